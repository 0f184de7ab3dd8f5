// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPatchMesher.h"

#include "vtkMeshingRun.h"
#include "vtkPatchSources.h"
#include "vtkSurfaceRemesher.h"
#include "vtkTriangleSoup.h"

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
#include <exception>
#include <map>
#include <new>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkPatchMesher);

namespace
{
using vtkMeshingRun::Aborted;
using vtkMeshingRun::InputError;
using vtkMeshingRun::Report;

const char* const DEFAULT_REGION_ARRAY = "Region";
constexpr double MAXIMUM_NUMBER_OF_TRIANGLES = 2e7;

//------------------------------------------------------------------------------
bool IsOneOfSeveralPieces(vtkInformation* output)
{
  vtkInformationIntegerKey* pieces = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES();
  return output->Has(pieces) && output->Get(pieces) > 1;
}

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
void Repair(vtkTriangleSoup& soup)
{
  soup.DropDegenerateTriangles();
  soup.DropDuplicateTriangles();
  soup.Orient();
}

//------------------------------------------------------------------------------
void CheckDefects(const vtkTriangleSoup& soup)
{
  const std::string defects = soup.DescribeDefects();
  if (!defects.empty())
  {
    throw InputError("The surface has " + defects + ": switch Repair on or repair it first.");
  }
}

//------------------------------------------------------------------------------
double ChooseEdgeLength(double wanted, const vtkTriangleSoup& soup)
{
  if (soup.Triangles.empty())
  {
    throw InputError("The surface has no area: all its polygons are degenerate or ghost cells.");
  }
  const double partsOfDiagonal = 50.0;
  return wanted > 0.0 ? wanted : soup.GetDiagonal() / partsOfDiagonal;
}

//------------------------------------------------------------------------------
void CheckEdgeLength(double length, double numberOfTriangles)
{
  // Written so that a length too small for the estimate, infinite then, is refused too.
  if (!(numberOfTriangles <= MAXIMUM_NUMBER_OF_TRIANGLES))
  {
    std::ostringstream text;
    text << "TargetEdgeLength " << length << " would give about " << numberOfTriangles
         << " triangles, more than " << MAXIMUM_NUMBER_OF_TRIANGLES
         << " are refused: give a larger length.";
    throw InputError(text.str());
  }
}

//------------------------------------------------------------------------------
void WriteGeometry(const vtkSurfaceRemesher::Result& patches, bool flip, vtkPolyData* output)
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
  for (const vtkTriangleSoup::Triangle& triangle : patches.Triangles)
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
void WriteCellData(const vtkSurfaceRemesher::Result& patches, const vtkTriangleSoup& soup,
  vtkPatchSources& sources, double reach, vtkCellData* from, vtkCellData* to)
{
  const vtkIdType size = static_cast<vtkIdType>(patches.Triangles.size());
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("OriginalCellIds");
  ids->SetNumberOfTuples(size);
  to->CopyAllOn();
  to->CopyAllocate(from, size);
  for (vtkIdType i = 0; i < size; ++i)
  {
    vtkTriangleSoup::Point center{ 0.0, 0.0, 0.0 };
    for (const std::size_t corner : patches.Triangles[i])
    {
      for (int j = 0; j < 3; ++j)
      {
        center[j] += patches.Points[corner][j] / 3.0;
      }
    }
    const vtkIdType cell = soup.CellIds[sources.Find(patches.Parts[i], center, reach).Triangle];
    to->CopyData(from, cell, i);
    ids->SetValue(i, cell);
  }
  // Several patches come from one cell, so its id is no longer global; and no patch is a ghost.
  to->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  to->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  to->AddArray(ids);
}

//------------------------------------------------------------------------------
void WritePointData(const vtkSurfaceRemesher::Result& patches, const vtkTriangleSoup& soup,
  vtkPatchSources& sources, double reach, vtkPointData* from, vtkPointData* to)
{
  if (from->GetNumberOfArrays() == 0)
  {
    return;
  }
  const std::size_t unknown = patches.Triangles.size();
  std::vector<std::size_t> triangleOfPoint(patches.Points.size(), unknown);
  for (std::size_t i = 0; i < patches.Triangles.size(); ++i)
  {
    for (const std::size_t corner : patches.Triangles[i])
    {
      triangleOfPoint[corner] = std::min(triangleOfPoint[corner], i);
    }
  }

  to->CopyNormalsOff();
  to->CopyTangentsOff();
  to->CopyTCoordsOff();
  to->InterpolateAllocate(from, static_cast<vtkIdType>(patches.Points.size()));
  vtkNew<vtkIdList> ids;
  ids->SetNumberOfIds(3);
  for (std::size_t i = 0; i < patches.Points.size(); ++i)
  {
    vtkPatchSources::Place place =
      sources.Find(patches.Parts[triangleOfPoint[i]], patches.Points[i], reach);
    for (int j = 0; j < 3; ++j)
    {
      ids->SetId(j, soup.PointIds[soup.Triangles[place.Triangle][j]]);
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
void WriteSummary(const vtkTriangleSoup& soup, vtkIdType patches, double length, vtkFieldData* to)
{
  AddSummary<vtkIdTypeArray>(to, "NumberOfPatches", patches);
  AddSummary<vtkIdTypeArray>(to, "NumberOfDroppedTriangles", soup.NumberOfDroppedTriangles);
  AddSummary<vtkIdTypeArray>(to, "NumberOfReversedTriangles", soup.NumberOfReversedTriangles);
  AddSummary<vtkIdTypeArray>(to, "NumberOfSplitPoints", soup.NumberOfSplitPoints);
  AddSummary<vtkDoubleArray>(to, "TargetEdgeLength", length);
}
} // namespace

//------------------------------------------------------------------------------
vtkPatchMesher::vtkPatchMesher()
{
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS,
    DEFAULT_REGION_ARRAY);
}

//------------------------------------------------------------------------------
vtkPatchMesher::~vtkPatchMesher() = default;

//------------------------------------------------------------------------------
void vtkPatchMesher::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TargetEdgeLength: " << this->TargetEdgeLength << "\n";
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "Repair: " << (this->Repair ? "on" : "off") << "\n";
  os << indent << "FlipNormals: " << (this->FlipNormals ? "on" : "off") << "\n";
}

//------------------------------------------------------------------------------
int vtkPatchMesher::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  if (input->GetNumberOfCells() == 0 && IsOneOfSeveralPieces(outputs->GetInformationObject(0)))
  {
    return 1;
  }
  std::string error;
  try
  {
    this->Mesh(input, this->ReadRegions(inputs), output);
    return 1;
  }
  catch (const Aborted&)
  {
    output->Initialize();
    return 1;
  }
  catch (const InputError& problem)
  {
    error = problem.what();
  }
  catch (const std::bad_alloc&)
  {
    error = "Not enough memory: give a larger TargetEdgeLength.";
  }
  catch (const std::exception& problem)
  {
    error = "CGAL could not remesh the surface (" + std::string(problem.what()) +
      "): try another TargetEdgeLength, or repair the surface first.";
  }
  output->Initialize();
  vtkErrorMacro(<< error);
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
void vtkPatchMesher::Mesh(vtkPolyData* input, const std::vector<int>& regionOfCell,
  vtkPolyData* output)
{
  if (!(this->TargetEdgeLength >= 0.0) || !std::isfinite(this->TargetEdgeLength))
  {
    throw InputError("TargetEdgeLength is " + std::to_string(this->TargetEdgeLength) +
      ": give a positive length, or 0 for the diagonal of the bounding box / 50.");
  }

  vtkTriangleSoup soup;
  soup.Read(input);
  Report(this, 0.05);
  if (this->Repair)
  {
    ::Repair(soup);
  }
  else
  {
    CheckDefects(soup);
  }
  Report(this, 0.1);

  const double length = ChooseEdgeLength(this->TargetEdgeLength, soup);
  std::vector<int> regions;
  for (const vtkIdType cell : soup.CellIds)
  {
    regions.push_back(regionOfCell[cell]);
  }
  vtkSurfaceRemesher remesher;
  if (!remesher.Build(soup, regions, this->FeatureAngle))
  {
    throw InputError("The surface is not a manifold, even after the repair: split it first.");
  }
  CheckEdgeLength(length, remesher.EstimateNumberOfTriangles(length));
  remesher.SplitKeptEdges(length);
  Report(this, 0.15);
  const auto monitor = [this](double fraction)
  {
    this->UpdateProgress(0.15 + 0.65 * fraction);
    return !vtkAbortCheck::IsAborted(this);
  };
  if (!remesher.Remesh(length, this->NumberOfIterations, monitor))
  {
    throw Aborted();
  }
  Report(this, 0.8);

  const vtkSurfaceRemesher::Result patches = remesher.GetResult();
  vtkPatchSources sources(soup, remesher.GetPartsOfSoup(), remesher.GetNumberOfParts());
  // New points lie on the old surface, centroids nearly so.
  const double reach = 0.1 * length;
  WriteGeometry(patches, this->FlipNormals, output);
  WriteCellData(patches, soup, sources, reach, input->GetCellData(), output->GetCellData());
  Report(this, 0.9);
  WritePointData(patches, soup, sources, reach, input->GetPointData(), output->GetPointData());
  WriteSummary(soup, output->GetNumberOfCells(), length, output->GetFieldData());
  this->UpdateProgress(1.0);
}
