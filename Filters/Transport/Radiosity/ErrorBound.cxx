// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/ErrorBound.h"

#include "Radiosity/ConjugateGradients.h"
#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/RadiosityVectors.h"
#include "vtkCPULinkOperator.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace LightTransport
{
namespace
{
// Where some 1 - rho * row sum is below this, w = 1 gives a poor bound or none, and a better w is
// worth a few products.
constexpr double SmallDominance = 1e-2;
// How well w must solve its system: d = 1 - residual is then at least 0.9.
constexpr double GoodResidual = 0.1;
// Steps of conjugate gradients for w; as many as a solver may take by default.
constexpr int MaximumIterations = 1000;

// Reflectances closer to 1 than single precision view factors can tell.
constexpr double FullReflectance = 1.0 - 1e-7;
// What the errors of view factors may do to B before users should know, and before B means nothing.
constexpr double WorthAWarning = 0.1;
constexpr double Meaningless = 1.0;
// Row sums that no error of an integral explains, but patches that overlap.
constexpr double OverfullRow = 1.01;
// Where w is above this fraction of its largest value is the part of the scene that light leaves
// last: w hardly varies in a part, and differs from part to part.
constexpr double SamePart = 0.5;
// What rounding and closing leave of a row sum.
constexpr double MostRounding = 1e-6;
// Errors of row sums from which on a mirror may be open as well as closed.
constexpr double WellKnown = 1e-3;

//------------------------------------------------------------------------------
// A patch in a band: where something is wrong.
struct Place
{
  std::size_t Index = 0;
  double Reflectance = 0.0;
  double RowSum = 0.0;
  double RowSumError = 0.0;
};

//------------------------------------------------------------------------------
Place GetPlace(const RadiosityEquation& equation, std::size_t index)
{
  const std::size_t patch = index / equation.NumberOfBands;
  return { index, equation.Reflectance[index], (*equation.RowSums)[patch],
    equation.RowSumErrors[patch] };
}

//------------------------------------------------------------------------------
// Where the part of the scene is in which `w` is largest, by its patch that loses least.
Place FindWorst(const RadiosityEquation& equation, const std::vector<double>& w)
{
  double largest = 0.0;
  for (const double value : w)
  {
    largest = std::abs(value) > largest ? std::abs(value) : largest;
  }
  Place worst;
  double most = -1.0;
  for (std::size_t k = 0; k < w.size(); ++k)
  {
    const Place place = GetPlace(equation, k);
    const double kept = place.Reflectance * place.RowSum;
    if (std::abs(w[k]) >= SamePart * largest && kept > most)
    {
      most = kept;
      worst = place;
    }
  }
  return worst;
}

//------------------------------------------------------------------------------
std::string Describe(const RadiosityEquation& equation, const Place& place)
{
  const auto patch = static_cast<vtkIdType>(place.Index / equation.NumberOfBands);
  std::ostringstream text;
  text.precision(9);
  text << "polygon " << (equation.GetPolygon ? equation.GetPolygon(patch) : patch);
  if (equation.NumberOfBands > 1)
  {
    text << ", band " << place.Index % equation.NumberOfBands;
  }
  text << " (reflectance " << place.Reflectance << ", view factors that sum to " << place.RowSum
       << ")";
  return text.str();
}

//------------------------------------------------------------------------------
std::string ExplainNoSolution(const RadiosityEquation& equation, const Place& place)
{
  const std::string beginning =
    "The radiosity equation has no unique solution: " + Describe(equation, place);
  const double excess = place.Reflectance * place.RowSum - 1.0;
  if (excess > std::max(place.RowSumError, MostRounding))
  {
    return beginning +
      " returns more than it receives. Remove patches that overlap or lie on each other "
      "(vtkPatchMesher with Repair); where the excess is small, switch EnforceClosure on or lower "
      "the reflectance.";
  }
  if (place.Reflectance >= FullReflectance)
  {
    return beginning +
      " belongs to a closed part of the scene that reflects all that it receives, so that what is "
      "emitted there never leaves. Lower a reflectance there, or give it an opening.";
  }
  return beginning +
    " returns all that it receives as far as these view factors tell. Switch EnforceClosure on, "
    "lower ViewFactorTolerance, LinkTolerance or the reflectance.";
}

//------------------------------------------------------------------------------
// The error of the row sums of what `w` is large in: by how much the largest eigenvalue of rho F
// may be off, of which w is nearly the vector, to first order of perturbation (that from the left
// is w times the areas over rho). A single row that is poorly known does to a scene what its area
// can.
double FindRowSumError(const RadiosityEquation& equation, const std::vector<double>& w, int band)
{
  double errors = 0.0, weights = 0.0;
  for (std::size_t patch = 0; patch < equation.RowSumErrors.size(); ++patch)
  {
    const double here = w[patch * equation.NumberOfBands + band];
    const double weight = (*equation.Areas)[patch] * here * here;
    errors += weight * equation.RowSumErrors[patch];
    weights += weight;
  }
  return weights > 0.0 ? errors / weights : 0.0;
}

//------------------------------------------------------------------------------
// What errors of the view factors may do to B, relative to its largest value.
Outcome CheckViewFactors(const RadiosityEquation& equation, const std::vector<double>& w,
  ErrorBound& bound)
{
  double amplification = 0.0, rowSumError = 0.0, effect = 0.0;
  for (int band = 0; band < equation.NumberOfBands; ++band)
  {
    const double times = bound.LargestW[band] * bound.LargestInverse[band];
    const double error = FindRowSumError(equation, w, band);
    if (times * error > effect)
    {
      amplification = times;
      rowSumError = error;
      effect = times * error;
    }
  }
  if (effect < WorthAWarning)
  {
    return Outcome::Done();
  }
  const Place place = FindWorst(equation, w);
  if (effect >= Meaningless && place.Reflectance >= FullReflectance && rowSumError <= WellKnown)
  {
    return Outcome::Failed(ExplainNoSolution(equation, place));
  }
  std::ostringstream text;
  text << "Light is reflected about " << amplification << " times around "
       << Describe(equation, place) << ", and row sums of the view factors are known to "
       << rowSumError << ": ";
  const char* const remedy = " Switch EnforceClosure on, lower ViewFactorTolerance, "
                             "LinkTolerance or the reflectance.";
  // Where no row sums to more than 1, light cannot grow: doubtful, but a solution.
  const auto& sums = *equation.RowSums;
  const bool mayGrow =
    !sums.empty() && *std::max_element(sums.begin(), sums.end()) > 1.0 + MostRounding;
  if (effect >= Meaningless && mayGrow)
  {
    text << "the radiosity equation has no unique solution within that error." << remedy;
    return Outcome::Failed(text.str());
  }
  text << "B may be wrong by " << 100.0 * effect << " % there." << remedy;
  bound.Warning = text.str();
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void CheckRows(const RadiosityEquation& equation, ErrorBound& bound)
{
  const std::vector<double>& sums = *equation.RowSums;
  const auto fullest = std::max_element(sums.begin(), sums.end());
  const auto patch = static_cast<std::size_t>(fullest - sums.begin());
  if (fullest != sums.end() && *fullest > OverfullRow + equation.RowSumErrors[patch])
  {
    bound.Warning = "What leaves " +
      Describe(equation, GetPlace(equation, patch * equation.NumberOfBands)) +
      " arrives more than once: patches that it sees overlap or lie on each other. Remove them "
      "(vtkPatchMesher with Repair). " +
      bound.Warning;
  }
}

//------------------------------------------------------------------------------
// With residuals 1 - d in Inverse. False unless all d and w are positive.
bool Finish(const std::vector<double>& w, ErrorBound& bound)
{
  const auto bands = bound.LargestW.size();
  bound.SpectralRadii.assign(bands, 0.0);
  bound.LargestInverse.assign(bands, 0.0);
  bool positive = true;
  for (std::size_t k = 0; k < w.size(); ++k)
  {
    const double d = 1.0 - bound.Inverse[k];
    // Written so that a NaN is not positive.
    positive = positive && d > 0.0 && w[k] > 0.0;
    bound.Inverse[k] = 1.0 / d;
    double& largest = bound.LargestInverse[k % bands];
    largest = std::max(largest, bound.Inverse[k]);
    double& radius = bound.SpectralRadii[k % bands];
    radius = std::max(radius, 1.0 - d / w[k]);
  }
  return positive;
}

//------------------------------------------------------------------------------
// w from conjugate gradients for a right-hand side of ones: then (I - rho F) w = 1 - residual.
// Returns false where there is no such w; it then points to where that fails.
bool FindW(const RadiosityEquation& equation, ErrorBound& bound, std::vector<double>& w)
{
  const std::vector<double> ones(equation.Reflectance.size(), 1.0);
  RadiosityVectors vectors(equation, equation.Reference, ones.data());
  ConjugateGradients gradients(vectors);
  bool good = vectors.Ok && gradients.Begin();
  RadiosityVectors::Bands residuals(equation.NumberOfBands);
  for (int count = 0; good && count < MaximumIterations; ++count)
  {
    good = equation.Reference->MaxNorm(RadiosityVectors::RESIDUAL, residuals.data());
    if (gradients.IsIndefinite() ||
      *std::max_element(residuals.begin(), residuals.end()) <= GoodResidual)
    {
      break;
    }
    good = good && gradients.Step();
  }
  // The recurrence drifts: the bound takes the residual itself.
  w.resize(ones.size());
  bound.Inverse.resize(ones.size());
  bound.LargestW.resize(equation.NumberOfBands);
  if (gradients.IsIndefinite())
  {
    gradients.GetIndefiniteDirection(w.data());
    return false;
  }
  return good && vectors.ComputeResidual() &&
    equation.Reference->GetVector(RadiosityVectors::RESIDUAL, bound.Inverse.data()) &&
    equation.Reference->MaxNorm(RadiosityVectors::SOLUTION, bound.LargestW.data()) &&
    equation.Reference->GetVector(RadiosityVectors::SOLUTION, w.data()) && Finish(w, bound);
}
} // namespace

//------------------------------------------------------------------------------
Outcome ErrorBound::Find(const RadiosityEquation& equation, ErrorBound& bound)
{
  bound.LargestW.assign(equation.NumberOfBands, 1.0);
  std::vector<double> w(equation.Reflectance.size(), 1.0);
  std::vector<double> kept(w.size());
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    kept[k] = GetPlace(equation, k).Reflectance * GetPlace(equation, k).RowSum;
  }
  const double most = kept.empty() ? 0.0 : *std::max_element(kept.begin(), kept.end());
  bound.Inverse = kept;
  if (1.0 - most > SmallDominance)
  {
    Finish(w, bound);
  }
  else if (!FindW(equation, bound, w))
  {
    return Outcome::Failed(ExplainNoSolution(equation, FindWorst(equation, w)));
  }
  Outcome found = CheckViewFactors(equation, w, bound);
  CheckRows(equation, bound);
  return found;
}
} // namespace LightTransport
