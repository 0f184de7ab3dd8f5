// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewFactors.h"

#include "Run/TransportRun.h"
#include "Scene/CellArrays.h"
#include "Scene/SceneOutput.h"
#include "Shared/ArrayNames.h"
#include "ViewFactors/EnclosureVerdict.h"
#include "ViewFactors/ViewFactorGroups.h"
#include "ViewFactors/ViewFactorStore.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

using namespace LightTransport;

vtkStandardNewMacro(vtkViewFactors);

namespace
{
// The links as a fraction of the progress.
constexpr double LinksDone = 0.98;
} // namespace

//------------------------------------------------------------------------------
class vtkViewFactors::Run : public TransportRun
{
public:
  Run(vtkViewFactors* owner, const RunPorts& ports) : TransportRun(ports), Owner(owner)
  {
    this->NumberOfSides = owner->TwoSided ? 2 : 1;
  }

protected:
  NumberProperties::List ListNumbers() const override
  {
    NumberProperties::List numbers = this->TransportRun::ListNumbers();
    numbers.emplace_back("Tolerance", this->Owner->Tolerance);
    numbers.emplace_back("LinkTolerance", this->Owner->LinkTolerance);
    return numbers;
  }

  Outcome Gather() override
  {
    return this->Owner->LinksClusters() ? this->GatherForClusters(this->Owner->ClusterTree)
                                        : this->TransportRun::Gather();
  }

  Outcome Read() override
  {
    return ViewFactorGroups::Gather(CellArrays(this->Scene, this->Input, this->AllRanks),
      this->Input, this->GetArrayName(0, "Group"), this->Groups);
  }

  Outcome Link() override
  {
    return this->Owner->Store->Update(this->Scene, this->Owner->GetSettings(), {}, this->AllRanks,
      this->Progress.GetMonitor().GetStage(0.0, LinksDone));
  }

  Outcome Compute() override
  {
    return ViewFactorGroups::FillTable(this->Owner->Store->GetLinks(), this->Groups,
      this->Scene.GetScale(), this->AllRanks, this->Table);
  }

  void Write() override
  {
    const Links& links = this->Owner->Store->GetLinks();
    const SceneOutput output(this->Scene, nullptr, this->Input, this->Output);
    output.AddArray("ViewFactorSum", links.RawRowSums, 1);
    output.AddArray("ViewFactorError", links.GetErrors(), 1);
    output.AddArray("SkyFraction", links.SkyFractions, 1);
    output.AddArray("BackFaceFraction", links.BackFaceFractions, 1);
    const EnclosureVerdict verdict(this->Scene, links);
    output.AddFlags(ArrayNames::SceneProblems, verdict.GetProblems());
    verdict.AddTo(this->GetOutputFields());
    links.AddSummaries(this->GetOutputFields());
    this->WarnOnce(verdict.GetWarnings());
  }

private:
  vtkViewFactors* Owner;
  ViewFactorGroups::Groups Groups;
};

//------------------------------------------------------------------------------
vtkViewFactors::vtkViewFactors() : Store(new ViewFactorStore)
{
  this->SetNumberOfOutputPorts(2);
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Group");
}

//------------------------------------------------------------------------------
vtkViewFactors::~vtkViewFactors() = default;

//------------------------------------------------------------------------------
std::unique_ptr<TransportRun> vtkViewFactors::MakeRun(const RunPorts& ports)
{
  return std::make_unique<Run>(this, ports);
}

//------------------------------------------------------------------------------
bool vtkViewFactors::LinksClusters() const
{
  return this->Store->GetMethod(this->GetSettings()) == LightTransport::LinkMethod::Hierarchical;
}

//------------------------------------------------------------------------------
ViewFactorSettings vtkViewFactors::GetSettings() const
{
  return { this->Tolerance, this->EnforceClosure,
    static_cast<LightTransport::LinkMethod>(this->LinkMethod), this->LinkTolerance };
}

//------------------------------------------------------------------------------
double vtkViewFactors::GetViewFactor(vtkIdType i, vtkIdType j)
{
  return this->Store->GetViewFactor(i, j);
}

//------------------------------------------------------------------------------
bool vtkViewFactors::GetViewFactors(vtkIdType i, vtkDoubleArray* rows)
{
  const vtkIdType count = this->Store->GetNumberOfFaces();
  if (!rows || rows->GetNumberOfComponents() != count || i < 0 ||
    i > count - rows->GetNumberOfTuples())
  {
    return false;
  }
  for (vtkIdType row = 0; row < rows->GetNumberOfTuples(); ++row)
  {
    this->Store->CopyRow(i + row, rows->GetPointer(row * count));
  }
  rows->Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkViewFactors::GetPatchAreas(vtkDoubleArray* areas)
{
  if (!areas || areas->GetNumberOfValues() != this->Store->GetNumberOfFaces())
  {
    return false;
  }
  double* area = areas->GetPointer(0);
  for (vtkIdType i = 0; i < areas->GetNumberOfValues(); ++i)
  {
    area[i] = this->Store->GetArea(i);
  }
  areas->Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkViewFactors::Save(const char* fileName)
{
  return this->Report(this->Store->Save(fileName ? fileName : "", Ranks(this->Controller)));
}

//------------------------------------------------------------------------------
bool vtkViewFactors::Load(const char* fileName)
{
  Outcome loaded = Outcome::Done();
  if (fileName && *fileName)
  {
    loaded = this->Store->Load(fileName, Ranks(this->Controller));
  }
  else
  {
    this->Store->Forget();
  }
  if (loaded)
  {
    this->Modified();
  }
  return this->Report(loaded);
}

//------------------------------------------------------------------------------
bool vtkViewFactors::Report(const Outcome& outcome)
{
  if (!outcome)
  {
    vtkErrorMacro(<< outcome.GetMessage());
  }
  return static_cast<bool>(outcome);
}

//------------------------------------------------------------------------------
vtkTable* vtkViewFactors::GetGroupTable()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
void vtkViewFactors::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "EnforceClosure: " << this->EnforceClosure << "\n";
  os << indent << "TwoSided: " << this->TwoSided << "\n";
  os << indent << "LinkMethod: " << this->LinkMethod << "\n";
  os << indent << "LinkTolerance: " << this->LinkTolerance << "\n";
  os << indent << "ClusterTree: " << this->ClusterTree << "\n";
  os << indent << "LoadedFile: " << this->Store->GetLoadedFile() << "\n";
  for (const auto& summary : this->Store->GetLinks().Summaries)
  {
    os << indent << summary.first << ": " << summary.second << "\n";
  }
}
