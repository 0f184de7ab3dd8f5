// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Solving/SceneActors.h"

#include "Passes/PlainMapper.h"
#include "Shared/BitHash.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace LightTransport
{
namespace
{
constexpr int Bands = 3;

//------------------------------------------------------------------------------
bool IsMeant(vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  return actor->GetVisibility() && actor->GetMapper() &&
    actor->GetMapper()->GetNumberOfInputConnections(0) > 0 &&
    property->GetRepresentation() == VTK_SURFACE && property->GetLighting() &&
    property->GetOpacity() >= 1.0;
}

//------------------------------------------------------------------------------
std::string Describe(vtkActor* actor, int number)
{
  return "Actor " + std::to_string(number) + " of the renderer takes no part in its radiosity: a " +
    std::string(actor->GetMapper()->GetClassName()) +
    " draws it, which has no polygons, triangle strips, or blocks of an opacity below 1. Give each "
    "of its surfaces an actor with a vtkPolyDataMapper, behind a vtkTriangleFilter for strips, or "
    "switch off its property's Lighting.";
}

//------------------------------------------------------------------------------
std::array<double, Bands> Scale(const double color[3], double factor)
{
  return { factor * color[0], factor * color[1], factor * color[2] };
}

///@{
/// What a member shines with, and what it reflects.
std::array<double, Bands> GetEmission(const SceneActors::Member& member)
{
  vtkProperty* property = member.Actor->GetProperty();
  return Scale(member.HasColor ? member.Color.data() : property->GetAmbientColor(),
    property->GetAmbient());
}
std::array<double, Bands> GetReflectance(const SceneActors::Member& member)
{
  vtkProperty* property = member.Actor->GetProperty();
  return Scale(member.HasColor ? member.Color.data() : property->GetDiffuseColor(),
    property->GetDiffuse());
}
///@}

//------------------------------------------------------------------------------
/// Of the array where there is one, else the color for all.
vtkSmartPointer<vtkDoubleArray> MakeArray(vtkPolyData* surface, const std::string& name,
  const char* newName, const std::array<double, Bands>& color, std::string& problem)
{
  auto values = vtkSmartPointer<vtkDoubleArray>::New();
  const vtkIdType polygons = surface->GetPolys()->GetNumberOfCells();
  const vtkIdType first = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  vtkDataArray* array = surface->GetCellData()->GetArray(name.c_str());
  const int components = array ? array->GetNumberOfComponents() : 0;
  values->SetName(newName);
  values->SetNumberOfComponents(Bands);
  values->SetNumberOfTuples(polygons);
  if (array &&
    ((components != 1 && components != Bands) ||
      array->GetNumberOfTuples() != surface->GetNumberOfCells()))
  {
    problem = "the cell array \"" + name +
      "\" has not 1 or 3 components, or not one tuple for each cell: correct it";
    return values;
  }
  for (vtkIdType polygon = 0; polygon < polygons; ++polygon)
  {
    for (int band = 0; band < Bands; ++band)
    {
      values->SetTypedComponent(polygon, band,
        array ? array->GetComponent(first + polygon, components == 1 ? 0 : band) : color[band]);
    }
  }
  return values;
}
} // namespace

//------------------------------------------------------------------------------
void SceneActors::Find(vtkRenderer* renderer, const Names& names,
  std::vector<std::string>& refusals)
{
  this->ArrayNames = names;
  this->Members.clear();
  this->Lights.clear();
  this->ShapeKey = this->MaterialKey = 0;
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator place;
  props->InitTraversal(place);
  int number = 0;
  while (vtkProp* prop = props->GetNextProp(place))
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    number += actor ? 1 : 0;
    if (!actor || !IsMeant(actor))
    {
      continue;
    }
    if (!this->AddBlocks(actor))
    {
      refusals.push_back(Describe(actor, number));
    }
  }
  BitHash lights;
  vtkLightCollection* all = renderer->GetLights();
  all->InitTraversal(place);
  while (vtkLight* light = all->GetNextLight(place))
  {
    if (light->GetSwitch() && light->LightTypeIsSceneLight())
    {
      lights.AddObjects({ light, light->GetTransformMatrix() });
      this->Lights.emplace_back(light);
    }
  }
  this->LightKey = lights.Get();
}

