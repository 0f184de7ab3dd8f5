// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/RefinementTables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace LightTransport
{
namespace
{
constexpr int NumberOfBands = vtkDeviceLinkRefiner::NumberOfBands;
/// A logarithm's fall where the value is 0; its square fits into single precision.
constexpr double Steepest = 1e18;
/// A limit that no deviation reaches; likewise.
constexpr double LargestLimit = 1e18;

using Slot = vtkDeviceLinkRefiner::Slot;

//------------------------------------------------------------------------------
double GetDistance(const Slot& a, const Slot& b)
{
  return std::hypot(a.Center[0] - b.Center[0], a.Center[1] - b.Center[1],
    a.Center[2] - b.Center[2]);
}

//------------------------------------------------------------------------------
double ReadBits(std::uint32_t bits)
{
  float value;
  std::memcpy(&value, &bits, sizeof(value));
  return static_cast<double>(value);
}

//------------------------------------------------------------------------------
template <typename... Values>
void SetTexel(float* texel, Values... values)
{
  for (const double value : { static_cast<double>(values)... })
  {
    *texel++ = static_cast<float>(value);
  }
}
} // namespace

//------------------------------------------------------------------------------
RefinementTables::RefinementTables(const Body& body)
{
  std::frexp(std::sqrt(body.Slots[0].Area), &this->Exponent);
  this->LengthFactor = std::ldexp(1.0, -this->Exponent);
  this->FillSlots(body);
  this->FillSpreads(body);
  this->FillProfile(body);
  this->FillBounds(body);
}

//------------------------------------------------------------------------------
void RefinementTables::FillSlots(const Body& body)
{
  const double factor = this->LengthFactor;
  for (Texels& table : this->Slots)
  {
    table.assign(4 * body.Slots.size(), 0.0f);
  }
  for (std::size_t index = 0; index < body.Slots.size(); ++index)
  {
    const Slot& slot = body.Slots[index];
    std::array<double, 3> center;
    std::array<double, 3> rest;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double exact = factor * (slot.Center[axis] - body.Slots[0].Center[axis]);
      center[axis] = static_cast<double>(static_cast<float>(exact));
      rest[axis] = exact - center[axis];
    }
    const double area = factor * factor;
    SetTexel(this->GetTexel(0, index), center[0], center[1], center[2], area * slot.Area);
    SetTexel(this->GetTexel(1, index), rest[0], rest[1], rest[2], area * slot.Moment);
    SetTexel(this->GetTexel(2, index), factor * slot.Radius, slot.FirstPatch, slot.LastPatch,
      std::min(slot.Limit, LargestLimit));
    SetTexel(this->GetTexel(3, index), slot.FirstChild, slot.LastChild, slot.FirstPiece,
      slot.LastPiece);
    this->MostChildren = std::max(this->MostChildren, slot.LastChild - slot.FirstChild);
  }
  this->Pieces.assign(4 * body.Pieces.size(), 0.0f);
  for (std::size_t piece = 0; piece < body.Pieces.size(); ++piece)
  {
    this->Pieces[4 * piece] = static_cast<float>(body.Pieces[piece]);
  }
}

//------------------------------------------------------------------------------
// Children come after their parents.
void RefinementTables::FillSpreads(const Body& body)
{
  const double factor = this->LengthFactor;
  for (std::size_t index = body.Slots.size(); index-- > 0;)
  {
    const Slot& slot = body.Slots[index];
    float* below = this->GetTexel(4, index);
    const double own = factor * factor * slot.Moment;
    if (index >= static_cast<std::size_t>(body.NumberOfNodes))
    {
      SetTexel(below, own, own, 0.0);
      continue;
    }
    const float* first = this->GetTexel(4, slot.FirstChild);
    std::copy_n(first, 3, below);
    for (int child = slot.FirstChild; child < slot.LastChild; ++child)
    {
      const float* part = this->GetTexel(4, child);
      const double distance = factor * GetDistance(slot, body.Slots[child]);
      SetTexel(below, std::min(below[0], part[0]), std::max(below[1], part[1]),
        std::max(static_cast<double>(below[2]), part[2] + distance));
    }
    double mean = 0.0;
    double largest = 0.0;
    double farthest = 0.0;
    for (int k = slot.FirstPiece; k < slot.LastPiece; ++k)
    {
      const Slot& piece = body.Slots[body.Pieces[k]];
      mean += piece.Area / slot.Area * piece.Moment;
      largest = std::max(largest, piece.Moment);
      farthest = std::max(farthest, GetDistance(slot, piece));
    }
    SetTexel(this->GetTexel(5, index), factor * factor * mean, factor * factor * largest,
      factor * farthest);
  }
}

