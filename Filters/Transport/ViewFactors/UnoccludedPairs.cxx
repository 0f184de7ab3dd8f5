// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/UnoccludedPairs.h"

#include "Scene/PatchTree.h"
#include "ViewFactors/QuadratureKernels.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace LightTransport
{
namespace
{
using PairIntegrals::Estimate;
using QuadratureRules::NumberOfRules;
using Vector = PatchScene::Vector;
using Node = PatchTree::Node;

constexpr double Pi = 3.14159265358979323846;
// The shares of the tolerance, a bound on the error of a whole row: a rule's error on each side is
// relative to area / (pi distance^2), which sums to a few over a row; contours are few per row (a
// patch has a few dozen near ones).
constexpr double RuleShare = 1.0 / 32.0;
constexpr double ContourShare = 0.01;
// Heights below this part of the extent of what is looked at are rounding: as in
// PairIntegrals::Clip.
constexpr double PlaneTolerance = 1e-12;
// And below this they are the rounding of coordinates: the scene's diagonal is 1.
constexpr double CoordinateRounding = 1e-15;
// Nodes of at most this many patches are not cut further: their pairs choose their own rules.
constexpr vtkIdType RowSize = QuadratureKernels::Lanes;
// Nodes of at most this many patches take one rule even where their far pairs could do with less.
constexpr vtkIdType UniformSize = 32;

// A rule on one polygon, the other polygon being a point y with a normal: the integrand is h g /
// |y - x|^4, where the height h of y over the polygon's plane is the same for all x, and the height
// g of x over the plane of y changes with the sine s of the angle between the planes. The error is
// at most
//
//   C q^(p + 1) / (1 - q)^3 * (h / D) * (g / D + s) * area / D^2,  q = radius / D < LargestRatio,
//
// with D = |y - c| and g for the point c around which the radius is, p the degree. C is one and a
// half times the largest seen in experiments with q from 0.05 to 0.7, all orientations (many of
// them grazing or parallel) and aspect ratios to 100: 20,000 triangles for each q around their
// centroid; and as many triangles around any point (the fans of clipped polygons), rectangles,
// parallelograms and quadrilaterals.
constexpr double LargestRatio = 0.7;
constexpr double TriangleConstants[NumberOfRules] = { 1.8, 0.21, 0.13, 0.4, 0.018 };
constexpr double PolygonConstants[NumberOfRules] = { 3.3, 0.7, 0.4, 0.45, 0.14 };
// The largest quotient of the two, for triangles whose bound turns out to be that of a fan.
constexpr double ClippedFactor = 8.0;
constexpr int Degrees[NumberOfRules] = { 1, 2, 4, 5, 8 };

//------------------------------------------------------------------------------
// One side of a pair (or of all pairs of two nodes).
struct Side
{
  double Radius;
  double Distance; ///< D, at least
  double Height;   ///< h, at most
  double Facing;   ///< g + s D, at most
  double Sum;      ///< over the other side's patches, of area_i area_j / pi

  double GetRatio() const { return this->Radius / this->Distance; }
};

//------------------------------------------------------------------------------
// The cheapest rule whose error, relative to area * area / (pi D^2), is below `tolerance`, or -1.
int ChooseRule(const Side& side, const double* constants, double tolerance, double& error)
{
  if (!(side.Radius < LargestRatio * side.Distance))
  {
    return -1;
  }
  const double ratio = side.GetRatio();
  const double rest = 1.0 - ratio;
  const double common = std::min(1.0, side.Height / side.Distance) *
    std::min(2.0, side.Facing / side.Distance) / (rest * rest * rest);
  double power = ratio;
  int degree = 0;
  for (int rule = 0; rule < NumberOfRules; ++rule)
  {
    for (; degree < Degrees[rule]; ++degree)
    {
      power *= ratio;
    }
    error = constants[rule] * power * common;
    if (error <= tolerance)
    {
      return rule;
    }
  }
  return -1;
}

//------------------------------------------------------------------------------
// Two nodes (or more exactly: all pairs of their patches) as seen from each other.
struct View
{
  double Nearest = 0.0;  ///< between centroids, at least
  double Furthest = 0.0; ///< between centroids, at most
  // Heights of the points of one over the planes of the other, at most and at least.
  double HighestOfI = 0.0;
  double LowestOfI = 0.0;
  double HighestOfJ = 0.0;
  double LowestOfJ = 0.0;
  double Rounding = 0.0; ///< heights below this are none
  double Sine = 1.0;     ///< of the angle between planes, at most

  bool MayFace() const
  {
    return this->HighestOfI > this->Rounding && this->HighestOfJ > this->Rounding;
  }
  bool NoHorizonCrosses() const
  {
    return this->LowestOfI >= -this->Rounding && this->LowestOfJ >= -this->Rounding;
  }
};

// What a scene knows beyond PatchTree::Node: how far normals leave the axis of the cone (whose
// cosine cannot tell 1e-9 from 0), and the slab across the axis that holds all corners.
struct Slab
{
  double Chord = 0.0;
  double Sine = 0.0;
  double Low = 0.0;
  double High = 0.0;
};

struct Heights
{
  double Lowest;
  double Highest;
};

// How one pair is to be computed.
struct Plan
{
  enum
  {
    None,    ///< certainly nothing
    Rules,   ///< by the points of both patches
    Clipped, ///< by rules on what is in front of the other's plane
    Contours
  } Method = None;
  int RuleI = -1;
  int RuleJ = -1;
  double Error = 0.0;
};
} // namespace

//------------------------------------------------------------------------------
struct UnoccludedPairs::Internals
{
  const PatchScene& Scene;
  const double Tolerance;

  Internals(const PatchScene& scene, double tolerance);

  // Structure of arrays, in the order of the patches.
  void FillPatches();
  void FillRule(int rule);
  void FillSlabs();
  QuadratureKernels::Patches GetPatches(int rule) const;
  int GetRuleSize(int rule, vtkIdType first, vtkIdType last) const;
  bool HasLargePolygons(vtkIdType first, vtkIdType last) const
  {
    return this->LargePolygons[last] > this->LargePolygons[first];
  }
  const double* GetConstants(vtkIdType first, vtkIdType last) const
  {
    const bool triangles = this->Quadrilaterals[last] == this->Quadrilaterals[first] &&
      !this->HasLargePolygons(first, last);
    return triangles ? TriangleConstants : PolygonConstants;
  }

  Heights GetHeights(int over, int of, double extent) const;
  View GetView(int nodeI, int nodeJ) const;

  void IntegrateRow(vtkIdType i, int ruleI, vtkIdType first, int count, int ruleJ, double* sums,
    double* margins) const;
  Plan MakePlan(vtkIdType i, vtkIdType j) const;
  Estimate Follow(vtkIdType i, vtkIdType j, const Plan& plan) const;
  bool NeedsClip(vtkIdType i, vtkIdType j) const;
  bool Clip(vtkIdType i, vtkIdType j, Polygon& a, Polygon& b) const;
  double IntegrateClipped(vtkIdType i, int ruleI, vtkIdType j, int ruleJ) const;
  Estimate IntegrateNear(vtkIdType i, vtkIdType j) const;
  double Limit(vtkIdType i, vtkIdType j, double value) const
  {
    const std::vector<double>& areas = this->Scene.GetAreas();
    return std::max(0.0, std::min(value, std::min(areas[i], areas[j])));
  }

  std::vector<double> Normals[3];
  std::vector<double> Centroids[3];
  std::vector<double> Radii;
  struct RulePoints
  {
    std::vector<double> Points[3];
    std::vector<double> Weights;
  };
  RulePoints Rules[NumberOfRules];
  long Stride = 0;
  // Sums over the patches before each: of quadrilaterals, and of polygons with more corners, which
  // have no points in Rules but the one of rule 0.
  std::vector<vtkIdType> Quadrilaterals;
  std::vector<vtkIdType> LargePolygons;
  std::vector<Slab> Slabs;

  class Filler;
};

namespace
{
//------------------------------------------------------------------------------
// One pair: what the bounds of the errors need.
struct Pair
{
  Side SideI;
  Side SideJ;
  double Margin; ///< below 0 a horizon may cross
  bool Facing;   ///< false is certain
};

//------------------------------------------------------------------------------
Pair MakePair(const PatchScene& scene, vtkIdType i, vtkIdType j)
{
  const Vector between = scene.GetCentroid(j) - scene.GetCentroid(i);
  const Vector& normalI = scene.GetNormal(i);
  const Vector& normalJ = scene.GetNormal(j);
  const double radiusI = scene.GetRadius(i);
  const double radiusJ = scene.GetRadius(j);
  const double heightOfI = -between.dot(normalJ);
  const double heightOfJ = between.dot(normalI);
  const double sine = std::min(1.0, normalI.cross(normalJ).norm());
  const double reachI = radiusI * sine;
  const double reachJ = radiusJ * sine;
  const double distance = between.norm();
  const double distanceI = distance - radiusJ;
  const double distanceJ = distance - radiusI;
  const double sum = scene.GetAreas()[i] * scene.GetAreas()[j] / Pi;
  Pair pair;
  pair.SideI = { radiusI, distanceI, std::abs(heightOfJ) + reachJ,
    std::abs(heightOfI) + sine * distanceI, sum };
  pair.SideJ = { radiusJ, distanceJ, std::abs(heightOfI) + reachI,
    std::abs(heightOfJ) + sine * distanceJ, sum };
  pair.Margin = std::min(heightOfI - reachI, heightOfJ - reachJ);
  pair.Facing = heightOfI > -reachI && heightOfJ > -reachJ;
  return pair;
}
} // namespace

//------------------------------------------------------------------------------
UnoccludedPairs::Internals::Internals(const PatchScene& scene, double tolerance)
  : Scene(scene), Tolerance(tolerance)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  this->Quadrilaterals.assign(patches + 1, 0);
  this->LargePolygons.assign(patches + 1, 0);
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    const int corners = scene.GetNumberOfCorners(patch);
    this->Quadrilaterals[patch + 1] = this->Quadrilaterals[patch] + (corners == 4 ? 1 : 0);
    this->LargePolygons[patch + 1] = this->LargePolygons[patch] + (corners > 4 ? 1 : 0);
  }
  this->Stride = static_cast<long>(patches) + QuadratureKernels::Lanes;
  this->FillPatches();
  for (int rule = 0; rule < NumberOfRules; ++rule)
  {
    this->FillRule(rule);
  }
  this->FillSlabs();
}

