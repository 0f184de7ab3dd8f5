// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/PolygonGathering.h"

#include "Scene/Leaves.h"
#include "Scene/PatchTree.h"
#include "Scene/TexelGathering.h"
#include "Shared/ArrayNames.h"
#include "Shared/BitHash.h"
#include "Shared/InputArrays.h"
#include "Shared/Pulse.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace LightTransport
{
namespace
{
// Coordinates in single precision come, as a rule, from better ones, rounded once or twice; those
// in double precision from arithmetic of their own.
constexpr double SinglePrecision = 1.5 * 0x1.0p-24;
constexpr double DoublePrecision = 4.0 * 0x1.0p-53;

//------------------------------------------------------------------------------
Outcome FindAtlas(vtkPolyData* data, vtkDataArray*& atlas)
{
  atlas = data->GetPointData()->GetArray(ArrayNames::AtlasCoordinates);
  if (!atlas || atlas->GetNumberOfComponents() != 2)
  {
    return Outcome::Failed(std::string("A surface has no point array \"") +
      ArrayNames::AtlasCoordinates +
      "\" with 2 components, which the cluster tree of the atlas needs: pass it through "
      "vtkSurfaceAtlas, or set ClusterTree to Spatial.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
bool IsGhost(vtkUnsignedCharArray* ghosts, vtkIdType cell)
{
  constexpr unsigned char skipped =
    vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
  return ghosts && (ghosts->GetValue(cell) & skipped);
}

//------------------------------------------------------------------------------
// False when a polygon names points that do not exist.
bool CollectBlock(vtkPolyData* data, int block, GatheredPolygons& polygons, BitHash& topology)
{
  auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
    data->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  const vtkIdType first = Leaves::GetFirstPolygonCell(data);
  vtkCellArray* cells = data->GetPolys();
  vtkNew<vtkIdList> corners;
  if (cells->GetNumberOfCells() > 0)
  {
    polygons.Precision = std::max(polygons.Precision,
      PolygonGathering::GetPrecision(data->GetPoints() ? data->GetPoints()->GetData() : nullptr));
  }
  for (vtkIdType polygon = 0; polygon < cells->GetNumberOfCells(); ++polygon)
  {
    Pulse::Beat(polygon);
    if (IsGhost(ghosts, first + polygon))
    {
      continue;
    }
    cells->GetCellAtId(polygon, corners);
    polygons.LocalCells.push_back({ block, first + polygon });
    polygons.Counts.push_back(corners->GetNumberOfIds());
    topology.Add(static_cast<std::uint64_t>(block));
    for (vtkIdType corner = 0; corner < corners->GetNumberOfIds(); ++corner)
    {
      const vtkIdType id = corners->GetId(corner);
      if (id < 0 || id >= data->GetNumberOfPoints())
      {
        return false;
      }
      topology.Add(static_cast<std::uint64_t>(id));
      double point[3];
      data->GetPoint(id, point);
      for (const double coordinate : point)
      {
        // Adding zero turns -0 into 0: equal coordinates then have equal bits.
        polygons.Coordinates.push_back(coordinate + 0.0);
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
Outcome CollectLocal(vtkDataObject* input, GatheredPolygons& polygons)
{
  const std::vector<vtkDataSet*> leaves = Leaves::Get(input);
  BitHash topology;
  for (std::size_t block = 0; block < leaves.size(); ++block)
  {
    auto* data = vtkPolyData::SafeDownCast(leaves[block]);
    if (!data)
    {
      return Outcome::Failed(
        "A block of the input is no polygonal data: extract its surface first.");
    }
    if (data->GetNumberOfStrips() > 0)
    {
      return Outcome::Failed(
        "The input has triangle strips: pass it through vtkTriangleFilter first.");
    }
    if (Outcome checked = InputArrays::CheckLengths(data); !checked)
    {
      return checked;
    }
    if (!CollectBlock(data, static_cast<int>(block), polygons, topology))
    {
      return Outcome::Failed(
        "The input has polygons whose points do not exist: check its connectivity.");
    }
  }
  polygons.Topology = topology.Get();
  if (!std::all_of(polygons.Coordinates.begin(), polygons.Coordinates.end(),
        [](double value) { return std::isfinite(value); }))
  {
    return Outcome::Failed(
      "The input has point coordinates that are not finite (NaN or infinite): remove those "
      "points, for example with a threshold and vtkCleanPolyData.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// The code of the mean of a patch's corners: blocks of a quadtree are convex.
Outcome CollectCodes(vtkDataObject* input, GatheredPolygons& polygons)
{
  const std::vector<vtkDataSet*> leaves = Leaves::Get(input);
  const std::vector<vtkIdType> numbers = Leaves::GetNumbers(input);
  vtkNew<vtkIdList> corners;
  int block = -1;
  vtkDataArray* atlas = nullptr;
  for (const LocalCell& local : polygons.LocalCells)
  {
    Pulse::Beat(polygons.Codes.size());
    auto* data = vtkPolyData::SafeDownCast(leaves[local.Block]);
    if (local.Block != block)
    {
      block = local.Block;
      if (Outcome found = FindAtlas(data, atlas); !found)
      {
        return found;
      }
    }
    data->GetPolys()->GetCellAtId(local.Cell - Leaves::GetFirstPolygonCell(data), corners);
    double middle[2] = { 0.0, 0.0 };
    for (vtkIdType corner = 0; corner < corners->GetNumberOfIds(); ++corner)
    {
      for (int axis = 0; axis < 2; ++axis)
      {
        middle[axis] += atlas->GetComponent(corners->GetId(corner), axis) /
          static_cast<double>(corners->GetNumberOfIds());
      }
    }
    if (!(std::min(middle[0], middle[1]) >= 0.0 && std::max(middle[0], middle[1]) <= 1.0))
    {
      return Outcome::Failed(std::string("The point array \"") + ArrayNames::AtlasCoordinates +
        "\" places cell " + std::to_string(local.Cell) +
        " outside of the unit square: make it with vtkSurfaceAtlas, or set ClusterTree to "
        "Spatial.");
    }
    polygons.Codes.push_back(PatchTree::GetCode(middle[0], middle[1]));
    polygons.Surfaces.push_back(numbers[block]);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void GatherRanks(const Ranks& ranks, GatheredPolygons& polygons)
{
  const std::vector<vtkIdType> mine{ static_cast<vtkIdType>(polygons.Counts.size()) };
  const std::vector<vtkIdType> counts = ranks.Gather(mine);
  polygons.FirstLocal =
    std::accumulate(counts.begin(), counts.begin() + ranks.GetMine(), static_cast<vtkIdType>(0));
  const std::vector<double> precisions = ranks.Gather(std::vector<double>{ polygons.Precision });
  polygons.Precision = *std::max_element(precisions.begin(), precisions.end());
  BitHash topology;
  topology.AddAll(counts);
  topology.AddAll(ranks.Gather(std::vector<std::uint64_t>{ polygons.Topology }));
  polygons.Topology = topology.Get();
  polygons.Counts = ranks.Gather(polygons.Counts);
  polygons.Coordinates = ranks.Gather(polygons.Coordinates);
  polygons.Codes = ranks.Gather(polygons.Codes);
  polygons.Surfaces = ranks.Gather(polygons.Surfaces);
}

//------------------------------------------------------------------------------
Outcome Collect(vtkDataObject* input, bool withAtlas, GatheredPolygons& polygons)
{
  Outcome collected = CollectLocal(input, polygons);
  return collected && withAtlas ? CollectCodes(input, polygons) : collected;
}
} // namespace

//------------------------------------------------------------------------------
double PolygonGathering::GetPrecision(vtkDataArray* coordinates)
{
  const bool isDouble = coordinates && coordinates->GetDataType() == VTK_DOUBLE;
  return isDouble ? DoublePrecision : SinglePrecision;
}

//------------------------------------------------------------------------------
Outcome PolygonGathering::Gather(vtkDataObject* input, const Ranks& ranks, bool withAtlas,
  bool takesTexels, GatheredPolygons& polygons)
{
  if (takesTexels && TexelGathering::HasImages(input, ranks))
  {
    return TexelGathering::Gather(input, ranks, withAtlas, polygons);
  }
  Outcome collected = ranks.Agree(Collect(input, withAtlas, polygons));
  if (collected)
  {
    GatherRanks(ranks, polygons);
  }
  return collected;
}

//------------------------------------------------------------------------------
bool PolygonGathering::HasAtlas(vtkDataObject* input, const Ranks& ranks)
{
  GatheredPolygons polygons;
  return TexelGathering::HasImages(input, ranks) ||
    static_cast<bool>(ranks.Agree(Collect(input, true, polygons)));
}
} // namespace LightTransport
