// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneOutput.h"

#include "Scene/Leaves.h"
#include "Scene/PatchScene.h"
#include "Scene/SmoothPoints.h"
#include "Shared/ArrayNames.h"
#include "Shared/OutputMemory.h"
#include "Shared/Pulse.h"
#include "Shared/ZeroedArray.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <map>
#include <numeric>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
void AppendPoints(vtkPolyData* input, const std::vector<vtkIdType>& sources, vtkPolyData* output)
{
  const vtkIdType old = input->GetNumberOfPoints();
  const vtkIdType total = old + static_cast<vtkIdType>(sources.size());
  vtkNew<vtkPoints> points;
  points->SetDataType(input->GetPoints()->GetDataType());
  ZeroedArray::Fill(points->GetData(), total);
  vtkPointData* from = input->GetPointData();
  vtkPointData* to = output->GetPointData();
  to->Initialize();
  to->CopyAllOn();
  OutputMemory::AllocateCopies(from, total, to);
  for (vtkIdType point = 0; point < total; ++point)
  {
    Pulse::Beat(point);
    const vtkIdType source = point < old ? point : sources[point - old];
    points->SetPoint(point, input->GetPoint(source));
    to->CopyData(from, source, point);
  }
  output->SetPoints(points);
}

//------------------------------------------------------------------------------
template <typename Array>
vtkSmartPointer<Array> MakeArray(const std::string& name, vtkIdType tuples, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  ZeroedArray::Fill(array, tuples);
  return array;
}

//------------------------------------------------------------------------------
std::string GetSideName(const std::string& name, int side)
{
  return side == 0 ? name : name + ArrayNames::BackSuffix;
}
} // namespace

//------------------------------------------------------------------------------
SceneOutput::SceneOutput(const PatchScene& scene, const SmoothPoints* points, vtkDataObject* input,
  vtkDataObject* output)
  : Scene(scene), Points(points), Output(output)
{
  const std::vector<vtkDataSet*> leaves = Leaves::Get(input);
  this->Groups.assign(leaves.size(), {});
  std::vector<vtkIdType> firstLocal(leaves.size() + 1, 0);
  for (const LocalCell& local : scene.GetLocalCells())
  {
    ++firstLocal[local.Block + 1];
  }
  std::partial_sum(firstLocal.begin(), firstLocal.end(), firstLocal.begin());

  auto* compositeIn = vtkCompositeDataSet::SafeDownCast(input);
  if (!compositeIn)
  {
    this->CopyBlock(leaves[0], 0, 0, vtkDataSet::SafeDownCast(output));
    return;
  }
  auto* compositeOut = vtkCompositeDataSet::SafeDownCast(output);
  compositeOut->CopyStructure(compositeIn);
  compositeOut->GetFieldData()->ShallowCopy(compositeIn->GetFieldData());
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(compositeIn->NewIterator());
  int block = 0;
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem(), ++block)
  {
    vtkSmartPointer<vtkDataSet> copy;
    copy.TakeReference(leaves[block]->NewInstance());
    this->CopyBlock(leaves[block], block, firstLocal[block], copy);
    compositeOut->SetDataSet(leaf, copy);
  }
}

//------------------------------------------------------------------------------
SceneOutput::PointGroups SceneOutput::GetGroups(vtkIdType polygon, vtkIdType corner) const
{
  PointGroups groups{ -1, -1 };
  for (int side = 0; side < this->Scene.GetFaces().GetNumberOfSides(); ++side)
  {
    groups[side] = this->Points->GetGroup(polygon, side, corner);
  }
  return groups;
}

//------------------------------------------------------------------------------
void SceneOutput::CopyBlock(vtkDataSet* input, int block, vtkIdType firstLocal, vtkDataSet* output)
{
  output->ShallowCopy(input);
  if (this->Points)
  {
    this->DividePoints(vtkPolyData::SafeDownCast(input), block, firstLocal,
      vtkPolyData::SafeDownCast(output));
  }
}

//------------------------------------------------------------------------------
// The first smooth groups that meet a point keep it; all further ones get a copy of their own at
// the end.
void SceneOutput::DividePoints(vtkPolyData* input, int block, vtkIdType firstLocal,
  vtkPolyData* output)
{
  constexpr PointGroups none{ -1, -1 };
  std::vector<PointGroups>& groups = this->Groups[block];
  groups.assign(input->GetNumberOfPoints(), none);
  const std::vector<LocalCell>& cells = this->Scene.GetLocalCells();
  std::vector<vtkIdType> sources; // of the points added
  std::map<PointGroups, vtkIdType> added;
  vtkNew<vtkCellArray> polygons;
  OutputMemory::Allocate(input->GetPolys()->GetNumberOfCells(),
    input->GetPolys()->GetNumberOfConnectivityIds(), polygons);
  vtkNew<vtkIdList> corners;
  auto local = static_cast<std::size_t>(firstLocal);
  const vtkIdType first = Leaves::GetFirstPolygonCell(input);
  for (vtkIdType polygon = 0; polygon < input->GetPolys()->GetNumberOfCells(); ++polygon)
  {
    Pulse::Beat(polygon);
    input->GetPolys()->GetCellAtId(polygon, corners);
    const bool isOfScene =
      local < cells.size() && cells[local].Block == block && cells[local].Cell == first + polygon;
    for (vtkIdType corner = 0; isOfScene && corner < corners->GetNumberOfIds(); ++corner)
    {
      const PointGroups group =
        this->GetGroups(this->Scene.GetFirstLocalPolygon() + static_cast<vtkIdType>(local), corner);
      const vtkIdType point = corners->GetId(corner);
      if (groups[point] == none)
      {
        groups[point] = group;
      }
      if (group == none || groups[point] == group)
      {
        continue;
      }
      const auto inserted = added.emplace(group, static_cast<vtkIdType>(groups.size()));
      if (inserted.second)
      {
        groups.push_back(group);
        sources.push_back(point);
      }
      corners->SetId(corner, inserted.first->second);
    }
    local += isOfScene ? 1 : 0;
    polygons->InsertNextCell(corners);
  }
  if (!sources.empty())
  {
    AppendPoints(input, sources, output);
    output->SetPolys(polygons);
  }
}

