// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How far coordinates may be off, by what they are: their type and size, as the transport filters
 * take it, and the number of digits that they were written with. Numbers that need few digits, as
 * those of a drawing, are exact.
 */
#ifndef CoordinateRounding_h
#define CoordinateRounding_h

#include <array>
#include <vector>

namespace LightTransport
{
namespace CoordinateRounding
{
/// Of points in single or double precision, in their unit.
double Find(const std::vector<std::array<double, 3>>& points, bool isSingle);
} // namespace CoordinateRounding
} // namespace LightTransport

#endif
