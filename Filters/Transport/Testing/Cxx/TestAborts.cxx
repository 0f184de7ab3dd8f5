// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Whatever a filter is at, it tells its progress and hears an abort: here at every beat, where
// users hear of it ten times a second.
#include "AbortTesting.h"
#include "LightTransportTesting.h"
#include "MessageLog.h"

#include "Shared/Attempt.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"

#include "vtkCommand.h"
#include "vtkDirectIrradiance.h"
#include "vtkExchangeMatrix.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkPointData.h"
#include "vtkRadianceTransfer.h"
#include "vtkRadiosity.h"
#include "vtkSMPTools.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkTable.h"
#include "vtkViewFactors.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <thread>
#include <utility>

using namespace LightTransportTesting;
using LightTransport::Outcome;
using LightTransport::Pulse;
using LightTransport::Stopped;

namespace
{
//------------------------------------------------------------------------------
template <typename Work>
bool IsStopped(const Work& work)
{
  try
  {
    work();
  }
  catch (const Stopped&)
  {
    return true;
  }
  return false;
}

//------------------------------------------------------------------------------
void TestBeats()
{
  Pulse::Beat(); // nobody hears it
  int outer = 0;
  int inner = 0;
  const Pulse pulse(
    [&]()
    {
      ++outer;
      Pulse::Beat(); // what observers do is no part of the work
      return outer < 3;
    },
    0.0);
  {
    const Pulse other(
      [&]()
      {
        ++inner;
        return true;
      },
      0.0);
    Pulse::Beat();
    const Pulse rare([&]() { return false; }, 3600.0);
    Pulse::Beat();
  }
  Check(outer == 0 && inner == 1, "the innermost pulse hears, and none before its time");
  Pulse::Beat();
  for (int step = 1; step <= 1024; ++step)
  {
    Pulse::Beat(step);
  }
  Check(outer == 2, "of many steps one is a beat");
  Check(IsStopped([]() { Pulse::Beat(); }) && outer == 3, "the pulse stops the work");
  Check(IsStopped([]() { Pulse::Beat(); }) && outer == 3, "it is not asked again");
  const Outcome outcome = LightTransport::Attempt(
    []()
    {
      Pulse::Beat();
      return Outcome::Done();
    },
    { "", "", "" });
  Check(outcome.IsAborted(), "the border makes an abort of it");
}

//------------------------------------------------------------------------------
// Of two parts one goes on for ever, on whichever thread.
void TestThreads()
{
  const std::thread::id here = std::this_thread::get_id();
  auto work = [here](vtkIdType, vtkIdType)
  {
    if (std::this_thread::get_id() == here)
    {
      throw std::runtime_error("no more");
    }
    for (;;)
    {
      Pulse::Beat();
    }
  };
  bool isThrown = false;
  try
  {
    LightTransport::Threads::For(0, 16, 1, work);
  }
  catch (const std::runtime_error&)
  {
    isThrown = true;
  }
  Check(isThrown, "other threads end where one has thrown");

  auto help = [here](vtkIdType, vtkIdType)
  {
    while (std::this_thread::get_id() != here)
    {
      Pulse::Beat();
    }
  };
  int heard = 0;
  const Pulse pulse([&]() { return ++heard < 4; }, 0.0);
  Check(IsStopped(
          [&]()
          {
            // Without a thread for it nothing would go on for ever.
            LightTransport::Threads::For(0, 2, 1, help);
            for (;;)
            {
              Pulse::Beat();
            }
          }),
    "the thread that called hears an abort while it waits for others");
}

//------------------------------------------------------------------------------
/// Runs of a filter, and what is heard of them.
template <typename Filter>
class Runs
{
public:
  /// The filter has the properties that `setUp` gives it.
  Runs(std::function<void(Filter*)> setUp, const char* array, std::string name)
    : SetUp(std::move(setUp)), Array(array), Name(std::move(name))
  {
    this->Renew();
  }

  Filter* Get() const { return this->Current; }

  /// A run without an abort.
  const Listener& Run()
  {
    this->Update(0);
    vtkDataArray* array = this->GetOutput()->GetCellData()->GetArray(this->Array);
    Check(array && array->GetNumberOfTuples() > 0, this->Name + ": results");
    Check(std::is_sorted(this->Heard->Progress.begin(), this->Heard->Progress.end()),
      this->Name + ": progress goes forward");
    return *this->Heard;
  }

  /// Aborts at events all over a run, each of a filter that keeps nothing from another.
  void Abort()
  {
    const auto events = static_cast<int>(this->Run().Count(0.0, 1.0));
    Check(events > NumberOfAborts, this->Name + ": " + std::to_string(events) + " events");
    for (int number = 0; number <= NumberOfAborts; ++number)
    {
      const int event = 2 + (events - 2) * number / NumberOfAborts;
      const std::string what = this->Name + ", aborted at " + std::to_string(event) + " of " +
        std::to_string(events) + " events: ";
      this->Renew();
      this->Update(event);
      // The executive ends every run, this one too, with an event of its own.
      const auto after = static_cast<int>(this->Heard->Progress.size()) - event;
      Check(after == 0 || after == 1, what + std::to_string(after) + " more");
      Check(this->GetOutput()->GetNumberOfCells() == 0, what + "an empty output");
      this->Run();
      Check(this->Errors->GetAll().empty(), what + "no error");
    }
  }

private:
  static constexpr int NumberOfAborts = 6;

