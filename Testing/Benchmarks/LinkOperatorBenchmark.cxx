// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Iterations per second of the dense Jacobi step B <- E + rho G B / A, on the CPU and with OpenGL,
 * and the memory bandwidth that this amounts to, beside a plain loop that reads the same bytes of
 * the same matrix with the same number of threads.
 *
 * Not a test: timings depend on the machine and on what else it does. For orientation, Carr, Hall
 * and Hart (Graphics Hardware 2003) report about 30 iterations per second on their GPU and 40 on
 * their CPU at about 1,530 patches.
 */
#include "vtkDenseLinkOperator.h"
#include "vtkDeviceLinkOperator.h"
#include "vtkExchangeMatrix.h"
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
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#if defined(__x86_64__) && defined(__GNUC__)
#define WIDEST_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDEST_VECTORS
#endif

namespace
{
constexpr const char* Usage =
  "usage: LinkOperatorBenchmark [--sizes N,N,...] [--bands N,N,...] [--device all|cpu|opengl]\n"
  "                             [--seconds S] [--csv FILE]\n"
  "  --sizes    numbers of patches (1530,4096,16384)\n"
  "  --bands    numbers of bands (1,3)\n"
  "  --device   what to measure (all); a software OpenGL renderer is measured up to 4,096 "
  "patches,\n"
  "             with --device opengl at all sizes\n"
  "  --seconds  time for each measurement, after warming up (2)\n"
  "  --csv      write the table to a file as well\n";

constexpr vtkIdType LargestForSoftwareRenderers = 4096;
constexpr int NumberOfSamples = 9;
constexpr double Reflectance = 0.7;

struct Options
{
  std::vector<int> Sizes = { 1530, 4096, 16384 };
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
  int Bands;
  double Bytes;
  /// Iterations per second.
  Sample Step;
  /// Passes over the matrix per second of the plain loop; 0 where it says nothing (OpenGL has
  /// memory of its own).
  Sample Read;
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
    if (values.back() < 1)
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
    else if (name == "--bands")
    {
      valid = ParseIntegers(value, options.Bands);
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
/// Seconds that `threads` threads take to read the whole matrix `passes` times.
double TimeReading(const vtkExchangeMatrix* matrix, int threads, int passes)
{
  const std::vector<vtkExchangeMatrix::Tile>& tiles = matrix->GetTiles();
  const std::size_t count = vtkExchangeMatrix::TileSize * vtkExchangeMatrix::TileSize;
  std::vector<std::uint32_t> sums(threads);
  std::vector<std::thread> workers;
  const double begin = GetSeconds();
  for (int t = 0; t < threads; ++t)
  {
    workers.emplace_back(
      [&, t]()
      {
        const std::size_t first = tiles.size() * t / threads;
        const std::size_t last = tiles.size() * (t + 1) / threads;
        std::uint32_t sum = 0;
        for (int pass = 0; pass < passes; ++pass)
        {
          for (std::size_t tile = first; tile < last; ++tile)
          {
            sum += Sum(reinterpret_cast<const std::uint32_t*>(tiles[tile].Values), count);
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
/**
 * Measure one operator, and with `threads` > 0 the plain loop in turn with it, so that both see the
 * same machine.
 */
bool Measure(vtkLinkOperator* links, const vtkExchangeMatrix* matrix, int threads, double seconds,
  Row& row)
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
  if (threads > 0)
  {
    TimeReading(matrix, threads, 2);
    passes = std::max(1, static_cast<int>(share / TimeReading(matrix, threads, 1)));
  }
  std::vector<double> steps;
  std::vector<double> reads;
  for (int sample = 0; sample < NumberOfSamples; ++sample)
  {
    steps.push_back(iterations / TimeIterations(links, iterations));
    reads.push_back(threads > 0 ? passes / TimeReading(matrix, threads, passes) : 0.0);
  }
  row.Step = Summarize(steps);
  row.Read = Summarize(reads);
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
void PrintRow(const Row& row)
{
  const double step = row.Bytes * row.Step.Median * 1e-9;
  std::cout << std::fixed << std::setw(7) << row.Patches << std::setw(6) << row.Bands
            << std::setprecision(1) << std::setw(10) << row.Bytes * 1e-6 << std::setw(11)
            << row.Step.Median << std::setw(11) << row.Step.Best << std::setprecision(2)
            << std::setw(9) << step;
  if (row.Read.Median > 0.0)
  {
    std::cout << std::setw(9) << row.Bytes * row.Read.Median * 1e-9 << std::setw(9)
              << row.Bytes * row.Read.Best * 1e-9 << std::setprecision(0) << std::setw(6)
              << 100.0 * row.Step.Median / row.Read.Median << " %";
  }
  std::cout << "  " << row.Device << std::endl;
}

//------------------------------------------------------------------------------
bool WriteTable(const std::string& file, const std::vector<Row>& rows, int threads)
{
  std::ofstream stream(file);
  stream << "device,threads,patches,bands,matrix_bytes,iterations_per_second_median,"
            "iterations_per_second_best,matrix_gb_per_second_median,read_gb_per_second_median,"
            "read_gb_per_second_best,percent_of_read\n";
  for (const Row& row : rows)
  {
    stream << '"' << row.Device << "\"," << threads << ',' << row.Patches << ',' << row.Bands << ','
           << std::setprecision(12) << row.Bytes << std::setprecision(6) << ',' << row.Step.Median
           << ',' << row.Step.Best << ',' << row.Bytes * row.Step.Median * 1e-9 << ',';
    if (row.Read.Median > 0.0)
    {
      stream << row.Bytes * row.Read.Median * 1e-9 << ',' << row.Bytes * row.Read.Best * 1e-9 << ','
             << 100.0 * row.Step.Median / row.Read.Median;
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
              << " threads. One kernel, symmetric storage in single precision. Medians of "
              << NumberOfSamples << " samples.\n";
    if (this->Settings.Device != "cpu")
    {
      this->OpenDevice();
    }
    std::cout << "patches bands matrix MB      it/s  best it/s     GB/s read GB/s     best  "
                 "share\n";
    for (int patches : this->Settings.Sizes)
    {
      if (!this->RunSize(patches))
      {
        return false;
      }
    }
    if (!this->Settings.File.empty() && !WriteTable(this->Settings.File, this->Rows, this->Threads))
    {
      std::cerr << "Cannot write " << this->Settings.File << ".\n";
      return false;
    }
    return true;
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
    }
  }

  //------------------------------------------------------------------------------
  bool RunSize(int patches)
  {
    vtkNew<vtkExchangeMatrix> matrix;
    if (!matrix->Allocate(std::vector<double>(patches, 1.0), 1))
    {
      std::cerr << "Not enough memory for " << patches << " patches: leave this size out.\n";
      return false;
    }
    FillMatrix(matrix);
    for (int bands : this->Settings.Bands)
    {
      std::vector<double> expected;
      if (this->Settings.Device != "opengl")
      {
        vtkNew<vtkDenseLinkOperator> links;
        if (!this->RunOperator(links, matrix, bands, this->Threads, expected))
        {
          return false;
        }
      }
      const bool tooSlow = this->Device && !this->Device->IsHardware() &&
        patches > LargestForSoftwareRenderers && this->Settings.Device == "all";
      if (this->Device && !tooSlow && !this->RunOperator(this->Device, matrix, bands, 0, expected))
      {
        return false;
      }
    }
    return true;
  }

  //------------------------------------------------------------------------------
  /// `expected` is the result to compare with, or receives the first one.
  bool RunOperator(vtkLinkOperator* links, vtkExchangeMatrix* matrix, int bands, int readers,
    std::vector<double>& expected)
  {
    Row row{ "", matrix->GetNumberOfPatches(), bands, matrix->GetNumberOfBytes(), {}, {} };
    if (vtkDeviceLinkOperator::SafeDownCast(links))
    {
      // The device holds, and reads, full rows.
      row.Bytes = std::pow(static_cast<double>(row.Patches), 2) * sizeof(float);
    }
    if (!links->Initialize(matrix, bands) ||
      !Measure(links, matrix, readers, this->Settings.Seconds, row))
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
