// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// One of three ranks fails alone: memory is refused to it, at any place, its arrays are bad, or its
// user aborts. All leave together, with an error that names it; ctest's limit of time tells of
// ranks that wait for each other.
#include "LightTransportTesting.h"
#include "MessageLog.h"
#include "RanksInThreads.h"
#include "Run/TransportRun.h"
#include "Shared/TransportMemory.h"
#include "Support/Ranks.h"

#include "vtkCallbackCommand.h"
#include "vtkCell.h"
#include "vtkDirectIrradiance.h"
#include "vtkExecutive.h"
#include "vtkLight.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkRadiosity.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkViewFactors.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace
{
constexpr int NumberOfRanks = 3;
constexpr int Failing = 1;
const std::string Place = "On rank 1 of 3: ";

/// Which of the pieces of memory that a thread asks for it does not get, while it is watched.
struct Refusal
{
  bool IsWanted = false;
  bool IsOn = false;
  long Asked = 0;
  long First = std::numeric_limits<long>::max();
  long Count = 0;

  bool IsRefused()
  {
    const bool isLate = this->IsOn && this->Asked >= this->First;
    const bool isRefused = isLate && this->Asked < this->First + this->Count;
    this->Asked += this->IsOn ? 1 : 0;
    return isRefused;
  }

  /// What is asked for before an output is written, by VTK, has been there.
  void Grant(std::size_t size)
  {
    const auto margin = static_cast<std::size_t>(LightTransport::TransportMemory::Margin);
    this->IsOn = this->IsOn && size != margin + 1;
  }
};
thread_local Refusal Refused;
} // namespace

//------------------------------------------------------------------------------
// All forms, so that what one took another may give back where an instrument has its own, too.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  const bool isRefused =
    !LightTransportTesting::ThreadCommunicator::IsCalled() && Refused.IsRefused();
  void* memory = isRefused ? nullptr : std::malloc(size > 0 ? size : 1);
  if (memory)
  {
    Refused.Grant(size);
  }
  return memory;
}

