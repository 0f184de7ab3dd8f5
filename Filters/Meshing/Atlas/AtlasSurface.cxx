// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/AtlasSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <unordered_set>

namespace LightTransport
{
namespace
{
// An edge is halved when it is longer than this part of the square root of the area of the
// surface, or of its component; but never into more pieces than the last number says.
constexpr double EdgesAcrossSurface = 24.0;
constexpr double EdgesAcrossComponent = 4.0;
constexpr double MaximumPiecesOfEdge = 64.0;

// The diagonal between two rungs of a narrow ladder is as much longer than the piece between them.
constexpr double LengthOfDiagonal = 1.05;

// Nor is it halved when it is shorter than so many steps between neighbouring numbers of the size
// of the coordinates: its middle must differ from its ends.
constexpr double LeastStepsOfEdge = 1024.0;

// The height of a thin triangle is less than this part of its longest side.
constexpr double HeightOfThin = 0.1;
constexpr double CosineWithinBundle = 0.87;

// Beyond this an atlas takes more than a few minutes and a few gigabytes.
constexpr std::size_t MostTriangles = 20000000;
// Small inputs must not take minutes to hear that they are refused: so many for each of theirs, but
// a few seconds' worth for any.
constexpr std::size_t MostPerTriangle = 256;
constexpr std::size_t TrianglesForAny = 1000000;
// Each pass looks at all triangles, and may halve few of them: so many times the most, in all.
constexpr std::size_t MostPasses = 20;

//------------------------------------------------------------------------------
std::uint64_t MakeKey(std::size_t a, std::size_t b)
{
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) |
    static_cast<std::uint64_t>(std::max(a, b));
}
} // namespace

//------------------------------------------------------------------------------
Outcome AtlasSurface::Build(const TriangleSoup& soup, const Watch& watch)
{
  this->Points = soup.Points;
  this->Triangles = soup.Triangles;
  this->Sources.resize(soup.Triangles.size());
  std::iota(this->Sources.begin(), this->Sources.end(), 0);
  this->FindGeometry();
  if (Outcome checked = this->CheckAreas(soup); !checked)
  {
    return checked;
  }
  this->FindNeighbors(watch);
  std::vector<double> longest = this->FindLongestEdges(watch);
  const std::size_t most =
    std::clamp(MostPerTriangle * soup.Triangles.size(), TrianglesForAny, MostTriangles);
  std::size_t looks = 0;
  while (this->HalveLongEdges(longest, watch))
  {
    looks += this->Triangles.size();
    if (this->Triangles.size() > most || looks > MostPasses * most)
    {
      return Outcome::Failed("The surface has " + std::to_string(soup.Triangles.size()) +
        " triangles, and too many (" + std::to_string(this->Triangles.size()) +
        " so far) once the edges are halved that are long beside it or beside its parts: pass it "
        "through "
        "vtkPatchMesher first, or remove small parts.");
    }
    this->FindNeighbors(watch);
  }
  this->FindGeometry();
  this->FindBundles(watch);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
double AtlasSurface::GetEdgeLength(int face, int edge) const
{
  const TriangleSoup::Triangle& triangle = this->Triangles[face];
  return (this->GetPoint(triangle[edge]) - this->GetPoint(triangle[(edge + 1) % 3])).norm();
}

//------------------------------------------------------------------------------
AtlasSurface::Vector AtlasSurface::GetEdgeMiddle(int face, int edge) const
{
  const TriangleSoup::Triangle& triangle = this->Triangles[face];
  return 0.5 * (this->GetPoint(triangle[edge]) + this->GetPoint(triangle[(edge + 1) % 3]));
}

//------------------------------------------------------------------------------
std::vector<std::array<int, 3>> AtlasSurface::GetNeighborsWithin(const std::vector<int>& faces,
  const std::vector<int>& owners, std::vector<int>& local) const
{
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    local[faces[i]] = static_cast<int>(i);
  }
  std::vector<std::array<int, 3>> neighbors(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const int neighbor = this->Neighbors[faces[i]][edge];
      const bool inside = neighbor >= 0 && owners[neighbor] == owners[faces[i]];
      neighbors[i][edge] = inside ? local[neighbor] : -1;
    }
  }
  return neighbors;
}

