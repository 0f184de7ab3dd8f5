// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Scattering links through the air between parts of a body, and between bodies: what they carry,
// and the result without them.
#include "LightTransportTesting.h"
#include "RanksInThreads.h"
#include "VoxelBodies.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSubsurfaceScattering.h"

#include <algorithm>

using namespace LightTransportTesting;

namespace
{
/// Light on a polygon.
using Light = std::function<double(const Point& centre)>;

//------------------------------------------------------------------------------
Light Everywhere()
{
  return [](const Point&) { return 1.0; };
}

//------------------------------------------------------------------------------
/// Light on all that is left of a place.
Light LeftOf(double x)
{
  return [x](const Point& centre) { return centre[0] < x ? 1.0 : 0.0; };
}

//------------------------------------------------------------------------------
Point GetCentre(vtkPolyData* data, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  data->GetCellPoints(cell, ids);
  Point centre = {};
  for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
  {
    double point[3];
    data->GetPoint(ids->GetId(k), point);
    for (int axis = 0; axis < 3; ++axis)
    {
      centre[axis] += point[axis] / ids->GetNumberOfIds();
    }
  }
  return centre;
}

//------------------------------------------------------------------------------
void Illuminate(vtkPolyData* data, const Light& light)
{
  vtkDoubleArray* array = AddArray(data, "TransmittedIrradiance", { 0.0 });
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    array->SetValue(cell, light(GetCentre(data, cell)));
  }
}

//------------------------------------------------------------------------------
struct Outcome
{
  std::vector<double> Scattered; ///< patches x bands
  double Shares[3];
  double Errors[3];
  double Entering[3];
  double Leaving[3];
  double Reused;
};

//------------------------------------------------------------------------------
Outcome GetResult(vtkSubsurfaceScattering* filter)
{
  filter->Update();
  Outcome result;
  vtkDataObject* output = filter->GetOutputDataObject(0);
  const auto read = [output](const char* name, double* values)
  {
    vtkDataArray* array = output->GetFieldData()->GetArray(name);
    if (Check(array && array->GetNumberOfComponents() == 3, std::string("there is ") + name))
    {
      array->GetTuple(0, values);
    }
  };
  read("LinksThroughAir", result.Shares);
  read("LinksThroughAirError", result.Errors);
  read("EnteringFlux", result.Entering);
  read("LeavingFlux", result.Leaving);
  result.Reused = GetSummary(output, "LinksReused");
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(output);
  for (unsigned int block = 0; block < (blocks ? blocks->GetNumberOfBlocks() : 1u); ++block)
  {
    auto* surface = vtkPolyData::SafeDownCast(blocks ? blocks->GetBlock(block) : output);
    vtkDataArray* array = surface->GetCellData()->GetArray("ScatteredIrradiance");
    for (vtkIdType k = 0; k < 3 * array->GetNumberOfTuples(); ++k)
    {
      result.Scattered.push_back(array->GetComponent(k / 3, k % 3));
    }
  }
  return result;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkSubsurfaceScattering> MakeFilter(vtkDataObject* data, bool drops)
{
  auto filter = vtkSmartPointer<vtkSubsurfaceScattering>::New();
  filter->SetInputDataObject(data);
  filter->SetScatteringCoefficient(3.0, 2.0, 0.5);
  filter->SetAbsorptionCoefficient(0.1, 0.1, 0.5);
  filter->SetIncidenceToTransmitted();
  filter->SetModelToDipole();
  filter->SetLinkTolerance(1e-3);
  filter->SetDeviceToCPU();
  filter->SetLinkMethodToDense();
  filter->SetDropLinksThroughAir(drops);
  return filter;
}

//------------------------------------------------------------------------------
Outcome Scatter(vtkDataObject* data, bool drops)
{
  return GetResult(MakeFilter(data, drops));
}

//------------------------------------------------------------------------------
/// Light is lost where links are dropped, and nothing else changes; what is left.
void CheckBalance(const Outcome& with, const Outcome& without, const std::string& what)
{
  for (int band = 0; band < 3; ++band)
  {
    CheckClose(without.Leaving[band], (1.0 - without.Shares[band]) * with.Leaving[band], 1e-5,
      what + ": what is not dropped");
    Check(without.Errors[band] == 0.0, what + ": of all links the share is exact");
    Check(std::abs(with.Shares[band] - without.Shares[band]) <= 4.0 * with.Errors[band],
      what + ": the share of a sample is " + std::to_string(with.Shares[band]) + " +- " +
        std::to_string(with.Errors[band]) + ", that of all " +
        std::to_string(without.Shares[band]));
  }
}

//------------------------------------------------------------------------------
void CheckNone(vtkPolyData* data, const std::string& what, bool isConvex)
{
  Illuminate(data, Everywhere());
  const Outcome with = Scatter(data, false);
  const Outcome without = Scatter(data, true);
  for (int band = 0; band < 3; ++band)
  {
    Check(with.Shares[band] == 0.0 && without.Shares[band] == 0.0, what + ": no air between");
    Check(!isConvex || with.Errors[band] == 0.0, what + ": not even in doubt");
  }
  Check(with.Scattered == without.Scattered, what + ": the same bits");
}

//------------------------------------------------------------------------------
void TestNone()
{
  CheckNone(MakeCubes({ { 0, 0, 0 } }, 4), "a box", true);
  CheckNone(MakeCubes({ { 0, 0, 0 } }, 4, true, { 0.1, 0.2, 0.3 }), "a box, float", true);
  CheckNone(MakeCubes({ { 0, 0, 0 } }, 3, false, { 6e5, 6e6, 0 }), "a box far away", true);
  Surface sphere(true);
  AddSphere(sphere, 1.0, 2, false);
  CheckNone(sphere.Get(), "a sphere", true);
  Surface sheet;
  sheet.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 4);
  CheckNone(sheet.Get(), "a sheet", true);
  sheet.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 3, 3);
  CheckNone(sheet.Get(), "a sheet with two sides", true);
  Surface one;
  one.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  CheckNone(one.Get(), "one patch", true);
  // The two sides of its corner are not turned towards each other by more than a right angle.
  CheckNone(MakeCubes({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 } }, 4), "an angle iron", false);
  Surface touching;
  AddCubes(touching, { { 0, 0, 0 } }, 4);
  AddCubes(touching, { { 0, 0, 0 } }, 3, { 1, 0, 0 });
  CheckNone(touching.Get(), "bodies that touch", false);
}

