// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sobol' points in four dimensions, sixteen to a packet, for a scrambling of each patch's own: two
 * dimensions for where a ray starts on the patch, two for where it goes. The points of a packet lie
 * in one cell of directions before they are scrambled, and do so after it (OwenScrambling), so that
 * rays that are traced together go the same way.
 */
#ifndef RayPattern_h
#define RayPattern_h

#include <cstdint>
#include <vector>

namespace LightTransport
{
class RayPattern
{
public:
  static constexpr int Dimensions = 4;
  static constexpr int Lanes = 16;

  struct Packet
  {
    alignas(64) std::uint32_t Digits[Dimensions][Lanes]; ///< from the last to the first
    int Places[Lanes];                                   ///< of each point, from the first one on
    int Count;                                           ///< lanes that have a point
  };

  RayPattern() = default;
  /// Points `first` to `first` + `count`.
  RayPattern(int first, int count);

  int GetNumberOfPoints() const { return this->Count; }
  const std::vector<Packet>& GetPackets() const { return this->Packets; }

private:
  int Count = 0;
  std::vector<Packet> Packets;
};
} // namespace LightTransport

#endif