//------------------------------------------------------------------------------
void UnoccludedPairs::Internals::FillPatches()
{
  const vtkIdType patches = this->Scene.GetNumberOfPatches();
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Normals[axis].assign(this->Stride, 0.0);
    this->Centroids[axis].assign(this->Stride, 0.0);
    for (vtkIdType patch = 0; patch < patches; ++patch)
    {
      this->Normals[axis][patch] = this->Scene.GetNormal(patch)[axis];
      this->Centroids[axis][patch] = this->Scene.GetCentroid(patch)[axis];
    }
  }
  this->Radii.assign(this->Stride, 1.0);
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    this->Radii[patch] = this->Scene.GetRadius(patch);
  }
}

//------------------------------------------------------------------------------
void UnoccludedPairs::Internals::FillRule(int rule)
{
  const vtkIdType patches = this->Scene.GetNumberOfPatches();
  const int size = this->GetRuleSize(rule, 0, patches);
  RulePoints& table = this->Rules[rule];
  table.Weights.assign(size * this->Stride, 0.0);
  for (std::vector<double>& coordinates : table.Points)
  {
    coordinates.assign(size * this->Stride, 0.0);
  }
  Polygon polygon;
  Vector points[QuadratureRules::MaximumCompactPoints];
  double weights[QuadratureRules::MaximumCompactPoints];
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    polygon.Set(this->Scene, patch);
    int count = 1;
    points[0] = this->Scene.GetCentroid(patch);
    weights[0] = rule == 0 ? this->Scene.GetAreas()[patch] : 0.0;
    if (rule > 0 && polygon.Count <= 4)
    {
      count = QuadratureRules::GetNumberOfPoints(rule, polygon.Count);
      QuadratureRules::MakeCompact(polygon, rule, points, weights);
    }
    for (int point = 0; point < size; ++point)
    {
      const std::size_t at = point * this->Stride + patch;
      const int source = point < count ? point : 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        table.Points[axis][at] = points[source][axis];
      }
      table.Weights[at] = point < count ? weights[point] : 0.0;
    }
  }
}