  void Renew()
  {
    this->Current = vtkSmartPointer<Attentive<Filter>>::New();
    this->SetUp(this->Current);
    this->Current->AddObserver(vtkCommand::ProgressEvent, this->Heard);
    this->Current->AddObserver(vtkCommand::ErrorEvent, this->Errors);
    this->Current->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Errors);
  }

  void Update(int abortAt)
  {
    this->Heard->AbortAt = abortAt;
    this->Heard->Progress.clear();
    this->Current->Modified();
    // One thread: the same events each time.
    vtkSMPTools::LocalScope(vtkSMPTools::Config(1, "STDThread", false),
      [this]() { this->Current->Update(); });
  }

  vtkPolyData* GetOutput() const
  {
    return vtkPolyData::SafeDownCast(this->Current->GetOutputDataObject(0));
  }

  std::function<void(Filter*)> SetUp;
  const char* Array;
  std::string Name;
  vtkSmartPointer<Filter> Current;
  vtkNew<Listener> Heard;
  vtkNew<MessageLog> Errors;
};

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeLitRoom(int n)
{
  auto room = MakeRoom(n);
  AddArray(room, "Reflectance", { 0.5 });
  AddArray(room, "Emission", { 0.0 })->SetValue(0, 1.0);
  AddArray(room, "Irradiance", { 1.0 });
  return room;
}

//------------------------------------------------------------------------------
void TestRadiosity()
{
  constexpr int side = 9;
  constexpr vtkIdType patches = 6 * side * side;
  constexpr vtkIdType tileRows =
    (patches + vtkExchangeMatrix::TileSize - 1) / vtkExchangeMatrix::TileSize;
  const auto room = MakeLitRoom(side);
  for (const int solver : { vtkRadiosity::SOLVER_CONJUGATE_GRADIENT,
         vtkRadiosity::SOLVER_GAUSS_SEIDEL, vtkRadiosity::SOLVER_SOUTHWELL })
  {
    const std::string name = "solver " + std::to_string(solver);
    Runs<vtkRadiosity> runs(
      [&](vtkRadiosity* radiosity)
      {
        radiosity->SetInputData(room);
        radiosity->SetSolver(solver);
        radiosity->SetTolerance(1e-3);
      },
      "Radiosity", name);
    runs.Abort();
    const long events = runs.Run().Count(0.8, 0.99);
    const vtkIdType iterations = runs.Get()->GetConvergence()->GetNumberOfRows() - 1;
    const vtkIdType beats = solver == vtkRadiosity::SOLVER_SOUTHWELL ? patches : tileRows;
    Check(iterations > 0 && events >= iterations * beats,
      name + ": " + std::to_string(events) + " events in " + std::to_string(iterations) +
        " iterations");
  }
}

//------------------------------------------------------------------------------
void TestHierarchy()
{
  const auto room = MakeLitRoom(6);
  Runs<vtkRadiosity>(
    [&](vtkRadiosity* radiosity)
    {
      radiosity->SetInputData(room);
      radiosity->SetLinkMethodToHierarchical();
      radiosity->SetSolverToSouthwell();
      radiosity->SetTolerance(1e-2);
    },
    "Radiosity", "hierarchy")
    .Abort();
}

//------------------------------------------------------------------------------
void TestViewFactors()
{
  const auto room = MakeLitRoom(7);
  Runs<vtkViewFactors>([&](vtkViewFactors* factors) { factors->SetInputData(room); },
    "ViewFactorSum", "view factors")
    .Abort();
}

//------------------------------------------------------------------------------
void TestScattering()
{
  const auto room = MakeLitRoom(7);
  Runs<vtkSubsurfaceScattering> runs(
    [&](vtkSubsurfaceScattering* scattering)
    {
      scattering->SetInputData(room);
      scattering->SetIncidenceToDiffuse();
      scattering->SetMillimetersPerUnit(10.0);
      scattering->SetDeviceToCPU();
    },
    "ScatteredIrradiance", "scattering");
  runs.Abort();
}

//------------------------------------------------------------------------------
void TestDirect()
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(0.5, 0.4, 0.9);
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(8 * 16);
  values->FillValue(0.5f);
  vtkNew<vtkImageData> sky;
  sky->SetDimensions(16, 8, 1);
  sky->GetPointData()->SetScalars(values);
  const auto room = MakeRoom(6);
  Runs<vtkDirectIrradiance>(
    [&](vtkDirectIrradiance* direct)
    {
      direct->SetInputData(room);
      direct->AddLight(light);
      direct->SetEnvironment(sky);
    },
    "DirectIrradiance", "direct irradiance")
    .Abort();
  Runs<vtkRadianceTransfer>([&](vtkRadianceTransfer* transfer) { transfer->SetInputData(room); },
    "RadianceTransfer", "radiance transfer")
    .Abort();
}
} // namespace

//------------------------------------------------------------------------------
int TestAborts(int, char*[])
{
  TestBeats();
  TestThreads();
  TestRadiosity();
  TestHierarchy();
  TestViewFactors();
  TestScattering();
  TestDirect();
  return Result();
}
