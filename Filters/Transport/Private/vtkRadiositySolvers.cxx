// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiositySolvers.h"

#include "vtkCPULinkOperator.h"
#include "vtkDenseLinkOperator.h"
#include "vtkRadiosity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
// Where some 1 - rho * row sum is below this, w = 1 gives a poor bound or none, and a better w is
// worth a few products.
constexpr double SmallDominance = 1e-2;
// How well w must solve its system: d = 1 - residual is then at least 0.9.
constexpr double BoundTolerance = 0.1;
constexpr int MaximumBoundIterations = 200;
// Corrections of a single precision result; each gains the digits that single precision has.
constexpr int MaximumCorrections = 6;
// A residual that has not fallen for so many iterations will not fall. Single precision reaches its
// floor abruptly, and the correction in double precision that follows is worth more than waiting.
constexpr int StagnationLimit = 50;
constexpr int StagnationLimitSinglePrecision = 5;

// Reflectances closer to 1 than single precision view factors can tell.
constexpr double FullReflectance = 1e-7;

enum Slot
{
  SOURCE,       // E
  REFLECTION,   // rho / A
  SYMMETRIC,    // sqrt(rho / A)
  BOUND_WEIGHT, // 1 / d
  SOLUTION,     // B
  RESIDUAL,     // E + rho F B - B
  UNKNOWN,      // y of the symmetrised system
  DIRECTION,
  IMAGE,
  SCRATCH
};

using Bands = std::vector<double>;

//------------------------------------------------------------------------------
// The state that the solvers share: vectors in their slots, the error bound, and when to stop.
class Iteration
{
public:
  Iteration(const vtkRadiosityProblem& problem, vtkLinkOperator* links, const double* source)
    : Problem(problem), Links(links), Ones(problem.NumberOfBands, 1.0),
      MinusOnes(problem.NumberOfBands, -1.0), Zeros(problem.NumberOfBands, 0.0),
      Scales(problem.NumberOfBands, 0.0), BoundScales(problem.NumberOfBands, 1.0),
      Smallest(problem.NumberOfBands, Infinity)
  {
    const std::size_t size = problem.Reflectance.size();
    std::vector<double> reflection(size), symmetric(size);
    for (std::size_t k = 0; k < size; ++k)
    {
      reflection[k] = problem.Reflectance[k] / (*problem.Areas)[k / problem.NumberOfBands];
      symmetric[k] = std::sqrt(reflection[k]);
    }
    this->Ok = links->SetVector(SOURCE, source) &&
      links->SetVector(REFLECTION, reflection.data()) &&
      links->SetVector(SYMMETRIC, symmetric.data());
  }

  // image = M x, M = I - (rho / A) G.
  bool ApplyMatrix(int image, int x)
  {
    return this->Links->Multiply(image, x) && this->Links->Scale(image, REFLECTION, image) &&
      this->Links->Combine(image, this->Ones.data(), x, this->MinusOnes.data(), image);
  }

  bool ComputeResidual()
  {
    return this->ApplyMatrix(RESIDUAL, SOLUTION) &&
      this->Links->Combine(RESIDUAL, this->Ones.data(), SOURCE, this->MinusOnes.data(), RESIDUAL);
  }

  // The bound from RESIDUAL and SOLUTION; false when there is nothing left to do (converged,
  // stagnated, used up, aborted).
  bool Continue()
  {
    const int bands = this->Problem.NumberOfBands;
    Bands residuals(bands), bounds(bands), sizes(bands);
    this->Ok = this->Ok && this->Links->MaxNorm(RESIDUAL, residuals.data()) &&
      this->Links->Scale(SCRATCH, RESIDUAL, BOUND_WEIGHT) &&
      this->Links->MaxNorm(SCRATCH, bounds.data()) && this->Links->MaxNorm(SOLUTION, sizes.data());
    bool reached = true;
    bool falling = false;
    bool finite = true;
    double residual = 0.0;
    this->ErrorBound = 0.0;
    for (int band = 0; band < bands; ++band)
    {
      const double bound = bounds[band] * this->BoundScales[band];
      const double size = std::max(sizes[band], this->Scales[band]);
      // Written so that a NaN does not pass for an answer.
      const bool bandReached = bound <= this->Problem.Tolerance * size;
      reached = reached && bandReached;
      // Bands apart: one that is done, or as far as it goes, does not end the others.
      falling = falling || (!bandReached && residuals[band] < 0.999 * this->Smallest[band]);
      this->Smallest[band] = std::min(this->Smallest[band], residuals[band]);
      residual = std::max(residual, residuals[band]);
      finite = finite && std::isfinite(residuals[band]);
      this->ErrorBound = bound >= this->ErrorBound ? bound : this->ErrorBound;
    }
    this->Converged = reached;
    this->Aborted = !this->Problem.Report(this->Count, residual, this->ErrorBound);
    this->SinceSmallest = falling ? 1 : this->SinceSmallest + 1;
    return this->Ok && !this->Converged && !this->Aborted && finite &&
      this->SinceSmallest <= this->GetStagnationLimit() &&
      this->Count < this->Problem.MaximumNumberOfIterations;
  }

