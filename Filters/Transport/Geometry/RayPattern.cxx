// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/RayPattern.h"

#include "Geometry/PatchSampler.h"

#include <algorithm>
#include <utility>

namespace LightTransport
{
namespace
{
// Digits of each of the two dimensions that tell a cell of directions from others.
constexpr int CellDigits = 12;

//------------------------------------------------------------------------------
// Cells in the order of a curve through all of them (Morton's).
std::uint32_t GetCell(int point)
{
  const std::uint32_t u = PatchSampler::GetDigits(point, 0);
  const std::uint32_t v = PatchSampler::GetDigits(point, 1);
  std::uint32_t cell = 0;
  for (int digit = 31; digit > 31 - CellDigits; --digit)
  {
    cell = cell << 2 | ((v >> digit) & 1u) << 1 | ((u >> digit) & 1u);
  }
  return cell;
}
} // namespace

//------------------------------------------------------------------------------
RayPattern::RayPattern(int first, int count)
  : Count(count), Packets((count + Lanes - 1) / Lanes, Packet())
{
  std::vector<std::pair<std::uint32_t, int>> order(count);
  for (int place = 0; place < count; ++place)
  {
    order[place] = { GetCell(first + place), place };
  }
  std::sort(order.begin(), order.end());
  for (int point = 0; point < count; ++point)
  {
    Packet& packet = this->Packets[point / Lanes];
    const int lane = packet.Count++;
    packet.Places[lane] = order[point].second;
    for (int dimension = 0; dimension < Dimensions; ++dimension)
    {
      packet.Digits[dimension][lane] = OwenScrambling::Reverse(
        PatchSampler::GetDigits(first + packet.Places[lane], dimension ^ 2));
    }
  }
}
} // namespace LightTransport
