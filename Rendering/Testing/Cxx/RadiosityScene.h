// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Actors in a window whose pass solves their radiosity, for tests of that.
#ifndef RadiosityScene_h
#define RadiosityScene_h

#include "CornellBoxTesting.h"
#include "LightTransportTesting.h"
#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkRadiosity.h"
#include "vtkRadiosityPass.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <algorithm>
#include <array>
#include <vector>

namespace RadiosityScene
{
/// More than any solution of these tests takes.
constexpr double Whole = 1e6;
constexpr int Side = 64;

inline vtkSmartPointer<vtkActor> MakeActor(vtkPolyData* surface)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

/// `count` x `count` quadrilaterals on a square of side 2 around the origin, with its front towards
/// +z.
inline vtkSmartPointer<vtkPolyData> MakeSquare(int count)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-1.0, -1.0, 0.0);
  source->SetPoint1(1.0, -1.0, 0.0);
  source->SetPoint2(-1.0, 1.0, 0.0);
  source->SetResolution(count, count);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return source->GetOutput();
}

/// A corner: a white floor and a red wall, by their properties, under a light, and a small lamp
/// above, by its ambient color.
struct Scene
{
  vtkNew<vtkOffScreenOpenGLRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkLight> Light;
  vtkSmartPointer<vtkActor> Floor = MakeActor(MakeSquare(6));
  vtkSmartPointer<vtkActor> Wall = MakeActor(MakeSquare(6));
  vtkSmartPointer<vtkActor> Lamp = MakeActor(MakeSquare(1));
  vtkNew<vtkRadiosity> Radiosity;
  vtkNew<vtkRadiosityPass> Pass;

  Scene()
  {
    this->Floor->GetProperty()->SetDiffuseColor(0.8, 0.8, 0.7);
    this->Wall->GetProperty()->SetDiffuseColor(0.9, 0.1, 0.1);
    this->Wall->GetProperty()->SetDiffuse(0.75);
    this->Wall->SetPosition(-1.0, 0.0, 1.0);
    this->Wall->RotateY(90.0);
    this->Lamp->SetScale(0.2);
    this->Lamp->SetPosition(0.3, 0.0, 1.5);
    this->Lamp->RotateX(180.0);
    this->Lamp->GetProperty()->SetAmbient(1.0);
    this->Lamp->GetProperty()->SetDiffuse(0.0);
    for (vtkActor* actor : { this->Floor.Get(), this->Wall.Get(), this->Lamp.Get() })
    {
      this->Renderer->AddActor(actor);
    }
    this->Light->SetLightTypeToSceneLight();
    this->Light->SetPosition(3.0, 1.0, 4.0);
    this->Light->SetFocalPoint(0.0, 0.0, 0.0);
    this->Light->SetIntensity(0.5);
    this->Renderer->AddLight(this->Light);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(4.0, -4.0, 4.0);
    camera->SetFocalPoint(-0.3, 0.0, 0.6);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->ParallelProjectionOn();
    camera->SetParallelScale(2.0);
    this->Renderer->ResetCameraClippingRange();
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Side, Side);
    this->Window->AddRenderer(this->Renderer);
    this->Pass->SetRadiosity(this->Radiosity);
    this->Pass->SetFrameBudget(Whole);
    this->Pass->SetOutputEncodingToLinear();
    this->Pass->SetExposure(1.5);
    this->Renderer->SetPass(this->Pass);
  }
  ~Scene() { this->Pass->ReleaseGraphicsResources(this->Window); }
  Scene(const Scene&) = delete;
  void operator=(const Scene&) = delete;

  void ShootInstead(double tolerance)
  {
    this->Radiosity->SetSolverToSouthwell();
    this->Radiosity->SetDeviceToOpenGL();
    this->Radiosity->SetTolerance(tolerance);
  }
  /// So dark that it ends after as few shots as there are between two looks at what is left.
  void ShootFew()
  {
    this->ShootInstead(1.0);
    this->Floor->GetProperty()->SetDiffuse(0.5);
    this->Wall->GetProperty()->SetDiffuse(0.5);
  }
};

inline void Fill(vtkPolyData* surface, const char* name, const std::array<double, 3>& value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    array->InsertNextTuple(value.data());
  }
  surface->GetCellData()->AddArray(array);
}

/// Values of an array of all actors of a scene, one after another.
inline std::vector<double> Read(Scene& scene, const char* name)
{
  std::vector<double> values;
  for (vtkActor* actor : { scene.Floor.Get(), scene.Wall.Get(), scene.Lamp.Get() })
  {
    vtkPolyData* output = scene.Pass->GetOutput(actor);
    if (LightTransportTesting::Check(output != nullptr, "an actor has no output"))
    {
      const std::vector<double> more = LightTransportTesting::GetCellValues(output, name);
      values.insert(values.end(), more.begin(), more.end());
    }
  }
  return values;
}

inline double GetLargest(const std::vector<double>& values)
{
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

inline std::array<vtkIdType, 3> GetRuns(Scene& scene)
{
  return { scene.Pass->GetNumberOfLinkRuns(), scene.Pass->GetNumberOfLightRuns(),
    scene.Pass->GetNumberOfSolverRuns() };
}

/// Frames until it has converged; 0 where it does not.
inline int DrawAll(Scene& scene, int most = 100000)
{
  for (int frame = 1; frame <= most; ++frame)
  {
    scene.Window->Render();
    if (scene.Pass->IsConverged())
    {
      return frame;
    }
  }
  LightTransportTesting::Check(false, "it does not converge");
  return 0;
}

/// What of an actor is drawn, where it is.
inline vtkSmartPointer<vtkPolyData> MoveToWorld(vtkActor* actor, vtkPolyData* surface)
{
  vtkNew<vtkTransform> transform;
  actor->ComputeMatrix();
  transform->SetMatrix(actor->GetMatrix());
  vtkNew<vtkTransformPolyDataFilter> moved;
  moved->SetTransform(transform);
  moved->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  moved->SetInputData(surface);
  moved->Update();
  return moved->GetOutput();
}
} // namespace RadiosityScene

#endif
