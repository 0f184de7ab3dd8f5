// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Links from rays: what must hold for any scene, and how far they are from the matrix of all pairs.
#include "MessageLog.h"
#include "OutcomeTesting.h"
#include "RanksInThreads.h"
#include "Scene/PatchScene.h"
#include "ViewFactorTesting.h"
#include "ViewFactors/RaySamples.h"
#include "ViewFactors/SampledViewFactors.h"
#include "ViewFactors/ViewFactorStore.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkViewFactors> Sample(vtkPolyData* data, double tolerance, bool twoSided = false)
{
  auto factors = vtkSmartPointer<vtkViewFactors>::New();
  vtkNew<MessageLog> log;
  factors->AddObserver(vtkCommand::ErrorEvent, log);
  factors->SetInputData(data);
  factors->SetLinkMethodToSampled();
  factors->SetLinkTolerance(tolerance);
  factors->SetTwoSided(twoSided);
  factors->Update();
  Check(log->GetAll().empty(), "no errors: " + log->GetAll());
  return factors;
}

//------------------------------------------------------------------------------
/// All factors, row by row.
std::vector<double> GetAll(vtkViewFactors* factors, vtkIdType faces)
{
  std::vector<double> all(faces * faces);
  for (vtkIdType i = 0; i < faces; ++i)
  {
    for (vtkIdType j = 0; j < faces; ++j)
    {
      all[i * faces + j] = factors->GetViewFactor(i, j);
    }
  }
  return all;
}

//------------------------------------------------------------------------------
/// Whether rows sum to 1 with sky and back faces, and the exchange is symmetric.
void CheckRows(vtkPolyData* data, const std::string& name, bool twoSided = false)
{
  auto factors = Sample(data, 5e-2, twoSided);
  std::vector<double> areas = GetAreas(data);
  std::vector<double> sky = GetCellValues(factors, "SkyFraction");
  std::vector<double> back = GetCellValues(factors, "BackFaceFraction");
  if (twoSided)
  {
    const std::vector<double> skyBack = GetCellValues(factors, "SkyFractionBack");
    const std::vector<double> backBack = GetCellValues(factors, "BackFaceFractionBack");
    areas.insert(areas.end(), areas.begin(), areas.end());
    sky.insert(sky.end(), skyBack.begin(), skyBack.end());
    back.insert(back.end(), backBack.begin(), backBack.end());
  }
  const auto faces = static_cast<vtkIdType>(areas.size());
  const std::vector<double> all = GetAll(factors, faces);
  double worst = 0.0, asymmetry = 0.0;
  for (vtkIdType i = 0; i < faces; ++i)
  {
    double sum = sky[i] + back[i];
    for (vtkIdType j = 0; j < faces; ++j)
    {
      const double here = areas[i] * all[i * faces + j];
      const double there = areas[j] * all[j * faces + i];
      asymmetry = std::max(asymmetry, std::abs(here - there) / areas[i]);
      sum += all[i * faces + j];
    }
    worst = std::max(worst, std::abs(1.0 - sum));
  }
  CheckClose(worst, 0.0, 1e-11, name + ": rows sum to 1");
  CheckClose(asymmetry, 0.0, 1e-10, name + ": symmetric");
}

//------------------------------------------------------------------------------
/// A closed box with a smaller one in it, far from the origin or not.
Surface MakeBoxes(bool single, double offset)
{
  Surface surface(single);
  const auto at = [offset](double x, double y, double z) {
    return Point{ offset + x, offset + y, z };
  };
  AddBox(surface, at(0, 0, 0), at(40, 30, 20), 8.0, true);
  AddBox(surface, at(12, 10, 5), at(24, 20, 10), 5.0, false);
  return surface;
}

