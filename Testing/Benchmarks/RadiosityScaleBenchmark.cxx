// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Radiosity by links between clusters beside the dense matrix, over the number of patches: links,
 * memory, times and errors, what they grow with, and their ratios.
 *
 * Not a test: timings depend on the machine and on what else it does. "assembly s" are the seconds
 * in which the links are made (with brightness those of both passes), "whole s" those of
 * vtkRadiosity from a mesh to arrays, conjugate gradients to 1e-6 with their error bound included;
 * "apply ms" the median of products of one band; "peak MB" the most resident memory of the process
 * in the run.
 *
 * Errors where a dense solution exists (view factors to 1e-3): "B l2" and "H l2" over the surface,
 * relative to those of the radiosity and the irradiance; "B max" relative to the largest radiosity.
 * Errors at all sizes, against exact rows of patches at random (ExactRows): "rows H" is the root
 * mean square over the rows of the irradiance that the links and that the exact rows make of the
 * same radiosity, relative to that of the irradiance, "largest" the largest of them, relative to
 * the same; "rows 1" the root mean square for a radiosity of 1 everywhere, which is what
 * LinkTolerance bounds. "LinkError" is the filter's own estimate of it (with brightness for the
 * radiosity that the links are for).
 */
#include "ExactRows.h"
#include "Links/Links.h"
#include "Support/Ranks.h"
#include "Shared/TransportMemory.h"
#include "ViewFactorScenes.h"
#include "ViewFactors/DenseViewFactors.h"
#include "ViewFactors/HierarchicalViewFactors.h"
#include "vtkCPULinkOperator.h"
#include "vtkCallbackCommand.h"
#include "vtkExchangeMatrix.h"
#include "vtkRadiosity.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <limits>
#include <numeric>
#include <sstream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

using namespace LightTransport;

using namespace LightTransportTesting;
using namespace ViewFactorBenchmark;

