// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Iterations per second of the Jacobi step B <- E + rho G B / A, on the CPU and with OpenGL: dense
 * for given numbers of patches, hierarchical for given numbers of random links between clusters,
 * and for given numbers of receivers with rows of links as scattering has them (three kernels):
 * uniform and adaptive, as they are and coded. Beside each stands the bandwidth that this amounts
 * to, in bytes of links as they are stored, and what the same memory does without computing,
 * measured in turn: on the CPU a plain loop that reads the same bytes with the same number of
 * threads; with OpenGL copying, as bytes read and written by a shader that multiplies a vector of
 * 64 MB with itself.
 *
 * Not a test: timings depend on the machine and on what else it does. For orientation, Carr, Hall
 * and Hart (Graphics Hardware 2003) report about 30 iterations per second on their GPU and 40 on
 * their CPU at about 1,530 patches.
 */
#include "vtkDenseLinkOperator.h"
#include "vtkDeviceLinkOperator.h"
#include "vtkExchangeHierarchy.h"
#include "vtkExchangeMatrix.h"
#include "vtkHierarchicalLinkOperator.h"
#include "vtkNew.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#if defined(__x86_64__) && defined(__GNUC__)
#define WIDEST_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDEST_VECTORS
#endif

namespace
{
constexpr const char* Usage =
  "usage: LinkOperatorBenchmark [--sizes N,N,...] [--links N,N,...] [--rows N,N,...] [--bands "
  "N,N,...]\n"
  "                             [--device all|cpu|opengl] [--seconds S] [--csv FILE]\n"
  "  --sizes    numbers of patches of a dense matrix, 0 for none (1530,4096,16384)\n"
  "  --links    numbers of links between clusters, 0 for none (1000000)\n"
  "  --rows     numbers of receivers, 0 for none (0)\n"
  "  --bands    numbers of bands (1,3)\n"
  "  --device   what to measure (all); a software OpenGL renderer is measured up to 4,096 "
  "patches,\n"
  "             with --device opengl at all sizes\n"
  "  --seconds  time for each measurement, after warming up (2)\n"
  "  --csv      write the table to a file as well\n";

constexpr vtkIdType LargestForSoftwareRenderers = 4096;
constexpr vtkIdType LinksPerPatch = 16;
/// Of the vector that is copied, with four bands, in single precision.
constexpr int CopiedPatches = 1 << 22;
constexpr int NumberOfSamples = 9;
constexpr double Reflectance = 0.7;

struct Options
{
  std::vector<int> Sizes = { 1530, 4096, 16384 };
  std::vector<int> Links = { 1000000 };
  std::vector<int> Rows = { 0 };
  std::vector<int> Bands = { 1, 3 };
  std::string Device = "all";
  double Seconds = 2.0;
  std::string File;
};

struct Sample
{
  double Best = 0.0;
  double Median = 0.0;
};

struct Row
{
  std::string Device;
  vtkIdType Patches;
  /// Between clusters; 0 for a matrix.
  vtkIdType Links;
  int Bands;
  double Bytes;
  /// Iterations per second.
  Sample Step;
  /// Bytes per second of what only reads or copies.
  Sample Plain;
};

/// What the memory does without computing: seconds for a number of passes, and bytes of a pass.
struct PlainWork
{
  std::function<double(int passes)> Time;
  double Bytes = 0.0;
};

/// Memory that a plain loop reads.
struct Block
{
  const void* Begin;
  std::size_t Bytes;
};

/// Slots of the operator's vectors.
enum Slot
{
  RADIOSITY,
  EMISSION,
  REFLECTANCE,
  GATHERED
};

//------------------------------------------------------------------------------
bool ParseIntegers(const char* text, std::vector<int>& values)
{
  values.clear();
  std::istringstream stream(text);
  std::string item;
  while (std::getline(stream, item, ','))
  {
    values.push_back(std::atoi(item.c_str()));
    if (values.back() < 0)
    {
      return false;
    }
  }
  return !values.empty();
}

//------------------------------------------------------------------------------
bool ParseOptions(int argc, char* argv[], Options& options)
{
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string name = argv[i];
    const char* value = argv[i + 1];
    bool valid = true;
    if (name == "--sizes")
    {
      valid = ParseIntegers(value, options.Sizes);
    }
    else if (name == "--links")
    {
      valid = ParseIntegers(value, options.Links);
    }
    else if (name == "--rows")
    {
      valid = ParseIntegers(value, options.Rows);
    }
    else if (name == "--bands")
    {
      valid = ParseIntegers(value, options.Bands) &&
        *std::min_element(options.Bands.begin(), options.Bands.end()) > 0;
    }
    else if (name == "--device")
    {
      options.Device = value;
      valid = options.Device == "all" || options.Device == "cpu" || options.Device == "opengl";
    }
    else if (name == "--seconds")
    {
      options.Seconds = std::atof(value);
      valid = options.Seconds > 0.0;
    }
    else if (name == "--csv")
    {
      options.File = value;
    }
    else
    {
      valid = false;
    }
    if (!valid)
    {
      return false;
    }
  }
  return argc % 2 == 1;
}