//------------------------------------------------------------------------------
void UnoccludedPairs::Internals::FillSlabs()
{
  const std::vector<Node>& nodes = this->Scene.GetTree().GetNodes();
  this->Slabs.resize(nodes.size());
  for (std::size_t index = 0; index < nodes.size(); ++index)
  {
    const Node& node = nodes[index];
    Slab& slab = this->Slabs[index];
    slab.Low = node.ConeAxis.dot(this->Scene.GetCorner(node.First, 0));
    slab.High = slab.Low;
    for (vtkIdType patch = node.First; patch < node.Last; ++patch)
    {
      slab.Chord = std::max(slab.Chord, (this->Scene.GetNormal(patch) - node.ConeAxis).norm());
      for (int corner = 0; corner < this->Scene.GetNumberOfCorners(patch); ++corner)
      {
        const double height = node.ConeAxis.dot(this->Scene.GetCorner(patch, corner));
        slab.Low = std::min(slab.Low, height);
        slab.High = std::max(slab.High, height);
      }
    }
    const double half = 0.25 * slab.Chord * slab.Chord;
    slab.Sine = half < 0.5 ? slab.Chord * std::sqrt(1.0 - half) : 1.0;
  }
}

//------------------------------------------------------------------------------
QuadratureKernels::Patches UnoccludedPairs::Internals::GetPatches(int rule) const
{
  const RulePoints& table = this->Rules[rule];
  QuadratureKernels::Patches patches;
  for (int axis = 0; axis < 3; ++axis)
  {
    patches.Normals[axis] = this->Normals[axis].data();
    patches.Centroids[axis] = this->Centroids[axis].data();
    patches.Points[axis] = table.Points[axis].data();
  }
  patches.Radii = this->Radii.data();
  patches.Weights = table.Weights.data();
  patches.Stride = this->Stride;
  return patches;
}

