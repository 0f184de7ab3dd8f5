// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPatchMesher.h"

#include "Common/MeshingRun.h"
#include "Common/TriangleSoup.h"
#include "Mesher/IsotropicRemesher.h"
#include "Mesher/PatchOutput.h"
#include "Mesher/RemeshToTarget.h"
#include "Mesher/SurfaceRepair.h"
#include "Mesher/WantedLengths.h"
#include "Shared/FilterMonitor.h"
#include "Shared/InputArrays.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkPatchMesher);

namespace
{
constexpr const char* DefaultRegionArray = "Region";
constexpr const char* DefaultLengthArray = "EdgeLength";

static_assert(static_cast<int>(PatchTarget::LengthSource::Uniform) ==
      vtkPatchMesher::SIZE_FIELD_UNIFORM &&
    static_cast<int>(PatchTarget::LengthSource::Curvature) ==
      vtkPatchMesher::SIZE_FIELD_CURVATURE &&
    static_cast<int>(PatchTarget::LengthSource::Array) == vtkPatchMesher::SIZE_FIELD_ARRAY,
  "SizeField is passed on as it is");
static_assert(static_cast<int>(SurfaceRepair::Intersections::Resolve) ==
      vtkPatchMesher::SELF_INTERSECTIONS_RESOLVE &&
    static_cast<int>(SurfaceRepair::Intersections::Refuse) ==
      vtkPatchMesher::SELF_INTERSECTIONS_REFUSE &&
    static_cast<int>(SurfaceRepair::Intersections::Keep) == vtkPatchMesher::SELF_INTERSECTIONS_KEEP,
  "SelfIntersections is passed on as it is");

//------------------------------------------------------------------------------
// Number the different tuples of an array: one number per input cell.
Outcome NumberTuples(vtkDataArray* array, std::vector<int>& numbers)
{
  std::map<std::vector<double>, int> known;
  std::vector<double> tuple(array->GetNumberOfComponents());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    array->GetTuple(i, tuple.data());
    if (std::any_of(tuple.begin(), tuple.end(), [](double value) { return std::isnan(value); }))
    {
      return Outcome::Failed("The region array \"" + std::string(array->GetName()) +
        "\" has NaN values: give every cell a region.");
    }
    numbers.push_back(known.emplace(tuple, static_cast<int>(known.size())).first->second);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// The same of arrays that hold no numbers, by their texts.
std::vector<int> NumberTexts(vtkAbstractArray* array)
{
  const int components = array->GetNumberOfComponents();
  std::map<std::vector<std::string>, int> known;
  std::vector<std::string> tuple(components);
  std::vector<int> numbers;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int j = 0; j < components; ++j)
    {
      tuple[j] = array->GetVariantValue(i * components + j).ToString();
    }
    numbers.push_back(known.emplace(tuple, static_cast<int>(known.size())).first->second);
  }
  return numbers;
}

//------------------------------------------------------------------------------
// Lengths with a default that depends on the input.
Outcome CheckLength(const char* name, double length, const char* remedy)
{
  if (!(length >= 0.0) || !std::isfinite(length))
  {
    return Outcome::Failed(std::string(name) + " is " + std::to_string(length) +
      ": give a positive length, or 0 for " + remedy + ".");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Per input cell to per triangle.
std::vector<int> GetRegionsOfTriangles(const std::vector<int>& regionOfCell,
  const TriangleSoup& soup)
{
  std::vector<int> regions;
  for (const vtkIdType cell : soup.CellIds)
  {
    regions.push_back(regionOfCell[cell]);
  }
  return regions;
}
} // namespace

//------------------------------------------------------------------------------
// What one run of the filter hands from step to step.
struct vtkPatchMesher::Job
{
  vtkPolyData* Input;
  vtkPolyData* Output;
  Monitor Watcher;
  std::vector<int> RegionOfCell;
  std::vector<double> LengthOfPoint;
  TriangleSoup Soup;
  RepairCounts Counts;
  IsotropicRemesher Remesher;
  /// The target edge length that was used.
  double Length = 0.0;
};

//------------------------------------------------------------------------------
vtkPatchMesher::vtkPatchMesher()
{
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, DefaultRegionArray);
  this->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS,
    DefaultLengthArray);
}

//------------------------------------------------------------------------------
vtkPatchMesher::~vtkPatchMesher() = default;