//------------------------------------------------------------------------------
double GetSeconds()
{
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

//------------------------------------------------------------------------------
/// A reproducible value in [0, 1) for an unordered pair.
float PairValue(std::uint64_t i, std::uint64_t j)
{
  std::uint64_t key = (std::min(i, j) << 32) + std::max(i, j);
  key = (key ^ (key >> 31)) * 0x9E3779B97F4A7C15ull;
  key = (key ^ (key >> 29)) * 0xBF58476D1CE4E5B9ull;
  return static_cast<float>((key >> 40) * 0x1p-24);
}

//------------------------------------------------------------------------------
/// A full matrix with row sums of about 1, for patches of area 1.
void FillMatrix(vtkExchangeMatrix* matrix)
{
  const vtkIdType size = vtkExchangeMatrix::TileSize;
  const vtkIdType patches = matrix->GetNumberOfPatches();
  const float mean = 2.0f / static_cast<float>(patches);
  std::vector<vtkExchangeMatrix::Tile>& tiles = matrix->GetTiles();
  vtkSMPTools::For(0, static_cast<vtkIdType>(tiles.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType t = begin; t < end; ++t)
      {
        const vtkIdType firstRow = tiles[t].Row * size;
        const vtkIdType firstColumn = tiles[t].Column * size;
        for (vtkIdType i = 0; i < std::min(size, patches - firstRow); ++i)
        {
          float* row = tiles[t].Values + i * size;
          for (vtkIdType j = 0; j < std::min(size, patches - firstColumn); ++j)
          {
            row[j] = mean * PairValue(firstRow + i, firstColumn + j);
          }
        }
      }
    });
}

//------------------------------------------------------------------------------
/// A tree of eight children each, with up to eight patches in a leaf.
std::vector<vtkExchangeHierarchy::Node> MakeTree(int patches)
{
  std::vector<int> levels = { (patches + 7) / 8 };
  while (levels.back() > 1)
  {
    levels.push_back((levels.back() + 7) / 8);
  }
  std::reverse(levels.begin(), levels.end());
  levels.push_back(patches);
  std::vector<vtkExchangeHierarchy::Node> nodes;
  int first = 1;
  for (std::size_t level = 0; level + 1 < levels.size(); ++level)
  {
    const int children = levels[level + 1];
    for (int node = 0; node < levels[level]; ++node)
    {
      nodes.push_back({ first + 8 * node, first + std::min(8 * node + 8, children) });
    }
    first += children;
  }
  return nodes;
}

//------------------------------------------------------------------------------
/**
 * Random links with row sums of about 1, for patches of area 1: half of them between any two
 * slots, which are mostly patches, half with one end on any level, so that rows differ in length as
 * they do in scenes.
 */
