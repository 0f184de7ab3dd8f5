// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPatchMesher.h"

#include "Common/MeshingRun.h"
#include "Mesher/SizedRemeshing.h"
#include "Mesher/SurfaceRemesher.h"
#include "Mesher/SurfaceRepair.h"
#include "Mesher/TriangleSoup.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkPatchMesher);

namespace
{
using MeshingRun::Advice;
using MeshingRun::InputError;
using MeshingRun::Outcome;
using MeshingRun::Report;
using MeshingRun::Try;

const char* const DEFAULT_REGION_ARRAY = "Region";
const char* const DEFAULT_LENGTH_ARRAY = "EdgeLength";

//------------------------------------------------------------------------------
// Number the different tuples of an array: one number per input cell.
std::vector<int> NumberTuples(vtkAbstractArray* array)
{
  const vtkIdType size = array->GetNumberOfTuples();
  const int components = array->GetNumberOfComponents();
  std::vector<int> numbers(size);
  if (auto numeric = vtkDataArray::SafeDownCast(array))
  {
    std::map<std::vector<double>, int> known;
    std::vector<double> tuple(components);
    for (vtkIdType i = 0; i < size; ++i)
    {
      numeric->GetTuple(i, tuple.data());
      if (std::any_of(tuple.begin(), tuple.end(), [](double value) { return std::isnan(value); }))
      {
        throw InputError("The region array \"" + std::string(array->GetName()) +
          "\" has NaN values: give every cell a region.");
      }
      numbers[i] = known.emplace(tuple, static_cast<int>(known.size())).first->second;
    }
    return numbers;
  }
  std::map<std::vector<std::string>, int> known;
  std::vector<std::string> tuple(components);
  for (vtkIdType i = 0; i < size; ++i)
  {
    for (int j = 0; j < components; ++j)
    {
      tuple[j] = array->GetVariantValue(i * components + j).ToString();
    }
    numbers[i] = known.emplace(tuple, static_cast<int>(known.size())).first->second;
  }
  return numbers;
}

//------------------------------------------------------------------------------
// Lengths with a default that depends on the input.
void CheckLength(const char* name, double length, const char* remedy)
{
  if (!(length >= 0.0) || !std::isfinite(length))
  {
    throw InputError(std::string(name) + " is " + std::to_string(length) +
      ": give a positive length, or 0 for " + remedy + ".");
  }
}

//------------------------------------------------------------------------------
double ChooseHoleSize(double wanted, const TriangleSoup& soup)
{
  const double partsOfDiagonal = 100.0;
  return wanted > 0.0 ? wanted : soup.GetDiagonal() / partsOfDiagonal;
}

//------------------------------------------------------------------------------
std::string Describe(const SurfaceRepair::Intersections& found,
  const SurfaceRepair::Intersections& left)
{
  std::ostringstream text;
  text << "The surface intersects itself: " << found.NumberWithin
       << " pairs of triangles of one connected component do";
  if (left.NumberWithin < found.NumberWithin)
  {
    text << ", and " << left.NumberWithin << " of them could not be resolved";
  }
  text << ", the first near (" << left.Place[0] << ", " << left.Place[1] << ", " << left.Place[2]
       << "), of the input's cells " << left.CellIds[0] << " and " << left.CellIds[1] << ". ";
  return text.str();
}

//------------------------------------------------------------------------------
void CheckDefects(const TriangleSoup& soup)
{
  const std::string defects = soup.DescribeDefects();
  if (!defects.empty())
  {
    throw InputError("The surface has " + defects + ": switch Repair on or repair it first.");
  }
}

//------------------------------------------------------------------------------
double ChooseEdgeLength(double wanted, const TriangleSoup& soup)
{
  if (soup.Triangles.empty())
  {
    throw InputError("The surface has no area: all its polygons are degenerate or ghost cells.");
  }
  const double partsOfDiagonal = 50.0;
  return wanted > 0.0 ? wanted : soup.GetDiagonal() / partsOfDiagonal;
}

//------------------------------------------------------------------------------
void WriteGeometry(const SurfaceRemesher::Result& patches, bool flip, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(patches.Points.size()));
  for (std::size_t i = 0; i < patches.Points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), patches.Points[i].data());
  }
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(static_cast<vtkIdType>(patches.Triangles.size()),
    static_cast<vtkIdType>(3 * patches.Triangles.size()));
  for (const TriangleSoup::Triangle& triangle : patches.Triangles)
  {
    const vtkIdType ids[3] = { static_cast<vtkIdType>(triangle[0]),
      static_cast<vtkIdType>(triangle[flip ? 2 : 1]),
      static_cast<vtkIdType>(triangle[flip ? 1 : 2]) };
    cells->InsertNextCell(3, ids);
  }
  output->SetPoints(points);
  output->SetPolys(cells);
}

