// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiosity.h"

#include "Links/LinkOperators.h"
#include "Radiosity/Brightness.h"
#include "Radiosity/ConvergenceTable.h"
#include "Radiosity/LinkMethodChoice.h"
#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/RadiosityMaterials.h"
#include "Radiosity/RadiositySolver.h"
#include "Radiosity/ShotPatches.h"
#include "Radiosity/SolutionErrors.h"
#include "Radiosity/SolverSettings.h"
#include "Radiosity/SolverTable.h"
#include "Radiosity/ThermalDoubts.h"
#include "Run/TransportRun.h"
#include "Scene/CellArrays.h"
#include "Scene/SceneOutput.h"
#include "Scene/SmoothPoints.h"
#include "Shared/AbortCheck.h"
#include "Shared/ArrayNames.h"
#include "Shared/FieldValues.h"
#include "Shared/TransportMemory.h"
#include "ViewFactors/CheckedErrors.h"
#include "ViewFactors/CheckedRows.h"
#include "ViewFactors/EnclosureVerdict.h"
#include "ViewFactors/HierarchicalViewFactors.h"
#include "ViewFactors/RayErrors.h"
#include "ViewFactors/RayHits.h"
#include "ViewFactors/SamplingPlan.h"
#include "ViewFactors/ViewFactorStore.h"
#include "vtkCPULinkOperator.h"
#include "vtkDataObject.h"
#include "vtkDeviceShooter.h"
#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"
#include "vtkViewFactors.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

using namespace LightTransport;

vtkStandardNewMacro(vtkRadiosity);
vtkCxxSetObjectMacro(vtkRadiosity, ViewFactors, vtkViewFactors);

namespace
{
// How much coarser the links are that show where light is, and how coarse at most: enough for a
// solution to exist.
constexpr double CoarseLinks = 4.0;
constexpr double CoarsestLinks = 0.1;
// Ranges of tolerances that are asked for.
constexpr double LeastLinkTolerance = 1e-5;
constexpr double LeastViewFactorTolerance = 1e-12;
constexpr double MostViewFactorTolerance = 0.1;
// Errors of links between clusters beyond this many times what was asked for are warned of.
constexpr double TolerableExcess = 1.2;
// What rays and their errors may take of the free memory.
constexpr double MemoryForRays = 0.8;

// The stages of a run as fractions of its progress.
constexpr double CoarseDone = 0.3;
constexpr double CoarseSolved = 0.35;
constexpr double LinksDone = 0.8;
constexpr double SolverDone = 0.98;
// And of the search for errors.
constexpr double RowsChecked = 0.8;

//------------------------------------------------------------------------------
double GetElement(const std::vector<double>& values, int index)
{
  return index >= 0 && index < static_cast<int>(values.size()) ? values[index] : 0.0;
}

//------------------------------------------------------------------------------
void PrintValues(ostream& os, const std::vector<double>& values)
{
  for (const double value : values)
  {
    os << " " << value;
  }
  os << "\n";
}
} // namespace

/// Shots that others make.
struct vtkRadiosity::OwnShots
{
  ShotProblem* Problem = nullptr; ///< to be told
  bool UsesAmbient = false;       ///< where nothing has been shot yet
  const std::vector<double>* Irradiance = nullptr;
  vtkIdType NumberOfShots = 0;
};

//------------------------------------------------------------------------------
class vtkRadiosity::Run : public TransportRun
{
public:
  Run(vtkRadiosity* owner, const RunPorts& ports, OwnShots* ownShots = nullptr)
    : TransportRun(ports), Owner(owner), Others(ownShots)
  {
    this->NumberOfSides = owner->TwoSided ? 2 : 1;
  }

protected:
  NumberProperties::List ListNumbers() const override;
  Outcome Check() override;
  Outcome Gather() override;
  Outcome Read() override;
  Outcome Link() override;
  Outcome Compute() override;
  void Write() override;

private:
  LinkMethodChoice ChooseLinkMethod() const;
  Outcome DecideLinkMethod();
  bool IsHierarchical() const
  {
    return this->Choice.Get() == LightTransport::LinkMethod::Hierarchical;
  }
  Outcome CheckSolver() const;

  ///@{ What was asked for, or what Accuracy asks for.
  double GetLinkTolerance() const;
  double GetViewFactorTolerance() const;
  ///@}

  ViewFactorStore& GetStore() const;
  Outcome UpdateLinks(double linkTolerance, const SamplingPlan& plan, const Monitor& monitor);
  Outcome LinkByBrightness();
  Outcome LinkByRays();
  SamplingPlan BeginPlan() const;
  SamplingPlan ImprovePlan(const SamplingPlan& plan) const;

  RadiosityEquation DescribeEquation() const;
  RadiosityEquation DescribeLinks(RadiosityEquation equation) const;
  SolverSettings MakeSettings(int mostIterations, double begin, const Monitor& monitor);
  Outcome Solve(const Monitor& monitor);
  Outcome FindErrors(const Monitor& monitor);
  Outcome TellErrors(const Monitor& monitor);
  Outcome CheckRows(const Monitor& monitor);
  std::unique_ptr<LinkDoubts> MakeDoubts() const;
  void WarnOfLinkError();
  Outcome Shoot(const Monitor& monitor);
  Outcome CheckBackground() const;
  Outcome TakeShots();
  void AddDirectIrradiance();
  Outcome AddHint(const Outcome& solved) const;
  bool Finish();

  void WriteThermal(const std::vector<double>& flux, const SceneOutput& output);
  void WriteErrors(const SceneOutput& output) const;
  void WriteVerdict(const SceneOutput& output) const;
  void WriteSummaries() const;

