// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A ball that other light than the renderer's falls on, for tests of vtkSurfaceLighting.
#ifndef LitScene_h
#define LitScene_h

#include "EnvironmentTesting.h"
#include "LightTransportTesting.h"
#include "ScatteringScene.h"
#include "vtkRadianceTransfer.h"
#include "vtkSurfaceLighting.h"

#include "vtkPlaneSource.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace ScatteringScene
{
constexpr int Size = 128;
constexpr double Index = 1.3;

/// Without the renderer's lights; links are few, since they are not what is tested.
struct LitScene : Scene
{
  vtkSurfaceLighting* Lighting;
  vtkSmartPointer<vtkPolyData> Plate; ///< casts a shadow

  explicit LitScene(int side = Size / ChartsPerSide) : Scene(side)
  {
    this->Lighting = this->Pass->GetLighting();
    this->Lighting->RendererLightsOff();
    this->Material->SetLinkMethodToUniform();
    this->Material->SetNumberOfLinks(4);
    this->Pass->SetScatteredMapSize(16);
    this->Pass->SetShadowMapSize(1024);
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-1.5, -1.5, 1.6);
    plane->SetPoint1(0.6, -1.5, 1.6);
    plane->SetPoint2(-1.5, 1.5, 1.3);
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputConnection(plane->GetOutputPort());
    triangles->Update();
    this->Plate = triangles->GetOutput();
  }

  vtkActor* AddPlate()
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(this->Plate);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    return actor;
  }

  std::vector<double> Draw()
  {
    this->Window->Render();
    return Read(this->Pass->GetTransmittedMap(this->Actor)->GetTexture());
  }

  /// Puts the ball's transfer, with the plate's shadow, where it is drawn.
  void AddTransfer(bool hasShadows, int degree = 4)
  {
    vtkNew<vtkRadianceTransfer> transfer;
    transfer->SetInputDataObject(Join(this->Ball, hasShadows ? this->Plate.Get() : nullptr));
    transfer->SetRefractiveIndex(Index);
    transfer->SetDegree(degree);
    transfer->SetSamples(256);
    transfer->Update();
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(transfer->GetOutputDataObject(0));
    auto* lit = vtkPolyData::SafeDownCast(blocks->GetBlock(0));
    vtkDataArray* values = lit->GetCellData()->GetArray("RadianceTransfer");
    this->Ball->GetCellData()->AddArray(values);
  }
};

inline double CheckMap(const std::vector<double>& map, const std::vector<double>& expected,
  double tolerance, const std::string& what)
{
  if (!LightTransportTesting::Check(map.size() == expected.size(), what + ": there is no map"))
  {
    return 1.0;
  }
  const Difference difference = Compare(map, expected);
  std::cout << what << ": relative error " << difference.Relative << ", texels off by 5 % "
            << difference.Outliers << "\n";
  LightTransportTesting::Check(difference.Relative <= tolerance, what + ": the map is off");
  return difference.Relative;
}

/// The largest difference of two maps over the largest value.
inline double GetDifference(const std::vector<double>& a, const std::vector<double>& b,
  double factor = 1)
{
  double largest = 0.0;
  double difference = a.size() == b.size() && !a.empty() ? 0.0 : 1e30;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
  {
    if (k % 4 < 3)
    {
      largest = std::max(largest, std::abs(b[k]));
      difference = std::max(difference, std::abs(a[k] - factor * b[k]));
    }
  }
  return difference / std::max(largest, 1e-30);
}

/// Over the surface.
inline double GetMean(const std::vector<double>& map)
{
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t k = 0; k < map.size(); k += 4)
  {
    sum += map[k];
    area += map[k + 3];
  }
  return sum / area;
}
} // namespace ScatteringScene

#endif
