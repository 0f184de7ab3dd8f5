// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/LitParts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace LightTransport
{
namespace
{
/// A patch is cut into pieces of this part of it over ShadowSamples, where much is before it.
constexpr double FirstPiece = 1.0 / 16.0;
/// By how much such pieces are made smaller where the tolerance needs it.
constexpr double Refinement = 16.0;
/// Of shares of a patch: so little beside all is nothing.
constexpr double Rounding = 1e-12;

//------------------------------------------------------------------------------
bool Sees(const LitPatch& patch, const ShadowClipper::Origin& light, const LitPatch::Vector& point)
{
  if (!light.IsPoint)
  {
    return !patch.IsBlocked(point, point - LightSource::OutOfScene * light.Direction);
  }
  const LitPatch::Vector path = light.Position - point;
  const double distance = path.norm();
  const double reach =
    std::min(LightSource::OutOfScene, std::max(0.0, distance - LightSource::Clearance));
  return !patch.IsBlocked(point, point + reach / distance * path);
}
} // namespace

//------------------------------------------------------------------------------
LitParts::LitParts(const ShadowClipper& clipper, const Piece& piece,
  const ShadowClipper::Origin& light, const std::vector<vtkIdType>& blockers,
  const LightEffort& effort)
{
  this->Divide(clipper, piece, light, blockers, FirstPiece / effort.ShadowSamples,
    [](const Vector&) { return 1.0; });
}

//------------------------------------------------------------------------------
LitParts LitParts::Refine(const ShadowClipper& clipper, const Piece& piece,
  const ShadowClipper::Origin& light, const std::vector<vtkIdType>& blockers,
  const LightEffort& effort, const Weight& weight, double unshadowed)
{
  double part = FirstPiece / effort.ShadowSamples;
  const double smallest = part / MostRefined;
  double rays = 0.0;
  for (;;)
  {
    LitParts parts;
    parts.Divide(clipper, piece, light, blockers, part, weight);
    rays += parts.Rays;
    part /= Refinement;
    if (std::sqrt(parts.Variance) <= effort.Tolerance * unshadowed || part < smallest)
    {
      parts.Rays = rays;
      return parts;
    }
  }
}

//------------------------------------------------------------------------------
// How many of the undecided pieces see the light tells what each of them may be off by: the places
// that are asked are spread evenly, and so the variance is at most that of places chosen at random.
// One more piece of either kind stands for what was not met.
void LitParts::Divide(const ShadowClipper& clipper, const Piece& piece,
  const ShadowClipper::Origin& light, const std::vector<vtkIdType>& blockers, double least,
  const Weight& weight)
{
  const LitPatch& patch = clipper.GetPatch();
  const double area = ShadowClipper::GetArea(clipper.GetWhole());
  ShadowClipper::Result divided;
  clipper.Divide(piece, light, blockers, least * area, divided);
  this->Pieces = std::move(divided.Lit);
  this->Rays = static_cast<double>(divided.Undecided.size());
  double seen = 0.0;
  double all = 0.0;
  double squares = 0.0;
  double largest = 0.0;
  for (std::size_t k = 0; k < divided.Undecided.size(); ++k)
  {
    const Piece& undecided = divided.Undecided[k];
    const auto index = static_cast<int>(k);
    const Vector point = clipper.GetPoint(ShadowClipper::Choose(undecided,
      patch.GetSampler().Get(index, 0), patch.GetSampler().Get(index, 1)));
    const double part = ShadowClipper::GetArea(undecided) / area * weight(point);
    all += part;
    squares += part * part;
    largest = std::max(largest, part);
    if (Sees(patch, light, point))
    {
      seen += part;
      this->Pieces.push_back(undecided);
    }
  }
  const double share = all > 0.0 ? (seen + largest) / (all + 2.0 * largest) : 0.0;
  this->Variance = share * (1.0 - share) * squares;
}

//------------------------------------------------------------------------------
double LitParts::GetShare(const ShadowClipper& clipper) const
{
  double area = 0.0;
  for (const Piece& piece : this->Pieces)
  {
    area += ShadowClipper::GetArea(piece);
  }
  const double share = area / ShadowClipper::GetArea(clipper.GetWhole());
  return share > 1.0 - Rounding ? 1.0 : share;
}
} // namespace LightTransport