  int GetStagnationLimit() const
  {
    return this->Links->IsSinglePrecision() ? StagnationLimitSinglePrecision : StagnationLimit;
  }

  const vtkRadiosityProblem& Problem;
  vtkLinkOperator* Links;
  Bands Ones, MinusOnes, Zeros;
  Bands Scales;      // sizes of B that a correction is measured against
  Bands BoundScales; // largest w
  Bands SpectralRadii;
  Bands Smallest; // residuals so far
  int Count = 0;
  double ErrorBound = Infinity;
  int SinceSmallest = 0;
  bool Ok = true;
  bool Converged = false;
  bool Aborted = false;
};

//------------------------------------------------------------------------------
void IterateJacobi(Iteration& state)
{
  vtkLinkOperator* links = state.Links;
  while (state.Ok && (state.Ok = state.ComputeResidual()) && state.Continue())
  {
    state.Ok = links->Combine(SOLUTION, state.Ones.data(), SOLUTION, state.Ones.data(), RESIDUAL);
    ++state.Count;
  }
}

//------------------------------------------------------------------------------
void IterateGaussSeidel(Iteration& state)
{
  auto* links = static_cast<vtkDenseLinkOperator*>(state.Links);
  while (state.Ok && (state.Ok = state.ComputeResidual()) && state.Continue())
  {
    state.Ok = links->Sweep(SOLUTION, SOURCE, REFLECTION);
    ++state.Count;
  }
}

//------------------------------------------------------------------------------
// Shoot from the patch with the most unshot power, again and again; as many shots as patches count
// as one iteration. Unlike the others it keeps its residual up to date shot by shot.
void IterateSouthwell(Iteration& state)
{
  const vtkRadiosityProblem& problem = state.Problem;
  const vtkIdType patches = problem.NumberOfPatches;
  const int bands = problem.NumberOfBands;
  auto* links = static_cast<vtkCPULinkOperator*>(state.Links);
  std::vector<double> unshot(patches * bands), radiosity(patches * bands), row(patches);
  const auto power = [&](vtkIdType patch)
  {
    double sum = 0.0;
    for (int band = 0; band < bands; ++band)
    {
      sum += std::abs(unshot[patch * bands + band]);
    }
    return sum * (*problem.Areas)[patch];
  };
  while (state.Ok && (state.Ok = state.ComputeResidual()) && state.Continue())
  {
    state.Ok =
      links->GetVector(RESIDUAL, unshot.data()) && links->GetVector(SOLUTION, radiosity.data());
    for (vtkIdType shot = 0; state.Ok && shot < patches; ++shot)
    {
      vtkIdType from = 0;
      double most = -1.0;
      for (vtkIdType patch = 0; patch < patches; ++patch)
      {
        const double here = power(patch);
        from = here > most ? patch : from;
        most = std::max(here, most);
      }
      const std::vector<double> sent(&unshot[from * bands], &unshot[from * bands] + bands);
      state.Ok = links->GetRow(from, 0, row.data());
      for (int band = 0; band < bands; ++band)
      {
        radiosity[from * bands + band] += sent[band];
        unshot[from * bands + band] = 0.0;
      }
      for (vtkIdType patch = 0; patch < patches; ++patch)
      {
        const double share = row[patch] / (*problem.Areas)[patch];
        for (int band = 0; band < bands; ++band)
        {
          unshot[patch * bands + band] +=
            problem.Reflectance[patch * bands + band] * share * sent[band];
        }
      }
    }
    state.Ok = state.Ok && links->SetVector(SOLUTION, radiosity.data());
    ++state.Count;
  }
}