//------------------------------------------------------------------------------
void WriteCellData(const SurfaceRemesher::Result& patches, const TriangleSoup& soup,
  vtkCellData* from, vtkCellData* to)
{
  const vtkIdType size = static_cast<vtkIdType>(patches.Triangles.size());
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("OriginalCellIds");
  ids->SetNumberOfTuples(size);
  to->CopyAllOn();
  to->CopyAllocate(from, size);
  for (vtkIdType i = 0; i < size; ++i)
  {
    const vtkIdType cell = soup.CellIds[patches.SourcesOfTriangles[i]];
    to->CopyData(from, cell, i);
    ids->SetValue(i, cell);
  }
  // Several patches come from one cell, so its id is no longer global; and no patch is a ghost.
  to->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  to->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  to->AddArray(ids);
}

//------------------------------------------------------------------------------
void WritePointData(const SurfaceRemesher::Result& patches, const TriangleSoup& soup,
  vtkPointData* from, vtkPointData* to)
{
  if (from->GetNumberOfArrays() == 0)
  {
    return;
  }
  to->CopyNormalsOff();
  to->CopyTangentsOff();
  to->CopyTCoordsOff();
  to->InterpolateAllocate(from, static_cast<vtkIdType>(patches.Points.size()));
  vtkNew<vtkIdList> ids;
  ids->SetNumberOfIds(3);
  for (std::size_t i = 0; i < patches.Points.size(); ++i)
  {
    const TriangleSoup::Triangle& source = soup.Triangles[patches.SourcesOfPoints[i]];
    SourceSurface::Place place = SourceSurface::GetClosest(soup.Points[source[0]],
      soup.Points[source[1]], soup.Points[source[2]], patches.Points[i]);
    for (int j = 0; j < 3; ++j)
    {
      ids->SetId(j, soup.PointIds[source[j]]);
    }
    to->InterpolatePoint(from, static_cast<vtkIdType>(i), ids, place.Weights.data());
  }
  to->RemoveArray(vtkDataSetAttributes::GhostArrayName());
}

//------------------------------------------------------------------------------
template <typename Array, typename Value>
void AddSummary(vtkFieldData* fields, const char* name, Value value)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fields->AddArray(array);
}

//------------------------------------------------------------------------------
void WriteSummary(const TriangleSoup& soup, vtkIdType patches, double length, vtkFieldData* to)
{
  AddSummary<vtkIdTypeArray>(to, "NumberOfPatches", patches);
  AddSummary<vtkIdTypeArray>(to, "NumberOfDroppedTriangles", soup.NumberOfDroppedTriangles);
  AddSummary<vtkIdTypeArray>(to, "NumberOfReversedTriangles", soup.NumberOfReversedTriangles);
  AddSummary<vtkIdTypeArray>(to, "NumberOfSplitPoints", soup.NumberOfSplitPoints);
  AddSummary<vtkIdTypeArray>(to, "NumberOfFilledHoles", soup.NumberOfFilledHoles);
  AddSummary<vtkIdTypeArray>(to, "NumberOfSelfIntersections", soup.NumberOfSelfIntersections);
  AddSummary<vtkIdTypeArray>(to, "NumberOfIntersectionsBetweenComponents",
    soup.NumberOfIntersectionsBetweenComponents);
  AddSummary<vtkDoubleArray>(to, "TargetEdgeLength", length);
}
} // namespace

