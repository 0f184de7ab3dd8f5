// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/TexelMaps.h"

#include "Atlas/TexelPieces.h"
#include "Common/Heartbeat.h"
#include "Shared/ArrayNames.h"
#include "Shared/TransportMemory.h"
#include "Shared/ZeroedArray.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangle.h"

#include <algorithm>
#include <array>

namespace LightTransport
{
namespace
{
using Triangle = std::array<vtkIdType, 3>;

//------------------------------------------------------------------------------
// Fails where the arrays of the maps do not fit into memory.
Outcome CheckMemory(int resolution, const std::vector<TexelMaps::Source>& sources)
{
  int components = 3 + 3 + 1;
  for (const TexelMaps::Source& source : sources)
  {
    components += source.Array->GetNumberOfComponents();
  }
  const double texels = static_cast<double>(resolution) * resolution;
  const double bytes = texels * (static_cast<double>(sizeof(double)) * components + sizeof(int));
  const std::string side = std::to_string(resolution);
  return TransportMemory::CanAllocate(bytes)
    ? Outcome::Done()
    : Outcome::Failed("Maps of " + side + " x " + side + " texels need " +
        TransportMemory::Format(bytes) + " of memory, which are not there: set a smaller " +
        "Resolution, or give fewer arrays.");
}

//------------------------------------------------------------------------------
template <typename Array, typename Value>
void Fill(Array* array, Value value, const Monitor& monitor)
{
  constexpr vtkIdType part = 1 << 20;
  Heartbeat heart(monitor, 1);
  for (vtkIdType first = 0; first < array->GetNumberOfValues(); first += part)
  {
    heart.Beat();
    std::fill_n(array->GetPointer(first), std::min(part, array->GetNumberOfValues() - first),
      value);
  }
}

// The means of one array over all texels, as the pieces seen so far make them.
class Mean
{
public:
  Mean(const TexelMaps::Source& source, const char* name, vtkImageData* maps,
    const Monitor& monitor)
    : Source(source), Components(source.Array->GetNumberOfComponents()),
      Values(source.Array->GetNumberOfComponents())
  {
    this->Means->SetName(name);
    this->Means->SetNumberOfComponents(this->Components);
    this->Means->CopyComponentNames(source.Array);
    ZeroedArray::Fill(this->Means, maps->GetNumberOfPoints());
    Fill(this->Means.Get(), 0.0, monitor);
    maps->GetPointData()->AddArray(this->Means);
  }

  // The value is linear in each cell: one at the first corner and, from there, two slopes.
  void SetCell(vtkIdType cell, const Triangle& corners)
  {
    for (int i = 0; i < this->Components; ++i)
    {
      std::array<double, 3>& value = this->Values[i];
      if (this->Source.OfPoints)
      {
        value[0] = this->Source.Array->GetComponent(corners[0], i);
        value[1] = this->Source.Array->GetComponent(corners[1], i) - value[0];
        value[2] = this->Source.Array->GetComponent(corners[2], i) - value[0];
      }
      else
      {
        value = { this->Source.Array->GetComponent(cell, i), 0.0, 0.0 };
      }
    }
  }

