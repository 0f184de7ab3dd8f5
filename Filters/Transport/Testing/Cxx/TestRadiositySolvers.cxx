// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The solvers by themselves, against a dense LU decomposition in double precision: how many
// iterations they take, that the error bound holds after each of them, and how they end.
#include "LightTransportTesting.h"
#include "OutcomeTesting.h"
#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/RadiositySolver.h"
#include "Radiosity/RadiosityVectors.h"
#include "Radiosity/SolverSettings.h"
#include "Radiosity/SolverTable.h"
#include "Scene/PatchScene.h"
#include "ViewFactors/ViewFactorStore.h"
#include "vtkDenseLinkOperator.h"
#include "vtkExchangeMatrix.h"
#include "vtkObjectFactory.h"
#include "vtkRadiosity.h"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

//------------------------------------------------------------------------------
// What came of it.
struct Answer : RadiositySolution
{
  Outcome Ended = Outcome::Done();
};

//------------------------------------------------------------------------------
// What a solver gets.
struct Task
{
  Answer Solve() const
  {
    Answer answer;
    answer.Ended = RadiositySolver::Solve(this->Equation, this->Settings, answer);
    return answer;
  }

  RadiosityEquation Equation;
  SolverSettings Settings;
};

//------------------------------------------------------------------------------
// A scene, its view factors, and what its patches are made of.
class Case
{
public:
  Case(vtkPolyData* data, bool closed)
  {
    CheckDone(this->Scene.Build(data, Ranks()), "scene");
    CheckDone(this->Factors.Update(this->Scene, { 1e-9, closed, LinkMethod::Dense, 0.0 }, {},
                Ranks(), Monitor()),
      "view factors");
    this->Exchange = this->Factors.GetLinks().Matrix;
    const vtkIdType patches = this->Exchange->GetNumberOfPatches();
    this->F.resize(patches, patches);
    for (vtkIdType i = 0; i < patches; ++i)
    {
      for (vtkIdType j = 0; j < patches; ++j)
      {
        this->F(i, j) = this->Exchange->GetValue(i, j) / this->Exchange->GetAreas()[i];
      }
    }
    this->Emission = Vector::Zero(patches);
    this->SetReflectance([](vtkIdType) { return 0.5; });
  }

  vtkIdType GetNumberOfPatches() const { return this->F.rows(); }

  // The first polygons emit 1, all others nothing.
  void LetEmit(vtkIdType polygons)
  {
    for (vtkIdType polygon = 0; polygon < this->GetNumberOfPatches(); ++polygon)
    {
      this->Emission[this->Scene.GetPatch(polygon)] = polygon < polygons ? 1.0 : 0.0;
    }
  }

  void SetReflectance(const std::function<double(vtkIdType polygon)>& reflectance)
  {
    this->Reflectance.resize(this->GetNumberOfPatches());
    for (vtkIdType polygon = 0; polygon < this->GetNumberOfPatches(); ++polygon)
    {
      this->Reflectance[this->Scene.GetPatch(polygon)] = reflectance(polygon);
    }
    this->K =
      Matrix::Identity(this->F.rows(), this->F.cols()) - this->Reflectance.asDiagonal() * this->F;
  }

  Vector GetExact() const { return this->K.lu().solve(this->Emission); }

  // Several bands are copies of the one.
  Task MakeTask(int solver, int bands = 1)
  {
    this->Links = vtkSmartPointer<vtkDenseLinkOperator>::New();
    this->Reference = vtkSmartPointer<vtkDenseLinkOperator>::New();
    Check(this->Links->Initialize(this->Exchange, bands) &&
        this->Reference->Initialize(this->Exchange, bands),
      "link operators");
    Task task;
    RadiosityEquation& equation = task.Equation;
    equation.Operator = this->Links;
    equation.Reference = this->Reference;
    equation.NumberOfPatches = this->GetNumberOfPatches();
    equation.NumberOfBands = bands;
    equation.Areas = &this->Exchange->GetAreas();
    equation.RowSums = &this->Factors.GetLinks().RowSums;
    equation.RowSumErrors.assign(this->GetNumberOfPatches(), 1e-14);
    for (vtkIdType patch = 0; patch < this->GetNumberOfPatches(); ++patch)
    {
      equation.Emission.insert(equation.Emission.end(), bands, this->Emission[patch]);
      equation.Reflectance.insert(equation.Reflectance.end(), bands, this->Reflectance[patch]);
    }
    equation.GetPolygon = [this](vtkIdType patch) { return this->Scene.GetPolygon(patch); };
    task.Settings.Solver = solver;
    task.Settings.MaximumNumberOfIterations = 20000;
    task.Settings.Report = [](int, double, double) { return true; };
    return task;
  }

