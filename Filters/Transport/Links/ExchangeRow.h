// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// G_ij of a patch with all others, as far as this part holds it: the bits of
/// vtkExchange::GetValue, which looks for each pair through all links of a patch.
#ifndef ExchangeRow_h
#define ExchangeRow_h

#include "vtkType.h"

#include <vector>

class vtkExchange;

namespace LightTransport
{
namespace ExchangeRow
{
/// Of the first kernel, one value for each patch.
void Copy(const vtkExchange* exchange, vtkIdType patch, std::vector<double>& row);
} // namespace ExchangeRow
} // namespace LightTransport

#endif
