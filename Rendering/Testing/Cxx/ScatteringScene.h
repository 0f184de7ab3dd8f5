// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A ball with an atlas, in a window, for tests of what is drawn into the atlas.
#ifndef ScatteringScene_h
#define ScatteringScene_h

#include "vtkDirectIrradiance.h"
#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkOpenGLAtlasTexture.h"
#include "vtkOpenGLScatteredMap.h"
#include "vtkOpenGLTransmittedMap.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkSubsurfaceScatteringPass.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTriangle.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ScatteringScene
{
/// Faces of a cube that are charts, each a fourth of the atlas a side, six of sixteen.
constexpr int Faces = 6;
constexpr int ChartsPerSide = 4;

/// Of one chart, side x side squares, each halved, between points in rows from `first` on.
inline void AddSquares(int side, vtkIdType first, int chart, vtkCellArray* triangles,
  vtkIntArray* charts)
{
  for (int j = 0; j < side; ++j)
  {
    for (int i = 0; i < side; ++i)
    {
      const vtkIdType corner = first + j * (side + 1) + i;
      const vtkIdType lower[3] = { corner, corner + 1, corner + side + 2 };
      const vtkIdType upper[3] = { corner, corner + side + 2, corner + side + 1 };
      triangles->InsertNextCell(3, lower);
      triangles->InsertNextCell(3, upper);
      charts->InsertNextValue(chart);
      charts->InsertNextValue(chart);
    }
  }
}

/// A ball of radius 1: each face of a cube is side x side squares, halved, and one chart;
/// `firstChart` of the 16 that there is room for.
inline vtkSmartPointer<vtkPolyData> MakeBall(int side, const double center[3], int firstChart = 0)
{
  auto ball = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkDoubleArray> coordinates;
  vtkNew<vtkIntArray> charts;
  points->SetDataTypeToDouble();
  coordinates->SetName("AtlasCoordinates");
  coordinates->SetNumberOfComponents(2);
  charts->SetName("ChartId");
  for (int face = 0; face < Faces; ++face)
  {
    const int chart = firstChart + face;
    const int ahead = face / 2;
    const double sign = face % 2 == 0 ? 1.0 : -1.0;
    const vtkIdType first = points->GetNumberOfPoints();
    for (int j = 0; j <= side; ++j)
    {
      for (int i = 0; i <= side; ++i)
      {
        double place[3];
        place[ahead] = sign;
        // Equal angles, so that squares are about as large everywhere.
        place[(ahead + 1) % 3] = sign * std::tan(vtkMath::Pi() / 4.0 * (2.0 * i / side - 1.0));
        place[(ahead + 2) % 3] = std::tan(vtkMath::Pi() / 4.0 * (2.0 * j / side - 1.0));
        vtkMath::Normalize(place);
        vtkMath::Add(place, center, place);
        points->InsertNextPoint(place);
        coordinates->InsertNextTuple2((chart % ChartsPerSide + static_cast<double>(i) / side) /
            ChartsPerSide,
          (chart / ChartsPerSide + static_cast<double>(j) / side) / ChartsPerSide);
      }
    }
    AddSquares(side, first, chart, triangles, charts);
  }
  ball->SetPoints(points);
  ball->SetPolys(triangles);
  ball->GetPointData()->AddArray(coordinates);
  ball->GetCellData()->AddArray(charts);
  return ball;
}

/// The texel of a map, `size` texels a side, that a pair of triangles of a ball is, whose faces
/// have size / ChartsPerSide squares a side.
inline vtkIdType GetTexel(vtkIdType pair, int size)
{
  const int side = size / ChartsPerSide;
  const auto face = static_cast<int>(pair / (side * side));
  const auto within = static_cast<int>(pair % (side * side));
  const vtkIdType column = (face % ChartsPerSide) * side + within % side;
  const vtkIdType line = (face / ChartsPerSide) * side + within / side;
  return line * size + column;
}

/// Of a triangle.
inline double GetArea(vtkPolyData* surface, vtkIdType cell)
{
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  surface->GetPolys()->GetCellAtId(cell, count, corners);
  double points[3][3];
  for (int corner = 0; corner < 3; ++corner)
  {
    surface->GetPoint(corners[corner], points[corner]);
  }
  return vtkTriangle::TriangleArea(points[0], points[1], points[2]);
}

/// A translucent ball, a renderer with one light, and a pass with small maps.
struct Scene
{
  vtkNew<vtkOffScreenOpenGLRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkLight> Light;
  vtkSmartPointer<vtkPolyData> Ball;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkSubsurfaceScattering> Material;
  vtkNew<vtkSubsurfaceScatteringPass> Pass;

  explicit Scene(int side = 8)
  {
    const double center[3] = { 0.0, 0.0, 0.0 };
    this->Ball = MakeBall(side, center);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(this->Ball);
    mapper->ScalarVisibilityOff();
    this->Actor->SetMapper(mapper);
    this->Actor->GetProperty()->SetDiffuse(0.0);
    this->Actor->GetProperty()->SetAmbient(0.0);
    this->Renderer->AddActor(this->Actor);
    this->Light->SetLightTypeToSceneLight();
    this->Light->SetPosition(1.0, 2.0, 3.0);
    this->Light->SetFocalPoint(0.0, 0.0, 0.0);
    this->Renderer->AddLight(this->Light);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(64, 64);
    this->Window->AddRenderer(this->Renderer);
    this->Material->SetMillimetersPerUnit(5.0);
    this->Material->SetLinkMethodToAdaptive();
    this->Pass->SetIrradianceMapSize(128);
    this->Pass->SetScatteredMapSize(32);
    this->Pass->SetOutputEncodingToLinear();
    this->Pass->SetMaterial(this->Actor, this->Material);
    this->Renderer->SetPass(this->Pass);
  }

  Scene(const Scene&) = delete;
  void operator=(const Scene&) = delete;
};

/// Level 0 of a map: value x area, and area, four numbers a texel.
inline std::vector<double> Read(vtkOpenGLAtlasTexture* map, int level = 0)
{
  vtkNew<vtkFloatArray> texels;
  if (!map->ReadLevel(level, texels))
  {
    return {};
  }
  return { texels->GetPointer(0), texels->GetPointer(0) + texels->GetNumberOfValues() };
}
/// What differs between two maps, and where.
struct Difference
{
  double Relative = 0.0; ///< L2, weighted by area
  double Outliers = 0.0; ///< part of the area that is off by more than 5 % of the largest
};

inline Difference Compare(const std::vector<double>& map, const std::vector<double>& expected)
{
  double squares = 0.0;
  double errors = 0.0;
  double largest = 0.0;
  for (std::size_t k = 0; k < map.size(); ++k)
  {
    const double area = map[k | 3];
    if (k % 4 < 3 && area > 0.0)
    {
      largest = std::max(largest, expected[k]);
      squares += area * expected[k] * expected[k];
      errors += area * std::pow(map[k] / area - expected[k], 2);
    }
  }
  double off = 0.0;
  double whole = 0.0;
  for (std::size_t k = 0; k < map.size(); k += 4)
  {
    const double area = map[k + 3];
    whole += area;
    off += area > 0.0 && std::abs(map[k] / area - expected[k]) > 0.05 * largest ? area : 0.0;
  }
  return { std::sqrt(errors / squares), off / whole };
}

/// A ball, and what casts a shadow on it.
inline vtkSmartPointer<vtkMultiBlockDataSet> Join(vtkPolyData* ball, vtkPolyData* blocker)
{
  auto scene = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  scene->SetBlock(0, ball);
  if (blocker)
  {
    scene->SetBlock(1, blocker);
  }
  return scene;
}

/// The means over texels of a cell array of a ball that has two triangles for each texel.
inline std::vector<double> AverageOverTexels(vtkPolyData* lit, const char* name, int size)
{
  vtkDataArray* values = lit->GetCellData()->GetArray(name);
  std::vector<double> map(static_cast<std::size_t>(4) * size * size, 0.0);
  for (vtkIdType pair = 0; pair < lit->GetNumberOfCells() / 2; ++pair)
  {
    const double areas[2] = { GetArea(lit, 2 * pair), GetArea(lit, 2 * pair + 1) };
    const vtkIdType texel = GetTexel(pair, size);
    for (int k = 0; k < 3; ++k)
    {
      map[static_cast<std::size_t>(4 * texel + k)] =
        (areas[0] * values->GetComponent(2 * pair, k) +
          areas[1] * values->GetComponent(2 * pair + 1, k)) /
        (areas[0] + areas[1]);
    }
  }
  return map;
}

/// Those of what vtkDirectIrradiance gives it; `blocker` casts a shadow on it.
inline std::vector<double> GetTransmitted(vtkPolyData* ball, vtkPolyData* blocker,
  const std::vector<vtkLight*>& lights, double index, int size, vtkImageData* environment = nullptr)
{
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputDataObject(Join(ball, blocker));
  filter->SetShadows(blocker != nullptr);
  filter->SetRefractiveIndex(index);
  filter->SetEnvironment(environment);
  for (vtkLight* light : lights)
  {
    filter->AddLight(light);
  }
  filter->Update();
  auto* scene = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  return AverageOverTexels(vtkPolyData::SafeDownCast(scene->GetBlock(0)), "TransmittedIrradiance",
    size);
}

} // namespace ScatteringScene

#endif