//------------------------------------------------------------------------------
/// Two bodies, one of them lit: without the links from one to the other each is alone.
void TestTwoBodies()
{
  auto both = MakeCubes({ { 0, 0, 0 }, { 2, 0, 0 } }, 4);
  auto alone = MakeCubes({ { 0, 0, 0 } }, 4);
  Illuminate(alone, Everywhere());
  const Outcome single = Scatter(alone, false);
  for (const bool isLeft : { false, true })
  {
    Illuminate(both, isLeft ? LeftOf(1.5) : Everywhere());
    const Outcome with = Scatter(both, false);
    const Outcome without = Scatter(both, true);
    CheckBalance(with, without, "two bodies");
    const double bodies = isLeft ? 1.0 : 2.0;
    for (int band = 0; band < 3; ++band)
    {
      CheckClose(without.Leaving[band], bodies * single.Leaving[band], 1e-3, "each body alone");
      Check(without.Shares[band] > 5e-3, "there are links between them");
    }
    double largest = 0.0;
    for (std::size_t k = 0; k < without.Scattered.size(); ++k)
    {
      const bool isLit = !isLeft || k < single.Scattered.size();
      const double expected = isLit ? single.Scattered[k % single.Scattered.size()] : 0.0;
      largest = std::max(largest, std::abs(without.Scattered[k] - expected));
    }
    CheckClose(largest, 0.0, 1e-3, "each patch as on a body alone");
  }
}

//------------------------------------------------------------------------------
/// A horseshoe and a bowl, in several lights.
void TestConcave()
{
  auto horseshoe = MakeCubes(MakeHorseshoe(), 3);
  auto bowl = MakeBowl(4, 1.0, 1.3);
  // Inside of the left leg alone: to its other side, where no light goes but through the air.
  const Light inLeftLeg = [](const Point& centre)
  { return std::abs(centre[0] - 1.0) < 1e-9 && centre[2] > 1.0 ? 1.0 : 0.0; };
  const Light above = [](const Point& centre) { return std::max(centre[2], 0.0); };
  for (const auto& light : { Everywhere(), LeftOf(1.2), inLeftLeg, above })
  {
    Illuminate(horseshoe, light);
    const Outcome with = Scatter(horseshoe, false);
    const Outcome without = Scatter(horseshoe, true);
    CheckBalance(with, without, "a horseshoe");
    Check(without.Shares[0] > 0.01 && without.Shares[0] < 0.4, "light goes from leg to leg");
    Check(without.Shares[2] < 0.3, "no more than what leaves");
  }
  Illuminate(horseshoe, inLeftLeg);
  const Outcome with = Scatter(horseshoe, false);
  const Outcome without = Scatter(horseshoe, true);
  double through = 0.0, around = 0.0, beside = 0.0;
  for (vtkIdType cell = 0; cell < horseshoe->GetNumberOfCells(); ++cell)
  {
    const Point centre = GetCentre(horseshoe, cell);
    const bool isFacing = std::abs(centre[0] - 2.0) < 1e-9 && centre[2] > 1.0;
    const bool isLit = std::abs(centre[0] - 1.0) < 1e-9 && centre[2] > 1.0;
    through += isFacing ? without.Scattered[3 * cell] : 0.0;
    around += isFacing ? with.Scattered[3 * cell] : 0.0;
    const double change = std::abs(without.Scattered[3 * cell] - with.Scattered[3 * cell]);
    beside = std::max(beside, isLit || centre[0] < 1.0 ? change : 0.0);
  }
  Check(around > 0.01, "links cross to the other leg");
  Check(through == 0.0, "but those that are dropped");
  Check(beside == 0.0, "the same bits within a leg");

  Illuminate(bowl, Everywhere());
  const Outcome whole = Scatter(bowl, false);
  const Outcome dropped = Scatter(bowl, true);
  CheckBalance(whole, dropped, "a bowl");
  Check(dropped.Shares[1] > 0.01 && dropped.Shares[1] < 0.3, "light goes across the bowl");
}

