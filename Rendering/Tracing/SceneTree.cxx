// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tracing/SceneTree.h"

#include "Context/OpenGLContextGuard.h"
#include "Device/DeviceSession.h"
#include "Maps/SceneUniforms.h"
#include "Tracing/TriangleTree.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace LightTransport
{
namespace
{
// From the origin: the square of a distance is a number in single precision.
constexpr double Farthest = 1e18;
/// Of the scene: nothing nearer is met by a ray.
constexpr double Bias = 1e-5;
} // namespace

//------------------------------------------------------------------------------
void SceneTree::Clear()
{
  if (this->IsOpen())
  {
    const OpenGLContextGuard guard(this->Engine->GetWindow());
    this->Table = TupleTable();
  }
  this->Table = TupleTable();
  this->Engine.reset();
  this->IsTried = false;
}

//------------------------------------------------------------------------------
Outcome SceneTree::Update(vtkRenderer* renderer)
{
  const Outcome done = this->Refresh(renderer);
  vtkNew<vtkMatrix4x4> back;
  vtkMatrix4x4::Invert(renderer->GetActiveCamera()->GetModelViewTransformMatrix(), back);
  this->FromView = SceneUniforms::MakeMove(back->GetData(), { 0.0, 0.0, 0.0 }, this->Origin);
  return done;
}

//------------------------------------------------------------------------------
Outcome SceneTree::Refresh(vtkRenderer* renderer)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  this->Casters.Find(renderer);
  if (!this->IsOpen() || this->Engine->GetWindow() != window)
  {
    this->Clear();
    this->Engine = std::make_unique<FloatTextures>(window);
  }
  if (this->IsTried && this->Stamp == this->Casters.GetStamp())
  {
    return this->IsThere() ? Outcome::Done() : Outcome::FailedAsReported();
  }
  this->IsTried = true;
  this->Stamp = this->Casters.GetStamp();
  const DeviceSession session(window);
  const Outcome uploaded = this->Upload();
  if (!uploaded)
  {
    this->Table = TupleTable();
    return Outcome::Failed("The tree of what casts shadows does not fit into " +
      this->Engine->GetDeviceName() + ": " + uploaded.GetMessage());
  }
  ++this->NumberOfRuns;
  return uploaded;
}

//------------------------------------------------------------------------------
// Triangles with a corner that is nowhere, or so far away that shaders cannot square the distance,
// cast no shadows.
void SceneTree::VisitTriangles(const std::function<void(const Corners&, int)>& visit) const
{
  const auto isUsable = [](const Vector3& corner)
  {
    return std::all_of(corner.begin(), corner.end(),
      [](double coordinate) { return std::abs(coordinate) < Farthest; });
  };
  int body = 0;
  for (const ShadowCasters::Caster& caster : this->Casters.Get())
  {
    caster.VisitTriangles(
      [&](Corners corners)
      {
        for (Vector3& corner : corners)
        {
          double moved[4] = { corner[0], corner[1], corner[2], 1.0 };
          vtkMatrix4x4::MultiplyPoint(caster.Matrix.data(), moved, moved);
          std::copy(moved, moved + 3, corner.begin());
        }
        if (std::all_of(corners.begin(), corners.end(), isUsable))
        {
          visit(corners, body);
        }
      });
    ++body;
  }
}

//------------------------------------------------------------------------------
Outcome SceneTree::Upload()
{
  vtkBoundingBox bounds;
  this->VisitTriangles(
    [&](const Corners& corners, int)
    {
      for (const Vector3& corner : corners)
      {
        bounds.AddPoint(corner[0], corner[1], corner[2]);
      }
    });
  this->Origin = {};
  this->Size = 0.0;
  if (bounds.IsValid())
  {
    bounds.GetCenter(this->Origin.data());
    this->Size = bounds.GetDiagonalLength();
  }
  std::vector<TriangleTree::Triangle> triangles;
  this->VisitTriangles(
    [&](const Corners& corners, int body)
    {
      triangles.emplace_back();
      triangles.back().Body = body;
      for (std::size_t corner = 0; corner < corners.size(); ++corner)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          triangles.back().Corners[corner][axis] =
            static_cast<float>(corners[corner][axis] - this->Origin[axis]);
        }
      }
    });
  const TriangleTree tree(std::move(triangles));
  this->NumberOfBoxes = tree.GetNumberOfBoxes();
  // A texture has at least one texel.
  std::vector<float> texels = tree.GetTexels();
  texels.resize(std::max<std::size_t>(texels.size(), 4), 0.0f);
  return this->Table.Upload(*this->Engine, std::move(texels));
}

//------------------------------------------------------------------------------
void SceneTree::Activate(vtkShaderProgram* program)
{
  this->Table.Get()->Activate();
  program->SetUniformi("lightTransportTree", this->Table.Get()->GetTextureUnit());
  program->SetUniformi("lightTransportTreeWidthBits", TupleTable::WidthBits);
  program->SetUniformi("lightTransportTreeBoxes", this->NumberOfBoxes);
  program->SetUniformMatrix4x4("lightTransportToScene", this->FromView.data());
  program->SetUniformf("lightTransportRayBias", static_cast<float>(Bias * this->Size));
}

//------------------------------------------------------------------------------
int SceneTree::FindBody(vtkActor* actor, vtkPolyData* surface) const
{
  const auto& casters = this->Casters.Get();
  const auto found = std::find_if(casters.begin(), casters.end(),
    [actor, surface](const ShadowCasters::Caster& caster)
    { return caster.Actor == actor && caster.Surface == surface; });
  return found != casters.end() ? static_cast<int>(found - casters.begin()) : -1;
}

//------------------------------------------------------------------------------
void SceneTree::Deactivate()
{
  if (this->IsThere())
  {
    this->Table.Get()->Deactivate();
  }
}
} // namespace LightTransport