//------------------------------------------------------------------------------
int UnoccludedPairs::Internals::GetRuleSize(int rule, vtkIdType first, vtkIdType last) const
{
  const bool quadrilaterals = this->Quadrilaterals[last] > this->Quadrilaterals[first];
  return QuadratureRules::GetNumberOfPoints(rule, quadrilaterals ? 4 : 3);
}

//------------------------------------------------------------------------------
// Heights of the points of one node over the planes of the other's patches, by the axis of the
// other's cone. Points of a plane parallel to it are known better by their slab than by their box.
Heights UnoccludedPairs::Internals::GetHeights(int over, int of, double extent) const
{
  const Node& nodeOver = this->Scene.GetTree().GetNode(over);
  const Node& nodeOf = this->Scene.GetTree().GetNode(of);
  const Slab& slabOver = this->Slabs[over];
  const Slab& slabOf = this->Slabs[of];
  const Vector& axis = nodeOver.ConeAxis;
  const double center = axis.dot(nodeOf.Lower + nodeOf.Upper) / 2.0;
  const double half = axis.cwiseAbs().dot(nodeOf.Upper - nodeOf.Lower) / 2.0;
  double low = center - half;
  double high = center + half;
  const bool same = axis.dot(nodeOf.ConeAxis) > 0.0;
  const Vector difference = same ? Vector(axis - nodeOf.ConeAxis) : Vector(axis + nodeOf.ConeAxis);
  // Scene coordinates are below 1.
  const double tilt = difference.norm();
  low = std::max(low, (same ? slabOf.Low : -slabOf.High) - tilt);
  high = std::min(high, (same ? slabOf.High : -slabOf.Low) + tilt);
  const double spread = slabOver.Chord * extent;
  return { low - slabOver.High - spread, high - slabOver.Low + slabOver.Sine * extent };
}

//------------------------------------------------------------------------------
View UnoccludedPairs::Internals::GetView(int nodeI, int nodeJ) const
{
  const Node& a = this->Scene.GetTree().GetNode(nodeI);
  const Node& b = this->Scene.GetTree().GetNode(nodeJ);
  View view;
  const Vector gap =
    (a.CentroidLower - b.CentroidUpper).cwiseMax(b.CentroidLower - a.CentroidUpper);
  view.Nearest = gap.cwiseMax(0.0).norm();
  view.Furthest =
    (a.CentroidUpper - b.CentroidLower).cwiseMax(b.CentroidUpper - a.CentroidLower).norm();
  const double extent = (a.Upper - b.Lower).cwiseMax(b.Upper - a.Lower).norm();
  const Heights ofI = this->GetHeights(nodeJ, nodeI, extent);
  const Heights ofJ = this->GetHeights(nodeI, nodeJ, extent);
  view.HighestOfI = ofI.Highest;
  view.LowestOfI = ofI.Lowest;
  view.HighestOfJ = ofJ.Highest;
  view.LowestOfJ = ofJ.Lowest;
  view.Rounding = PlaneTolerance * extent + CoordinateRounding;
  view.Sine = std::min(1.0,
    a.ConeAxis.cross(b.ConeAxis).norm() + this->Slabs[nodeI].Chord + this->Slabs[nodeJ].Chord);
  return view;
}