  // B as it is while a solver reports.
  Vector GetCurrent() const
  {
    Vector current(this->GetNumberOfPatches());
    this->Links->GetVector(RadiosityVectors::SOLUTION, current.data());
    return current;
  }

  ViewFactorStore Factors;
  PatchScene Scene;
  vtkExchangeMatrix* Exchange = nullptr;
  vtkSmartPointer<vtkDenseLinkOperator> Links, Reference;
  Matrix F, K;
  Vector Emission, Reflectance;
};

//------------------------------------------------------------------------------
// The numbers of all solvers that go along links; Auto not among them.
std::vector<int> GetSolvers()
{
  std::vector<int> solvers;
  for (const SolverEntry* entry : SolverTable::GetAll())
  {
    if (entry->Iterate)
    {
      solvers.push_back(entry->Type);
    }
  }
  return solvers;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakePlates(double gap)
{
  Surface plates;
  plates.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 14, 14);
  plates.AddGrid({ 0, 0, gap }, { 0, 1, 0 }, { 1, 0, 0 }, 14, 14);
  return plates.Get();
}

//------------------------------------------------------------------------------
// Iterations until the residual is 1e-6 of the emission (2-norm), after each of which the error
// must be within the bound; and the bound must not be idle talk.
int CountIterations(Case& scene, int solver, const std::string& what)
{
  const Vector exact = scene.GetExact();
  Task task = scene.MakeTask(solver);
  task.Settings.Tolerance = 1e-15;
  int count = -1;
  task.Settings.Report = [&](int iteration, double residual, double bound)
  {
    const Vector current = scene.GetCurrent();
    const Vector difference = scene.Emission - scene.K * current;
    const double error = (current - exact).lpNorm<Eigen::Infinity>();
    Check(error <= bound,
      what + ": the error is within its bound after iteration " + std::to_string(iteration));
    // Rounding of the residual, which conjugate gradients carry along.
    const double rounding =
      std::numeric_limits<double>::epsilon() * (4 + iteration) * current.lpNorm<Eigen::Infinity>();
    Check(std::abs(residual - difference.lpNorm<Eigen::Infinity>()) <= rounding,
      what + ": the residual is the true one");
    if (difference.norm() < 1e-6 * scene.Emission.norm())
    {
      count = iteration;
    }
    return count < 0;
  };
  const Answer solution = task.Solve();
  Check(solution.Status == SolverStatus::Aborted && solution.Ended.IsAborted(),
    what + ": stopped by us " + solution.Ended.GetMessage());
  return count;
}

//------------------------------------------------------------------------------
struct Expected
{
  double Reflectance;
  // Most iterations of Jacobi, Gauss-Seidel, Southwell, Chebyshev, conjugate gradients; 0: not run.
  int Most[5];
};

// The counts of a reference computation (exact view factors of rectangles, double precision), with
// a twentieth more and one for the order of the patches. Southwell overshoots here and did not
// there; Chebyshev knew 1 - rho to 1 + rho there.
void TestCounts(Case& scene, const std::vector<Expected>& rows, const std::string& name)
{
  for (const Expected& row : rows)
  {
    scene.SetReflectance([&](vtkIdType) { return row.Reflectance; });
    for (int solver = vtkRadiosity::SOLVER_JACOBI;
         solver <= vtkRadiosity::SOLVER_CONJUGATE_GRADIENT; ++solver)
    {
      const int most = row.Most[solver - 1];
      const std::string what =
        name + " at " + std::to_string(row.Reflectance) + ", " + SolverTable::GetName(solver);
      const int count = most > 0 ? CountIterations(scene, solver, what) : 0;
      Check(count >= 0 && count <= most + most / 20 + 1,
        what + " takes " + std::to_string(count) + " iterations, not " + std::to_string(most));
    }
  }
}

