// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The comparison of Carr, Hall and Hart (Graphics Hardware 2003), as rows of a table: their Jacobi
 * iteration in ceil(n / 254) unrolled passes and one more, their Gauss-Seidel iteration in n
 * passes, both as shaders beside this file; Gauss-Seidel as a plain loop on the CPU; and what
 * vtkLightTransport does. Of each the iterations and CPU seconds until no radiosity is off by more
 * than 1e-4 of the largest, and what an iteration amounts to: 2 n^2 operations, and 4 n^2 bytes of
 * a full matrix (of which ours stores and reads one triangle).
 *
 * A closed room of 6 walls of 17 x 15 squares, four of which shine; reflectance 0.7, one band.
 *
 * Not a test: times depend on the machine. CPU seconds of all threads say what a software renderer
 * does; of a GPU they say nothing.
 */
#include "Context/OpenGLFunctions.h"
#include "LightTransportPaperEmitFS.h"
#include "LightTransportPaperGaussSeidelFS.h"
#include "LightTransportPaperJacobiFS.h"
#include "LightTransportTesting.h"
#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/RadiositySolution.h"
#include "Radiosity/RadiositySolver.h"
#include "Radiosity/SolverSettings.h"
#include "ShaderPass.h"
#include "ViewFactorTesting.h"
#include "vtkDenseLinkOperator.h"
#include "vtkExchangeMatrix.h"
#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkOpenGLLinkOperator.h"
#include "vtkRadiosity.h"
#include "vtkSMPTools.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkViewFactors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

using namespace LightTransport;

namespace
{
constexpr double Accuracy = 1e-4;
constexpr double Reflectance = 0.7;
constexpr int MostIterations = 200;
constexpr int ColumnsPerPass = 254;
// Of one measurement.
constexpr double LeastSeconds = 1.0;

/// The scene: full, row by row, in the order of the patches.
struct Problem
{
  int Size = 0;
  std::vector<double> Areas;
  std::vector<double> Emission;
  std::vector<float> Matrix; ///< rho F
  std::vector<double> Exact; ///< radiosity
};

/// One way to solve.
class Method
{
public:
  virtual ~Method() = default;
  /// From the start, that many iterations; true once what they have done is there.
  virtual bool Iterate(int iterations) = 0;
  virtual std::vector<double> GetRadiosity() = 0;
};

//------------------------------------------------------------------------------
std::vector<double> SolveExactly(const Problem& problem)
{
  std::vector<double> radiosity = problem.Emission;
  double change = 1.0;
  while (change > 1e-13)
  {
    change = 0.0;
    for (int i = 0; i < problem.Size; ++i)
    {
      double sum = problem.Emission[i];
      const float* row = problem.Matrix.data() + std::size_t(i) * problem.Size;
      for (int j = 0; j < problem.Size; ++j)
      {
        sum += static_cast<double>(row[j]) * radiosity[j];
      }
      change = std::max(change, std::abs(sum - std::exchange(radiosity[i], sum)));
    }
  }
  return radiosity;
}

//------------------------------------------------------------------------------
Problem MakeProblem()
{
  using LightTransportTesting::Point;
  LightTransportTesting::Surface room;
  const auto addPair =
    [&room](const Point& corner, const Point& opposite, const Point& u, const Point& v)
  {
    room.AddGrid(corner, u, v, 17, 15);
    room.AddGrid(opposite, v, u, 15, 17);
  };
  addPair({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 });
  addPair({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 });
  addPair({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 });
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(room.Get());
  factors->SetTolerance(1e-5);
  factors->SetEnforceClosure(true);
  factors->Update();

  Problem problem;
  problem.Areas = LightTransportTesting::GetAreas(room.Get());
  problem.Size = static_cast<int>(problem.Areas.size());
  problem.Emission.assign(problem.Size, 0.0);
  // The middle of the second wall, the ceiling.
  for (const int square : { 7 * 17 + 7, 7 * 17 + 8, 8 * 17 + 7, 8 * 17 + 8 })
  {
    problem.Emission[17 * 15 + square] = 1.0;
  }
  for (int i = 0; i < problem.Size; ++i)
  {
    for (int j = 0; j < problem.Size; ++j)
    {
      problem.Matrix.push_back(static_cast<float>(Reflectance * factors->GetViewFactor(i, j)));
    }
  }
  problem.Exact = SolveExactly(problem);
  return problem;
}

//------------------------------------------------------------------------------
double GetError(const std::vector<double>& radiosity, const std::vector<double>& exact)
{
  double error = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k)
  {
    error = std::max(error, std::abs(radiosity[k] - exact[k]));
    largest = std::max(largest, exact[k]);
  }
  return error / largest;
}

