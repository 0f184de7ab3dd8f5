// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What tests of vtkRadiosity share: a run with its messages, and the solution of the same equation
/// by an LU decomposition in double precision.
#ifndef RadiosityTesting_h
#define RadiosityTesting_h

#include "MessageLog.h"
#include "ViewFactorTesting.h"
#include "vtkExecutive.h"
#include "vtkRadiosity.h"
#include "vtkTable.h"
#include "vtkTestErrorObserver.h"

#include <Eigen/Dense>

#include <numeric>
#include <vector>

namespace LightTransportTesting
{
using Vector = Eigen::VectorXd;

//------------------------------------------------------------------------------
inline Vector ToVector(const std::vector<double>& values)
{
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

//------------------------------------------------------------------------------
/// All solvers that the filter takes, Auto first.
inline std::vector<int> GetSolvers()
{
  vtkNew<vtkRadiosity> filter;
  std::vector<int> solvers(filter->GetSolverMaxValue() + 1);
  std::iota(solvers.begin(), solvers.end(), static_cast<int>(vtkRadiosity::SOLVER_AUTO));
  return solvers;
}

//------------------------------------------------------------------------------
inline vtkSmartPointer<vtkViewFactors> MakeFactors(vtkPolyData* data, double tolerance)
{
  auto factors = vtkSmartPointer<vtkViewFactors>::New();
  factors->SetInputData(data);
  factors->SetTolerance(tolerance);
  factors->Update();
  return factors;
}

//------------------------------------------------------------------------------
/// One run of the filter; the vectors are empty after an error.
struct Run
{
  Run(vtkPolyData* data, vtkViewFactors* factors, int solver, double tolerance, bool closed = false)
  {
    vtkNew<MessageLog> observer;
    vtkNew<vtkTest::ErrorObserver> pipelineObserver;
    this->Filter->AddObserver(vtkCommand::ErrorEvent, observer);
    this->Filter->AddObserver(vtkCommand::WarningEvent, observer);
    this->Filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineObserver);
    this->Filter->SetInputData(data);
    this->Filter->SetViewFactors(factors);
    this->Filter->SetEnforceClosure(closed);
    this->Filter->SetSolver(solver);
    this->Filter->SetTolerance(tolerance);
    this->Filter->Update();
    this->Messages = observer->GetAllButVerdict();
    this->Radiosity = this->Get("Radiosity");
    this->Irradiance = this->Get("Irradiance");
    this->NetFlux = this->Get("NetFlux");
    vtkFieldData* fields = this->Filter->GetPolyDataOutput()->GetFieldData();
    if (vtkAbstractArray* status = fields->GetAbstractArray("SolverStatus"))
    {
      this->Status = status->GetVariantValue(0).ToString();
      this->Explanation =
        fields->GetAbstractArray("SolverExplanation")->GetVariantValue(0).ToString();
      this->Iterations =
        static_cast<int>(GetSummary(this->Filter->GetPolyDataOutput(), "NumberOfIterations"));
      this->ErrorBound = GetSummary(this->Filter->GetPolyDataOutput(), "ErrorBound");
    }
  }

  /// The first iteration with a residual of at most this.
  int CountIterations(double residual) const
  {
    vtkTable* table = this->Filter->GetConvergence();
    for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
    {
      if (table->GetValueByName(row, "Residual").ToDouble() <= residual)
      {
        return table->GetValueByName(row, "Iteration").ToInt();
      }
    }
    return VTK_INT_MAX;
  }

  vtkNew<vtkRadiosity> Filter;
  std::string Messages; ///< errors and warnings, but for the verdict on the scene
  std::string Status;
  std::string Explanation;
  int Iterations = -1;
  double ErrorBound = -1.0;
  Vector Radiosity, Irradiance, NetFlux;

private:
  Vector Get(const char* name) const
  {
    vtkDataArray* array = this->Filter->GetPolyDataOutput()->GetCellData()->GetArray(name);
    Vector values(array ? array->GetNumberOfTuples() : 0);
    for (vtkIdType cell = 0; cell < values.size(); ++cell)
    {
      values[cell] = array->GetComponent(cell, 0);
    }
    return values;
  }
};

//------------------------------------------------------------------------------
/// B of the first band, from the cell arrays "Emission" and "Reflectance" and up-to-date view
/// factors.
inline Vector SolveExactly(vtkPolyData* data, vtkViewFactors* factors)
{
  const vtkIdType patches = data->GetNumberOfCells();
  vtkDataArray* reflectance = data->GetCellData()->GetArray("Reflectance");
  vtkDataArray* emission = data->GetCellData()->GetArray("Emission");
  Eigen::MatrixXd matrix(patches, patches);
  Vector source(patches);
  for (vtkIdType i = 0; i < patches; ++i)
  {
    source[i] = emission->GetComponent(i, 0);
    for (vtkIdType j = 0; j < patches; ++j)
    {
      matrix(i, j) =
        (i == j ? 1.0 : 0.0) - reflectance->GetComponent(i, 0) * factors->GetViewFactor(i, j);
    }
  }
  return matrix.fullPivLu().solve(source);
}
} // namespace LightTransportTesting

#endif