//------------------------------------------------------------------------------
void TestCube()
{
  Case cube(MakeRoom(8), true);
  cube.LetEmit(64);
  TestCounts(cube,
    { { 0.5, { 18, 10, 5, 10, 7 } }, { 0.8, { 57, 30, 7, 20, 8 } }, { 0.9, { 122, 63, 8, 30, 9 } },
      { 0.95, { 251, 129, 8, 43, 10 } }, { 0.99, { 1285, 653, 9, 97, 11 } },
      { 0.999, { 12913, 6555, 10, 306, 12 } }, { 0.999999, { 0, 0, 14, 0, 15 } } },
    "cube");
}

//------------------------------------------------------------------------------
void TestPlates()
{
  Case wide(MakePlates(1.0), false);
  wide.LetEmit(196);
  TestCounts(wide, { { 0.99, { 8, 5, 5, 77, 4 } } }, "plates, gap 1");
  Case near(MakePlates(0.1), false);
  near.LetEmit(196);
  TestCounts(near, { { 0.9, { 58, 30, 15, 29, 14 } }, { 0.99, { 100, 51, 19, 98, 16 } } },
    "plates, gap 0.1");
  Case nearer(MakePlates(0.02), false);
  nearer.LetEmit(196);
  TestCounts(nearer,
    { { 0.9, { 110, 56, 37, 29, 24 } }, { 0.99, { 523, 262, 94, 98, 37 } },
      { 0.999, { 812, 407, 143, 311, 40 } } },
    "plates, gap 0.02");
}

//------------------------------------------------------------------------------
// The final error bound is that of what is returned, and the tolerance is kept.
void TestAnswers()
{
  Case cube(MakeRoom(3), true);
  cube.LetEmit(5);
  cube.SetReflectance(
    [](vtkIdType polygon) { return polygon % 7 == 0 ? 1.0
                              : polygon % 7 == 1    ? 0.0
                                                    : 0.9; });
  const Vector exact = cube.GetExact();
  std::vector<int> solvers = GetSolvers();
  solvers.push_back(vtkRadiosity::SOLVER_AUTO);
  for (const int bands : { 1, 5 })
  {
    for (const double tolerance : { 1e-2, 1e-6, 1e-12 })
    {
      for (const int solver : solvers)
      {
        const std::string what =
          std::string(SolverTable::GetName(solver)) + " to " + std::to_string(tolerance);
        Task task = cube.MakeTask(solver, bands);
        task.Settings.Tolerance = tolerance;
        const Answer solution = task.Solve();
        Check(solution.HasConverged() && solution.Warning.empty() && solution.Ended,
          what + " converges");
        Check(solution.Solver == (solver == 0 ? vtkRadiosity::SOLVER_CONJUGATE_GRADIENT : solver),
          what + " is what is used");
        double error = 0.0;
        for (std::size_t k = 0; k < solution.Radiosity.size(); ++k)
        {
          error = std::max(error,
            std::abs(solution.Radiosity[k] - exact[static_cast<vtkIdType>(k) / bands]));
        }
        Check(error <= solution.ErrorBound &&
            solution.ErrorBound <= tolerance * exact.maxCoeff() * (1.0 + tolerance),
          what + ": the error is within the tolerance");
      }
    }
  }
}

//------------------------------------------------------------------------------
// What a device does: vectors in single precision, and a matrix without its remainders.
class SinglePrecisionLinks : public vtkDenseLinkOperator
{
public:
  static SinglePrecisionLinks* New();
  vtkTypeMacro(SinglePrecisionLinks, vtkDenseLinkOperator);

  bool Take(const vtkExchangeMatrix* exchange)
  {
    Check(this->Copy->Allocate(exchange->GetAreas(), 1), "allocation");
    for (std::size_t k = 0; k < exchange->GetTiles().size(); ++k)
    {
      std::copy_n(exchange->GetTiles()[k].Values,
        vtkExchangeMatrix::TileSize * vtkExchangeMatrix::TileSize,
        this->Copy->GetTiles()[k].Values);
    }
    return this->Initialize(this->Copy, 1);
  }

