// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Dynamic links on the GPU: pairs of a receiver and a sender, both slots of a tree, from coarse to
 * fine. A level is three passes over a buffer of pairs: a vertex shader tests them, a geometry
 * shader takes those that are done, another makes the pairs of the next level, with the children of
 * the receiver or of the sender. How many come is all that is read back on the way.
 *
 * All calls within a DeviceSession.
 *
 * Source: the future work of N. A. Carr, J. D. Hall, J. C. Hart, GPU algorithms for radiosity and
 * subsurface scattering, Graphics Hardware 2003.
 */
#ifndef LinkRefinementGL_h
#define LinkRefinementGL_h

#include "Refinement/FeedbackPass.h"
#include "Shared/Outcome.h"
#include "Textures/FloatTextures.h"
#include "Textures/VectorBuffer.h"
#include "vtkDeviceLinkRefiner.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkShaderProgram;

namespace LightTransport
{
class RefinementTables;

class LinkRefinementGL
{
public:
  using Body = vtkDeviceLinkRefiner::Body;
  using Part = vtkDeviceLinkRefiner::Part;

  /// Called between levels: others may use the context then.
  using Pause = std::function<void()>;

  explicit LinkRefinementGL(FloatTextures& engine);

  /// Before the context goes.
  void Release();

  /// Messages of failures have no full stop.
  Outcome Initialize(std::shared_ptr<const Body> body);
  /// What patches [first, last) find.
  Outcome Refine(vtkIdType first, vtkIdType last, const Pause& pause, std::vector<Part>& parts);

  /// Pairs that have been tested.
  vtkTypeInt64 GetNumberOfTests() const { return this->NumberOfTests; }

private:
  using Group = FloatTextures::Group;

  Outcome CheckLimits(const RefinementTables& tables) const;
  Outcome MakeTable(Group& group, std::size_t index, const std::vector<float>& texels);
  Outcome MakeTables(const RefinementTables& tables);
  void MakePasses(const RefinementTables& tables);
  Outcome UseTest(vtkShaderProgram*& program);
  Outcome Test(vtkIdType count);
  Outcome Take(vtkIdType count, vtkIdType& taken);
  Outcome Divide(vtkIdType count, vtkIdType& followers);
  void AddCover(int slot, vtkIdType first, vtkIdType last, std::vector<float>& pairs) const;
  Outcome Read(vtkIdType taken, vtkIdType first, vtkIdType last, std::vector<Part>& parts) const;

  FloatTextures& Engine;
  std::shared_ptr<const Body> Described;
  Group Slots;
  Group Pieces;
  Group Profile;
  Group Bounds;
  VectorBuffer Pairs{ 1 };
  VectorBuffer Followers{ 1 };
  VectorBuffer Tested{ 3 };
  VectorBuffer Taken{ 3 };
  std::unique_ptr<FeedbackPass> TestPass;
  std::unique_ptr<FeedbackPass> TakePass;
  std::unique_ptr<FeedbackPass> DividePass;
  int FirstPiece = 0;
  float SquaredCore = 0.0f;
  double LengthFactor = 1.0;
  double ValueFactor = 1.0;
  vtkTypeInt64 NumberOfTests = 0;
};
} // namespace LightTransport

#endif
