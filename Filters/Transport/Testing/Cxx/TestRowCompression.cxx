// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Rows of links in one or two bytes each: what they stand for, how far they are off, which links
 * stay as they are, how many bytes they take; links that are several, nothing or not finite; many
 * sources of one row; ranks and threads.
 */
#include "ClusterLinksTesting.h"
#include "RanksInThreads.h"
#include "vtkHierarchicalLinkOperator.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <mutex>
#include <numeric>
#include <random>

using namespace LightTransportTesting;

namespace
{
using Values = std::vector<double>;
using CodedRows = vtkExchangeHierarchy::CodedRows;

//------------------------------------------------------------------------------
Values Multiply(vtkExchangeHierarchy* hierarchy, const Values& x, int bands)
{
  vtkNew<vtkHierarchicalLinkOperator> links;
  Values y(x.size());
  Check(links->Initialize(hierarchy, bands) && links->SetVector(0, x.data()) &&
      links->Multiply(1, 0) && links->GetVector(1, y.data()),
    "product");
  return y;
}

//------------------------------------------------------------------------------
Values MakeLight(std::size_t size, double mean)
{
  std::mt19937 generator(23);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Values light(size);
  std::generate(light.begin(), light.end(), [&]() { return mean + uniform(generator); });
  return light;
}

//------------------------------------------------------------------------------
// The largest difference, as a share of the largest value.
double Compare(const Values& found, const Values& expected)
{
  double difference = 0.0;
  double largest = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k)
  {
    difference = std::max(difference, std::abs(found[k] - expected[k]));
    largest = std::max(largest, std::abs(expected[k]));
  }
  return difference / largest;
}