  bool IsSinglePrecision() override { return true; }
  bool SetVector(int slot, const double* values) override
  {
    return this->Superclass::SetVector(slot, values) && this->Round(slot);
  }
  bool Multiply(int y, int x) override
  {
    return this->Superclass::Multiply(y, x) && this->Round(y);
  }
  bool Combine(int z, const double* a, int x, const double* b, int y) override
  {
    return this->Superclass::Combine(z, a, x, b, y) && this->Round(z);
  }
  bool Scale(int z, int x, int y) override
  {
    return this->Superclass::Scale(z, x, y) && this->Round(z);
  }

private:
  bool Round(int slot)
  {
    for (double& value : *this->FindVector(slot))
    {
      value = static_cast<float>(value);
    }
    return true;
  }

  vtkNew<vtkExchangeMatrix> Copy;
};
vtkStandardNewMacro(SinglePrecisionLinks);

//------------------------------------------------------------------------------
// Corrected in double precision, single precision reaches any tolerance, with the help of the CPU
// where it takes 0.999999 for more than 1; no iteration is reported twice.
void TestSinglePrecision()
{
  Case cube(MakeRoom(8), true);
  cube.LetEmit(64);
  for (const double rho : { 0.5, 0.99, 0.999, 0.999999 })
  {
    cube.SetReflectance([&](vtkIdType) { return rho; });
    const Vector exact = cube.GetExact();
    for (const int solver : { vtkRadiosity::SOLVER_JACOBI, vtkRadiosity::SOLVER_CHEBYSHEV,
           vtkRadiosity::SOLVER_CONJUGATE_GRADIENT })
    {
      if (rho > 0.99 && solver != vtkRadiosity::SOLVER_CONJUGATE_GRADIENT)
      {
        continue;
      }
      const std::string what = std::string(SolverTable::GetName(solver)) +
        " in single precision at " + std::to_string(rho);
      vtkNew<SinglePrecisionLinks> links;
      Task task = cube.MakeTask(solver);
      Check(links->Take(cube.Exchange), "links");
      task.Equation.Operator = links;
      task.Settings.Tolerance = 1e-8;
      int last = -1;
      task.Settings.Report = [&](int iteration, double, double)
      {
        Check(iteration == last + 1, what + ": each iteration once");
        last = iteration;
        return true;
      };
      const Answer solution = task.Solve();
      Check(solution.HasConverged() && last == solution.NumberOfIterations,
        what + " converges: " + solution.Warning);
      double error = 0.0;
      for (vtkIdType patch = 0; patch < cube.GetNumberOfPatches(); ++patch)
      {
        error = std::max(error, std::abs(solution.Radiosity[patch] - exact[patch]));
      }
      Check(error <= solution.ErrorBound && solution.ErrorBound <= 1.1e-8 * exact.maxCoeff(),
        what + " is as exact as in double: " + std::to_string(error / exact.maxCoeff()));
      const bool onDevice = solution.Explanation.find("single precision") == std::string::npos;
      Check(onDevice || rho > 0.9999, what + " needs no help: " + solution.Explanation);
    }
  }
}

//------------------------------------------------------------------------------
// Auto goes by the number of products.
void TestAuto()
{
  Case cube(MakeRoom(3), true);
  cube.LetEmit(5);
  for (const double rho : { 0.0, 0.02, 0.5, 0.99 })
  {
    cube.SetReflectance([&](vtkIdType) { return rho; });
    const Answer chosen = cube.MakeTask(vtkRadiosity::SOLVER_AUTO).Solve();
    const int expected =
      rho < 0.1 ? vtkRadiosity::SOLVER_JACOBI : vtkRadiosity::SOLVER_CONJUGATE_GRADIENT;
    Check(chosen.HasConverged() && chosen.Solver == expected, "Auto at " + std::to_string(rho));
    const SolverEntry* entry = SolverTable::Find(chosen.Solver, vtkRadiosity::DEVICE_CPU);
    Check(entry && entry->EstimateProducts, "Auto takes one that tells its cost");
    Check(chosen.Explanation.find(std::string(SolverTable::GetName(expected)) + ": ") == 0,
      "Auto explains: " + chosen.Explanation);
    for (const int other : { vtkRadiosity::SOLVER_JACOBI, vtkRadiosity::SOLVER_CONJUGATE_GRADIENT })
    {
      const Answer solution = cube.MakeTask(other).Solve();
      Check(chosen.NumberOfIterations <= solution.NumberOfIterations + 1, "Auto is no slower");
      Check(solution.Explanation.find("asked for") != std::string::npos,
        "a choice needs no reason");
    }
  }
}

