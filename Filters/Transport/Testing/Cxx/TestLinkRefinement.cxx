// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Which links between clusters a scene gets: their error against the matrix of all pairs, and what
// they must not depend on.
#include "Links/Links.h"
#include "OutcomeTesting.h"
#include "RanksInThreads.h"
#include "Scene/PatchScene.h"
#include "ViewFactorTesting.h"
#include "ViewFactors/HierarchicalViewFactors.h"
#include "ViewFactors/PairLooks.h"
#include "ViewFactors/ViewFactorStore.h"
#include "vtkCPULinkOperator.h"
#include "vtkExchangeHierarchy.h"
#include "vtkXMLPolyDataReader.h"

#include <Eigen/Dense>

#include <algorithm>
#include <mutex>
#include <random>
#include <tuple>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
using Vector = Eigen::VectorXd;

constexpr double MatrixTolerance = 2e-3;

//------------------------------------------------------------------------------
// A table, two boxes on each other and a lamp in a room; nothing touches.
vtkSmartPointer<vtkPolyData> MakeFurnishedRoom(double length)
{
  Surface room;
  const auto box = [&](const Point& low, const Point& high)
  { AddBox(room, low, high, length, false); };
  AddBox(room, { 0, 0, 0 }, { 5, 4, 2.6 }, length, true);
  box({ 1.6, 1.3, 0.72 }, { 3.2, 2.2, 0.76 });
  for (int k = 0; k < 4; ++k)
  {
    const double x = k % 2 ? 3.1 : 1.65, y = k / 2 ? 2.1 : 1.35;
    box({ x, y, 0.01 }, { x + 0.06, y + 0.06, 0.71 });
  }
  box({ 4.0, 0.5, 0.01 }, { 4.9, 1.9, 0.9 });
  box({ 4.2, 0.7, 0.92 }, { 4.7, 1.4, 1.9 });
  box({ 2.2, 1.55, 1.6 }, { 2.6, 1.95, 1.8 });
  box({ 0.3, 3.3, 0.01 }, { 0.7, 3.7, 1.5 });
  return room.Get();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSpheres()
{
  Surface spheres;
  AddSphere(spheres, 1.0, 2, false);
  AddSphere(spheres, 3.0, 2, true);
  return spheres.Get();
}

//------------------------------------------------------------------------------
// Halves a triangle until no edge is longer than `length`; neighbours halve the same edges.
void AddTriangle(Surface& surface, const std::array<Point, 3>& corners, double length)
{
  int longest = 0;
  double squared = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const double other =
      vtkMath::Distance2BetweenPoints(corners[k].data(), corners[(k + 1) % 3].data());
    longest = other > squared ? k : longest;
    squared = std::max(squared, other);
  }
  const Point &a = corners[longest], &b = corners[(longest + 1) % 3],
              &c = corners[(longest + 2) % 3];
  if (squared <= length * length)
  {
    surface.AddPolygon({ a, b, c });
    return;
  }
  const Point middle = { 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) };
  AddTriangle(surface, { a, middle, c }, length);
  AddTriangle(surface, { middle, b, c }, length);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeCornellBox()
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(LIGHTTRANSPORT_DATA_DIRECTORY "/cornell_box.vtp");
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  Surface box;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, ids);
    const auto get = [&](vtkIdType corner)
    {
      Point point;
      data->GetPoint(ids->GetId(corner), point.data());
      return point;
    };
    for (vtkIdType corner = 2; corner < ids->GetNumberOfIds(); ++corner)
    {
      AddTriangle(box, { get(0), get(corner - 1), get(corner) }, 130.0);
    }
  }
  return box.Get();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkViewFactors> MakeFactors(double linkTolerance, bool closed = false)
{
  auto factors = vtkSmartPointer<vtkViewFactors>::New();
  factors->SetTolerance(MatrixTolerance);
  factors->SetHierarchical(linkTolerance > 0.0);
  factors->SetLinkTolerance(linkTolerance);
  factors->SetEnforceClosure(closed);
  return factors;
}

//------------------------------------------------------------------------------
ViewFactorSettings MakeSettings(double linkTolerance, bool closed = false)
{
  return { MatrixTolerance, closed,
    linkTolerance > 0.0 ? LinkMethod::Hierarchical : LinkMethod::Dense, linkTolerance };
}

