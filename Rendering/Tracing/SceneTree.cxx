// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tracing/SceneTree.h"

#include "Context/OpenGLContextGuard.h"
#include "Device/DeviceSession.h"
#include "Tracing/TriangleTree.h"

#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace LightTransport
{
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
Outcome SceneTree::Upload()
{
  const std::array<double, 6>& bounds = this->Casters.GetBounds();
  const bool isAny = vtkMath::AreBoundsInitialized(bounds.data()) != 0;
  this->Size = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Origin[axis] = isAny ? 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) : 0.0;
    this->Size = isAny ? std::hypot(this->Size, bounds[2 * axis + 1] - bounds[2 * axis]) : 0.0;
  }
  std::vector<TriangleTree::Triangle> triangles;
  for (const ShadowCasters::Caster& caster : this->Casters.Get())
  {
    caster.VisitTriangles(
      [&](const std::array<Vector3, 3>& corners)
      {
        triangles.emplace_back();
        for (std::size_t corner = 0; corner < corners.size(); ++corner)
        {
          const Vector3& at = corners[corner];
          double moved[4] = { at[0], at[1], at[2], 1.0 };
          vtkMatrix4x4::MultiplyPoint(caster.Matrix.data(), moved, moved);
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            triangles.back()[corner][axis] = static_cast<float>(moved[axis] - this->Origin[axis]);
          }
        }
      });
  }
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
