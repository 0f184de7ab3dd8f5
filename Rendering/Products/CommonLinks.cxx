// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Products/CommonLinks.h"

#include "Textures/FloatTextures.h"
#include "vtkExchangeHierarchy.h"

#include <algorithm>
#include <cstdint>

namespace LightTransport
{
//------------------------------------------------------------------------------
CommonLinks::CommonLinks(const vtkExchangeHierarchy& hierarchy, double bytesPerLink, int width,
  int maximumHeight)
  : Hierarchy(hierarchy), Width(width), MaximumHeight(maximumHeight),
    Kernels(hierarchy.GetNumberOfKernels()),
    LinksPerRound(std::min(MostLinksPerRound, LinksPerTexel * (maximumHeight / Kernels)))
{
  if (!hierarchy.GetOffsets().empty() && this->LinksPerRound > 0)
  {
    this->FindSlots(bytesPerLink);
    this->CutIntoParts();
  }
}

//------------------------------------------------------------------------------
// In ascending order; the rarest stay rows where they do not fill a texel.
void CommonLinks::FindSlots(double bytesPerLink)
{
  const int nodes = this->Hierarchy.GetNumberOfNodes();
  const auto patches = static_cast<double>(this->Hierarchy.GetNumberOfPatches());
  std::vector<int> counts(static_cast<std::size_t>(this->Hierarchy.GetNumberOfSlots()), 0);
  const std::vector<int>& columns = this->Hierarchy.GetColumns();
  std::for_each(columns.begin() + this->Hierarchy.GetOffsets()[static_cast<std::size_t>(nodes)],
    columns.end(), [&](int column) { ++counts[static_cast<std::size_t>(column)]; });
  const double fewest = sizeof(float) * this->Kernels * patches / bytesPerLink;
  for (int slot = 0; slot < this->Hierarchy.GetNumberOfSlots(); ++slot)
  {
    if (counts[static_cast<std::size_t>(slot)] > fewest)
    {
      this->Slots.push_back(slot);
    }
  }
  std::stable_sort(this->Slots.begin(), this->Slots.end(),
    [&](int a, int b)
    { return counts[static_cast<std::size_t>(a)] > counts[static_cast<std::size_t>(b)]; });
  this->Slots.resize(this->Slots.size() / LinksPerTexel * LinksPerTexel);
  std::sort(this->Slots.begin(), this->Slots.end());
  if (!this->Slots.empty())
  {
    this->Places.assign(counts.size(), -1);
  }
  for (std::size_t place = 0; place < this->Slots.size(); ++place)
  {
    this->Places[static_cast<std::size_t>(this->Slots[place])] = static_cast<int>(place);
  }
}

//------------------------------------------------------------------------------
void CommonLinks::CutIntoParts()
{
  const int lines = FloatTextures::DivideUp(this->Hierarchy.GetNumberOfPatches(), this->Width);
  for (int round = 0; round < this->GetNumberOfRounds(); ++round)
  {
    const int most = this->MaximumHeight / this->GetHeight(round);
    for (int line = 0; line < lines; line += most)
    {
      this->Parts.push_back({ round, line, std::min(most, lines - line) });
    }
  }
}

//------------------------------------------------------------------------------
int CommonLinks::GetNumberOfRounds() const
{
  return this->Slots.empty()
    ? 0
    : FloatTextures::DivideUp(static_cast<vtkIdType>(this->Slots.size()), this->LinksPerRound);
}

//------------------------------------------------------------------------------
int CommonLinks::GetNumberOfLinks(int round) const
{
  return std::min(this->LinksPerRound,
    static_cast<int>(this->Slots.size()) - round * this->LinksPerRound);
}

//------------------------------------------------------------------------------
int CommonLinks::GetHeight(int round) const
{
  return this->GetNumberOfLinks(round) / LinksPerTexel * this->Kernels;
}

//------------------------------------------------------------------------------
// Links of a row with the same slot add up.
std::vector<float> CommonLinks::MakeValues(int round, int line) const
{
  std::vector<float> texels(std::size_t(4) * this->Width * this->GetHeight(round), 0.0f);
  const int begin = round * this->LinksPerRound;
  const int end = begin + this->GetNumberOfLinks(round);
  const int nodes = this->Hierarchy.GetNumberOfNodes();
  const auto patches = static_cast<int>(this->Hierarchy.GetNumberOfPatches());
  const int first = line * this->Width;
  for (int patch = first; patch < std::min(first + this->Width, patches); ++patch)
  {
    const auto [firstLink, lastLink] = this->Hierarchy.GetRow(nodes + patch);
    for (std::int64_t link = firstLink; link < lastLink; ++link)
    {
      const auto source = static_cast<std::size_t>(link);
      const int place =
        this->Places[static_cast<std::size_t>(this->Hierarchy.GetColumns()[source])];
      if (place < begin || place >= end)
      {
        continue;
      }
      const int quad = (place - begin) / LinksPerTexel;
      for (int kernel = 0; kernel < this->Kernels; ++kernel)
      {
        const std::size_t texel =
          static_cast<std::size_t>(quad * this->Kernels + kernel) * this->Width + patch - first;
        texels[4 * texel + place % LinksPerTexel] +=
          this->Hierarchy.GetValues()[source * this->Kernels + kernel];
      }
    }
  }
  return texels;
}
} // namespace LightTransport