/// A plain loop in single precision, with as many sums as the widest vectors have lanes.
class PlainGaussSeidel : public Method
{
public:
  explicit PlainGaussSeidel(const Problem& problem)
    : Emission(problem.Emission.begin(), problem.Emission.end()), Matrix(problem.Matrix)
  {
  }

  bool Iterate(int iterations) override
  {
    this->Radiosity = this->Emission;
    for (int k = 0; k < iterations; ++k)
    {
      for (std::size_t i = 0; i < this->Radiosity.size(); ++i)
      {
        this->Radiosity[i] = this->Emission[i] + this->Multiply(i);
      }
    }
    return true;
  }
  std::vector<double> GetRadiosity() override
  {
    return { this->Radiosity.begin(), this->Radiosity.end() };
  }

private:
  float Multiply(std::size_t i) const
  {
    constexpr std::size_t lanes = 16;
    const std::size_t size = this->Radiosity.size();
    const float* row = this->Matrix.data() + i * size;
    std::array<float, lanes> sums{};
    std::size_t j = 0;
    for (; j + lanes <= size; j += lanes)
    {
      for (std::size_t lane = 0; lane < lanes; ++lane)
      {
        sums[lane] += row[j + lane] * this->Radiosity[j + lane];
      }
    }
    for (; j < size; ++j)
    {
      sums[0] += row[j] * this->Radiosity[j];
    }
    float sum = 0.0f;
    for (const float part : sums)
    {
      sum += part;
    }
    return sum;
  }

  std::vector<float> Emission;
  const std::vector<float>& Matrix;
  std::vector<float> Radiosity;
};

/// What both of the paper's shaders need: one component to a patch, in a line; the matrix is wider
/// than it is high, by zeros.
class PaperMethod : public Method
{
public:
  PaperMethod(vtkOpenGLRenderWindow* window, const Problem& problem)
    : Window(window), Size(problem.Size),
      Passes((problem.Size + ColumnsPerPass - 1) / ColumnsPerPass)
  {
    const int width = this->Passes * ColumnsPerPass;
    std::vector<float> matrix(std::size_t(width) * this->Size, 0.0f);
    for (int row = 0; row < this->Size; ++row)
    {
      std::copy_n(problem.Matrix.begin() + std::ptrdiff_t(row) * this->Size, this->Size,
        matrix.begin() + std::ptrdiff_t(row) * width);
    }
    std::vector<float> emission(problem.Emission.begin(), problem.Emission.end());
    emission.resize(width, 0.0f);
    this->Matrix = ShaderPass::MakeTexture(window, width, this->Size, 1, matrix.data());
    this->Emission = ShaderPass::MakeTexture(window, width, 1, 1, emission.data());
    for (auto* texture : { &this->Radiosity, &this->Sums[0], &this->Sums[1] })
    {
      *texture = ShaderPass::MakeTexture(window, width, 1, 1, nullptr);
    }
  }

  std::vector<double> GetRadiosity() override
  {
    std::vector<float> values(this->Radiosity->GetWidth());
    this->Radiosity->Activate();
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, values.data());
    this->Radiosity->Deactivate();
    return { values.begin(), values.begin() + this->Size };
  }

protected:
  void Begin(vtkTextureObject* texture)
  {
    // What is emitted is the first radiosity.
    this->Emit.Begin(texture);
    this->Emit.Draw({ { "emission", this->Emission }, { "sum", this->Zero } }, 0, this->Size, 1,
      [](vtkShaderProgram*) {});
    this->Emit.End(false);
  }

  vtkOpenGLRenderWindow* Window;
  const int Size;
  const int Passes;
  vtkSmartPointer<vtkTextureObject> Matrix;
  vtkSmartPointer<vtkTextureObject> Emission;
  vtkSmartPointer<vtkTextureObject> Radiosity;
  vtkSmartPointer<vtkTextureObject> Sums[2];
  vtkSmartPointer<vtkTextureObject> Zero =
    ShaderPass::MakeTexture(this->Window, this->Passes* ColumnsPerPass, 1, 1, nullptr);
  ShaderPass Emit{ this->Window, LightTransportPaperEmitFS };
};

