// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What of a patch a light without extent reaches: pieces from a ShadowClipper, with rays for those
/// that it leaves undecided.
#ifndef LitParts_h
#define LitParts_h

#include "Lighting/LightSource.h"
#include "Lighting/ShadowClipper.h"

#include <functional>
#include <vector>

namespace LightTransport
{
class LitParts
{
public:
  using Vector = LitPatch::Vector;
  using Piece = ShadowClipper::Piece;
  /// What a place of the patch counts for.
  using Weight = std::function<double(const Vector&)>;

  /// Pieces are at most divided this many times as finely as at first.
  static constexpr int MostRefined = 256;

  /// All of a piece.
  explicit LitParts(const Piece& piece) : Pieces(1, piece) {}

  /// The part of a piece that is lit, with the effort that is worth it at first.
  LitParts(const ShadowClipper& clipper, const Piece& piece, const ShadowClipper::Origin& light,
    const std::vector<vtkIdType>& blockers, const LightEffort& effort);

  /// With more of it until the error of the weights' integral over the patch's area is within the
  /// tolerance of `unshadowed`.
  static LitParts Refine(const ShadowClipper& clipper, const Piece& piece,
    const ShadowClipper::Origin& light, const std::vector<vtkIdType>& blockers,
    const LightEffort& effort, const Weight& weight, double unshadowed);

  const std::vector<Piece>& GetPieces() const { return this->Pieces; }
  /// Their part of the patch.
  double GetShare(const ShadowClipper& clipper) const;
  /// Of the weights' integral over the area.
  double GetVariance() const { return this->Variance; }
  double GetNumberOfRays() const { return this->Rays; }

private:
  LitParts() = default;
  void Divide(const ShadowClipper& clipper, const Piece& piece, const ShadowClipper::Origin& light,
    const std::vector<vtkIdType>& blockers, double least, const Weight& weight);

  std::vector<Piece> Pieces;
  double Variance = 0.0;
  double Rays = 0.0;
};
} // namespace LightTransport

#endif
