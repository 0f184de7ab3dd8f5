// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What rays say of two blocks of patches: all hidden, all free, or nothing.

#include "ViewFactors/BlockRays.h"
#include "VisibilityTesting.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace LightTransport;

using namespace LightTransportTesting;
using namespace VisibilityTesting;

namespace
{
using Verdict = BlockRays::Verdict;
constexpr double Tolerance = 0.1;

//------------------------------------------------------------------------------
Corners MakeSquare(double x, double y, double z, double size, bool up)
{
  const Corners square{ { x, y, z }, { x + size, y, z }, { x + size, y + size, z },
    { x, y + size, z } };
  return up ? square : Corners(square.rbegin(), square.rend());
}

//------------------------------------------------------------------------------
// Two grids of 4 x 4 squares that face each other, far apart, and something in between.
std::vector<Corners> MakePlates(const std::vector<Corners>& between)
{
  std::vector<Corners> polygons = between;
  for (int k = 0; k < 16; ++k)
  {
    polygons.push_back(MakeSquare(0.25 * (k % 4), 0.25 * (k / 4), 0.0, 0.25, true));
    polygons.push_back(MakeSquare(0.25 * (k % 4), 0.25 * (k / 4), 4.0, 0.25, false));
  }
  return polygons;
}

//------------------------------------------------------------------------------
// How many pairs of one grid and the other are judged each way by all nodes that hold patches of
// one grid each; every pair exchanges `share` of its smaller area.
std::vector<double> CountVerdicts(const std::vector<Corners>& between, double share)
{
  PatchScene scene;
  BuildScene(MakePlates(between), scene);
  const BlockRays rays(scene, Tolerance);
  const PatchTree& tree = scene.GetTree();
  // Whether all patches of a node belong to the lower grid, or to the upper one.
  const auto isOf = [&](int node, bool upper)
  {
    const double place = upper ? tree.GetNode(0).Upper.z() : tree.GetNode(0).Lower.z();
    return std::abs(tree.GetNode(node).Lower.z() - place) < 1e-9 &&
      std::abs(tree.GetNode(node).Upper.z() - place) < 1e-9;
  };
  std::vector<double> counts(3, 0.0);
  std::function<void(int, int)> visit = [&](int i, int j)
  {
    if (isOf(i, false) && isOf(j, true))
    {
      const vtkIdType rows = tree.GetNode(i).GetSize();
      const vtkIdType columns = tree.GetNode(j).GetSize();
      const std::vector<float> values(rows * columns,
        static_cast<float>(share * scene.GetAreas()[tree.GetNode(i).First]));
      counts[static_cast<int>(rays.Ask(i, j, values.data(), columns))] +=
        static_cast<double>(rows * columns);
      return;
    }
    const bool first = !isOf(i, false) && !tree.GetNode(i).IsLeaf();
    if (!first && tree.GetNode(j).IsLeaf())
    {
      return;
    }
    for (int child = 0; child < 2; ++child)
    {
      visit(first ? tree.GetNode(i).Left + child : i, first ? j : tree.GetNode(j).Left + child);
    }
  };
  visit(0, 0);
  return counts;
}

//------------------------------------------------------------------------------
void CheckVerdicts(const std::vector<Corners>& between, double share, Verdict expected,
  const std::string& what)
{
  const std::vector<double> counts = CountVerdicts(between, share);
  const double sum = counts[0] + counts[1] + counts[2];
  Check(sum > 0.0, what + ": there are blocks");
  CheckClose(counts[static_cast<int>(expected)], sum, 0.0, what);
}
} // namespace

//------------------------------------------------------------------------------
int TestBlockRays(int, char*[])
{
  const std::vector<Corners> screen{ MakeSquare(-1, -1, 2, 3, true) };
  const std::vector<Corners> aside{ MakeSquare(2, -1, 2, 3, true) };
  std::vector<Corners> grid;
  for (int k = 0; k < 16; ++k)
  {
    grid.push_back({ { 0.0625 * k, 0, 2 }, { 0.0625 * k + 0.03125, 0, 2 },
      { 0.0625 * k + 0.03125, 1, 2 }, { 0.0625 * k, 1, 2 } });
  }
  CheckVerdicts(screen, 1e-4, Verdict::Hidden, "behind a screen");
  CheckVerdicts(aside, 1e-4, Verdict::Free, "beside a screen");
  CheckVerdicts(grid, 1e-4, Verdict::Unknown, "through bars");
  CheckVerdicts(screen, 0.06, Verdict::Unknown, "more than rays may judge");
  return Result();
}
