// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/CellArrays.h"

#include "Scene/Leaves.h"
#include "Scene/PatchScene.h"
#include "Shared/ArrayNames.h"
#include "Shared/InputArrays.h"
#include "Shared/Pulse.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
const char* GetWord(bool ofPoints)
{
  return ofPoints ? "point" : "cell";
}

//------------------------------------------------------------------------------
// The array, or nullptr where there is none.
Outcome FindArray(vtkDataSet* data, const std::string& name, vtkDataArray*& numbers)
{
  vtkDataSetAttributes* ofPatches = Leaves::GetPatchData(data);
  const bool ofPoints = ofPatches == data->GetPointData();
  vtkAbstractArray* array = ofPatches->GetAbstractArray(name.c_str());
  numbers = vtkDataArray::SafeDownCast(array);
  if (array && !numbers)
  {
    return Outcome::Failed(std::string("The ") + GetWord(ofPoints) + " array \"" + name +
      "\" is not numeric: it holds no numbers but a " + array->GetClassName() +
      ". Give one of floats or doubles.");
  }
  const auto other = ofPoints ? vtkDataObject::CELL : vtkDataObject::POINT;
  if (!array && data->GetAttributes(other)->HasArray(name.c_str()))
  {
    return Outcome::Failed("\"" + name + "\" is a " + GetWord(!ofPoints) + " array and a " +
      GetWord(ofPoints) + " array is needed: pass the input through " +
      (ofPoints ? "vtkCellDataToPointData." : "vtkPointDataToCellData."));
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome FailUneven(const std::string& kind, const std::string& name)
{
  return Outcome::Failed("The " + kind + " \"" + name +
    "\" is missing or has another number of components in some blocks: give it to all of them.");
}
} // namespace

//------------------------------------------------------------------------------
Outcome CellArrays::Read(const std::string& name, bool required, std::vector<double>& values,
  int& components, bool* hasBack) const
{
  std::vector<double> fronts;
  std::vector<double> backs;
  int componentsOfBacks = 0;
  Outcome read = this->ReadPolygons(name, fronts, components);
  if (read && this->Scene.GetFaces().GetNumberOfSides() == 2)
  {
    read = this->ReadPolygons(name + ArrayNames::BackSuffix, backs, componentsOfBacks);
  }
  if (!read)
  {
    return read;
  }
  if (hasBack)
  {
    *hasBack = componentsOfBacks > 0;
  }
  if (components == 0)
  {
    values.clear();
    return required || componentsOfBacks > 0
      ? Outcome::Failed("The input has no " + this->GetKind() + " \"" + name + "\"" +
          (componentsOfBacks > 0 ? ", but one for the backs: add it with the values of the fronts."
                                 : ".") +
          this->Suggest(name))
      : Outcome::Done();
  }
  if (componentsOfBacks > 0 && componentsOfBacks != components)
  {
    return Outcome::Failed("The cell array \"" + name + ArrayNames::BackSuffix + "\" has " +
      std::to_string(componentsOfBacks) + " components where \"" + name + "\" has " +
      std::to_string(components) + ": give both the same number.");
  }
  values = this->Spread(fronts, componentsOfBacks > 0 ? backs : fronts, components);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
std::string CellArrays::Suggest(const std::string& name) const
{
  std::string suggested;
  for (vtkDataSet* data : Leaves::Get(this->Input))
  {
    suggested =
      suggested.empty() ? InputArrays::Suggest(Leaves::GetPatchData(data), name) : suggested;
  }
  return suggested;
}

//------------------------------------------------------------------------------
std::string CellArrays::GetKind() const
{
  return std::string(GetWord(this->Scene.IsOfTexels())) + " array";
}

//------------------------------------------------------------------------------
bool CellArrays::IsInput(const std::string& name) const
{
  const std::vector<vtkDataSet*> leaves = Leaves::Get(this->Input);
  const bool isMine = std::any_of(leaves.begin(), leaves.end(),
    [&](vtkDataSet* data) { return Leaves::GetPatchData(data)->HasArray(name.c_str()) != 0; });
  return this->AllRanks.GetLargest(isMine ? 1 : 0) != 0;
}

//------------------------------------------------------------------------------
Outcome CellArrays::ReadPolygons(const std::string& name, std::vector<double>& values,
  int& components) const
{
  std::vector<double> mine;
  int found = 0;
  if (Outcome read = this->AllRanks.Agree(this->ReadLocal(name, mine, found)); !read)
  {
    return read;
  }
  components = 0;
  bool missing = false;
  bool even = true;
  for (const int rank : this->AllRanks.Gather(std::vector<int>{ found }))
  {
    missing = missing || rank < 0;
    even = even && (rank <= 0 || components == 0 || rank == components);
    components = std::max(components, rank);
  }
  if (missing && components == 0)
  {
    return Outcome::Done();
  }
  if (missing || !even)
  {
    return FailUneven(this->GetKind(), name);
  }
  values = this->AllRanks.Gather(mine);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
std::vector<double> CellArrays::SpreadBlockValues(const std::vector<double>& blockValues) const
{
  std::vector<double> mine;
  for (const LocalCell& local : this->Scene.GetLocalCells())
  {
    mine.push_back(blockValues[local.Block]);
  }
  const std::vector<double> all = this->AllRanks.Gather(mine);
  return this->Spread(all, all, 1);
}

//------------------------------------------------------------------------------
std::vector<double> CellArrays::Spread(const std::vector<double>& fronts,
  const std::vector<double>& backs, int components) const
{
  const SceneFaces& faces = this->Scene.GetFaces();
  std::vector<double> values(this->Scene.GetNumberOfPatches() * components);
  for (vtkIdType patch = 0; patch < this->Scene.GetNumberOfPatches(); ++patch)
  {
    Pulse::Beat(patch);
    const vtkIdType face = faces.GetFace(patch);
    const std::vector<double>& source = faces.GetSide(face) == 0 ? fronts : backs;
    std::copy_n(source.begin() + faces.GetPolygon(face) * components, components,
      values.begin() + patch * components);
  }
  return values;
}

//------------------------------------------------------------------------------
Outcome CellArrays::ReadLocal(const std::string& name, std::vector<double>& values,
  int& components) const
{
  const std::vector<vtkDataSet*> leaves = Leaves::Get(this->Input);
  int block = -1;
  vtkDataArray* array = nullptr;
  for (const LocalCell& local : this->Scene.GetLocalCells())
  {
    Pulse::Beat(values.size());
    if (local.Block != block)
    {
      block = local.Block;
      if (Outcome found = FindArray(leaves[block], name, array); !found)
      {
        return found;
      }
      const int here = array ? array->GetNumberOfComponents() : -1;
      if (components != 0 && here != components)
      {
        return FailUneven(this->GetKind(), name);
      }
      components = here;
    }
    for (int component = 0; component < components; ++component)
    {
      const double value = array->GetComponent(local.Cell, component);
      if (!std::isfinite(value))
      {
        return Outcome::Failed("The " + this->GetKind() + " \"" + name +
          "\" has a value that is not finite at " + GetWord(this->Scene.IsOfTexels()) + " " +
          std::to_string(local.Cell) + ": replace it, for example with vtkArrayCalculator.");
      }
      values.push_back(value);
    }
  }
  return Outcome::Done();
}
} // namespace LightTransport