bool FillHierarchy(vtkExchangeHierarchy* hierarchy, int links)
{
  const int patches = static_cast<int>(std::max<vtkIdType>(links / LinksPerPatch, 1));
  if (!hierarchy->SetTree(std::vector<double>(patches, 1.0), MakeTree(patches)))
  {
    return false;
  }
  const int slots = hierarchy->GetNumberOfSlots();
  const std::vector<int>& levels = hierarchy->GetLevels();
  std::uint64_t count = 0;
  const auto random = [&](int begin, int end)
  { return begin + static_cast<int>(PairValue(++count, 1) * static_cast<float>(end - begin)); };
  std::vector<int> sizes(slots, 1);
  for (int slot = slots - 1; slot > 0; --slot)
  {
    const int parent = hierarchy->GetParents()[slot];
    sizes[parent] += slot < hierarchy->GetNumberOfNodes() ? sizes[slot] - 1 : 1;
  }
  std::vector<vtkExchangeHierarchy::Link> table(links);
  for (int link = 0; link < links; ++link)
  {
    const int level = random(0, static_cast<int>(levels.size()) - 1);
    const int i = link % 2 == 0 ? random(0, slots) : random(levels[level], levels[level + 1]);
    const int j = random(0, slots);
    // Each link adds as much to the sum of all rows.
    const double pairs = static_cast<double>(sizes[i]) * sizes[j];
    table[link] = { i, j, static_cast<float>(patches / (2.0 * links * pairs)) };
  }
  return hierarchy->SetLinks(table);
}

//------------------------------------------------------------------------------
/**
 * Rows of three kernels with sums of about 1: each patch hears the nodes of one level (uniform), or
 * the patches of its leaf and the siblings of all that is above it.
 */
bool FillRows(vtkExchangeHierarchy* hierarchy, int patches, bool uniform)
{
  constexpr int kernels = 3;
  if (!hierarchy->SetTree(std::vector<double>(patches, 1.0), MakeTree(patches), 0, 1, kernels))
  {
    return false;
  }
  const std::vector<int>& levels = hierarchy->GetLevels();
  const std::size_t level = std::min<std::size_t>(levels.size() - 2, 2);
  const int nodes = hierarchy->GetNumberOfNodes();
  std::vector<double> areas(nodes, 0.0);
  areas.resize(hierarchy->GetNumberOfSlots(), 1.0);
  for (int slot = hierarchy->GetNumberOfSlots() - 1; slot > 0; --slot)
  {
    areas[hierarchy->GetParents()[slot]] += areas[slot];
  }
  std::vector<std::int64_t> offsets(nodes + 1, 0);
  std::vector<int> columns;
  std::vector<float> values;
  for (int patch = 0; patch < patches; ++patch)
  {
    const std::size_t first = columns.size();
    for (int node = levels[level]; uniform && node < levels[level + 1]; ++node)
    {
      columns.push_back(node);
    }
    for (int slot = nodes + patch; !uniform && slot > 0; slot = hierarchy->GetParents()[slot])
    {
      const vtkExchangeHierarchy::Node& siblings =
        hierarchy->GetNodes()[hierarchy->GetParents()[slot]];
      for (int other = siblings.First; other < siblings.Last; ++other)
      {
        if (other != slot || slot == nodes + patch)
        {
          columns.push_back(other);
        }
      }
    }
    for (std::size_t link = first; link < columns.size(); ++link)
    {
      const double share = (0.5 + static_cast<double>(PairValue(patch, columns[link]))) /
        static_cast<double>(columns.size() - first);
      for (int kernel = 0; kernel < kernels; ++kernel)
      {
        values.push_back(static_cast<float>(share / areas[columns[link]] / (1 + kernel)));
      }
    }
    offsets.push_back(static_cast<std::int64_t>(columns.size()));
  }
  return hierarchy->SetRows(offsets, columns, values);
}

//------------------------------------------------------------------------------
std::vector<Block> GetBlocks(const vtkExchangeMatrix* matrix)
{
  std::vector<Block> blocks;
  for (const vtkExchangeMatrix::Tile& tile : matrix->GetTiles())
  {
    blocks.push_back(
      { tile.Values, sizeof(float) * vtkExchangeMatrix::TileSize * vtkExchangeMatrix::TileSize });
  }
  return blocks;
}

//------------------------------------------------------------------------------
/// In pieces, so that threads share them evenly.
std::vector<Block> GetBlocks(const vtkExchangeHierarchy* hierarchy)
{
  std::vector<Block> blocks;
  const auto cut = [&](const auto& table)
  {
    const std::size_t most = 262144;
    const std::size_t bytes = table.size() * sizeof(table[0]);
    for (std::size_t first = 0; first < bytes; first += most)
    {
      blocks.push_back(
        { reinterpret_cast<const char*>(table.data()) + first, std::min(most, bytes - first) });
    }
  };
  cut(hierarchy->GetColumns());
  cut(hierarchy->GetValues());
  cut(hierarchy->GetCodedRows().Slots);
  cut(hierarchy->GetCodedRows().Bytes);
  return blocks;
}

