// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiosity.h"

#include "Radiosity/ProgressiveRadiosity.h"
#include "Radiosity/RadiosityMaterials.h"
#include "Radiosity/RadiositySolvers.h"
#include "Scene/PatchScene.h"
#include "vtkCPULinkOperator.h"
#include "vtkDataObject.h"
#include "vtkDeviceShooter.h"
#include "vtkDoubleArray.h"
#include "vtkExchangeMatrix.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"
#include "vtkViewFactors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace LightTransport;

vtkStandardNewMacro(vtkRadiosity);
vtkCxxSetObjectMacro(vtkRadiosity, ViewFactors, vtkViewFactors);

namespace
{
// What sums of view factors lose by rounding in double precision.
constexpr double DoublePrecision = 1e-14;

// More patches than this are linked by clusters unless asked for otherwise: a matrix takes about
// half a minute from here on.
constexpr vtkIdType MostDensePatches = 8192;
// How much coarser the links are that show where light is, and how coarse at most: enough for a
// solution to exist.
constexpr double CoarseLinks = 4.0;
constexpr double CoarsestLinks = 0.1;

// The stages of a run as fractions of its progress.
constexpr double CoarseDone = 0.3;
constexpr double CoarseSolved = 0.35;
constexpr double ViewFactorsDone = 0.8;
constexpr double SolverDone = 0.98;

//------------------------------------------------------------------------------
// The largest error of a row sum. A row that has been closed is as good as its sum.
double GetRowSumError(vtkViewFactors* viewFactors)
{
  const std::vector<double>& errors = viewFactors->GetRowErrors();
  const std::vector<double>& sums = viewFactors->GetRowSums();
  double largest = DoublePrecision;
  for (std::size_t row = 0; row < errors.size(); ++row)
  {
    const double gap = viewFactors->HasClosedRows() ? std::abs(1.0 - sums[row]) : errors[row];
    largest = std::max(largest, std::min(errors[row], gap));
  }
  return largest;
}

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

//------------------------------------------------------------------------------
struct vtkRadiosity::Problem
{
  RadiosityMaterials Materials;
  const std::vector<double>* Areas = nullptr; // in the exchange matrix's unit
  std::vector<double> Irradiance;             // patches x bands
  RadiositySolution Solution;
  std::string DeviceUsed;
  std::string DeviceExplanation;
  double SolverSeconds = 0.0;
  bool IsTrial = false; // only to know where light is: nothing to tell users
  int Shots = 0;        // of the solver that keeps no view factors
};

//------------------------------------------------------------------------------
vtkRadiosity::vtkRadiosity()
{
  this->SetNumberOfOutputPorts(2);
  for (int array = 0; array < RadiosityMaterials::NUMBER_OF_ARRAYS; ++array)
  {
    this->SetInputArrayToProcess(array, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS,
      RadiosityMaterials::GetDefaultName(array));
  }
  this->InternalViewFactors = vtkSmartPointer<vtkViewFactors>::New();
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
int vtkRadiosity::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  PatchScene scene;
  Problem problem;
  if (!this->CheckSolver() || !this->BuildScene(input, scene) ||
    !this->ReadMaterials(input, scene, problem))
  {
    return 0;
  }
  vtkTable* convergence = vtkTable::GetData(outputs, 1);
  vtkSmartPointer<vtkViewFactors> viewFactors;
  if (!(this->ShootsOnDevice() ? this->Shoot(scene, problem, convergence)
                               : this->LinkAndSolve(scene, viewFactors, problem, convergence)))
  {
    return 0;
  }
  this->Write(input, scene, problem, viewFactors, vtkDataObject::GetData(outputs, 0));
  this->UpdateProgress(1.0);
  return 1;
}

//------------------------------------------------------------------------------
// Southwell on OpenGL finds what patches see while it goes, and keeps no links.
bool vtkRadiosity::ShootsOnDevice() const
{
  return this->Solver == SOLVER_SOUTHWELL && this->Device == DEVICE_OPENGL;
}

//------------------------------------------------------------------------------
bool vtkRadiosity::CheckSolver()
{
  const bool given = this->ViewFactors && !this->ShootsOnDevice();
  const bool givenHierarchical = given && this->ViewFactors->LinksClusters();
  if (given && this->LinkMethod != LINK_METHOD_AUTO &&
    givenHierarchical != (this->LinkMethod == LINK_METHOD_HIERARCHICAL))
  {
    vtkErrorMacro("LinkMethod is not what the given view factors are: set it to Auto, or switch "
                  "Hierarchical of vtkViewFactors "
      << (givenHierarchical ? "off." : "on."));
    return false;
  }
  if (this->Solver == SOLVER_GAUSS_SEIDEL &&
    (givenHierarchical || this->LinkMethod == LINK_METHOD_HIERARCHICAL))
  {
    vtkErrorMacro("GaussSeidel needs a link for each pair of patches: set LinkMethod to Dense, or "
                  "use ConjugateGradient, Chebyshev, Jacobi or Southwell.");
    return false;
  }
  if (!RadiositySolvers::IsSequential(this->Solver) || this->ShootsOnDevice())
  {
    return this->CheckDevice(this->Device);
  }
  if (this->Device == DEVICE_OPENGL || this->GetNumberOfRanks() > 1)
  {
    vtkErrorMacro(<< RadiositySolvers::GetName(this->Solver)
                  << " goes from patch to patch and runs on the CPU of one process: set Device to "
                     "Auto or CPU on one process, or use Jacobi, Chebyshev or ConjugateGradient.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
// The number of patches decides how they are linked, which decides on their order.
bool vtkRadiosity::BuildScene(vtkDataObject* input, PatchScene& scene)
{
  std::string error;
  bool built = scene.Build(input, this->Controller, error);
  const int tree = this->ViewFactors ? this->ViewFactors->GetClusterTree() : this->ClusterTree;
  if (built && !this->ShootsOnDevice() && this->IsHierarchical(scene.GetNumberOfPatches()) &&
    this->UsesAtlas(input, tree))
  {
    built = scene.Build(input, this->Controller, error, PatchScene::Order::Atlas);
  }
  if (!built)
  {
    vtkErrorMacro(<< error);
  }
  return built;
}

//------------------------------------------------------------------------------
bool vtkRadiosity::ReadMaterials(vtkDataObject* input, const PatchScene& scene, Problem& problem)
{
  std::vector<std::string> names;
  for (int array = 0; array < RadiosityMaterials::NUMBER_OF_ARRAYS; ++array)
  {
    const char* name = this->GetInputArrayInformation(array)->Get(vtkDataObject::FIELD_NAME());
    names.emplace_back(name && *name ? name : RadiosityMaterials::GetDefaultName(array));
  }
  problem.Materials.BandLimits = this->BandLimits;
  problem.Materials.BackgroundTemperature = this->BackgroundTemperature;
  problem.Materials.BackgroundRadiance = this->BackgroundRadiances;
  std::string error;
  if (!problem.Materials.Read(input, scene, names, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadiosity::IsHierarchical(vtkIdType patches) const
{
  if (this->ViewFactors)
  {
    return this->ViewFactors->LinksClusters();
  }
  return this->LinkMethod == LINK_METHOD_HIERARCHICAL ||
    (this->LinkMethod == LINK_METHOD_AUTO && patches > MostDensePatches &&
      this->Solver != SOLVER_GAUSS_SEIDEL);
}

//------------------------------------------------------------------------------
bool vtkRadiosity::LinkAndSolve(const PatchScene& scene,
  vtkSmartPointer<vtkViewFactors>& viewFactors, Problem& problem, vtkTable* convergence)
{
  const bool isBright = this->RefineByBrightness && !this->ViewFactors &&
    this->IsHierarchical(scene.GetNumberOfPatches());
  this->SetProgressStage(0.0, isBright ? CoarseDone : ViewFactorsDone);
  // Of a background the first links tell all: those for the light that there is know no row sums.
  const bool isCoarse = isBright && !problem.Materials.HasBackground();
  const double coarse = std::min(CoarseLinks * this->LinkTolerance, CoarsestLinks);
  viewFactors = this->UpdateViewFactors(scene, problem,
    isCoarse ? std::max(coarse, this->LinkTolerance) : this->LinkTolerance);
  if (!viewFactors)
  {
    return false;
  }
  AddBackground(viewFactors, problem);
  if (!isBright)
  {
    this->SetProgressStage(ViewFactorsDone, SolverDone);
    return this->Solve(scene, viewFactors, problem, convergence);
  }
  this->SetProgressStage(CoarseDone, CoarseSolved);
  problem.IsTrial = true;
  const bool isBrightKnown = this->Solve(scene, viewFactors, problem, convergence);
  problem.IsTrial = false;
  if (problem.Solution.Status == RadiosityStatus::Aborted)
  {
    return false;
  }
  this->SetProgressStage(CoarseSolved, ViewFactorsDone);
  viewFactors = isBrightKnown ? this->UpdateBrightLinks(scene, problem)
                              : this->UpdateViewFactors(scene, problem, this->LinkTolerance);
  this->SetProgressStage(ViewFactorsDone, SolverDone);
  return viewFactors && this->Solve(scene, viewFactors, problem, convergence);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkViewFactors> vtkRadiosity::UpdateViewFactors(const PatchScene& scene,
  const Problem& problem, double linkTolerance)
{
  vtkSmartPointer<vtkViewFactors> viewFactors = this->ViewFactors;
  const std::vector<bool> senders = problem.Materials.FindSenders();
  const bool needsAll = viewFactors || this->EnforceClosure || problem.Materials.HasBackground();
  if (!viewFactors)
  {
    viewFactors = this->InternalViewFactors;
    viewFactors->SetController(this->Controller);
    viewFactors->SetTolerance(this->ViewFactorTolerance);
    const bool isHierarchical = this->IsHierarchical(scene.GetNumberOfPatches());
    viewFactors->SetEnforceClosure(this->EnforceClosure);
    viewFactors->SetHierarchical(isHierarchical);
    viewFactors->SetLinkTolerance(linkTolerance);
  }
  const auto progress = [this](double done) { return this->ReportProgress(done); };
  return viewFactors->UpdateExchange(scene, progress, needsAll ? nullptr : &senders) ? viewFactors
                                                                                     : nullptr;
}

//------------------------------------------------------------------------------
// In an object of their own: they serve this distribution of light alone.
vtkSmartPointer<vtkViewFactors> vtkRadiosity::UpdateBrightLinks(const PatchScene& scene,
  const Problem& problem)
{
  const int bands = problem.Materials.NumberOfBands;
  std::vector<double> brightness(scene.GetNumberOfPatches(), 0.0);
  for (std::size_t k = 0; k < problem.Solution.Radiosity.size(); ++k)
  {
    brightness[k / bands] =
      std::max(brightness[k / bands], std::abs(problem.Solution.Radiosity[k]));
  }
  // Nothing counts as so dark that row sums, which rows are closed by, are less well known than to
  // the coarse tolerance.
  const std::vector<double>& areas = scene.GetAreas();
  double squared = 0.0;
  for (std::size_t patch = 0; patch < areas.size(); ++patch)
  {
    squared += areas[patch] * brightness[patch] * brightness[patch];
  }
  const double darkest =
    std::sqrt(squared / std::accumulate(areas.begin(), areas.end(), 0.0)) / CoarseLinks;
  for (double& value : brightness)
  {
    value = std::max(value, darkest);
  }
  vtkNew<vtkViewFactors> viewFactors;
  viewFactors->SetController(this->Controller);
  viewFactors->HierarchicalOn();
  viewFactors->SetLinkTolerance(this->LinkTolerance);
  viewFactors->SetBrightness(brightness);
  const auto progress = [this](double done) { return this->ReportProgress(done); };
  return viewFactors->UpdateExchange(scene, progress) ? viewFactors.Get() : nullptr;
}

//------------------------------------------------------------------------------
// What enters through openings falls on the patches as the light of lamps does.
void vtkRadiosity::AddBackground(const vtkViewFactors* viewFactors, Problem& problem)
{
  if (problem.Materials.HasBackground())
  {
    problem.Materials.AddBackground(viewFactors->GetSkyFractions());
  }
}

//------------------------------------------------------------------------------
bool vtkRadiosity::Solve(const PatchScene& scene, vtkViewFactors* viewFactors, Problem& problem,
  vtkTable* convergence)
{
  const double begin = vtkTimerLog::GetUniversalTime();
  vtkExchange* exchange = viewFactors->GetExchange();
  const int device = RadiositySolvers::IsSequential(this->Solver) ? DEVICE_CPU : this->Device;
  auto links = this->MakeLinkOperator(device, exchange, problem.Materials.NumberOfBands,
    problem.DeviceExplanation);
  auto reference =
    links ? this->MakeCPULinkOperator(exchange, problem.Materials.NumberOfBands) : nullptr;
  if (!reference)
  {
    return false;
  }
  problem.Areas = &exchange->GetAreas();
  RadiosityProblem equation = this->DescribeEquation(problem);
  equation.Operator = links;
  equation.Reference = reference;
  equation.Areas = problem.Areas;
  equation.RowSums = &viewFactors->GetRowSums();
  equation.RowSumError = GetRowSumError(viewFactors);
  equation.GetPolygon = [&scene](vtkIdType patch) { return scene.GetPolygon(patch); };
  this->RecordConvergence(equation, convergence, begin);

  problem.Solution = RadiositySolvers::Solve(equation);
  problem.DeviceUsed = links->GetDeviceName();
  problem.SolverSeconds = vtkTimerLog::GetUniversalTime() - begin;
  return this->Finish(reference, problem);
}

//------------------------------------------------------------------------------
// The other way to solve: an iteration is a shot here, and shots bring the irradiance.
bool vtkRadiosity::Shoot(const PatchScene& scene, Problem& problem, vtkTable* convergence)
{
  const double begin = vtkTimerLog::GetUniversalTime();
  auto shooter = vtkSmartPointer<vtkDeviceShooter>::Take(vtkDeviceShooter::New());
  std::string reason = "no loaded module shoots on it.";
  if (!shooter || !shooter->Open(reason))
  {
    vtkErrorMacro("Device is OpenGL, but " << reason << " Or set Device to Auto or CPU.");
    return false;
  }
  if (problem.Materials.HasBackground())
  {
    vtkErrorMacro("Southwell on OpenGL computes no sky fractions, which a background needs: set "
                  "Device to Auto or CPU, or use another solver.");
    return false;
  }
  RadiosityProblem equation = this->DescribeEquation(problem);
  const vtkIdType patches = equation.NumberOfPatches;
  equation.MaximumNumberOfIterations =
    static_cast<int>(std::min<vtkIdType>(VTK_INT_MAX, patches * this->MaximumNumberOfIterations));
  this->SetProgressStage(0.0, SolverDone);
  this->RecordConvergence(equation, convergence, begin);

  RadiositySolution& solution = problem.Solution;
  solution = ProgressiveRadiosity::Solve(shooter, scene, equation, problem.Irradiance);
  problem.Shots = solution.NumberOfIterations;
  solution.NumberOfIterations = static_cast<int>((problem.Shots + patches - 1) / patches);
  problem.DeviceUsed = shooter->GetDeviceName();
  problem.DeviceExplanation = "OpenGL: asked for";
  problem.SolverSeconds = vtkTimerLog::GetUniversalTime() - begin;
  std::transform(problem.Irradiance.begin(), problem.Irradiance.end(),
    problem.Materials.DirectIrradiance.begin(), problem.Irradiance.begin(), std::plus<double>());
  return this->CheckSolution(problem);
}

//------------------------------------------------------------------------------
// What the equation is, whatever solves it.
RadiosityProblem vtkRadiosity::DescribeEquation(const Problem& problem) const
{
  const RadiosityMaterials& materials = problem.Materials;
  RadiosityProblem equation;
  equation.Solver = this->Solver;
  equation.NumberOfBands = materials.NumberOfBands;
  equation.Reflectance = materials.Reflectance;
  equation.Emission = materials.Emission;
  for (std::size_t k = 0; k < equation.Emission.size(); ++k)
  {
    equation.Emission[k] += materials.Reflectance[k] * materials.DirectIrradiance[k];
  }
  equation.NumberOfPatches =
    static_cast<vtkIdType>(equation.Emission.size()) / equation.NumberOfBands;
  equation.Tolerance = this->Tolerance;
  equation.MaximumNumberOfIterations = this->MaximumNumberOfIterations;
  return equation;
}

//------------------------------------------------------------------------------
// One row of the table per iteration; progress follows the logarithm of the error bound, which
// falls steadily.
void vtkRadiosity::RecordConvergence(RadiosityProblem& equation, vtkTable* convergence,
  double begin)
{
  vtkNew<vtkIntArray> iterations;
  iterations->SetName("Iteration");
  convergence->Initialize();
  convergence->AddColumn(iterations);
  vtkSmartPointer<vtkDoubleArray> columns[3];
  const char* const names[3] = { "Seconds", "Residual", "ErrorBound" };
  for (int column = 0; column < 3; ++column)
  {
    columns[column] = vtkSmartPointer<vtkDoubleArray>::New();
    columns[column]->SetName(names[column]);
    convergence->AddColumn(columns[column]);
  }
  vtkIntArray* count = iterations;
  const double most = equation.MaximumNumberOfIterations;
  double first = 0.0;
  equation.Report = [=](int iteration, double residual, double bound) mutable
  {
    count->InsertNextValue(iteration);
    columns[0]->InsertNextValue(vtkTimerLog::GetUniversalTime() - begin);
    columns[1]->InsertNextValue(residual);
    columns[2]->InsertNextValue(bound);
    first = first > 0.0 ? first : residual;
    const double gained = residual > 0.0 && first > 0.0 ? std::log(first / residual) : 0.0;
    const double byResidual = gained / -std::log(this->Tolerance);
    return this->ReportProgress(std::max(byResidual, iteration / most));
  };
}

//------------------------------------------------------------------------------
// Whether there is one to write, after saying what is wrong with it.
bool vtkRadiosity::CheckSolution(const Problem& problem)
{
  const RadiositySolution& solution = problem.Solution;
  if (problem.IsTrial)
  {
    return solution.Error.empty() && solution.Status != RadiosityStatus::Aborted;
  }
  if (!solution.Error.empty())
  {
    const char* hint = problem.Materials.HasGivenFluxes()
      ? " A patch with a given net flux counts as one that reflects everything: each closed part "
        "of "
        "the scene needs a patch with a given temperature."
      : "";
    vtkErrorMacro(<< solution.Error << hint);
    return false;
  }
  if (solution.Status == RadiosityStatus::Aborted)
  {
    return false;
  }
  if (!solution.Warning.empty())
  {
    vtkWarningMacro(<< solution.Warning);
  }
  return true;
}

//------------------------------------------------------------------------------
// The irradiance of the solution, in double precision; B = E + rho H then holds exactly between the
// output arrays.
bool vtkRadiosity::Finish(vtkCPULinkOperator* links, Problem& problem)
{
  RadiositySolution& solution = problem.Solution;
  if (!this->CheckSolution(problem))
  {
    return false;
  }
  problem.Irradiance.resize(solution.Radiosity.size());
  if (!links->SetVector(0, solution.Radiosity.data()) || !links->Multiply(1, 0) ||
    !links->GetVector(1, problem.Irradiance.data()))
  {
    return false;
  }
  const std::vector<double>& areas = *problem.Areas;
  for (std::size_t k = 0; k < problem.Irradiance.size(); ++k)
  {
    double& irradiance = problem.Irradiance[k];
    irradiance = irradiance / areas[k / problem.Materials.NumberOfBands] +
      problem.Materials.DirectIrradiance[k];
    solution.Radiosity[k] =
      problem.Materials.Emission[k] + problem.Materials.Reflectance[k] * irradiance;
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkRadiosity::Write(vtkDataObject* input, PatchScene& scene, const Problem& problem,
  vtkViewFactors* viewFactors, vtkDataObject* output)
{
  scene.BuildSmoothPoints(this->FeatureAngle, problem.Materials.GetPointMaterials(),
    2 * problem.Materials.NumberOfBands);
  scene.CopyStructure(input, output);

  std::vector<double> flux = problem.Solution.Radiosity;
  std::transform(flux.begin(), flux.end(), problem.Irradiance.begin(), flux.begin(),
    std::minus<double>());
  scene.AddArray(output, "Radiosity", problem.Solution.Radiosity, problem.Materials.NumberOfBands);
  scene.AddArray(output, "Irradiance", problem.Irradiance, problem.Materials.NumberOfBands);
  scene.AddArray(output, "NetFlux", flux, problem.Materials.NumberOfBands);
  this->WriteThermal(scene, problem, flux, output);

  vtkFieldData* fields = output->GetFieldData();
  const RadiositySolution& solution = problem.Solution;
  AddSummary(fields, "SolverUsed", std::string(RadiositySolvers::GetName(solution.Solver)));
  AddSummary(fields, "SolverExplanation", solution.Explanation);
  AddSummary(fields, "SolverStatus", std::string(RadiositySolvers::GetName(solution.Status)));
  AddSummary(fields, "DeviceUsed", problem.DeviceUsed);
  AddSummary(fields, "DeviceExplanation", problem.DeviceExplanation);
  AddSummary(fields, "NumberOfIterations", solution.NumberOfIterations);
  AddSummary(fields, "ErrorBound", solution.ErrorBound);
  AddSummary(fields, "Converged", solution.HasConverged() ? 1.0 : 0.0);
  AddSummary(fields, "SolverSeconds", problem.SolverSeconds);
  if (viewFactors)
  {
    const bool dense = vtkExchangeMatrix::SafeDownCast(viewFactors->GetExchange()) != nullptr;
    AddSummary(fields, "LinkMethodUsed", std::string(dense ? "Dense" : "Hierarchical"));
    viewFactors->AddSummaries(fields);
  }
  else
  {
    AddSummary(fields, "NumberOfShots", problem.Shots);
  }
}

//------------------------------------------------------------------------------
void vtkRadiosity::WriteThermal(const PatchScene& scene, const Problem& problem,
  const std::vector<double>& flux, vtkDataObject* output)
{
  const RadiosityMaterials& materials = problem.Materials;
  if (!materials.IsThermal())
  {
    return;
  }
  vtkIdType impossible = 0;
  const std::vector<double> temperatures =
    materials.ComputeTemperatures(problem.Irradiance, problem.Solution.ErrorBound, impossible);
  if (impossible > 0)
  {
    vtkWarningMacro(<< impossible
                    << " patches have no temperature (SurfaceTemperature is 0 there): their given "
                       "net flux takes out more than they absorb. Raise it, or give the patches "
                       "around them a higher temperature.");
  }
  scene.AddArray(output, "SurfaceTemperature", temperatures, 1);
  std::vector<double> totals(temperatures.size(), 0.0);
  for (std::size_t k = 0; k < flux.size(); ++k)
  {
    totals[k / materials.NumberOfBands] += flux[k];
  }
  if (materials.NumberOfBands > 1)
  {
    scene.AddArray(output, "TotalNetFlux", totals, 1);
  }
  const std::vector<double>& areas = scene.GetAreas();
  const double power = std::inner_product(areas.begin(), areas.end(), totals.begin(), 0.0);
  AddSummary(output->GetFieldData(), "NetPower", power * scene.GetScale() * scene.GetScale());
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
  os << indent << "Solver: " << RadiositySolvers::GetName(this->Solver) << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  PrintValues(os << indent << "BandLimits:", this->BandLimits);
  os << indent << "BackgroundTemperature: " << this->BackgroundTemperature << "\n";
  PrintValues(os << indent << "BackgroundRadiance:", this->BackgroundRadiances);
  os << indent << "LinkMethod: " << this->LinkMethod << "\n";
  os << indent << "LinkTolerance: " << this->LinkTolerance << "\n";
  os << indent << "ClusterTree: " << this->ClusterTree << "\n";
  os << indent << "RefineByBrightness: " << this->RefineByBrightness << "\n";
  os << indent << "Device: " << this->Device << "\n";
  os << indent << "ViewFactorTolerance: " << this->ViewFactorTolerance << "\n";
  os << indent << "EnforceClosure: " << this->EnforceClosure << "\n";
  os << indent << "ViewFactors: " << this->ViewFactors << "\n";
}