//------------------------------------------------------------------------------
void AtlasSurface::FindNeighbors(const Watch& watch)
{
  struct Side
  {
    std::uint64_t Key;
    int Face;
    int Edge;
  };
  std::vector<Side> sides;
  sides.reserve(3 * this->Triangles.size());
  for (int face = 0; face < this->GetNumberOfFaces(); ++face)
  {
    const TriangleSoup::Triangle& triangle = this->Triangles[face];
    for (int edge = 0; edge < 3; ++edge)
    {
      sides.push_back({ MakeKey(triangle[edge], triangle[(edge + 1) % 3]), face, edge });
    }
  }
  std::sort(sides.begin(), sides.end(),
    [&watch](const Side& a, const Side& b)
    {
      watch.Check();
      return a.Key < b.Key;
    });
  this->Neighbors.assign(this->Triangles.size(), { -1, -1, -1 });
  for (std::size_t i = 0; i + 1 < sides.size(); ++i)
  {
    if (sides[i].Key == sides[i + 1].Key)
    {
      this->Neighbors[sides[i].Face][sides[i].Edge] = sides[i + 1].Face;
      this->Neighbors[sides[i + 1].Face][sides[i + 1].Edge] = sides[i].Face;
    }
  }
}

//------------------------------------------------------------------------------
void AtlasSurface::FindGeometry()
{
  const std::size_t size = this->Triangles.size();
  this->Areas.resize(size);
  this->Normals.resize(size);
  this->Centers.resize(size);
  this->Area = 0.0;
  for (std::size_t i = 0; i < size; ++i)
  {
    const Vector a = this->GetPoint(this->Triangles[i][0]);
    const Vector b = this->GetPoint(this->Triangles[i][1]);
    const Vector c = this->GetPoint(this->Triangles[i][2]);
    const Vector normal = (b - a).cross(c - a);
    this->Areas[i] = 0.5 * normal.norm();
    this->Normals[i] = normal.normalized();
    this->Centers[i] = (a + b + c) / 3.0;
    this->Area += this->Areas[i];
  }
}

//------------------------------------------------------------------------------
double AtlasSurface::GetLongestEdge(int face) const
{
  return std::max(
    { this->GetEdgeLength(face, 0), this->GetEdgeLength(face, 1), this->GetEdgeLength(face, 2) });
}

//------------------------------------------------------------------------------
// Grow each bundle from one face to both sides, across long edges.
void AtlasSurface::FindBundles(const Watch& watch)
{
  const int none = -1;
  const int free = -2;
  this->Bundles.assign(this->Triangles.size(), none);
  for (int face = 0; face < this->GetNumberOfFaces(); ++face)
  {
    const double longest = this->GetLongestEdge(face);
    this->Bundles[face] = 2.0 * this->Areas[face] < HeightOfThin * longest * longest ? free : none;
  }
  std::vector<int> bundle;
  for (int first = 0; first < this->GetNumberOfFaces(); ++first)
  {
    if (this->Bundles[first] != free)
    {
      continue;
    }
    const double longest = this->GetLongestEdge(first);
    bundle.assign(1, first);
    this->Bundles[first] = first;
    double area = this->Areas[first];
    int beside = none;
    for (std::size_t i = 0; i < bundle.size(); ++i)
    {
      watch.Check();
      for (int edge = 0; edge < 3; ++edge)
      {
        const int neighbor = this->Neighbors[bundle[i]][edge];
        if (neighbor < 0 || this->Bundles[neighbor] == none ||
          this->GetEdgeLength(bundle[i], edge) < 0.5 * longest ||
          this->Normals[neighbor].dot(this->Normals[bundle[i]]) < CosineWithinBundle)
        {
          continue;
        }
        if (this->Bundles[neighbor] != free)
        {
          beside = this->Bundles[neighbor] != first ? this->Bundles[neighbor] : beside;
        }
        else if (area < longest * longest)
        {
          this->Bundles[neighbor] = first;
          area += this->Areas[neighbor];
          bundle.push_back(neighbor);
        }
      }
    }
    // What is left over between others goes to one of them.
    for (std::size_t i = 0; i < bundle.size() && beside != none && area < 0.5 * longest * longest;
         ++i)
    {
      this->Bundles[bundle[i]] = beside;
    }
  }
}

//------------------------------------------------------------------------------
// Stretch, normals and metrics are made of squares of areas.
Outcome AtlasSurface::CheckAreas(const TriangleSoup& soup) const
{
  const auto canBeSquared = [](double area) { return std::isnormal(area * area); };
  const auto bad = std::find_if_not(this->Areas.begin(), this->Areas.end(), canBeSquared);
  if (bad != this->Areas.end())
  {
    std::ostringstream text;
    text << "Cell " << soup.CellIds[bad - this->Areas.begin()] << " has a triangle of area " << *bad
         << ", whose square no double holds: give coordinates whose size is nearer to 1.";
    return Outcome::Failed(text.str());
  }
  return canBeSquared(this->Area)
    ? Outcome::Done()
    : Outcome::Failed("The area of the surface is so large that no double holds its square: give "
                      "coordinates whose size is nearer to 1.");
}