//------------------------------------------------------------------------------
/// Integers, so that the compiler may add them in any order and with any width.
WIDEST_VECTORS std::uint32_t Sum(const std::uint32_t* values, std::size_t count)
{
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    sum += values[i];
  }
  return sum;
}

//------------------------------------------------------------------------------
/// Seconds that `threads` threads take to read all blocks `passes` times.
double TimeReading(const std::vector<Block>& blocks, int threads, int passes)
{
  std::vector<std::uint32_t> sums(threads);
  std::vector<std::thread> workers;
  const double begin = GetSeconds();
  for (int t = 0; t < threads; ++t)
  {
    workers.emplace_back(
      [&, t]()
      {
        const std::size_t first = blocks.size() * t / threads;
        const std::size_t last = blocks.size() * (t + 1) / threads;
        std::uint32_t sum = 0;
        for (int pass = 0; pass < passes; ++pass)
        {
          for (std::size_t block = first; block < last; ++block)
          {
            sum += Sum(static_cast<const std::uint32_t*>(blocks[block].Begin),
              blocks[block].Bytes / sizeof(std::uint32_t));
          }
        }
        sums[t] = sum;
      });
  }
  for (std::thread& worker : workers)
  {
    worker.join();
  }
  const double seconds = GetSeconds() - begin;
  volatile std::uint32_t keep = 0;
  for (std::uint32_t sum : sums)
  {
    keep = keep + sum;
  }
  return seconds;
}

//------------------------------------------------------------------------------
PlainWork MakeReading(const std::vector<Block>& blocks, int threads)
{
  PlainWork work;
  for (const Block& block : blocks)
  {
    work.Bytes += static_cast<double>(block.Bytes);
  }
  work.Time = [=](int passes) { return TimeReading(blocks, threads, passes); };
  return work;
}

//------------------------------------------------------------------------------
/// An operator on the same device, and in the same context, as another, with a vector of four bands
/// in slot 0; null where the device cannot hold it.
vtkSmartPointer<vtkLinkOperator> MakeVectorOnDevice(vtkDeviceLinkOperator* device, int patches)
{
  vtkNew<vtkExchangeHierarchy> tree;
  vtkSmartPointer<vtkLinkOperator> links;
  links.TakeReference(device->NewInstance());
  const std::vector<double> values(4 * static_cast<std::size_t>(patches), 0.5);
  if (!tree->SetTree(std::vector<double>(patches, 1.0), MakeTree(patches)) ||
    !links->Initialize(tree, 4) || !links->SetVector(0, values.data()))
  {
    links = nullptr;
  }
  return links;
}

//------------------------------------------------------------------------------
/// Without a time where the device cannot hold the vectors.
PlainWork MakeCopying(vtkDeviceLinkOperator* device)
{
  PlainWork work;
  const vtkSmartPointer<vtkLinkOperator> large = MakeVectorOnDevice(device, CopiedPatches);
  const vtkSmartPointer<vtkLinkOperator> small = MakeVectorOnDevice(device, 1);
  if (large && small)
  {
    work.Bytes = 2.0 * 4.0 * sizeof(float) * CopiedPatches;
    work.Time = [=](int passes)
    {
      const double begin = GetSeconds();
      for (int pass = 0; pass < passes; ++pass)
      {
        large->Scale(1, 0, 0);
      }
      // Reading one number back waits for all that the context has drawn before.
      double norm[4];
      small->MaxNorm(0, norm);
      return GetSeconds() - begin;
    };
  }
  return work;
}

//------------------------------------------------------------------------------
bool PrepareVectors(vtkLinkOperator* links)
{
  const std::size_t size =
    static_cast<std::size_t>(links->GetNumberOfPatches()) * links->GetNumberOfBands();
  std::vector<double> emission(size);
  for (std::size_t i = 0; i < size; ++i)
  {
    emission[i] = PairValue(i, size);
  }
  // All areas are 1, so rho / A is the reflectance.
  const std::vector<double> reflectance(size, Reflectance);
  return links->SetVector(EMISSION, emission.data()) &&
    links->SetVector(RADIOSITY, emission.data()) &&
    links->SetVector(REFLECTANCE, reflectance.data());
}

