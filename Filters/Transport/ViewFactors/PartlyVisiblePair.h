// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Two patches with something partly between them.
#ifndef PartlyVisiblePair_h
#define PartlyVisiblePair_h

#include "vtkType.h"

namespace LightTransport
{
struct PartlyVisiblePair
{
  vtkIdType I = 0; ///< I < J
  vtkIdType J = 0;
  double Open = 0.0;  ///< the exchange with nothing between, unit of the matrix
  double Value = 0.0; ///< the exchange as computed
  double Error = 0.0; ///< estimate of its absolute error
};
} // namespace LightTransport

#endif
