// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Run/TransportRun.h"

#include "Scene/Leaves.h"
#include "Shared/InputArrays.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Shared/TransportMemory.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkTransportAlgorithm.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace LightTransport
{
namespace
{
/// Calls of the progress function, at least, and rays at most between two of them, by which a user
/// who aborts does not wait. The same on all ranks.
constexpr double LeastBatches = 50.0;
constexpr double RaysOfBatch = 4e6;
} // namespace

//------------------------------------------------------------------------------
TransportRun::TransportRun(const RunPorts& ports)
  : Filter(ports.Filter), Input(ports.Input), Output(ports.Output), Table(ports.Table),
    AllRanks(ports.Filter->GetController()), Progress(ports.Filter, this->AllRanks),
    ProgressInterval(ports.ProgressInterval)
{
}

//------------------------------------------------------------------------------
TransportRun::~TransportRun() = default;

//------------------------------------------------------------------------------
const Advice& TransportRun::GetAdvice()
{
  static constexpr Advice advice = {
    "use fewer patches (a larger TargetEdgeLength in vtkPatchMesher), or more memory",
    "A library gave up", "try another mesh, and report this if it remains"
  };
  return advice;
}

//------------------------------------------------------------------------------
Outcome TransportRun::Go()
{
  const Pulse pulse([this]() { return this->Progress.Repeat(); }, this->ProgressInterval);
  Outcome outcome = Outcome::Done();
  for (const auto step : { &TransportRun::CheckNumbers, &TransportRun::Check, &TransportRun::Gather,
         &TransportRun::WarnOfScene, &TransportRun::Read, &TransportRun::Link,
         &TransportRun::Compute, &TransportRun::Finish })
  {
    if (outcome)
    {
      outcome = this->AllRanks.Attempt([&]() { return (this->*step)(); }, GetAdvice());
    }
  }
  return outcome;
}

//------------------------------------------------------------------------------
NumberProperties::List TransportRun::ListNumbers() const
{
  return { { "FeatureAngle", this->Filter->GetFeatureAngle() } };
}

//------------------------------------------------------------------------------
Outcome TransportRun::CheckNumbers()
{
  return NumberProperties::Check(this->ListNumbers());
}

//------------------------------------------------------------------------------
Outcome TransportRun::WarnOfScene()
{
  this->WarnOnce(this->Scene.GetWarnings());
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome TransportRun::Finish()
{
  TransportMemory::RequireMargin();
  this->Write();
  if (this->Filter->GetProgress() < 1.0)
  {
    this->Filter->UpdateProgress(1.0);
  }
  return this->CheckResults();
}

//------------------------------------------------------------------------------
// Products of numbers that are all right may be too large, and areas too small, for any number.
Outcome TransportRun::CheckResults() const
{
  const std::vector<vtkDataSet*> inputs = Leaves::Get(this->Input);
  const std::vector<vtkDataSet*> outputs = Leaves::Get(this->Output);
  for (std::size_t block = 0; block < outputs.size(); ++block)
  {
    vtkDataSetAttributes* results = Leaves::GetPatchData(outputs[block]);
    vtkDataSetAttributes* given = Leaves::GetPatchData(inputs[block]);
    for (int index = 0; index < results->GetNumberOfArrays(); ++index)
    {
      auto* array = vtkDoubleArray::SafeDownCast(results->GetAbstractArray(index));
      if (!array || given->GetAbstractArray(array->GetName()) == array)
      {
        continue;
      }
      const double* begin = array->GetPointer(0);
      if (!std::all_of(begin, begin + array->GetNumberOfValues(),
            [](double value) { return std::isfinite(value); }))
      {
        return Outcome::Failed(std::string("The result \"") + array->GetName() +
          "\" is not finite: coordinates, materials or lights are too large or too small to "
          "compute "
          "with. Use other units, such as MillimetersPerUnit, and look for values near 1e300.");
      }
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// What all ranks know one of them tells.
void TransportRun::WarnOnce(const std::vector<std::string>& warnings) const
{
  for (const std::string& warning : warnings)
  {
    if (this->AllRanks.GetMine() == 0)
    {
      this->Warn(warning);
    }
  }
}

//------------------------------------------------------------------------------
Outcome TransportRun::Gather()
{
  return this->GatherInOrder(PatchScene::Order::Spatial);
}

//------------------------------------------------------------------------------
Outcome TransportRun::GatherInOrder(PatchScene::Order order,
  std::shared_ptr<const PatchArrangement> kept)
{
  return this->Scene.Build(this->Input, this->AllRanks, order, this->NumberOfSides,
    this->TakesTexels, std::move(kept));
}

//------------------------------------------------------------------------------
Outcome TransportRun::GatherForClusters(int clusterTree)
{
  const bool usesAtlas = clusterTree == vtkTransportAlgorithm::CLUSTER_TREE_ATLAS ||
    (clusterTree == vtkTransportAlgorithm::CLUSTER_TREE_AUTO &&
      PolygonGathering::HasAtlas(this->Input, this->AllRanks));
  return this->GatherInOrder(usesAtlas ? PatchScene::Order::Atlas : PatchScene::Order::Spatial);
}

//------------------------------------------------------------------------------
Outcome TransportRun::ForLocalPatches(double rays, double done,
  const std::function<void(vtkIdType)>& compute, const std::function<void(vtkIdType)>& finish)
{
  const std::vector<vtkIdType> locals = this->Scene.GetLocalPatches();
  const auto count = static_cast<vtkIdType>(locals.size());
  const auto computeSome = [&locals, &compute](vtkIdType first, vtkIdType last)
  {
    for (vtkIdType local = first; local < last; ++local)
    {
      Pulse::Beat();
      compute(locals[local]);
    }
  };
  const Monitor monitor = this->Progress.GetMonitor().GetStage(0.0, done);
  const auto patches = static_cast<double>(this->Scene.GetAreas().size());
  const auto batches = static_cast<vtkIdType>(
    std::max(LeastBatches, std::min(patches, std::ceil(patches * rays / RaysOfBatch))));
  for (vtkIdType batch = 0; batch < batches; ++batch)
  {
    const vtkIdType first = count * batch / batches;
    const vtkIdType last = count * (batch + 1) / batches;
    Threads::For(first, last, std::min<vtkIdType>(16, 1 + (last - first) / 16), computeSome);
    if (finish)
    {
      std::for_each(locals.begin() + first, locals.begin() + last, finish);
    }
    if (!monitor.Report(static_cast<double>(batch + 1) / static_cast<double>(batches)))
    {
      return Outcome::Aborted();
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome TransportRun::CheckRefractiveIndex(double index)
{
  if (!(index >= 1.0) || !std::isfinite(index))
  {
    std::ostringstream text;
    text << "RefractiveIndex is " << index << ": it must be at least 1 (1 for an opaque surface).";
    return Outcome::Failed(text.str());
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void TransportRun::Warn(const std::string& text) const
{
  vtkWarningWithObjectMacro(this->Filter, << text);
}

//------------------------------------------------------------------------------
std::string TransportRun::GetArrayName(int index, const char* defaultName) const
{
  return InputArrays::GetChosenName(this->Filter, index, defaultName);
}

//------------------------------------------------------------------------------
vtkFieldData* TransportRun::GetOutputFields() const
{
  return this->Output->GetFieldData();
}
} // namespace LightTransport