  // `share` is the part that the piece has in what is known of its texel. Moving the mean by that
  // part of the difference leaves a constant exactly as it is.
  void Add(const TexelPieces::Piece& piece, double share)
  {
    double* mean = this->Means->GetPointer(piece.Texel * this->Components);
    for (int i = 0; i < this->Components; ++i)
    {
      const std::array<double, 3>& value = this->Values[i];
      const double here = value[0] + piece.Weights[1] * value[1] + piece.Weights[2] * value[2];
      mean[i] += share * (here - mean[i]);
    }
  }

private:
  TexelMaps::Source Source;
  int Components;
  std::vector<std::array<double, 3>> Values;
  vtkSmartPointer<vtkDoubleArray> Means = vtkSmartPointer<vtkDoubleArray>::New();
};

//------------------------------------------------------------------------------
void MakeGrid(int resolution, vtkImageData* maps)
{
  const double spacing = 1.0 / resolution;
  maps->SetDimensions(resolution, resolution, 1);
  maps->SetSpacing(spacing, spacing, spacing);
  maps->SetOrigin(0.5 * spacing, 0.5 * spacing, 0.0);
}

//------------------------------------------------------------------------------
template <typename Array>
vtkSmartPointer<Array> AddMap(const char* name, typename Array::ValueType value, vtkImageData* maps,
  const Monitor& monitor)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  ZeroedArray::Fill(array, maps->GetNumberOfPoints());
  Fill(array.Get(), value, monitor);
  maps->GetPointData()->AddArray(array);
  return array;
}

//------------------------------------------------------------------------------
Triangle GetCorners(vtkPolyData* surface, vtkIdType cell)
{
  vtkIdType size;
  const vtkIdType* corners;
  surface->GetPolys()->GetCellAtId(cell, size, corners);
  return { corners[0], corners[1], corners[2] };
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDoubleArray> MakeNormals(vtkPolyData* surface, const Monitor& monitor)
{
  Heartbeat heart(monitor);
  auto normals = vtkSmartPointer<vtkDoubleArray>::New();
  normals->SetNumberOfComponents(3);
  ZeroedArray::Fill(normals, surface->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    heart.Beat();
    const Triangle corners = GetCorners(surface, cell);
    vtkTriangle::ComputeNormal(surface->GetPoints(), 3, corners.data(),
      normals->GetPointer(3 * cell));
  }
  return normals;
}

//------------------------------------------------------------------------------
void Normalize(vtkDataArray* vectors, const Monitor& monitor)
{
  Heartbeat heart(monitor);
  for (vtkIdType i = 0; i < vectors->GetNumberOfTuples(); ++i)
  {
    heart.Beat();
    std::array<double, 3> vector;
    vectors->GetTuple(i, vector.data());
    vtkMath::Normalize(vector.data());
    vectors->SetTuple(i, vector.data());
  }
}
} // namespace

//------------------------------------------------------------------------------
Outcome TexelMaps::Make(vtkPolyData* surface, int resolution, vtkImageData* maps,
  const Monitor& monitor, const std::vector<Source>& sources)
{
  if (Outcome checked = CheckMemory(resolution, sources); !checked)
  {
    return checked;
  }
  const Monitor first = monitor.GetStage(0.0, 0.1);
  const Monitor last = monitor.GetStage(0.9, 1.0);
  MakeGrid(resolution, maps);
  const vtkSmartPointer<vtkDoubleArray> normals = MakeNormals(surface, first);
  std::vector<Mean> means;
  means.emplace_back(TexelMaps::Source{ surface->GetPoints()->GetData(), true },
    ArrayNames::TexelPosition, maps, first);
  means.emplace_back(TexelMaps::Source{ normals, false }, ArrayNames::TexelNormal, maps, first);
  for (const Source& source : sources)
  {
    means.emplace_back(source, source.Array->GetName(), maps, first);
  }
  const auto areas = AddMap<vtkDoubleArray>(ArrayNames::TexelArea, 0.0, maps, first);
  const auto charts = AddMap<vtkIntArray>(ArrayNames::ChartId, -1, maps, first);

  vtkDataArray* chartOfCell = surface->GetCellData()->GetArray(ArrayNames::ChartId);
  vtkIdType cell = -1;
  int chart = 0;
  TexelPieces::Visit(
    surface, resolution,
    [&](const TexelPieces::Piece& piece)
    {
      if (piece.Cell != cell)
      {
        cell = piece.Cell;
        const Triangle corners = GetCorners(surface, cell);
        for (Mean& mean : means)
        {
          mean.SetCell(cell, corners);
        }
        chart = chartOfCell ? static_cast<int>(chartOfCell->GetComponent(cell, 0)) : 0;
      }
      double& area = *areas->GetPointer(piece.Texel);
      area += piece.Area;
      for (Mean& mean : means)
      {
        mean.Add(piece, piece.Area / area);
      }
      charts->SetValue(piece.Texel, chart);
    },
    monitor.GetStage(0.1, 0.9));
  Normalize(maps->GetPointData()->GetArray(ArrayNames::TexelNormal), last);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
bool TexelMaps::IsTexelMap(const std::string& name)
{
  return name == ArrayNames::TexelPosition || name == ArrayNames::TexelNormal ||
    name == ArrayNames::TexelArea || name == ArrayNames::ChartId;
}
} // namespace LightTransport
