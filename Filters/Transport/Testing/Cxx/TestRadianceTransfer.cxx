// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Spherical harmonics against closed forms, and radiance transfer against them and against
 * vtkDirectIrradiance: with and without shadows, turned, in the kinds of input that occur.
 */
#include "EnvironmentTesting.h"
#include "LightTransportTesting.h"
#include "Shared/SphericalHarmonics.h"
#include "vtkDirectIrradiance.h"
#include "vtkRadianceTransfer.h"

#include "vtkExecutive.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkTestErrorObserver.h"

#include <iostream>

namespace
{
using namespace EnvironmentTesting;
using namespace LightTransport;
using namespace LightTransportTesting;

constexpr int Degree = 4;
const double Square = std::sqrt(0.5);

/// About an axis that is none of the picture's.
const SphericalHarmonics::Matrix Turned = { 0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6 };

Direction Move(const SphericalHarmonics::Matrix& matrix, const Direction& w)
{
  Direction moved;
  for (std::size_t k = 0; k < 3; ++k)
  {
    moved[k] = matrix[3 * k] * w[0] + matrix[3 * k + 1] * w[1] + matrix[3 * k + 2] * w[2];
  }
  return moved;
}

void TestHarmonics()
{
  constexpr int Most = vtkRadianceTransfer::LargestDegree;
  const std::size_t count = SphericalHarmonics::GetCount(Most);
  std::vector<double> products(count * count, 0.0);
  std::vector<double> values(count);
  const GaussLegendre heights(Most + 1);
  for (std::size_t row = 0; row < heights.Nodes.size(); ++row)
  {
    for (int column = 0; column < 2 * Most + 1; ++column)
    {
      const double z = 2.0 * heights.Nodes[row] - 1.0;
      const double angle = 2.0 * vtkMath::Pi() * column / (2 * Most + 1);
      const double w[3] = { std::sqrt(1.0 - z * z) * std::cos(angle),
        std::sqrt(1.0 - z * z) * std::sin(angle), z };
      SphericalHarmonics::Evaluate(Most, w, values.data());
      for (std::size_t k = 0; k < count * count; ++k)
      {
        products[k] += 4.0 * vtkMath::Pi() * heights.Weights[row] / (2 * Most + 1) *
          values[k / count] * values[k % count];
      }
    }
  }
  double error = 0.0;
  for (std::size_t k = 0; k < count * count; ++k)
  {
    error = std::max(error, std::abs(products[k] - (k / count == k % count ? 1.0 : 0.0)));
  }
  Check(error < 1e-13, "harmonics are not orthonormal: " + std::to_string(error));
  const double w[3] = { 0.36, 0.48, 0.8 };
  SphericalHarmonics::Evaluate(Most, w, values.data());
  CheckClose(values[1], std::sqrt(0.75 / vtkMath::Pi()) * w[1], 1e-14, "Y_1,-1");
  CheckClose(values[4], std::sqrt(3.75 / vtkMath::Pi()) * w[0] * w[1], 1e-14, "Y_2,-2");
  CheckClose(values[8], 0.5 * std::sqrt(3.75 / vtkMath::Pi()) * (w[0] * w[0] - w[1] * w[1]), 1e-14,
    "Y_2,2");
}

void TestKernel()
{
  const std::vector<double> open = SphericalHarmonics::GetCosineKernel(Degree, 1.0);
  const double expected[] = { 1.0, 2.0 / 3.0, 0.25, 0.0, -1.0 / 24.0 };
  for (std::size_t degree = 0; degree < open.size(); ++degree)
  {
    Check(std::abs(open[degree] - vtkMath::Pi() * expected[degree]) < 1e-12,
      "the cosine's harmonic of degree " + std::to_string(degree));
  }
  CheckClose(SphericalHarmonics::GetCosineKernel(Degree, 1.5)[0],
    vtkMath::Pi() * (1.0 - Fresnel::GetMeanExternalReflectance(1.5)), 1e-12,
    "what enters of even light");
}

/// A square floor, and a wall that stands on it.
vtkSmartPointer<vtkPolyData> MakeCorner(int count, bool isSingle = false, double shift = 0.0)
{
  Surface surface(isSingle);
  surface.AddGrid({ shift, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, count, count);
  surface.AddGrid({ shift, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, count, count);
  return surface.Get();
}

std::vector<double> Relight(vtkPolyData* surface, vtkRadianceTransfer* transfer, vtkImageData* sky)
{
  vtkNew<vtkDoubleArray> coefficients;
  transfer->ProjectEnvironment(sky, coefficients);
  vtkDataArray* array = surface->GetCellData()->GetArray("RadianceTransfer");
  std::vector<double> values(static_cast<std::size_t>(3 * surface->GetNumberOfCells()), 0.0);
  for (std::size_t k = 0; array && k < values.size(); ++k)
  {
    for (int harmonic = 0; harmonic < array->GetNumberOfComponents(); ++harmonic)
    {
      values[k] += array->GetComponent(static_cast<vtkIdType>(k / 3), harmonic) *
        coefficients->GetComponent(harmonic, static_cast<int>(k % 3));
    }
  }
  return values;
}

/// Relative, L2.
double GetDifference(const std::vector<double>& values, const std::vector<double>& expected)
{
  double errors = 0.0;
  double squares = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    errors += std::pow(values[k] - expected[k], 2);
    squares += std::pow(expected[k], 2);
  }
  return std::sqrt(errors / squares);
}

std::vector<double> LightDirectly(vtkPolyData* surface, vtkImageData* sky, double index)
{
  vtkNew<vtkDirectIrradiance> direct;
  direct->SetInputData(surface);
  direct->SetEnvironment(sky);
  direct->SetTolerance(1e-3);
  direct->SetEnvironmentSamples(1024);
  direct->SetRefractiveIndex(index);
  direct->Update();
  vtkDataArray* array = vtkPolyData::SafeDownCast(direct->GetOutputDataObject(0))
                          ->GetCellData()
                          ->GetArray(index > 1.0 ? "TransmittedIrradiance" : "DirectIrradiance");
  std::vector<double> values;
  for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
  {
    values.push_back(array->GetComponent(value / 3, static_cast<int>(value % 3)));
  }
  return values;
}

vtkPolyData* Transfer(vtkRadianceTransfer* transfer, vtkPolyData* surface, double index = 1.0)
{
  transfer->SetInputData(surface);
  transfer->SetRefractiveIndex(index);
  transfer->Update();
  return vtkPolyData::SafeDownCast(transfer->GetOutputDataObject(0));
}

void TestAgainstDirectIrradiance()
{
  const auto corner = MakeCorner(6);
  const auto sky = MakeSky(64, GetSoftSky);
  vtkNew<vtkRadianceTransfer> transfer;
  for (const double index : { 1.0, 1.3, 1.5 })
  {
    vtkPolyData* surface = Transfer(transfer, corner, index);
    const double error =
      GetDifference(Relight(surface, transfer, sky), LightDirectly(corner, sky, index));
    std::cout << "index " << index << ": relative error " << error << "\n";
    Check(error < 0.01, "transfer is not direct irradiance: " + std::to_string(error));
    CheckClose(surface->GetFieldData()->GetArray("RefractiveIndex")->GetComponent(0, 0), index, 0.0,
      "the index that is recorded");
    Check(surface->GetPointData()->GetArray("RadianceTransfer")->GetNumberOfComponents() == 25,
      "there are no values of points");
  }
  // More rays, less error: of the wall's shadow alone.
  transfer->SetSamples(4096);
  const std::vector<double> exact = Relight(Transfer(transfer, corner), transfer, sky);
  double before = 1.0;
  for (const int samples : { 16, 256 })
  {
    transfer->SetSamples(samples);
    const double error = GetDifference(Relight(Transfer(transfer, corner), transfer, sky), exact);
    std::cout << samples << " rays: relative error " << error << "\n";
    Check(error < 0.5 * before, "more rays are not better");
    before = error;
  }
  transfer->SetSamples(256);
  Check(before < 0.01, "256 rays are too few");
}

/// What is not hidden is exact, without a ray.
void TestOpenPatch()
{
  Surface square;
  square.AddPolygon(
    { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 1.0, Square, Square }, { 0.0, Square, Square } });
  vtkNew<vtkRadianceTransfer> transfer;
  vtkPolyData* surface = Transfer(transfer, square.Get(), 1.3);
  const double normal[3] = { 0.0, -Square, Square };
  double harmonics[25];
  SphericalHarmonics::Evaluate(Degree, normal, harmonics);
  const std::vector<double> kernel = SphericalHarmonics::GetCosineKernel(Degree, 1.3);
  vtkDataArray* array = surface->GetCellData()->GetArray("RadianceTransfer");
  for (int k = 0; k < 25; ++k)
  {
    const auto degree = static_cast<std::size_t>(std::sqrt(k + 0.5));
    Check(std::abs(array->GetComponent(0, k) - kernel[degree] * harmonics[k]) < 1e-12,
      "an open square, harmonic " + std::to_string(k));
  }
  CheckClose(surface->GetFieldData()->GetArray("RadianceTransferRays")->GetComponent(0, 0), 0.0,
    0.0, "rays of an open square");
}

/// Object and sky together, and the sky's coefficients alone.
void TestTurns()
{
  const auto corner = MakeCorner(4);
  vtkNew<vtkPolyData> other;
  other->DeepCopy(corner);
  for (vtkIdType point = 0; point < other->GetNumberOfPoints(); ++point)
  {
    Direction place;
    other->GetPoint(point, place.data());
    other->GetPoints()->SetPoint(point, Move(Turned, place).data());
  }
  const auto sky = MakeSky(64, GetSoftSky);
  SphericalHarmonics::Matrix back;
  for (std::size_t k = 0; k < 9; ++k)
  {
    back[k] = Turned[3 * (k % 3) + k / 3];
  }
  const auto turnedSky =
    MakeSky(64, [&back](const Direction& w) { return GetSoftSky(Move(back, w)); });
  vtkNew<vtkRadianceTransfer> transfer;
  transfer->SetSamples(1024);
  const std::vector<double> first = Relight(Transfer(transfer, corner), transfer, sky);
  const std::vector<double> second = Relight(Transfer(transfer, other), transfer, turnedSky);
  const double error = GetDifference(second, first);
  std::cout << "turned together: " << error << "\n";
  Check(error < 0.01, "sky and surface turned together: " + std::to_string(error));

  vtkNew<vtkDoubleArray> coefficients;
  vtkNew<vtkDoubleArray> turnedCoefficients;
  transfer->ProjectEnvironment(sky, coefficients);
  transfer->ProjectEnvironment(turnedSky, turnedCoefficients);
  const std::vector<double> values(coefficients->GetPointer(0), coefficients->GetPointer(0) + 75);
  const std::vector<double> turned = SphericalHarmonics::Turn(Degree, values, 3, back);
  const std::vector<double> expected(turnedCoefficients->GetPointer(0),
    turnedCoefficients->GetPointer(0) + 75);
  Check(GetDifference(turned, expected) < 1e-3, "coefficients that turn");
  Check(GetDifference(SphericalHarmonics::Turn(Degree, turned, 3, Turned), values) < 1e-12,
    "coefficients that turn there and back");
}

/// Single precision, far away, several blocks, nothing.
void TestInputs()
{
  const auto sky = MakeSky(32, GetSoftSky);
  vtkNew<vtkRadianceTransfer> transfer;
  const std::vector<double> plain = Relight(Transfer(transfer, MakeCorner(4)), transfer, sky);
  Check(GetDifference(Relight(Transfer(transfer, MakeCorner(4, true)), transfer, sky), plain) <
      1e-5,
    "float points");
  Check(GetDifference(Relight(Transfer(transfer, MakeCorner(4, false, 6e5)), transfer, sky),
          plain) < 1e-3,
    "far away");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeCorner(4));
  transfer->SetInputDataObject(blocks);
  transfer->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(transfer->GetOutputDataObject(0));
  Check(GetDifference(Relight(vtkPolyData::SafeDownCast(output->GetBlock(0)), transfer, sky),
          plain) < 1e-12,
    "composite input");
  vtkPolyData* one = Transfer(transfer, MakeCorner(1));
  Check(one->GetNumberOfCells() == 2 && one->GetCellData()->GetArray("RadianceTransfer"),
    "one patch and another");
}