//------------------------------------------------------------------------------
void RefinementTables::FillProfile(const Body& body)
{
  const auto& table = body.Profile;
  this->SquaredCore =
    static_cast<float>(this->LengthFactor * this->LengthFactor * table.SquaredCore);
  this->FirstPiece =
    static_cast<int>(table.FirstPiece) - 2 * this->Exponent * (1 << table.PieceBits);
  this->Profile.assign(12 * table.Pieces.size(), 0.0f);
  float* texel = this->Profile.data();
  for (const auto& piece : table.Pieces)
  {
    for (const auto& coefficients : piece)
    {
      for (int band = 0; band < NumberOfBands; ++band)
      {
        texel[band] = static_cast<float>(this->GetValueFactor() * coefficients[band]);
      }
      texel += 4;
    }
  }
}

//------------------------------------------------------------------------------
/// Over a piece of the profile, in the shader's lengths.
struct RefinementTables::PieceBounds
{
  double Slopes[NumberOfBands] = {};     ///< at most
  double Curvatures[NumberOfBands] = {}; ///< in any direction, at most
  double LeastFall = 0.0;                ///< of logarithms, in the band where it is largest
  double LargestFall = 0.0;
};

//------------------------------------------------------------------------------
// The derivative by the squared distance d2 is linear in a piece. In space slopes are 2 d v', and
// curvatures 2 v' across and 2 v' + 4 d2 v'' along the distance.
RefinementTables::PieceBounds RefinementTables::BoundPiece(const Body& body,
  std::size_t piece) const
{
  const int placeBits = MantissaBits - body.Profile.PieceBits;
  const auto bits = static_cast<std::uint32_t>(this->FirstPiece + static_cast<int>(piece))
    << placeBits;
  const double begin = ReadBits(bits);
  const double length = ReadBits(bits + (1u << placeBits)) - begin;
  const double core = static_cast<double>(this->SquaredCore);
  const double near2 = std::max(begin - core, 0.0);
  const double far2 = begin + length - core;
  PieceBounds bounds;
  for (int band = 0; band < NumberOfBands; ++band)
  {
    const float* texels = this->Profile.data() + 12 * piece + band;
    const double value = texels[0];
    const double last = static_cast<double>(texels[0]) + texels[4] + texels[8];
    const double slope = texels[4] / length;
    const double lastSlope = (texels[4] + 2.0 * texels[8]) / length;
    const double bend = 2.0 * texels[8] / (length * length);
    const double steepest = std::max(std::abs(slope), std::abs(lastSlope));
    const double flattest =
      slope * lastSlope > 0.0 ? std::min(std::abs(slope), std::abs(lastSlope)) : 0.0;
    bounds.Slopes[band] = 2.0 * std::sqrt(far2) * steepest;
    bounds.Curvatures[band] = std::max({ 2.0 * steepest, std::abs(2.0 * slope + 4.0 * near2 * bend),
      std::abs(2.0 * lastSlope + 4.0 * far2 * bend) });
    const double least = std::min(value, last);
    const double largest = std::max(value, last);
    if (steepest > 0.0)
    {
      bounds.LargestFall =
        std::max(bounds.LargestFall, least > 0.0 ? bounds.Slopes[band] / least : Steepest);
    }
    if (largest > 0.0)
    {
      bounds.LeastFall = std::max(bounds.LeastFall, 2.0 * std::sqrt(near2) * flattest / largest);
    }
  }
  bounds.LargestFall = std::min(bounds.LargestFall, Steepest);
  return bounds;
}

//------------------------------------------------------------------------------
void RefinementTables::FillBounds(const Body& body)
{
  const std::size_t count = body.Profile.Pieces.size();
  Texels& largest = this->Bounds[0];
  Texels& others = this->Bounds[1];
  for (std::size_t piece = 0; piece < count; ++piece)
  {
    const PieceBounds bounds = this->BoundPiece(body, piece);
    for (int band = 0; band < NumberOfBands; ++band)
    {
      largest.push_back(static_cast<float>(bounds.Slopes[band]));
      others.push_back(static_cast<float>(bounds.Curvatures[band]));
    }
    largest.push_back(static_cast<float>(bounds.LargestFall));
    others.push_back(static_cast<float>(bounds.LeastFall));
  }
  // What reaches beyond the last piece is never asked for.
  for (std::size_t reach = 1; 2 * reach <= count; reach *= 2)
  {
    const std::size_t before = largest.size() / 4 - count;
    for (std::size_t piece = 0; piece < count; ++piece)
    {
      const std::size_t a = 4 * (before + piece);
      const std::size_t b = 4 * (before + std::min(piece + reach, count - 1));
      for (int k = 0; k < 4; ++k)
      {
        largest.push_back(std::max(largest[a + k], largest[b + k]));
        others.push_back(k < NumberOfBands ? std::max(others[a + k], others[b + k])
                                           : std::min(others[a + k], others[b + k]));
      }
    }
  }
}
} // namespace LightTransport
