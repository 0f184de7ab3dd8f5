// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiosity.h"

#include "vtkDataObject.h"
#include "vtkDenseLinkOperator.h"
#include "vtkDoubleArray.h"
#include "vtkExchangeMatrix.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPatchScene.h"
#include "vtkRadiositySolvers.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"
#include "vtkViewFactors.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkRadiosity);
vtkCxxSetObjectMacro(vtkRadiosity, ViewFactors, vtkViewFactors);

namespace
{
// W m^-2 K^-4, exact in the SI of 2019.
constexpr double StefanBoltzmann = 5.670374419e-8;

// What storing view factors in single precision costs a row sum.
constexpr double SinglePrecision = 1e-7;

enum InputArray
{
  EMISSION,
  REFLECTANCE,
  TEMPERATURE,
  EMISSIVITY,
  DIRECT_IRRADIANCE,
  NUMBER_OF_ARRAYS
};
const char* const DefaultNames[NUMBER_OF_ARRAYS] = { "Emission", "Reflectance", "Temperature",
  "Emissivity", "DirectIrradiance" };

// The stages of a run as fractions of its progress.
constexpr double ViewFactorsDone = 0.8;
constexpr double SolverDone = 0.98;

//------------------------------------------------------------------------------
// The largest error of a row sum. A row that has been closed is as good as its sum.
double GetRowSumError(vtkViewFactors* viewFactors)
{
  const std::vector<double>& errors = viewFactors->GetRowErrors();
  const std::vector<double>& sums = viewFactors->GetRowSums();
  double largest = 0.0;
  for (std::size_t row = 0; row < errors.size(); ++row)
  {
    const double gap = viewFactors->HasClosedRows() ? std::abs(1.0 - sums[row]) : errors[row];
    largest = std::max(largest, std::min(errors[row], gap));
  }
  return largest + SinglePrecision;
}

//------------------------------------------------------------------------------
struct BandArray
{
  std::string Name;
  std::vector<double> Values;
  int Components = 0;

  bool IsThere() const { return this->Components > 0; }
  double Get(vtkIdType patch, int band) const
  {
    return this->Values[patch * this->Components + (this->Components == 1 ? 0 : band)];
  }
  // Empty, or what is wrong with the range of the values.
  std::string CheckRange(const vtkPatchScene& scene, double low, double high,
    const char* range) const
  {
    const auto count = static_cast<vtkIdType>(this->Values.size());
    for (vtkIdType k = 0; k < count; ++k)
    {
      const vtkIdType polygon = k / this->Components;
      const double value =
        this->Get(scene.GetPatch(polygon), static_cast<int>(k % this->Components));
      if (!(value >= low && value <= high))
      {
        return "The cell array \"" + this->Name + "\" is " + std::to_string(value) +
          " at polygon " + std::to_string(polygon) + ": it must be " + range + ".";
      }
    }
    return "";
  }
};
} // namespace

//------------------------------------------------------------------------------
struct vtkRadiosity::Problem
{
  BandArray Arrays[NUMBER_OF_ARRAYS];
  int Bands = 0;
  const std::vector<double>* Areas = nullptr; // in the exchange matrix's unit
  // patches x bands
  std::vector<double> Emission;
  std::vector<double> Reflectance;
  std::vector<double> DirectIrradiance;
  std::vector<double> Irradiance;

  vtkRadiositySolution Solution;
  std::string SolverUsed;
  std::string DeviceUsed;
  std::string DeviceExplanation;
  double SolverSeconds = 0.0;

  std::vector<bool> FindSenders() const;
};

