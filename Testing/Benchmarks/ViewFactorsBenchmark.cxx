// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * View factors: error against run time, before any closure, on scenes with known answers and on
 * real ones, beside what other tools were measured to reach on the same or equal meshes.
 *
 * Numbers in the names of cases: for spheres, cylinders and real scenes the patches of the whole
 * scene, for plates and discs the triangles of each of the two, which is how the other tools count.
 *
 * Not a test: timings depend on the machine and on what else it does. "seconds" is the wall time of
 * vtkViewFactors::Update with all threads, "cpu s" the processor time of all threads together (the
 * other tools ran on one thread, python-flux was timed by the wall). A run that takes less than
 * RepeatBelow seconds counts as a warm-up and is followed by repetitions, of which the median is
 * given; a longer run is its own measurement.
 *
 * Errors of factors between groups of patches (F12 ...) are relative. "row rms" and "row max" are
 * those of |sum_j F_ij - 1| over all rows that must sum to 1. "est." is the cell array
 * ViewFactorError, "uncovered" the number of rows whose error is larger than that by more than what
 * single precision storage explains. Where no exact answer exists the error is what ten times less
 * tolerance changes: "change" is sum_j |F_ij - F_ij of the next line| in a sample of the rows, "ch.
 * uncov." the number of those whose change is larger than the two estimates together. "partly" are
 * the pairs that see each other in part.
 */
#include "ViewFactorScenes.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

using namespace LightTransportTesting;
using namespace ViewFactorBenchmark;

namespace
{
constexpr const char* Usage =
  "usage: ViewFactorsBenchmark [CASE ...] [--quick] [--list] [--tolerances T,T,...]\n"
  "                            [--dragon FILE] [--csv FILE]\n"
  "  CASE          names of cases, or what they begin with; all for every one, the largest "
  "included\n"
  "                (default: those that take up to about two minutes together)\n"
  "  --quick       the cases that take a few seconds together\n"
  "  --list        print the names of the cases\n"
  "  --tolerances  instead of those of each case\n"
  "  --dragon      PLY file of the Stanford dragon (dragon_vrip_res3.ply), for the cases of it\n"
  "  --csv         write all numbers to a file as well, one a line\n";

constexpr double RepeatBelow = 0.25;
constexpr int Repetitions = 5;
/// Rows that are compared where there is no exact answer.
constexpr vtkIdType SampledRows = 256;
/// What rounding to single precision may move in a row.
constexpr double Single = 2e-7;
constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

struct Options
{
  std::vector<std::string> Names;
  Set Largest = STANDARD;
  bool List = false;
  std::vector<double> Tolerances;
  std::string Dragon;
  std::string File;
};

struct Measurement
{
  std::string Case;
  std::string Tool;
  std::string Setting;
  double Wall;
  double Cpu;
  std::vector<std::pair<std::string, double>> Values;