//------------------------------------------------------------------------------
void TestRows()
{
  CheckRows(MakeRoom(4), "room");
  CheckRows(MakeBoxes(false, 0.0).Get(), "boxes");
  CheckRows(MakeBoxes(true, 6e5).Get(), "boxes in single precision at an offset");
  CheckRows(MakeBoxes(false, 6e6).Get(), "boxes at an offset");

  Surface open;
  open.AddGrid({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 6, 6);
  AddBox(open, { 1, 1, 0.1 }, { 2, 2, 1.4 }, 0.5, false);
  CheckRows(open.Get(), "open");

  // A sheet between two others: its back counts, or absorbs.
  Surface sheets;
  sheets.AddGrid({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 5, 5);
  sheets.AddGrid({ 0, 0, 2 }, { 0, 4, 0 }, { 4, 0, 0 }, 5, 5);
  sheets.AddGrid({ 1, 1, 1 }, { 2, 0, 0 }, { 0, 2, 0 }, 3, 3);
  CheckRows(sheets.Get(), "sheet");
  CheckRows(sheets.Get(), "sheet with two sides", true);

  Surface one;
  one.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
  CheckRows(one.Get(), "one patch");
  CheckClose(GetCellValues(Sample(one.Get(), 0.1), "SkyFraction")[0], 1.0, 0.0, "sky of one patch");

  // One patch of a millionth of the area.
  Surface small;
  AddBox(small, { 0, 0, 0 }, { 1, 1, 1 }, 0.5, true);
  const double e = 1e-3;
  small.AddPolygon({ { 0.5, 0.5, 0.3 }, { 0.5 + e, 0.5, 0.3 }, { 0.5, 0.5 + 2.0 * e, 0.3 } });
  CheckRows(small.Get(), "small patch");
}

//------------------------------------------------------------------------------
/// What one of two plates sends the other is what it receives from there: rows close only where
/// openings give a little.
void TestPlates()
{
  Surface plates;
  plates.AddGrid({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 6, 6);
  plates.AddGrid({ 0, 0, 2 }, { 0, 4, 0 }, { 4, 0, 0 }, 5, 5);
  CheckRows(plates.Get(), "two plates");
  const std::vector<double> sky = GetCellValues(Sample(plates.Get(), 5e-2), "SkyFraction");
  const std::vector<double> right =
    GetCellValues(ComputeViewFactors(plates.Get(), 1e-4), "SkyFraction");
  double squares = 0.0;
  for (std::size_t patch = 0; patch < sky.size(); ++patch)
  {
    squares += std::pow(sky[patch] - right[patch], 2);
  }
  // 64 independent rays would give .06.
  const double error = std::sqrt(squares / static_cast<double>(sky.size()));
  Check(error < 0.03, "sky of plates: " + std::to_string(error));
}

//------------------------------------------------------------------------------
/// Rows close where two surfaces hardly see anything but each other: a box just above the floor.
void TestNarrowGap()
{
  Surface room;
  AddBox(room, { 0, 0, 0 }, { 4, 3, 2.5 }, 0.4, true);
  AddBox(room, { 1, 1, 0.005 }, { 3, 2, 0.5 }, 0.25, false);
  CheckRows(room.Get(), "box above a floor");
  const std::vector<double> sky = GetCellValues(Sample(room.Get(), 5e-2), "SkyFraction");
  CheckClose(*std::max_element(sky.begin(), sky.end()), 0.0, 0.0, "nothing of it goes to the sky");
}

//------------------------------------------------------------------------------
/// Nothing gets out of a closed room: rays that start on the plane of a wall, as far as single
/// precision tells, meet it.
void TestCorners()
{
  const std::vector<double> sky =
    GetCellValues(Sample(MakeBoxes(true, 6e4).Get(), 1e-2), "SkyFraction");
  CheckClose(*std::max_element(sky.begin(), sky.end()), 0.0, 0.0,
    "sky in a room in single precision at an offset");
}

//------------------------------------------------------------------------------
/// Two rooms that share a wall, which is meshed differently on both sides: none sees the other.
void TestSharedWall()
{
  Surface rooms(true);
  AddBox(rooms, { 0, 0, 0 }, { 1, 1, 1 }, 0.5, true);
  const auto first = rooms.Get()->GetNumberOfCells();
  AddBox(rooms, { 1, 0, 0 }, { 2, 1, 1 }, 0.34, true);
  auto data = rooms.Get();
  const vtkIdType patches = data->GetNumberOfCells();
  auto factors = Sample(data, 2e-2);
  double across = 0.0;
  for (vtkIdType i = 0; i < first; ++i)
  {
    for (vtkIdType j = first; j < patches; ++j)
    {
      across = std::max(across, factors->GetViewFactor(i, j));
    }
  }
  Check(across == 0.0, "nothing is seen through a shared wall: " + std::to_string(across));
  const std::vector<double> sky = GetCellValues(factors, "SkyFraction");
  const std::vector<double> back = GetCellValues(factors, "BackFaceFraction");
  Check(*std::max_element(sky.begin(), sky.end()) == 0.0 &&
      *std::max_element(back.begin(), back.end()) == 0.0,
    "two rooms are closed");
}

//------------------------------------------------------------------------------
/// What all of an inner sphere sends meets the outer one, and reciprocity tells the rest; single
/// factors come closer to those of the matrix with more rays.
void TestErrors()
{
  Surface spheres;
  AddSphere(spheres, 1.0, 1, false);
  const auto inner = spheres.Get()->GetNumberOfCells();
  AddSphere(spheres, 3.0, 1, true);
  auto data = spheres.Get();
  const vtkIdType patches = data->GetNumberOfCells();
  const std::vector<double> areas = GetAreas(data);
  auto matrix = ComputeViewFactors(data, 1e-4);
  double last = 1e3;
  for (const double tolerance : { 1e-1, 2e-2, 4e-3 })
  {
    auto factors = Sample(data, tolerance);
    double sum = 0.0, inside = 0.0, area = 0.0;
    for (vtkIdType i = 0; i < patches; ++i)
    {
      for (vtkIdType j = 0; j < patches; ++j)
      {
        const double error = factors->GetViewFactor(i, j) - matrix->GetViewFactor(i, j);
        sum += areas[i] * error * error;
        inside += i < inner && j >= inner ? areas[i] * factors->GetViewFactor(i, j) : 0.0;
      }
      area += i < inner ? areas[i] : 0.0;
    }
    CheckClose(inside / area, 1.0, 1e-10, "all of the inner sphere's light");
    Check(sum < 0.25 * last, "error falls with rays: " + std::to_string(sum));
    last = sum;
  }
  Check(last < 1e-2, "error of single factors: " + std::to_string(last));
}

//------------------------------------------------------------------------------
void TestThreads()
{
  std::vector<std::vector<double>> results;
  auto data = MakeBoxes(false, 0.0).Get();
  for (const int threads : { 1, 3 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&]() { results.push_back(GetAll(Sample(data, 5e-2), data->GetNumberOfCells())); });
  }
  Check(std::memcmp(results[0].data(), results[1].data(), results[0].size() * sizeof(double)) == 0,
    "the same bits with any number of threads");
}

//------------------------------------------------------------------------------
/// Each rank casts the rays of a range of patches; their links add up to those of one. Where some
/// are bright, too.
void TestRanks(bool areBright)
{
  auto data = MakeBoxes(false, 0.0).Get();
  ViewFactorSettings settings{ 1e-3, false, LinkMethod::Sampled, 5e-2 };
  PatchScene scene;
  CheckDone(scene.Build(data, Ranks()), "scene");
  const vtkIdType patches = scene.GetNumberOfPatches();
  if (areBright)
  {
    settings.Plan.Rays = { 64, std::vector<unsigned char>(patches, 0) };
    settings.Plan.Rays.Doublings[1] = 4;
  }
  ViewFactorStore whole;
  CheckDone(whole.Update(scene, settings, {}, Ranks(), Monitor()), "links");
  std::vector<double> sums(patches * patches, 0.0);
  std::mutex mutex;
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int)
    {
      ViewFactorStore part;
      CheckDone(part.Update(scene, settings, {}, Ranks(controller), Monitor()), "links of a rank");
      const std::lock_guard<std::mutex> lock(mutex);
      for (vtkIdType i = 0; i < patches; ++i)
      {
        for (vtkIdType j = 0; j < patches; ++j)
        {
          sums[i * patches + j] += part.GetLinks().Hierarchy->GetValue(i, j);
        }
      }
    });
  double worst = 0.0;
  for (vtkIdType i = 0; i < patches; ++i)
  {
    for (vtkIdType j = 0; j < patches; ++j)
    {
      worst = std::max(worst,
        std::abs(sums[i * patches + j] - whole.GetLinks().Hierarchy->GetValue(i, j)) /
          scene.GetAreas()[i]);
    }
  }
  Check(worst < 1e-7, "links of three ranks, off by " + std::to_string(worst));
}