//------------------------------------------------------------------------------
bool Iterate(vtkLinkOperator* links, int iterations)
{
  const std::vector<double> one(links->GetNumberOfBands(), 1.0);
  for (int i = 0; i < iterations; ++i)
  {
    if (!links->Multiply(GATHERED, RADIOSITY) || !links->Scale(GATHERED, GATHERED, REFLECTANCE) ||
      !links->Combine(RADIOSITY, one.data(), EMISSION, one.data(), GATHERED))
    {
      return false;
    }
  }
  // Reading one number back waits for a device that works on its own.
  std::vector<double> norm(links->GetNumberOfBands());
  return links->MaxNorm(RADIOSITY, norm.data());
}

//------------------------------------------------------------------------------
double TimeIterations(vtkLinkOperator* links, int iterations)
{
  const double begin = GetSeconds();
  return Iterate(links, iterations) ? GetSeconds() - begin : 0.0;
}

//------------------------------------------------------------------------------
Sample Summarize(std::vector<double> rates)
{
  std::sort(rates.begin(), rates.end());
  return { rates.back(), rates[rates.size() / 2] };
}

//------------------------------------------------------------------------------
/// Measure one operator, and the plain work in turn with it, so that both see the same machine.
bool Measure(vtkLinkOperator* links, const PlainWork& plain, double seconds, Row& row)
{
  if (!PrepareVectors(links) || !Iterate(links, 2))
  {
    return false;
  }
  const double share = seconds / NumberOfSamples;
  const double once = TimeIterations(links, 1);
  if (once <= 0.0)
  {
    return false;
  }
  const int iterations = std::max(1, static_cast<int>(share / once));
  int passes = 0;
  if (plain.Time)
  {
    plain.Time(2);
    passes = std::max(1, static_cast<int>(share / plain.Time(1)));
  }
  std::vector<double> steps;
  std::vector<double> rates;
  for (int sample = 0; sample < NumberOfSamples; ++sample)
  {
    steps.push_back(iterations / TimeIterations(links, iterations));
    rates.push_back(plain.Time ? plain.Bytes * passes / plain.Time(passes) : 0.0);
  }
  row.Step = Summarize(steps);
  row.Plain = Summarize(rates);
  return true;
}

//------------------------------------------------------------------------------
/// The vector after a fixed number of iterations from the start: the same on every device.
std::vector<double> GetReferenceResult(vtkLinkOperator* links)
{
  std::vector<double> result(
    static_cast<std::size_t>(links->GetNumberOfPatches()) * links->GetNumberOfBands());
  if (!PrepareVectors(links) || !Iterate(links, 20) || !links->GetVector(RADIOSITY, result.data()))
  {
    result.clear();
  }
  return result;
}

//------------------------------------------------------------------------------
double GetRelativeDifference(const std::vector<double>& a, const std::vector<double>& b)
{
  double largest = 0.0;
  double difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max(largest, std::abs(a[i]));
    difference = std::max(difference, std::abs(a[i] - b[i]));
  }
  return difference / largest;
}

//------------------------------------------------------------------------------
double GetShare(const Row& row)
{
  return 100.0 * row.Bytes * row.Step.Median / row.Plain.Median;
}

//------------------------------------------------------------------------------
void PrintRow(const Row& row)
{
  const double step = row.Bytes * row.Step.Median * 1e-9;
  std::cout << std::fixed << std::setw(7) << row.Patches << std::setw(9) << row.Links
            << std::setw(6) << row.Bands << std::setprecision(1) << std::setw(10)
            << row.Bytes * 1e-6 << std::setw(11) << row.Step.Median << std::setw(11)
            << row.Step.Best << std::setprecision(2) << std::setw(9) << step;
  if (row.Plain.Median > 0.0)
  {
    std::cout << std::setw(11) << row.Plain.Median * 1e-9 << std::setw(9) << row.Plain.Best * 1e-9
              << std::setprecision(0) << std::setw(6) << GetShare(row) << " %";
  }
  std::cout << "  " << row.Device << std::endl;
}

