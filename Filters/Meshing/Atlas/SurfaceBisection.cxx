// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/SurfaceBisection.h"

#include "Atlas/PointDistances.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <unordered_map>
#include <utility>

namespace LightTransport
{
namespace
{
using Vector = AtlasSurface::Vector;

constexpr double Infinite = std::numeric_limits<double>::infinity();

// Edges sharper than this are creases. Crossing one at a right angle is as far as going this part
// of the way across the whole piece, so that level lines gather there; and to cut along it costs a
// fifth of what a cut elsewhere costs.
const double CreaseCosine = std::cos(30.0 * M_PI / 180.0);
constexpr double WidthOfCrease = 0.5;
constexpr double CostOfCrease = 0.2;

// How much a half that is e times too large or too small weighs against a longer cut: that much of
// the square root of the area of the piece.
constexpr double WeightOfBalance = 12.0;

// So large a part of the faces must be thin for distances to be found over their points.
constexpr double ManyThin = 0.5;

// A half has at least so many faces of each component that it has a part of: a single triangle
// has too few corners for a square.
constexpr std::size_t SmallestPart = 4;

//------------------------------------------------------------------------------
// 0 for no crease, 1 for a right angle, more beyond.
double GetSharpness(const Vector& a, const Vector& b)
{
  return std::max(0.0, (CreaseCosine - a.dot(b)) / CreaseCosine);
}
} // namespace

//------------------------------------------------------------------------------
struct SurfaceBisection::Cut
{
  double Score = Infinite;
  std::vector<char> Sides;
};

//------------------------------------------------------------------------------
SurfaceBisection::SurfaceBisection(const AtlasSurface& surface, const std::vector<int>& owners,
  std::vector<int>& local, const Watch& watch)
  : Surface(surface), Owners(owners), Local(local), Watcher(watch)
{
}

//------------------------------------------------------------------------------
std::array<std::vector<int>, 2> SurfaceBisection::Divide(const std::vector<int>& faces,
  double share, double density)
{
  this->Gather(faces);
  this->FindComponents();
  this->TieComponents();

  const bool apart = share <= 0.0 && this->NumberOfComponents > 1;
  const std::vector<char> sides =
    apart ? this->DivideComponents() : this->CutBetweenCorners(share, density);
  std::array<std::vector<int>, 2> halves;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    halves[sides[i]].push_back(faces[i]);
  }
  return halves;
}

//------------------------------------------------------------------------------
// Half of the components, in their order, on each side: whole ones, whatever their areas.
std::vector<char> SurfaceBisection::DivideComponents() const
{
  std::vector<char> sideOfComponent(this->NumberOfComponents, 0);
  for (std::size_t i = this->TiedFaces.size() / 2; i < this->TiedFaces.size(); ++i)
  {
    sideOfComponent[this->Components[this->TiedFaces[i]]] = 1;
  }
  std::vector<char> sides(this->Faces.size());
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    sides[i] = sideOfComponent[this->Components[i]];
  }
  return sides;
}

//------------------------------------------------------------------------------
std::vector<char> SurfaceBisection::CutBetweenCorners(double share, double density) const
{
  const std::array<std::array<double, 4>, 4> candidates = { { { 1, -1, 0, 0 }, { 0, 0, 1, -1 },
    { 1, -1, 1, -1 }, { 1, -1, -1, 1 } } };
  Cut best;
  std::vector<double> values(this->Faces.size());
  for (const bool overPoints : { false, true })
  {
    if (overPoints && !this->IsThin)
    {
      continue;
    }
    const std::array<std::vector<double>, 4> d = this->FindDistancesFromCorners(overPoints);
    for (const std::array<double, 4>& signs : candidates)
    {
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        values[i] =
          signs[0] * d[0][i] + signs[1] * d[1][i] + signs[2] * d[2][i] + signs[3] * d[3][i];
      }
      Cut cut = this->FindBestCut(values, share, density);
      if (best.Sides.empty() || cut.Score < best.Score)
      {
        best = std::move(cut);
      }
    }
  }

  this->Smooth(best.Sides);
  for (const char side : { 0, 1, 0 })
  {
    this->JoinCrumbs(best.Sides, side);
  }
  return best.Sides;
}

