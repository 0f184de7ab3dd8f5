// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Tables of photons in a flat medium against exact totals, published rings and other photons.
#include "LightTransportTesting.h"
#include "RanksInThreads.h"
#include "Scattering/HalfSpaceTable.h"
#include "Scattering/MatchedHalfSpace.h"
#include "Scattering/TabulatedProfile.h"
#include "Shared/Fresnel.h"
#include "Shared/Pulse.h"
#include "vtkSMPTools.h"
#include "vtkSubsurfaceScattering.h"

using namespace LightTransport;
using namespace LightTransportTesting;

namespace
{
// Standard errors that one of a hundred comparisons exceeds by chance with 1 %.
constexpr double MostDeviations = 4.0;

//------------------------------------------------------------------------------
/// What leaves of all light that falls on the surface from all directions (H functions and, with
/// internal reflection, a linear system); tables are of light that has entered.
void TestTotals()
{
  struct Case
  {
    double Albedo;
    double Index;
    double Exact;
    long long Photons;
  };
  const Case cases[] = { { 0.2, 1.0, 0.046265, 400000 }, { 0.2, 1.5, 0.012422, 400000 },
    { 0.8, 1.4, 0.153598, 200000 }, { 0.9, 1.0, 0.478024, 200000 }, { 0.9, 1.3, 0.288334, 200000 },
    { 0.99, 1.33, 0.616294, 50000 }, { 0.999, 1.5, 0.762462, 20000 },
    { 0.9999, 1.0, 0.977187, 10000 } };
  for (const Case& test : cases)
  {
    const TabulatedProfile profile({ test.Albedo, 1.0 - test.Albedo, test.Index }, test.Photons, 1);
    const double exact = test.Exact / (1.0 - Fresnel::GetMeanExternalReflectance(test.Index));
    const double error = profile.GetError();
    const std::string what =
      "albedo " + std::to_string(test.Albedo) + ", index " + std::to_string(test.Index);
    std::cout << what << ": " << (profile.GetTotal() / exact - 1.0) / error << " of "
              << 100.0 * error << " %\n";
    Check(error > 0.0 && error < 8e-3, "standard error of the total, " + what);
    CheckClose(profile.GetTotal(), exact, MostDeviations * error, "total, " + what);
  }
  // Nothing is absorbed, or hardly anything: what the walk does not reach is there.
  for (const double index : { 1.0, 1.5 })
  {
    const TabulatedProfile all({ 1.0, 0.0, index }, 10000, 1);
    CheckClose(all.GetTotal(), 1.0, 1e-6, "no absorption");
    Check(all.GetError() > 0.0, "its error is that of the walk");
    const TabulatedProfile most({ 1.0 - 1e-9, 1e-9, index }, 10000, 1);
    CheckClose(most.GetTotal(), all.GetTotal(), 2e-4, "hardly any absorption");
  }
  Check(TabulatedProfile({ 0.0, 1.0, 1.3 }, 100, 1).GetError() == 0.0, "no scattering");
}

//------------------------------------------------------------------------------
/// Over seeds totals are spread about the exact ones as their errors say, or less where less is
/// absorbed than in the walk.
void TestErrors()
{
  constexpr int seeds = 20;
  constexpr long long photons = 400;
  struct Case
  {
    double Absorbed, Index, Exact;
  };
  for (const Case& test :
    { Case{ 0.1, 1.0, 0.478024 }, Case{ 0.01, 1.3, 0.630551 / (1.0 - 0.061132) },
      Case{ 1e-3, 1.5, 0.762462 / (1.0 - 0.0917779) }, Case{ 1e-4, 1.0, 0.977187 },
      Case{ 5e-5, 1.0, 0.0 }, Case{ 1e-6, 1.0, 0.0 }, Case{ 0.0, 1.0, 1.0 } })
  {
    const ScatteringMedium medium{ 1.0 - test.Absorbed, test.Absorbed, test.Index };
    const double exact =
      test.Exact > 0.0 ? test.Exact : MatchedHalfSpace::GetDiffuseReflectance(medium);
    double sum = 0.0, squares = 0.0;
    for (int seed = 1; seed <= seeds; ++seed)
    {
      const TabulatedProfile profile(medium, photons, seed);
      const double deviation = (profile.GetTotal() / exact - 1.0) / profile.GetError();
      sum += deviation / std::sqrt(double(seeds));
      squares += deviation * deviation / seeds;
    }
    std::cout << "absorbed " << test.Absorbed << ", index " << test.Index << ": off by " << sum
              << " errors of the mean, squares " << squares << "\n";
    Check(std::abs(sum) < MostDeviations, "mean of totals over seeds");
    const double chance = MostDeviations * std::sqrt(2.0 / seeds);
    Check(squares < 1.0 + chance && (test.Absorbed < 1e-4 || squares > 1.0 / (1.0 + chance)),
      "spread of totals over seeds: " + std::to_string(squares));
  }
}

//------------------------------------------------------------------------------
/// Mean of the profile between two radii, per unit of light that enters along the normal, of
/// albedos 0.8 and 0.99 (2e7 photons, another program).
struct Ring
{
  double Begin;
  double End;
  double Means[2];
};

const Ring RingsMatched[] = { { 0.056234, 0.074989, { 7.8812e-01, 1.0348e+00 } },
  { 0.1, 0.13335, { 3.9713e-01, 5.4029e-01 } }, { 0.17783, 0.23714, { 1.8892e-01, 2.7173e-01 } },
  { 0.31623, 0.4217, { 8.3571e-02, 1.3094e-01 } }, { 0.56234, 0.74989, { 3.2791e-02, 5.9298e-02 } },
  { 1, 1.3335, { 1.0734e-02, 2.4540e-02 } }, { 1.7783, 2.3714, { 2.6155e-03, 8.7802e-03 } },
  { 3.1623, 4.217, { 3.8147e-04, 2.4825e-03 } }, { 5.6234, 7.4989, { 2.2423e-05, 4.9385e-04 } } };
const Ring Rings14[] = { { 0.056234, 0.074989, { 4.7316e-01, 6.3035e-01 } },
  { 0.1, 0.13335, { 2.2502e-01, 3.1323e-01 } }, { 0.17783, 0.23714, { 1.0005e-01, 1.5035e-01 } },
  { 0.31623, 0.4217, { 4.1217e-02, 7.1201e-02 } }, { 0.56234, 0.74989, { 1.5602e-02, 3.3688e-02 } },
  { 1, 1.3335, { 5.4142e-03, 1.6101e-02 } }, { 1.7783, 2.3714, { 1.5625e-03, 7.1685e-03 } },
  { 3.1623, 4.217, { 2.8399e-04, 2.5768e-03 } }, { 5.6234, 7.4989, { 2.1222e-05, 6.4035e-04 } } };

//------------------------------------------------------------------------------
double GetMean(const HalfSpaceTable& table, double decay, const Ring& ring)
{
  constexpr int steps = 40;
  double sum = 0.0;
  double weights = 0.0;
  for (int k = 0; k < steps; ++k)
  {
    const double r = ring.Begin + (ring.End - ring.Begin) * (k + 0.5) / steps;
    sum += r * table.Evaluate(r, decay);
    weights += r;
  }
  return sum / weights;
}

//------------------------------------------------------------------------------
template <std::size_t N>
void TestRings(double index, const Ring (&rings)[N])
{
  const double albedos[2] = { 0.8, 0.99 };
  for (int column = 0; column < 2; ++column)
  {
    HalfSpaceTable::Settings settings{ albedos[column], index, 0.0 };
    settings.NumberOfPhotons = 400000;
    settings.IsNormal = true;
    const HalfSpaceTable table(settings);
    const double decay = HalfSpaceTable::GetDecay(1.0 - albedos[column], 0.0);
    double errors = 0.0;
    double energy = 0.0;
    for (const Ring& ring : rings)
    {
      const double error = GetMean(table, decay, ring) / ring.Means[column] - 1.0;
      const double weight = ring.Means[column] * ring.Begin * ring.Begin;
      errors += weight * std::abs(error);
      energy += weight;
      // The outermost ring holds a few hundredths of a percent.
      Check(std::abs(error) < (ring.Begin > 5.0 ? 0.15 : 0.05),
        "ring from " + std::to_string(ring.Begin) + ", off by " + std::to_string(error));
    }
    std::cout << "rings at index " << index << ", albedo " << albedos[column] << ": "
              << 100.0 * errors / energy << " %\n";
    Check(errors / energy < 0.015, "rings at index " + std::to_string(index));
  }
}

//------------------------------------------------------------------------------
/// Other photons give the same profile, from all directions and anisotropic, too.
void TestOtherSeed()
{
  for (const double anisotropy : { 0.0, 0.8, -0.5 })
  {
    HalfSpaceTable::Settings settings{ 0.95, 1.3, anisotropy };
    settings.NumberOfPhotons = 100000;
    const HalfSpaceTable first(settings);
    settings.Seed = 2;
    const HalfSpaceTable second(settings);
    const double decay = HalfSpaceTable::GetDecay(0.05, anisotropy);
    double errors = 0.0;
    double energy = 0.0;
    double before = first.Evaluate(0.0, decay);
    for (double r = 1e-5; r < 1e3; r *= 1.1)
    {
      const double value = first.Evaluate(r, decay);
      errors += r * r * std::abs(value - second.Evaluate(r, decay));
      energy += r * r * value;
      Check(value >= 0.0 && value <= before, "falls at " + std::to_string(r));
      before = value;
    }
    std::cout << "anisotropy " << anisotropy << ": " << 100.0 * errors / energy << " %\n";
    Check(errors / energy < 0.02, "the same profile by other photons");
    Check(errors > 0.0, "they are others");
  }
}

//------------------------------------------------------------------------------
void TestDecay()
{
  for (const double absorption : { 1e-6, 0.1, 0.5 })
  {
    const double decay = HalfSpaceTable::GetDecay(absorption, 0.0);
    // Plain differences lose digits where decay is small.
    CheckClose((1.0 - absorption) * std::atanh(decay) / decay, 1.0, 1e-9, "decay");
  }
  CheckClose(HalfSpaceTable::GetDecay(1e-7, 0.9), std::sqrt(3e-7), 1e-5, "diffusion theory");
  Check(HalfSpaceTable::GetDecay(0.0, 0.5) == 0.0, "no absorption, no decay");
}

//------------------------------------------------------------------------------
void TestKept()
{
  HalfSpaceTable::Settings settings{ 0.7, 1.3, 0.0 };
  settings.NumberOfPhotons = 3000;
  settings.Seed = 77;
  // Nobody waits for it: nothing is kept.
  {
    const Pulse pulse([]() { return false; }, 0.0);
    bool isStopped = false;
    try
    {
      HalfSpaceTable::Get(settings);
    }
    catch (const Stopped&)
    {
      isStopped = true;
    }
    Check(isStopped, "an abort is heard");
  }
  const auto first = HalfSpaceTable::Get(settings);
  Check(first->GetNumberOfPhotons() == 3000, "as many photons as asked for");
  Check(HalfSpaceTable::Get(settings) == first, "tables are kept");
  for (const int threads : { 1, 3 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads),
      [&]()
      {
        const HalfSpaceTable again(settings);
        Check(again.Evaluate(0.3, 0.1) == first->Evaluate(0.3, 0.1) &&
            again.GetError() == first->GetError(),
          "the same bits on any number of threads");
      });
  }
  settings.Seed = 78;
  Check(HalfSpaceTable::Get(settings) != first, "another seed, another table");
  settings.Albedo = 1.0 - 1e-9;
  const auto clear = HalfSpaceTable::Get(settings);
  settings.Albedo = 1.0;
  Check(HalfSpaceTable::Get(settings) == clear, "those that absorb little share their walk");
}