//------------------------------------------------------------------------------
bool WriteTable(const std::string& file, const std::vector<Row>& rows, int threads)
{
  std::ofstream stream(file);
  stream << "device,threads,patches,links,bands,link_bytes,iterations_per_second_median,"
            "iterations_per_second_best,link_gb_per_second_median,plain_gb_per_second_median,"
            "plain_gb_per_second_best,percent_of_plain\n";
  for (const Row& row : rows)
  {
    stream << '"' << row.Device << "\"," << threads << ',' << row.Patches << ',' << row.Links << ','
           << row.Bands << ',' << std::setprecision(12) << row.Bytes << std::setprecision(6) << ','
           << row.Step.Median << ',' << row.Step.Best << ',' << row.Bytes * row.Step.Median * 1e-9
           << ',';
    if (row.Plain.Median > 0.0)
    {
      stream << row.Plain.Median * 1e-9 << ',' << row.Plain.Best * 1e-9 << ',' << GetShare(row);
    }
    else
    {
      stream << ",,";
    }
    stream << '\n';
  }
  return static_cast<bool>(stream.flush());
}

//------------------------------------------------------------------------------
class Benchmark
{
public:
  explicit Benchmark(const Options& options)
    : Settings(options), Threads(vtkDenseLinkOperator::GetNumberOfThreads())
  {
  }

  //------------------------------------------------------------------------------
  bool Run()
  {
    std::cout << "Instruction set of the CPU operator: "
              << vtkDenseLinkOperator::GetInstructionSet() << ", " << this->Threads
              << " threads. Single precision. Medians of " << NumberOfSamples
              << " samples. Plain: reading on the CPU, copying with OpenGL.\n";
    if (this->Settings.Device != "cpu")
    {
      this->OpenDevice();
    }
    std::cout << "patches    links bands  links MB      it/s  best it/s     GB/s plain GB/s     "
                 "best  share\n";
    bool done = true;
    for (std::size_t i = 0; i < this->Settings.Sizes.size() && done; ++i)
    {
      done = this->Settings.Sizes[i] == 0 || this->RunMatrix(this->Settings.Sizes[i]);
    }
    for (std::size_t i = 0; i < this->Settings.Links.size() && done; ++i)
    {
      done = this->Settings.Links[i] == 0 || this->RunHierarchy(this->Settings.Links[i]);
    }
    for (std::size_t i = 0; i < this->Settings.Rows.size() && done; ++i)
    {
      done = this->Settings.Rows[i] == 0 ||
        (this->RunRows(this->Settings.Rows[i], true) &&
          this->RunRows(this->Settings.Rows[i], false));
    }
    if (done && !this->Settings.File.empty() &&
      !WriteTable(this->Settings.File, this->Rows, this->Threads))
    {
      std::cerr << "Cannot write " << this->Settings.File << ".\n";
      return false;
    }
    return done;
  }

private:
  //------------------------------------------------------------------------------
  void OpenDevice()
  {
    this->Device.TakeReference(vtkDeviceLinkOperator::New());
    std::string reason = "the rendering module is not built.";
    if (!this->Device || !this->Device->Open(reason))
    {
      std::cout << "OpenGL is left out: " << reason << "\n";
      this->Device = nullptr;
      return;
    }
    this->Copying = MakeCopying(this->Device);
  }

  //------------------------------------------------------------------------------
  bool RunMatrix(int patches)
  {
    vtkNew<vtkExchangeMatrix> matrix;
    if (!matrix->Allocate(std::vector<double>(patches, 1.0), 1))
    {
      std::cerr << "Not enough memory for " << patches << " patches: leave this size out.\n";
      return false;
    }
    FillMatrix(matrix);
    Row row{ "", patches, 0, 0, matrix->GetNumberOfBytes(), {}, {} };
    vtkNew<vtkDenseLinkOperator> links;
    const PlainWork reading = MakeReading(GetBlocks(matrix), this->Threads);
    const bool tooSlow = this->Device && !this->Device->IsHardware() &&
      patches > LargestForSoftwareRenderers && this->Settings.Device == "all";
    // The device holds, and reads, full rows.
    const double bytesOnDevice = std::pow(static_cast<double>(patches), 2) * sizeof(float);
    return this->RunOperators(matrix, links, reading, tooSlow ? 0.0 : bytesOnDevice, row);
  }