//------------------------------------------------------------------------------
// One patch with a run of others, the points of all of them as they are.
void UnoccludedPairs::Internals::IntegrateRow(vtkIdType i, int ruleI, vtkIdType first, int count,
  int ruleJ, double* sums, double* margins) const
{
  QuadratureKernels::IntegrateRow(this->GetPatches(ruleI), this->GetRuleSize(ruleI, i, i + 1), i,
    this->GetPatches(ruleJ), this->GetRuleSize(ruleJ, first, first + count), first, count, sums,
    margins);
  for (int column = 0; column < count; ++column)
  {
    sums[column] *= 1.0 / Pi;
  }
}

//------------------------------------------------------------------------------
Plan UnoccludedPairs::Internals::MakePlan(vtkIdType i, vtkIdType j) const
{
  Plan plan;
  const Pair pair = MakePair(this->Scene, i, j);
  if (!pair.Facing)
  {
    return plan;
  }
  double errorI = 0.0;
  double errorJ = 0.0;
  const double tolerance = RuleShare * this->Tolerance;
  plan.RuleI = ChooseRule(pair.SideI, this->GetConstants(i, i + 1), tolerance, errorI);
  plan.RuleJ =
    plan.RuleI < 0 ? -1 : ChooseRule(pair.SideJ, this->GetConstants(j, j + 1), tolerance, errorJ);
  if (plan.RuleJ < 0)
  {
    plan.Method = Plan::Contours;
    return plan;
  }
  const bool large = this->HasLargePolygons(i, i + 1) || this->HasLargePolygons(j, j + 1);
  const bool crossing = pair.Margin < 0.0 && this->NeedsClip(i, j);
  const double factor = crossing ? ClippedFactor : 1.0;
  plan.Method = large || crossing ? Plan::Clipped : Plan::Rules;
  plan.Error = factor * pair.SideI.Sum *
    (errorI / (pair.SideI.Distance * pair.SideI.Distance) +
      errorJ / (pair.SideJ.Distance * pair.SideJ.Distance));
  return plan;
}

//------------------------------------------------------------------------------
Estimate UnoccludedPairs::Internals::Follow(vtkIdType i, vtkIdType j, const Plan& plan) const
{
  Estimate pair{ 0.0, plan.Error };
  switch (plan.Method)
  {
    case Plan::None:
      break;
    case Plan::Rules:
      this->IntegrateRow(i, plan.RuleI, j, 1, plan.RuleJ, &pair.Value, nullptr);
      break;
    case Plan::Clipped:
      pair.Value = this->IntegrateClipped(i, plan.RuleI, j, plan.RuleJ);
      break;
    case Plan::Contours:
      pair = this->IntegrateNear(i, j);
      break;
  }
  pair.Value = this->Limit(i, j, pair.Value);
  return pair;
}

//------------------------------------------------------------------------------
// Whether the plane of one patch passes through the other.
bool UnoccludedPairs::Internals::NeedsClip(vtkIdType i, vtkIdType j) const
{
  const auto reaches = [this](vtkIdType over, vtkIdType of)
  {
    const Vector& normal = this->Scene.GetNormal(over);
    const Vector& origin = this->Scene.GetCorner(over, 0);
    for (int corner = 0; corner < this->Scene.GetNumberOfCorners(of); ++corner)
    {
      const Vector ray = this->Scene.GetCorner(of, corner) - origin;
      const double height = ray.dot(normal);
      if (height < 0.0 && height * height > PlaneTolerance * PlaneTolerance * ray.squaredNorm())
      {
        return true;
      }
    }
    return false;
  };
  return reaches(i, j) || reaches(j, i);
}

//------------------------------------------------------------------------------
bool UnoccludedPairs::Internals::Clip(vtkIdType i, vtkIdType j, Polygon& a, Polygon& b) const
{
  a.Set(this->Scene, i);
  b.Set(this->Scene, j);
  return b.Clip(this->Scene.GetCorner(i, 0), a.Normal) &&
    a.Clip(this->Scene.GetCorner(j, 0), b.Normal);
}