//------------------------------------------------------------------------------
// Every number of vtkRadiosity has an entry with the name that the filter shows.
void TestNumbers()
{
  vtkNew<vtkRadiosity> filter;
  for (int type = filter->GetSolverMinValue(); type <= filter->GetSolverMaxValue(); ++type)
  {
    const std::string what = "solver " + std::to_string(type);
    filter->SetSolver(type);
    std::ostringstream text;
    filter->PrintSelf(text, vtkIndent());
    for (const int device :
      { vtkRadiosity::DEVICE_AUTO, vtkRadiosity::DEVICE_CPU, vtkRadiosity::DEVICE_OPENGL })
    {
      const SolverEntry* entry = SolverTable::Find(type, device);
      Check(entry && entry->Type == type, what + " has an entry");
      Check(entry &&
          text.str().find(std::string("Solver: ") + entry->Name + "\n") < std::string::npos,
        what + " has the name that is shown");
      Check(entry && (entry->NeedsLinks() || device == vtkRadiosity::DEVICE_OPENGL),
        what + " needs links where no device finds them");
    }
  }
}

//------------------------------------------------------------------------------
// Every entry can be found, runs in one way, and is the only one of its kind.
void TestEntries()
{
  vtkNew<vtkRadiosity> filter;
  std::set<std::pair<int, bool>> kinds;
  std::set<std::pair<std::string, bool>> names;
  for (const SolverEntry* entry : SolverTable::GetAll())
  {
    const std::string what = entry->Name;
    const int device = entry->NeedsLinks() ? vtkRadiosity::DEVICE_CPU : vtkRadiosity::DEVICE_OPENGL;
    Check(SolverTable::Find(entry->Type, device) == entry, what + " is found");
    Check(entry->Type >= filter->GetSolverMinValue() && entry->Type <= filter->GetSolverMaxValue(),
      what + " has a number of the filter");
    Check(kinds.emplace(entry->Type, entry->NeedsLinks()).second &&
        names.emplace(what, entry->NeedsLinks()).second,
      what + " is there once");
    const bool isAuto = entry->Type == vtkRadiosity::SOLVER_AUTO;
    Check((entry->Iterate != nullptr) == (entry->NeedsLinks() && !isAuto) &&
        (entry->Shoot != nullptr) == !entry->NeedsLinks(),
      what + " runs in one way");
    Check(!entry->EstimateProducts || entry->Iterate, what + " can be what Auto takes");
  }
  const SolverEntry* shots =
    SolverTable::Find(vtkRadiosity::SOLVER_SOUTHWELL, vtkRadiosity::DEVICE_OPENGL);
  Check(shots && !shots->NeedsLinks() && !shots->NeedsOneCPU(), "Southwell shoots on OpenGL");
}

//------------------------------------------------------------------------------
// A number without a solver is an error, not a default.
void TestUnknown()
{
  Case cube(MakeRoom(1), true);
  cube.LetEmit(1);
  for (const int type : { -1, vtkNew<vtkRadiosity>()->GetSolverMaxValue() + 1 })
  {
    Check(!SolverTable::Find(type, vtkRadiosity::DEVICE_AUTO) &&
        !SolverTable::Find(type, vtkRadiosity::DEVICE_OPENGL),
      "there is no solver " + std::to_string(type));
    const Answer solution = cube.MakeTask(type).Solve();
    Check(solution.Ended.GetMessage().find("There is no solver " + std::to_string(type)) == 0 &&
        solution.Ended.GetMessage().find("5 (ConjugateGradient)") != std::string::npos,
      "an unknown number is refused: " + solution.Ended.GetMessage());
    Check(solution.Radiosity.empty(), "and nothing runs");
  }
}