namespace
{
constexpr const char* Usage =
  "usage: RadiosityScaleBenchmark [--scene room|cornell] [--sizes N,N,...]\n"
  "                               [--tolerances T,T,...] [--closure off,on]\n"
  "                               [--brightness off,on] [--dense-limit N] [--dense-apply N]\n"
  "                               [--rows N] [--seconds S] [--csv FILE]\n"
  "  --scene        a furnished room, closed (default), or the Cornell box, open\n"
  "  --sizes        numbers of patches, about (2000,8000,32000,128000)\n"
  "  --tolerances   of the links (1e-1,3e-2,1e-2,3e-3)\n"
  "  --closure      EnforceClosure off, on or both, off,on (off)\n"
  "  --brightness   refinement by brightness, likewise (off)\n"
  "  --dense-limit  largest number of patches for which the matrix is computed (8500)\n"
  "  --dense-apply  and for which one is filled with any numbers, to time products (40000)\n"
  "  --rows         exact rows that errors are measured with, 0 for none (512)\n"
  "  --seconds      a run that takes longer is stopped, and those that would take still longer\n"
  "                 are left out (1800)\n"
  "  --csv          write all numbers to a file as well\n";

constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double SolverTolerance = 1e-6;
constexpr double DenseTolerance = 1e-3;
constexpr std::size_t Products = 9;
constexpr double ProductSeconds = 0.3;
/// How near the number of patches must come to the one that was asked for.
constexpr double SizeTolerance = 0.005;

using Values = std::vector<double>;

struct Options
{
  std::string Scene = "room";
  Values Sizes = { 2000, 8000, 32000, 128000 };
  Values Tolerances = { 1e-1, 3e-2, 1e-2, 3e-3 };
  std::vector<bool> Closure = { false };
  std::vector<bool> Brightness = { false };
  double DenseLimit = 8500;
  double DenseApply = 40000;
  int Rows = 512;
  double Seconds = 1800.0;
  std::string File;
};

/// How links are made.
struct Setting
{
  double Tolerance; ///< 0: the dense matrix
  bool Closure;
  bool Brightness;
};

enum Ending
{
  MEASURED,
  STOPPED, ///< after as many seconds as are allowed
  LEFT_OUT,
  FAILED
};

struct Measurement
{
  Setting How{};
  double Patches = 0.0;
  Ending Result = LEFT_OUT;
  double Assembly = Unknown;
  double Links = Unknown;
  double PatchLinks = Unknown;
  double Bytes = Unknown;
  double AllBytes = Unknown; ///< of all tiles of a matrix
  double Apply = Unknown;
  double Iterations = Unknown;
  double Whole = Unknown;
  double Peak = Unknown;
  double RadiosityError = Unknown;
  double LargestRadiosityError = Unknown;
  double IrradianceError = Unknown;
  double RowError = Unknown;
  double LargestRowError = Unknown;
  double UniformError = Unknown;
  double LinkError = Unknown;
  ///@{ Of the polygons of the mesh; emptied when the errors are known.
  Values Radiosity;
  Values Irradiance;
  Values RowSums;
  ///@}
};

/// A number that is printed: its name in the file, its head and width in the table.
struct Column
{
  const char* Name;
  const char* Head;
  int Width;
  double Scale;
  int Digits; ///< significant ones; 0 for a whole number
  double Measurement::*Value;
};

const std::vector<Column>& GetColumns()
{
  static const std::vector<Column> columns = { { "assembly_seconds", "assembly s", 11, 1.0, 3,
                                                 &Measurement::Assembly },
    { "links", "links", 10, 1.0, 0, &Measurement::Links },
    { "patch_links", "of patches", 11, 1.0, 0, &Measurement::PatchLinks },
    { "bytes", "MB", 9, 1e-6, 3, &Measurement::Bytes },
    { "bytes_all_tiles", "all MB", 8, 1e-6, 3, &Measurement::AllBytes },
    { "apply_seconds", "apply ms", 9, 1e3, 3, &Measurement::Apply },
    { "iterations", "CG", 4, 1.0, 0, &Measurement::Iterations },
    { "whole_seconds", "whole s", 8, 1.0, 3, &Measurement::Whole },
    { "peak_bytes", "peak MB", 8, 1e-6, 3, &Measurement::Peak },
    { "radiosity_error_l2", "B l2", 9, 1.0, 2, &Measurement::RadiosityError },
    { "radiosity_error_largest", "B max", 9, 1.0, 2, &Measurement::LargestRadiosityError },
    { "irradiance_error_l2", "H l2", 9, 1.0, 2, &Measurement::IrradianceError },
    { "rows_irradiance_error_rms", "rows H", 9, 1.0, 2, &Measurement::RowError },
    { "rows_irradiance_error_largest", "largest", 9, 1.0, 2, &Measurement::LargestRowError },
    { "rows_uniform_error_rms", "rows 1", 9, 1.0, 2, &Measurement::UniformError },
    { "link_error_estimate", "LinkError", 10, 1.0, 2, &Measurement::LinkError } };
  return columns;
}

//------------------------------------------------------------------------------
bool ParseNumbers(const char* text, Values& values)
{
  values.clear();
  std::istringstream stream(text);
  std::string item;
  while (std::getline(stream, item, ','))
  {
    values.push_back(std::atof(item.c_str()));
  }
  return !values.empty() && *std::min_element(values.begin(), values.end()) > 0.0;
}

//------------------------------------------------------------------------------
bool ParseSwitches(const std::string& text, std::vector<bool>& values)
{
  values.clear();
  std::istringstream stream(text);
  std::string item;
  while (std::getline(stream, item, ','))
  {
    if (item != "off" && item != "on")
    {
      return false;
    }
    values.push_back(item == "on");
  }
  return !values.empty();
}

//------------------------------------------------------------------------------
bool ParseNumber(const char* text, double& value)
{
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end != text && *end == '\0' && value >= 0.0;
}

//------------------------------------------------------------------------------
bool ParseOption(const std::string& name, const char* value, Options& options)
{
  const std::map<std::string, std::function<bool()>> parsers = { { "--scene",
                                                                   [&]()
                                                                   {
                                                                     options.Scene = value;
                                                                     return options.Scene ==
                                                                       "room" ||
                                                                       options.Scene == "cornell";
                                                                   } },
    { "--sizes", [&]() { return ParseNumbers(value, options.Sizes); } },
    { "--tolerances", [&]() { return ParseNumbers(value, options.Tolerances); } },
    { "--closure", [&]() { return ParseSwitches(value, options.Closure); } },
    { "--brightness", [&]() { return ParseSwitches(value, options.Brightness); } },
    { "--dense-limit", [&]() { return ParseNumber(value, options.DenseLimit); } },
    { "--dense-apply", [&]() { return ParseNumber(value, options.DenseApply); } },
    { "--rows",
      [&]()
      {
        double rows = 0.0;
        const bool valid = ParseNumber(value, rows) && rows <= 1e6;
        options.Rows = valid ? static_cast<int>(rows) : 0;
        return valid;
      } },
    { "--seconds", [&]() { return ParseNumber(value, options.Seconds); } },
    { "--csv",
      [&]()
      {
        options.File = value;
        return !options.File.empty();
      } } };
  const auto parser = parsers.find(name);
  return parser != parsers.end() && parser->second();
}

//------------------------------------------------------------------------------
bool ParseOptions(int argc, char* argv[], Options& options)
{
  bool valid = argc % 2 == 1;
  for (int i = 1; i + 1 < argc && valid; i += 2)
  {
    valid = ParseOption(argv[i], argv[i + 1], options);
  }
  // Runs that take longer come later.
  std::sort(options.Sizes.begin(), options.Sizes.end());
  std::sort(options.Tolerances.rbegin(), options.Tolerances.rend());
  return valid;
}

//------------------------------------------------------------------------------
double GetSeconds()
{
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

//------------------------------------------------------------------------------
/// Where the system lets a process do that: the most resident memory is then counted from now on,
/// without what the C library has kept of what was freed.
void ResetPeakMemory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  std::ofstream("/proc/self/clear_refs") << "5";
}

//------------------------------------------------------------------------------
/// Bytes; unknown where the system does not tell.
double GetPeakMemory()
{
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line))
  {
    if (line.compare(0, 6, "VmHWM:") == 0)
    {
      return 1024.0 * std::atof(line.c_str() + 6);
    }
  }
  return Unknown;
}

