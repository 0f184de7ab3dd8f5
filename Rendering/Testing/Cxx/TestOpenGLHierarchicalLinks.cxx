// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Products of vtkOpenGLLinkOperator with a vtkExchangeHierarchy against
 * vtkHierarchicalLinkOperator, for random trees and links that take one texture or many; what is
 * read back; operators that change from one form of links to the other; windows that go; errors.
 */
#include "ClusterLinksTesting.h"
#include "CornellBoxTesting.h"
#include "LinkOperatorTesting.h"
#include "vtkHierarchicalLinkOperator.h"
#include "vtkOpenGLLinkOperator.h"

#include "vtkExchangeHierarchy.h"
#include "vtkExchangeMatrix.h"
#include "vtkNew.h"
#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkRadiosity.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTestErrorObserver.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace
{
using namespace LightTransportTesting;
using Link = vtkExchangeHierarchy::Link;
using Node = vtkExchangeHierarchy::Node;

/// Of the sum of the absolute values of all terms: vectors, weights and the sums of each level are
/// rounded to single precision.
constexpr double Tolerance = 1e-6;

struct Case
{
  int Patches;
  int LargestLeaf; ///< patches that a node may have
  int Links;       ///< random ones; the root's own come with them
  int Bands;
  int MaximumTextureSize;
  int LinkTextures;
  int Kernels = 0; ///< of links that serve one direction; 0 for links that serve both
};

std::string Describe(const Case& setting)
{
  return std::to_string(setting.Patches) + " patches, leaves of at most " +
    std::to_string(setting.LargestLeaf) + ", " + std::to_string(setting.Links) + " links, " +
    std::to_string(setting.Bands) + " bands, textures of at most " +
    std::to_string(setting.MaximumTextureSize) +
    (setting.Kernels > 0 ? ", one way with kernels: " + std::to_string(setting.Kernels) : "");
}

/// Cut at random places into two to five children, breadth first, so that levels and patches mix.
std::vector<Node> MakeTree(int patches, int largestLeaf)
{
  std::mt19937 engine(11);
  std::vector<Node> ranges = { { 0, patches } };
  std::vector<Node> nodes;
  for (std::size_t node = 0; node < ranges.size(); ++node)
  {
    const Node range = ranges[node];
    const int count = range.Last - range.First;
    if (count <= largestLeaf)
    {
      nodes.push_back({ -1 - range.First, -1 - range.Last });
      continue;
    }
    std::vector<int> cuts = { range.First, range.Last };
    const int children = 2 + static_cast<int>(engine() % 4);
    for (int cut = 1; cut < children; ++cut)
    {
      cuts.push_back(range.First + 1 + static_cast<int>(engine() % (count - 1)));
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    const int first = static_cast<int>(ranges.size());
    for (std::size_t cut = 1; cut < cuts.size(); ++cut)
    {
      ranges.push_back({ cuts[cut - 1], cuts[cut] });
    }
    nodes.push_back({ first, static_cast<int>(ranges.size()) });
  }
  // Patches come after the nodes, whose number is known only now.
  const int count = static_cast<int>(nodes.size());
  for (Node& node : nodes)
  {
    node = node.First < 0 ? Node{ count - 1 - node.First, count - 1 - node.Last } : node;
  }
  return nodes;
}

/// Between any two levels, of a slot with itself, and one from the root to every third patch. The
/// last tenth of the slots, patches where there are many, has no links.
std::vector<Link> MakeLinks(int nodes, int patches, int count)
{
  std::mt19937 engine(12);
  std::vector<Link> links;
  const int slots = nodes + patches;
  const int linked = slots - slots / 10;
  const auto value = [&]() { return static_cast<float>(engine() % 10007) / 10007.0f - 0.4f; };
  for (int link = 0; link < count; ++link)
  {
    const int i = static_cast<int>(engine() % linked);
    const int j = link % 7 == 0 ? i : static_cast<int>(engine() % linked);
    links.push_back({ i, j, value() });
  }
  for (int slot = nodes; count > 0 && slot < linked; slot += 3)
  {
    links.push_back({ 0, slot, value() });
  }
  return links;
}

/// The links in the rows of their first ends, with other values in each kernel.
bool SetRows(vtkExchangeHierarchy* hierarchy, std::vector<Link> links)
{
  std::stable_sort(links.begin(), links.end(),
    [](const Link& a, const Link& b) { return a.I < b.I; });
  std::vector<std::int64_t> offsets(static_cast<std::size_t>(hierarchy->GetNumberOfSlots()) + 1, 0);
  std::vector<int> columns;
  std::vector<float> values;
  for (const Link& link : links)
  {
    columns.push_back(link.J);
    ++offsets[static_cast<std::size_t>(link.I) + 1];
    for (int kernel = 0; kernel < hierarchy->GetNumberOfKernels(); ++kernel)
    {
      values.push_back(link.Value / static_cast<float>(1 + (link.J + 3 * kernel) % 7));
    }
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  return hierarchy->SetRows(offsets, columns, values);
}

/// With absolute values of the links, a product bounds the rounding of the other.
void FillHierarchy(vtkExchangeHierarchy* hierarchy, const Case& setting, bool absolute = false)
{
  const std::vector<Node> nodes = MakeTree(setting.Patches, setting.LargestLeaf);
  std::vector<Link> links =
    MakeLinks(static_cast<int>(nodes.size()), setting.Patches, setting.Links);
  for (Link& link : links)
  {
    link.Value = absolute ? std::abs(link.Value) : link.Value;
  }
  Vector weights = MakeVector(static_cast<std::size_t>(setting.Patches), 13);
  for (double& weight : weights)
  {
    weight = weight * weight + 0.1;
  }
  if (!hierarchy->SetTree(weights, nodes, 0, 1, std::max(setting.Kernels, 1)) ||
    !(setting.Kernels > 0 ? SetRows(hierarchy, links) : hierarchy->SetLinks(links)))
  {
    std::cerr << "ERROR: no hierarchy for " << Describe(setting) << "\n";
  }
}

Vector Absolute(Vector values)
{
  std::transform(values.begin(), values.end(), values.begin(),
    [](double value) { return std::abs(value); });
  return values;
}

Vector MultiplyOnCPU(vtkExchangeHierarchy* hierarchy, int bands, const Vector& x)
{
  vtkNew<vtkHierarchicalLinkOperator> links;
  Vector y(x.size());
  links->Initialize(hierarchy, bands);
  links->SetVector(0, x.data());
  links->Multiply(1, 0);
  links->GetVector(1, y.data());
  return y;
}

bool TestProduct(vtkOpenGLLinkOperator* device, const Case& setting, unsigned int seed)
{
  vtkNew<vtkExchangeHierarchy> hierarchy;
  vtkNew<vtkExchangeHierarchy> absolute;
  FillHierarchy(hierarchy, setting);
  FillHierarchy(absolute, setting, true);
  const Vector x = MakeVector(static_cast<std::size_t>(setting.Patches) * setting.Bands, seed);
  const Vector expected = MultiplyOnCPU(hierarchy, setting.Bands, x);
  const Vector bound = MultiplyOnCPU(absolute, setting.Bands, Absolute(x));
  Vector found(x.size());
  if (!device->SetVector(0, x.data()) || !device->Multiply(1, 0) ||
    !device->GetVector(1, found.data()))
  {
    return false;
  }
  return CheckWithinBound(found, expected, bound, Tolerance, Describe(setting));
}

bool TestCase(vtkOpenGLLinkOperator* device, const Case& setting)
{
  vtkNew<vtkExchangeHierarchy> hierarchy;
  FillHierarchy(hierarchy, setting);
  device->SetMaximumTextureSize(setting.MaximumTextureSize);
  if (!Check(device->Initialize(hierarchy, setting.Bands), Describe(setting) + ", Initialize"))
  {
    return false;
  }
  const int textures = device->GetNumberOfLinkTextures();
  // A second product must not see the first.
  return Check(textures == setting.LinkTextures,
           Describe(setting) + ", " + std::to_string(textures) + " textures of links") &&
    TestProduct(device, setting, 1) && TestProduct(device, setting, 2);
}

/// `textures` hold the links.
bool TestRows(vtkOpenGLLinkOperator* device, vtkExchangeHierarchy* hierarchy, int bands,
  int textures, const std::string& what, int maximumTextureSize = 0)
{
  device->SetMaximumTextureSize(maximumTextureSize);
  if (!Check(device->Initialize(hierarchy, bands), what + ", Initialize"))
  {
    return false;
  }
  bool good = Check(device->GetNumberOfLinkTextures() == textures,
    what + ", " + std::to_string(device->GetNumberOfLinkTextures()) + " textures of links");
  const auto size = static_cast<std::size_t>(hierarchy->GetNumberOfPatches() * bands);
  for (const unsigned int seed : { 1u, 2u })
  {
    const Vector x = MakeVector(size, seed);
    const Vector expected = MultiplyOnCPU(hierarchy, bands, x);
    const Vector bound = MultiplyOnCPU(hierarchy, bands, Absolute(x));
    Vector found(size);
    good = device->SetVector(0, x.data()) && device->Multiply(1, 0) &&
      device->GetVector(1, found.data()) &&
      CheckWithinBound(found, expected, bound, Tolerance, what) && good;
  }
  device->SetMaximumTextureSize(0);
  return good;
}

/// Rows with common slots alone, with others, with more slots than a tile; of nodes and of patches.
bool TestCompression(vtkOpenGLLinkOperator* device)
{
  bool good = true;
  for (const int kernels : { 1, 3, 4, 5 })
  {
    const ClusterLinks scene(600, kernels);
    const std::string what = ", coded, kernels: " + std::to_string(kernels);
    const auto adaptive = scene.MakeAdaptive(0.8);
    adaptive->CompressRows(0.0);
    good = TestRows(device, adaptive, kernels, 1, "adaptive" + what) && good;
    const auto kept = scene.MakeAdaptive(0.8);
    kept->CompressRows(0.01);
    good = TestRows(device, kept, kernels, 2, "adaptive, some kept" + what) && good;
    const auto uniform = scene.MakeUniform(5);
    uniform->CompressRows(0.0);
    good = TestRows(device, uniform, kernels, 1, "uniform" + what) && good;
    const auto all = scene.MakeAdaptive(0.0);
    all->CompressRows(0.0);
    good = TestRows(device, all, kernels, 1, "all pairs" + what) && good;
  }
  const ClusterLinks colours(400, 3);
  const auto lights = colours.MakeAdaptive(0.8);
  lights->CompressRows(0.01);
  good = TestRows(device, lights, 9, 2, "coded, three lights of three kernels") && good;
  const ClusterLinks shared(300, 1);
  const auto one = shared.MakeAdaptive(0.8);
  one->CompressRows(0.0);
  good = TestRows(device, one, 6, 1, "coded, one kernel for six bands") && good;
  const ClusterLinks large(1500, 2);
  const auto parts = large.MakeUniform(7);
  parts->CompressRows(0.0);
  good = TestRows(device, parts, 2, 2, "coded, several textures", 100) && good;
  vtkNew<vtkExchangeHierarchy> odd;
  FillHierarchy(odd, { 300, 8, 5000, 3, 0, 1, 3 }, true);
  odd->CompressRows(0.0);
  return TestRows(device, odd, 3, 1, "coded, rows of nodes and patches") && good;
}

/// What most patches are linked with is constants of the program: alone, beside rows of their own,
/// with one kernel or many for one light or several, in more rounds than one, in many textures.
bool TestCommonLinks(vtkOpenGLLinkOperator* device)
{
  bool good = true;
  for (const int kernels : { 1, 2, 3, 4, 5 })
  {
    const ClusterLinks scene(600, kernels);
    const std::string what = ", kernels: " + std::to_string(kernels);
    good = TestRows(device, scene.MakeUniform(4), kernels, 1, "common links alone" + what) && good;
    const auto mixed = scene.MakeUniformAround(5);
    good = TestRows(device, mixed, kernels, 2, "common links and rows" + what) && good;
    good = TestRows(device, mixed, 6 * kernels, 2, "six lights, common links" + what) && good;
  }
  const ClusterLinks shared(300, 1);
  good = TestRows(device, shared.MakeUniform(1), 3, 1, "too few to fill a texel") && good;
  good = TestRows(device, shared.MakeUniform(5), 7, 1, "one kernel for seven bands") && good;
  const ClusterLinks parted(600, 3);
  good =
    TestRows(device, parted.MakeUniform(7), 3, 20, "common links in many textures", 64) && good;
  // Of one round there may be 1,024.
  const ClusterLinks large(6000, 1);
  return TestRows(device, large.MakeUniform(11), 3, 2, "2,048 common links") && good;
}

/// A chain of nodes that each keep one patch: the patches of all levels, one line of texels each.
bool TestChain(vtkOpenGLLinkOperator* device)
{
  const int patches = 40;
  // Children in pairs: the first goes on, the second has a patch of its own.
  const int count = 2 * patches - 1;
  std::vector<Node> nodes(static_cast<std::size_t>(count));
  int patch = count;
  for (int node = 0; node < count; ++node)
  {
    const bool goesOn = (node == 0 || node % 2 == 1) && node + 2 < count;
    const int child = node == 0 ? 1 : node + 2;
    nodes[static_cast<std::size_t>(node)] =
      goesOn ? Node{ child, child + 2 } : Node{ patch, patch + 1 };
    patch += goesOn ? 0 : 1;
  }
  vtkNew<vtkExchangeHierarchy> hierarchy;
  std::vector<Link> links;
  for (int slot = 0; slot < count + patches; ++slot)
  {
    links.push_back({ slot, (7 * slot) % (count + patches), 1.0f / static_cast<float>(1 + slot) });
  }
  if (!Check(hierarchy->SetTree(Vector(patches, 0.5), nodes), "no chain") ||
    !hierarchy->SetLinks(links) || !device->Initialize(hierarchy, 1))
  {
    return false;
  }
  const Vector x(patches, 1.0);
  const Vector expected = MultiplyOnCPU(hierarchy, 1, x);
  Vector found(x.size());
  bool good =
    device->SetVector(0, x.data()) && device->Multiply(1, 0) && device->GetVector(1, found.data());
  for (std::size_t index = 0; index < x.size(); ++index)
  {
    good = Check(std::abs(found[index] - expected[index]) <= Tolerance * expected[index],
             "chain: patch " + std::to_string(index) + " is wrong") &&
      good;
  }
  return good;
}

/// A node with 50,000 patches and a patch with as many links: added up plainly in single precision
/// these sums are off by 1e-5 and more.
bool TestLongSums(vtkOpenGLLinkOperator* device)
{
  const int patches = 50000;
  vtkNew<vtkExchangeHierarchy> hierarchy;
  hierarchy->SetTree(Vector(patches, 0.1), { { 1, patches + 1 } });
  const Vector x(patches, 1.0);
  bool good = true;
  for (const bool ofRoot : { true, false })
  {
    std::vector<Link> links(ofRoot ? 1 : 0, { 0, 0, 1.0f });
    for (int slot = 1; !ofRoot && slot <= patches; ++slot)
    {
      links.push_back({ 1, slot, 0.1f });
    }
    hierarchy->SetLinks(links);
    const double expected = MultiplyOnCPU(hierarchy, 1, x)[0];
    Vector found(x.size());
    good = device->Initialize(hierarchy, 1) && device->SetVector(0, x.data()) &&
      device->Multiply(1, 0) && device->GetVector(1, found.data()) && good;
    const double error = std::abs(found[0] / expected - 1.0);
    std::cout << "long sums: relative error " << error << "\n";
    good = Check(error <= Tolerance, "long sums lose digits") && good;
  }
  return good;
}

/// Also that nothing of a NaN gets into other bands.
bool TestBytesRead()
{
  const Case setting = { 300, 8, 1000, 3, 0, 1 };
  vtkNew<vtkExchangeHierarchy> hierarchy;
  FillHierarchy(hierarchy, setting);
  vtkNew<vtkOpenGLLinkOperator> device;
  Vector x = MakeVector(3 * 300, 1);
  x[3 * 20 + 1] = std::nan("");
  Vector numbers(3);
  bool good = device->Initialize(hierarchy, 3) && device->SetVector(0, x.data());
  for (int iteration = 0; iteration < 10; ++iteration)
  {
    good = good && device->Multiply(1, 0) && device->Scale(1, 1, 0);
  }
  good = Check(device->GetNumberOfBytesRead() == 0, "vectors travel while nobody asks") && good;
  good = Check(device->GetNumberOfLinkBytes() > 0 && device->GetNumberOfLinkBytes() % 16 == 0,
           "bytes of links") &&
    good;
  good = good && device->MaxNorm(1, numbers.data());
  return Check(device->GetNumberOfBytesRead() == 16, "a number per band takes more than a texel") &&
    Check(std::isfinite(numbers[0]) && std::isnan(numbers[1]) && std::isfinite(numbers[2]),
      "a NaN is lost, or spreads to other bands") &&
    good;
}

bool TestWindowsAndForms()
{
  const Case setting = { 300, 8, 1000, 3, 0, 1 };
  vtkNew<vtkOpenGLLinkOperator> device;
  bool good = TestCase(device, setting);
  vtkNew<vtkExchangeMatrix> matrix;
  matrix->AllocateSparse(Vector(300, 1.0), 1);
  good = Check(device->Initialize(matrix, 3), "a matrix after a hierarchy") && good;
  good = TestCase(device, setting) && good;
  device->Release();
  good = Check(device->GetNumberOfLinkTextures() == 0, "released links are there") && good;
  good = TestCase(device, setting) && good;

  auto window = vtkSmartPointer<vtkOffScreenOpenGLRenderWindow>::New();
  device->SetRenderWindow(window);
  good =
    TestCase(device, setting) && Check(!window->IsCurrent(), "the context stays current") && good;
  vtkNew<vtkTest::ErrorObserver> observer;
  device->AddObserver(vtkCommand::ErrorEvent, observer);
  window->Finalize();
  good = Check(!device->Multiply(1, 0), "Multiply without a context") &&
    observer->CheckErrorMessage("Initialize()") == 0 && good;
  good = TestCase(device, setting) && good;
  window = nullptr;
  good = Check(!device->Multiply(1, 0), "Multiply without a window") &&
    observer->CheckErrorMessage("Initialize()") == 0 && good;
  device->SetRenderWindow(nullptr);
  return TestCase(device, setting) && good;
}

bool TestErrors()
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkOpenGLLinkOperator> device;
  device->AddObserver(vtkCommand::ErrorEvent, observer);
  vtkNew<vtkExchangeHierarchy> hierarchy;
  bool good = Check(!device->Initialize(hierarchy, 1), "an empty hierarchy is taken") &&
    observer->CheckErrorMessage("empty") == 0;
  // 13 of 16 lines for the patches, and one or more for each of many levels.
  FillHierarchy(hierarchy, { 200, 2, 0, 1, 0, 0 });
  device->SetMaximumTextureSize(16);
  good = Check(!device->Initialize(hierarchy, 1), "a tree that does not fit is taken") &&
    observer->CheckErrorMessage("0 links between") == 0 && good;
  // Pieces of 16 texels: 20,000 links are some 80 lines of them.
  FillHierarchy(hierarchy, { 100, 100, 20000, 1, 0, 0 });
  good = Check(!device->Initialize(hierarchy, 1), "links that do not fit are taken") &&
    observer->CheckErrorMessage("Device to CPU") == 0 && good;
  device->SetMaximumTextureSize(0);
  good = Check(device->Initialize(hierarchy, 1), "the operator does not recover") && good;
  vtkNew<vtkExchangeHierarchy> part;
  part->SetTree(Vector(2, 1.0), { { 1, 3 } }, 0, 2);
  return Check(!device->Initialize(part, 1), "a part of a hierarchy is taken") &&
    observer->CheckErrorMessage("parts") == 0 && good;
}

//------------------------------------------------------------------------------
// The filter on either device: single precision is corrected, so they agree to the tolerance.
bool TestRadiosity()
{
  vtkNew<vtkRadiosity> filters[2];
  for (vtkRadiosity* filter : { filters[0].Get(), filters[1].Get() })
  {
    filter->SetInputData(MakeCornellBox(120.0));
    filter->SetLinkMethodToHierarchical();
    filter->SetLinkTolerance(3e-2);
    filter->SetTolerance(1e-8);
  }
  filters[0]->SetDeviceToCPU();
  filters[1]->SetDeviceToOpenGL();
  vtkDataArray* values[2];
  for (int k = 0; k < 2; ++k)
  {
    filters[k]->Update();
    values[k] = filters[k]->GetPolyDataOutput()->GetCellData()->GetArray("Radiosity");
    if (!Check(values[k] != nullptr, "no radiosity"))
    {
      return false;
    }
  }
  double difference = 0.0;
  double largest = 0.0;
  for (vtkIdType cell = 0; cell < values[0]->GetNumberOfTuples(); ++cell)
  {
    for (int band = 0; band < values[0]->GetNumberOfComponents(); ++band)
    {
      const double value = values[0]->GetComponent(cell, band);
      largest = std::max(largest, value);
      difference = std::max(difference, std::abs(value - values[1]->GetComponent(cell, band)));
    }
  }
  auto* used = vtkStringArray::SafeDownCast(
    filters[1]->GetPolyDataOutput()->GetFieldData()->GetAbstractArray("DeviceUsed"));
  return Check(used && used->GetValue(0).find("OpenGL") == 0, "the device is OpenGL") &&
    Check(difference <= 2e-8 * largest,
      "devices differ by " + std::to_string(difference / largest));
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenGLHierarchicalLinks(int, char*[])
{
  const Case cases[] = { { 1, 1, 0, 1, 0, 0 }, { 1, 1, 3, 1, 0, 1 }, { 5, 5, 20, 3, 0, 2 },
    { 5, 1, 20, 3, 0, 1 }, { 300, 300, 1000, 3, 0, 1 }, { 300, 8, 0, 3, 0, 0 },
    { 300, 8, 1000, 1, 0, 1 }, { 300, 8, 1000, 3, 0, 1 }, { 300, 1, 1000, 4, 0, 1 },
    { 300, 8, 1000, 5, 0, 1 }, { 300, 8, 1000, 8, 0, 1 }, { 300, 8, 1000, 32, 0, 1 },
    { 3000, 4, 50000, 3, 0, 1 }, { 5, 1, 20, 3, 64, 1 }, { 300, 8, 10000, 3, 64, 3 },
    { 300, 8, 10000, 5, 100, 2 }, { 1000, 8, 20000, 1, 64, 6 }, { 300, 8, 1000, 1, 0, 1, 1 },
    { 300, 8, 1000, 3, 0, 1, 1 }, { 300, 8, 1000, 2, 0, 1, 2 }, { 300, 8, 1000, 3, 0, 1, 3 },
    { 300, 8, 1000, 4, 0, 1, 4 }, { 300, 8, 1000, 5, 0, 1, 5 }, { 300, 8, 1000, 32, 0, 1, 32 },
    { 300, 8, 1000, 6, 0, 1, 3 }, { 300, 8, 1000, 24, 0, 1, 3 }, { 300, 8, 1000, 10, 0, 1, 5 },
    { 1, 1, 3, 3, 0, 1, 3 }, { 3000, 4, 50000, 3, 0, 1, 3 }, { 300, 8, 10000, 3, 64, 4, 3 } };
  vtkNew<vtkOpenGLLinkOperator> device;
  bool good = true;
  for (const Case& setting : cases)
  {
    good = TestCase(device, setting) && good;
  }
  device->SetMaximumTextureSize(0);
  good = TestChain(device) && good;
  good = TestCommonLinks(device) && good;
  good = TestCompression(device) && good;
  good = TestLongSums(device) && good;
  good = TestBytesRead() && good;
  good = TestWindowsAndForms() && good;
  good = TestErrors() && good;
  good = TestRadiosity() && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