//------------------------------------------------------------------------------
void IterateChebyshev(Iteration& state)
{
  vtkLinkOperator* links = state.Links;
  const int bands = state.Problem.NumberOfBands;
  const Bands& radii =
    state.SpectralRadii; // the spectrum of I - rho F lies in [1 - radius, 1 + radius]
  Bands ratios = radii;  // rho_k of the recurrence: 1 / sigma at first
  state.Ok = state.Ok && state.ComputeResidual() &&
    links->Combine(DIRECTION, state.Ones.data(), RESIDUAL, state.Zeros.data(), RESIDUAL);
  while (state.Ok && state.Continue())
  {
    state.Ok =
      links->Combine(SOLUTION, state.Ones.data(), SOLUTION, state.Ones.data(), DIRECTION) &&
      state.ComputeResidual();
    Bands previous(bands), residual(bands);
    for (int band = 0; band < bands; ++band)
    {
      const double radius = radii[band];
      const double next = radius / (2.0 - radius * ratios[band]);
      previous[band] = next * ratios[band];
      residual[band] = radius > 0.0 ? 2.0 * next / radius : 1.0;
      ratios[band] = next;
    }
    state.Ok =
      state.Ok && links->Combine(DIRECTION, previous.data(), DIRECTION, residual.data(), RESIDUAL);
    ++state.Count;
  }
}

//------------------------------------------------------------------------------
// On (I - s G s) y = s G E with B = E + s y. A residual r of this system is a residual s r of B = E
// + rho F B.
class ConjugateGradients
{
public:
  explicit ConjugateGradients(Iteration& state) : State(state), Squares(state.Problem.NumberOfBands)
  {
  }

  bool Begin()
  {
    vtkLinkOperator* links = this->State.Links;
    Iteration& s = this->State;
    // y = 0, r = p = s G E
    return links->Multiply(IMAGE, SOURCE) && links->Scale(IMAGE, SYMMETRIC, IMAGE) &&
      links->Combine(DIRECTION, s.Ones.data(), IMAGE, s.Zeros.data(), IMAGE) &&
      links->Combine(UNKNOWN, s.Zeros.data(), IMAGE, s.Zeros.data(), IMAGE) &&
      links->Combine(GRADIENT, s.Ones.data(), IMAGE, s.Zeros.data(), IMAGE) &&
      links->Dot(GRADIENT, GRADIENT, this->Squares.data()) && this->Translate();
  }

  bool Step()
  {
    vtkLinkOperator* links = this->State.Links;
    Iteration& s = this->State;
    const int bands = s.Problem.NumberOfBands;
    Bands curvatures(bands), steps(bands), back(bands), next(bands), ratios(bands);
    if (!links->Apply(IMAGE, SYMMETRIC, SYMMETRIC, DIRECTION, SCRATCH) ||
      !links->Combine(IMAGE, s.Ones.data(), DIRECTION, s.MinusOnes.data(), IMAGE) ||
      !links->Dot(DIRECTION, IMAGE, curvatures.data()))
    {
      return false;
    }
    for (int band = 0; band < bands; ++band)
    {
      const bool idle = this->Squares[band] == 0.0;
      this->Indefinite = this->Indefinite || (!idle && !(curvatures[band] > 0.0));
      steps[band] =
        idle || !(curvatures[band] > 0.0) ? 0.0 : this->Squares[band] / curvatures[band];
      back[band] = -steps[band];
    }
    if (!links->Combine(UNKNOWN, s.Ones.data(), UNKNOWN, steps.data(), DIRECTION) ||
      !links->Combine(GRADIENT, s.Ones.data(), GRADIENT, back.data(), IMAGE) ||
      !links->Dot(GRADIENT, GRADIENT, next.data()))
    {
      return false;
    }
    for (int band = 0; band < bands; ++band)
    {
      ratios[band] = this->Squares[band] > 0.0 ? next[band] / this->Squares[band] : 0.0;
    }
    this->Squares = next;
    return links->Combine(DIRECTION, s.Ones.data(), GRADIENT, ratios.data(), DIRECTION) &&
      this->Translate();
  }

  bool Indefinite = false;

private:
  static constexpr int GRADIENT = SCRATCH + 1;

  // B = E + s y, and its residual s r.
  bool Translate()
  {
    vtkLinkOperator* links = this->State.Links;
    return links->Scale(SOLUTION, SYMMETRIC, UNKNOWN) &&
      links->Combine(SOLUTION, this->State.Ones.data(), SOURCE, this->State.Ones.data(),
        SOLUTION) &&
      links->Scale(RESIDUAL, SYMMETRIC, GRADIENT);
  }

  Iteration& State;
  Bands Squares;
};

//------------------------------------------------------------------------------
void IterateConjugateGradients(Iteration& state)
{
  ConjugateGradients gradients(state);
  state.Ok = state.Ok && gradients.Begin();
  while (state.Ok && state.Continue() && !gradients.Indefinite)
  {
    state.Ok = gradients.Step();
    ++state.Count;
  }
}