//------------------------------------------------------------------------------
void SceneOutput::AddArray(const std::string& name, const std::vector<double>& values,
  int components) const
{
  this->AddFaceArray(name, this->Scene.GetFaces().GetMeans(values, components), components);
}

//------------------------------------------------------------------------------
void SceneOutput::AddFaceArray(const std::string& name, const std::vector<double>& values,
  int components) const
{
  const std::vector<double> means =
    this->Points ? this->Points->GetMeans(values, components) : std::vector<double>();
  for (int side = 0; side < this->Scene.GetFaces().GetNumberOfSides(); ++side)
  {
    this->AddCellArray<vtkDoubleArray>(name, values, components, side);
    if (this->Points)
    {
      this->AddPointArray(name, means, components, side);
    }
  }
}

//------------------------------------------------------------------------------
void SceneOutput::AddGroups(const std::string& name) const
{
  const std::vector<vtkDataSet*> leaves = Leaves::Get(this->Output);
  for (std::size_t block = 0; block < leaves.size(); ++block)
  {
    auto array = MakeArray<vtkDoubleArray>(name, leaves[block]->GetNumberOfPoints(), 1);
    for (std::size_t point = 0; point < this->Groups[block].size(); ++point)
    {
      array->SetValue(static_cast<vtkIdType>(point),
        static_cast<double>(this->Groups[block][point][0]));
    }
    leaves[block]->GetPointData()->AddArray(array);
  }
}

//------------------------------------------------------------------------------
void SceneOutput::AddFlags(const std::string& name, const std::vector<int>& flags) const
{
  for (int side = 0; side < this->Scene.GetFaces().GetNumberOfSides(); ++side)
  {
    this->AddCellArray<vtkIntArray>(name, flags, 1, side);
  }
}

//------------------------------------------------------------------------------
template <typename Array, typename Value>
void SceneOutput::AddCellArray(const std::string& name, const std::vector<Value>& values,
  int components, int side) const
{
  std::vector<vtkSmartPointer<Array>> arrays;
  for (vtkDataSet* data : Leaves::Get(this->Output))
  {
    const int kind =
      this->Scene.IsOfTexels() ? static_cast<int>(vtkDataObject::POINT) : vtkDataObject::CELL;
    arrays.push_back(
      MakeArray<Array>(GetSideName(name, side), data->GetNumberOfElements(kind), components));
    data->GetAttributes(kind)->AddArray(arrays.back());
  }
  const std::vector<LocalCell>& cells = this->Scene.GetLocalCells();
  vtkIdType face =
    this->Scene.GetFirstLocalPolygon() + side * this->Scene.GetFaces().GetNumberOfPolygons();
  for (const LocalCell& cell : cells)
  {
    Pulse::Beat(face);
    arrays[cell.Block]->SetTypedTuple(cell.Cell, &values[face * components]);
    ++face;
  }
  for (const CopiedCell& copy : this->Scene.GetCopiedCells())
  {
    arrays[copy.Cell.Block]->SetTypedTuple(copy.Cell.Cell, &values[copy.Polygon * components]);
  }
}

//------------------------------------------------------------------------------
void SceneOutput::AddPointArray(const std::string& name, const std::vector<double>& means,
  int components, int side) const
{
  const std::vector<vtkDataSet*> leaves = Leaves::Get(this->Output);
  for (std::size_t block = 0; block < leaves.size(); ++block)
  {
    auto array = MakeArray<vtkDoubleArray>(GetSideName(name, side),
      leaves[block]->GetNumberOfPoints(), components);
    const std::vector<PointGroups>& groups = this->Groups[block];
    for (std::size_t point = 0; point < groups.size(); ++point)
    {
      Pulse::Beat(point);
      if (groups[point][side] >= 0)
      {
        array->SetTypedTuple(static_cast<vtkIdType>(point),
          &means[groups[point][side] * components]);
      }
    }
    leaves[block]->GetPointData()->AddArray(array);
  }
}
} // namespace LightTransport
