// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Errors of Monte Carlo in meshes: over seeds patches and totals are spread as their errors say,
// neither more nor less, around what exact tables say.
#include "PhotonScatteringTesting.h"
#include "PhotonWalkTesting.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace LightTransportTesting;

namespace
{
constexpr int Cuts = 4; // of the sides of the cube

//------------------------------------------------------------------------------
/// Values of patches that a symmetry of the body makes alike.
class Spread
{
public:
  using Kind = std::pair<int, int>;

  void Add(const Kind& kind, double value, double error)
  {
    this->Values[kind].push_back(value);
    this->Variances[kind] += error * error;
  }

  /// Squares of deviations over errors are 1 on average, but for `slack` and chance; 0.3 % are
  /// larger than three errors.
  void CheckErrors(double slack, const std::string& what) const
  {
    double chi = 0.0;
    double freedom = 0.0;
    double count = 0.0;
    int beyond = 0;
    for (const auto& kind : this->Values)
    {
      const std::vector<double>& values = kind.second;
      const auto n = static_cast<double>(values.size());
      const double variance = this->Variances.at(kind.first) / n;
      double mean = 0.0;
      for (const double value : values)
      {
        mean += value / n;
      }
      for (const double value : values)
      {
        const double square = (value - mean) * (value - mean) / variance;
        chi += square;
        beyond += square > 9.0;
      }
      freedom += n - 1.0;
      count += n;
    }
    std::cout << what << ": squares " << chi / freedom << ", beyond three errors "
              << 100.0 * beyond / count << " % of " << count << "\n";
    CheckClose(chi / freedom, 1.0, slack + MostDeviations * std::sqrt(2.0 / freedom),
      "squares of deviations over errors, " + what);
    const double expected = 0.0027 * count;
    Check(beyond < expected + MostDeviations * std::sqrt(expected) + 1.0,
      what + ": " + std::to_string(beyond) + " of " + std::to_string(count) +
        " values beyond three errors");
  }

private:
  std::map<Kind, std::vector<double>> Values;
  std::map<Kind, double> Variances;
};

//------------------------------------------------------------------------------
/// A patch of the unit cube: how far it is from the two nearest edges, in patches.
Spread::Kind GetKind(vtkPolyData* cube, vtkIdType patch)
{
  double bounds[6];
  cube->GetCellBounds(patch, bounds);
  std::vector<int> places;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double width = bounds[2 * axis + 1] - bounds[2 * axis];
    const double middle = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
    if (width > 0.0)
    {
      places.push_back(static_cast<int>(Cuts * std::min(middle, 1.0 - middle)));
    }
  }
  return { std::min(places[0], places[1]), std::max(places[0], places[1]) };
}

//------------------------------------------------------------------------------
struct BodyCase
{
  const char* Name;
  double Scattering[3];
  double Absorption[3];
  double Index;
  double Anisotropy;
  double Millimeters;
  int Photons;
};

//------------------------------------------------------------------------------
/// Patches of a cube in even light. `slack` of their errors.
void TestPatches(const BodyCase& test, int method, double slack)
{
  const auto cube = MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, Cuts);
  AddArray(cube, "Irradiance", { 1.0, 0.5, 0.1 });
  Spread patches;
  for (int seed = 1; seed <= Seeds; ++seed)
  {
    PhotonRun run(cube);
    run.Filter->SetScatteringCoefficient(test.Scattering[0], test.Scattering[1],
      test.Scattering[2]);
    run.Filter->SetAbsorptionCoefficient(test.Absorption[0], test.Absorption[1],
      test.Absorption[2]);
    run.Filter->SetAnisotropy(test.Anisotropy, test.Anisotropy, test.Anisotropy);
    run.Filter->SetRefractiveIndex(test.Index);
    run.Filter->SetMillimetersPerUnit(test.Millimeters);
    run.Filter->SetNumberOfPhotons(test.Photons);
    run.Filter->SetLinkMethod(method);
    run.Filter->SetSeed(seed);
    CheckWorks(run, test.Name);
    vtkDataArray* values = run.Get("ScatteredIrradiance");
    vtkDataArray* errors = run.Get("ScatteredIrradianceError");
    // Bands that share their photons err together.
    const int band = seed % 3;
    for (vtkIdType patch = 0; patch < cube->GetNumberOfCells(); ++patch)
    {
      const double light = cube->GetCellData()->GetArray("Irradiance")->GetComponent(0, band);
      Spread::Kind kind = GetKind(cube, patch);
      kind.first += 10 * band;
      patches.Add(kind, values->GetComponent(patch, band) / light,
        errors->GetComponent(patch, band) / light);
    }
  }
  patches.CheckErrors(slack, std::string(test.Name) + (method == 1 ? ", links" : ""));
}