//------------------------------------------------------------------------------
// The weights 1 / d_i and largest w of the error bound, per band.
struct ErrorWeights
{
  std::vector<double> Inverse; // patches x bands
  Bands LargestW;
  Bands SpectralRadii; // of rho F, from above: max (1 - d_i / w_i)
  std::string Error;
};

const char* const NoSolution =
  "The radiosity equation has no unique solution here: some closed part of the scene reflects all "
  "that it receives, or its view factors sum to more than 1 / reflectance. Lower the largest "
  "reflectance, or switch EnforceClosure on.";

//------------------------------------------------------------------------------
// Residuals 1 - d in weights.Inverse become 1 / d. False unless all d and w are positive.
bool FinishWeights(const std::vector<double>& w, ErrorWeights& weights)
{
  const std::size_t bands = weights.LargestW.size();
  weights.SpectralRadii.assign(bands, 0.0);
  bool positive = true;
  for (std::size_t k = 0; k < w.size(); ++k)
  {
    const double dominance = 1.0 - weights.Inverse[k];
    positive = positive && dominance > 0.0 && w[k] > 0.0;
    weights.Inverse[k] = 1.0 / dominance;
    double& radius = weights.SpectralRadii[k % bands];
    radius = std::max(radius, 1.0 - dominance / w[k]);
  }
  return positive;
}

//------------------------------------------------------------------------------
// w from conjugate gradients for a right-hand side of ones: then (I - rho F) w = 1 - residual.
ErrorWeights ImproveWeights(const vtkRadiosityProblem& problem)
{
  ErrorWeights weights;
  const std::vector<double> ones(problem.Reflectance.size(), 1.0);
  Iteration state(problem, problem.Reference, ones.data());
  ConjugateGradients gradients(state);
  state.Ok = state.Ok && gradients.Begin();
  Bands residuals(problem.NumberOfBands, Infinity);
  weights.LargestW.resize(problem.NumberOfBands);
  for (int iteration = 0; state.Ok && iteration < MaximumBoundIterations; ++iteration)
  {
    state.Ok = problem.Reference->MaxNorm(RESIDUAL, residuals.data());
    if (*std::max_element(residuals.begin(), residuals.end()) <= BoundTolerance ||
      gradients.Indefinite)
    {
      break;
    }
    state.Ok = state.Ok && gradients.Step();
  }
  weights.Inverse.resize(problem.Reflectance.size());
  // The recurrence drifts: the bound takes the residual itself.
  state.Ok = state.Ok && state.ComputeResidual() &&
    problem.Reference->GetVector(RESIDUAL, weights.Inverse.data()) &&
    problem.Reference->MaxNorm(SOLUTION, weights.LargestW.data());
  std::vector<double> w(problem.Reflectance.size());
  state.Ok = state.Ok && problem.Reference->GetVector(SOLUTION, w.data());
  const bool positive = FinishWeights(w, weights);
  if (!state.Ok || !positive)
  {
    weights.Error = NoSolution;
  }
  return weights;
}

//------------------------------------------------------------------------------
ErrorWeights FindWeights(const vtkRadiosityProblem& problem)
{
  ErrorWeights weights;
  weights.LargestW.assign(problem.NumberOfBands, 1.0);
  weights.Inverse.resize(problem.Reflectance.size());
  double largest = 0.0;
  bool mirrors = false;
  for (std::size_t k = 0; k < weights.Inverse.size(); ++k)
  {
    weights.Inverse[k] = problem.Reflectance[k] * (*problem.RowSums)[k / problem.NumberOfBands];
    largest = std::max(largest, weights.Inverse[k]);
    mirrors = mirrors || problem.Reflectance[k] > 1.0 - FullReflectance;
  }
  if (1.0 - largest > SmallDominance)
  {
    FinishWeights(std::vector<double>(weights.Inverse.size(), 1.0), weights);
    return weights;
  }
  weights = ImproveWeights(problem);
  // A closed part that reflects everything is regular by the errors of its row sums alone: w is
  // then as large as 1 / error.
  const double w = *std::max_element(weights.LargestW.begin(), weights.LargestW.end());
  if (mirrors && weights.Error.empty() && w * problem.RowSumError >= 1.0)
  {
    weights.Error = NoSolution;
  }
  return weights;
}

