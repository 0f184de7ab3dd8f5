// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What lights the patches of a scene from outside: PointLight and DistantLight (from vtkLights),
 * Environment (a picture of the surroundings). A source adds what it gives a patch and what that
 * may be off by, from pieces or points of the patch and rays of its own choice.
 */
#ifndef LightSource_h
#define LightSource_h

#include "Geometry/PatchSampler.h"
#include "Geometry/Polygon.h"
#include "vtkType.h"

namespace LightTransport
{
class PatchScene;
class SceneRayCaster;

/// Light has red, green and blue.
constexpr int LightBands = 3;

/// How much work lights are worth.
struct LightEffort
{
  double Tolerance;       ///< one standard error, over LightSum::Unshadowed
  int EnvironmentSamples; ///< rays of a patch at first
  int ShadowSamples;      ///< directions, or a 16th of pieces, where a patch is partly lit
};

/// What falls on a patch per unit area, and how much of it enters the surface.
struct LightSum
{
  double Incident[LightBands] = {};
  double Transmitted[LightBands] = {};
  /// Of what is incident: squares of standard errors.
  double Variance[LightBands] = {};
  /// What would be incident if nothing were in the way, about, or a quarter of that on a patch that
  /// faces the light, where that is more: errors are measured by it.
  double Unshadowed[LightBands] = {};

  /// What comes, or would come if the way were not blocked.
  void Add(const double* values, double weight, double transmittance, bool isBlocked = false);
  void Add(const LightSum& other) { this->AddScaled(other, 1.0); }
  void AddScaled(const LightSum& other, double factor);
  void RaiseUnshadowed(const double* values, double factor);

  ///@{ Of the band where it is largest.
  double GetLargestUnshadowed() const;
  double GetLargestError() const;
  ///@}
};

/// A patch that is lit.
class LitPatch
{
public:
  using Vector = Polygon::Vector;

  /// `caster` decides what is in the shadow; without it (nullptr) nothing is.
  LitPatch(const PatchScene& scene, const SceneRayCaster* caster, double refractiveIndex,
    vtkIdType patch);

  const PatchScene& GetScene() const { return this->Scene; }
  vtkIdType GetId() const { return this->Id; }
  const Polygon& GetShape() const { return this->Shape; }
  const Vector& GetNormal() const { return this->Shape.Normal; }
  const PatchSampler& GetSampler() const { return this->Sampler; }
  /// Evenly spread points of the patch, and directions around its normal.
  Vector GetPoint(int k) const { return this->Sampler.GetPoint(this->Shape, k, 0); }
  Vector GetDirection(int k) const { return this->Sampler.GetDirection(this->Shape.Normal, k, 2); }

  /// Whether patches cast shadows at all.
  bool HasShadows() const { return this->Caster != nullptr; }
  /// Whether any patch is in front of this one at all.
  bool HasBlockers() const;
  /// Whether a patch has a part in front of this one.
  bool IsInFront(vtkIdType other) const;
  /// Whether anything is between a point of the patch and a target.
  bool IsBlocked(const Vector& point, const Vector& target) const;
  /// The part of the light that enters, at an angle of incidence given by its cosine.
  double GetTransmittance(double cosine) const;

private:
  const PatchScene& Scene;
  const SceneRayCaster* Caster;
  double RefractiveIndex;
  vtkIdType Id;
  PatchPlane Plane;
  Polygon Shape;
  PatchSampler Sampler;
};

class LightSource
{
public:
  /// Longer than a scene, whose bounding box has diagonal 1.
  static constexpr double OutOfScene = 2.0;
  /// Nothing so near to a light hides it: a lamp that touches a surface shines in front of it.
  static constexpr double Clearance = 1e-6;

  virtual ~LightSource() = default;

  /// Add what the source gives the patch to what others give it. Returns how many rays were cast.
  virtual double Light(const LitPatch& patch, LightSum& sum) const = 0;
};
} // namespace LightTransport

#endif