//------------------------------------------------------------------------------
vtkPatchMesher::vtkPatchMesher()
{
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS,
    DEFAULT_REGION_ARRAY);
  this->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS,
    DEFAULT_LENGTH_ARRAY);
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
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  if (MeshingRun::IsEmptyPiece(input, outputs->GetInformationObject(0)))
  {
    return 1;
  }
  const Advice advice = { "give larger edge lengths", "CGAL could not remesh the surface",
    "try another TargetEdgeLength, or repair the surface first" };
  const Outcome outcome = Try(advice,
    [&]()
    {
      this->CheckProperties();
      this->Mesh(input, this->ReadRegions(inputs), this->ReadLengths(inputs), output);
    });
  if (!outcome.Done)
  {
    output->Initialize();
  }
  if (outcome.Error.empty())
  {
    return 1;
  }
  vtkErrorMacro(<< outcome.Error);
  return 0;
}

//------------------------------------------------------------------------------
std::vector<int> vtkPatchMesher::ReadRegions(vtkInformationVector** inputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  int association = vtkDataObject::FIELD_ASSOCIATION_CELLS;
  vtkAbstractArray* array = this->GetInputAbstractArrayToProcess(0, inputs, association);
  const char* chosen = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
  const std::string name = chosen && *chosen ? chosen : DEFAULT_REGION_ARRAY;
  if (!array && name == DEFAULT_REGION_ARRAY)
  {
    // ParaView's empty name comes with the association of points.
    association = vtkDataObject::FIELD_ASSOCIATION_CELLS;
    array = input->GetCellData()->GetAbstractArray(DEFAULT_REGION_ARRAY);
    if (!array)
    {
      return std::vector<int>(input->GetNumberOfCells(), 0);
    }
  }
  if (!array || association != vtkDataObject::FIELD_ASSOCIATION_CELLS)
  {
    throw InputError("There is no cell array \"" + name +
      "\" to take the regions from: name a cell array of the input, or \"" + DEFAULT_REGION_ARRAY +
      "\", which may be missing.");
  }
  return NumberTuples(array);
}

//------------------------------------------------------------------------------
void vtkPatchMesher::RepairSurface(TriangleSoup& soup)
{
  soup.DropDegenerateTriangles();
  soup.DropDuplicateTriangles();
  soup.Orient();
  Report(this, 0.04);

  const double size = ChooseHoleSize(this->HoleSize, soup);
  SurfaceRepair surface(soup);
  // Where a crumb is gone, what else met there can be joined.
  vtkIdType changes = surface.JoinBorders();
  const vtkIdType crumbs = surface.DropCrumbs(size);
  changes += crumbs + surface.JoinBorders();
  Report(this, 0.05);
  const vtkIdType holes = this->FillHoles ? surface.FillHoles(size) : 0;
  const vtkIdType dropped = soup.NumberOfDroppedTriangles + crumbs;
  if (changes + holes > 0)
  {
    surface.Write(soup);
    // A crack without width has been filled with triangles without area.
    soup.DropDegenerateTriangles();
  }
  soup.NumberOfDroppedTriangles = dropped;
  soup.NumberOfFilledHoles = holes;
  Report(this, 0.06);
}

//------------------------------------------------------------------------------
void vtkPatchMesher::TreatSelfIntersections(TriangleSoup& soup)
{
  SurfaceRepair surface(soup);
  const SurfaceRepair::Intersections found = surface.FindSelfIntersections();
  soup.NumberOfSelfIntersections = found.NumberWithin;
  soup.NumberOfIntersectionsBetweenComponents = found.NumberBetween;
  Report(this, 0.08);
  if (found.NumberWithin == 0 || this->SelfIntersections == SELF_INTERSECTIONS_KEEP)
  {
    return;
  }
  if (!this->Repair || this->SelfIntersections == SELF_INTERSECTIONS_REFUSE)
  {
    throw InputError(Describe(found, found) +
      "Set SelfIntersections to Resolve (with Repair on) or Keep, or repair the surface first.");
  }
  const auto stop = [this]()
  {
    this->UpdateProgress(0.08);
    return AbortCheck::IsAborted(this);
  };
  const SurfaceRepair::Intersections left =
    surface.ResolveSelfIntersections(ChooseHoleSize(this->HoleSize, soup), stop);
  Report(this, 0.1);
  if (left.NumberWithin > 0)
  {
    throw InputError(Describe(found, left) +
      "Set SelfIntersections to Keep, give a larger HoleSize, or repair the surface first.");
  }
  surface.Write(soup);
}