//------------------------------------------------------------------------------
/// A mesh with about `wanted` cells, by the length of their edges.
vtkSmartPointer<vtkPolyData> FindMesh(const std::function<Scene(double)>& make, double wanted)
{
  vtkSmartPointer<vtkPolyData> best;
  double distance = std::numeric_limits<double>::infinity();
  const auto isEnough = [&](double length)
  {
    const vtkSmartPointer<vtkPolyData> mesh = make(length).Data;
    const double excess = static_cast<double>(mesh->GetNumberOfCells()) / wanted - 1.0;
    best = std::abs(excess) < distance ? mesh : best;
    distance = std::min(distance, std::abs(excess));
    return excess >= 0.0;
  };
  double fine = 1024.0;
  while (!isEnough(fine))
  {
    fine *= 0.5;
  }
  double coarse = 2.0 * fine;
  for (int step = 0; step < 16 && distance > SizeTolerance; ++step)
  {
    const double middle = std::sqrt(fine * coarse);
    (isEnough(middle) ? fine : coarse) = middle;
  }
  return best;
}

//------------------------------------------------------------------------------
/// One band: the lamp over the table shines, floor, walls and furniture differ.
void AddRoomMaterials(vtkPolyData* room)
{
  // Of the parts in their order; the walls' is that of those on the sides.
  constexpr double reflectances[] = { 0.7, 0.4, 0.5, 0.6, 0.55 };
  constexpr double floor = 0.3;
  constexpr double ceiling = 0.8;
  vtkDoubleArray* reflectance = AddArray(room, "Reflectance", { 0.0 });
  vtkDoubleArray* emission = AddArray(room, "Emission", { 0.0 });
  vtkDataArray* parts = room->GetCellData()->GetArray("Part");
  for (vtkIdType cell = 0; cell < room->GetNumberOfCells(); ++cell)
  {
    const int part = static_cast<int>(parts->GetComponent(cell, 0));
    double bounds[6];
    room->GetCellBounds(cell, bounds);
    const bool isFloor = part == ROOM_WALLS && bounds[5] <= 0.0;
    const bool isCeiling = part == ROOM_WALLS && bounds[4] >= RoomHeight;
    reflectance->SetValue(cell, isFloor ? floor : (isCeiling ? ceiling : reflectances[part]));
    emission->SetValue(cell, part == ROOM_LAMP ? 1.0 : 0.0);
  }
}

//------------------------------------------------------------------------------
/// The first band of what there is.
[[maybe_unused]] void KeepOneBand(vtkPolyData* scene)
{
  for (const char* name : { "Reflectance", "Emission" })
  {
    const vtkSmartPointer<vtkDataArray> all = scene->GetCellData()->GetArray(name);
    scene->GetCellData()->RemoveArray(name);
    vtkDoubleArray* one = AddArray(scene, name, { 0.0 });
    one->CopyComponent(0, all, 0);
  }
}

