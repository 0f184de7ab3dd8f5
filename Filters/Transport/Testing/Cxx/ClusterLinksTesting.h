// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Rows of links between patches and clusters, as scattering has them: patches at random places of
/// a cube in a binary tree, values that fall with the distance, differently in each kernel.
#ifndef ClusterLinksTesting_h
#define ClusterLinksTesting_h

#include "LightTransportTesting.h"
#include "vtkExchangeHierarchy.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace LightTransportTesting
{
class ClusterLinks
{
public:
  ClusterLinks(int patches, int kernels) : Kernels(kernels)
  {
    std::mt19937 generator(17);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int patch = 0; patch < patches; ++patch)
    {
      const double x = uniform(generator);
      const double y = uniform(generator);
      this->Centers.push_back({ x, y, uniform(generator) });
      this->Areas.push_back((0.5 + uniform(generator)) / patches);
    }
    this->MakeTree();
  }

  /// Links of each patch with itself and its neighbours, and with clusters that look at most
  /// `opening` wide.
  vtkSmartPointer<vtkExchangeHierarchy> MakeAdaptive(double opening, int part = 0,
    int parts = 1) const
  {
    return this->Make(part, parts,
      [&](int patch, std::vector<int>& columns) { this->Collect(0, patch, opening, columns); });
  }

  /// Links of all patches with the same clusters, as many nodes of one level as there are.
  vtkSmartPointer<vtkExchangeHierarchy> MakeUniform(int level) const
  {
    return this->Make(0, 1,
      [&](int, std::vector<int>& columns)
      {
        for (int node = (1 << level) - 1; node < (2 << level) - 1; ++node)
        {
          columns.push_back(node);
        }
      });
  }

  /// Likewise, but for the cluster that holds the receiver: it is divided down to patches.
  vtkSmartPointer<vtkExchangeHierarchy> MakeUniformAround(int level) const
  {
    return this->Make(0, 1,
      [&](int patch, std::vector<int>& columns)
      {
        for (int node = (1 << level) - 1; node < (2 << level) - 1; ++node)
        {
          const Range range = this->Ranges[node];
          const bool holds = range.First <= patch && patch < range.Last;
          holds ? this->Collect(node, patch, 0.0, columns) : columns.push_back(node);
        }
      });
  }

  int GetNumberOfPatches() const { return static_cast<int>(this->Areas.size()); }

private:
  using Node = vtkExchangeHierarchy::Node;
  using Point = std::array<double, 3>;

  struct Range
  {
    int First;
    int Last;
  };

  // Breadth first; each range is cut in half along an axis that changes with the level.
  void MakeTree()
  {
    const int patches = this->GetNumberOfPatches();
    this->Ranges = { { 0, patches } };
    std::vector<int> depths = { 0 };
    for (std::size_t node = 0; node < this->Ranges.size(); ++node)
    {
      const Range range = this->Ranges[node];
      const int axis = depths[node] % 3;
      const int middle = (range.First + range.Last) / 2;
      if (range.Last - range.First <= 4)
      {
        this->Nodes.push_back({ -1 - range.First, -1 - range.Last });
        continue;
      }
      std::nth_element(this->Centers.begin() + range.First, this->Centers.begin() + middle,
        this->Centers.begin() + range.Last,
        [&](const Point& a, const Point& b) { return a[axis] < b[axis]; });
      const int first = static_cast<int>(this->Ranges.size());
      this->Nodes.push_back({ first, first + 2 });
      this->Ranges.push_back({ range.First, middle });
      this->Ranges.push_back({ middle, range.Last });
      depths.insert(depths.end(), 2, depths[node] + 1);
    }
    const int count = static_cast<int>(this->Nodes.size());
    for (Node& node : this->Nodes)
    {
      node = node.First < 0 ? Node{ count - 1 - node.First, count - 1 - node.Last } : node;
    }
    for (int patch = 0; patch < patches; ++patch)
    {
      this->Ranges.push_back({ patch, patch + 1 });
    }
  }

  Point GetCenter(int slot) const
  {
    const Range range = this->Ranges[slot];
    Point mean = {};
    for (int patch = range.First; patch < range.Last; ++patch)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        mean[axis] += this->Centers[patch][axis] / (range.Last - range.First);
      }
    }
    return mean;
  }

  double GetDistance(int slot, int patch) const
  {
    const Point center = this->GetCenter(slot);
    const Point& other = this->Centers[patch];
    return std::hypot(center[0] - other[0], center[1] - other[1], center[2] - other[2]);
  }

  double GetSize(int slot) const
  {
    const Range range = this->Ranges[slot];
    return std::cbrt(static_cast<double>(range.Last - range.First) / this->GetNumberOfPatches());
  }

  void Collect(int slot, int patch, double opening, std::vector<int>& columns) const
  {
    const int nodes = static_cast<int>(this->Nodes.size());
    const double distance = this->GetDistance(slot, patch);
    if (slot >= nodes || this->GetSize(slot) < opening * distance)
    {
      columns.push_back(slot);
      return;
    }
    for (int child = this->Nodes[slot].First; child < this->Nodes[slot].Last; ++child)
    {
      this->Collect(child, patch, opening, columns);
    }
  }

  // Rows of this part of the patches.
  template <typename Fill>
  vtkSmartPointer<vtkExchangeHierarchy> Make(int part, int parts, Fill&& fill) const
  {
    auto hierarchy = vtkSmartPointer<vtkExchangeHierarchy>::New();
    Check(hierarchy->SetTree(this->Areas, this->Nodes, part, parts, this->Kernels), "a tree");
    std::vector<std::int64_t> offsets(this->Nodes.size() + 1, 0);
    std::vector<int> columns;
    std::vector<float> values;
    for (int patch = 0; patch < this->GetNumberOfPatches(); ++patch)
    {
      std::vector<int> row;
      if (patch * parts / this->GetNumberOfPatches() == part)
      {
        fill(patch, row);
      }
      for (const int slot : row)
      {
        const double distance = this->GetDistance(slot, patch);
        for (int kernel = 0; kernel < this->Kernels; ++kernel)
        {
          const double decay = 4.0 + 3.0 * kernel;
          values.push_back(
            static_cast<float>(std::exp(-decay * distance) / (0.02 + distance * distance)));
        }
      }
      columns.insert(columns.end(), row.begin(), row.end());
      offsets.push_back(static_cast<std::int64_t>(columns.size()));
    }
    Check(hierarchy->SetRows(offsets, columns, values), "rows");
    return hierarchy;
  }

  int Kernels;
  std::vector<Point> Centers;
  std::vector<double> Areas;
  std::vector<Node> Nodes;
  std::vector<Range> Ranges; ///< patches below each slot
};
} // namespace LightTransportTesting

#endif