  //------------------------------------------------------------------------------
  bool RunHierarchy(int count)
  {
    vtkNew<vtkExchangeHierarchy> hierarchy;
    if (!FillHierarchy(hierarchy, count))
    {
      std::cerr << "Not enough memory for " << count << " links: leave this number out.\n";
      return false;
    }
    const PlainWork reading = MakeReading(GetBlocks(hierarchy), this->Threads);
    Row row{ "", hierarchy->GetNumberOfPatches(), count, 0, reading.Bytes, {}, {} };
    vtkNew<vtkHierarchicalLinkOperator> links;
    return this->RunOperators(hierarchy, links, reading, reading.Bytes, row);
  }

  //------------------------------------------------------------------------------
  /// As they are, and coded.
  bool RunRows(int patches, bool uniform)
  {
    vtkNew<vtkExchangeHierarchy> hierarchy;
    if (!FillRows(hierarchy, patches, uniform))
    {
      std::cerr << "Not enough memory for " << patches << " rows: leave this number out.\n";
      return false;
    }
    const std::vector<int> bands = std::exchange(this->Settings.Bands, std::vector<int>{ 3 });
    bool done = true;
    for (const bool coded : { false, true })
    {
      std::cout << (uniform ? "uniform" : "adaptive") << (coded ? ", coded" : "");
      if (coded)
      {
        const double begin = GetSeconds();
        const double error = hierarchy->CompressRows(0.0);
        std::cout << std::setprecision(4) << " in " << GetSeconds() - begin << " s, error "
                  << error;
      }
      std::cout << "\n";
      const PlainWork reading = MakeReading(GetBlocks(hierarchy), this->Threads);
      Row row{ "", patches, hierarchy->GetNumberOfLinks(), 0, reading.Bytes, {}, {} };
      vtkNew<vtkHierarchicalLinkOperator> links;
      done = done && this->RunOperators(hierarchy, links, reading, reading.Bytes, row);
    }
    this->Settings.Bands = bands;
    return done;
  }

  //------------------------------------------------------------------------------
  /// On the CPU, and on the device if `bytesOnDevice` is not 0.
  bool RunOperators(vtkExchange* exchange, vtkLinkOperator* links, const PlainWork& reading,
    double bytesOnDevice, Row row)
  {
    bool done = true;
    for (std::size_t i = 0; i < this->Settings.Bands.size() && done; ++i)
    {
      row.Bands = this->Settings.Bands[i];
      std::vector<double> expected;
      done = this->Settings.Device == "opengl" ||
        this->RunOperator(links, exchange, reading, row, expected);
      if (done && this->Device && bytesOnDevice > 0.0)
      {
        Row onDevice = row;
        onDevice.Bytes = bytesOnDevice;
        done = this->RunOperator(this->Device, exchange, this->Copying, onDevice, expected);
      }
    }
    return done;
  }

  //------------------------------------------------------------------------------
  /// `expected` is the result to compare with, or receives the first one.
  bool RunOperator(vtkLinkOperator* links, vtkExchange* exchange, const PlainWork& plain, Row row,
    std::vector<double>& expected)
  {
    if (!links->Initialize(exchange, row.Bands) ||
      !Measure(links, plain, this->Settings.Seconds, row))
    {
      return false;
    }
    const std::vector<double> result = GetReferenceResult(links);
    row.Device = links->GetDeviceName();
    links->Release();
    if (result.empty())
    {
      return false;
    }
    if (expected.empty())
    {
      expected = result;
    }
    else if (GetRelativeDifference(expected, result) > 1e-5)
    {
      std::cerr << row.Device << " differs from the first operator by "
                << GetRelativeDifference(expected, result) << " of the largest value.\n";
      return false;
    }
    PrintRow(row);
    this->Rows.push_back(row);
    return true;
  }

  Options Settings;
  int Threads;
  vtkSmartPointer<vtkDeviceLinkOperator> Device;
  PlainWork Copying;
  std::vector<Row> Rows;
};
} // end of anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Options options;
  if (argc == 2 && std::strcmp(argv[1], "--help") == 0)
  {
    std::cout << Usage;
    return EXIT_SUCCESS;
  }
  if (!ParseOptions(argc, argv, options))
  {
    std::cerr << Usage;
    return EXIT_FAILURE;
  }
  bool done = false;
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 0, "STDThread", false },
    [&]() { done = Benchmark(options).Run(); });
  return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
