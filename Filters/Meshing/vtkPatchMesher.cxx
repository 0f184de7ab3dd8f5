// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPatchMesher.h"

#include "Common/MeshingRun.h"
#include "Common/TriangleSoup.h"
#include "Common/Watch.h"
#include "Mesher/IsotropicRemesher.h"
#include "Mesher/PatchOutput.h"
#include "Mesher/RemeshToTarget.h"
#include "Mesher/SurfaceRepair.h"
#include "Mesher/WantedLengths.h"
#include "Shared/FilterMonitor.h"
#include "Shared/InputArrays.h"
#include "Shared/NumberProperties.h"
#include "Shared/OutputLikeInput.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
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
// Put the triangles of one soup behind those of another, apart from them, with ids that count on.
void Append(const TriangleSoup& from, vtkIdType firstPoint, vtkIdType firstCell, TriangleSoup& to)
{
  const std::size_t offset = to.Points.size();
  to.Points.insert(to.Points.end(), from.Points.begin(), from.Points.end());
  for (const vtkIdType id : from.PointIds)
  {
    to.PointIds.push_back(firstPoint + id);
  }
  for (const TriangleSoup::Triangle& t : from.Triangles)
  {
    to.Triangles.push_back({ offset + t[0], offset + t[1], offset + t[2] });
  }
  for (const vtkIdType id : from.CellIds)
  {
    to.CellIds.push_back(firstCell + id);
  }
}
} // namespace

//------------------------------------------------------------------------------
// A surface of the input, and what becomes of it.
struct vtkPatchMesher::Block
{
  vtkPolyData* Input;
  vtkPolyData* Output;
  /// What comes before messages: empty unless the input is composite.
  std::string Name;
  std::vector<int> RegionOfCell;
  std::vector<double> LengthOfPoint;
  TriangleSoup Soup;
  RepairCounts Counts;
};

//------------------------------------------------------------------------------
// What one run of the filter hands from step to step.
struct vtkPatchMesher::Job
{
  vtkDataObject* Output;
  Monitor Watcher;
  /// Those with polygons.
  std::vector<Block> Blocks;
  /// The triangles of all blocks, block by block.
  TriangleSoup Soup;
  std::vector<int> Regions;
  std::vector<double> LengthOfPoint;
  RemeshToTarget::Result Result;

  TriangleSoup Gather() const
  {
    TriangleSoup all;
    vtkIdType firstPoint = 0;
    vtkIdType firstCell = 0;
    for (const Block& block : this->Blocks)
    {
      Append(block.Soup, firstPoint, firstCell, all);
      firstPoint += block.Input->GetNumberOfPoints();
      firstCell += block.Input->GetNumberOfCells();
    }
    return all;
  }
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
  os << indent << "WeldTolerance: " << this->WeldTolerance << "\n";
  os << indent << "SelfIntersections: " << this->SelfIntersections << "\n";
  os << indent << "FlipNormals: " << (this->FlipNormals ? "on" : "off") << "\n";
}

//------------------------------------------------------------------------------
int vtkPatchMesher::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkPatchMesher::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkPatchMesher::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  if (!request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->Superclass::ProcessRequest(request, inputs, outputs);
  }
  return OutputLikeInput::Make(inputs, outputs) ? 1 : 0;
}

