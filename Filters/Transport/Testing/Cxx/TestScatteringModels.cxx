// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The table of models, and what each of them promises as a profile: for albedos and refractive
// indices from end to end.
#include "LightTransportTesting.h"
#include "Scattering/ScatteringMaterials.h"
#include "Scattering/ScatteringModels.h"
#include "vtkSubsurfaceScattering.h"

#include <set>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
// What ScatteringProfile::GetDecay promises of the logarithm's slope, and by how much it may be
// off.
constexpr double MostSlope = 1.1;
// A table of few photons keeps what a table promises.
const ScatteringOptions Options{ 1, 4096 };

// By its error the total of a model may exceed 1 where nothing is absorbed (index 1).
constexpr double LargestTotal = 1.154;

//------------------------------------------------------------------------------
void TestTable()
{
  // SetModel takes all numbers of ModelType and no others.
  vtkNew<vtkSubsurfaceScattering> filter;
  std::set<int> accepted;
  for (int number = -1; number < 100; ++number)
  {
    filter->SetModel(number);
    accepted.insert(filter->GetModel());
  }
  std::set<int> numbers;
  std::set<std::string> names;
  for (const ScatteringModel& model : ScatteringModels::GetAll())
  {
    Check(numbers.insert(model.Number).second, std::string("another number for ") + model.Name);
    Check(names.insert(model.Name).second, std::string("another name than ") + model.Name);
    Check(ScatteringModels::Find(model.Number) == &model, std::string("find ") + model.Name);
  }
  // Photons have links of their own.
  numbers.insert(vtkSubsurfaceScattering::MODEL_MONTE_CARLO);
  Check(numbers == accepted, "every ModelType has an entry, and every entry a ModelType");
  Check(numbers.count(vtkSubsurfaceScattering::MODEL_DIPOLE) == 1, "the dipole");
}

//------------------------------------------------------------------------------
void TestUnknown()
{
  const std::vector<ScatteringMedium> bands(3, { 1.0, 0.1, 1.3 });
  for (const int number : { -1, 99 })
  {
    Check(!ScatteringModels::Find(number), "no model " + std::to_string(number));
    ScatteringProfiles profiles;
    const Outcome made = ScatteringModels::MakeProfiles(number, {}, bands, profiles);
    Check(made.HasFailed() && profiles.empty(), "no profiles of model " + std::to_string(number));
    Check(made.GetMessage().find("Model is " + std::to_string(number)) != std::string::npos &&
        made.GetMessage().find("Dipole (0)") != std::string::npos,
      "problem and remedy in \"" + made.GetMessage() + "\"");
  }
  for (const ScatteringModel& model : ScatteringModels::GetAll())
  {
    ScatteringProfiles profiles;
    const Outcome made = ScatteringModels::MakeProfiles(model.Number, Options, bands, profiles);
    Check(made && profiles.size() == bands.size(), std::string("three bands of ") + model.Name);
  }
}

//------------------------------------------------------------------------------
void TestMaterials()
{
  for (int number = -1; number < 15; ++number)
  {
    const ScatteringMaterial* material = ScatteringMaterials::Find(number);
    Check((material != nullptr) == (number >= 1 && number <= 12),
      "material " + std::to_string(number));
    const char* name = vtkSubsurfaceScattering::GetMaterialName(number);
    Check(!material || std::string(name) == material->Name,
      "name of material " + std::to_string(number));
  }
}