//------------------------------------------------------------------------------
// How long the edges of each face may be.
std::vector<double> AtlasSurface::FindLongestEdges(const Watch& watch) const
{
  double largest = 0.0;
  for (const TriangleSoup::Point& point : this->Points)
  {
    for (const double value : point)
    {
      largest = std::max(largest, std::abs(value));
    }
  }
  const double shortest = LeastStepsOfEdge * std::numeric_limits<double>::epsilon() * largest;
  std::vector<double> lengths(this->Triangles.size(), -1.0);
  std::vector<int> component;
  for (int first = 0; first < this->GetNumberOfFaces(); ++first)
  {
    if (lengths[first] >= 0.0)
    {
      continue;
    }
    component.assign(1, first);
    lengths[first] = 0.0;
    double area = 0.0;
    double longest = 0.0;
    for (std::size_t i = 0; i < component.size(); ++i)
    {
      watch.Check();
      area += this->Areas[component[i]];
      for (int edge = 0; edge < 3; ++edge)
      {
        longest = std::max(longest, this->GetEdgeLength(component[i], edge));
        const int neighbor = this->Neighbors[component[i]][edge];
        if (neighbor >= 0 && lengths[neighbor] < 0.0)
        {
          lengths[neighbor] = 0.0;
          component.push_back(neighbor);
        }
      }
    }
    const double length = std::max({ shortest, LengthOfDiagonal * longest / MaximumPiecesOfEdge,
      std::min(std::sqrt(this->Area) / EdgesAcrossSurface,
        std::sqrt(area) / EdgesAcrossComponent) });
    for (const int face : component)
    {
      lengths[face] = length;
    }
  }
  return lengths;
}

//------------------------------------------------------------------------------
int AtlasSurface::FindLongestHalvedEdge(std::size_t face, const Middles& middles) const
{
  int found = -1;
  double length = 0.0;
  for (int edge = 0; edge < 3; ++edge)
  {
    const TriangleSoup::Triangle& t = this->Triangles[face];
    const double candidate = this->GetEdgeLength(static_cast<int>(face), edge);
    if (candidate > length && middles.count(MakeKey(t[edge], t[(edge + 1) % 3])) != 0)
    {
      found = edge;
      length = candidate;
    }
  }
  return found;
}

// The edge between two faces of one triangle of the soup that are both long in two sides, at
// opposite ends of the edge.
struct AtlasSurface::Diagonal
{
  std::array<int, 2> Faces;
  std::array<std::size_t, 2> Ends; ///< as the first face goes around
};

//------------------------------------------------------------------------------
// Of a face with exactly two edges that are too long, `edge` and another, the other; -1 else.
int AtlasSurface::FindOtherLongEdge(int face, int edge, double longest) const
{
  int found = -1;
  int number = 0;
  for (int i = 0; i < 3; ++i)
  {
    if (this->GetEdgeLength(face, i) > longest)
    {
      ++number;
      found = i == edge ? found : i;
    }
  }
  return number == 2 && this->GetEdgeLength(face, edge) > longest ? found : -1;
}

//------------------------------------------------------------------------------
// No face has more than one.
std::vector<AtlasSurface::Diagonal> AtlasSurface::FindDiagonals(
  const std::vector<double>& longest) const
{
  std::vector<Diagonal> diagonals;
  std::vector<bool> isTaken(this->Triangles.size(), false);
  for (int face = 0; face < this->GetNumberOfFaces(); ++face)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const int other = this->Neighbors[face][edge];
      if (other <= face || isTaken[face] || isTaken[other] ||
        this->Sources[other] != this->Sources[face])
      {
        continue;
      }
      const std::array<int, 3>& back = this->Neighbors[other];
      const int opposite =
        static_cast<int>(std::find(back.begin(), back.end(), face) - back.begin());
      const int here = this->FindOtherLongEdge(face, edge, longest[face]);
      const int there = this->FindOtherLongEdge(other, opposite, longest[other]);
      // Both sides come after the edge, or both before it, as their faces go around.
      if (here >= 0 && there >= 0 && (here - edge + 3) % 3 == (there - opposite + 3) % 3)
      {
        const TriangleSoup::Triangle& t = this->Triangles[face];
        diagonals.push_back({ { face, other }, { t[edge], t[(edge + 1) % 3] } });
        isTaken[face] = true;
        isTaken[other] = true;
      }
    }
  }
  return diagonals;
}

