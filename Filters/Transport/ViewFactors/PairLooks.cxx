// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/PairLooks.h"

#include "Scene/PatchScene.h"
#include "Support/Ranks.h"

namespace LightTransport
{
namespace
{
// Lists grow by this part of themselves: they are most of the memory.
constexpr std::size_t GrowthPart = 4;
} // namespace

//------------------------------------------------------------------------------
void PairLooks::Prepare(const PatchScene& scene, const Ranks& ranks, std::size_t units)
{
  if (this->Fingerprint == scene.GetFingerprint() && this->NumberOfRanks == ranks.GetNumber() &&
    this->Rank == ranks.GetMine() && this->Units.size() == units)
  {
    return;
  }
  this->Fingerprint = scene.GetFingerprint();
  this->NumberOfRanks = ranks.GetNumber();
  this->Rank = ranks.GetMine();
  this->Units = std::vector<Unit>(units);
}

//------------------------------------------------------------------------------
void PairLooks::Clear()
{
  *this = PairLooks();
}

//------------------------------------------------------------------------------
std::size_t PairLooks::Divide(Unit& unit, std::size_t place, int side, int children)
{
  if (unit[place].Children[side] == 0)
  {
    const std::size_t size = unit.size() + children;
    if (size > unit.capacity())
    {
      unit.reserve(size + size / GrowthPart);
    }
    unit[place].Children[side] = static_cast<std::uint32_t>(unit.size());
    unit.resize(size);
  }
  return unit[place].Children[side];
}

//------------------------------------------------------------------------------
double PairLooks::GetNumberOfBytes() const
{
  double looks = 0.0;
  for (const Unit& unit : this->Units)
  {
    looks += static_cast<double>(unit.capacity());
  }
  return looks * sizeof(Look);
}
} // namespace LightTransport