//------------------------------------------------------------------------------
/// Also where nearly all that enters a patch leaves there again: how much enters is no chance.
void TestAllPatches()
{
  const BodyCase cases[] = {
    { "a cube of ten free paths", { 1, 1, 1 }, { 0.01, 0.01, 0.01 }, 1.3, 0.0, 10.0, 5000 },
    { "a large cube", { 1, 1, 1 }, { 0.001, 0.001, 0.001 }, 1.5, 0.0, 200.0, 5000 },
    { "three bands", { 2, 1, 0.5 }, { 0.01, 0.1, 0.02 }, 1.4, 0.0, 10.0, 10000 },
    { "anisotropic scattering", { 1, 1, 1 }, { 0.01, 0.01, 0.01 }, 1.3, 0.9, 3.0, 5000 },
  };
  for (const BodyCase& test : cases)
  {
    TestPatches(test, vtkSubsurfaceScattering::LINK_METHOD_AUTO, 0.05);
  }
  // Their variance is a small difference, in which all patches have one mean weight.
  for (const BodyCase* test : { &cases[0], &cases[1] })
  {
    TestPatches(*test, vtkSubsurfaceScattering::LINK_METHOD_DENSE, 0.15);
  }
}

//------------------------------------------------------------------------------
/// Large against the free path: as much as a half space in diffuse light (H functions).
void TestHalfSpaces()
{
  struct Case
  {
    double Albedo, Index, Reflectance, Mean;
  };
  for (const Case& test : { Case{ 0.9, 1.5, 0.216112, 0.0917779 }, Case{ 0.8, 1.0, 0.341867, 0.0 },
         Case{ 0.98, 1.4, 0.490517, 0.076812 } })
  {
    Deviations totals;
    for (int seed = 1; seed <= Seeds; ++seed)
    {
      PhotonRun run(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2));
      run.SetMedium(test.Albedo, 1.0 - test.Albedo, test.Index);
      run.Filter->SetMillimetersPerUnit(2e4);
      run.Filter->SetNumberOfPhotons(PhotonsPerSeed);
      run.Filter->SetSeed(seed);
      CheckWorks(run, "a large box");
      totals.AddMean(run.GetNumber("LeavingShare"), run.GetNumber("LeavingShareError"),
        test.Reflectance / (1.0 - test.Mean));
    }
    totals.CheckNormal("what leaves a large box of albedo " + std::to_string(test.Albedo));
  }
}

//------------------------------------------------------------------------------
/// A plate that is lit from one side (adding-doubling; what is not scattered is 2 E3(2)).
void TestPlate()
{
  constexpr double anisotropy = 0.75;
  constexpr double reflected = 0.191090, transmitted = 0.501816 - 0.060267;
  const auto plate = MakeBox({ 0, 0, 0 }, { 1e5, 1e5, 2 });
  AddArray(plate, "Irradiance", { 0.0 })->SetComponent(1, 0, 1.0);
  Deviations above, below;
  for (int seed = 1; seed <= Seeds; ++seed)
  {
    PhotonRun run(plate);
    run.SetMedium(0.9 * (1.0 - anisotropy), 0.1, 1.0);
    run.Filter->SetAnisotropy(anisotropy, anisotropy, anisotropy);
    run.Filter->SetNumberOfPhotons(PhotonsPerSeed);
    run.Filter->SetSeed(seed);
    CheckWorks(run, "a plate");
    const auto get = [&run](const char* name, vtkIdType patch)
    { return run.Get(name)->GetComponent(patch, 0); };
    above.AddMean(get("ScatteredIrradiance", 1), get("ScatteredIrradianceError", 1), reflected);
    below.AddMean(get("ScatteredIrradiance", 0), get("ScatteredIrradianceError", 0), transmitted);
  }
  above.CheckNormal("reflectance of a plate");
  below.CheckNormal("transmittance of a plate");
}

//------------------------------------------------------------------------------
/// When to stop is decided by what has been seen: that must not favour some results, nor more
/// photons than the target needs.
void TestTarget()
{
  constexpr double target = 0.015;
  constexpr double exact = 0.341867;
  Deviations totals;
  double squares = 0.0;
  double told = 0.0;
  for (int seed = 1; seed <= Seeds; ++seed)
  {
    PhotonRun run(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
    run.SetMedium(0.8, 0.2, 1.0);
    run.Filter->SetMillimetersPerUnit(2e4);
    run.Filter->SetNumberOfPhotons(0);
    run.Filter->SetTargetError(target);
    run.Filter->SetSeed(seed);
    CheckWorks(run, "a target");
    totals.AddMean(run.GetNumber("LeavingShare"), run.GetNumber("LeavingShareError"), exact);
    const double error = run.GetNumber("RelativeError");
    Check(error <= target && error > 0.9 * target,
      "the target, not more: " + std::to_string(error));
    told += error * error;
    vtkDataArray* values = run.Get("ScatteredIrradiance");
    const vtkIdType patches = values->GetNumberOfTuples();
    for (vtkIdType patch = 0; patch < patches; ++patch)
    {
      const double deviation = values->GetComponent(patch, 0) / exact - 1.0;
      squares += deviation * deviation / patches;
    }
  }
  totals.CheckNormal("what leaves where a target stops the walk");
  std::cout << "target: errors are " << std::sqrt(squares / told) << " of what is told\n";
  CheckClose(squares / told, 1.0, 0.05 + MostDeviations * std::sqrt(2.0 / (Seeds * 6)),
    "squares of errors over what is told");
}
} // namespace

//------------------------------------------------------------------------------
int TestPhotonErrors(int, char*[])
{
  TestAllPatches();
  TestHalfSpaces();
  TestPlate();
  TestTarget();
  return Result();
}