class PaperJacobi : public PaperMethod
{
public:
  using PaperMethod::PaperMethod;

  bool Iterate(int iterations) override
  {
    this->Begin(this->Radiosity);
    for (int k = 0; k < iterations; ++k)
    {
      vtkTextureObject* sum = this->Zero;
      for (int pass = 0; pass < this->Passes; ++pass)
      {
        vtkTextureObject* next = this->Sums[pass % 2];
        this->Step.Begin(next);
        this->Step.Draw(
          { { "matrix", this->Matrix }, { "radiosity", this->Radiosity }, { "sum", sum } }, 0,
          this->Size, 1,
          [pass](vtkShaderProgram* program)
          { program->SetUniformi("first", pass * ColumnsPerPass); });
        this->Step.End(false);
        sum = next;
      }
      this->Emit.Begin(this->Radiosity);
      this->Emit.Draw({ { "emission", this->Emission }, { "sum", sum } }, 0, this->Size, 1,
        [](vtkShaderProgram*) {});
      this->Emit.End(k + 1 == iterations);
    }
    return true;
  }

private:
  ShaderPass Step{ this->Window, LightTransportPaperJacobiFS };
};

/// A pass draws one patch; what it wrote is copied to where the others read it, since no shader may
/// read what it draws into.
class PaperGaussSeidel : public PaperMethod
{
public:
  using PaperMethod::PaperMethod;

  bool Iterate(int iterations) override
  {
    this->Begin(this->Radiosity);
    this->Step.Begin(this->Sums[0]);
    for (int pass = 0; pass < iterations * this->Size; ++pass)
    {
      const int row = pass % this->Size;
      this->Step.Draw({ { "matrix", this->Matrix }, { "radiosity", this->Radiosity },
                        { "emission", this->Emission } },
        row, 1, 1,
        [this](vtkShaderProgram* program) { program->SetUniformi("columns", this->Size); });
      this->Radiosity->Activate();
      glCopyTexSubImage2D(GL_TEXTURE_2D, 0, row, 0, row, 0, 1, 1);
      this->Radiosity->Deactivate();
    }
    this->Step.End();
    return true;
  }

private:
  ShaderPass Step{ this->Window, LightTransportPaperGaussSeidelFS };
};

/// A solver of vtkRadiosity, error bound and all, on the CPU or a device.
class OurMethod : public Method
{
public:
  OurMethod(const Problem& problem, int solver, vtkExchangeMatrix* matrix, vtkLinkOperator* links)
  {
    this->Reference->Initialize(matrix, 1);
    this->RowSums.assign(problem.Size, 1.0);
    this->Equation.Operator = links ? links : this->Reference;
    this->Equation.Reference = this->Reference;
    this->Equation.Areas = &matrix->GetAreas();
    this->Equation.RowSums = &this->RowSums;
    this->Equation.RowSumErrors.assign(problem.Size, 1e-6);
    this->Equation.NumberOfPatches = problem.Size;
    this->Equation.NumberOfBands = 1;
    this->Equation.Emission = problem.Emission;
    this->Equation.Reflectance.assign(problem.Size, Reflectance);
    this->Settings.Solver = solver;
    this->Settings.Tolerance = 1e-15;
    this->Settings.Report = [](int, double, double) { return true; };
  }

  bool Iterate(int iterations) override
  {
    this->Settings.MaximumNumberOfIterations = iterations;
    return static_cast<bool>(
      RadiositySolver::Solve(this->Equation, this->Settings, this->Solution));
  }
  std::vector<double> GetRadiosity() override { return this->Solution.Radiosity; }

private:
  vtkNew<vtkDenseLinkOperator> Reference;
  std::vector<double> RowSums;
  RadiosityEquation Equation;
  SolverSettings Settings;
  RadiositySolution Solution;
};