//------------------------------------------------------------------------------
void* operator new(std::size_t size)
{
  void* memory = operator new(size, std::nothrow);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

//------------------------------------------------------------------------------
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept
{
  return operator new(size, std::nothrow);
}

//------------------------------------------------------------------------------
void* operator new[](std::size_t size)
{
  return operator new(size);
}

//------------------------------------------------------------------------------
void operator delete(void* memory) noexcept
{
  std::free(memory);
}

//------------------------------------------------------------------------------
void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

//------------------------------------------------------------------------------
void operator delete[](void* memory) noexcept
{
  std::free(memory);
}

//------------------------------------------------------------------------------
void operator delete[](void* memory, std::size_t) noexcept
{
  std::free(memory);
}

namespace
{
using namespace LightTransport;
using namespace LightTransportTesting;

using Filter = vtkSmartPointer<vtkTransportAlgorithm>;

/// A filter, ready but for its input and controller.
struct Case
{
  std::string Name;
  std::function<Filter()> Make;
};

/// A filter whose own work is watched from its first piece of memory on: VTK's pipeline is not
/// tested.
template <typename Kind>
class Watched : public Kind
{
public:
  static Watched* New() { VTK_STANDARD_NEW_BODY(Watched); }

protected:
  Watched() = default;
  std::unique_ptr<TransportRun> MakeRun(const RunPorts& ports) override
  {
    Refused.IsOn = Refused.IsWanted;
    return Kind::MakeRun(ports);
  }
};

//------------------------------------------------------------------------------
std::array<Case, 5> GetCases()
{
  const auto makeRadiosity = [](int method)
  {
    auto filter = vtkSmartPointer<Watched<vtkRadiosity>>::New();
    filter->SetDevice(vtkRadiosity::DEVICE_CPU);
    filter->SetLinkMethod(method);
    return filter;
  };
  const auto makeLight = []()
  {
    auto filter = vtkSmartPointer<Watched<vtkDirectIrradiance>>::New();
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(0.5, 0.4, 0.3);
    light->SetPositional(1);
    filter->AddLight(light);
    return filter;
  };
  const auto makeScattering = []()
  {
    auto filter = vtkSmartPointer<Watched<vtkSubsurfaceScattering>>::New();
    filter->SetDevice(vtkSubsurfaceScattering::DEVICE_CPU);
    return filter;
  };
  return { { { "vtkDirectIrradiance", makeLight },
    { "vtkViewFactors", []() { return vtkSmartPointer<Watched<vtkViewFactors>>::New(); } },
    { "vtkRadiosity, dense", [=]() { return makeRadiosity(vtkRadiosity::LINK_METHOD_DENSE); } },
    { "vtkRadiosity, clusters",
      [=]() { return makeRadiosity(vtkRadiosity::LINK_METHOD_HIERARCHICAL); } },
    { "vtkSubsurfaceScattering", makeScattering } } };
}

//------------------------------------------------------------------------------
// A rank's part of a room with a lamp.
vtkSmartPointer<vtkPolyData> MakePart(int rank)
{
  auto room = MakeRoom(2);
  Surface part;
  for (vtkIdType cell = rank; cell < room->GetNumberOfCells(); cell += NumberOfRanks)
  {
    vtkPoints* points = room->GetCell(cell)->GetPoints();
    std::vector<Point> corners(points->GetNumberOfPoints());
    for (std::size_t corner = 0; corner < corners.size(); ++corner)
    {
      points->GetPoint(static_cast<vtkIdType>(corner), corners[corner].data());
    }
    part.AddPolygon(corners);
  }
  auto data = part.Get();
  AddArray(data, "Emission", { 0.0 })->SetValue(0, 1.0);
  AddArray(data, "Reflectance", { 0.5 });
  AddArray(data, "Irradiance", { 1.0 });
  return data;
}

/// What became of the ranks.
struct Results
{
  std::array<std::string, NumberOfRanks> Errors;
  std::array<vtkIdType, NumberOfRanks> Cells{};
  long Asked = 0; ///< pieces of memory by the failing rank
};

//------------------------------------------------------------------------------
// Run a filter on all ranks; `prepare` gets the filter of the one that is to fail, and its input.
Results Run(const Case& filterCase, const std::function<void(vtkAlgorithm*, vtkPolyData*)>& prepare)
{
  Results results;
  RunRanks(NumberOfRanks,
    [&](vtkMultiProcessController* controller, int rank)
    {
      vtkNew<MessageLog> errors;
      const Filter filter = filterCase.Make();
      auto part = MakePart(rank);
      filter->SetController(controller);
      filter->SetInputDataObject(part);
      filter->AddObserver(vtkCommand::ErrorEvent, errors);
      filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
      filter->AddObserver(vtkCommand::WarningEvent, vtkNew<MessageLog>());
      if (rank == Failing)
      {
        prepare(filter, part);
      }
      filter->Update();
      results.Errors[rank] = errors->GetAll();
      results.Cells[rank] =
        filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL);
      if (rank == Failing)
      {
        results.Asked = Refused.Asked;
      }
    });
  return results;
}

//------------------------------------------------------------------------------
// All have an error with these words, and no output.
void CheckErrors(const Results& results, const std::string& words, const std::string& what)
{
  for (int rank = 0; rank < NumberOfRanks; ++rank)
  {
    Check(results.Errors[rank].find(words) != std::string::npos && results.Cells[rank] == 0,
      what + " on rank " + std::to_string(rank) + ": " + results.Errors[rank]);
  }
}

//------------------------------------------------------------------------------
// Refuse one piece to a filter until its work is done, or has failed.
class Watch : public vtkCommand
{
public:
  static Watch* New() { return new Watch; }

  void Execute(vtkObject* filter, unsigned long event, void*) override
  {
    Refused.IsOn = Refused.IsOn && event == vtkCommand::ProgressEvent &&
      vtkAlgorithm::SafeDownCast(filter)->GetProgress() < 1.0;
  }

  static void Begin(vtkAlgorithm* filter, long first)
  {
    Refused = { true, false, 0, first, 1 };
    vtkNew<Watch> watch;
    for (const auto event : { vtkCommand::ProgressEvent, vtkCommand::ErrorEvent })
    {
      filter->AddObserver(event, watch);
    }
  }
};

//------------------------------------------------------------------------------
// Whether all have a whole output and say nothing.
bool AreDone(const Results& results)
{
  bool areDone = true;
  for (int rank = 0; rank < NumberOfRanks; ++rank)
  {
    areDone = areDone && results.Errors[rank].empty() && results.Cells[rank] > 0;
  }
  return areDone;
}

//------------------------------------------------------------------------------
// Each piece of memory that a filter asks for, some 30 of them, is refused to one rank. A few need
// not fail: how many it asks for depends on how its threads share the work, and a stream that
// cannot grow its text cuts it without a word.
void TestMemory(const Case& filterCase)
{
  const auto never = std::numeric_limits<long>::max();
  const Results whole =
    Run(filterCase, [=](vtkAlgorithm* filter, vtkPolyData*) { Watch::Begin(filter, never); });
  Check(whole.Errors[0].empty() && whole.Cells[0] > 0 && whole.Asked > 100,
    filterCase.Name + ": " + std::to_string(whole.Asked) + " pieces, " + whole.Errors[0]);
  const long step = std::max(whole.Asked / 30, 1L);
  int refused = 0;
  for (long first = 0; first < whole.Asked - step; first += step)
  {
    const Results results =
      Run(filterCase, [=](vtkAlgorithm* filter, vtkPolyData*) { Watch::Begin(filter, first); });
    if (AreDone(results))
    {
      continue;
    }
    ++refused;
    const std::string what = filterCase.Name + " without piece " + std::to_string(first);
    CheckErrors(results, Place, what);
    CheckErrors(results, "emory", what);
  }
  Check(refused >= 20, filterCase.Name + ": " + std::to_string(refused) + " refusals were told");
}

//------------------------------------------------------------------------------
void TestArrays(const Case& filterCase)
{
  const Results longer = Run(filterCase,
    [](vtkAlgorithm*, vtkPolyData* part)
    { AddArray(part, "Wrong", { 1.0 })->InsertNextValue(2.0); });
  CheckErrors(longer, Place + "In the input the cell array \"Wrong\" has", filterCase.Name);
  const Results infinite = Run(filterCase,
    [](vtkAlgorithm*, vtkPolyData* part)
    { part->GetPoints()->SetPoint(0, std::numeric_limits<double>::infinity(), 0.0, 0.0); });
  CheckErrors(infinite, Place, filterCase.Name);
}

//------------------------------------------------------------------------------
void TestAbort(const Case& filterCase)
{
  const Results results = Run(filterCase,
    [](vtkAlgorithm* filter, vtkPolyData*)
    {
      vtkNew<vtkCallbackCommand> abort;
      abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
        { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
      filter->AddObserver(vtkCommand::ProgressEvent, abort);
    });
  for (int rank = 0; rank < NumberOfRanks; ++rank)
  {
    Check(results.Errors[rank].empty() && results.Cells[rank] == 0,
      filterCase.Name + " aborted: " + results.Errors[rank]);
  }
}

//------------------------------------------------------------------------------
// A rank without any memory left can still tell the others, and those that have none take it in.
void TestNoMemoryAtAll()
{
  std::array<std::string, NumberOfRanks> messages;
  const Advice advice = { "use fewer", "It gave up", "try again" };
  RunRanks(NumberOfRanks,
    [&](vtkMultiProcessController* controller, int rank)
    {
      const Ranks ranks(controller);
      const auto step = [&]()
      {
        Refused = { true, rank == Failing, 0, 0, std::numeric_limits<long>::max() };
        std::vector<double> values(1000, 1.0);
        ranks.Sum(values);
        return Outcome::Done();
      };
      const Outcome outcome = ranks.Attempt(step, advice);
      Refused.IsOn = false;
      messages[rank] = outcome.GetMessage();
    });
  Check(messages[0] == Place + "Not enough memory: use fewer.", messages[0]);
  Check(messages[1] == "No memory left.", messages[1]);
  Check(messages[2] == messages[0], messages[2]);
}

//------------------------------------------------------------------------------
// What all say is told as it is; what a rank has reported itself others point to.
void TestAgreement()
{
  std::array<std::string, NumberOfRanks> same, reported;
  RunRanks(NumberOfRanks,
    [&](vtkMultiProcessController* controller, int rank)
    {
      const Ranks ranks(controller);
      same[rank] = ranks.Agree(Outcome::Failed("It is so.")).GetMessage();
      reported[rank] =
        ranks.Agree(rank == Failing ? Outcome::FailedAsReported() : Outcome::Done()).GetMessage();
    });
  for (int rank = 0; rank < NumberOfRanks; ++rank)
  {
    Check(same[rank] == "It is so.", same[rank]);
    Check(reported[rank] == (rank == Failing ? "" : Place + "see the messages of that rank."),
      reported[rank]);
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestFailingRank(int, char*[])
{
  TestNoMemoryAtAll();
  TestAgreement();
  for (const Case& filterCase : GetCases())
  {
    TestMemory(filterCase);
    TestArrays(filterCase);
    TestAbort(filterCase);
  }
  return Result();
}