  vtkRadiosity* Owner;
  OwnShots* Others;                    // null but where others shoot
  const SolverEntry* Solver = nullptr; // set by Check
  LinkMethodChoice Choice;             // begun by Check
  RadiosityMaterials Materials;
  const LightTransport::Links* Links = nullptr; // null where the solver needs none
  LightTransport::Links BrightLinks;            // serve this run's light alone
  vtkSmartPointer<vtkCPULinkOperator> Reference;
  RadiositySolution Solution;
  std::vector<double> Irradiance; // patches x bands
  std::vector<double> LastChange; // of the radiosity, after the product that gave it
  bool IsSolved = false;          // while linking
  bool LinksAreNew = false;       // made in this run
  SolutionErrors Errors;
  std::string DeviceUsed;
  std::string DeviceExplanation;
  double NetPower = 0.0; // of a thermal scene
  double SolverSeconds = 0.0;
  int Shots = 0; // of the solver that needs no links
};

//------------------------------------------------------------------------------
NumberProperties::List vtkRadiosity::Run::ListNumbers() const
{
  NumberProperties::List numbers = this->TransportRun::ListNumbers();
  numbers.emplace_back("Tolerance", this->Owner->Tolerance);
  numbers.emplace_back("LinkTolerance", this->Owner->LinkTolerance);
  numbers.emplace_back("Accuracy", this->Owner->Accuracy);
  numbers.emplace_back("ViewFactorTolerance", this->Owner->ViewFactorTolerance);
  numbers.emplace_back("BackgroundTemperature", this->Owner->BackgroundTemperature);
  if (vtkViewFactors* given = this->Owner->ViewFactors)
  {
    numbers.emplace_back("Tolerance of the given view factors", given->GetTolerance());
    numbers.emplace_back("LinkTolerance of the given view factors", given->GetLinkTolerance());
  }
  return numbers;
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::Check()
{
  this->Solver = this->Others ? SolverTable::Find(SOLVER_SOUTHWELL, DEVICE_OPENGL)
                              : SolverTable::Find(this->Owner->Solver, this->Owner->Device);
  if (!this->Solver)
  {
    return Outcome::Failed(SolverTable::ExplainUnknown(this->Owner->Solver));
  }
  const vtkViewFactors* given = this->Solver->NeedsLinks() ? this->Owner->ViewFactors : nullptr;
  this->Choice = this->ChooseLinkMethod();
  const LightTransport::LinkMethod linked = this->Choice.Get();
  if (given && this->Owner->LinkMethod != LINK_METHOD_AUTO &&
    static_cast<LightTransport::LinkMethod>(this->Owner->LinkMethod) != linked)
  {
    const std::string& file = given->Store->GetLoadedFile();
    return Outcome::Failed(
      "LinkMethod is not what the given view factors are: set it to Auto, or " +
      (file.empty() ? std::string("LinkMethod of vtkViewFactors to ") +
            LinkMethodChoice::GetName(
              static_cast<LightTransport::LinkMethod>(this->Owner->LinkMethod)) +
            "."
                    : "compute others (Load(nullptr)): those of \"" + file + "\" are " +
            LinkMethodChoice::GetName(linked) + "."));
  }
  if (given && given->TwoSided != this->Owner->TwoSided)
  {
    return Outcome::Failed(std::string("The given view factors are those of ") +
      (given->TwoSided ? "both sides" : "one side") +
      " of each polygon: switch TwoSided of vtkViewFactors and vtkRadiosity both on, or both off.");
  }
  if (this->Solver->NeedsEachPair() && linked != LightTransport::LinkMethod::Dense)
  {
    return Outcome::Failed(std::string(this->Solver->Name) +
      " needs a link for each pair of patches: set LinkMethod to Dense, or "
      "use ConjugateGradient, Chebyshev, Jacobi or Southwell.");
  }
  return this->CheckSolver();
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::CheckSolver() const
{
  if (!this->Solver->NeedsOneCPU())
  {
    return LinkOperators::CheckDevice(static_cast<LinkDevice>(this->Owner->Device), this->AllRanks);
  }
  if (this->Owner->Device == DEVICE_OPENGL || this->AllRanks.AreSeveral())
  {
    return Outcome::Failed(std::string(this->Solver->Name) +
      " goes from patch to patch and runs on the CPU of one process: set Device to Auto or CPU on "
      "one process, or use Jacobi, Chebyshev or ConjugateGradient.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// The number of patches decides how they are linked, which decides on their order.
Outcome vtkRadiosity::Run::Gather()
{
  Outcome gathered = this->TransportRun::Gather();
  if (gathered && this->Solver->NeedsLinks() && this->IsHierarchical())
  {
    const vtkViewFactors* given = this->Owner->ViewFactors;
    gathered = this->GatherForClusters(given ? given->ClusterTree : this->Owner->ClusterTree);
  }
  return gathered;
}

//------------------------------------------------------------------------------
LinkMethodChoice vtkRadiosity::Run::ChooseLinkMethod() const
{
  LinkMethodChoice::Wishes wishes;
  if (vtkViewFactors* given = this->Solver->NeedsLinks() ? this->Owner->ViewFactors : nullptr)
  {
    wishes.AreGiven = true;
    wishes.Given = given->Store->GetMethod(given->GetSettings());
  }
  wishes.Method = this->Owner->LinkMethod;
  wishes.PairSolver = this->Solver->NeedsEachPair() ? this->Solver->Name : nullptr;
  wishes.ViewFactorTolerance = this->Owner->ViewFactorTolerance;
  wishes.LinkTolerance = this->Owner->LinkTolerance;
  wishes.RefinesByBrightness = this->Owner->RefineByBrightness;
  wishes.UsesAtlas = this->Owner->ClusterTree == CLUSTER_TREE_ATLAS;
  return LinkMethodChoice(wishes);
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::DecideLinkMethod()
{
  Outcome decided =
    this->AllRanks.Agree(this->Choice.DecideByCost(this->Scene, this->Owner->Accuracy));
  this->WarnOnce(this->Choice.ListUnheeded());
  return decided;
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::Read()
{
  std::vector<std::string> names;
  for (int array = 0; array < MaterialArrays::NUMBER_OF_ARRAYS; ++array)
  {
    names.push_back(this->GetArrayName(array, MaterialArrays::GetDefaultName(array)));
  }
  this->Materials.Settings.BandLimits = this->Owner->BandLimits;
  this->Materials.Settings.BackgroundTemperature = this->Owner->BackgroundTemperature;
  this->Materials.Settings.BackgroundRadiance = this->Owner->BackgroundRadiances;
  const CellArrays arrays(this->Scene, this->Input, this->AllRanks);
  Outcome read = this->Materials.Read(arrays, this->Scene, names);
  for (const std::string& warning : this->Materials.Warnings)
  {
    this->Warn(warning);
  }
  return read;
}

//------------------------------------------------------------------------------
double vtkRadiosity::Run::GetLinkTolerance() const
{
  const double asked = this->Owner->LinkTolerance;
  return std::max(asked > 0.0 ? asked : this->Owner->Accuracy, LeastLinkTolerance);
}

//------------------------------------------------------------------------------
double vtkRadiosity::Run::GetViewFactorTolerance() const
{
  const double asked = this->Owner->ViewFactorTolerance;
  return asked > 0.0 ? std::max(asked, LeastViewFactorTolerance)
                     : std::min(this->Owner->Accuracy, MostViewFactorTolerance);
}

//------------------------------------------------------------------------------
// What enters through openings falls on the patches as the light of lamps does. Of it the first
// links tell all: those for the light that there is know no row sums.
Outcome vtkRadiosity::Run::Link()
{
  if (!this->Solver->NeedsLinks())
  {
    return Outcome::Done();
  }
  if (Outcome decided = this->DecideLinkMethod(); !decided)
  {
    return decided;
  }
  if (this->Choice.Get() == LightTransport::LinkMethod::Sampled && !this->Owner->ViewFactors &&
    this->Owner->LinkTolerance == 0.0)
  {
    return this->LinkByRays();
  }
  const bool isBright =
    this->Owner->RefineByBrightness && !this->Owner->ViewFactors && this->IsHierarchical();
  const double tolerance = this->GetLinkTolerance();
  const double coarse = std::max(std::min(CoarseLinks * tolerance, CoarsestLinks), tolerance);
  const bool isCoarse = isBright && !this->Materials.Settings.HasBackground();
  Outcome linked = this->UpdateLinks(isCoarse ? coarse : tolerance, {},
    this->Progress.GetMonitor().GetStage(0.0, isBright ? CoarseDone : LinksDone));
  if (linked && this->Materials.Settings.HasBackground())
  {
    this->Materials.AddBackground(this->Links->SkyFractions);
  }
  return linked && isBright ? this->LinkByBrightness() : linked;
}

//------------------------------------------------------------------------------
ViewFactorStore& vtkRadiosity::Run::GetStore() const
{
  vtkViewFactors* given = this->Owner->ViewFactors;
  return given ? *given->Store : *this->Owner->OwnViewFactors;
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::UpdateLinks(double linkTolerance, const SamplingPlan& plan,
  const Monitor& monitor)
{
  vtkViewFactors* given = this->Owner->ViewFactors;
  ViewFactorStore& store = this->GetStore();
  const bool needsAll =
    given || this->Owner->EnforceClosure || this->Materials.Settings.HasBackground();
  const ViewFactorSettings own{ this->GetViewFactorTolerance(), this->Owner->EnforceClosure,
    this->Choice.Get(), linkTolerance, plan };
  this->Links = &store.GetLinks();
  const Outcome updated = store.Update(this->Scene, given ? given->GetSettings() : own,
    needsAll ? std::vector<bool>() : this->Materials.FindSenders(), this->AllRanks, monitor);
  const bool wereMade = updated && store.WereMade();
  this->Owner->NumberOfLinkRuns += wereMade ? 1 : 0;
  this->LinksAreNew = this->LinksAreNew || wereMade;
  return updated;
}

//------------------------------------------------------------------------------
// Few rays first, or what there is of this scene; from the solution with them, and how wrong it is,
// follows how many are enough, and which patches are worth exact rows.
Outcome vtkRadiosity::Run::LinkByRays()
{
  const std::vector<double> direct = this->Materials.DirectIrradiance;
  const auto rays = this->GetStore().ShareRays();
  SamplingPlan plan = this->GetStore().FindPlan(this->Scene, this->GetLinkTolerance(),
    this->BeginPlan(), this->AllRanks);
  double done = 0.0;
  for (;;)
  {
    const double end = 0.5 * (done + SolverDone);
    const Monitor stage = this->Progress.GetMonitor().GetStage(done, end);
    Outcome outcome =
      this->UpdateLinks(this->GetLinkTolerance(), plan, stage.GetStage(0.0, CoarseSolved));
    if (outcome && this->Materials.Settings.HasBackground())
    {
      this->Materials.DirectIrradiance = direct;
      this->Materials.AddBackground(this->Links->SkyFractions);
    }
    outcome = outcome ? this->Solve(stage.GetStage(CoarseSolved, LinksDone)) : outcome;
    outcome = outcome && !this->Finish() ? Outcome::FailedAsReported() : outcome;
    outcome = outcome ? this->FindErrors(stage.GetStage(LinksDone, 1.0)) : outcome;
    const SamplingPlan better = outcome ? this->ImprovePlan(plan) : plan;
    if (!outcome || better == plan)
    {
      this->IsSolved = static_cast<bool>(outcome);
      return outcome;
    }
    plan = better;
    done = end;
  }
}

//------------------------------------------------------------------------------
// As if all that is reflected came evenly; of what enters through openings nothing is known yet.
SamplingPlan vtkRadiosity::Run::BeginPlan() const
{
  const double accuracy = this->GetLinkTolerance();
  if (this->Materials.Settings.HasBackground())
  {
    return SamplingPlan::Begin(accuracy);
  }
  const std::vector<double>& areas = this->Scene.GetAreas();
  const RadiosityEquation equation = this->DescribeEquation();
  const std::vector<double> ambient = equation.FindAmbientIrradiance(areas);
  std::vector<double> radiosity = equation.Emission;
  for (std::size_t k = 0; k < radiosity.size(); ++k)
  {
    radiosity[k] += equation.Reflectance[k] * ambient[k % ambient.size()];
  }
  return SamplingPlan::Begin(accuracy, { areas, radiosity, this->Materials.Emission });
}

//------------------------------------------------------------------------------
// The same where the accuracy has been reached, or cannot be.
SamplingPlan vtkRadiosity::Run::ImprovePlan(const SamplingPlan& plan) const
{
  const double accuracy = this->Owner->Accuracy;
  if (this->Errors.Whole <= accuracy)
  {
    return plan;
  }
  const std::vector<double> nothing;
  SamplingPlan better =
    plan.Improve({ this->Scene.GetAreas(), this->Solution.Radiosity,
                   this->Materials.Settings.HasBackground() ? this->Materials.Background : nothing,
                   this->Links->SkyFractions, this->Errors.Whole },
      accuracy);
  const vtkIdType patches = this->Scene.GetNumberOfPatches();
  const double bytes = RayHits::GetEstimatedBytes(patches, better.Rays, this->AllRanks) +
    SolutionErrors::GetEstimatedBytes(patches, this->Materials.NumberOfBands);
  const bool fits = bytes <= MemoryForRays * TransportMemory::GetAvailableBytes();
  const bool doNotFit = this->AllRanks.GetLargest(fits ? 0 : 1) > 0;
  if (doNotFit || better == plan)
  {
    std::ostringstream text;
    text << "An Accuracy of " << accuracy << " was not reached: by its links B is known to "
         << this->Errors.Whole << ". "
         << (doNotFit ? "More rays do not fit into memory" : "No patch casts more rays")
         << ": raise Accuracy, or set LinkMethod to Dense.";
    this->WarnOnce({ text.str() });
    return plan;
  }
  return better;
}

//------------------------------------------------------------------------------
// A trial with the first links shows where light is; nothing of it is told to users.
Outcome vtkRadiosity::Run::LinkByBrightness()
{
  const Monitor monitor = this->Progress.GetMonitor();
  const Outcome solved = this->Solve(monitor.GetStage(CoarseDone, CoarseSolved));
  if (solved.IsAborted())
  {
    return solved;
  }
  const bool isKnown = solved && this->Finish();
  const Monitor second = monitor.GetStage(CoarseSolved, LinksDone);
  if (!isKnown)
  {
    return this->UpdateLinks(this->GetLinkTolerance(), {}, second);
  }
  const HierarchicalViewFactors builder(this->GetLinkTolerance(),
    Brightness::Find(this->Solution.Radiosity, this->Scene.GetAreas(), CoarseLinks),
    this->GetStore().GetLooks());
  this->BrightLinks.Fingerprint = this->Scene.GetFingerprint();
  ++this->Owner->NumberOfLinkRuns;
  this->Links = &this->BrightLinks;
  return builder.Build(this->Scene, this->AllRanks, second, this->BrightLinks);
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::Compute()
{
  if (this->Others)
  {
    return this->TakeShots();
  }
  const Monitor monitor = this->Progress.GetMonitor();
  Outcome solved = Outcome::Done();
  if (!this->IsSolved)
  {
    solved = this->Solver->NeedsLinks() ? this->Solve(monitor.GetStage(LinksDone, SolverDone))
                                        : this->Shoot(monitor.GetStage(0.0, SolverDone));
  }
  if (solved && !this->Solution.Warning.empty())
  {
    this->Warn(this->Solution.Warning);
  }
  if (!solved || !this->Links || this->IsSolved)
  {
    return solved;
  }
  solved = this->Finish() ? solved : Outcome::FailedAsReported();
  return solved ? this->TellErrors(monitor.GetStage(SolverDone, 1.0)) : solved;
}

//------------------------------------------------------------------------------
// Where nobody has asked for errors no solution is given up for want of memory for them. Rows are
// checked in the order of space. Of a matrix that is kept, or given, errors take longer than the
// solution.
Outcome vtkRadiosity::Run::TellErrors(const Monitor& monitor)
{
  const bool isSampled = this->Links->IsSampled();
  const bool isCheap = isSampled || this->IsHierarchical() || this->LinksAreNew;
  if ((!isSampled && this->Scene.GetOrder() != PatchScene::Order::Spatial) ||
    (!isCheap && !this->Owner->ComputeErrors))
  {
    return Outcome::Done();
  }
  const Outcome found = this->FindErrors(monitor);
  if (found && this->IsHierarchical())
  {
    this->WarnOfLinkError();
  }
  const bool areNeeded = isSampled || this->Owner->ComputeErrors;
  return found.HasFailed() && !areNeeded ? Outcome::Done() : found;
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::Solve(const Monitor& monitor)
{
  const double begin = vtkTimerLog::GetUniversalTime();
  vtkExchange* exchange = this->Links->GetExchange();
  const LinkDevice device =
    this->Solver->NeedsOneCPU() ? LinkDevice::CPU : static_cast<LinkDevice>(this->Owner->Device);
  vtkSmartPointer<vtkLinkOperator> links;
  Outcome made = LinkOperators::Make(device, exchange, this->Materials.NumberOfBands,
    this->AllRanks, links, this->DeviceExplanation);
  if (!made)
  {
    return made;
  }
  this->Reference =
    LinkOperators::MakeOnCPU(exchange, this->Materials.NumberOfBands, this->AllRanks);
  if (!this->Reference)
  {
    return Outcome::FailedAsReported();
  }
  RadiosityEquation equation = this->DescribeLinks(this->DescribeEquation());
  equation.Operator = links;
  equation.Reference = this->Reference;
  const SolverSettings settings =
    this->MakeSettings(this->Owner->MaximumNumberOfIterations, begin, monitor);

  const Outcome solved = RadiositySolver::Solve(equation, settings, this->Solution);
  this->DeviceUsed = links->GetDeviceName();
  this->SolverSeconds = vtkTimerLog::GetUniversalTime() - begin;
  return this->AddHint(solved);
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::FindErrors(const Monitor& monitor)
{
  const double bytes = SolutionErrors::GetEstimatedBytes(this->Scene.GetNumberOfPatches(),
    this->Materials.NumberOfBands);
  const double available = TransportMemory::GetAvailableBytes();
  const Outcome fits = this->AllRanks.Agree(bytes <= available
      ? Outcome::Done()
      : Outcome::Failed("The errors of a solution need " + TransportMemory::Format(bytes) +
          " of memory and " + TransportMemory::Format(available) +
          " are free: use fewer patches or bands."));
  if (!fits)
  {
    return fits;
  }
  auto links = LinkOperators::MakeOnCPU(this->Links->GetExchange(),
    this->Materials.NumberOfBands * SolutionErrors::GetNumberOfVectors(), this->AllRanks);
  if (!links)
  {
    return Outcome::FailedAsReported();
  }
  if (Outcome checked = this->CheckRows(monitor.GetStage(0.0, RowsChecked)); !checked)
  {
    return checked;
  }
  RadiosityEquation equation = this->DescribeLinks(this->DescribeEquation());
  equation.Reference = this->Reference;
  const std::vector<double> nothing;
  const std::unique_ptr<LinkDoubts> doubts = this->MakeDoubts();
  return this->Errors.Find(*doubts, equation, links, this->Solution.Radiosity, this->Irradiance,
    this->LastChange,
    this->Materials.Settings.HasBackground() ? this->Materials.Background : nothing,
    monitor.GetStage(RowsChecked, 1.0));
}

//------------------------------------------------------------------------------
// Rays know their own errors; other links are compared with more exact rows.
std::unique_ptr<LinkDoubts> vtkRadiosity::Run::MakeDoubts() const
{
  if (this->Links->IsSampled())
  {
    return std::make_unique<RayErrors>(this->Scene, this->GetStore().GetHits(), *this->Links,
      this->AllRanks);
  }
  return std::make_unique<CheckedErrors>(this->Scene, this->GetStore().GetCheckedRows(),
    *this->Links, this->AllRanks);
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::CheckRows(const Monitor& monitor)
{
  return this->Links->IsSampled()
    ? Outcome::Done()
    : this->GetStore().GetCheckedRows().Provide(this->Scene, *this->Links, this->Solution.Radiosity,
        this->AllRanks, monitor);
}

//------------------------------------------------------------------------------
// What decides on links between clusters is even light, or that of a coarse solution.
void vtkRadiosity::Run::WarnOfLinkError()
{
  const double tolerance = this->Links->Tolerance;
  if (this->Errors.Whole > TolerableExcess * tolerance)
  {
    std::ostringstream text;
    text << "A LinkTolerance of " << tolerance
         << " was not reached in this light: links between clusters leave B off by "
         << this->Errors.Whole << ". Set LinkMethod to Auto"
         << (this->Owner->RefineByBrightness ? "" : ", switch RefineByBrightness on")
         << ", or lower LinkTolerance.";
    this->WarnOnce({ text.str() });
  }
}

//------------------------------------------------------------------------------
// The other way to solve: an iteration is a shot here, and shots bring the irradiance.
Outcome vtkRadiosity::Run::Shoot(const Monitor& monitor)
{
  const double begin = vtkTimerLog::GetUniversalTime();
  auto shooter = vtkSmartPointer<vtkDeviceShooter>::Take(vtkDeviceShooter::New());
  std::string reason = "no loaded module shoots on it.";
  if (!shooter || !shooter->Open(reason))
  {
    return Outcome::Failed("Device is OpenGL, but " + reason + " Or set Device to Auto or CPU.");
  }
  if (Outcome checked = this->CheckBackground(); !checked)
  {
    return checked;
  }
  const RadiosityEquation equation = this->DescribeEquation();
  const vtkIdType patches = equation.NumberOfPatches;
  const vtkIdType mostShots =
    std::min<vtkIdType>(VTK_INT_MAX, patches * this->Owner->MaximumNumberOfIterations);
  const SolverSettings settings = this->MakeSettings(static_cast<int>(mostShots), begin, monitor);

  const Outcome solved =
    this->Solver->Shoot(shooter, this->Scene, equation, settings, this->Solution);
  this->Shots = this->Solution.NumberOfIterations;
  this->Solution.NumberOfIterations = static_cast<int>((this->Shots + patches - 1) / patches);
  this->DeviceUsed = shooter->GetDeviceName();
  this->DeviceExplanation = "OpenGL: asked for";
  this->SolverSeconds = vtkTimerLog::GetUniversalTime() - begin;
  this->AddDirectIrradiance();
  return this->AddHint(solved);
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::CheckBackground() const
{
  return this->Materials.Settings.HasBackground()
    ? Outcome::Failed("Southwell on OpenGL computes no sky fractions, which a background needs: "
                      "set Device to Auto or CPU, or use another solver.")
    : Outcome::Done();
}

//------------------------------------------------------------------------------
// To what shots have brought.
void vtkRadiosity::Run::AddDirectIrradiance()
{
  this->Irradiance = this->Solution.Irradiance;
  std::transform(this->Irradiance.begin(), this->Irradiance.end(),
    this->Materials.DirectIrradiance.begin(), this->Irradiance.begin(), std::plus<double>());
}

//------------------------------------------------------------------------------
// What others have shot, or are to shoot.
Outcome vtkRadiosity::Run::TakeShots()
{
  if (Outcome checked = this->CheckBackground(); !checked)
  {
    return checked;
  }
  const RadiosityEquation equation = this->DescribeEquation();
  const std::vector<double> ambient = equation.FindAmbientIrradiance(this->Scene.GetAreas());
  const std::size_t size = equation.Emission.size();
  std::vector<double>& irradiance = this->Solution.Irradiance;
  irradiance.assign(size, 0.0);
  for (std::size_t k = 0; k < size && this->Others->UsesAmbient; ++k)
  {
    irradiance[k] = ambient[k % ambient.size()];
  }
  if (this->Others->Irradiance)
  {
    if (this->Others->Irradiance->size() != size)
    {
      return Outcome::Failed("The irradiance of shots is that of another scene: shoot again.");
    }
    irradiance = *this->Others->Irradiance;
  }
  this->Solution.Solver = SOLVER_SOUTHWELL;
  this->Solution.Explanation = "Southwell: by others";
  this->Solution.Status = SolverStatus::IterationsUsedUp;
  this->Solution.Radiosity = equation.Emission;
  for (std::size_t k = 0; k < size; ++k)
  {
    this->Solution.Radiosity[k] += equation.Reflectance[k] * irradiance[k];
  }
  this->Shots = static_cast<int>(this->Others->NumberOfShots);
  this->AddDirectIrradiance();
  if (ShotProblem* problem = this->Others->Problem)
  {
    problem->Patches = DescribePatches(this->Scene);
    problem->NumberOfBands = equation.NumberOfBands;
    problem->Source = equation.Emission;
    problem->Reflectance = equation.Reflectance;
    problem->Ambient = ambient;
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// What the equation is, whatever solves it.
RadiosityEquation vtkRadiosity::Run::DescribeEquation() const
{
  const RadiosityMaterials& materials = this->Materials;
  RadiosityEquation equation;
  equation.NumberOfBands = materials.NumberOfBands;
  equation.Reflectance = materials.Reflectance;
  equation.Emission = materials.Emission;
  for (std::size_t k = 0; k < equation.Emission.size(); ++k)
  {
    equation.Emission[k] += materials.Reflectance[k] * materials.DirectIrradiance[k];
  }
  equation.NumberOfPatches =
    static_cast<vtkIdType>(equation.Emission.size()) / equation.NumberOfBands;
  return equation;
}

//------------------------------------------------------------------------------
// With what is known of the links that it is solved with.
RadiosityEquation vtkRadiosity::Run::DescribeLinks(RadiosityEquation equation) const
{
  equation.Areas = &this->Links->GetExchange()->GetAreas();
  equation.RowSums = &this->Links->RowSums;
  equation.RowSumErrors = this->Links->GetRowSumErrors();
  equation.GetPolygon = [this](vtkIdType patch) { return this->Scene.GetPolygon(patch); };
  return equation;
}

//------------------------------------------------------------------------------
// One row of the table per iteration; progress is by the residual, or the iterations that are left.
SolverSettings vtkRadiosity::Run::MakeSettings(int mostIterations, double begin,
  const Monitor& monitor)
{
  SolverSettings settings;
  settings.Solver = this->Owner->Solver;
  settings.Tolerance = this->Owner->Tolerance;
  settings.MaximumNumberOfIterations = mostIterations;
  ConvergenceTable table(this->Table, begin);
  settings.Report = [table, tolerance = settings.Tolerance, most = double(mostIterations),
                      monitor](int iteration, double residual, double bound) mutable
  {
    const double byResidual = table.Add(iteration, residual, bound, tolerance);
    return monitor.Report(std::max(byResidual, iteration / most));
  };
  return settings;
}

//------------------------------------------------------------------------------
Outcome vtkRadiosity::Run::AddHint(const Outcome& solved) const
{
  return solved.HasFailed() && this->Materials.HasGivenFluxes()
    ? Outcome::Failed(solved.GetMessage() +
        " A patch with a given net flux counts as one that reflects everything: each closed part "
        "of the scene needs a patch with a given temperature.")
    : solved;
}

//------------------------------------------------------------------------------
// The irradiance of the solution, in double precision; B = E + rho H then holds exactly between the
// output arrays. False after an error of the links, which has been reported.
bool vtkRadiosity::Run::Finish()
{
  std::vector<double>& radiosity = this->Solution.Radiosity;
  this->Irradiance.resize(radiosity.size());
  this->LastChange.resize(radiosity.size());
  if (!this->Reference->SetVector(0, radiosity.data()) || !this->Reference->Multiply(1, 0) ||
    !this->Reference->GetVector(1, this->Irradiance.data()))
  {
    return false;
  }
  const std::vector<double>& areas = this->Links->GetExchange()->GetAreas();
  for (std::size_t k = 0; k < this->Irradiance.size(); ++k)
  {
    double& irradiance = this->Irradiance[k];
    irradiance =
      irradiance / areas[k / this->Materials.NumberOfBands] + this->Materials.DirectIrradiance[k];
    const double before = radiosity[k];
    radiosity[k] = this->Materials.Emission[k] + this->Materials.Reflectance[k] * irradiance;
    this->LastChange[k] = radiosity[k] - before;
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkRadiosity::Run::Write()
{
  const int bands = this->Materials.NumberOfBands;
  const SmoothPoints points(this->Scene, this->Owner->FeatureAngle,
    this->Materials.GetPointMaterials(), 2 * bands);
  const SceneOutput output(this->Scene, &points, this->Input, this->Output);
  const std::vector<double>& radiosity = this->Solution.Radiosity;
  std::vector<double> flux = radiosity;
  std::transform(flux.begin(), flux.end(), this->Irradiance.begin(), flux.begin(),
    std::minus<double>());
  output.AddArray("Radiosity", radiosity, bands);
  output.AddArray(ArrayNames::Irradiance, this->Irradiance, bands);
  output.AddArray("NetFlux", flux, bands);
  if (this->Others)
  {
    output.AddGroups(ArrayNames::SmoothGroup);
    if (ShotProblem* problem = this->Others->Problem)
    {
      points.GetMembers(problem->Starts, problem->Members, problem->Parts);
    }
  }
  if (this->Materials.IsThermal())
  {
    this->WriteThermal(flux, output);
  }
  if (this->Owner->ComputeErrors)
  {
    this->WriteErrors(output);
  }
  this->WriteVerdict(output);
  this->WriteSummaries();
}

//------------------------------------------------------------------------------
void vtkRadiosity::Run::WriteErrors(const SceneOutput& output) const
{
  if (this->Errors.Whole < 0.0)
  {
    this->WarnOnce(
      { "Shots, and links over the quadtree of an atlas, know no standard errors: take "
        "a solver with links and the ClusterTree Spatial, or switch ComputeErrors "
        "off." });
    return;
  }
  const int bands = this->Materials.NumberOfBands;
  output.AddArray("RadiosityError", this->Errors.Radiosity, bands);
  output.AddArray("IrradianceError", this->Errors.Irradiance, bands);
  output.AddArray("NetFluxError", this->Errors.NetFlux, bands);
  if (this->Materials.IsThermal())
  {
    // How much warmer it is where that much more arrives.
    std::vector<double> more = this->Irradiance;
    std::transform(more.begin(), more.end(), this->Errors.Irradiance.begin(), more.begin(),
      std::plus<double>());
    vtkIdType impossible = 0;
    const auto compute = [&](const std::vector<double>& irradiance)
    {
      return this->Materials.ComputeTemperatures(this->Scene, irradiance, this->Solution.ErrorBound,
        impossible);
    };
    std::vector<double> errors = compute(more);
    const std::vector<double> temperatures = compute(this->Irradiance);
    std::transform(errors.begin(), errors.end(), temperatures.begin(), errors.begin(),
      std::minus<double>());
    output.AddFaceArray("SurfaceTemperatureError", errors, 1);
  }
}

//------------------------------------------------------------------------------
// What shots see is not known as openings.
void vtkRadiosity::Run::WriteVerdict(const SceneOutput& output) const
{
  if (!this->Links)
  {
    output.AddFlags(ArrayNames::SceneProblems, this->Scene.GetProblems());
    return;
  }
  const EnclosureVerdict verdict(this->Scene, *this->Links);
  output.AddFlags(ArrayNames::SceneProblems, verdict.GetProblems());
  verdict.AddTo(this->GetOutputFields());
  std::vector<std::string> warnings = verdict.GetWarnings();
  if (this->Materials.IsThermal())
  {
    ThermalDoubts::Add(this->Materials, this->Scene, verdict, this->NetPower, warnings);
  }
  this->WarnOnce(warnings);
}

//------------------------------------------------------------------------------
void vtkRadiosity::Run::WriteSummaries() const
{
  vtkFieldData* fields = this->GetOutputFields();
  const RadiositySolution& solution = this->Solution;
  FieldValues::Add(fields, "SolverUsed", std::string(SolverTable::GetName(solution.Solver)));
  FieldValues::Add(fields, "SolverExplanation", solution.Explanation);
  FieldValues::Add(fields, "SolverStatus", std::string(GetName(solution.Status)));
  FieldValues::Add(fields, "DeviceUsed", this->DeviceUsed);
  FieldValues::Add(fields, "DeviceExplanation", this->DeviceExplanation);
  FieldValues::Add(fields, "NumberOfIterations", solution.NumberOfIterations);
  FieldValues::Add(fields, "ErrorBound", solution.ErrorBound);
  FieldValues::Add(fields, "Converged", solution.HasConverged() ? 1.0 : 0.0);
  FieldValues::Add(fields, "SolverSeconds", this->SolverSeconds);
  if (this->Links)
  {
    FieldValues::Add(fields, "LinkMethodUsed",
      std::string(LinkMethodChoice::GetName(this->Choice.Get())));
    FieldValues::Add(fields, "LinkMethodExplanation", this->Choice.Explain());
    this->Links->AddSummaries(fields);
    if (this->Errors.Whole >= 0.0)
    {
      FieldValues::Add(fields, "AccuracyReached", this->Errors.Whole);
    }
    if (this->IsHierarchical() && this->Errors.Whole >= 0.0)
    {
      FieldValues::Add(fields, "LinkError", this->Errors.Whole);
    }
  }
  else
  {
    FieldValues::Add(fields, "NumberOfShots", this->Shots);
  }
}

//------------------------------------------------------------------------------
void vtkRadiosity::Run::WriteThermal(const std::vector<double>& flux, const SceneOutput& output)
{
  vtkIdType impossible = 0;
  const std::vector<double> temperatures = this->Materials.ComputeTemperatures(this->Scene,
    this->Irradiance, this->Solution.ErrorBound, impossible);
  if (impossible > 0)
  {
    this->Warn(std::to_string(impossible) +
      " patches have no temperature (SurfaceTemperature is 0 there): their given net flux takes "
      "out more than they absorb. Raise it, or give the patches around them a higher "
      "temperature.");
  }
  output.AddFaceArray("SurfaceTemperature", temperatures, 1);
  std::vector<double> totals(this->Scene.GetAreas().size(), 0.0);
  for (std::size_t k = 0; k < flux.size(); ++k)
  {
    totals[k / this->Materials.NumberOfBands] += flux[k];
  }
  if (this->Materials.NumberOfBands > 1)
  {
    output.AddArray("TotalNetFlux", totals, 1);
  }
  const std::vector<double>& areas = this->Scene.GetAreas();
  this->NetPower =
    this->GetAreaUnit() * std::inner_product(areas.begin(), areas.end(), totals.begin(), 0.0);
  FieldValues::Add(this->GetOutputFields(), "NetPower", this->NetPower);
}

//------------------------------------------------------------------------------
vtkRadiosity::vtkRadiosity() : OwnViewFactors(new ViewFactorStore)
{
  this->SetNumberOfOutputPorts(2);
  for (int array = 0; array < MaterialArrays::NUMBER_OF_ARRAYS; ++array)
  {
    this->SetInputArrayToProcess(array, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS,
      MaterialArrays::GetDefaultName(array));
  }
}

//------------------------------------------------------------------------------
vtkRadiosity::~vtkRadiosity()
{
  this->SetViewFactors(nullptr);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkRadiosity::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->ViewFactors ? std::max(own, this->ViewFactors->GetMTime()) : own;
}

//------------------------------------------------------------------------------
vtkTable* vtkRadiosity::GetConvergence()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
std::unique_ptr<TransportRun> vtkRadiosity::MakeRun(const RunPorts& ports)
{
  return std::make_unique<Run>(this, ports);
}

//------------------------------------------------------------------------------
void vtkRadiosity::CopyProperties(vtkRadiosity* source)
{
  if (!source || source == this)
  {
    return;
  }
  this->FeatureAngle = source->FeatureAngle;
  this->Solver = source->Solver;
  this->Tolerance = source->Tolerance;
  this->MaximumNumberOfIterations = source->MaximumNumberOfIterations;
  this->BandLimits = source->BandLimits;
  this->BackgroundTemperature = source->BackgroundTemperature;
  this->BackgroundRadiances = source->BackgroundRadiances;
  this->LinkMethod = source->LinkMethod;
  this->LinkTolerance = source->LinkTolerance;
  this->Accuracy = source->Accuracy;
  this->ComputeErrors = source->ComputeErrors;
  this->ClusterTree = source->ClusterTree;
  this->TwoSided = source->TwoSided;
  this->RefineByBrightness = source->RefineByBrightness;
  this->Device = source->Device;
  this->ViewFactorTolerance = source->ViewFactorTolerance;
  this->EnforceClosure = source->EnforceClosure;
  this->SetViewFactors(source->ViewFactors);
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkRadiosity::RunShots(vtkDataObject* scene, OwnShots& shots, vtkDataObject* output)
{
  if (!scene || !output)
  {
    vtkErrorMacro("There is no scene to shoot in, or no output to write to.");
    return false;
  }
  AbortCheck::Forget(this);
  RunPorts ports;
  ports.Filter = this;
  ports.Input = scene;
  ports.Output = output;
  ports.ProgressInterval = this->ProgressInterval;
  Outcome outcome = Outcome::Done();
  {
    Run run(this, ports, &shots);
    outcome = run.Go();
  }
  if (!outcome)
  {
    output->Initialize();
  }
  if (!outcome.GetMessage().empty())
  {
    vtkErrorMacro(<< outcome.GetMessage());
  }
  return static_cast<bool>(outcome);
}

//------------------------------------------------------------------------------
bool vtkRadiosity::PrepareShots(vtkDataObject* scene, bool ambient, ShotProblem& problem,
  vtkDataObject* output)
{
  OwnShots shots;
  shots.Problem = &problem;
  shots.UsesAmbient = ambient;
  return this->RunShots(scene, shots, output);
}

//------------------------------------------------------------------------------
bool vtkRadiosity::WriteShots(vtkDataObject* scene, const std::vector<double>& irradiance,
  vtkIdType numberOfShots, vtkDataObject* output)
{
  OwnShots shots;
  shots.Irradiance = &irradiance;
  shots.NumberOfShots = numberOfShots;
  return this->RunShots(scene, shots, output);
}

//------------------------------------------------------------------------------
void vtkRadiosity::AddBandLimit(double micrometers)
{
  this->BandLimits.push_back(micrometers);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRadiosity::ClearBandLimits()
{
  this->BandLimits.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
double vtkRadiosity::GetBandLimit(int index) const
{
  return GetElement(this->BandLimits, index);
}

//------------------------------------------------------------------------------
void vtkRadiosity::SetBackgroundRadiance(double radiance)
{
  this->BackgroundRadiances.assign(1, radiance);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRadiosity::AddBackgroundRadiance(double radiance)
{
  this->BackgroundRadiances.push_back(radiance);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRadiosity::ClearBackgroundRadiances()
{
  this->BackgroundRadiances.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
double vtkRadiosity::GetBackgroundRadiance(int band) const
{
  return GetElement(this->BackgroundRadiances, band);
}

//------------------------------------------------------------------------------
void vtkRadiosity::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Solver: " << SolverTable::GetName(this->Solver) << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  PrintValues(os << indent << "BandLimits:", this->BandLimits);
  os << indent << "BackgroundTemperature: " << this->BackgroundTemperature << "\n";
  PrintValues(os << indent << "BackgroundRadiance:", this->BackgroundRadiances);
  os << indent << "LinkMethod: " << this->LinkMethod << "\n";
  os << indent << "LinkTolerance: " << this->LinkTolerance << "\n";
  os << indent << "Accuracy: " << this->Accuracy << "\n";
  os << indent << "ComputeErrors: " << this->ComputeErrors << "\n";
  os << indent << "ClusterTree: " << this->ClusterTree << "\n";
  os << indent << "RefineByBrightness: " << this->RefineByBrightness << "\n";
  os << indent << "Device: " << this->Device << "\n";
  os << indent << "ViewFactorTolerance: " << this->ViewFactorTolerance << "\n";
  os << indent << "EnforceClosure: " << this->EnforceClosure << "\n";
  os << indent << "TwoSided: " << this->TwoSided << "\n";
  os << indent << "ViewFactors: " << this->ViewFactors << "\n";
}