//------------------------------------------------------------------------------
// Find middles for the edges that are too long, but for those that are kept.
AtlasSurface::Middles AtlasSurface::HalveEdges(const std::vector<double>& longest,
  const std::vector<Diagonal>& kept)
{
  std::unordered_set<std::uint64_t> keys;
  for (const Diagonal& diagonal : kept)
  {
    keys.insert(MakeKey(diagonal.Ends[0], diagonal.Ends[1]));
  }
  Middles middles;
  for (int face = 0; face < this->GetNumberOfFaces(); ++face)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const std::size_t a = this->Triangles[face][edge];
      const std::size_t b = this->Triangles[face][(edge + 1) % 3];
      const std::uint64_t key = MakeKey(a, b);
      if (this->GetEdgeLength(face, edge) > longest[face] && keys.count(key) == 0 &&
        middles.emplace(key, this->Points.size()).second)
      {
        const Vector middle = this->GetEdgeMiddle(face, edge);
        this->Points.push_back({ middle[0], middle[1], middle[2] });
        this->HalvedEdges.push_back({ a, b });
      }
    }
  }
  return middles;
}

//------------------------------------------------------------------------------
// Cut a face at its longest halved side; its parts keep the sides that are still to be cut.
void AtlasSurface::CutFace(std::size_t face, const Middles& middles, std::vector<double>& longest)
{
  for (int edge = this->FindLongestHalvedEdge(face, middles); edge >= 0;
       edge = this->FindLongestHalvedEdge(face, middles))
  {
    const TriangleSoup::Triangle t = this->Triangles[face];
    const std::size_t middle = middles.at(MakeKey(t[edge], t[(edge + 1) % 3]));
    this->Triangles[face][(edge + 1) % 3] = middle;
    this->Triangles.push_back({ middle, t[(edge + 1) % 3], t[(edge + 2) % 3] });
    this->Sources.push_back(this->Sources[face]);
    longest.push_back(longest[face]);
  }
}

//------------------------------------------------------------------------------
// Put a rung in the place of a diagonal whose faces have been cut, each into itself and a part,
// unless that would turn a triangle over.
void AtlasSurface::Replace(const Diagonal& diagonal, int firstPart, int secondPart)
{
  std::array<int, 2> faces{ -1, -1 };
  std::array<std::size_t, 2> tips{ 0, 0 };
  const int parts[2] = { firstPart, secondPart };
  for (int side = 0; side < 2; ++side)
  {
    for (const int face : { diagonal.Faces[side], parts[side] })
    {
      const TriangleSoup::Triangle& t = this->Triangles[face];
      for (int corner = 0; corner < 3; ++corner)
      {
        if (t[(corner + 1) % 3] == diagonal.Ends[side] &&
          t[(corner + 2) % 3] == diagonal.Ends[1 - side])
        {
          faces[side] = face;
          tips[side] = t[corner];
        }
      }
    }
  }
  const auto getNormal = [this](const TriangleSoup::Triangle& t)
  {
    const Vector a = this->GetPoint(t[0]);
    return Vector((this->GetPoint(t[1]) - a).cross(this->GetPoint(t[2]) - a));
  };
  const TriangleSoup::Triangle first{ tips[0], diagonal.Ends[0], tips[1] };
  const TriangleSoup::Triangle second{ tips[1], diagonal.Ends[1], tips[0] };
  const Vector normal = getNormal(this->Triangles[faces[0]]);
  if (getNormal(first).dot(normal) > 0.0 && getNormal(second).dot(normal) > 0.0)
  {
    this->Triangles[faces[0]] = first;
    this->Triangles[faces[1]] = second;
  }
}

//------------------------------------------------------------------------------
// Halve all edges that are too long, once. Returns whether there were any.
bool AtlasSurface::HalveLongEdges(std::vector<double>& longest, const Watch& watch)
{
  const std::vector<Diagonal> diagonals = this->FindDiagonals(longest);
  watch.Check();
  const Middles middles = this->HalveEdges(longest, diagonals);
  std::vector<int> parts(this->Triangles.size(), -1);
  // The parts of cut faces follow below: they have nothing more to cut but what their face leaves.
  for (std::size_t face = 0; face < this->Triangles.size() && !middles.empty(); ++face)
  {
    watch.Check();
    if (face < parts.size())
    {
      parts[face] = static_cast<int>(this->Triangles.size());
    }
    this->CutFace(face, middles, longest);
  }
  for (const Diagonal& diagonal : diagonals)
  {
    this->Replace(diagonal, parts[diagonal.Faces[0]], parts[diagonal.Faces[1]]);
  }
  return !middles.empty();
}
} // namespace LightTransport
