// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Progressive refinement on a device (vtkDeviceShooter) in the Cornell box: shots per second, when
 * the largest unshot radiosity is below a tenth of the first one (the first picture), and the error
 * of the irradiance against the dense solution on the CPU after more and more shots.
 *
 *   ShooterBenchmark [--sweeps S] EDGE...
 *
 * For each longest edge in millimetres (default 86 and 22: about 2,000 and 32,000 triangles) up to
 * S shots per patch (default 0.1). The error is given up to 4,000 triangles.
 */
#include "CornellBoxTesting.h"
#include "vtkDeviceShooter.h"
#include "vtkRadiosity.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cstdlib>

using namespace LightTransportTesting;

namespace
{
using Vector = std::vector<double>;

constexpr vtkIdType LargestDense = 4000;

//------------------------------------------------------------------------------
vtkDeviceShooter::Patches DescribePatches(vtkPolyData* scene)
{
  vtkDeviceShooter::Patches patches;
  for (vtkIdType point = 0; point < scene->GetNumberOfPoints(); ++point)
  {
    const double* place = scene->GetPoint(point);
    patches.Points.insert(patches.Points.end(), place, place + 3);
  }
  patches.Offsets.push_back(0);
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < scene->GetNumberOfCells(); ++cell)
  {
    scene->GetCellPoints(cell, corners);
    double p[3][3], u[3], v[3], normal[3];
    for (int corner = 0; corner < 3; ++corner)
    {
      patches.Corners.push_back(corners->GetId(corner));
      scene->GetPoint(corners->GetId(corner), p[corner]);
    }
    patches.Offsets.push_back(static_cast<vtkIdType>(patches.Corners.size()));
    vtkMath::Subtract(p[1], p[0], u);
    vtkMath::Subtract(p[2], p[0], v);
    vtkMath::Cross(u, v, normal);
    patches.Areas.push_back(0.5 * vtkMath::Normalize(normal));
    patches.Normals.insert(patches.Normals.end(), normal, normal + 3);
  }
  return patches;
}

//------------------------------------------------------------------------------
/// Empty where the scene is too large.
Vector SolveDense(vtkPolyData* scene)
{
  if (scene->GetNumberOfCells() > LargestDense)
  {
    return {};
  }
  vtkNew<vtkRadiosity> dense;
  dense->SetInputData(scene);
  dense->SetDeviceToCPU();
  dense->SetViewFactorTolerance(1e-3);
  dense->Update();
  return GetCellValues(dense->GetPolyDataOutput(), "Irradiance");
}

//------------------------------------------------------------------------------
void Print(vtkDeviceShooter* shooter, vtkPolyData* scene, const Vector& exact, vtkIdType shots,
  double seconds)
{
  std::cout << "  " << shots << " shots, " << seconds << " s, "
            << static_cast<double>(shots) / seconds << " shots/s";
  Vector irradiance(exact.size());
  if (!exact.empty() && shooter->GetIrradiance(irradiance.data()))
  {
    std::cout << ", L2 error of the irradiance " << Compare(scene, irradiance, exact);
  }
  std::cout << std::endl;
}

//------------------------------------------------------------------------------
void Measure(vtkDeviceShooter* shooter, double edge, double sweeps)
{
  auto scene = MakeCornellBox(edge);
  const Vector exact = SolveDense(scene);
  const Vector emission = GetCellValues(scene, "Emission");
  const Vector reflectance = GetCellValues(scene, "Reflectance");
  const vtkIdType patches = scene->GetNumberOfCells();
  const int bands = static_cast<int>(emission.size() / static_cast<std::size_t>(patches));
  Vector first(static_cast<std::size_t>(bands));
  Vector largest(first);
  if (!shooter->Initialize(DescribePatches(scene), bands, emission.data(), reflectance.data()) ||
    !shooter->GetLargestUnshot(first.data()))
  {
    return;
  }
  std::cout << patches << " triangles, " << bands << " bands, " << shooter->GetDeviceName()
            << std::endl;
  const double begin = vtkTimerLog::GetUniversalTime();
  const auto most = static_cast<vtkIdType>(sweeps * static_cast<double>(patches));
  bool isPicture = false;
  vtkIdType next = 1;
  for (vtkIdType shots = 0; shots < most;)
  {
    const vtkIdType done = shooter->Shoot(std::min<vtkIdType>(16, most - shots));
    if (done <= 0 || !shooter->GetLargestUnshot(largest.data()))
    {
      break;
    }
    shots += done;
    const double seconds = vtkTimerLog::GetUniversalTime() - begin;
    double left = 0.0;
    for (std::size_t band = 0; band < largest.size(); ++band)
    {
      left = std::max(left, largest[band] / first[band]);
    }
    if (!isPicture && left < 0.1)
    {
      isPicture = true;
      std::cout << "  first picture after " << shots << " shots, " << seconds << " s" << std::endl;
    }
    if (shots >= next || shots >= most)
    {
      next = 2 * shots;
      Print(shooter, scene, exact, shots, seconds);
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Vector edges;
  double sweeps = 0.1;
  for (int argument = 1; argument < argc; ++argument)
  {
    if (std::string(argv[argument]) == "--sweeps" && argument + 1 < argc)
    {
      sweeps = std::atof(argv[++argument]);
    }
    else
    {
      edges.push_back(std::atof(argv[argument]));
    }
  }
  auto shooter = vtkSmartPointer<vtkDeviceShooter>::Take(vtkDeviceShooter::New());
  std::string reason = "no loaded module shoots";
  if (!shooter || !shooter->Open(reason))
  {
    std::cerr << reason << std::endl;
    return EXIT_FAILURE;
  }
  for (const double edge : edges.empty() ? Vector{ 86.0, 22.0 } : edges)
  {
    Measure(shooter, edge, sweeps);
  }
  return EXIT_SUCCESS;
}
