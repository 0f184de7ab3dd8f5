// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/PatchPairs.h"

#include "Geometry/ShaftCuller.h"
#include "Scene/PatchScene.h"
#include "ViewFactors/PairVisibility.h"
#include "ViewFactors/UnoccludedPairs.h"

#include <vector>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
PatchPairs::View::Share Round(const PairVisibility::Share& share)
{
  return { static_cast<float>(share.Value), static_cast<float>(share.Error) };
}
} // namespace

//------------------------------------------------------------------------------
// Sets the pair up for looking at it; false where all of it is visible.
bool PatchPairs::MayBeHidden(vtkIdType i, vtkIdType j, double kernel,
  PairVisibility& visibility) const
{
  if (kernel <= 0.0 || !this->Culler.HasOccluders())
  {
    return false;
  }
  std::vector<ShaftCuller::Occluder> between;
  this->Culler.FindBetween(i, j, between);
  const std::vector<double>& areas = this->Scene.GetAreas();
  return !between.empty() &&
    visibility.SetPair(this->Scene, i, j, this->Culler.GetWalls(), between,
      PairVisibility::GetKey(i, j), kernel * areas[i] * areas[j]);
}

//------------------------------------------------------------------------------
PatchPairs::View PatchPairs::Look(vtkIdType i, vtkIdType j, bool isFree,
  PairVisibility& visibility) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  const double kernel = this->Open.Compute(i, j).Value / (areas[i] * areas[j]);
  View view = { static_cast<float>(kernel), { 1.0f, 0.0f }, {}, 0.0f };
  if (!isFree && this->MayBeHidden(i, j, view.Kernel, visibility))
  {
    view.First = Round(visibility.Look());
  }
  return view;
}

//------------------------------------------------------------------------------
PatchPairs::View::Share PatchPairs::See(vtkIdType i, vtkIdType j, double allowed,
  PairVisibility& visibility, View& view) const
{
  if (view.First.Error <= allowed)
  {
    return view.First;
  }
  if (view.Allowed != static_cast<float>(allowed))
  {
    this->MayBeHidden(i, j, view.Kernel, visibility);
    view.Fine = Round(visibility.Integrate(allowed, visibility.Look().Value));
    view.Allowed = static_cast<float>(allowed);
  }
  return view.Fine;
}
} // namespace LightTransport