//------------------------------------------------------------------------------
void SurfaceBisection::Gather(const std::vector<int>& faces)
{
  this->Faces = faces;
  this->Neighbors = this->Surface.GetNeighborsWithin(faces, this->Owners, this->Local);
  this->Area = 0.0;
  std::size_t numberOfThin = 0;
  for (const int face : faces)
  {
    this->Area += this->Surface.Areas[face];
    numberOfThin += this->Surface.IsThin(face);
  }
  this->IsThin = static_cast<double>(numberOfThin) > ManyThin * static_cast<double>(faces.size());
  this->Crease = WidthOfCrease * std::sqrt(this->Area);
}

//------------------------------------------------------------------------------
void SurfaceBisection::FindComponents()
{
  this->Components.assign(this->Faces.size(), -1);
  this->NumberOfComponents = 0;
  this->TiedFaces.clear();
  std::vector<int> stack;
  for (int first = 0; first < static_cast<int>(this->Faces.size()); ++first)
  {
    if (this->Components[first] >= 0)
    {
      continue;
    }
    this->TiedFaces.push_back(first);
    this->Components[first] = this->NumberOfComponents;
    stack.push_back(first);
    while (!stack.empty())
    {
      const int face = stack.back();
      stack.pop_back();
      for (const int neighbor : this->Neighbors[face])
      {
        if (neighbor >= 0 && this->Components[neighbor] < 0)
        {
          this->Components[neighbor] = this->NumberOfComponents;
          stack.push_back(neighbor);
        }
      }
    }
    ++this->NumberOfComponents;
  }
}

//------------------------------------------------------------------------------
// Put one face of each component into an order in which neighbours are near: along the longest side
// of their box.
void SurfaceBisection::TieComponents()
{
  Eigen::AlignedBox3d box;
  for (const int face : this->TiedFaces)
  {
    box.extend(this->Surface.Centers[this->Faces[face]]);
  }
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::sort(this->TiedFaces.begin(), this->TiedFaces.end(),
    [this, axis](int a, int b)
    {
      const double x = this->Surface.Centers[this->Faces[a]][axis];
      const double y = this->Surface.Centers[this->Faces[b]][axis];
      return x != y ? x < y : a < b;
    });
}

//------------------------------------------------------------------------------
// The distance of a face's neighbour from where the face is at `distance`.
double SurfaceBisection::GetDistanceAcross(int face, int edge, double distance) const
{
  const int global = this->Faces[face];
  const int other = this->Faces[this->Neighbors[face][edge]];
  const Vector middle = this->Surface.GetEdgeMiddle(global, edge);
  return distance + (this->Surface.Centers[global] - middle).norm() +
    (this->Surface.Centers[other] - middle).norm() +
    this->Crease * GetSharpness(this->Surface.Normals[global], this->Surface.Normals[other]);
}

//------------------------------------------------------------------------------
double SurfaceBisection::GetTie(int from, int to) const
{
  return (this->Surface.Centers[this->Faces[from]] - this->Surface.Centers[this->Faces[to]]).norm();
}

//------------------------------------------------------------------------------
// Ties join faces of different components, in a chain; so the components are done in its order,
// away from the first on both sides. Calls reach(face, face before or -1).
template <typename Visitor>
void SurfaceBisection::FollowTies(int start, const Visitor& reach) const
{
  const auto place = std::find_if(this->TiedFaces.begin(), this->TiedFaces.end(),
    [&](int face) { return this->Components[face] == this->Components[start]; });
  const auto follow = [&](auto first, auto last)
  {
    for (auto next = first; next != last; ++next)
    {
      reach(*next, *(next - 1));
    }
  };
  reach(start, -1);
  follow(place + 1, this->TiedFaces.end());
  const auto back = std::make_reverse_iterator(place);
  follow(back, this->TiedFaces.rend());
}

//------------------------------------------------------------------------------
// Distances from one face to all others, from centre to centre through the middles of edges.
std::vector<double> SurfaceBisection::FindDistances(int start) const
{
  using Entry = std::pair<double, int>;
  std::vector<double> distances(this->Faces.size(), Infinite);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  const auto reach = [&](int face, double distance)
  {
    if (distance < distances[face])
    {
      distances[face] = distance;
      queue.emplace(distance, face);
    }
  };
  const auto settle = [&]()
  {
    while (!queue.empty())
    {
      this->Watcher.Check();
      const Entry entry = queue.top();
      queue.pop();
      const int face = entry.second;
      if (entry.first > distances[face])
      {
        continue;
      }
      for (int edge = 0; edge < 3; ++edge)
      {
        const int neighbor = this->Neighbors[face][edge];
        if (neighbor >= 0)
        {
          reach(neighbor, this->GetDistanceAcross(face, edge, entry.first));
        }
      }
    }
  };
  this->FollowTies(start,
    [&](int face, int from)
    {
      reach(face, from < 0 ? 0.0 : distances[from] + this->GetTie(from, face));
      settle();
    });
  return distances;
}

