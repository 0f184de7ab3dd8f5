// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/SideMasks.h"

#include "Support/InstructionSets.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
constexpr int N = SideFinder::MaximumPatches;
constexpr double Far = 1e30;

struct Sides
{
  bool Above = false;
  bool On = false;
  bool Below = false;
};

//------------------------------------------------------------------------------
Sides Compare(const PatchPlane& plane, const PatchGeometry& geometry, vtkIdType polygon)
{
  Sides sides;
  for (int corner = 0; corner < geometry.GetNumberOfCorners(polygon); ++corner)
  {
    const double height = plane.GetCertainHeight(geometry.GetCorner(polygon, corner));
    sides.Above = sides.Above || height > 0.0;
    sides.On = sides.On || height == 0.0;
    sides.Below = sides.Below || height < 0.0;
  }
  return sides;
}

//------------------------------------------------------------------------------
// Of some heights: within the rounding they are none, beyond the limit they are certain; the doubt
// is how far from between them they are, below 0 in between. The number of lanes is handed down:
// loops of constant length would be unrolled, and become no vector instructions.
struct Table
{
  double Rounding[N], Limit[N], Highest[N], Lowest[N], Doubt[N];
};

LT_INLINE void Clear(Table& table, int lanes)
{
  for (int k = 0; k < lanes; ++k)
  {
    table.Highest[k] = -Far;
    table.Lowest[k] = Far;
    table.Doubt[k] = Far;
  }
}

// Values are chosen, not references to them: else the loop would become no vector instructions.
LT_INLINE void Add(const double* heights, Table& table, int lanes)
{
  for (int k = 0; k < lanes; ++k)
  {
    const double height = heights[k];
    const double size = std::abs(height);
    const double beyond = size - table.Limit[k];
    const double within = table.Rounding[k] - size;
    const double distance = beyond > within ? beyond : within;
    const double highest = table.Highest[k];
    const double lowest = table.Lowest[k];
    const double doubt = table.Doubt[k];
    table.Highest[k] = height > highest ? height : highest;
    table.Lowest[k] = height < lowest ? height : lowest;
    table.Doubt[k] = distance < doubt ? distance : doubt;
  }
}

//------------------------------------------------------------------------------
struct Masks
{
  std::uint16_t Above, OnOrBelow, Below, Doubtful;
};

LT_INLINE Masks MakeMasks(const Table& table, int lanes)
{
  unsigned int above = 0, onOrBelow = 0, below = 0, doubtful = 0;
  for (int k = 0; k < lanes; ++k)
  {
    above |= static_cast<unsigned int>(table.Highest[k] > table.Rounding[k]) << k;
    onOrBelow |= static_cast<unsigned int>(table.Lowest[k] <= table.Rounding[k]) << k;
    below |= static_cast<unsigned int>(table.Lowest[k] < -table.Rounding[k]) << k;
    doubtful |= static_cast<unsigned int>(table.Doubt[k] < 0.0) << k;
  }
  return { static_cast<std::uint16_t>(above), static_cast<std::uint16_t>(onOrBelow),
    static_cast<std::uint16_t>(below), static_cast<std::uint16_t>(doubtful) };
}

//------------------------------------------------------------------------------
// The corners of a wall over all planes.
LT_CLONES Masks CompareWithPlanes(const PatchGeometry::Vector* corners, int count,
  const double* const normal[3], const double* offset, const double* rounding, const double* limit,
  int lanes)
{
  Table table;
  Clear(table, lanes);
  for (int k = 0; k < lanes; ++k)
  {
    table.Rounding[k] = rounding[k];
    table.Limit[k] = limit[k];
  }
  for (int corner = 0; corner < count; ++corner)
  {
    const double x = corners[corner][0], y = corners[corner][1], z = corners[corner][2];
    double heights[N];
    for (int k = 0; k < lanes; ++k)
    {
      heights[k] = normal[0][k] * x + normal[1][k] * y + normal[2][k] * z - offset[k];
    }
    Add(heights, table, lanes);
  }
  return MakeMasks(table, lanes);
}