void TestErrors()
{
  vtkNew<vtkRadianceTransfer> transfer;
  vtkNew<vtkTest::ErrorObserver> observer;
  transfer->AddObserver(vtkCommand::ErrorEvent, observer);
  transfer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  Transfer(transfer, MakeCorner(1), 0.5);
  Check(observer->GetErrorMessage().find("RefractiveIndex is 0.5") != std::string::npos,
    "an index below 1");
  observer->Clear();
  vtkNew<vtkPolyData> nothing;
  Transfer(transfer, nothing);
  Check(observer->GetErrorMessage().find("no polygons") != std::string::npos, "no surface");
  observer->Clear();
  vtkNew<vtkDoubleArray> coefficients;
  vtkNew<vtkImageData> empty;
  Check(!transfer->ProjectEnvironment(empty, coefficients) &&
      observer->CheckErrorMessage("two-dimensional image") == 0,
    "a picture without values");
  observer->Clear();
  Check(!transfer->ProjectEnvironment(nullptr, coefficients) &&
      observer->CheckErrorMessage("no environment") == 0,
    "no picture");
}

/// The back of the floor of a corner sees nothing but the sky below; fronts see what they did.
void TestTwoSided()
{
  vtkNew<vtkRadianceTransfer> filters[2];
  for (const bool isTwoSided : { false, true })
  {
    vtkRadianceTransfer* filter = filters[isTwoSided ? 1 : 0];
    filter->SetInputData(MakeCorner(3));
    filter->SetDegree(Degree);
    filter->SetTwoSided(isTwoSided);
    // Rays are others: as many that it does not matter.
    filter->SetSamples(4096);
    filter->Update();
  }
  vtkCellData* both = filters[1]->GetPolyDataOutput()->GetCellData();
  vtkDataArray* backs = both->GetArray("RadianceTransferBack");
  vtkCellData* single = filters[0]->GetPolyDataOutput()->GetCellData();
  Check(!single->GetArray("RadianceTransferBack"), "backs that nobody asked for");
  if (!Check(backs != nullptr, "no backs"))
  {
    return;
  }
  const double down[3] = { 0.0, 0.0, -1.0 };
  double harmonics[(Degree + 1) * (Degree + 1)];
  SphericalHarmonics::Evaluate(Degree, down, harmonics);
  const std::vector<double> kernel = SphericalHarmonics::GetCosineKernel(Degree, 1.0);
  double worst = 0.0;
  double errors = 0.0;
  double squares = 0.0;
  for (int k = 0; k < (Degree + 1) * (Degree + 1); ++k)
  {
    const auto degree = static_cast<std::size_t>(std::sqrt(k));
    worst = std::max(worst, std::abs(backs->GetComponent(0, k) - kernel[degree] * harmonics[k]));
    const double front = single->GetArray("RadianceTransfer")->GetComponent(0, k);
    const double other = both->GetArray("RadianceTransfer")->GetComponent(0, k);
    errors += std::pow(other - front, 2);
    squares += front * front;
  }
  Check(worst < 1e-12, "the back of a floor is off by " + std::to_string(worst));
  std::cout << "fronts of two sides differ by " << std::sqrt(errors / squares) << "\n";
  Check(errors < 4e-4 * squares, "fronts are others where backs count");
}
} // namespace

//------------------------------------------------------------------------------
int TestRadianceTransfer(int, char*[])
{
  TestHarmonics();
  TestKernel();
  TestOpenPatch();
  TestAgainstDirectIrradiance();
  TestTurns();
  TestInputs();
  TestErrors();
  TestTwoSided();
  return Result();
}