//------------------------------------------------------------------------------
/// An open surface: what is behind its patches counts for inside.
void TestOpen()
{
  Surface inward, outward;
  AddSphere(inward, 1.0, 2, true);
  AddSphere(outward, 1.0, 2, false);
  const auto getHalf = [](const Surface& surface)
  {
    auto data = surface.Get();
    data->BuildLinks();
    for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
    {
      if (GetCentre(data, cell)[2] > 0.0)
      {
        data->DeleteCell(cell);
      }
    }
    data->RemoveDeletedCells();
    Illuminate(data, Everywhere());
    return data;
  };
  CheckNone(getHalf(outward), "the outside of half a sphere", true);
  const Outcome with = Scatter(getHalf(inward), false);
  const Outcome without = Scatter(getHalf(inward), true);
  CheckBalance(with, without, "the inside of half a sphere");
  Check(without.Shares[0] > 0.01, "the inside of half a sphere faces itself");
}

//------------------------------------------------------------------------------
void TestInputs()
{
  const auto compute = [](vtkDataObject* data) { return Scatter(data, true); };
  auto plain = MakeCubes(MakeHorseshoe(), 3);
  Illuminate(plain, LeftOf(1.2));
  const Outcome expected = compute(plain);
  const auto check = [&expected](const Outcome& result, double tolerance, const std::string& what)
  {
    for (int band = 0; band < 3; ++band)
    {
      CheckClose(result.Shares[band], expected.Shares[band], tolerance, what);
    }
  };
  auto single = MakeCubes(MakeHorseshoe(), 3, true);
  Illuminate(single, LeftOf(1.2));
  // Rounding decides of segments that touch an edge.
  check(compute(single), 5e-3, "single precision");
  auto far = MakeCubes(MakeHorseshoe(), 3, false, { 6e6, 6e5, 1e3 });
  Illuminate(far, LeftOf(6e6 + 1.2));
  check(compute(far), 5e-3, "far away");
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int leg = 0; leg < 2; ++leg)
  {
    vtkNew<vtkPolyData> part;
    part->DeepCopy(plain);
    part->BuildLinks();
    for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
    {
      if ((GetCentre(part, cell)[0] < 1.2) != (leg == 0))
      {
        part->DeleteCell(cell);
      }
    }
    part->RemoveDeletedCells();
    blocks->SetBlock(leg, part);
  }
  check(compute(blocks), 1e-6, "two blocks");

  auto filter = MakeFilter(plain, false);
  const Outcome first = GetResult(filter);
  Illuminate(plain, Everywhere());
  plain->Modified();
  const Outcome second = GetResult(filter);
  Check(first.Reused == 0.0 && second.Reused == 1.0, "new light takes the links that are there");
  Check(first.Shares[0] != second.Shares[0], "but carries more, or less, through air");
  Illuminate(plain, [](const Point&) { return 0.0; });
  plain->Modified();
  const Outcome dark = GetResult(filter);
  Check(dark.Shares[0] == 0.0 && dark.Errors[0] == 0.0, "none in the dark");
  filter->DropLinksThroughAirOn();
  Check(GetResult(filter).Reused == 0.0, "links are made anew to drop some");
}

//------------------------------------------------------------------------------
/// Three ranks, the last without anything.
void TestRanks()
{
  auto data = MakeCubes(MakeHorseshoe(), 3);
  Illuminate(data, LeftOf(1.2));
  for (const bool drops : { false, true })
  {
    const Outcome one = Scatter(data, drops);
    RunRanks(3,
      [&](vtkMultiProcessController* controller, int rank)
      {
        vtkNew<vtkPolyData> part;
        part->DeepCopy(data);
        part->BuildLinks();
        for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
        {
          if (rank != (GetCentre(part, cell)[0] < 1.7 ? 0 : 1))
          {
            part->DeleteCell(cell);
          }
        }
        part->RemoveDeletedCells();
        auto filter = MakeFilter(part, drops);
        filter->SetController(controller);
        const Outcome mine = GetResult(filter);
        for (int band = 0; band < 3; ++band)
        {
          CheckClose(mine.Leaving[band], one.Leaving[band], 1e-9, "ranks: leaving");
          CheckClose(mine.Shares[band], one.Shares[band], 1e-9, "ranks: through air");
          CheckClose(mine.Errors[band], one.Errors[band], 1e-9, "ranks: error");
        }
      });
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestLinksThroughAir(int, char*[])
{
  TestNone();
  TestTwoBodies();
  TestConcave();
  TestOpen();
  TestInputs();
  TestRanks();
  return Result();
}