//------------------------------------------------------------------------------
/// Null where the scene cannot be made.
vtkSmartPointer<vtkPolyData> MakeScene(const std::string& name, double patches)
{
  if (name == "room")
  {
    const auto room = FindMesh(MakeFurnishedRoom, patches);
    AddRoomMaterials(room);
    return room;
  }
#ifdef LIGHTTRANSPORT_HAS_MESHING
  const auto box = FindMesh(MakeCornellBox, patches);
  KeepOneBand(box);
  return box;
#else
  std::cerr << "The Cornell box is cut into patches by the meshing module, which is not built.\n";
  return nullptr;
#endif
}

//------------------------------------------------------------------------------
Values GetOutputValues(vtkRadiosity* radiosity, const char* name)
{
  vtkDataArray* array = radiosity->GetPolyDataOutput()->GetCellData()->GetArray(name);
  Values values(array ? array->GetNumberOfTuples() : 0);
  for (std::size_t cell = 0; cell < values.size(); ++cell)
  {
    values[cell] = array->GetComponent(static_cast<vtkIdType>(cell), 0);
  }
  return values;
}

//------------------------------------------------------------------------------
/// NaN where it is missing.
double GetFieldValue(vtkRadiosity* radiosity, const char* name)
{
  vtkDataArray* array = radiosity->GetPolyDataOutput()->GetFieldData()->GetArray(name);
  return array ? array->GetComponent(0, 0) : Unknown;
}

//------------------------------------------------------------------------------
/// vtkRadiosity, which is stopped when the time is used up.
class TimedRadiosity
{
public:
  TimedRadiosity(vtkPolyData* scene, const Setting& setting, double end) : End(end)
  {
    this->Filter->SetInputData(scene);
    this->Filter->SetLinkMethod(setting.Tolerance > 0.0 ? vtkRadiosity::LINK_METHOD_HIERARCHICAL
                                                        : vtkRadiosity::LINK_METHOD_DENSE);
    this->Filter->SetLinkTolerance(setting.Tolerance);
    this->Filter->SetViewFactorTolerance(DenseTolerance);
    this->Filter->SetEnforceClosure(setting.Closure);
    this->Filter->SetRefineByBrightness(setting.Brightness);
    this->Filter->SetDeviceToCPU();
    this->Filter->SetSolverToConjugateGradient();
    this->Filter->SetTolerance(SolverTolerance);
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback(&TimedRadiosity::Look);
    this->Filter->AddObserver(vtkCommand::ProgressEvent, command);
  }

  Ending Run()
  {
    this->Filter->Update();
    if (this->IsStopped)
    {
      return STOPPED;
    }
    return GetOutputValues(this->Filter, "Radiosity").empty() ? FAILED : MEASURED;
  }

  vtkRadiosity* GetFilter() { return this->Filter; }

private:
  static void Look(vtkObject*, unsigned long, void* self, void*)
  {
    auto* run = static_cast<TimedRadiosity*>(self);
    if (GetSeconds() > run->End)
    {
      run->IsStopped = true;
      run->Filter->SetAbortExecute(1);
    }
  }

  vtkNew<vtkRadiosity> Filter;
  double End;
  bool IsStopped = false;
};

//------------------------------------------------------------------------------
/// Median of the seconds of a product with one band.
double TimeProducts(vtkExchange* exchange)
{
  const auto links = vtkCPULinkOperator::NewFor(exchange);
  const Values ones(exchange->GetNumberOfPatches(), 1.0);
  if (!links->Initialize(exchange, 1) || !links->SetVector(0, ones.data()) ||
    !links->Multiply(1, 0) || !links->Multiply(1, 0))
  {
    return Unknown;
  }
  Values seconds;
  const double begin = GetSeconds();
  while (seconds.size() < Products || GetSeconds() - begin < ProductSeconds)
  {
    const double start = GetSeconds();
    if (!links->Multiply(1, 0))
    {
      return Unknown;
    }
    seconds.push_back(GetSeconds() - start);
  }
  std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
  return seconds[seconds.size() / 2];
}

//------------------------------------------------------------------------------
/// Of a matrix with all its tiles stored; unknown where there is no memory for it.
double TimeFilledMatrix(vtkIdType patches)
{
  constexpr int size = vtkExchangeMatrix::TileSize;
  vtkNew<vtkExchangeMatrix> matrix;
  if (vtkExchangeMatrix::GetEstimatedBytes(patches, 1) >
      0.8 * TransportMemory::GetAvailableBytes() ||
    !matrix->Allocate(Values(patches, 1.0), 1))
  {
    return Unknown;
  }
  for (vtkExchangeMatrix::Tile& tile : matrix->GetTiles())
  {
    std::fill(tile.Values, tile.Values + size * size, 1.0f / static_cast<float>(patches));
  }
  return TimeProducts(matrix);
}