//------------------------------------------------------------------------------
/// Three ranks share the photons, and get the bits of one, wherever some have the table already.
void TestRanks()
{
  HalfSpaceTable::Settings settings{ 0.9, 1.4, 0.3 };
  settings.NumberOfPhotons = 6400;
  const HalfSpaceTable one(settings);
  settings.NumberOfPhotons = 0;
  settings.Albedo = 0.9999;
  const HalfSpaceTable timed(settings);
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int)
    {
      const Ranks ranks(controller);
      HalfSpaceTable::Settings wanted = settings;
      const HalfSpaceTable open(wanted, ranks);
      Check(open.GetNumberOfPhotons() == timed.GetNumberOfPhotons() &&
          open.Evaluate(0.3, 0.1) == timed.Evaluate(0.3, 0.1),
        "as many photons on three ranks as work allows on one");
      wanted.NumberOfPhotons = 6400;
      wanted.Albedo = 0.9;
      int beats = 0;
      {
        const Pulse pulse(
          [&beats]()
          {
            ++beats;
            return true;
          },
          0.0);
        const HalfSpaceTable table(wanted, ranks);
        for (const double radius : { 0.01, 0.3, 5.0 })
        {
          Check(table.Evaluate(radius, 0.1) == one.Evaluate(radius, 0.1), "the bits of one rank");
        }
        Check(table.GetError() == one.GetError(), "the error of one rank");
      }
      Check(beats > 1800 && beats < 2800, "a third of the photons: " + std::to_string(beats));
    });
}

