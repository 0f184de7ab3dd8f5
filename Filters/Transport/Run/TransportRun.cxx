// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Run/TransportRun.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkTransportAlgorithm.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
TransportRun::TransportRun(const RunPorts& ports)
  : Filter(ports.Filter), Input(ports.Input), Output(ports.Output), Table(ports.Table),
    AllRanks(ports.Filter->GetController()), Progress(ports.Filter, this->AllRanks)
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
  Outcome outcome = Outcome::Done();
  for (const auto step : { &TransportRun::Check, &TransportRun::Gather, &TransportRun::WarnOfScene,
         &TransportRun::Read, &TransportRun::Link, &TransportRun::Compute, &TransportRun::Finish })
  {
    outcome =
      outcome ? this->AllRanks.Attempt([&]() { return (this->*step)(); }, GetAdvice()) : outcome;
  }
  return outcome;
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
  this->Write();
  if (this->Filter->GetProgress() < 1.0)
  {
    this->Filter->UpdateProgress(1.0);
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
  return this->Scene.Build(this->Input, this->AllRanks, PatchScene::Order::Spatial,
    this->NumberOfSides);
}

//------------------------------------------------------------------------------
Outcome TransportRun::GatherForClusters(int clusterTree)
{
  const bool usesAtlas = clusterTree == vtkTransportAlgorithm::CLUSTER_TREE_ATLAS ||
    (clusterTree == vtkTransportAlgorithm::CLUSTER_TREE_AUTO &&
      PolygonGathering::HasAtlas(this->Input, this->AllRanks));
  return this->Scene.Build(this->Input, this->AllRanks,
    usesAtlas ? PatchScene::Order::Atlas : PatchScene::Order::Spatial, this->NumberOfSides);
}

//------------------------------------------------------------------------------
void TransportRun::Warn(const std::string& text) const
{
  vtkWarningWithObjectMacro(this->Filter, << text);
}

//------------------------------------------------------------------------------
std::string TransportRun::GetArrayName(int index, const char* defaultName) const
{
  const char* name =
    this->Filter->GetInputArrayInformation(index)->Get(vtkDataObject::FIELD_NAME());
  return name && *name ? name : defaultName;
}

//------------------------------------------------------------------------------
vtkFieldData* TransportRun::GetOutputFields() const
{
  return this->Output->GetFieldData();
}
} // namespace LightTransport