//------------------------------------------------------------------------------
double UnoccludedPairs::Internals::IntegrateClipped(vtkIdType i, int ruleI, vtkIdType j,
  int ruleJ) const
{
  Polygon a, b;
  if (!this->Clip(i, j, a, b))
  {
    return 0.0;
  }
  constexpr int most = QuadratureRules::MaximumPoints;
  Vector pointsA[most], pointsB[most];
  double weightsA[most], weightsB[most];
  QuadratureRules::Make(a, ruleI, pointsA, weightsA);
  QuadratureRules::Make(b, ruleJ, pointsB, weightsB);
  const int countA = QuadratureRules::GetNumberOfPoints(ruleI) * (a.Count - 2);
  const int countB = QuadratureRules::GetNumberOfPoints(ruleJ) * (b.Count - 2);
  return PairIntegrals::IntegrateRules({ countA, pointsA, weightsA }, a.Normal,
    { countB, pointsB, weightsB }, b.Normal);
}

//------------------------------------------------------------------------------
Estimate UnoccludedPairs::Internals::IntegrateNear(vtkIdType i, vtkIdType j) const
{
  Polygon a, b;
  if (!this->Clip(i, j, a, b))
  {
    return {};
  }
  const double smaller = std::min(this->Scene.GetAreas()[i], this->Scene.GetAreas()[j]);
  return PairIntegrals::Integrate(a, b, ContourShare * this->Tolerance * smaller);
}

//------------------------------------------------------------------------------
// One call of UnoccludedPairs::Fill.
class UnoccludedPairs::Internals::Filler
{
public:
  Filler(const Internals& self, int nodeI, int nodeJ, float* values, vtkIdType stride,
    double* errorsI, double* errorsJ, UnoccludedPairs::Counters& counters)
    : Outer(self), Tree(self.Scene.GetTree()), FirstI(Tree.GetNode(nodeI).First),
      FirstJ(Tree.GetNode(nodeJ).First), Values(values), Stride(stride), ErrorsI(errorsI),
      ErrorsJ(errorsJ), Counters(counters)
  {
  }

  void Fill(int nodeI, int nodeJ)
  {
    const Node& a = this->Tree.GetNode(nodeI);
    const Node& b = this->Tree.GetNode(nodeJ);
    const double pairs = nodeI == nodeJ ? 0.5 * a.GetSize() * (a.GetSize() - 1.0)
                                        : static_cast<double>(a.GetSize()) * b.GetSize();
    const View view = this->Outer.GetView(nodeI, nodeJ);
    if (!view.MayFace())
    {
      this->Counters.Examined += pairs;
      this->Counters.BackFacing += pairs;
      return;
    }
    if (nodeI != nodeJ && this->FillByOneRule(a, b, view))
    {
      this->Counters.Examined += pairs;
    }
    else if (a.GetSize() <= RowSize && b.GetSize() <= RowSize)
    {
      this->FillPairs(a, b, nodeI == nodeJ);
    }
    else
    {
      this->Split(nodeI, nodeJ);
    }
  }

private:
  void Split(int nodeI, int nodeJ)
  {
    const Node& a = this->Tree.GetNode(nodeI);
    const Node& b = this->Tree.GetNode(nodeJ);
    if (nodeI == nodeJ)
    {
      this->Fill(a.Left, a.Left);
      this->Fill(a.Left, a.Left + 1);
      this->Fill(a.Left + 1, a.Left + 1);
    }
    else if (b.GetSize() <= RowSize ||
      (a.GetSize() > RowSize &&
        (a.Upper - a.Lower).squaredNorm() > (b.Upper - b.Lower).squaredNorm()))
    {
      this->Fill(a.Left, nodeJ);
      this->Fill(a.Left + 1, nodeJ);
    }
    else
    {
      this->Fill(nodeI, b.Left);
      this->Fill(nodeI, b.Left + 1);
    }
  }