//------------------------------------------------------------------------------
void ExpectEnd(const Task& task, SolverStatus status, const std::string& remedy)
{
  const Answer solution = task.Solve();
  const std::string what =
    std::string(SolverTable::GetName(task.Settings.Solver)) + ": " + GetName(status);
  Check(solution.Status == status, what + ", not " + GetName(solution.Status));
  Check(solution.Warning.find(remedy) != std::string::npos, what + " warns: " + solution.Warning);
  Check(solution.Ended.IsAborted() == (status == SolverStatus::Aborted),
    what + " is aborted where it says so");
  Check(!solution.Ended.HasFailed() && solution.Radiosity.size() == task.Equation.Emission.size(),
    what + " leaves the result so far");
}

//------------------------------------------------------------------------------
// Each way to end has its name and its remedy.
void TestEndings()
{
  Case cube(MakeRoom(3), true);
  cube.LetEmit(5);
  cube.SetReflectance([](vtkIdType) { return 0.9; });
  // Row sums that are not those of the matrix: 1.08 is reflected and the bound does not know.
  Case unstable(MakeRoom(3), true);
  unstable.LetEmit(5);
  unstable.SetReflectance([](vtkIdType) { return 0.9; });
  for (vtkExchangeMatrix::Tile& tile : unstable.Exchange->GetTiles())
  {
    std::transform(tile.Values,
      tile.Values + vtkExchangeMatrix::TileSize * vtkExchangeMatrix::TileSize, tile.Values,
      [](float value) { return 1.2f * value; });
  }
  for (const int solver : GetSolvers())
  {
    Task hasty = cube.MakeTask(solver);
    hasty.Settings.Tolerance = 1e-12;
    hasty.Settings.MaximumNumberOfIterations = 2;
    ExpectEnd(hasty, SolverStatus::IterationsUsedUp, "MaximumNumberOfIterations");
    Task tight = cube.MakeTask(solver);
    tight.Settings.Tolerance = 1e-15;
    ExpectEnd(tight, SolverStatus::Stagnated, "Raise Tolerance");
    Task stopped = cube.MakeTask(solver);
    stopped.Settings.Report = [](int iteration, double, double) { return iteration < 1; };
    ExpectEnd(stopped, SolverStatus::Aborted, "");
    ExpectEnd(unstable.MakeTask(solver), SolverStatus::Diverged, "EnforceClosure");
  }
}

//------------------------------------------------------------------------------
void ExpectError(const Task& task, const std::vector<std::string>& parts)
{
  const Answer solution = task.Solve();
  for (const std::string& part : parts)
  {
    Check(solution.Ended.GetMessage().find(part) != std::string::npos,
      "\"" + part + "\" in \"" + solution.Ended.GetMessage() + "\"");
  }
}