//------------------------------------------------------------------------------
/// Radii from much smaller than the scale to where nothing is left.
void CheckProfile(const ScatteringProfile& profile, const std::string& what)
{
  const double pi = vtkMath::Pi();
  const double total = profile.GetTotal();
  const double scale = profile.GetSmallestScale();
  Check(std::isfinite(total) && total >= 0.0 && total <= LargestTotal, what + "total");
  Check(std::isfinite(scale) && scale > 0.0, what + "scale");
  Check(std::isfinite(profile.GetDecay()) && profile.GetDecay() >= 0.0, what + "decay");
  double before = profile.Evaluate(0.0);
  double tailBefore = total;
  double momentsBefore[3] = {};
  Check(profile.IsSingular() || std::isfinite(before), what + "finite at 0");
  for (double radius = 1e-3 * scale; radius < 1e5 * scale; radius *= 1.5)
  {
    const std::string where = what + std::to_string(radius / scale) + " scales: ";
    const double value = profile.Evaluate(radius);
    Check(value >= 0.0 && value <= before, where + "falls with distance");
    const double tail = profile.GetTail(radius);
    Check(tail >= 0.0 && tail <= tailBefore, where + "so does the tail");
    double moments[3];
    profile.GetMoments(radius, moments);
    CheckClose(2.0 * pi * moments[0] + tail, total, 1e-12, where + "disc + tail = total");
    for (int k = 0; k < 3; ++k)
    {
      Check(moments[k] >= momentsBefore[k] * (1.0 - 1e-9),
        where + "moment " + std::to_string(k) + " grows");
      momentsBefore[k] = moments[k];
    }
    Check(moments[1] <= radius * moments[0] * (1.0 + 1e-9) &&
        moments[2] <= radius * moments[1] * (1.0 + 1e-9),
      where + "moments in order");
    before = value;
    tailBefore = tail;
  }
}

//------------------------------------------------------------------------------
// Moments and slopes are those of the values. Midpoint rule over r = scale sinh(t): doubly fine for
// functions that fall like powers.
void CheckValues(const ScatteringProfile& profile, const std::string& what)
{
  const double scale = profile.GetSmallestScale();
  constexpr int steps = 4000;
  constexpr double furthest = 100.0; // scales
  const double step = std::asinh(furthest) / steps;
  double expected[3] = {};
  double before = profile.Evaluate(0.0);
  double rBefore = 0.0;
  for (int k = 0; k < steps; ++k)
  {
    const double r = scale * std::sinh((k + 0.5) * step);
    const double width = step * scale * std::cosh((k + 0.5) * step);
    const double value = profile.Evaluate(r);
    expected[0] += value * r * width;
    expected[1] += value * r * r * width;
    expected[2] += value * r * r * r * width;
    // Where what is left no longer matters nobody asks how fast it falls.
    const double steepest = profile.GetNearbySlope(std::sqrt(r * rBefore)) + profile.GetDecay();
    Check(!std::isfinite(before) || profile.GetTail(r) < 1e-6 * profile.GetTotal() ||
        std::log(before / value) <= MostSlope * steepest * width,
      what + "falls no faster than it says at " + std::to_string(r / scale) + " scales");
    before = value;
    rBefore = r;
  }
  double moments[3];
  profile.GetMoments(furthest * scale, moments);
  for (int k = 0; k < 3; ++k)
  {
    CheckClose(moments[k], expected[k], 1e-5, what + "moment " + std::to_string(k));
  }
}

//------------------------------------------------------------------------------
void TestValues()
{
  for (const ScatteringModel& model : ScatteringModels::GetAll())
  {
    for (const double albedo : { 0.1, 0.5, 0.9, 0.999 })
    {
      for (const double index : { 1.0, 1.3, 1.5 })
      {
        const auto profile = model.MakeProfile({ albedo, 1.0 - albedo, index }, Options);
        CheckValues(*profile,
          std::string(model.Name) + ", albedo " + std::to_string(albedo) + ", index " +
            std::to_string(index) + ": ");
      }
    }
  }
}

//------------------------------------------------------------------------------
void TestContract()
{
  for (const ScatteringModel& model : ScatteringModels::GetAll())
  {
    for (const double albedo : { 0.0, 0.1, 0.5, 0.9, 0.999, 1.0 - 1e-9, 1.0 })
    {
      for (const double index : { 1.0, 1.0001, 1.3, 1.5, 2.0 })
      {
        for (const double extinction : { 1e-3, 1.0, 1e3 })
        {
          const auto profile =
            model.MakeProfile({ albedo * extinction, (1.0 - albedo) * extinction, index }, Options);
          CheckProfile(*profile,
            std::string(model.Name) + ", albedo " + std::to_string(albedo) + ", index " +
              std::to_string(index) + ", " + std::to_string(extinction) + " per mm, ");
        }
      }
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestScatteringModels(int, char*[])
{
  TestTable();
  TestUnknown();
  TestMaterials();
  TestContract();
  TestValues();
  return Result();
}
