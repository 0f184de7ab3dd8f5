// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Integrals over triangles of what a point light gives: smooth, but with a peak where the light is
 * near. Triangles are quartered while they are large beside their distance from the light, and
 * where two rules disagree.
 */
#ifndef PieceIntegral_h
#define PieceIntegral_h

#include "Lighting/LightSource.h"
#include "Lighting/ShadowClipper.h"

#include <functional>
#include <vector>

namespace LightTransport
{
class PieceIntegral
{
public:
  using Vector = LitPatch::Vector;

  /// What is integrated, at a point: its value, and the part of it that enters the surface.
  struct Value
  {
    double Incident = 0.0;
    double Transmitted = 0.0;
    void Add(const Value& other, double weight);
  };
  using Function = std::function<Value(const Vector&)>;

  /// `reach` is how large triangles may be beside their distance from `light`.
  PieceIntegral(const ShadowClipper& clipper, const Vector& light, double reach, Function function);

  void Add(const ShadowClipper::Piece& piece);
  /// Integrate until the rules agree to `tolerance` of the whole. `error` is what it may be off by.
  Value Get(double tolerance, double& error);

private:
  using Place = ShadowClipper::Place;
  struct Triangle
  {
    Place Corners[3];
    double Area = 0.0;
    Value Integral;
    double Doubt = 0.0; ///< the difference of two rules
  };

  void AddTriangle(const Place& a, const Place& b, const Place& c, int depth);
  void Quarter(const Triangle& triangle, std::vector<Triangle>& parts) const;
  void Measure(Triangle& triangle) const;

  const ShadowClipper& Clipper;
  Vector Light;
  double Reach;
  Function Integrand;
  std::vector<Triangle> Triangles;
};
} // namespace LightTransport

#endif
