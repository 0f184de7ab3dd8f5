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
} // namespace LightTransportTesting

#endif