//------------------------------------------------------------------------------
std::vector<double> vtkPatchMesher::ReadLengths(vtkInformationVector** inputs)
{
  if (this->SizeField != SIZE_FIELD_ARRAY)
  {
    return {};
  }
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkDataArray* array =
    vtkDataArray::SafeDownCast(this->GetInputAbstractArrayToProcess(1, inputs, association));
  const char* chosen = this->GetInputArrayInformation(1)->Get(vtkDataObject::FIELD_NAME());
  const std::string name = chosen && *chosen ? chosen : DEFAULT_LENGTH_ARRAY;
  if (!chosen || !*chosen)
  {
    association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
    array = vtkPolyData::GetData(inputs[0])->GetPointData()->GetArray(DEFAULT_LENGTH_ARRAY);
  }
  if (!array || association != vtkDataObject::FIELD_ASSOCIATION_POINTS)
  {
    throw InputError("There is no numeric point array \"" + name +
      "\" to take edge lengths from: name one, or set SizeField to Uniform or Curvature.");
  }
  return SizedRemeshing::ReadLengths(array);
}

//------------------------------------------------------------------------------
void vtkPatchMesher::CheckProperties()
{
  CheckLength("TargetEdgeLength", this->TargetEdgeLength, "the diagonal of the bounding box / 50");
  CheckLength("HoleSize", this->HoleSize, "the diagonal of the bounding box / 100");
  CheckLength("ApproximationError", this->ApproximationError, "TargetEdgeLength / 100");
  CheckLength("MinimumEdgeLength", this->MinimumEdgeLength, "TargetEdgeLength / 10");
  if (!(this->Grading > 0.0) || !std::isfinite(this->Grading))
  {
    throw InputError(
      "Grading is " + std::to_string(this->Grading) + ": give a positive number, such as 0.3.");
  }
}

//------------------------------------------------------------------------------
SizedRemeshing::Settings vtkPatchMesher::GetSettings(const TriangleSoup& soup,
  const std::vector<double>& lengthOfPoint)
{
  const double length = ChooseEdgeLength(this->TargetEdgeLength, soup);
  const double shortest = this->MinimumEdgeLength > 0.0 ? this->MinimumEdgeLength : 0.1 * length;
  const double error = this->ApproximationError > 0.0 ? this->ApproximationError : 0.01 * length;
  if (shortest > length)
  {
    throw InputError("MinimumEdgeLength " + std::to_string(shortest) +
      " is larger than TargetEdgeLength " + std::to_string(length) + ": give a smaller one.");
  }
  return { this->SizeField, length, shortest, error, this->Grading, this->CoarsePlanarRegions,
    this->TargetNumberOfPatches, this->NumberOfIterations, lengthOfPoint };
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

//------------------------------------------------------------------------------
void vtkPatchMesher::Mesh(vtkPolyData* input, const std::vector<int>& regionOfCell,
  const std::vector<double>& lengthOfPoint, vtkPolyData* output)
{
  TriangleSoup soup;
  soup.Read(input);
  Report(this, 0.02);
  if (this->Repair)
  {
    this->RepairSurface(soup);
  }
  else
  {
    CheckDefects(soup);
  }
  this->TreatSelfIntersections(soup);
  Report(this, 0.1);

  std::vector<int> regions;
  for (const vtkIdType cell : soup.CellIds)
  {
    regions.push_back(regionOfCell[cell]);
  }
  const SizedRemeshing::Settings settings = this->GetSettings(soup, lengthOfPoint);
  SurfaceRemesher remesher;
  if (!remesher.Build(soup, regions, this->FeatureAngle))
  {
    throw InputError("The surface is not a manifold, even after the repair: split it first.");
  }
  const double length = SizedRemeshing::Remesh(remesher, soup, settings,
    [this](double fraction) { Report(this, 0.1 + 0.75 * fraction); });
  Report(this, 0.85);

  const SurfaceRemesher::Result patches = remesher.GetResult();
  WriteGeometry(patches, this->FlipNormals, output);
  WriteCellData(patches, soup, input->GetCellData(), output->GetCellData());
  Report(this, 0.95);
  WritePointData(patches, soup, input->GetPointData(), output->GetPointData());
  WriteSummary(soup, output->GetNumberOfCells(), length, output->GetFieldData());
  this->CheckNumberOfPatches(output->GetNumberOfCells());
  this->UpdateProgress(1.0);
}