//------------------------------------------------------------------------------
/// H = F B with the links of a scene.
struct Irradiator
{
  LightTransport::Links Factors;
  vtkSmartPointer<vtkCPULinkOperator> Links;
  Vector Areas;

  Irradiator(const PatchScene& scene, double linkTolerance, bool closed = false)
  {
    ViewFactorStore store;
    CheckDone(store.Update(scene, MakeSettings(linkTolerance, closed), {}, Ranks(), Monitor()),
      "links");
    this->Factors = store.GetLinks();
    this->Links = vtkCPULinkOperator::NewFor(this->Factors.GetExchange());
    this->Links->Initialize(this->Factors.GetExchange(), 1);
    const std::vector<double>& areas = this->Factors.GetExchange()->GetAreas();
    this->Areas = Eigen::Map<const Vector>(areas.data(), static_cast<Eigen::Index>(areas.size()));
  }

  Vector Get(const Vector& radiosity) const
  {
    Vector irradiance(radiosity.size());
    Check(this->Links->SetVector(0, radiosity.data()) && this->Links->Multiply(1, 0) &&
        this->Links->GetVector(1, irradiance.data()),
      "product");
    return irradiance.cwiseQuotient(this->Areas);
  }

  /// B = E + rho F B to rounding.
  Vector Solve(const Vector& emission, const Vector& reflectance) const
  {
    Vector radiosity = emission;
    for (int step = 0; step < 60; ++step)
    {
      radiosity = emission + reflectance.cwiseProduct(this->Get(radiosity));
    }
    return radiosity;
  }
};

//------------------------------------------------------------------------------
/// Root mean square over the surface.
double GetNorm(const Vector& values, const Vector& areas)
{
  return std::sqrt(values.cwiseAbs2().dot(areas) / areas.sum());
}

//------------------------------------------------------------------------------
Vector MakeRandom(Eigen::Index size, double low, double high, unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(low, high);
  Vector values(size);
  std::generate(values.data(), values.data() + size, [&]() { return uniform(generator); });
  return values;
}

//------------------------------------------------------------------------------
/// A few neighbours send, all others reflect what they get.
Vector MakeLamp(const PatchScene& scene)
{
  Vector emission = Vector::Zero(scene.GetNumberOfPatches());
  const vtkIdType lamp = scene.GetNumberOfPatches() / 3;
  emission.segment(lamp, 8).setConstant(1.0);
  return emission;
}

//------------------------------------------------------------------------------
void TestErrors(const std::string& name, vtkPolyData* data)
{
  PatchScene scene;
  CheckDone(scene.Build(data, Ranks()), "scene");
  const Irradiator dense(scene, 0.0);
  const Eigen::Index patches = dense.Areas.size();
  const Vector ones = Vector::Ones(patches);
  const Vector random = MakeRandom(patches, 0.0, 1.0, 1);
  const Vector emission = MakeRandom(patches, 0.0, 1.0, 2).array().pow(8.0);
  const Vector lamp = MakeLamp(scene);
  const Vector reflectance = MakeRandom(patches, 0.2, 0.8, 3);
  const Vector radiosity = dense.Solve(emission, reflectance);
  const Vector lit = dense.Solve(lamp, reflectance);
  const auto compare = [&](const Vector& found, const Vector& expected, const Vector& unit)
  { return GetNorm(found - expected, dense.Areas) / GetNorm(unit, dense.Areas); };
  double before = 0.0;
  for (const double tolerance : { 1e-1, 3e-2, 1e-2 })
  {
    const std::string what = name + ", " + std::to_string(tolerance);
    const Irradiator links(scene, tolerance);
    const double estimate = links.Factors.GetSummary("LinkError");
    const double count = links.Factors.GetSummary("NumberOfLinks");
    const double even = compare(links.Get(ones), dense.Get(ones), ones);
    const double uneven = compare(links.Get(random), dense.Get(random), random);
    const double solution = compare(links.Solve(emission, reflectance), radiosity, radiosity);
    const double lampSolution = compare(links.Solve(lamp, reflectance), lit, lit);
    std::cout << what << ": " << patches << " patches, " << count << " links ("
              << links.Factors.GetSummary("NumberOfPatchLinks") << " of patches), error of H "
              << even << ", for random B " << uneven << ", of B " << solution << ", by a lamp "
              << lampSolution << ", estimate " << estimate << std::endl;
    Check(estimate <= tolerance, "the estimate keeps the tolerance: " + what);
    Check(even <= estimate, "the estimate is no less than the error: " + what);
    Check(even <= tolerance, "irradiance of even radiosity: " + what);
    Check(uneven <= tolerance, "irradiance of uneven radiosity: " + what);
    Check(solution <= tolerance, "radiosity: " + what);
    Check(lampSolution <= tolerance, "radiosity by a lamp: " + what);
    Check(count > before, "a lower tolerance takes more links: " + what);
    Check(count == static_cast<double>(links.Factors.Hierarchy->GetNumberOfLinks()),
      "links that are counted: " + what);
    const double pairs = 0.5 * static_cast<double>(patches) * static_cast<double>(patches - 1);
    Check(tolerance < 0.1 || count < 0.3 * pairs, "far fewer links than pairs: " + what);
    before = count;
  }
}

