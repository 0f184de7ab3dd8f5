// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Disjoint sets of the indices 0 to size - 1 (union and find).
#ifndef DisjointSets_h
#define DisjointSets_h

#include <cstddef>
#include <numeric>
#include <vector>

namespace LightTransport
{
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t size) : Parents(size)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0);
  }
  std::size_t Find(std::size_t index)
  {
    while (this->Parents[index] != index)
    {
      this->Parents[index] = this->Parents[this->Parents[index]];
      index = this->Parents[index];
    }
    return index;
  }
  void Join(std::size_t a, std::size_t b) { this->Parents[this->Find(a)] = this->Find(b); }

private:
  std::vector<std::size_t> Parents;
};
} // namespace LightTransport

#endif
