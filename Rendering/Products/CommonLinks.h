// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The slots of a vtkExchangeHierarchy that most patches are linked with, as uniform links have them
 * (N. A. Carr, J. D. Hall, J. C. Hart, Graphics Hardware 2003): all of a link but its values is
 * constant, so that a table of values, slots x patches, is all there is to store. A slot is common
 * where its column of this table takes fewer bytes than the links that it replaces.
 *
 * A texel holds four links of one kernel, those of the kernels follow below each other, then come
 * the next four links. What slots send is handed to a program as constants, of which OpenGL 3.2
 * promises 16 KB: 1,024 links, a *round*. The values of a round are those of some lines of patches
 * to a texture.
 */
#ifndef CommonLinks_h
#define CommonLinks_h

#include <vector>

class vtkExchangeHierarchy;

namespace LightTransport
{
class CommonLinks
{
public:
  static constexpr int LinksPerTexel = 4;
  static constexpr int MostLinksPerRound = 1024;

  /// Links of a round, and of some lines of patches: a texture.
  struct Part
  {
    int Round;
    int FirstLine;
    int Lines;
  };

  /// `bytesPerLink` is what a link takes elsewhere.
  CommonLinks(const vtkExchangeHierarchy& hierarchy, double bytesPerLink, int width,
    int maximumHeight);

  /// A multiple of LinksPerTexel of them.
  const std::vector<int>& GetSlots() const { return this->Slots; }
  bool Has(int slot) const
  {
    return !this->Places.empty() && this->Places[static_cast<std::size_t>(slot)] >= 0;
  }

  const std::vector<Part>& GetParts() const { return this->Parts; }
  int GetNumberOfRounds() const;
  int GetNumberOfLinks(int round) const;
  /// That a line of patches takes in the texture of a round.
  int GetHeight(int round) const;

  /// Of a line of patches in the texture of a round: lines of texels, of four values each.
  std::vector<float> MakeValues(int round, int line) const;

private:
  void FindSlots(double bytesPerLink);
  void CutIntoParts();

  const vtkExchangeHierarchy& Hierarchy;
  const int Width;
  const int MaximumHeight;
  const int Kernels;
  const int LinksPerRound;
  std::vector<int> Slots;
  std::vector<int>
    Places; ///< of each slot among them, -1 where it is not; empty where there are none
  std::vector<Part> Parts;
};
} // namespace LightTransport

#endif