//------------------------------------------------------------------------------
bool FillMatrix(const Problem& problem, vtkExchangeMatrix* matrix)
{
  constexpr int size = vtkExchangeMatrix::TileSize;
  if (!matrix->Allocate(problem.Areas, 1))
  {
    return false;
  }
  for (vtkExchangeMatrix::Tile& tile : matrix->GetTiles())
  {
    const auto firstRow = static_cast<int>(tile.Row) * size;
    const auto firstColumn = static_cast<int>(tile.Column) * size;
    for (int i = firstRow; i < std::min(firstRow + size, problem.Size); ++i)
    {
      for (int j = std::max(firstColumn, tile.Row == tile.Column ? i : 0);
           j < std::min(firstColumn + size, problem.Size); ++j)
      {
        const double factor =
          static_cast<double>(problem.Matrix[std::size_t(i) * problem.Size + j]) / Reflectance;
        vtkExchangeMatrix::SetValue(tile, i - firstRow, j - firstColumn, 0,
          problem.Areas[i] * factor);
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/// CPU seconds of one go, the mean of several.
double GetCPUSeconds(Method& method, int iterations)
{
  int runs = 0;
  const std::clock_t begin = std::clock();
  double seconds = 0.0;
  while (seconds < LeastSeconds)
  {
    method.Iterate(iterations);
    ++runs;
    seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }
  return seconds / runs;
}

//------------------------------------------------------------------------------
bool Measure(const std::string& name, Method& method, const Problem& problem, double matrixBytes)
{
  int iterations = 1;
  while (iterations <= MostIterations && method.Iterate(iterations) &&
    GetError(method.GetRadiosity(), problem.Exact) > Accuracy)
  {
    ++iterations;
  }
  const double error = GetError(method.GetRadiosity(), problem.Exact);
  const double seconds = GetCPUSeconds(method, iterations);
  const double rate = iterations / seconds;
  const double pairs = static_cast<double>(problem.Size) * problem.Size;
  std::cout << std::left << std::setw(46) << name << std::right << std::fixed << std::setw(6)
            << iterations << std::setprecision(1) << std::setw(11) << rate << std::setprecision(2)
            << std::setw(10) << 2e-9 * pairs * rate << std::setw(10) << 1e-9 * matrixBytes * rate
            << std::setprecision(4) << std::setw(10) << seconds << std::scientific
            << std::setprecision(0) << std::setw(8) << error << std::endl;
  return error <= Accuracy;
}

//------------------------------------------------------------------------------
bool Run()
{
  const Problem problem = MakeProblem();
  vtkNew<vtkExchangeMatrix> matrix;
  if (!FillMatrix(problem, matrix))
  {
    std::cerr << "Not enough memory for a matrix of " << problem.Size << " patches.\n";
    return false;
  }
  vtkNew<vtkOffScreenOpenGLRenderWindow> window;
  window->SetSize(16, 16);
  window->Initialize();
  const double full = 4.0 * problem.Size * problem.Size;
  const double triangle = matrix->GetNumberOfBytes();
  std::cout << problem.Size << " patches, error " << Accuracy << ", CPU seconds of all threads\n"
            << std::left << std::setw(46) << "method" << std::right << std::setw(6) << "iter."
            << std::setw(11) << "per s" << std::setw(10) << "Gflop/s" << std::setw(10) << "GB/s"
            << std::setw(10) << "seconds" << std::setw(8) << "error"
            << "\n";
  bool done = true;
  {
    PaperJacobi jacobi(window, problem);
    done = Measure("paper: Jacobi, OpenGL, 254 products a pass", jacobi, problem, full) && done;
    PaperGaussSeidel seidel(window, problem);
    done = Measure("paper: Gauss-Seidel, OpenGL, n passes", seidel, problem, full) && done;
    PlainGaussSeidel plain(problem);
    done = Measure("paper: Gauss-Seidel, CPU, plain loop", plain, problem, full) && done;
  }
  vtkNew<vtkOpenGLLinkOperator> device;
  device->SetRenderWindow(window);
  if (!device->Initialize(matrix, 1))
  {
    return false;
  }
  for (const auto& [name, solver] :
    { std::pair<std::string, int>{ "Jacobi", vtkRadiosity::SOLVER_JACOBI },
      { "Gauss-Seidel", vtkRadiosity::SOLVER_GAUSS_SEIDEL },
      { "ConjugateGradient", vtkRadiosity::SOLVER_CONJUGATE_GRADIENT } })
  {
    OurMethod onCPU(problem, solver, matrix, nullptr);
    done = Measure("vtkRadiosity: " + name + ", CPU", onCPU, problem, triangle) && done;
    if (solver != vtkRadiosity::SOLVER_GAUSS_SEIDEL)
    {
      OurMethod onDevice(problem, solver, matrix, device);
      done = Measure("vtkRadiosity: " + name + ", OpenGL", onDevice, problem, full) && done;
    }
  }
  return done;
}
} // namespace

//------------------------------------------------------------------------------
int main(int, char*[])
{
  bool done = false;
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 0, "STDThread", false }, [&]() { done = Run(); });
  return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