//------------------------------------------------------------------------------
void Iterate(Iteration& state)
{
  switch (state.Problem.Solver)
  {
    case vtkRadiosity::SOLVER_JACOBI:
      return IterateJacobi(state);
    case vtkRadiosity::SOLVER_GAUSS_SEIDEL:
      return IterateGaussSeidel(state);
    case vtkRadiosity::SOLVER_SOUTHWELL:
      return IterateSouthwell(state);
    case vtkRadiosity::SOLVER_CHEBYSHEV:
      return IterateChebyshev(state);
    default:
      return IterateConjugateGradients(state);
  }
}

//------------------------------------------------------------------------------
// Residual, bound and sizes of a solution in double precision. Returns false after an error.
bool Check(const vtkRadiosityProblem& problem, const ErrorWeights& weights,
  vtkRadiositySolution& solution, std::vector<double>& residual, Bands& sizes)
{
  Iteration state(problem, problem.Reference, problem.Emission.data());
  residual.resize(problem.Emission.size());
  if (!state.Ok || !problem.Reference->SetVector(SOLUTION, solution.Radiosity.data()) ||
    !state.ComputeResidual() || !problem.Reference->GetVector(RESIDUAL, residual.data()) ||
    !problem.Reference->MaxNorm(SOLUTION, sizes.data()))
  {
    return false;
  }
  Bands bounds(problem.NumberOfBands, 0.0);
  for (std::size_t k = 0; k < residual.size(); ++k)
  {
    double& bound = bounds[k % problem.NumberOfBands];
    bound = std::max(bound, std::abs(residual[k]) * weights.Inverse[k]);
  }
  solution.Converged = true;
  solution.ErrorBound = 0.0;
  for (int band = 0; band < problem.NumberOfBands; ++band)
  {
    const double bound = bounds[band] * weights.LargestW[band];
    solution.Converged = solution.Converged && bound <= problem.Tolerance * sizes[band];
    solution.ErrorBound = std::max(solution.ErrorBound, bound);
  }
  return true;
}
} // namespace

namespace vtkRadiositySolvers
{
//------------------------------------------------------------------------------
const char* GetName(int solver)
{
  const char* const names[] = { "Auto", "Jacobi", "GaussSeidel", "Southwell", "Chebyshev",
    "ConjugateGradient" };
  return names[solver];
}

//------------------------------------------------------------------------------
bool IsSequential(int solver)
{
  return solver == vtkRadiosity::SOLVER_GAUSS_SEIDEL || solver == vtkRadiosity::SOLVER_SOUTHWELL;
}

//------------------------------------------------------------------------------
// Solve, look at the residual in double precision, and where it is not yet small enough (single
// precision devices, the drift of a recurrence) solve again for the correction.
vtkRadiositySolution Solve(const vtkRadiosityProblem& problem)
{
  vtkRadiositySolution solution;
  const ErrorWeights weights = FindWeights(problem);
  solution.Error = weights.Error;
  if (!solution.Error.empty())
  {
    return solution;
  }
  solution.Radiosity.assign(problem.Emission.size(), 0.0);
  std::vector<double> residual = problem.Emission;
  std::vector<double> correction(residual.size());
  const std::vector<double> nothing(residual.size(), 0.0);
  Bands sizes(problem.NumberOfBands, 0.0);
  double previous = Infinity;
  for (int round = 0; round <= MaximumCorrections; ++round)
  {
    Iteration state(problem, problem.Operator, residual.data());
    state.Count = solution.NumberOfIterations;
    state.Scales = sizes;
    state.BoundScales = weights.LargestW;
    state.SpectralRadii = weights.SpectralRadii;
    state.Ok = state.Ok && problem.Operator->SetVector(BOUND_WEIGHT, weights.Inverse.data()) &&
      problem.Operator->SetVector(SOLUTION, nothing.data());
    Iterate(state);
    if (!state.Ok || !problem.Operator->GetVector(SOLUTION, correction.data()))
    {
      solution.Error = "The links could not be applied (see the message before this one).";
      return solution;
    }
    std::transform(solution.Radiosity.begin(), solution.Radiosity.end(), correction.begin(),
      solution.Radiosity.begin(), std::plus<double>());
    solution.NumberOfIterations = state.Count;
    solution.Aborted = state.Aborted;
    if (!Check(problem, weights, solution, residual, sizes))
    {
      solution.Error = "The residual could not be computed (see the message before this one).";
      return solution;
    }
    // Converged, or as far as it goes: used up, or a round that gained less than a factor of two.
    if (solution.Converged || solution.Aborted ||
      state.Count >= problem.MaximumNumberOfIterations || !(solution.ErrorBound < 0.5 * previous))
    {
      break;
    }
    previous = solution.ErrorBound;
  }
  return solution;
}
} // namespace vtkRadiositySolvers