//------------------------------------------------------------------------------
double GetSquares(const Values& values)
{
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

//------------------------------------------------------------------------------
std::int64_t CountExact(vtkExchangeHierarchy* hierarchy)
{
  return static_cast<std::int64_t>(hierarchy->GetColumns().size());
}

//------------------------------------------------------------------------------
// What is stored is one matrix, whichever way it is asked for; and how far it is off.
void TestErrors(const ClusterLinks& scene, int kernels)
{
  const auto before = scene.MakeAdaptive(0.7);
  const auto after = scene.MakeAdaptive(0.7);
  const double error = after->CompressRows(0.0);
  const vtkIdType links = before->GetNumberOfLinks();
  const std::string what = " (" + std::to_string(kernels) + " kernels)";
  Check(after->GetNumberOfLinks() == links && CountExact(after) == 0 && !after->IsSymmetric(),
    "all links are coded" + what);
  const std::size_t size = static_cast<std::size_t>(scene.GetNumberOfPatches()) * kernels;
  const Values even(size, 1.0);
  const Values mixed = MakeLight(size, 0.0);
  for (const Values& light : { even, mixed })
  {
    const Values expected = Multiply(before, light, kernels);
    Values found = Multiply(after, light, kernels);
    std::transform(found.begin(), found.end(), expected.begin(), found.begin(), std::minus<>());
    const double relative = std::sqrt(GetSquares(found) / GetSquares(expected));
    std::cout << links / scene.GetNumberOfPatches() << " links a patch" << what << ", error "
              << error << ", of the result " << relative << "\n";
    Check(relative > 0.0 && relative < 1.5 * error, "the error of the result" + what);
  }
  Check(error > 0.0 && error < (kernels == 1 ? 0.01 : 0.015), "the error" + what);

  vtkNew<vtkHierarchicalLinkOperator> operators;
  operators->Initialize(after, kernels);
  const Values product = Multiply(after, mixed, kernels);
  Values row(scene.GetNumberOfPatches());
  for (const int patch : { 0, scene.GetNumberOfPatches() / 3 })
  {
    for (int kernel = 0; kernel < kernels; ++kernel)
    {
      double sum = 0.0;
      operators->GetRow(patch, kernel, row.data());
      for (std::size_t j = 0; j < row.size(); ++j)
      {
        sum += row[j] * mixed[j * kernels + kernel];
      }
      Check(std::abs(sum - product[patch * kernels + kernel]) <= 1e-12 * row[patch],
        "a row is that of the product" + what);
      CheckClose(after->GetValue(patch, 7, kernel), row[7], 1e-12, "a value" + what);
    }
  }
}

//------------------------------------------------------------------------------
// Links that are missed stay; sums of rows keep the tolerance; bytes are told and saved.
void TestTolerance(const ClusterLinks& scene)
{
  constexpr int kernels = 3;
  const auto before = scene.MakeAdaptive(0.7);
  const std::size_t size = static_cast<std::size_t>(scene.GetNumberOfPatches()) * kernels;
  const Values even(size, 1.0);
  const Values mixed = MakeLight(size, 0.0);
  const Values expected = Multiply(before, even, kernels);
  std::int64_t fewer = 0;
  for (const double tolerance : { 0.1, 0.03, 0.01 })
  {
    const auto after = scene.MakeAdaptive(0.7);
    const double error = after->CompressRows(tolerance);
    const std::int64_t exact = CountExact(after);
    std::cout << "tolerance " << tolerance << ": error " << error << ", kept "
              << 100.0 * exact / before->GetNumberOfLinks() << " %\n";
    Check(exact > fewer && exact < before->GetNumberOfLinks(), "a lower tolerance keeps more");
    Check(after->GetNumberOfLinks() == before->GetNumberOfLinks(), "kept and coded are all");
    fewer = exact;
    const Values found = Multiply(after, even, kernels);
    double worst = 0.0;
    for (std::size_t k = 0; k < size; ++k)
    {
      worst = std::max(worst, std::abs(found[k] / expected[k] - 1.0));
    }
    Check(worst <= tolerance && error <= tolerance, "no sum is off by more than the tolerance");
  }
  // A patch's link with itself has the same value everywhere, so that a code meets it.
  const auto all = scene.MakeAdaptive(0.7);
  Check(all->CompressRows(1e-12) < 1e-12 &&
      all->GetCodedRows().NumberOfLinks <= scene.GetNumberOfPatches(),
    "a tolerance that hardly a code keeps");
  Check(Compare(Multiply(all, mixed, kernels), Multiply(before, mixed, kernels)) < 1e-12,
    "links that are kept are the same");
}

//------------------------------------------------------------------------------
// Where rows have the same slots a link is one byte, else two; a code for each value loses nothing.
void TestBytes()
{
  constexpr int patches = 4096;
  const ClusterLinks scene(patches, 3);
  const auto uniform = scene.MakeUniform(6);
  Check(uniform->GetNumberOfLinks() == 64 * patches, "64 links");
  uniform->CompressRows(0.0);
  Check(uniform->CompressRows(0.0) == 0.0 && uniform->GetNumberOfLinks() == 64 * patches,
    "a second time nothing changes");
  const CodedRows& same = uniform->GetCodedRows();
  Check(same.Bytes.size() == std::size_t(64 + 1) * patches && same.Tiles[0].Common == 64,
    "a byte for a link that all have, and one for a row");
  Check(uniform->GetNumberOfLinkBytes() <= 67.0 * patches, "hardly two bytes more in all");

  const auto adaptive = scene.MakeAdaptive(1.0);
  const double before = adaptive->GetNumberOfLinkBytes();
  adaptive->CompressRows(0.0);
  const CodedRows& coded = adaptive->GetCodedRows();
  const auto links = static_cast<double>(adaptive->GetNumberOfLinks());
  std::cout << links / patches << " links a patch in " << adaptive->GetNumberOfLinkBytes() / patches
            << " bytes, of links alone " << static_cast<double>(coded.Bytes.size()) / patches
            << ", before " << before / patches << "; rows a tile "
            << static_cast<double>(patches) / coded.Tiles.size() << "\n";
  Check(static_cast<double>(coded.Bytes.size()) <= 2.0 * links + 1.1 * patches,
    "two bytes for another link, and one for a piece");
  Check(adaptive->GetNumberOfLinkBytes() < 2.4 * links, "hardly more in all");

  // 200 values among the links.
  const auto few = scene.MakeAdaptive(1.0);
  std::vector<float> values = few->GetValues();
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    values[k] = 1.0f / static_cast<float>(1 + (k / 3) % 200 + k % 3);
  }
  const Values light = MakeLight(std::size_t(3) * patches, 1.0);
  few->SetRows(few->GetOffsets(), few->GetColumns(), values);
  const Values expected = Multiply(few, light, 3);
  const double error = few->CompressRows(0.0);
  Check(error < 1e-6 && Compare(Multiply(few, light, 3), expected) < 1e-6,
    "as few values as the book has entries");
}