//------------------------------------------------------------------------------
// All patches over the plane of a wall.
LT_CLONES Masks CompareWithCorners(const PatchPlane& plane,
  const std::vector<std::array<std::array<double, N>, 3>>& corners, int lanes)
{
  const double x = plane.Normal[0], y = plane.Normal[1], z = plane.Normal[2];
  const double offset = plane.Normal.dot(plane.Origin);
  Table table;
  Clear(table, lanes);
  for (int k = 0; k < lanes; ++k)
  {
    table.Rounding[k] = plane.Rounding;
    table.Limit[k] = plane.Rounding + plane.Slope;
  }
  for (const auto& corner : corners)
  {
    double heights[N];
    for (int k = 0; k < lanes; ++k)
    {
      heights[k] = x * corner[0][k] + y * corner[1][k] + z * corner[2][k] - offset;
    }
    Add(heights, table, lanes);
  }
  return MakeMasks(table, lanes);
}
} // namespace

//------------------------------------------------------------------------------
SideMasks FindSides(const PatchGeometry& walls, vtkIdType wall, const PatchGeometry& patches,
  vtkIdType patch)
{
  const Sides ofWall = Compare(patches.GetPlane(patch), walls, wall);
  const Sides ofPatch = Compare(walls.GetPlane(wall), patches, patch);
  SideMasks sides;
  sides.Front = ofWall.Above ? 1 : 0;
  sides.Cut = ofWall.Above && (ofWall.On || ofWall.Below) ? 1 : 0;
  sides.Above = ofPatch.Above ? 1 : 0;
  sides.Below = ofPatch.Below ? 1 : 0;
  return sides;
}

//------------------------------------------------------------------------------
void SideFinder::SetPatches(vtkIdType first, vtkIdType last)
{
  this->First = first;
  this->Count = static_cast<int>(last - first);
  int most = 0;
  for (int k = 0; k < N; ++k)
  {
    const vtkIdType patch = std::min(first + k, last - 1);
    const PatchPlane plane = this->Patches.GetPlane(patch);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Normal[axis][k] = plane.Normal[axis];
    }
    this->Offset[k] = plane.Normal.dot(plane.Origin);
    this->Rounding[k] = plane.Rounding;
    // Nothing in the scene is further away.
    this->Limit[k] = plane.GetTolerance(1.0);
    most = std::max(most, this->Patches.GetNumberOfCorners(patch));
  }
  this->Corners.resize(most);
  for (int corner = 0; corner < most; ++corner)
  {
    for (int k = 0; k < N; ++k)
    {
      const vtkIdType patch = std::min(first + k, last - 1);
      const auto& place = this->Patches.GetCorner(patch,
        std::min(corner, this->Patches.GetNumberOfCorners(patch) - 1));
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Corners[corner][axis][k] = place[axis];
      }
    }
  }
}

//------------------------------------------------------------------------------
SideMasks SideFinder::Find(vtkIdType wall) const
{
  PatchGeometry::Vector places[PatchGeometry::MaximumCorners];
  const int count = this->Walls.GetNumberOfCorners(wall);
  for (int corner = 0; corner < count; ++corner)
  {
    places[corner] = this->Walls.GetCorner(wall, corner);
  }
  const double* const normal[3] = { this->Normal[0].data(), this->Normal[1].data(),
    this->Normal[2].data() };
  const Masks ofWall = CompareWithPlanes(places, count, normal, this->Offset.data(),
    this->Rounding.data(), this->Limit.data(), this->Count);
  const Masks ofPatches =
    CompareWithCorners(this->Walls.GetPlane(wall), this->Corners, this->Count);
  SideMasks sides;
  sides.Front = ofWall.Above;
  sides.Cut = ofWall.Above & ofWall.OnOrBelow;
  sides.Above = ofPatches.Above;
  sides.Below = ofPatches.Below;
  const unsigned int doubtful = ofWall.Doubtful | ofPatches.Doubtful;
  for (int k = 0; k < this->Count && doubtful >> k != 0; ++k)
  {
    if (doubtful >> k & 1)
    {
      const SideMasks exact = FindSides(this->Walls, wall, this->Patches, this->First + k);
      const auto set = [k](std::uint16_t& mask, int bit)
      { mask = static_cast<std::uint16_t>((mask & ~(1 << k)) | bit << k); };
      set(sides.Front, exact.Front);
      set(sides.Cut, exact.Cut);
      set(sides.Above, exact.Above);
      set(sides.Below, exact.Below);
    }
  }
  return sides;
}
} // namespace LightTransport
