// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Runs of vtkRadiosity in a room with a box, and how wrong they are.
#ifndef AccuracyTesting_h
#define AccuracyTesting_h

#include "RadiosityTesting.h"

#include <cmath>
#include <functional>
#include <string>

namespace LightTransportTesting
{
using Settings = std::function<void(vtkRadiosity*)>;

//------------------------------------------------------------------------------
/// A run of a filter of its own, on the CPU.
struct Solved
{
  std::string Messages;
  vtkNew<vtkRadiosity> Filter;

  Solved(
    vtkPolyData* data, int linkMethod, const Settings& settings = [](vtkRadiosity*) {})
  {
    vtkNew<MessageLog> observer;
    this->Filter->AddObserver(vtkCommand::ErrorEvent, observer);
    this->Filter->AddObserver(vtkCommand::WarningEvent, observer);
    this->Filter->SetInputData(data);
    this->Filter->SetDeviceToCPU();
    this->Filter->SetTolerance(1e-8);
    this->Filter->SetLinkMethod(linkMethod);
    this->Filter->SetViewFactorTolerance(
      linkMethod == vtkRadiosity::LINK_METHOD_DENSE ? 1e-3 : 0.0);
    settings(this->Filter);
    this->Filter->Update();
    this->Messages = observer->GetAllButVerdict();
    this->Filter->RemoveAllObservers();
  }

  Vector Get(const char* name) const
  {
    vtkDataArray* array = this->Filter->GetPolyDataOutput()->GetCellData()->GetArray(name);
    Check(array != nullptr, std::string(name) + " is there: " + this->Messages);
    return array ? ToVector(GetValues(array)) : Vector();
  }
  double GetNumber(const char* name) const
  {
    return GetSummary(this->Filter->GetPolyDataOutput(), name);
  }
};

constexpr int Dense = vtkRadiosity::LINK_METHOD_DENSE;
constexpr int Sampled = vtkRadiosity::LINK_METHOD_SAMPLED;

//------------------------------------------------------------------------------
/// A room with a box in it, lit by a small lamp; open at the top or not.
inline vtkSmartPointer<vtkPolyData> MakeScene(double reflectance, bool open = false)
{
  Surface room;
  AddBox(room, { 0, 0, 0 }, { 4, 3, 2.5 }, 0.5, true);
  AddBox(room, { 1.0, 1.0, 0.4 }, { 2.5, 2.0, 0.9 }, 0.4, false);
  auto data = room.Get();
  const vtkIdType lamp = data->GetNumberOfCells();
  room.AddPolygon({ { 2, 1.5, 2.2 }, { 2, 1.6, 2.2 }, { 2.1, 1.6, 2.2 }, { 2.1, 1.5, 2.2 } });
  data = room.Get();
  if (open)
  {
    // The ceiling comes second of the pairs of walls of the last axis.
    Surface floor;
    AddBox(floor, { 1.0, 1.0, 0.1 }, { 2.5, 2.0, 0.9 }, 0.4, false);
    floor.AddGrid({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 3, 0 }, 8, 6);
    data = floor.Get();
  }
  AddArray(data, "Reflectance", { reflectance });
  AddArray(data, "Emission", { 0.0 })->SetValue(open ? 3 : lamp, 1.0);
  return data;
}

//------------------------------------------------------------------------------
/// sqrt(sum A (B - R)^2 / sum A (R - E)^2)
inline double Compare(vtkPolyData* data, const Vector& found, const Vector& right)
{
  const Vector areas = ToVector(GetAreas(data));
  const Vector emission = ToVector(GetValues(data->GetCellData()->GetArray("Emission")));
  return std::sqrt(
    areas.dot((found - right).cwiseAbs2()) / areas.dot((right - emission).cwiseAbs2()));
}
} // namespace LightTransportTesting

#endif