//------------------------------------------------------------------------------
int vtkPatchMesher::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  Job job;
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  job.Output = vtkDataObject::GetData(outputs, 0);
  job.Watcher = MakeFilterMonitor(this);
  if (MeshingRun::IsEmptyPiece(input, outputs->GetInformationObject(0)))
  {
    return 1;
  }
  const MeshingRun::Advice advice = { "give larger edge lengths",
    "CGAL could not remesh the surface",
    "try another TargetEdgeLength, or repair the surface first" };
  MeshingRun::Steps steps(advice);
  steps.Take([&]() { return this->CheckProperties(); });
  steps.Take([&]() { return this->FindBlocks(input, job); });
  steps.Take([&]() { return this->ReadBlocks(job); });
  steps.Take([&]() { return this->MakePatches(job); });
  steps.Take([&]() { return this->Write(job); });
  RepairCounts counts;
  for (const Block& block : job.Blocks)
  {
    counts.Add(block.Counts);
  }
  if (const std::string repairs = counts.Describe(); !repairs.empty())
  {
    vtkWarningMacro(<< repairs);
  }
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
    CheckLength("WeldTolerance", this->WeldTolerance, "what the coordinates are worth"),
    CheckLength("ApproximationError", this->ApproximationError, "TargetEdgeLength / 100"),
    CheckLength("MinimumEdgeLength", this->MinimumEdgeLength, "TargetEdgeLength / 10") };
  for (const Outcome& checked : lengths)
  {
    if (!checked)
    {
      return checked;
    }
  }
  if (Outcome angle = NumberProperties::Check({ { "FeatureAngle", this->FeatureAngle } }); !angle)
  {
    return angle;
  }
  if (!(this->Grading > 0.0) || !std::isfinite(this->Grading))
  {
    return Outcome::Failed(
      "Grading is " + std::to_string(this->Grading) + ": give a positive number, such as 0.3.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// The surfaces of the input, and an output for each in the same place.
Outcome vtkPatchMesher::FindBlocks(vtkDataObject* input, Job& job)
{
  if (auto* surface = vtkPolyData::SafeDownCast(input))
  {
    job.Blocks.emplace_back();
    job.Blocks.back().Input = surface;
    job.Blocks.back().Output = vtkPolyData::SafeDownCast(job.Output);
    return Outcome::Done();
  }
  auto* from = vtkCompositeDataSet::SafeDownCast(input);
  auto* to = vtkCompositeDataSet::SafeDownCast(job.Output);
  to->CopyStructure(from);
  to->GetFieldData()->ShallowCopy(from->GetFieldData());
  vtkIdType withoutPolygons = 0;
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(from->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    auto* surface = vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject());
    const std::string name = "Block " + std::to_string(leaf->GetCurrentFlatIndex());
    if (!surface)
    {
      return Outcome::Failed(name + " is a " + leaf->GetCurrentDataObject()->GetClassName() +
        ": give surfaces made of polygons (vtkPolyData), extract them first.");
    }
    vtkNew<vtkPolyData> output;
    to->SetDataSet(leaf, output);
    if (surface->GetNumberOfPolys() + surface->GetNumberOfStrips() > 0)
    {
      job.Blocks.emplace_back();
      job.Blocks.back().Input = surface;
      job.Blocks.back().Output = output;
      job.Blocks.back().Name = name + ": ";
    }
    else
    {
      withoutPolygons += surface->GetNumberOfCells() > 0;
    }
  }
  if (job.Blocks.empty())
  {
    return Outcome::Failed("The input has no polygons: give surfaces made of polygons.");
  }
  if (withoutPolygons > 0)
  {
    vtkWarningMacro(<< withoutPolygons
                    << " blocks have vertices or lines, but no polygons: they come out empty.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::ReadBlocks(Job& job)
{
  const Monitor monitor = job.Watcher.GetStage(0.0, 0.02);
  for (Block& block : job.Blocks)
  {
    if (Outcome read = this->ReadBlock(block, monitor); !read)
    {
      return read.HasFailed() ? Outcome::Failed(block.Name + read.GetMessage()) : read;
    }
  }
  return job.Watcher.Check(0.02);
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::ReadBlock(Block& block, const Monitor& monitor)
{
  vtkPolyData* input = block.Input;
  // The input's field data, also of what has no patches.
  block.Output->GetFieldData()->PassData(input->GetFieldData());
  if (Outcome lengths = this->ReadLengths(input, block.LengthOfPoint); !lengths)
  {
    return lengths;
  }
  if (Outcome regions = this->ReadRegions(input, block.RegionOfCell); !regions)
  {
    return regions;
  }
  // The repair joins what belongs together; without it points with equal coordinates are one.
  return block.Soup.Read(input, !this->Repair, monitor);
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::ReadRegions(vtkPolyData* input, std::vector<int>& regions)
{
  int association = vtkDataObject::FIELD_ASSOCIATION_CELLS;
  vtkAbstractArray* array = this->GetInputAbstractArrayToProcess(0, input, association);
  const std::string name = InputArrays::GetChosenName(this, 0, DefaultRegionArray);
  if (name == DefaultRegionArray)
  {
    // ParaView's default may come with the association of points.
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
Outcome vtkPatchMesher::ReadLengths(vtkPolyData* input, std::vector<double>& lengths)
{
  if (this->SizeField != SIZE_FIELD_ARRAY)
  {
    return Outcome::Done();
  }
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkDataArray* array =
    vtkDataArray::SafeDownCast(this->GetInputAbstractArrayToProcess(1, input, association));
  const std::string name = InputArrays::GetChosenName(this, 1, DefaultLengthArray);
  if (name == DefaultLengthArray)
  {
    association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
    array = input->GetPointData()->GetArray(DefaultLengthArray);
  }
  if (!array || association != vtkDataObject::FIELD_ASSOCIATION_POINTS)
  {
    return Outcome::Failed("There is no numeric point array \"" + name +
      "\" to take edge lengths from: name one, or set SizeField to Uniform or Curvature." +
      InputArrays::Suggest(input->GetPointData(), name));
  }
  return WantedLengths::Read(array, lengths);
}

//------------------------------------------------------------------------------
// Without gaps in the progress, however long a call of CGAL takes.
Outcome vtkPatchMesher::MakePatches(Job& job) const
{
  return Watch::Run(job.Watcher,
    [&](Watch& watch)
    {
      const Monitor monitor = watch.MakeMonitor();
      Outcome repaired = this->RepairBlocks(job, monitor.GetStage(0.02, 0.1));
      return repaired ? this->Remesh(job, monitor.GetStage(0.1, 0.85)) : repaired;
    });
}

//------------------------------------------------------------------------------
// Each surface by itself: what is in different blocks does not hang together.
Outcome vtkPatchMesher::RepairBlocks(Job& job, const Monitor& monitor) const
{
  SurfaceRepair::Settings settings = { this->Repair, this->FillHoles, this->HoleSize,
    this->WeldTolerance, static_cast<SurfaceRepair::Intersections>(this->SelfIntersections) };
  if (job.Blocks.size() > 1)
  {
    settings.HoleSize = SurfaceRepair::ChooseHoleSize(settings.HoleSize, job.Gather());
  }
  for (std::size_t i = 0; i < job.Blocks.size(); ++i)
  {
    Block& block = job.Blocks[i];
    const double size = static_cast<double>(job.Blocks.size());
    const Monitor stage = monitor.GetStage(i / size, (i + 1) / size);
    if (Outcome repaired = SurfaceRepair::Run(settings, stage, block.Soup, block.Counts); !repaired)
    {
      return repaired.HasFailed() ? Outcome::Failed(block.Name + repaired.GetMessage()) : repaired;
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::Remesh(Job& job, const Monitor& monitor) const
{
  job.Soup = job.Gather();
  for (const Block& block : job.Blocks)
  {
    job.LengthOfPoint.insert(job.LengthOfPoint.end(), block.LengthOfPoint.begin(),
      block.LengthOfPoint.end());
    for (const vtkIdType cell : block.Soup.CellIds)
    {
      job.Regions.push_back(block.RegionOfCell[cell]);
    }
  }
  PatchTarget target;
  if (Outcome chosen = this->ChooseTarget(job, target); !chosen)
  {
    return chosen;
  }
  IsotropicRemesher remesher;
  if (!remesher.Build(job.Soup, job.Regions, this->FeatureAngle))
  {
    return Outcome::Failed("The surface is not a manifold, even after the repair: split it first.");
  }
  return RemeshToTarget::Run(remesher, job.Soup, target, monitor, job.Result);
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
  const bool isDefault = this->TargetEdgeLength == 0.0;
  const double length = isDefault ? job.Soup.GetDiagonal() / PatchTarget::DefaultPartsOfDiagonal
                                  : this->TargetEdgeLength;
  const double shortest = this->MinimumEdgeLength > 0.0 ? this->MinimumEdgeLength : 0.1 * length;
  const double error = this->ApproximationError > 0.0 ? this->ApproximationError : 0.01 * length;
  if (shortest > length)
  {
    return Outcome::Failed("MinimumEdgeLength " + std::to_string(shortest) +
      " is larger than TargetEdgeLength " + std::to_string(length) + ": give a smaller one.");
  }
  target = { static_cast<PatchTarget::LengthSource>(this->SizeField), length, isDefault, shortest,
    error, this->Grading, this->CoarsePlanarRegions, this->TargetNumberOfPatches,
    this->NumberOfIterations, this->SelfIntersections == SELF_INTERSECTIONS_KEEP,
    job.LengthOfPoint };
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkPatchMesher::Write(Job& job)
{
  const Monitor monitor = job.Watcher.GetStage(0.85, 1.0);
  std::size_t firstTriangle = 0;
  PatchSummary total;
  for (const Block& block : job.Blocks)
  {
    const std::size_t lastTriangle = firstTriangle + block.Soup.Triangles.size();
    const PatchPart part(job.Result, firstTriangle, lastTriangle);
    const PatchOutput writer(block.Input, block.Soup, part.Patches, monitor);
    writer.WriteGeometry(this->FlipNormals, block.Output);
    writer.WriteCellData(block.Output);
    writer.WritePointData(block.Output);
    const PatchSummary summary = { block.Output->GetNumberOfCells(), block.Counts,
      part.NumberOfCrossingsWithin, part.NumberOfCrossingsBetween, job.Result.Length };
    summary.Write(block.Output->GetFieldData());
    total.Add(summary);
    firstTriangle = lastTriangle;
  }
  total.NumberOfCrossingsBetween = static_cast<vtkIdType>(job.Result.CrossingsBetween.size());
  total.Write(job.Output->GetFieldData());
  for (const std::string& warning : job.Result.Warnings)
  {
    vtkWarningMacro(<< warning);
  }
  this->CheckNumberOfPatches(total.NumberOfPatches);
  return monitor.Check(1.0);
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