//------------------------------------------------------------------------------
bool AreSame(vtkExchangeHierarchy* a, vtkExchangeHierarchy* b)
{
  return a->GetOffsets() == b->GetOffsets() && a->GetColumns() == b->GetColumns() &&
    a->GetValues() == b->GetValues() && a->GetWeights() == b->GetWeights();
}

//------------------------------------------------------------------------------
/// That of the same tolerance, made by another way.
void CheckSame(const Links& found, const Links& expected, const std::string& what)
{
  Check(AreSame(found.Hierarchy, expected.Hierarchy) && found.RowSums == expected.RowSums,
    "the same links " + what);
  for (const char* name : { "LinkError", "NumberOfLinks", "PairsExamined", "PairsUnobstructed" })
  {
    Check(found.GetSummary(name) == expected.GetSummary(name), std::string(name) + " " + what);
  }
}

//------------------------------------------------------------------------------
// Other tolerances of one scene refine what there is; they must not be able to tell.
void TestKeptPairs(const PatchScene& scene)
{
  ViewFactorStore store;
  double raysBefore = 0.0;
  for (const double tolerance : { 1e-1, 1e-2, 3e-2 })
  {
    const std::string what = "from kept pairs, tolerance " + std::to_string(tolerance);
    CheckDone(store.Update(scene, MakeSettings(tolerance), {}, Ranks(), Monitor()), what);
    const Links fresh = Irradiator(scene, tolerance).Factors;
    CheckSame(store.GetLinks(), fresh, what);
    const double rays = store.GetLinks().GetSummary("LinkRaysCast");
    const double freshRays = fresh.GetSummary("LinkRaysCast");
    std::cout << what << ": " << rays << " rays, afresh " << freshRays << std::endl;
    Check(freshRays > 0.0 && rays == std::max(freshRays - raysBefore, 0.0),
      "no pair is looked at twice: " + what);
    raysBefore = std::max(raysBefore, freshRays);
  }
}

//------------------------------------------------------------------------------
void TestKeptPairsByBrightness(const PatchScene& scene, const PatchScene& other)
{
  const Vector lamp = MakeLamp(scene).array() + 0.1;
  const std::vector<double> brightness(lamp.data(), lamp.data() + lamp.size());
  const auto build = [&](const PatchScene& where, const std::vector<double>& light,
                       const std::shared_ptr<PairLooks>& looks)
  {
    Links links;
    CheckDone(HierarchicalViewFactors(1e-2, light, looks).Build(where, Ranks(), Monitor(), links),
      "links from kept pairs");
    return links;
  };
  const auto looks = std::make_shared<PairLooks>();
  const Links even = build(scene, {}, looks);
  const double bytes = looks->GetNumberOfBytes();
  Check(bytes >= 48.0 * even.GetSummary("PairsExamined"), "bytes of kept pairs");
  const Links kept = build(scene, brightness, looks);
  const Links fresh = build(scene, brightness, std::make_shared<PairLooks>());
  CheckSame(kept, fresh, "by brightness, from pairs of even light");
  Check(kept.GetSummary("LinkRaysCast") < 0.8 * fresh.GetSummary("LinkRaysCast"),
    "brightness looks at few pairs again: " + std::to_string(kept.GetSummary("LinkRaysCast")) +
      " rays of " + std::to_string(fresh.GetSummary("LinkRaysCast")));
  CheckSame(build(other, {}, looks), build(other, {}, std::make_shared<PairLooks>()),
    "of another scene");
  CheckSame(build(scene, {}, looks), even, "of the first scene again");
}