//------------------------------------------------------------------------------
/// The links of a run once more, to look at: a filter keeps its own to itself.
Links MakeLinks(const PatchScene& scene, const Setting& setting, const Values& brightness)
{
  Links links;
  const Outcome made = setting.Tolerance > 0.0
    ? HierarchicalViewFactors(setting.Tolerance, brightness).Build(scene, Ranks(), Monitor(), links)
    : DenseViewFactors(DenseTolerance, setting.Closure, {}).Build(scene, Ranks(), Monitor(), links);
  if (!made)
  {
    std::cerr << made.GetMessage() << "\n";
  }
  return links;
}

//------------------------------------------------------------------------------
/// What a run and its links tell.
void Record(vtkRadiosity* run, const Links& links, Measurement& row)
{
  row.Assembly = GetFieldValue(run, "ViewFactorSeconds");
  row.Links = GetFieldValue(run, "NumberOfLinks");
  row.PatchLinks = GetFieldValue(run, "NumberOfPatchLinks");
  row.LinkError = GetFieldValue(run, "LinkError");
  row.Iterations = GetFieldValue(run, "NumberOfIterations");
  row.Bytes = GetFieldValue(run, "MatrixBytes");
  row.Radiosity = GetOutputValues(run, "Radiosity");
  row.Irradiance = GetOutputValues(run, "Irradiance");
  row.RowSums = links.RowSums;
}

//------------------------------------------------------------------------------
/// For values of the scene's patches of those of the mesh's polygons.
Values SortValues(const PatchScene& scene, const Values& values)
{
  Values sorted(values.size());
  for (std::size_t polygon = 0; polygon < values.size(); ++polygon)
  {
    sorted[scene.GetPatch(static_cast<vtkIdType>(polygon))] = values[polygon];
  }
  return sorted;
}

//------------------------------------------------------------------------------
/// Before it is measured.
Measurement Describe(vtkPolyData* mesh, const Setting& setting)
{
  Measurement row;
  row.How = setting;
  row.Patches = static_cast<double>(mesh->GetNumberOfCells());
  if (setting.Tolerance == 0.0)
  {
    row.AllBytes = vtkExchangeMatrix::GetEstimatedBytes(mesh->GetNumberOfCells(), 1);
  }
  return row;
}

//------------------------------------------------------------------------------
/// One run from a mesh to arrays, and products with links like its own.
Measurement Measure(vtkPolyData* mesh, const PatchScene& scene, const Setting& setting,
  double limit)
{
  Measurement row = Describe(mesh, setting);
  ResetPeakMemory();
  const double begin = GetSeconds();
  TimedRadiosity run(mesh, setting, begin + limit);
  row.Result = run.Run();
  if (row.Result == MEASURED)
  {
    row.Whole = GetSeconds() - begin;
    row.Peak = GetPeakMemory();
    const Links links = MakeLinks(scene, setting,
      setting.Brightness ? SortValues(scene, GetOutputValues(run.GetFilter(), "Radiosity"))
                         : Values());
    Record(run.GetFilter(), links, row);
    row.Apply = links.GetExchange() ? TimeProducts(links.GetExchange()) : Unknown;
  }
  return row;
}

//------------------------------------------------------------------------------
/// Root of the sum of areas times squares.
double GetNorm(const Values& areas, const Values& values)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < areas.size(); ++k)
  {
    sum += areas[k] * values[k] * values[k];
  }
  return std::sqrt(sum);
}

//------------------------------------------------------------------------------
Values Subtract(Values a, const Values& b)
{
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::minus<double>());
  return a;
}

