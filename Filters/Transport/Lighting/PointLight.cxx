// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/PointLight.h"

#include "Lighting/LitParts.h"
#include "Scene/PatchScene.h"
#include "vtkMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
/// Edges of the pyramid that stands for a cone: as large as the cone, and nowhere off by more than
/// a thousandth of its radius.
constexpr int ConeEdges = 64;
/// How large triangles may be beside their distance from a light.
constexpr double TriangleReach = 0.5;
} // namespace

//------------------------------------------------------------------------------
// Irradiance at normal incidence over the color, times the cosine.
double PointLight::GetStrength(const Vector& point, const LitPatch& patch, double& cosine) const
{
  const Vector towards = (this->Origin.Position - point).normalized();
  const double strength = this->Origin.GetStrength(point, patch.GetScene().GetScale());
  cosine = towards.dot(patch.GetNormal());
  return cosine > 0.0 ? strength * cosine : 0.0;
}

//------------------------------------------------------------------------------
// What is within a pyramid as wide as the cone.
void PointLight::CutCone(const ShadowClipper& clipper, Piece& piece) const
{
  const double cosine = this->Origin.ConeCosine;
  const Vector& axis = this->Origin.Axis;
  const bool isInside = std::all_of(piece.begin(), piece.end(),
    [&](const ShadowClipper::Place& corner)
    {
      const Vector path = clipper.GetPoint(corner) - this->Origin.Position;
      return path.dot(axis) >= cosine * path.norm();
    });
  const double step = vtkMath::Pi() / ConeEdges;
  const double width = std::sqrt((1.0 / (cosine * cosine) - 1.0) * step / std::tan(step));
  const Vector tangent = axis.unitOrthogonal();
  const Vector other = axis.cross(tangent);
  for (int edge = 0; !isInside && edge < ConeEdges && !piece.empty(); ++edge)
  {
    const double angle = 2.0 * edge * step;
    const Vector outwards = std::cos(angle) * tangent + std::sin(angle) * other;
    clipper.Cut(this->Origin.Position, width * axis - outwards, piece);
  }
}

//------------------------------------------------------------------------------
PointLight::Mean PointLight::Integrate(const ShadowClipper& clipper,
  const std::vector<Piece>& pieces) const
{
  const LitPatch& patch = clipper.GetPatch();
  const double sharpness = this->Origin.ConeCosine > 0.0 ? this->Origin.Exponent : 0.0;
  PieceIntegral integral(clipper, this->Origin.Position,
    TriangleReach / std::sqrt(1.0 + 0.5 * sharpness),
    [&](const Vector& point)
    {
      double cosine;
      const double strength = this->GetStrength(point, patch, cosine);
      return PieceIntegral::Value{ strength, strength * patch.GetTransmittance(cosine) };
    });
  for (const Piece& piece : pieces)
  {
    integral.Add(piece);
  }
  const double area = ShadowClipper::GetArea(clipper.GetWhole());
  Mean mean;
  mean.Value = integral.Get(this->Effort.Tolerance, mean.Error);
  mean.Value.Incident /= area;
  mean.Value.Transmitted /= area;
  mean.Error /= area;
  return mean;
}

//------------------------------------------------------------------------------
double PointLight::Light(const LitPatch& patch, LightSum& sum) const
{
  const PatchPlane plane = patch.GetScene().GetPlane(patch.GetId());
  const double height = plane.GetCertainHeight(this->Origin.Position);
  if (!(height > 0.0))
  {
    return 0.0;
  }
  const ShadowClipper clipper(patch);
  Piece piece = clipper.GetWhole();
  if (this->Origin.ConeCosine > 0.0)
  {
    this->CutCone(clipper, piece);
  }
  const Mean whole = this->Integrate(clipper, { piece });
  const double facing =
    PunctualLight::Facing * (this->Origin.Position - plane.Origin).norm() / height;
  const ShadowClipper::Origin origin = { true, this->Origin.Position, Vector::Zero() };
  const std::vector<vtkIdType> blockers = clipper.FindBlockers(piece, origin);
  Mean lit = whole;
  LitParts parts(piece);
  if (!blockers.empty())
  {
    double cosine;
    parts = LitParts::Refine(
      clipper, piece, origin, blockers, this->Effort,
      [&](const Vector& point) { return this->GetStrength(point, patch, cosine); },
      whole.Value.Incident * std::max(1.0, facing));
    lit = this->Integrate(clipper, parts.GetPieces());
  }
  LightSum light;
  for (int band = 0; band < LightBands; ++band)
  {
    const double color = this->Origin.Color[band];
    light.Unshadowed[band] = color * whole.Value.Incident * std::max(1.0, facing);
    light.Incident[band] = color * lit.Value.Incident;
    light.Transmitted[band] = color * lit.Value.Transmitted;
    light.Variance[band] = color * color * (parts.GetVariance() + lit.Error * lit.Error);
  }
  sum.Add(light);
  return parts.GetNumberOfRays();
}
} // namespace LightTransport