//------------------------------------------------------------------------------
using Table = std::vector<std::tuple<int, int, float>>;

/// Appends rows, columns and values.
void Append(vtkExchangeHierarchy* hierarchy, Table& table)
{
  for (int row = 0; row < hierarchy->GetNumberOfSlots(); ++row)
  {
    for (auto k = hierarchy->GetOffsets()[row]; k < hierarchy->GetOffsets()[row + 1]; ++k)
    {
      table.emplace_back(row, hierarchy->GetColumns()[k], hierarchy->GetValues()[k]);
    }
  }
}

//------------------------------------------------------------------------------
void TestThreads(const PatchScene& scene)
{
  Links factors[2];
  for (const int threads : { 1, 4 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&]() { factors[threads / 4] = Irradiator(scene, 3e-2).Factors; });
  }
  Check(AreSame(factors[0].Hierarchy, factors[1].Hierarchy),
    "links do not depend on the number of threads");
  Check(factors[0].GetSummary("LinkError") == factors[1].GetSummary("LinkError"),
    "nor does the estimate");
}

//------------------------------------------------------------------------------
void TestRanks(vtkPolyData* data, const PatchScene& scene)
{
  const Irradiator whole(scene, 3e-2, true);
  Table expected, found;
  Append(whole.Factors.Hierarchy, expected);
  std::mutex mutex;
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      PatchScene mine;
      vtkNew<vtkPolyData> nothing;
      const Ranks ranks(controller);
      const Outcome good = mine.Build(rank == 1 ? data : nothing.Get(), ranks);
      ViewFactorStore store;
      Outcome updated = store.Update(mine, MakeSettings(1e-1, true), {}, ranks, Monitor());
      updated =
        updated ? store.Update(mine, MakeSettings(3e-2, true), {}, ranks, Monitor()) : updated;
      const Links& factors = store.GetLinks();
      const std::lock_guard<std::mutex> lock(mutex);
      CheckDone(good, "scene on several ranks");
      CheckDone(updated, "links on several ranks");
      Append(factors.Hierarchy, found);
      CheckClose(factors.GetSummary("LinkError"), whole.Factors.GetSummary("LinkError"), 1e-12,
        "the estimate on several ranks");
      CheckClose(factors.GetSummary("NumberOfLinks"), whole.Factors.GetSummary("NumberOfLinks"),
        0.0, "the number of links of all ranks");
      double worst = 0.0;
      for (std::size_t k = 0; k < whole.Factors.RowSums.size(); ++k)
      {
        worst = std::max({ worst, std::abs(factors.RowSums[k] - whole.Factors.RowSums[k]),
          std::abs(
            factors.Hierarchy->GetWeights()[k] / whole.Factors.Hierarchy->GetWeights()[k] - 1.0) });
      }
      Check(worst < 1e-11, "sums and weights of closed rows on several ranks");
    });
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  Check(found == expected, "the links of all ranks are those of one");
}

//------------------------------------------------------------------------------
void TestReciprocity(vtkPolyData* data)
{
  auto factors = MakeFactors(3e-2);
  factors->SetInputData(data);
  factors->Update();
  const std::vector<double> areas = GetAreas(data);
  double worst = 0.0;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); i += 5)
  {
    for (vtkIdType j = 0; j < i; j += 3)
    {
      const double there = areas[i] * factors->GetViewFactor(i, j);
      const double back = areas[j] * factors->GetViewFactor(j, i);
      worst = std::max(worst, std::abs(there - back) / std::max(there, 1e-30));
    }
    Check(factors->GetViewFactor(i, i) == 0.0, "no patch sees itself");
  }
  Check(worst < 1e-12, "reciprocity " + std::to_string(worst));
}

//------------------------------------------------------------------------------
// H of even radiosity, in the order of the input's polygons.
Vector GetSums(vtkPolyData* data, double scale, const Point& shift, double& links)
{
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(data);
  for (vtkIdType point = 0; point < copy->GetNumberOfPoints(); ++point)
  {
    Point place;
    copy->GetPoint(point, place.data());
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] = place[axis] * scale + shift[axis];
    }
    copy->GetPoints()->SetPoint(point, place.data());
  }
  auto factors = MakeFactors(3e-2);
  factors->SetInputData(copy);
  factors->Update();
  links = GetSummary(factors->GetPolyDataOutput(), "NumberOfLinks");
  const std::vector<double> sums = GetCellValues(factors, "ViewFactorSum");
  return Eigen::Map<const Vector>(sums.data(), static_cast<Eigen::Index>(sums.size()));
}