//------------------------------------------------------------------------------
Links LinkBy(const SamplingPlan& plan, const PatchScene& scene,
  const std::shared_ptr<RaySamples>& samples)
{
  Links links;
  CheckDone(SampledViewFactors(plan, samples).Build(scene, Ranks(), Monitor(), links), "links");
  return links;
}

//------------------------------------------------------------------------------
bool AreSame(const Links& a, const Links& b)
{
  return a.Hierarchy->GetColumns() == b.Hierarchy->GetColumns() &&
    a.Hierarchy->GetValues() == b.Hierarchy->GetValues() &&
    a.Hierarchy->GetWeights() == b.Hierarchy->GetWeights() && a.RowSums == b.RowSums &&
    a.SkyFractions == b.SkyFractions;
}

//------------------------------------------------------------------------------
/// How far the rows of some patches are from others, relative to the length of these.
double CompareRows(const Links& a, const Links& b, const std::vector<vtkIdType>& rows)
{
  double squares = 0.0, whole = 0.0;
  for (const vtkIdType row : rows)
  {
    for (vtkIdType other = 0; other < a.Hierarchy->GetNumberOfPatches(); ++other)
    {
      const double right = b.Hierarchy->GetValue(row, other);
      squares += std::pow(a.Hierarchy->GetValue(row, other) - right, 2);
      whole += right * right;
    }
  }
  return std::sqrt(squares / whole);
}