//------------------------------------------------------------------------------
void TestFilter()
{
  Surface plane;
  plane.AddGrid({ 0, 0, 0 }, { 20, 0, 0 }, { 0, 20, 0 }, 3, 3);
  auto data = plane.Get();
  AddArray(data, "TransmittedIrradiance", { 1.0, 1.0, 1.0 });
  vtkNew<vtkSubsurfaceScattering> filter;
  filter->SetInputData(data);
  filter->SetModelToTabulated();
  filter->SetNumberOfPhotons(2000);
  filter->SetAbsorptionCoefficient(0.01, 0.1, 0.1);
  filter->SetIncidenceToTransmitted();
  filter->SetDeviceToCPU();
  const auto get = [&filter](const char* name)
  {
    filter->Update();
    return filter->GetPolyDataOutput()->GetFieldData()->GetArray(name);
  };
  vtkDataArray* errors = get("ProfileError");
  if (!Check(errors && errors->GetNumberOfComponents() == 3, "ProfileError"))
  {
    return;
  }
  const double error = errors->GetComponent(0, 1);
  Check(error > 0.01 && error < 0.1 && errors->GetComponent(0, 2) == error, "of 2000 photons");
  filter->SetNumberOfPhotons(8000);
  CheckClose(get("ProfileError")->GetComponent(0, 1), 0.5 * error, 0.1, "half for 8000");
  const double before = get("LeavingFlux")->GetComponent(0, 0);
  filter->SetAnisotropy(0.7, 0.7, 0.7);
  const double after = get("LeavingFlux")->GetComponent(0, 0);
  Check(after != before && std::abs(after / before - 1.0) < 0.1, "anisotropy matters, a little");
  filter->SetLinkTolerance(1e-4);
  Check(get("LinksReused")->GetComponent(0, 0) == 0.0, "links made anew");
  filter->SetTargetError(0.5);
  Check(get("LinksReused")->GetComponent(0, 0) == 1.0, "and kept");
  filter->SetSeed(2);
  Check(get("LinksReused")->GetComponent(0, 0) == 0.0, "not for another seed");
}
} // namespace

//------------------------------------------------------------------------------
int TestTabulatedProfile(int, char*[])
{
  TestTotals();
  TestRings(1.0, RingsMatched);
  TestRings(1.4, Rings14);
  TestOtherSeed();
  TestDecay();
  TestKept();
  TestFilter();
  TestErrors();
  TestRanks();
  return Result();
}