  bool FillByOneRule(const Node& a, const Node& b, const View& view)
  {
    if (this->Outer.HasLargePolygons(a.First, a.Last) ||
      this->Outer.HasLargePolygons(b.First, b.Last))
    {
      return false;
    }
    const double* constantsI = this->Outer.GetConstants(a.First, a.Last);
    const double* constantsJ = this->Outer.GetConstants(b.First, b.Last);
    const double tolerance = RuleShare * this->Outer.Tolerance;
    const auto sideOfI = [&](double distance) -> Side
    {
      const double d = distance - b.Radius;
      return { a.Radius, d, view.HighestOfJ, view.HighestOfI + view.Sine * d, 0.0 };
    };
    const auto sideOfJ = [&](double distance) -> Side
    {
      const double d = distance - a.Radius;
      return { b.Radius, d, view.HighestOfI, view.HighestOfJ + view.Sine * d, 0.0 };
    };
    double errorI = 0.0;
    double errorJ = 0.0;
    const Side sideI = sideOfI(view.Nearest);
    const Side sideJ = sideOfJ(view.Nearest);
    const int ruleI = ChooseRule(sideI, constantsI, tolerance, errorI);
    const int ruleJ = ruleI < 0 ? -1 : ChooseRule(sideJ, constantsJ, tolerance, errorJ);
    if (ruleJ < 0)
    {
      return false;
    }
    if (std::max(a.GetSize(), b.GetSize()) > UniformSize)
    {
      double ignored = 0.0;
      const int farI = ChooseRule(sideOfI(view.Furthest), constantsI, tolerance, ignored);
      const int farJ = ChooseRule(sideOfJ(view.Furthest), constantsJ, tolerance, ignored);
      if (farI < ruleI || farJ < ruleJ)
      {
        return false;
      }
    }
    const double error =
      (errorI / (sideI.Distance * sideI.Distance) + errorJ / (sideJ.Distance * sideJ.Distance)) /
      Pi;
    this->AddErrors(a, b, error);
    this->FillRows(a, b, ruleI, ruleJ, view.NoHorizonCrosses(), error);
    return true;
  }

  void AddErrors(const Node& a, const Node& b, double error)
  {
    const std::vector<double>& areas = this->Outer.Scene.GetAreas();
    for (vtkIdType i = a.First; i < a.Last; ++i)
    {
      this->ErrorsI[i - this->FirstI] += error * areas[i] * b.Area;
    }
    for (vtkIdType j = b.First; j < b.Last; ++j)
    {
      this->ErrorsJ[j - this->FirstJ] += error * areas[j] * a.Area;
    }
  }

  void FillRows(const Node& a, const Node& b, int ruleI, int ruleJ, bool clear, double error)
  {
    double sums[PatchTree::BlockSize];
    double margins[PatchTree::BlockSize];
    const int size = static_cast<int>(b.GetSize());
    double facing = 0.0;
    for (vtkIdType i = a.First; i < a.Last; ++i)
    {
      this->Outer.IntegrateRow(i, ruleI, b.First, size, ruleJ, sums, clear ? nullptr : margins);
      if (!clear)
      {
        this->CorrectRow(i, ruleI, b.First, ruleJ, size, sums, margins, error);
      }
      float* row = this->Values + (i - this->FirstI) * this->Stride + (b.First - this->FirstJ);
      int count = 0;
      for (int column = 0; column < size; ++column)
      {
        row[column] = static_cast<float>(sums[column]);
        count += sums[column] > 0.0 ? 1 : 0;
      }
      facing += count;
    }
    this->Counters.Facing += facing;
    this->Counters.Rules += facing;
    this->Counters.BackFacing += static_cast<double>(a.GetSize()) * size - facing;
  }

  // Where a horizon crosses, the positive parts of cosines are no smooth functions: clip.
  void CorrectRow(vtkIdType i, int ruleI, vtkIdType first, int ruleJ, int size, double* sums,
    const double* margins, double error)
  {
    for (int column = 0; column < size; ++column)
    {
      if (std::abs(margins[column]) < 1.0 && this->Outer.NeedsClip(i, first + column))
      {
        const vtkIdType j = first + column;
        sums[column] = this->Outer.IntegrateClipped(i, ruleI, j, ruleJ);
        const std::vector<double>& areas = this->Outer.Scene.GetAreas();
        const double more = (ClippedFactor - 1.0) * error * areas[i] * areas[j];
        this->ErrorsI[i - this->FirstI] += more;
        this->ErrorsJ[j - this->FirstJ] += more;
      }
    }
  }