//------------------------------------------------------------------------------
vtkRadiosity::vtkRadiosity()
{
  this->SetNumberOfOutputPorts(2);
  for (int array = 0; array < NUMBER_OF_ARRAYS; ++array)
  {
    this->SetInputArrayToProcess(array, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS,
      DefaultNames[array]);
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
  vtkPatchScene scene;
  Problem problem;
  std::string error;
  if (!this->CheckSolver())
  {
    return 0;
  }
  if (!scene.Build(input, this->Controller, error))
  {
    vtkErrorMacro(<< error);
    return 0;
  }
  if (!this->ReadMaterials(input, scene, problem))
  {
    return 0;
  }
  vtkViewFactors* viewFactors = this->UpdateViewFactors(scene, problem);
  if (!viewFactors || !this->Solve(viewFactors, problem, vtkTable::GetData(outputs, 1)))
  {
    return 0;
  }
  this->Write(input, scene, problem, viewFactors, vtkDataObject::GetData(outputs, 0));
  this->UpdateProgress(1.0);
  return 1;
}

//------------------------------------------------------------------------------
int vtkRadiosity::GetChosenSolver() const
{
  return this->Solver == SOLVER_AUTO ? SOLVER_CONJUGATE_GRADIENT : this->Solver;
}

//------------------------------------------------------------------------------
bool vtkRadiosity::CheckSolver()
{
  const int chosen = this->GetChosenSolver();
  if (!vtkRadiositySolvers::IsSequential(chosen))
  {
    return this->CheckDevice(this->Device);
  }
  if (this->Device == DEVICE_OPENGL || this->GetNumberOfRanks() > 1)
  {
    vtkErrorMacro(<< vtkRadiositySolvers::GetName(chosen)
                  << " goes from patch to patch and runs on the CPU of one process: set Device to "
                     "Auto or CPU on one process, or use Jacobi, Chebyshev or ConjugateGradient.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadiosity::ReadArrays(vtkDataObject* input, const vtkPatchScene& scene, Problem& problem)
{
  problem.Bands = 1;
  for (int k = 0; k < NUMBER_OF_ARRAYS; ++k)
  {
    BandArray& array = problem.Arrays[k];
    vtkInformation* choice = this->GetInputArrayInformation(k);
    const char* name = choice->Get(vtkDataObject::FIELD_NAME());
    array.Name = name && *name ? name : DefaultNames[k];
    std::string error;
    if (!scene.GatherCellArray(input, array.Name, false, array.Values, array.Components, error))
    {
      vtkErrorMacro(<< error);
      return false;
    }
    if (array.Components > 1 && problem.Bands > 1 && array.Components != problem.Bands)
    {
      vtkErrorMacro("The cell array \"" << array.Name << "\" has " << array.Components
                                        << " components where another has " << problem.Bands
                                        << ": give all of them 1 or the same number of bands.");
      return false;
    }
    problem.Bands = std::max(problem.Bands, array.Components);
  }
  return true;
}

//------------------------------------------------------------------------------
std::string vtkRadiosity::CheckArrays(const vtkPatchScene& scene, const Problem& problem)
{
  const BandArray* arrays = problem.Arrays;
  const bool thermal = arrays[TEMPERATURE].IsThere();
  if (thermal && !arrays[EMISSIVITY].IsThere())
  {
    return "There is a temperature (\"" + arrays[TEMPERATURE].Name +
      "\") but no emissivity: add a "
      "cell array \"" +
      arrays[EMISSIVITY].Name + "\" with values from 0 to 1.";
  }
  if (thermal && arrays[EMISSION].IsThere())
  {
    return "There are both \"" + arrays[EMISSION].Name + "\" and \"" + arrays[TEMPERATURE].Name +
      "\": remove one of the two cell arrays.";
  }
  if (thermal && problem.Bands > 1)
  {
    return "The temperature gives the total emission of one band, but there are " +
      std::to_string(problem.Bands) + " bands: use one component, or \"" + arrays[EMISSION].Name +
      "\" with the emission of each band.";
  }
  if (!thermal && !arrays[REFLECTANCE].IsThere() && !arrays[EMISSIVITY].IsThere())
  {
    return "There is no reflectance: add a cell array \"" + arrays[REFLECTANCE].Name +
      "\" with values from 0 to 1 (or \"" + arrays[TEMPERATURE].Name + "\" and \"" +
      arrays[EMISSIVITY].Name + "\").";
  }
  if (!thermal && !arrays[EMISSION].IsThere() && !arrays[DIRECT_IRRADIANCE].IsThere())
  {
    return "Nothing emits: add a cell array \"" + arrays[EMISSION].Name + "\", or \"" +
      arrays[TEMPERATURE].Name + "\" and \"" + arrays[EMISSIVITY].Name + "\", or \"" +
      arrays[DIRECT_IRRADIANCE].Name + "\" from vtkDirectIrradiance.";
  }
  const double most = VTK_DOUBLE_MAX;
  for (const std::string& problemFound :
    { arrays[REFLECTANCE].CheckRange(scene, 0.0, 1.0, "from 0 to 1"),
      arrays[EMISSIVITY].CheckRange(scene, 0.0, 1.0, "from 0 to 1"),
      arrays[TEMPERATURE].CheckRange(scene, 0.0, most, "in kelvin, at least 0"),
      arrays[EMISSION].CheckRange(scene, 0.0, most, "at least 0"),
      arrays[DIRECT_IRRADIANCE].CheckRange(scene, 0.0, most, "at least 0") })
  {
    if (!problemFound.empty())
    {
      return problemFound;
    }
  }
  return "";
}

//------------------------------------------------------------------------------
bool vtkRadiosity::ReadMaterials(vtkDataObject* input, const vtkPatchScene& scene, Problem& problem)
{
  if (!this->ReadArrays(input, scene, problem))
  {
    return false;
  }
  const std::string error = CheckArrays(scene, problem);
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
    return false;
  }
  const BandArray* arrays = problem.Arrays;
  const bool thermal = arrays[TEMPERATURE].IsThere();
  const bool byEmissivity = thermal || !arrays[REFLECTANCE].IsThere();
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    for (int band = 0; band < problem.Bands; ++band)
    {
      const double reflectance = byEmissivity ? 1.0 - arrays[EMISSIVITY].Get(patch, band)
                                              : arrays[REFLECTANCE].Get(patch, band);
      double emission = arrays[EMISSION].IsThere() ? arrays[EMISSION].Get(patch, band) : 0.0;
      if (thermal)
      {
        emission = arrays[EMISSIVITY].Get(patch, band) * StefanBoltzmann *
          std::pow(arrays[TEMPERATURE].Get(patch, band), 4);
      }
      const BandArray& direct = arrays[DIRECT_IRRADIANCE];
      problem.Reflectance.push_back(reflectance);
      problem.Emission.push_back(emission);
      problem.DirectIrradiance.push_back(direct.IsThere() ? direct.Get(patch, band) : 0.0);
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// Others only receive: what they would send to each other is nothing.
std::vector<bool> vtkRadiosity::Problem::FindSenders() const
{
  std::vector<bool> senders(this->Reflectance.size() / this->Bands, false);
  for (std::size_t k = 0; k < this->Reflectance.size(); ++k)
  {
    if (this->Reflectance[k] > 0.0 || this->Emission[k] > 0.0)
    {
      senders[k / this->Bands] = true;
    }
  }
  return senders;
}

//------------------------------------------------------------------------------
vtkViewFactors* vtkRadiosity::UpdateViewFactors(const vtkPatchScene& scene, const Problem& problem)
{
  vtkViewFactors* viewFactors = this->ViewFactors;
  const std::vector<bool> senders = problem.FindSenders();
  const bool needsAll = viewFactors || this->EnforceClosure;
  if (!viewFactors)
  {
    viewFactors = this->InternalViewFactors;
    viewFactors->SetController(this->Controller);
    viewFactors->SetTolerance(this->ViewFactorTolerance);
    viewFactors->SetEnforceClosure(this->EnforceClosure);
  }
  this->SetProgressStage(0.0, ViewFactorsDone);
  const auto progress = [this](double done) { return this->ReportProgress(done); };
  return viewFactors->UpdateExchange(scene, progress, needsAll ? nullptr : &senders) ? viewFactors
                                                                                     : nullptr;
}

//------------------------------------------------------------------------------
bool vtkRadiosity::Solve(vtkViewFactors* viewFactors, Problem& problem, vtkTable* convergence)
{
  const double begin = vtkTimerLog::GetUniversalTime();
  const int chosen = this->GetChosenSolver();
  vtkExchangeMatrix* exchange = viewFactors->GetExchange();
  const int device = vtkRadiositySolvers::IsSequential(chosen) ? DEVICE_CPU : this->Device;
  auto links = this->MakeLinkOperator(device, exchange, problem.Bands, problem.DeviceExplanation);
  vtkNew<vtkDenseLinkOperator> reference;
  reference->SetController(this->Controller);
  if (!links || !reference->Initialize(exchange, problem.Bands))
  {
    return false;
  }
  problem.Areas = &exchange->GetAreas();
  vtkRadiosityProblem equation;
  equation.Operator = links;
  equation.Reference = reference;
  equation.Solver = chosen;
  equation.NumberOfPatches = exchange->GetNumberOfPatches();
  equation.NumberOfBands = problem.Bands;
  equation.Areas = problem.Areas;
  equation.RowSums = &viewFactors->GetRowSums();
  equation.RowSumError = GetRowSumError(viewFactors);
  equation.Reflectance = problem.Reflectance;
  equation.Emission = problem.Emission;
  for (std::size_t k = 0; k < equation.Emission.size(); ++k)
  {
    equation.Emission[k] += problem.Reflectance[k] * problem.DirectIrradiance[k];
  }
  equation.Tolerance = this->Tolerance;
  equation.MaximumNumberOfIterations = this->MaximumNumberOfIterations;
  this->SetProgressStage(ViewFactorsDone, SolverDone);
  this->RecordConvergence(equation, convergence, begin);

  problem.Solution = vtkRadiositySolvers::Solve(equation);
  problem.SolverUsed = vtkRadiositySolvers::GetName(chosen);
  problem.DeviceUsed = links->GetDeviceName();
  problem.SolverSeconds = vtkTimerLog::GetUniversalTime() - begin;
  return this->Finish(reference, problem);
}

//------------------------------------------------------------------------------
// One row of the table per iteration; progress follows the logarithm of the error bound, which
// falls steadily.
void vtkRadiosity::RecordConvergence(vtkRadiosityProblem& equation, vtkTable* convergence,
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
    const double byCount = static_cast<double>(iteration) / this->MaximumNumberOfIterations;
    return this->ReportProgress(std::max(byResidual, byCount));
  };
}

//------------------------------------------------------------------------------
// The irradiance of the solution, in double precision; B = E + rho H then holds exactly between the
// output arrays.
bool vtkRadiosity::Finish(vtkDenseLinkOperator* links, Problem& problem)
{
  vtkRadiositySolution& solution = problem.Solution;
  if (!solution.Error.empty())
  {
    vtkErrorMacro(<< solution.Error);
    return false;
  }
  if (solution.Aborted)
  {
    return false;
  }
  if (!solution.Converged)
  {
    vtkWarningMacro(<< problem.SolverUsed << " stopped after " << solution.NumberOfIterations
                    << " iterations with an error bound of " << solution.ErrorBound
                    << ": raise MaximumNumberOfIterations or Tolerance, or use ConjugateGradient.");
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
    irradiance = irradiance / areas[k / problem.Bands] + problem.DirectIrradiance[k];
    solution.Radiosity[k] = problem.Emission[k] + problem.Reflectance[k] * irradiance;
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkRadiosity::Write(vtkDataObject* input, vtkPatchScene& scene, const Problem& problem,
  const vtkViewFactors* viewFactors, vtkDataObject* output)
{
  // Points are not averaged across a change of what the patches are made of. That a patch emits is
  // part of it, how much is not: temperatures and emissions may vary from patch to patch.
  std::vector<double> materials;
  for (std::size_t k = 0; k < problem.Reflectance.size(); ++k)
  {
    materials.push_back(problem.Reflectance[k]);
    materials.push_back(problem.Emission[k] > 0.0 ? 1.0 : 0.0);
  }
  scene.BuildSmoothPoints(this->FeatureAngle, materials, 2 * problem.Bands);
  scene.CopyStructure(input, output);

  std::vector<double> flux = problem.Solution.Radiosity;
  std::transform(flux.begin(), flux.end(), problem.Irradiance.begin(), flux.begin(),
    std::minus<double>());
  scene.AddArray(output, "Radiosity", problem.Solution.Radiosity, problem.Bands);
  scene.AddArray(output, "Irradiance", problem.Irradiance, problem.Bands);
  scene.AddArray(output, "NetFlux", flux, problem.Bands);

  vtkFieldData* fields = output->GetFieldData();
  AddSummary(fields, "SolverUsed", problem.SolverUsed);
  AddSummary(fields, "DeviceUsed", problem.DeviceUsed);
  AddSummary(fields, "DeviceExplanation", problem.DeviceExplanation);
  AddSummary(fields, "NumberOfIterations", problem.Solution.NumberOfIterations);
  AddSummary(fields, "ErrorBound", problem.Solution.ErrorBound);
  AddSummary(fields, "Converged", problem.Solution.Converged ? 1.0 : 0.0);
  AddSummary(fields, "SolverSeconds", problem.SolverSeconds);
  viewFactors->AddSummaries(fields);
}

//------------------------------------------------------------------------------
void vtkRadiosity::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Solver: " << vtkRadiositySolvers::GetName(this->Solver) << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "Device: " << this->Device << "\n";
  os << indent << "ViewFactorTolerance: " << this->ViewFactorTolerance << "\n";
  os << indent << "EnforceClosure: " << this->EnforceClosure << "\n";
  os << indent << "ViewFactors: " << this->ViewFactors << "\n";
}