//------------------------------------------------------------------------------
// A row with more slots than a tile, some of them twice; nothing, and what is not a number.
void TestOddRows()
{
  constexpr int patches = 700;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  vtkNew<vtkExchangeHierarchy> hierarchy;
  hierarchy->SetTree(Values(patches, 0.5), { { 1, patches + 1 } }, 0, 1, 2);
  std::vector<std::int64_t> offsets = { 0 };
  std::vector<int> columns;
  std::vector<float> values;
  for (int slot = 0; slot <= patches; ++slot)
  {
    for (int link = 0; slot % 3 == 0 && link < 2 * patches; ++link)
    {
      columns.push_back(1 + (slot + 5 * link) % patches);
      values.push_back(link % 5 == 0 ? 0.0f : static_cast<float>(link % 8) - 3.5f);
      values.push_back(link % 5 == 0 ? 0.0f : 1.0f);
    }
    offsets.push_back(static_cast<std::int64_t>(columns.size()));
  }
  hierarchy->SetRows(offsets, columns, values);
  const Values light = MakeLight(std::size_t(2) * patches, 1.0);
  const Values expected = Multiply(hierarchy, light, 2);
  Check(hierarchy->CompressRows(0.0) < 1e-6, "eight values");
  Check(Compare(Multiply(hierarchy, light, 2), expected) < 1e-6, "rows with many slots");
  Check(hierarchy->GetNumberOfLinks() == static_cast<vtkIdType>(columns.size()) / 5 * 4,
    "links that are nothing are left out");

  values[7] = nan;
  hierarchy->SetRows(offsets, columns, values);
  Check(hierarchy->CompressRows(0.0) < 1e-6 && CountExact(hierarchy) == 1 &&
      std::isnan(hierarchy->GetValues()[1]),
    "what is not finite is kept");

  hierarchy->SetRows(std::vector<std::int64_t>(patches + 2, 0), {}, {});
  Check(hierarchy->CompressRows(0.0) == 0.0 && hierarchy->GetNumberOfLinks() == 0 &&
      hierarchy->GetCodedRows().Tiles.empty(),
    "no links");
  CodedRows wrong = hierarchy->GetCodedRows();
  wrong.Book.assign(std::size_t(2) * CodedRows::BookSize, 0.0f);
  Check(hierarchy->SetCodedRows(wrong), "a book of two kernels");
  wrong.Tiles = { { 0, patches + 2, 0, 0, 0, 0 } };
  Check(!hierarchy->SetCodedRows(wrong), "a row that is not there is refused");
  wrong.Tiles = { { 0, 1, 1, 0, 0, 0 } };
  const int missing = patches + 1;
  wrong.WriteSlots(&missing, &missing + 1, 0);
  Check(!hierarchy->SetCodedRows(wrong), "a slot that is not there is refused");
}

//------------------------------------------------------------------------------
void TestThreads(const ClusterLinks& scene)
{
  const Values light = MakeLight(std::size_t(3) * scene.GetNumberOfPatches(), 1.0);
  Values results[2];
  for (const int threads : { 1, 4 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&]()
      {
        const auto hierarchy = scene.MakeAdaptive(0.7);
        hierarchy->CompressRows(0.02);
        results[threads / 4] = Multiply(hierarchy, light, 3);
      });
  }
  Check(results[0] == results[1], "the same bits on any number of threads");
}

//------------------------------------------------------------------------------
// Last: ranks make vtkSMPTools sequential.
void TestRanks(const ClusterLinks& scene)
{
  constexpr int ranks = 3;
  const Values light = MakeLight(std::size_t(3) * scene.GetNumberOfPatches(), 1.0);
  const auto whole = scene.MakeAdaptive(0.7);
  const double expectedError = whole->CompressRows(0.02);
  const Values expected = Multiply(whole, light, 3);
  std::mutex mutex;
  RunRanks(ranks,
    [&](vtkMultiProcessController* controller, int rank)
    {
      auto hierarchy = scene.MakeAdaptive(0.7, rank, ranks);
      const double error = hierarchy->CompressRows(0.02, controller);
      vtkNew<vtkHierarchicalLinkOperator> links;
      links->SetController(controller);
      Values found(light.size());
      const bool good = links->Initialize(hierarchy, 3) && links->SetVector(0, light.data()) &&
        links->Multiply(1, 0) && links->GetVector(1, found.data());
      const std::lock_guard<std::mutex> lock(mutex);
      Check(good && Compare(found, expected) < 1e-12, "parts give the serial result");
      CheckClose(error, expectedError, 1e-10, "the error of all ranks");
    });
}
} // namespace

//------------------------------------------------------------------------------
int TestRowCompression(int, char*[])
{
  const ClusterLinks scene(1000, 3);
  TestErrors(scene, 3);
  TestErrors(ClusterLinks(600, 1), 1);
  TestErrors(ClusterLinks(600, 5), 5);
  TestTolerance(scene);
  TestBytes();
  TestOddRows();
  TestThreads(scene);
  TestRanks(scene);
  return Result();
}
