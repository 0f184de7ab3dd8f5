// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneOutput.h"

#include "Scene/Leaves.h"
#include "Scene/PatchScene.h"
#include "Scene/SmoothPoints.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <numeric>
#include <unordered_map>

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
  points->SetNumberOfPoints(total);
  vtkPointData* from = input->GetPointData();
  vtkPointData* to = output->GetPointData();
  to->Initialize();
  to->CopyAllOn();
  to->CopyAllocate(from, total);
  for (vtkIdType point = 0; point < total; ++point)
  {
    const vtkIdType source = point < old ? point : sources[point - old];
    points->SetPoint(point, input->GetPoint(source));
    to->CopyData(from, source, point);
  }
  output->SetPoints(points);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDoubleArray> MakeArray(const std::string& name, vtkIdType tuples, int components)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(0.0);
  return array;
}
} // namespace

//------------------------------------------------------------------------------
SceneOutput::SceneOutput(const PatchScene& scene, const SmoothPoints* points, vtkDataObject* input,
  vtkDataObject* output)
  : Scene(scene), Points(points), Output(output)
{
  const std::vector<vtkPolyData*> leaves = Leaves::Get(input);
  this->PointGroups.assign(leaves.size(), {});
  std::vector<vtkIdType> firstLocal(leaves.size() + 1, 0);
  for (const LocalCell& local : scene.GetLocalCells())
  {
    ++firstLocal[local.Block + 1];
  }
  std::partial_sum(firstLocal.begin(), firstLocal.end(), firstLocal.begin());

  auto* compositeIn = vtkCompositeDataSet::SafeDownCast(input);
  if (!compositeIn)
  {
    this->CopyBlock(leaves[0], 0, 0, vtkPolyData::SafeDownCast(output));
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
    vtkNew<vtkPolyData> copy;
    this->CopyBlock(leaves[block], block, firstLocal[block], copy);
    compositeOut->SetDataSet(leaf, copy);
  }
}

//------------------------------------------------------------------------------
// The first smooth group that meets a point keeps it; every further one gets a copy of its own at
// the end.
void SceneOutput::CopyBlock(vtkPolyData* input, int block, vtkIdType firstLocal,
  vtkPolyData* output)
{
  output->ShallowCopy(input);
  if (!this->Points)
  {
    return;
  }
  std::vector<vtkIdType>& groups = this->PointGroups[block];
  groups.assign(input->GetNumberOfPoints(), -1);
  const std::vector<LocalCell>& cells = this->Scene.GetLocalCells();
  std::vector<vtkIdType> sources; // of the points added
  std::unordered_map<vtkIdType, vtkIdType> added;
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> corners;
  auto local = static_cast<std::size_t>(firstLocal);
  const vtkIdType first = Leaves::GetFirstPolygonCell(input);
  for (vtkIdType polygon = 0; polygon < input->GetPolys()->GetNumberOfCells(); ++polygon)
  {
    input->GetPolys()->GetCellAtId(polygon, corners);
    const bool isPatch =
      local < cells.size() && cells[local].Block == block && cells[local].Cell == first + polygon;
    for (vtkIdType corner = 0; isPatch && corner < corners->GetNumberOfIds(); ++corner)
    {
      const vtkIdType patch = this->Scene.GetLocalPatches()[local];
      const vtkIdType group = this->Points->GetGroup(this->Scene.GetOffsets()[patch] + corner);
      const vtkIdType point = corners->GetId(corner);
      if (groups[point] < 0)
      {
        groups[point] = group;
      }
      if (groups[point] == group)
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
    local += isPatch ? 1 : 0;
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
  this->AddCellArray(name, values, components);
  if (this->Points)
  {
    this->AddPointArray(name, values, components);
  }
}

//------------------------------------------------------------------------------
void SceneOutput::AddCellArray(const std::string& name, const std::vector<double>& values,
  int components) const
{
  std::vector<vtkSmartPointer<vtkDoubleArray>> arrays;
  for (vtkPolyData* data : Leaves::Get(this->Output))
  {
    arrays.push_back(MakeArray(name, data->GetNumberOfCells(), components));
    data->GetCellData()->AddArray(arrays.back());
  }
  const std::vector<LocalCell>& cells = this->Scene.GetLocalCells();
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    arrays[cells[k].Block]->SetTypedTuple(cells[k].Cell,
      &values[this->Scene.GetLocalPatches()[k] * components]);
  }
}

//------------------------------------------------------------------------------
void SceneOutput::AddPointArray(const std::string& name, const std::vector<double>& values,
  int components) const
{
  const std::vector<double> means = this->Points->GetMeans(values, components);
  const std::vector<vtkPolyData*> leaves = Leaves::Get(this->Output);
  for (std::size_t block = 0; block < leaves.size(); ++block)
  {
    auto array = MakeArray(name, leaves[block]->GetNumberOfPoints(), components);
    const std::vector<vtkIdType>& groups = this->PointGroups[block];
    for (std::size_t point = 0; point < groups.size(); ++point)
    {
      if (groups[point] >= 0)
      {
        array->SetTypedTuple(static_cast<vtkIdType>(point), &means[groups[point] * components]);
      }
    }
    leaves[block]->GetPointData()->AddArray(array);
  }
}
} // namespace LightTransport
