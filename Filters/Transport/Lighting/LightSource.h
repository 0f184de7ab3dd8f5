// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What lights the patches of a scene from outside: PunctualLight (a vtkLight), Environment (a
 * picture of the surroundings). A source adds what it gives a patch, from points on the patch and
 * rays of its own choice.
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

/// What falls on a patch per unit area, and how much of it enters the surface.
struct LightSum
{
  double Incident[LightBands] = {};
  double Transmitted[LightBands] = {};

  void Add(const double* values, double weight, double transmittance);
  void Add(const LightSum& other);
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
  const Vector& GetNormal() const { return this->Shape.Normal; }
  /// Evenly spread points of the patch, and directions around its normal.
  Vector GetPoint(int k) const { return this->Sampler.GetPoint(this->Shape, k, 0); }
  Vector GetDirection(int k) const { return this->Sampler.GetDirection(this->Shape.Normal, k, 2); }

  /// Whether anything is between a point of the patch and a target.
  bool IsBlocked(const Vector& point, const Vector& target) const;
  /// The part of the light that enters, at an angle of incidence given by its cosine.
  double GetTransmittance(double cosine) const;

private:
  const PatchScene& Scene;
  const SceneRayCaster* Caster;
  double RefractiveIndex;
  vtkIdType Id;
  Polygon Shape;
  PatchSampler Sampler;
};

class LightSource
{
public:
  /// Longer than a scene, whose bounding box has diagonal 1.
  static constexpr double OutOfScene = 2.0;

  virtual ~LightSource() = default;

  /// Add what the source gives the patch. Returns how many points were looked from.
  virtual double Light(const LitPatch& patch, LightSum& sum) const = 0;
};
} // namespace LightTransport

#endif