  // Each pair by rules of its own, or by contours; a row of them at once where rules do.
  void FillPairs(const Node& a, const Node& b, bool same)
  {
    std::array<Plan, RowSize> plans;
    std::array<double, RowSize> sums;
    for (vtkIdType i = a.First; i < a.Last; ++i)
    {
      const vtkIdType first = same ? i + 1 : b.First;
      const int size = static_cast<int>(b.Last - first);
      int ruleI = -1;
      int ruleJ = -1;
      for (int column = 0; column < size; ++column)
      {
        Plan& plan = plans[column];
        plan = this->Outer.MakePlan(i, first + column);
        if (plan.Method == Plan::Rules)
        {
          ruleI = std::max(ruleI, plan.RuleI);
          ruleJ = std::max(ruleJ, plan.RuleJ);
        }
      }
      if (ruleI >= 0)
      {
        this->Outer.IntegrateRow(i, ruleI, first, size, ruleJ, sums.data(), nullptr);
      }
      for (int column = 0; column < size; ++column)
      {
        const Plan& plan = plans[column];
        const vtkIdType j = first + column;
        this->AddPair(i, j, plan,
          plan.Method == Plan::Rules ? Estimate{ sums[column], plan.Error }
                                     : this->Outer.Follow(i, j, plan));
      }
    }
  }

  void AddPair(vtkIdType i, vtkIdType j, const Plan& plan, const Estimate& pair)
  {
    this->Counters.Examined += 1.0;
    if (!(pair.Value > 0.0))
    {
      this->Counters.BackFacing += 1.0;
      return;
    }
    this->Counters.Facing += 1.0;
    (plan.Method == Plan::Contours ? this->Counters.Contours : this->Counters.Rules) += 1.0;
    this->ErrorsI[i - this->FirstI] += pair.Error;
    this->ErrorsJ[j - this->FirstJ] += pair.Error;
    this->Values[(i - this->FirstI) * this->Stride + (j - this->FirstJ)] =
      static_cast<float>(this->Outer.Limit(i, j, pair.Value));
  }

private:
  const Internals& Outer;
  const PatchTree& Tree;
  const vtkIdType FirstI;
  const vtkIdType FirstJ;
  float* const Values;
  const vtkIdType Stride;
  double* const ErrorsI;
  double* const ErrorsJ;
  UnoccludedPairs::Counters& Counters;
};

//------------------------------------------------------------------------------
UnoccludedPairs::UnoccludedPairs(const PatchScene& scene, double tolerance)
  : Internal(new Internals(scene, tolerance))
{
}

//------------------------------------------------------------------------------
UnoccludedPairs::~UnoccludedPairs() = default;

//------------------------------------------------------------------------------
bool UnoccludedPairs::MayFace(int nodeI, int nodeJ) const
{
  return this->Internal->GetView(nodeI, nodeJ).MayFace();
}

//------------------------------------------------------------------------------
double UnoccludedPairs::GetKernelBound(int nodeI, int nodeJ) const
{
  const View view = this->Internal->GetView(nodeI, nodeJ);
  if (!view.MayFace())
  {
    return 0.0;
  }
  const Node& a = this->Internal->Scene.GetTree().GetNode(nodeI);
  const Node& b = this->Internal->Scene.GetTree().GetNode(nodeJ);
  const Vector gap = (a.Lower - b.Upper).cwiseMax(b.Lower - a.Upper).cwiseMax(0.0);
  const double squared = gap.squaredNorm();
  const double distance = std::sqrt(squared);
  const double cosines = std::min(view.HighestOfI, distance) * std::min(view.HighestOfJ, distance);
  return squared > 0.0 ? cosines / (Pi * squared * squared)
                       : std::numeric_limits<double>::infinity();
}

//------------------------------------------------------------------------------
void UnoccludedPairs::Fill(int nodeI, int nodeJ, float* values, vtkIdType stride, double* errorsI,
  double* errorsJ, Counters& counters) const
{
  Internals::Filler filler(*this->Internal, nodeI, nodeJ, values, stride, errorsI, errorsJ,
    counters);
  filler.Fill(nodeI, nodeJ);
}

//------------------------------------------------------------------------------
PairIntegrals::Estimate UnoccludedPairs::Compute(vtkIdType i, vtkIdType j) const
{
  // In one order, so that exchanging the two changes not even the rounding.
  const vtkIdType first = std::min(i, j);
  const vtkIdType second = std::max(i, j);
  return this->Internal->Follow(first, second, this->Internal->MakePlan(first, second));
}
} // namespace LightTransport