//------------------------------------------------------------------------------
void TestPlaces(vtkPolyData* data)
{
  double links = 0.0;
  const Vector sums = GetSums(data, 1.0, { 0, 0, 0 }, links);
  // Powers of two round nothing; otherwise quadratures may take another rule.
  const struct
  {
    double Scale;
    Point Shift;
    bool IsExact;
  } places[] = { { 0x1p-20, { 0, 0, 0 }, true }, { 0x1p20, { 0, 0, 0 }, true },
    { 1e-6, { 0, 0, 0 }, false }, { 1e6, { 0, 0, 0 }, false }, { 1.0, { 64, -128, 32 }, false },
    { 1e-3, { 10, 20, 30 }, false } };
  for (const auto& place : places)
  {
    double count = 0.0;
    const Vector moved = GetSums(data, place.Scale, place.Shift, count);
    const double largest = (moved - sums).cwiseAbs().maxCoeff();
    const double mean = std::sqrt((moved - sums).squaredNorm() / moved.size());
    const std::string what = "scaled by " + std::to_string(place.Scale) + ", moved by " +
      std::to_string(place.Shift[0]) + ": " + std::to_string(count) + " links, off by " +
      std::to_string(largest);
    Check(place.IsExact ? count == links && largest == 0.0
                        : std::abs(count - links) <= 0.005 * links && mean < 3e-4,
      what);
  }
}

//------------------------------------------------------------------------------
void TestClosure(const PatchScene& scene)
{
  for (const double tolerance : { 1e-1, 1e-2 })
  {
    const Irradiator links(scene, tolerance, true);
    const Vector ones = Vector::Ones(links.Areas.size());
    Check((links.Get(ones) - ones).cwiseAbs().maxCoeff() < 1e-12, "closed rows sum to 1");
    const Vector reflectance = MakeRandom(ones.size(), 0.1, 0.9, 4);
    Check((links.Solve(ones - reflectance, reflectance) - ones).cwiseAbs().maxCoeff() < 1e-9,
      "furnace");
    Check(links.Factors.GetSummary("ClosureGap") < 1e-12, "gap that closure tells");
    const double change = links.Factors.GetSummary("ClosureChange");
    Check(change > 1e-3 && change < 1.0, "change that closure tells");
  }
}

//------------------------------------------------------------------------------
void TestOpenScene(vtkPolyData* data)
{
  PatchScene scene;
  CheckDone(scene.Build(data, Ranks()), "scene");
  const Irradiator links(scene, 3e-2);
  const std::vector<double>& sky = links.Factors.SkyFractions;
  double worst = 0.0;
  std::size_t numberOpen = 0;
  for (std::size_t row = 0; row < sky.size(); ++row)
  {
    const double sum = links.Factors.RowSums[row];
    worst = std::max(worst, std::abs(sum + sky[row] + links.Factors.BackFaceFractions[row] - 1.0));
    numberOpen += sky[row] > 0.0 ? 1 : 0;
  }
  Check(numberOpen > sky.size() / 2 && numberOpen < sky.size() - 50, "open and closed rows");
  Check(worst < 1e-12, "rows of an open scene make 1 with their openings");
}
} // namespace

//------------------------------------------------------------------------------
int TestLinkRefinement(int, char*[])
{
  TestErrors("room", MakeFurnishedRoom(0.5));
  TestErrors("spheres", MakeSpheres());
  TestErrors("Cornell box", MakeCornellBox());
  auto room = MakeFurnishedRoom(0.9);
  PatchScene scene;
  CheckDone(scene.Build(room, Ranks()), "scene");
  TestThreads(scene);
  TestKeptPairs(scene);
  PatchScene spheres;
  CheckDone(spheres.Build(MakeSpheres(), Ranks()), "scene");
  TestKeptPairsByBrightness(scene, spheres);
  TestReciprocity(room);
  TestPlaces(room);
  TestClosure(scene);
  TestOpenScene(MakeCornellBox());
  TestRanks(room, scene);
  return Result();
}