//------------------------------------------------------------------------------
double GetLargest(const Values& values)
{
  double largest = 0.0;
  for (const double value : values)
  {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

//------------------------------------------------------------------------------
void CompareWithDense(const Values& areas, const Measurement& dense, Measurement& row)
{
  const Values radiosity = Subtract(row.Radiosity, dense.Radiosity);
  row.RadiosityError = GetNorm(areas, radiosity) / GetNorm(areas, dense.Radiosity);
  row.LargestRadiosityError = GetLargest(radiosity) / GetLargest(dense.Radiosity);
  row.IrradianceError =
    GetNorm(areas, Subtract(row.Irradiance, dense.Irradiance)) / GetNorm(areas, dense.Irradiance);
}

//------------------------------------------------------------------------------
/// `vector` is the one that the row's radiosity was among those that the exact rows were
/// multiplied with, 0 that of ones.
void CompareWithRows(const PatchScene& scene, const ExactRows& exact, std::size_t vector,
  Measurement& row)
{
  Values areas, irradiance, difference, sumDifference;
  for (std::size_t k = 0; k < exact.GetPatches().size(); ++k)
  {
    const vtkIdType patch = exact.GetPatches()[k];
    areas.push_back(scene.GetAreas()[patch]);
    irradiance.push_back(exact.GetProduct(k, vector));
    difference.push_back(row.Irradiance[scene.GetPolygon(patch)] - irradiance.back());
    sumDifference.push_back(row.RowSums[patch] - exact.GetProduct(k, 0));
  }
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double norm = GetNorm(areas, irradiance);
  row.RowError = GetNorm(areas, difference) / norm;
  row.LargestRowError = GetLargest(difference) / (norm / std::sqrt(area));
  row.UniformError = GetNorm(areas, sumDifference) / std::sqrt(area);
}

//------------------------------------------------------------------------------
/// value = Factor * n ^ Exponent
struct PowerLaw
{
  double Factor = Unknown;
  double Exponent = Unknown;
  double operator()(double n) const { return this->Factor * std::pow(n, this->Exponent); }
};

//------------------------------------------------------------------------------
/// Least squares in logarithms over the sizes at which it is known; unknown for fewer than two.
PowerLaw Fit(const std::vector<const Measurement*>& rows, double Measurement::*value)
{
  double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Measurement* row : rows)
  {
    if (row->*value > 0.0)
    {
      const double u = std::log(row->Patches);
      const double v = std::log(row->*value);
      count += 1.0;
      x += u;
      y += v;
      xx += u * u;
      xy += u * v;
    }
  }
  PowerLaw law;
  if (count > 1.0)
  {
    law.Exponent = (count * xy - x * y) / (count * xx - x * x);
    law.Factor = std::exp((y - law.Exponent * x) / count);
  }
  return law;
}

//------------------------------------------------------------------------------
std::string FormatSetting(const Setting& setting)
{
  std::ostringstream text;
  text << std::setw(8);
  if (setting.Tolerance > 0.0)
  {
    text << setting.Tolerance << (setting.Closure ? " closed" : "       ")
         << (setting.Brightness ? " bright" : "       ");
  }
  else
  {
    text << "dense" << std::setw(14) << "";
  }
  return text.str();
}

//------------------------------------------------------------------------------
std::string FormatValue(double value, int digits)
{
  std::ostringstream text;
  if (!std::isnan(value))
  {
    digits > 0 ? text << std::setprecision(digits) << value
               : text << std::fixed << std::setprecision(0) << value;
  }
  return text.str();
}

//------------------------------------------------------------------------------
void PrintHead()
{
  std::cout << "\npatches tolerance              ";
  for (const Column& column : GetColumns())
  {
    std::cout << std::setw(column.Width) << column.Head;
  }
  std::cout << "\n";
}

//------------------------------------------------------------------------------
void PrintRow(const Measurement& row)
{
  static const char* const notes[] = { "", "  stopped", "  left out", "  failed" };
  std::cout << std::setw(7) << FormatValue(row.Patches, 0) << FormatSetting(row.How);
  for (const Column& column : GetColumns())
  {
    const double value = row.*column.Value;
    // Large numbers without an exponent.
    const bool isLarge = std::abs(value * column.Scale) >= 1000.0;
    std::cout << std::setw(column.Width)
              << FormatValue(value * column.Scale, isLarge ? 0 : column.Digits);
  }
  std::cout << notes[row.Result] << std::endl;
}

//------------------------------------------------------------------------------
bool WriteTable(const std::string& file, const std::vector<Measurement>& rows)
{
  static const char* const results[] = { "measured", "stopped", "left out", "failed" };
  std::ofstream stream(file);
  stream << "patches,method,link_tolerance,closure,brightness,result";
  for (const Column& column : GetColumns())
  {
    stream << ',' << column.Name;
  }
  stream << '\n';
  for (const Measurement& row : rows)
  {
    const bool isDense = row.How.Tolerance == 0.0;
    stream << row.Patches << ',' << (isDense ? "dense" : "hierarchical") << ','
           << FormatValue(isDense ? Unknown : row.How.Tolerance, 6) << ',' << row.How.Closure << ','
           << row.How.Brightness << ',' << results[row.Result];
    for (const Column& column : GetColumns())
    {
      stream << ',' << FormatValue(row.*column.Value, 12);
    }
    stream << '\n';
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
    std::cout << "Scene: " << this->Settings.Scene << ". "
              << vtkCPULinkOperator::GetNumberOfThreads() << " threads.\n";
    for (const double size : this->Settings.Sizes)
    {
      if (!this->RunSize(size))
      {
        return false;
      }
    }
    PrintHead();
    std::for_each(this->Rows.begin(), this->Rows.end(), PrintRow);
    this->PrintExponents();
    this->PrintRatios();
    if (!this->Settings.File.empty() && !WriteTable(this->Settings.File, this->Rows))
    {
      std::cerr << "Cannot write " << this->Settings.File << ".\n";
      return false;
    }
    return std::none_of(this->Rows.begin(), this->Rows.end(),
      [](const Measurement& row) { return row.Result == FAILED; });
  }

private:
  //------------------------------------------------------------------------------
  bool RunSize(double size)
  {
    const vtkSmartPointer<vtkPolyData> mesh = MakeScene(this->Settings.Scene, size);
    PatchScene scene;
    const Outcome built = mesh ? scene.Build(mesh, Ranks()) : Outcome::FailedAsReported();
    if (!built)
    {
      std::cerr << built.GetMessage() << "\n";
      return false;
    }
    const std::size_t first = this->Rows.size();
    PrintHead();
    this->RunDense(mesh, scene);
    for (const bool closure : this->Settings.Closure)
    {
      for (const bool brightness : this->Settings.Brightness)
      {
        for (const double tolerance : this->Settings.Tolerances)
        {
          this->RunLinks(mesh, scene, { tolerance, closure, brightness }, first);
        }
      }
    }
    this->RunRows(scene, first);
    for (std::size_t row = first; row < this->Rows.size(); ++row)
    {
      this->Rows[row].Radiosity = this->Rows[row].Irradiance = this->Rows[row].RowSums = Values();
    }
    return true;
  }

  //------------------------------------------------------------------------------
  void RunDense(vtkPolyData* mesh, const PatchScene& scene)
  {
    const Setting dense{ 0.0, false, false };
    Measurement row = Describe(mesh, dense);
    if (row.Patches <= this->Settings.DenseLimit && !this->WasStopped(dense))
    {
      row = Measure(mesh, scene, dense, this->Settings.Seconds);
    }
    if (row.Result != MEASURED && row.Patches <= this->Settings.DenseApply)
    {
      row.Apply = TimeFilledMatrix(mesh->GetNumberOfCells());
    }
    PrintRow(row);
    this->Rows.push_back(row);
  }

  //------------------------------------------------------------------------------
  /// `first` is the row of the dense matrix of this size.
  void RunLinks(vtkPolyData* mesh, const PatchScene& scene, const Setting& setting,
    std::size_t first)
  {
    Measurement row = Describe(mesh, setting);
    if (!this->WasStopped(setting))
    {
      row = Measure(mesh, scene, setting, this->Settings.Seconds);
    }
    if (row.Result == MEASURED && this->Rows[first].Result == MEASURED)
    {
      CompareWithDense(GetAreas(mesh), this->Rows[first], row);
    }
    PrintRow(row);
    this->Rows.push_back(row);
  }

  //------------------------------------------------------------------------------
  /// Whether a run that would not have taken longer was.
  bool WasStopped(const Setting& setting) const
  {
    return std::any_of(this->Rows.begin(), this->Rows.end(),
      [&](const Measurement& row)
      {
        return row.Result == STOPPED && row.How.Closure == setting.Closure &&
          row.How.Brightness == setting.Brightness &&
          (row.How.Tolerance > 0.0) == (setting.Tolerance > 0.0) &&
          row.How.Tolerance >= setting.Tolerance;
      });
  }

  //------------------------------------------------------------------------------
  /// Errors of all runs of this size.
  void RunRows(const PatchScene& scene, std::size_t first)
  {
    if (this->Settings.Rows == 0)
    {
      return;
    }
    std::vector<Values> vectors(1, Values(scene.GetNumberOfPatches(), 1.0));
    for (std::size_t row = first; row < this->Rows.size(); ++row)
    {
      if (this->Rows[row].Result == MEASURED)
      {
        vectors.push_back(SortValues(scene, this->Rows[row].Radiosity));
      }
    }
    std::vector<const Values*> pointers;
    for (const Values& vector : vectors)
    {
      pointers.push_back(&vector);
    }
    const double begin = GetSeconds();
    ExactRows exact(scene, this->Settings.Rows);
    exact.Multiply(pointers);
    std::size_t vector = 0;
    for (std::size_t row = first; row < this->Rows.size(); ++row)
    {
      if (this->Rows[row].Result == MEASURED)
      {
        CompareWithRows(scene, exact, ++vector, this->Rows[row]);
      }
    }
    this->PrintRowErrors(exact, GetSeconds() - begin, first);
  }

  //------------------------------------------------------------------------------
  void PrintRowErrors(const ExactRows& exact, double seconds, std::size_t first) const
  {
    double error = 0.0;
    for (std::size_t k = 0; k < exact.GetPatches().size(); ++k)
    {
      error += exact.GetError(k) / static_cast<double>(exact.GetPatches().size());
    }
    std::cout << "  " << exact.GetPatches().size() << " exact rows in " << FormatValue(seconds, 3)
              << " s; estimate of the sum of the errors of a row, mean: " << FormatValue(error, 2)
              << "\n";
    for (std::size_t row = first; row < this->Rows.size(); ++row)
    {
      const Measurement& result = this->Rows[row];
      if (result.Result == MEASURED)
      {
        std::cout << "  " << FormatSetting(result.How) << "  rows H "
                  << FormatValue(result.RowError, 2) << ", largest "
                  << FormatValue(result.LargestRowError, 2) << ", rows 1 "
                  << FormatValue(result.UniformError, 2) << "\n";
      }
    }
    std::cout << std::flush;
  }

  //------------------------------------------------------------------------------
  /// Those that were measured, in the order of their sizes.
  std::vector<const Measurement*> GetSeries(const Setting& setting) const
  {
    std::vector<const Measurement*> series;
    for (const Measurement& row : this->Rows)
    {
      if (row.How.Tolerance == setting.Tolerance && row.How.Closure == setting.Closure &&
        row.How.Brightness == setting.Brightness)
      {
        series.push_back(&row);
      }
    }
    return series;
  }

  //------------------------------------------------------------------------------
  void PrintExponents() const
  {
    std::cout << "\nFitted exponents of the number of patches\n"
                 "tolerance                  links  apply  assembly  bytes  whole\n";
    const auto print = [&](const Setting& setting)
    {
      const auto series = this->GetSeries(setting);
      std::cout << FormatSetting(setting);
      for (const auto& column : { std::make_pair(&Measurement::Links, 10),
             std::make_pair(&Measurement::Apply, 7), std::make_pair(&Measurement::Assembly, 10),
             std::make_pair(&Measurement::Bytes, 7), std::make_pair(&Measurement::Whole, 7) })
      {
        std::cout << std::setw(column.second) << FormatValue(Fit(series, column.first).Exponent, 3);
      }
      std::cout << "\n";
    };
    // All that there are, in the order of the first size.
    for (const Measurement& row : this->Rows)
    {
      if (row.Patches == this->Rows.front().Patches)
      {
        print(row.How);
      }
    }
  }

  //------------------------------------------------------------------------------
  /// Dense by hierarchical at each size. What was not measured of the matrix is extrapolated.
  void PrintRatios() const
  {
    std::cout << "\nDense matrix by links (* extrapolated from the measured sizes; \"apply\" where "
                 "the matrix was left out: of one with all tiles)\n"
                 "patches tolerance                 assembly       apply       bytes   all tiles\n";
    const auto dense = this->GetSeries({ 0.0, false, false });
    for (const Measurement* matrix : dense)
    {
      for (const Measurement& row : this->Rows)
      {
        if (row.Patches != matrix->Patches || row.How.Tolerance == 0.0 || row.Result != MEASURED)
        {
          continue;
        }
        std::cout << std::setw(7) << FormatValue(row.Patches, 0) << FormatSetting(row.How)
                  << std::setw(2) << "";
        for (const auto value :
          { &Measurement::Assembly, &Measurement::Apply, &Measurement::Bytes })
        {
          const bool isKnown = !std::isnan(matrix->*value);
          const double other = isKnown ? matrix->*value : Fit(dense, value)(row.Patches);
          std::cout << std::setw(11) << FormatValue(other / row.*value, 3)
                    << (isKnown || std::isnan(other) ? " " : "*");
        }
        std::cout << std::setw(11) << FormatValue(matrix->AllBytes / row.Bytes, 3) << "\n";
      }
    }
  }

  Options Settings;
  std::vector<Measurement> Rows;
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
  return Benchmark(options).Run() ? EXIT_SUCCESS : EXIT_FAILURE;
}