//------------------------------------------------------------------------------
// What cannot be solved is named with its place.
void TestNoSolution()
{
  Case cube(MakeRoom(3), true);
  cube.LetEmit(5);
  cube.SetReflectance([](vtkIdType) { return 1.0; });
  ExpectError(cube.MakeTask(0),
    { "no unique solution: polygon ", "(reflectance 1, view factors that sum to 1)",
      "closed part" });
  // Two bands, of which the second is the one.
  Task bands = cube.MakeTask(0, 2);
  for (std::size_t k = 0; k < bands.Equation.Reflectance.size(); k += 2)
  {
    bands.Equation.Reflectance[k] = 0.7;
  }
  ExpectError(bands, { ", band 1 (reflectance 1" });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeTwoRooms()
{
  Surface rooms;
  for (const double x : { 0.0, 3.0 })
  {
    rooms.AddGrid({ x, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
    rooms.AddGrid({ x, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
    rooms.AddGrid({ x, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, 1, 1);
    rooms.AddGrid({ x, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 1, 1);
    rooms.AddGrid({ x, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 1, 1);
    rooms.AddGrid({ x + 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, 1, 1);
  }
  return rooms.Get();
}

//------------------------------------------------------------------------------
// Of two rooms the one whose rows sum to too much is named.
void TestOverfullRoom()
{
  Case two(MakeTwoRooms(), true);
  two.LetEmit(1);
  two.SetReflectance([](vtkIdType polygon) { return polygon < 6 ? 0.9 : 0.8; });
  for (vtkIdType i = 6; i < 12; ++i)
  {
    for (vtkIdType j = 6; j < 12; ++j)
    {
      const vtkIdType a = two.Scene.GetPatch(i), b = two.Scene.GetPatch(j);
      vtkExchangeMatrix::SetValue(two.Exchange->GetTiles()[0], static_cast<int>(a),
        static_cast<int>(b), 0, 1.3 * two.Exchange->GetAreas()[a] * two.F(a, b));
    }
  }
  std::vector<double> sums = two.Factors.GetLinks().RowSums;
  for (vtkIdType i = 6; i < 12; ++i)
  {
    sums[two.Scene.GetPatch(i)] = 1.3;
  }
  Task overfull = two.MakeTask(0);
  overfull.Equation.RowSums = &sums;
  const Answer solution = overfull.Solve();
  ExpectError(overfull,
    { "no unique solution", "(reflectance 0.8, view factors that sum to 1.3)",
      "returns more than it receives" });
  const std::string number =
    solution.Ended.GetMessage().substr(solution.Ended.GetMessage().find("polygon ") + 8, 2);
  Check(std::atoi(number.c_str()) >= 6,
    "the place is in the second room: " + solution.Ended.GetMessage());
  // At 0.7 it can be solved, and users hear of the row.
  two.SetReflectance([](vtkIdType) { return 0.7; });
  overfull = two.MakeTask(0);
  overfull.Equation.RowSums = &sums;
  const Answer doubtful = overfull.Solve();
  Check(doubtful.HasConverged() &&
      doubtful.Warning.find("arrives more than once") != std::string::npos,
    "a row above 1 is named: " + doubtful.Warning);
}

//------------------------------------------------------------------------------
// View factors that are not good enough.
void TestVagueViewFactors()
{
  Case cube(MakeRoom(3), true);
  cube.LetEmit(5);
  cube.SetReflectance([](vtkIdType) { return 0.9999; });
  Task vague = cube.MakeTask(0);
  vague.Equation.RowSumErrors.assign(vague.Equation.NumberOfPatches, 1e-3);
  // Where no row exceeds 1 there is a solution, however doubtful.
  const Answer doubted = vague.Solve();
  Check(doubted.HasConverged() && doubted.Warning.find("EnforceClosure") != std::string::npos,
    "view factors that tell little: " + doubted.Warning);
  std::vector<double> fuller = *vague.Equation.RowSums;
  fuller[0] = 1.00005;
  vague.Equation.RowSums = &fuller;
  ExpectError(vague, { "no unique solution within that error", "EnforceClosure" });
  vague = cube.MakeTask(0);
  vague.Equation.RowSumErrors.assign(vague.Equation.NumberOfPatches, 3e-5);
  const Answer uncertain = vague.Solve();
  Check(uncertain.HasConverged() &&
      uncertain.Warning.find("B may be wrong by 3") != std::string::npos,
    "errors of view factors are amplified: " + uncertain.Warning);
  // One row of 54 that is poorly known is a small part of the scene.
  vague = cube.MakeTask(0);
  vague.Equation.RowSumErrors[7] = 54.0 * 3e-5;
  const Answer single = vague.Solve();
  Check(single.HasConverged() && single.Warning.find("B may be wrong by 3") != std::string::npos,
    "the error of a row weighs by its area: " + single.Warning);
}
} // namespace

//------------------------------------------------------------------------------
int TestRadiositySolvers(int, char*[])
{
  TestCube();
  TestPlates();
  TestAnswers();
  TestSinglePrecision();
  TestAuto();
  TestNumbers();
  TestEntries();
  TestUnknown();
  TestEndings();
  TestNoSolution();
  TestOverfullRoom();
  TestVagueViewFactors();
  return Result();
}
