// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A body for vtkLightTransportRefinementTestVS.glsl: its tree and its profile as tables of texels,
 * four floats each.
 *
 * Lengths are over a power of two next to the root of the body's area, so that squares fit into
 * single precision in any unit and pieces of the profile stay what they are. Centers are in two
 * parts, the second what single precision takes from the first: differences of near ones are exact.
 *
 * A receiver that is a node needs to know what holds over a range of distances. A sparse table has
 * it for all ranges of 2^k pieces of the profile, and any range is two of these (M. A. Bender and
 * M. Farach-Colton, The LCA problem revisited, 2000).
 */
#ifndef RefinementTables_h
#define RefinementTables_h

#include "vtkDeviceLinkRefiner.h"

#include <vector>

namespace LightTransport
{
class RefinementTables
{
public:
  using Body = vtkDeviceLinkRefiner::Body;
  using Texels = std::vector<float>;

  ///@{ Of each slot: center and area; what the center's single precision leaves, and moment;
  /// radius,
  /// first and last patch, limit; children, and pieces; of the patches below, least and largest
  /// moment and largest distance from the center; of the pieces, mean moment, largest moment and
  /// largest distance.
  static constexpr int NumberOfSlotTables = 6;
  static constexpr int TableOfChildren = 3;
  ///@}
  static constexpr int MantissaBits = 23;

  explicit RefinementTables(const Body& body);

  const Texels& GetSlots(int table) const { return this->Slots[table]; }
  const Texels& GetPieces() const { return this->Pieces; }
  /// Three texels a piece.
  const Texels& GetProfile() const { return this->Profile; }
  /// Over pieces p to p + 2^k, at texel k count + p: largest slopes, and fall of the logarithm in
  /// the band where it is largest; largest curvatures, and least fall.
  const Texels& GetBounds(int table) const { return this->Bounds[table]; }

  ///@{ As the shader has them.
  int GetFirstPiece() const { return this->FirstPiece; }
  float GetSquaredCore() const { return this->SquaredCore; }
  /// Of a length and of the profile, for the shader over for the body.
  double GetLengthFactor() const { return this->LengthFactor; }
  double GetValueFactor() const { return 1.0 / (this->LengthFactor * this->LengthFactor); }
  ///@}

  /// Most children of a node.
  int GetMostChildren() const { return this->MostChildren; }

private:
  struct PieceBounds;

  void FillSlots(const Body& body);
  void FillSpreads(const Body& body);
  void FillProfile(const Body& body);
  void FillBounds(const Body& body);
  PieceBounds BoundPiece(const Body& body, std::size_t piece) const;
  float* GetTexel(int table, std::size_t slot) { return this->Slots[table].data() + 4 * slot; }

  Texels Slots[NumberOfSlotTables];
  Texels Pieces;
  Texels Profile;
  Texels Bounds[2];
  int Exponent = 0; ///< of the unit of length
  double LengthFactor = 1.0;
  int FirstPiece = 0;
  float SquaredCore = 0.0f;
  int MostChildren = 0;
};
} // namespace LightTransport

#endif