//------------------------------------------------------------------------------
/// Patches that cast more rays than others: rows sum to 1 and are symmetric, the links are better
/// known and the same bits whether rays are cast at once or step by step, by any number of threads.
void TestBrightPatches()
{
  Surface yard;
  yard.AddGrid({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 8, 8);
  AddBox(yard, { 1, 1, 0.1 }, { 2, 2, 1.4 }, 0.5, false);
  for (const auto& data : { MakeBoxes(false, 0.0).Get(), yard.Get() })
  {
    PatchScene scene;
    CheckDone(scene.Build(data, Ranks()), "scene");
    const vtkIdType patches = scene.GetNumberOfPatches();
    SamplingPlan few, bright, more, many;
    few.Rays = { 16, {} };
    bright.Rays = { 16, std::vector<unsigned char>(patches, 0) };
    const std::vector<vtkIdType> rows = { 3, patches / 2 };
    for (const vtkIdType row : rows)
    {
      bright.Rays.Doublings[row] = row == 3 ? 6 : 7;
    }
    more.Rays = { 48, bright.Rays.Doublings };
    many.Rays = { 16384, {} };

    const auto samples = std::make_shared<RaySamples>();
    const Links known = LinkBy(many, scene, std::make_shared<RaySamples>());
    const Links first = LinkBy(few, scene, samples);
    const Links second = LinkBy(bright, scene, samples);
    const Links third = LinkBy(more, scene, samples);
    Check(AreSame(third, LinkBy(more, scene, std::make_shared<RaySamples>())), "step by step");
    Check(AreSame(second, LinkBy(bright, scene, samples)), "of what there is");
    vtkSMPTools::LocalScope(vtkSMPTools::Config(5, "STDThread", false),
      [&]()
      {
        Check(AreSame(third, LinkBy(more, scene, std::make_shared<RaySamples>())),
          "any number of threads");
      });

    const double before = CompareRows(first, known, rows);
    const double after = CompareRows(second, known, rows);
    Check(after < 0.3 * before,
      "more rays know more: " + std::to_string(before) + " " + std::to_string(after));
    for (vtkIdType i = 0; i < patches; ++i)
    {
      CheckClose(second.RowSums[i] + second.SkyFractions[i] + second.BackFaceFractions[i], 1.0,
        1e-11, "a row's sum");
      for (vtkIdType j = 0; j < i; ++j)
      {
        const double here = second.Hierarchy->GetValue(i, j);
        CheckClose(second.Hierarchy->GetValue(j, i), here, 1e-15, "symmetric");
      }
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestSampledViewFactors(int, char*[])
{
  TestRows();
  TestPlates();
  TestNarrowGap();
  TestCorners();
  TestSharedWall();
  TestErrors();
  TestThreads();
  TestRanks(false);
  TestRanks(true);
  TestBrightPatches();
  return Result();
}