  void Set(const std::string& name, double value)
  {
    for (auto& known : this->Values)
    {
      if (known.first == name)
      {
        known.second = value;
        return;
      }
    }
    this->Values.emplace_back(name, value);
  }
};

//------------------------------------------------------------------------------
/**
 * Other tools, built from source and run on one thread of a two-core x86-64 machine. Relative
 * errors of factors; root mean square of |row sum - 1|. OpenViewFactor adds the pair of a patch
 * with itself as -1 to factors of a surface with itself; that is taken out here.
 */
const std::vector<Measurement>& GetOtherTools()
{
  static const std::string ovf = "OpenViewFactor 0.3";
  static const std::string view3d = "View3D 4.0";
  static const std::string flux = "python-flux";
  static const std::vector<Measurement> tools = {
    { "parallel-221", ovf, "DAI", Unknown, 0.01, { { "F12", 1.7e-3 } } },
    { "parallel-221", ovf, "SAI", Unknown, 0.01, { { "F12", 8.4e-4 } } },
    { "parallel-221", view3d, "eps 1e-4", Unknown, 0.01, { { "F12", -8.5e-7 } } },
    { "parallel-921", ovf, "DAI", Unknown, 0.09, { { "F12", 3.9e-4 } } },
    { "parallel-921", ovf, "SAI", Unknown, 0.28, { { "F12", 1.9e-4 } } },
    { "parallel-921", view3d, "eps 1e-4", Unknown, 0.16, { { "F12", -7.6e-8 } } },
    { "parallel-3682", ovf, "DAI", Unknown, 1.34, { { "F12", 9.5e-5 } } },
    { "parallel-3682", ovf, "SAI", Unknown, 4.46, { { "F12", 4.8e-5 } } },
    { "parallel-10034", ovf, "DAI", Unknown, 11.4, { { "F12", 3.5e-5 } } },
    { "parallel-10034", ovf, "SAI", Unknown, 32.9, { { "F12", 1.7e-5 } } },
    { "perpendicular-221", view3d, "eps 1e-4", Unknown, 0.01, { { "F12", -7.6e-6 } } },
    { "perpendicular-221", view3d, "eps 1e-6", Unknown, 0.01, { { "F12", -1.4e-7 } } },
    { "perpendicular-921", ovf, "DAI", Unknown, Unknown, { { "F12", 5.7e-3 } } },
    { "perpendicular-921", ovf, "SAI", Unknown, Unknown, { { "F12", -2.9e-5 } } },
    { "perpendicular-10034", ovf, "DAI", Unknown, Unknown, { { "F12", 1.7e-3 } } },
    { "perpendicular-10034", ovf, "SAI", Unknown, 32.6, { { "F12", -5.0e-6 } } },
    { "discs-665", view3d, "eps 1e-4", Unknown, 0.06, { { "F12", -8.7e-4 } } },
    { "discs-2796", ovf, "DAI", Unknown, Unknown, { { "F12", -1.1e-4 } } },
    { "discs-2796", ovf, "SAI", Unknown, Unknown, { { "F12", -2.1e-4 } } },
    { "spheres-640", view3d, "eps 1e-4", Unknown, 1.29,
      { { "F_oi", 7.3e-5 }, { "F_oo", 5.1e-4 }, { "row rms", 3.3e-4 } } },
    { "spheres-640", view3d, "eps 1e-6", Unknown, 6.49,
      { { "F_oi", 1.0e-7 }, { "F_oo", 1.4e-6 }, { "row rms", 1.8e-6 } } },
    { "spheres-2560", view3d, "eps 1e-4", Unknown, 19.6,
      { { "F_oi", -1.1e-5 }, { "F_oo", 1.6e-4 }, { "row rms", 9.9e-5 } } },
    { "spheres-2560", flux, "CGAL", 76.5, Unknown,
      { { "F_oi", 3.0e-3 }, { "F_oo", 1.8e-3 }, { "row rms", 2.7e-3 } } },
    { "spheres-2560", flux, "Embree", 4.1, Unknown,
      { { "F_oi", -2.2e-2 }, { "F_oo", -9.7e-3 }, { "row rms", 5.2e-2 } } },
    { "spheres-2560", ovf, "SAI, BVH", Unknown, 12.2, { { "F_oo", -2.1e-3 } } },
    { "spheres-10240", ovf, "DAI", Unknown, Unknown, { { "F_io", 7.3e-4 }, { "F_oi", 7.3e-4 } } },
    { "spheres-10240", ovf, "SAI", Unknown, Unknown, { { "F_io", -2.4e-4 }, { "F_oi", 7.3e-4 } } },
    { "cylinders-1256", ovf, "DAI", Unknown, Unknown, { { "F12", 6.8e-3 } } },
    { "cylinders-1256", ovf, "SAI", Unknown, Unknown, { { "F12", -1.8e-3 } } },
    { "cylinders-1256", view3d, "eps 1e-4", Unknown, 12.6,
      { { "F12", -1.3e-4 }, { "F21", -3.2e-3 }, { "F22", 6.7e-3 } } },
    { "tube-1576", ovf, "DAI, BVH", Unknown, Unknown, { { "F12", -4.0e-2 } } },
  };
  return tools;
}

//------------------------------------------------------------------------------
double GetSeconds()
{
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

//------------------------------------------------------------------------------
double GetProcessorSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

//------------------------------------------------------------------------------
double GetMedian(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

//------------------------------------------------------------------------------
struct Norms
{
  explicit Norms(const std::vector<double>& values)
  {
    double square = 0.0;
    for (double value : values)
    {
      this->Largest = std::max(this->Largest, std::abs(value));
      square += value * value / values.size();
    }
    this->RootMeanSquare = std::sqrt(square);
  }
  double Largest = 0.0;
  double RootMeanSquare = 0.0;
};

//------------------------------------------------------------------------------
// Measuring
//------------------------------------------------------------------------------

/// Runs one scene with one tolerance after another.
class Runner
{
public:
  explicit Runner(const Scene& scene) : Data(scene), Areas(GetAreas(scene.Data)) {}

  //------------------------------------------------------------------------------
  /// `previous`, where there is one, learns what this run changes. Without values where the filter
  /// failed.
  Measurement Run(double tolerance, Measurement* previous)
  {
    Measurement result;
    std::ostringstream setting;
    setting << "Tolerance " << tolerance;
    result.Tool = "vtkViewFactors";
    result.Setting = setting.str();
    this->Time(tolerance, result);
    if (!this->Factors->GetPolyDataOutput()->GetCellData()->GetArray("ViewFactorError"))
    {
      return result;
    }
    this->AddFactorErrors(result);
    this->AddRowErrors(result);
    if (this->Data.Factors.empty())
    {
      this->AddChange(result, previous);
    }
    const std::vector<double> estimates = GetCellValues(this->Factors, "ViewFactorError");
    result.Set("est. max", Norms(estimates).Largest);
    result.Set("est. mean",
      std::accumulate(estimates.begin(), estimates.end(), 0.0) / estimates.size());
    result.Set("partly", this->GetField("PairsPartlyVisible"));
    result.Set("rays", this->GetField("RaysCast"));
    result.Set("MiB", this->GetField("MatrixBytes") / (1 << 20));
    return result;
  }

private:
  //------------------------------------------------------------------------------
  void Time(double tolerance, Measurement& result)
  {
    std::vector<double> walls, processors;
    for (int k = 0; k <= Repetitions; ++k)
    {
      // One matrix at a time.
      this->Factors = nullptr;
      const double wall = GetSeconds(), processor = GetProcessorSeconds();
      this->Factors = ComputeViewFactors(this->Data.Data, tolerance);
      const double seconds = GetSeconds() - wall;
      if (k > 0 || seconds > RepeatBelow)
      {
        walls.push_back(seconds);
        processors.push_back(GetProcessorSeconds() - processor);
      }
      if (seconds > RepeatBelow)
      {
        break;
      }
    }
    result.Wall = GetMedian(walls);
    result.Cpu = GetMedian(processors);
  }

  //------------------------------------------------------------------------------
  double GetField(const char* name) const
  {
    vtkDataArray* array = this->Factors->GetPolyDataOutput()->GetFieldData()->GetArray(name);
    return array ? array->GetComponent(0, 0) : Unknown;
  }

  //------------------------------------------------------------------------------
  void AddFactorErrors(Measurement& result) const
  {
    for (const ExactFactor& factor : this->Data.Factors)
    {
      const double value = GetGroupFactor(this->Factors, this->Areas, factor.From, factor.To);
      result.Set(factor.Name, value / factor.Value - 1.0);
    }
  }

  //------------------------------------------------------------------------------
  void AddRowErrors(Measurement& result) const
  {
    const Group& rows = this->Data.Closed;
    if (rows.End == rows.Begin)
    {
      return;
    }
    const std::vector<double> sums = GetCellValues(this->Factors, "ViewFactorSum");
    const std::vector<double> estimates = GetCellValues(this->Factors, "ViewFactorError");
    std::vector<double> errors;
    int uncovered = 0;
    for (vtkIdType i = rows.Begin; i < rows.End; ++i)
    {
      errors.push_back(std::abs(sums[i] - 1.0));
      uncovered += errors.back() > estimates[i] + Single ? 1 : 0;
    }
    const Norms norms(errors);
    result.Set("row rms", norms.RootMeanSquare);
    result.Set("row max", norms.Largest);
    result.Set("uncovered", uncovered);
  }

  //------------------------------------------------------------------------------
  /// Rows of a run, and the estimates of their errors.
  struct Sample
  {
    std::vector<float> Values;
    std::vector<double> Estimates;
  };

  //------------------------------------------------------------------------------
  Sample TakeSample() const
  {
    const vtkIdType patches = static_cast<vtkIdType>(this->Areas.size());
    const vtkIdType rows = std::min(SampledRows, patches);
    const std::vector<double> estimates = GetCellValues(this->Factors, "ViewFactorError");
    Sample sample;
    for (vtkIdType row = 0; row < rows; ++row)
    {
      const vtkIdType i = row * patches / rows;
      sample.Estimates.push_back(estimates[i]);
      for (vtkIdType j = 0; j < patches; ++j)
      {
        sample.Values.push_back(static_cast<float>(this->Factors->GetViewFactor(i, j)));
      }
    }
    return sample;
  }

  //------------------------------------------------------------------------------
  void AddChange(Measurement& result, Measurement* previous)
  {
    const Sample before = std::move(this->Last);
    this->Last = this->TakeSample();
    result.Set("change rms", Unknown);
    result.Set("change max", Unknown);
    result.Set("ch. uncov.", Unknown);
    if (!previous)
    {
      return;
    }
    const std::size_t patches = this->Areas.size();
    std::vector<double> changes(before.Estimates.size());
    int uncovered = 0;
    for (std::size_t row = 0; row < changes.size(); ++row)
    {
      for (std::size_t k = row * patches; k < (row + 1) * patches; ++k)
      {
        changes[row] += std::abs(this->Last.Values[k] - before.Values[k]);
      }
      const double estimate = before.Estimates[row] + this->Last.Estimates[row];
      uncovered += changes[row] > estimate + Single ? 1 : 0;
    }
    const Norms norms(changes);
    previous->Set("change rms", norms.RootMeanSquare);
    previous->Set("change max", norms.Largest);
    previous->Set("ch. uncov.", uncovered);
  }

  const Scene& Data;
  std::vector<double> Areas;
  vtkSmartPointer<vtkViewFactors> Factors;
  Sample Last;
};

//------------------------------------------------------------------------------
// Output
//------------------------------------------------------------------------------

/// Counts as they are, what is not known as a dash.
std::string Format(double value)
{
  std::ostringstream stream;
  if (std::isnan(value))
  {
    return "-";
  }
  if (value == std::floor(value) && std::abs(value) < 1e15)
  {
    stream << std::fixed << std::setprecision(0) << value;
  }
  else
  {
    stream << (std::abs(value) < 1.0 ? std::scientific : std::fixed) << std::setprecision(1)
           << value;
  }
  return stream.str();
}

//------------------------------------------------------------------------------
std::string FormatSeconds(double value)
{
  std::ostringstream stream;
  stream << std::setprecision(3) << value;
  return std::isnan(value) ? "-" : stream.str();
}

//------------------------------------------------------------------------------
void PrintTable(const std::vector<Measurement>& lines)
{
  std::cout << std::left << std::setw(20) << "tool" << std::setw(17) << "setting" << std::right
            << std::setw(9) << "seconds" << std::setw(9) << "cpu s";
  for (const auto& value : lines.front().Values)
  {
    std::cout << "  " << std::setw(9) << value.first;
  }
  std::cout << '\n';
  for (const Measurement& line : lines)
  {
    std::cout << std::left << std::setw(20) << line.Tool << std::setw(17) << line.Setting
              << std::right << std::setw(9) << FormatSeconds(line.Wall) << std::setw(9)
              << FormatSeconds(line.Cpu);
    for (const auto& column : lines.front().Values)
    {
      const auto found = std::find_if(line.Values.begin(), line.Values.end(),
        [&](const auto& value) { return value.first == column.first; });
      const int width = std::max(9, static_cast<int>(column.first.size()));
      std::cout << "  " << std::setw(width)
                << (found == line.Values.end() ? "-" : Format(found->second));
    }
    std::cout << '\n';
  }
  std::cout << std::endl;
}

//------------------------------------------------------------------------------
/// One number a line: what other tools give and what this one gives have different columns.
bool WriteNumbers(const std::string& file, const std::vector<Measurement>& lines)
{
  std::ofstream stream(file);
  stream << "case,tool,setting,seconds,cpu_seconds,quantity,value\n";
  const auto number = [](double value)
  {
    std::ostringstream text;
    text << std::setprecision(8) << value;
    return std::isnan(value) ? std::string() : text.str();
  };
  for (const Measurement& line : lines)
  {
    for (const auto& value : line.Values)
    {
      stream << line.Case << ',' << line.Tool << ",\"" << line.Setting << "\"," << number(line.Wall)
             << ',' << number(line.Cpu) << ',' << value.first << ',' << number(value.second)
             << '\n';
    }
  }
  return static_cast<bool>(stream.flush());
}

//------------------------------------------------------------------------------
class Benchmark
{
public:
  explicit Benchmark(const Options& options) : Settings(options) {}

  //------------------------------------------------------------------------------
  bool Run()
  {
    std::cout << vtkSMPTools::GetEstimatedNumberOfThreads() << " threads. Runs below "
              << RepeatBelow << " s: one to warm up, then the median of " << Repetitions
              << "; others once.\n\n";
    for (const Case& item : GetCases(this->Settings.Dragon))
    {
      if (this->IsWanted(item) && !this->RunCase(item))
      {
        return false;
      }
    }
    this->PrintGrowth();
    if (!this->Settings.File.empty() && !WriteNumbers(this->Settings.File, this->Lines))
    {
      std::cerr << "Cannot write " << this->Settings.File << ".\n";
      return false;
    }
    return true;
  }

private:
  //------------------------------------------------------------------------------
  bool IsWanted(const Case& item) const
  {
    if (this->Settings.Names.empty())
    {
      return item.FirstSet <= this->Settings.Largest;
    }
    return std::any_of(this->Settings.Names.begin(), this->Settings.Names.end(),
      [&](const std::string& name)
      { return name == "all" || item.Name.compare(0, name.size(), name) == 0; });
  }

  //------------------------------------------------------------------------------
  bool RunCase(const Case& item)
  {
    if (this->Settings.List)
    {
      std::cout << item.Name << '\n';
      return true;
    }
    const Scene scene = item.Make();
    std::cout << item.Name << ": " << scene.Text << std::endl;
    Runner runner(scene);
    std::vector<Measurement> lines;
    const auto& wanted = this->Settings.Tolerances;
    for (double tolerance : wanted.empty() ? item.Tolerances : wanted)
    {
      Measurement line = runner.Run(tolerance, lines.empty() ? nullptr : &lines.back());
      if (line.Values.empty())
      {
        return false;
      }
      line.Case = item.Name;
      lines.push_back(line);
    }
    for (const Measurement& other : GetOtherTools())
    {
      if (other.Case == item.Name)
      {
        lines.push_back(other);
      }
    }
    PrintTable(lines);
    this->Lines.insert(this->Lines.end(), lines.begin(), lines.end());
    return true;
  }

  //------------------------------------------------------------------------------
  /// Time grows with the number of triangles to the power of this.
  void PrintGrowth() const
  {
    const std::string prefix = "spheres-";
    std::map<std::string, std::vector<std::pair<double, double>>> times;
    for (const Measurement& line : this->Lines)
    {
      if (line.Case.compare(0, prefix.size(), prefix) == 0 && line.Tool == "vtkViewFactors")
      {
        times[line.Setting].emplace_back(std::atof(line.Case.c_str() + prefix.size()), line.Cpu);
      }
    }
    for (const auto& setting : times)
    {
      const auto& points = setting.second;
      if (points.size() > 1)
      {
        std::cout << "Spheres, " << setting.first << ": processor time grows with the power "
                  << std::setprecision(3)
                  << std::log(points.back().second / points.front().second) /
            std::log(points.back().first / points.front().first)
                  << " of the number of triangles from " << std::fixed << std::setprecision(0)
                  << points.front().first << " to " << points.back().first << std::defaultfloat
                  << '\n';
      }
    }
  }

  Options Settings;
  std::vector<Measurement> Lines;
};

//------------------------------------------------------------------------------
bool ParseNumbers(const char* text, std::vector<double>& values)
{
  std::istringstream stream(text);
  std::string item;
  while (std::getline(stream, item, ','))
  {
    values.push_back(std::atof(item.c_str()));
    if (!(values.back() > 0.0))
    {
      return false;
    }
  }
  return !values.empty();
}

//------------------------------------------------------------------------------
bool ParseOptions(int argc, char* argv[], Options& options)
{
  for (int i = 1; i < argc; ++i)
  {
    const std::string name = argv[i];
    const char* value = i + 1 < argc ? argv[i + 1] : nullptr;
    if (name == "--quick")
    {
      options.Largest = QUICK;
    }
    else if (name == "--list")
    {
      options.List = true;
      options.Largest = ALL;
    }
    else if (name.compare(0, 2, "--") != 0)
    {
      options.Names.push_back(name);
    }
    else if (!value)
    {
      return false;
    }
    else if (name == "--dragon")
    {
      options.Dragon = argv[++i];
    }
    else if (name == "--csv")
    {
      options.File = argv[++i];
    }
    else if (name != "--tolerances" || !ParseNumbers(argv[++i], options.Tolerances))
    {
      return false;
    }
  }
  return true;
}
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
