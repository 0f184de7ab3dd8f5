// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What tests of Monte Carlo through the filter share: boxes, and the filter with its messages.
#ifndef PhotonScatteringTesting_h
#define PhotonScatteringTesting_h

#include "LightTransportTesting.h"
#include "MessageLog.h"
#include "vtkExecutive.h"
#include "vtkSMPTools.h"
#include "vtkSubsurfaceScattering.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace LightTransportTesting
{
// Of a box with these corners, faces cut into as many quadrilaterals a side as the axis says.
inline void AddBox(Surface& surface, const Point& low, const Point& high, int cuts = 1)
{
  const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
  surface.AddGrid(low, { 0, y, 0 }, { x, 0, 0 }, cuts, cuts);
  surface.AddGrid({ low[0], low[1], high[2] }, { x, 0, 0 }, { 0, y, 0 }, cuts, cuts);
  surface.AddGrid(low, { x, 0, 0 }, { 0, 0, z }, cuts, cuts);
  surface.AddGrid({ low[0], high[1], low[2] }, { 0, 0, z }, { x, 0, 0 }, cuts, cuts);
  surface.AddGrid(low, { 0, 0, z }, { 0, y, 0 }, cuts, cuts);
  surface.AddGrid({ high[0], low[1], low[2] }, { 0, y, 0 }, { 0, 0, z }, cuts, cuts);
}

//------------------------------------------------------------------------------
inline vtkSmartPointer<vtkPolyData> MakeBox(const Point& low, const Point& high, int cuts = 1,
  bool single = false)
{
  Surface surface(single);
  AddBox(surface, low, high, cuts);
  auto data = surface.Get();
  AddArray(data, "Irradiance", { 1.0 });
  return data;
}

//------------------------------------------------------------------------------
/// Half a ball, as cut along its equator, without half a ball that is a little smaller.
inline vtkSmartPointer<vtkPolyData> MakeBowl(double thickness)
{
  constexpr int rings = 4, sectors = 12;
  std::vector<std::array<double, 2>> profile; // radius and height, the wall on the left
  for (int k = 0; k <= 2 * rings + 1; ++k)
  {
    const bool isOutside = k <= rings;
    const int ring = isOutside ? k : 2 * rings + 1 - k;
    const double angle = 0.5 * vtkMath::Pi() * ring / rings;
    const double radius = isOutside ? 1.0 : 1.0 - thickness;
    profile.push_back({ ring == 0 ? 0.0 : radius * std::sin(angle), -radius * std::cos(angle) });
  }
  const auto at = [&](std::size_t k, int sector)
  {
    const double angle = 2.0 * vtkMath::Pi() * (sector % sectors) / sectors;
    return Point{ profile[k][0] * std::cos(angle), profile[k][0] * std::sin(angle), profile[k][1] };
  };
  Surface surface;
  for (std::size_t k = 0; k + 1 < profile.size(); ++k)
  {
    for (int sector = 0; sector < sectors; ++sector)
    {
      std::vector<Point> corners = { at(k, sector) };
      if (profile[k][0] > 0.0)
      {
        corners.push_back(at(k, sector + 1));
      }
      corners.push_back(at(k + 1, sector + 1));
      if (profile[k + 1][0] > 0.0)
      {
        corners.push_back(at(k + 1, sector));
      }
      surface.AddPolygon(corners);
    }
  }
  auto data = surface.Get();
  AddArray(data, "Irradiance", { 1.0 });
  return data;
}

//------------------------------------------------------------------------------
struct PhotonRun
{
  vtkNew<vtkSubsurfaceScattering> Filter;
  vtkNew<MessageLog> Errors;
  vtkNew<MessageLog> Warnings;

  explicit PhotonRun(vtkDataObject* data)
  {
    this->Filter->SetInputDataObject(data);
    this->Filter->SetModelToMonteCarlo();
    this->Filter->SetNumberOfPhotons(20000);
    this->Filter->AddObserver(vtkCommand::ErrorEvent, this->Errors);
    this->Filter->AddObserver(vtkCommand::WarningEvent, this->Warnings);
    this->Filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Errors);
  }

  void SetMedium(double scattering, double absorption, double index)
  {
    this->Filter->SetScatteringCoefficient(scattering, scattering, scattering);
    this->Filter->SetAbsorptionCoefficient(absorption, absorption, absorption);
    this->Filter->SetRefractiveIndex(index);
  }

  vtkDataArray* Get(const char* name) const
  {
    auto* output = vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0));
    vtkDataArray* array = output ? output->GetCellData()->GetArray(name) : nullptr;
    Check(array != nullptr, std::string("the output has ") + name);
    return array;
  }
  // All values of an array, on this many threads.
  std::vector<double> GetValues(const char* name, int threads) const
  {
    std::vector<double> values;
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads, "STDThread", false },
      [&]()
      {
        this->Filter->Update();
        vtkDataArray* array = this->Get(name);
        for (vtkIdType k = 0; array && k < 3 * array->GetNumberOfTuples(); ++k)
        {
          values.push_back(array->GetComponent(k / 3, k % 3));
        }
      });
    return values;
  }
  double GetNumber(const char* name) const
  {
    return GetSummary(this->Filter->GetOutputDataObject(0), name);
  }
  // What entered and is told of.
  double GetAccounted() const
  {
    return this->GetNumber("LeavingShare") + this->GetNumber("UnscatteredShare") +
      this->GetNumber("LostShare");
  }
};

//------------------------------------------------------------------------------
inline void CheckFails(PhotonRun& run, const std::string& part, const std::string& what)
{
  run.Filter->Update();
  Check(run.Errors->GetAll().find(part) != std::string::npos,
    what + " is refused with \"" + part + "\", not \"" + run.Errors->GetAll() + "\"");
}

//------------------------------------------------------------------------------
inline void CheckWorks(PhotonRun& run, const std::string& what)
{
  run.Filter->Update();
  Check(run.Errors->GetAll().empty() && run.Warnings->GetAll().empty(),
    what + " says: " + run.Errors->GetAll() + run.Warnings->GetAll());
}

//------------------------------------------------------------------------------
/// Patches of two runs differ as their errors say.
inline void CheckSame(
  const PhotonRun& one, const PhotonRun& other, const std::string& what,
  const std::function<bool(vtkIdType)>& concerns = [](vtkIdType) { return true; })
{
  const auto get = [](const PhotonRun& run, const char* name, vtkIdType k)
  { return run.Get(name)->GetComponent(k / 3, k % 3); };
  double squares = 0.0;
  int count = 0, beyond = 0;
  const vtkIdType patches = one.Get("ScatteredIrradiance")->GetNumberOfTuples();
  for (vtkIdType k = 0; k < 3 * patches; ++k)
  {
    if (concerns(k / 3))
    {
      const double deviation =
        (get(one, "ScatteredIrradiance", k) - get(other, "ScatteredIrradiance", k)) /
        std::hypot(get(one, "ScatteredIrradianceError", k),
          get(other, "ScatteredIrradianceError", k));
      squares += deviation * deviation;
      beyond += std::abs(deviation) > 3.0;
      ++count;
    }
  }
  CheckClose(squares / count, 1.0, 5.0 * std::sqrt(2.0 / count),
    "squares of deviations over errors, " + what);
  Check(beyond <= 2 + count / 50,
    what + ": " + std::to_string(beyond) + " of " + std::to_string(count) +
      " values beyond three errors");
}

} // namespace LightTransportTesting

#endif