//------------------------------------------------------------------------------
std::vector<std::array<double, 3>> SurfaceBisection::FindCostsOfCreases() const
{
  std::vector<std::array<double, 3>> costs(this->Faces.size(), { 0.0, 0.0, 0.0 });
  for (std::size_t face = 0; face < costs.size(); ++face)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const int neighbor = this->Neighbors[face][edge];
      costs[face][edge] = neighbor < 0 ? 0.0
                                       : this->Crease *
          GetSharpness(this->Surface.Normals[this->Faces[face]],
            this->Surface.Normals[this->Faces[neighbor]]);
    }
  }
  return costs;
}

//------------------------------------------------------------------------------
// As above, for pieces with thin faces.
std::vector<double> SurfaceBisection::FindDistancesOverPoints(int start) const
{
  const std::vector<std::array<double, 3>> costs = this->FindCostsOfCreases();
  PointDistances distances(this->Surface, this->Faces, this->Neighbors, costs, this->Watcher);
  this->FollowTies(start,
    [&](int face, int from)
    {
      distances.Reach(face,
        from < 0 ? 0.0 : distances.GetDistance(from) + this->GetTie(from, face));
    });
  std::vector<double> result;
  for (int face = 0; face < static_cast<int>(this->Faces.size()); ++face)
  {
    result.push_back(distances.GetDistance(face));
  }
  this->LevelBundles(result);
  return result;
}

//------------------------------------------------------------------------------
// Give all faces of a bundle their mean value.
void SurfaceBisection::LevelBundles(std::vector<double>& values) const
{
  std::unordered_map<int, std::pair<double, double>> sums;
  for (std::size_t face = 0; face < values.size(); ++face)
  {
    std::pair<double, double>& sum = sums[this->Surface.GetBundle(this->Faces[face])];
    sum.first += values[face];
    sum.second += 1.0;
  }
  for (std::size_t face = 0; face < values.size(); ++face)
  {
    const int bundle = this->Surface.GetBundle(this->Faces[face]);
    if (bundle >= 0)
    {
      values[face] = sums[bundle].first / sums[bundle].second;
    }
  }
}

//------------------------------------------------------------------------------
// Each corner is the face that is farthest from those before.
std::array<std::vector<double>, 4> SurfaceBisection::FindDistancesFromCorners(bool overPoints) const
{
  const auto findFarthest = [](const std::vector<double>& distances)
  {
    return static_cast<int>(
      std::max_element(distances.begin(), distances.end()) - distances.begin());
  };
  std::array<std::vector<double>, 4> distances;
  const auto find = [this, overPoints](int start)
  { return overPoints ? this->FindDistancesOverPoints(start) : this->FindDistances(start); };
  int corner = findFarthest(find(0));
  std::vector<double> nearest(this->Faces.size(), Infinite);
  for (std::vector<double>& values : distances)
  {
    values = find(corner);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      nearest[i] = std::min(nearest[i], values[i]);
    }
    corner = findFarthest(nearest);
  }
  return distances;
}

//------------------------------------------------------------------------------
// What it costs to cut before each rank: the length of the edges between lower and higher ranks.
std::vector<double> SurfaceBisection::FindCosts(const std::vector<int>& ranks) const
{
  std::vector<double> costs(ranks.size() + 1, 0.0);
  for (std::size_t i = 0; i < ranks.size(); ++i)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const int neighbor = this->Neighbors[i][edge];
      if (neighbor > static_cast<int>(i))
      {
        const double cost = this->GetCost(static_cast<int>(i), edge);
        costs[std::min(ranks[i], ranks[neighbor]) + 1] += cost;
        costs[std::max(ranks[i], ranks[neighbor]) + 1] -= cost;
      }
    }
  }
  std::partial_sum(costs.begin(), costs.end(), costs.begin());
  return costs;
}

//------------------------------------------------------------------------------
double SurfaceBisection::GetCost(int face, int edge) const
{
  const int global = this->Faces[face];
  const int other = this->Faces[this->Neighbors[face][edge]];
  const double sharpness =
    GetSharpness(this->Surface.Normals[global], this->Surface.Normals[other]);
  return this->Surface.GetEdgeLength(global, edge) *
    std::max(CostOfCrease, 1.0 - (1.0 - CostOfCrease) * sharpness);
}