//------------------------------------------------------------------------------
void vtkPatchMesher::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TargetEdgeLength: " << this->TargetEdgeLength << "\n";
  os << indent << "SizeField: " << this->SizeField << "\n";
  os << indent << "ApproximationError: " << this->ApproximationError << "\n";
  os << indent << "MinimumEdgeLength: " << this->MinimumEdgeLength << "\n";
  os << indent << "Grading: " << this->Grading << "\n";
  os << indent << "CoarsePlanarRegions: " << (this->CoarsePlanarRegions ? "on" : "off") << "\n";
  os << indent << "TargetNumberOfPatches: " << this->TargetNumberOfPatches << "\n";
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "Repair: " << (this->Repair ? "on" : "off") << "\n";
  os << indent << "FillHoles: " << (this->FillHoles ? "on" : "off") << "\n";
  os << indent << "HoleSize: " << this->HoleSize << "\n";
  os << indent << "SelfIntersections: " << this->SelfIntersections << "\n";
  os << indent << "FlipNormals: " << (this->FlipNormals ? "on" : "off") << "\n";
}

//------------------------------------------------------------------------------
int vtkPatchMesher::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  Job job;
  job.Input = vtkPolyData::GetData(inputs[0]);
  job.Output = vtkPolyData::GetData(outputs);
  job.Watcher = MakeFilterMonitor(this);
  if (MeshingRun::IsEmptyPiece(job.Input, outputs->GetInformationObject(0)))
  {
    return 1;
  }
  const MeshingRun::Advice advice = { "give larger edge lengths",
    "CGAL could not remesh the surface",
    "try another TargetEdgeLength, or repair the surface first" };
  MeshingRun::Steps steps(advice);
  steps.Take([&]() { return this->CheckProperties(); });
  steps.Take([&]() { return this->ReadArrays(inputs, job); });
  steps.Take([&]() { return this->ReadSurface(job); });
  steps.Take([&]() { return this->Remesh(job); });
  steps.Take([&]() { return this->Write(job); });
  const Outcome& outcome = steps.GetOutcome();
  if (!outcome)
  {
    job.Output->Initialize();
  }
  if (outcome.HasFailed())
  {
    vtkErrorMacro(<< outcome.GetMessage());
    return 0;
  }
  return 1;
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::CheckProperties() const
{
  const Outcome lengths[] = { CheckLength("TargetEdgeLength", this->TargetEdgeLength,
                                "the diagonal of the bounding box / 50"),
    CheckLength("HoleSize", this->HoleSize, "the diagonal of the bounding box / 100"),
    CheckLength("ApproximationError", this->ApproximationError, "TargetEdgeLength / 100"),
    CheckLength("MinimumEdgeLength", this->MinimumEdgeLength, "TargetEdgeLength / 10") };
  for (const Outcome& checked : lengths)
  {
    if (!checked)
    {
      return checked;
    }
  }
  if (!(this->Grading > 0.0) || !std::isfinite(this->Grading))
  {
    return Outcome::Failed(
      "Grading is " + std::to_string(this->Grading) + ": give a positive number, such as 0.3.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::ReadArrays(vtkInformationVector** inputs, Job& job)
{
  if (Outcome read = this->ReadLengths(inputs, job.LengthOfPoint); !read)
  {
    return read;
  }
  return this->ReadRegions(inputs, job.RegionOfCell);
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::ReadRegions(vtkInformationVector** inputs, std::vector<int>& regions)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  int association = vtkDataObject::FIELD_ASSOCIATION_CELLS;
  vtkAbstractArray* array = this->GetInputAbstractArrayToProcess(0, inputs, association);
  const char* chosen = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
  const std::string name = chosen && *chosen ? chosen : DefaultRegionArray;
  if (!array && name == DefaultRegionArray)
  {
    // ParaView's empty name comes with the association of points.
    association = vtkDataObject::FIELD_ASSOCIATION_CELLS;
    array = input->GetCellData()->GetAbstractArray(DefaultRegionArray);
    if (!array)
    {
      regions.assign(input->GetNumberOfCells(), 0);
      return Outcome::Done();
    }
  }
  if (!array || association != vtkDataObject::FIELD_ASSOCIATION_CELLS)
  {
    return Outcome::Failed("There is no cell array \"" + name +
      "\" to take the regions from: name a cell array of the input, or \"" + DefaultRegionArray +
      "\", which may be missing." + InputArrays::Suggest(input->GetCellData(), name));
  }
  if (auto numbers = vtkDataArray::SafeDownCast(array))
  {
    return NumberTuples(numbers, regions);
  }
  regions = NumberTexts(array);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::ReadLengths(vtkInformationVector** inputs, std::vector<double>& lengths)
{
  if (this->SizeField != SIZE_FIELD_ARRAY)
  {
    return Outcome::Done();
  }
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkDataArray* array =
    vtkDataArray::SafeDownCast(this->GetInputAbstractArrayToProcess(1, inputs, association));
  const char* chosen = this->GetInputArrayInformation(1)->Get(vtkDataObject::FIELD_NAME());
  const std::string name = chosen && *chosen ? chosen : DefaultLengthArray;
  if (!chosen || !*chosen)
  {
    association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
    array = vtkPolyData::GetData(inputs[0])->GetPointData()->GetArray(DefaultLengthArray);
  }
  if (!array || association != vtkDataObject::FIELD_ASSOCIATION_POINTS)
  {
    return Outcome::Failed("There is no numeric point array \"" + name +
      "\" to take edge lengths from: name one, or set SizeField to Uniform or Curvature." +
      InputArrays::Suggest(vtkPolyData::GetData(inputs[0])->GetPointData(), name));
  }
  return WantedLengths::Read(array, lengths);
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::ReadSurface(Job& job) const
{
  if (Outcome read = job.Soup.Read(job.Input); !read)
  {
    return read;
  }
  if (!job.Watcher.Report(0.02))
  {
    return Outcome::Aborted();
  }
  const SurfaceRepair::Settings settings = { this->Repair, this->FillHoles, this->HoleSize,
    static_cast<SurfaceRepair::Intersections>(this->SelfIntersections) };
  return SurfaceRepair::Run(settings, job.Watcher.GetStage(0.02, 0.1), job.Soup, job.Counts);
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::Remesh(Job& job) const
{
  PatchTarget target;
  if (Outcome chosen = this->ChooseTarget(job, target); !chosen)
  {
    return chosen;
  }
  if (!job.Remesher.Build(job.Soup, GetRegionsOfTriangles(job.RegionOfCell, job.Soup),
        this->FeatureAngle))
  {
    return Outcome::Failed("The surface is not a manifold, even after the repair: split it first.");
  }
  return RemeshToTarget::Run(job.Remesher, job.Soup, target, job.Watcher.GetStage(0.1, 0.85),
    job.Length);
}

//------------------------------------------------------------------------------
// Fill in the defaults that depend on the surface.
Outcome vtkPatchMesher::ChooseTarget(const Job& job, PatchTarget& target) const
{
  if (job.Soup.Triangles.empty())
  {
    return Outcome::Failed(
      "The surface has no area: all its polygons are degenerate or ghost cells.");
  }
  const double partsOfDiagonal = 50.0;
  const double length = this->TargetEdgeLength > 0.0 ? this->TargetEdgeLength
                                                     : job.Soup.GetDiagonal() / partsOfDiagonal;
  const double shortest = this->MinimumEdgeLength > 0.0 ? this->MinimumEdgeLength : 0.1 * length;
  const double error = this->ApproximationError > 0.0 ? this->ApproximationError : 0.01 * length;
  if (shortest > length)
  {
    return Outcome::Failed("MinimumEdgeLength " + std::to_string(shortest) +
      " is larger than TargetEdgeLength " + std::to_string(length) + ": give a smaller one.");
  }
  target = { static_cast<PatchTarget::LengthSource>(this->SizeField), length, shortest, error,
    this->Grading, this->CoarsePlanarRegions, this->TargetNumberOfPatches, this->NumberOfIterations,
    job.LengthOfPoint };
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::Write(const Job& job)
{
  if (!job.Watcher.Report(0.85))
  {
    return Outcome::Aborted();
  }
  const IsotropicRemesher::Result patches = job.Remesher.GetResult();
  const PatchOutput writer(job.Input, job.Soup, patches);
  writer.WriteGeometry(this->FlipNormals, job.Output);
  writer.WriteCellData(job.Output);
  if (!job.Watcher.Report(0.95))
  {
    return Outcome::Aborted();
  }
  writer.WritePointData(job.Output);
  writer.WriteSummary(job.Counts, job.Length, job.Output);
  this->CheckNumberOfPatches(job.Output->GetNumberOfCells());
  job.Watcher.Report(1.0);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void vtkPatchMesher::CheckNumberOfPatches(vtkIdType number)
{
  const double wanted = static_cast<double>(this->TargetNumberOfPatches);
  if (wanted > 0.0 && std::abs(number - wanted) > 0.05 * wanted)
  {
    vtkWarningMacro(<< number << " patches came out instead of " << this->TargetNumberOfPatches
                    << ", for the edges to keep allow no other number: ask for more patches, or "
                       "give a larger FeatureAngle.");
  }
}
