// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CodecMemory_h
#define CodecMemory_h

#include <ImfHeader.h>

namespace LightTransport
{
namespace CodecMemory
{
/// Throws std::bad_alloc where there is no memory for what OpenEXR's DWA compression takes beside
/// the pixels: it does not look whether it gets that, and writes to it.
void Require(const Imf::Header& header);
} // namespace CodecMemory
} // namespace LightTransport

#endif