//------------------------------------------------------------------------------
SurfaceBisection::Cut SurfaceBisection::FindBestCut(const std::vector<double>& values, double share,
  double density) const
{
  const std::size_t size = values.size();
  std::vector<int> order(size);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&](int a, int b)
    {
      this->Watcher.Check();
      return values[a] != values[b] ? values[a] < values[b] : a < b;
    });
  std::vector<int> ranks(size);
  for (std::size_t i = 0; i < size; ++i)
  {
    ranks[order[i]] = static_cast<int>(i);
  }
  const std::vector<double> costs = this->FindCosts(ranks);

  // In the middle where no cut is better than another: one face may have all of the area.
  Cut best;
  std::size_t rank = size / 2;
  double area = 0.0;
  for (std::size_t i = 1; i < size; ++i)
  {
    area += this->Surface.Areas[this->Faces[order[i - 1]]];
    const double part = area / this->Area;
    const double low = std::log(2.0 * density * part);
    const double high = std::log(2.0 * density * (1.0 - part));
    double score =
      costs[i] / std::sqrt(this->Area) + WeightOfBalance * 0.5 * (low * low + high * high);
    const double miss = share - std::min(part, 1.0 - part);
    if (miss > 0.0)
    {
      // Far beyond all others, and the less the better.
      score += 1e6 * (1.0 + miss);
    }
    if (score < best.Score)
    {
      best.Score = score;
      rank = i;
    }
  }
  best.Sides.resize(size);
  for (std::size_t i = 0; i < size; ++i)
  {
    best.Sides[i] = ranks[i] >= static_cast<int>(rank);
  }
  return best;
}

//------------------------------------------------------------------------------
// Shorten the cut: a face that hangs on its side by one edge at most goes to the other side where
// that costs less. No side can fall apart by this, and the cost falls, so it ends.
void SurfaceBisection::Smooth(std::vector<char>& sides) const
{
  std::vector<int> queue(sides.size());
  std::iota(queue.begin(), queue.end(), 0);
  while (!queue.empty())
  {
    this->Watcher.Check();
    const int face = queue.back();
    queue.pop_back();
    double gain = 0.0;
    int own = 0;
    for (int edge = 0; edge < 3; ++edge)
    {
      const int neighbor = this->Neighbors[face][edge];
      if (neighbor >= 0)
      {
        const bool same = sides[neighbor] == sides[face];
        own += same;
        gain += (same ? -1.0 : 1.0) * this->GetCost(face, edge);
      }
    }
    if (own <= 1 && gain > 1e-12 * std::sqrt(this->Area))
    {
      sides[face] = !sides[face];
      for (const int neighbor : this->Neighbors[face])
      {
        if (neighbor >= 0)
        {
          queue.push_back(neighbor);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// Of each component, one side keeps its largest connected part; the others go to the other side,
// and so does the largest when it is too small for a chart.
void SurfaceBisection::JoinCrumbs(std::vector<char>& sides, char side) const
{
  std::vector<int> parts(sides.size(), -1);
  std::vector<std::vector<int>> members;
  std::vector<int> largest(this->NumberOfComponents, -1);
  std::vector<double> areas;
  std::vector<std::size_t> sizes(this->NumberOfComponents, 0);
  for (int first = 0; first < static_cast<int>(sides.size()); ++first)
  {
    this->Watcher.Check();
    ++sizes[this->Components[first]];
    if (sides[first] != side || parts[first] >= 0)
    {
      continue;
    }
    const int part = static_cast<int>(members.size());
    members.emplace_back(1, first);
    areas.push_back(0.0);
    parts[first] = part;
    for (std::size_t i = 0; i < members[part].size(); ++i)
    {
      const int face = members[part][i];
      areas[part] += this->Surface.Areas[this->Faces[face]];
      for (const int neighbor : this->Neighbors[face])
      {
        if (neighbor >= 0 && sides[neighbor] == side && parts[neighbor] < 0)
        {
          parts[neighbor] = part;
          members[part].push_back(neighbor);
        }
      }
    }
    int& candidate = largest[this->Components[first]];
    candidate = candidate < 0 || areas[part] > areas[candidate] ? part : candidate;
  }
  for (std::size_t part = 0; part < members.size(); ++part)
  {
    const int component = this->Components[members[part].front()];
    const std::size_t size = members[part].size();
    const bool kept = largest[component] == static_cast<int>(part) &&
      (size >= SmallestPart || size == sizes[component]);
    for (std::size_t i = 0; i < size && !kept; ++i)
    {
      sides[members[part][i]] = !side;
    }
  }
}
} // namespace LightTransport