//------------------------------------------------------------------------------
// False where it is kept from taking part.
bool SceneActors::AddBlocks(vtkActor* actor)
{
  if (vtkPolyDataMapper* mapper = FindPlainMapper(actor->GetMapper()))
  {
    mapper->Update();
    BlockSurface all;
    all.Surface = mapper->GetInput();
    if (all.Surface && all.Surface->GetNumberOfStrips() > 0)
    {
      return false;
    }
    if (all.Surface && all.Surface->GetNumberOfPolys() > 0)
    {
      this->Add(actor, all, 0);
    }
    return true;
  }
  std::vector<BlockSurface> blocks;
  FindBlockSurfaces(actor->GetMapper(), blocks);
  const bool canTakePart = std::all_of(blocks.begin(), blocks.end(),
    [](const BlockSurface& block)
    {
      return !block.IsVisible ||
        ((!block.HasOpacity || block.Opacity >= 1.0) && block.Surface->GetNumberOfStrips() == 0);
    });
  if (blocks.empty() || !canTakePart)
  {
    return false;
  }
  int number = 0;
  for (const BlockSurface& block : blocks)
  {
    if (block.IsVisible)
    {
      this->Add(actor, block, number++);
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void SceneActors::Add(vtkActor* actor, const BlockSurface& block, int number)
{
  vtkPolyData* surface = block.Surface;
  Member member;
  member.Actor = actor;
  member.Block = number;
  member.HasColor = block.HasColor;
  member.Color = block.Color;
  member.Surface = surface;
  actor->ComputeMatrix();
  std::copy_n(actor->GetMatrix()->GetData(), member.Matrix.size(), member.Matrix.begin());
  BitHash shape;
  shape.AddObjects({ surface->GetPoints(), surface->GetPolys() });
  member.Shape = shape.Get();
  BitHash place;
  place.AddAll(std::array<std::uint64_t, 2>{ this->ShapeKey, member.Shape });
  for (const double value : member.Matrix)
  {
    place.AddNumber(value);
  }
  this->ShapeKey = place.Get();

  BitHash material;
  material.Add(this->MaterialKey);
  for (int band = 0; band < Bands; ++band)
  {
    material.AddNumber(GetReflectance(member)[band]);
    material.AddNumber(GetEmission(member)[band]);
  }
  vtkCellData* cells = surface->GetCellData();
  material.AddObjects({ cells->GetArray(this->ArrayNames.Emission.c_str()),
    cells->GetArray(this->ArrayNames.Reflectance.c_str()) });
  this->MaterialKey = material.Get();
  this->Members.push_back(member);
}

//------------------------------------------------------------------------------
bool SceneActors::AreOfActorsOf(const SceneActors& other) const
{
  return std::equal(this->Members.begin(), this->Members.end(), other.Members.begin(),
    other.Members.end(),
    [](const Member& a, const Member& b) { return a.Actor.Get() == b.Actor.Get(); });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkMultiBlockDataSet> SceneActors::MakeScene(std::string& problem) const
{
  auto scene = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const Member& member : this->Members)
  {
    const unsigned int index = scene->GetNumberOfBlocks();
    scene->SetBlock(index, this->MakeBlock(member, problem));
    if (!problem.empty())
    {
      problem.insert(0,
        "Of surface " + std::to_string(index) +
          " of those that take part in the radiosity of the renderer, ");
      problem += '.';
      return nullptr;
    }
  }
  return scene;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> SceneActors::MakeBlock(const Member& member,
  std::string& problem) const
{
  vtkPolyData* surface = member.Surface;
  auto block = vtkSmartPointer<vtkPolyData>::New();
  block->GetPointData()->PassData(surface->GetPointData());
  vtkDataArray* ghosts = surface->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  if (ghosts && surface->GetNumberOfPolys() == surface->GetNumberOfCells())
  {
    block->GetCellData()->AddArray(ghosts);
  }
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(member.Matrix.data());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(surface->GetNumberOfPoints());
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    double place[4] = { 0.0, 0.0, 0.0, 1.0 };
    surface->GetPoint(point, place);
    matrix->MultiplyPoint(place, place);
    points->SetPoint(point, place);
  }
  vtkNew<vtkCellArray> polygons;
  polygons->DeepCopy(surface->GetPolys());
  if (matrix->Determinant() < 0.0)
  {
    // A mirror turns front and back around.
    for (vtkIdType polygon = 0; polygon < polygons->GetNumberOfCells(); ++polygon)
    {
      polygons->ReverseCellAtId(polygon);
    }
  }
  block->SetPoints(points);
  block->SetPolys(polygons);
  block->GetCellData()->AddArray(
    MakeArray(surface, this->ArrayNames.Emission, "Emission", GetEmission(member), problem));
  block->GetCellData()->AddArray(MakeArray(surface, this->ArrayNames.Reflectance, "Reflectance",
    GetReflectance(member), problem));
  return block;
}

//------------------------------------------------------------------------------
std::vector<vtkSmartPointer<vtkLight>> SceneActors::CopyLights() const
{
  std::vector<vtkSmartPointer<vtkLight>> copies;
  for (vtkLight* light : this->Lights)
  {
    copies.push_back(vtkSmartPointer<vtkLight>::New());
    copies.back()->DeepCopy(light);
  }
  return copies;
}
} // namespace LightTransport
