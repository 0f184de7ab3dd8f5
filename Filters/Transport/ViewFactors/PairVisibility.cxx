// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/PairVisibility.h"

#include "Geometry/PatchSampler.h"
#include "Scene/PatchScene.h"
#include "vtkMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
using Vector = Polygon::Vector;
using ShadowRaster::Flux;

// Into how many parts the sides of the outer polygon's triangles are cut, one grid after the other.
// Numbers without common factors: others lie alike to a shadow's edge along one of the sides, and
// agree on what is wrong.
constexpr int Cuts[] = { 1, 2, 3, 5, 7, 11, 17, 23, 31 };
// Points times triangles after which no finer grid is tried: some ten milliseconds.
constexpr double MaximumWork = 1e6;
// The raster's own error at one point, measured: root mean square for one shadow edge across it.
constexpr double RasterError = 0.004;
// Of the raster's lines to the longest edge, where length and width of the polygon are the same.
constexpr double Slant = 0.38;
// The largest error of the first look's rule for one shadow edge across the pair, and the part of
// the exchange that belongs to the rim.
constexpr double FirstError = 0.05;
constexpr double RimPart = 0.5;
// Of the first look's error what a grid is usually off by, times the square of its cuts.
constexpr double UsualPart = 0.35;
// Two polygons closer than this part of the larger one's extent: the raster does not resolve there
// what one sees of the other.
constexpr double CloseDistance = 0.125;
// Ten times what samples that share weights are off by from a point that is as far from the target
// as that reaches, measured; it falls with the square of the distance.
constexpr double CoarseError = 0.02;
// Of heights over the planes of a hull in double precision (the scene is 1 large).
constexpr double HeightRounding = 1e-14;
// By how much the points of grids turn, at most, to either side of where they are symmetric; grids
// one after the other by multiples of the golden ratio.
constexpr double GoldenRatio = 0.6180339887498949;
constexpr double LargestTurn = 0.25 * vtkMath::Pi();
// Edges of the target that leave the raster's lines by less than this part are along them.
constexpr double AlongLines = 1e-12;

//------------------------------------------------------------------------------
double GetExtent(const Polygon& polygon)
{
  const Vector middle = polygon.GetMiddle();
  double squared = 0.0;
  for (int corner = 0; corner < polygon.Count; ++corner)
  {
    squared = std::max(squared, (polygon.Corners[corner] - middle).squaredNorm());
  }
  return std::sqrt(squared);
}

//------------------------------------------------------------------------------
// Whether two polygons are closer than a distance.
bool AreCloseTogether(const Polygon& a, const Polygon& b)
{
  const double extents[2] = { GetExtent(a), GetExtent(b) };
  const double distance = CloseDistance * std::max(extents[0], extents[1]);
  return (a.GetMiddle() - b.GetMiddle()).norm() < extents[0] + extents[1] + distance &&
    a.IsCloser(b, distance);
}

//------------------------------------------------------------------------------
// Points of a grid of similar triangles, three of each: those that turn into each other by a third
// of a turn and are on a certain circle (degree 2, whatever the angle at which they begin). Rows of
// points would lie along the edges of shadows, which often run along the polygon's own, and be
// wrong all alike: each grid begins at another angle. Stops where visit returns false.
template <typename Visit>
bool VisitTriangle(const Vector& origin, const Vector& u, const Vector& v, int cuts,
  const Visit& visit)
{
  const double turns = GoldenRatio * cuts;
  const double angle = LargestTurn * (2.0 * (turns - std::floor(turns)) - 1.0);
  double shares[3]; // of the corners, for one of the points
  for (int corner = 0; corner < 3; ++corner)
  {
    shares[corner] = (1.0 + std::cos(angle + 2.0 * vtkMath::Pi() / 3.0 * corner)) / 3.0;
  }
  for (int i = 0; i < cuts; ++i)
  {
    for (int j = 0; j < cuts - i; ++j)
    {
      const Vector corner = origin + i * u + j * v;
      for (int point = 0; point < 3; ++point)
      {
        const double alongU = shares[(point + 1) % 3];
        const double alongV = shares[(point + 2) % 3];
        if (!visit(Vector(corner + alongU * u + alongV * v)) ||
          (i + j + 1 < cuts && !visit(Vector(corner + (1.0 - alongU) * u + (1.0 - alongV) * v))))
        {
          return false;
        }
      }
    }
  }
  return true;
}
} // namespace

//------------------------------------------------------------------------------
bool PairVisibility::SetPair(const PatchScene& scene, vtkIdType i, vtkIdType j,
  const OccluderWalls& walls, const std::vector<Occluder>& occluders, std::uint64_t key,
  double open)
{
  this->Open = open;
  Polygon::SetToClippedPair(scene, i, j, this->Outer, this->Inner);
  this->OuterPlane = scene.GetPlane(i);
  this->InnerPlane = scene.GetPlane(j);
  this->Key = key;
  this->HullRounding =
    HeightRounding + std::max(scene.GetEdgeRounding(i), scene.GetEdgeRounding(j));
  this->NumberOfPoints = 0;
  this->Walls = &walls;
  this->WalledOff = this->IsHiddenByOne(occluders, i, j);
  if (this->WalledOff)
  {
    return true;
  }
  this->SelectOccluders(occluders);
  if (this->Occluders.empty())
  {
    return false;
  }
  this->AreClose = open > 0.0 && AreCloseTogether(this->Outer, this->Inner);
  this->IsExactReady = false;
  this->ChooseOuter();
  this->SetFrame();
  this->AddTarget();
  this->AddShapes();
  return this->Shapes.GetCount() > 0;
}

//------------------------------------------------------------------------------
void PairVisibility::SelectOccluders(const std::vector<Occluder>& occluders)
{
  this->Occluders.clear();
  if (occluders.empty())
  {
    return;
  }
  this->Hull.Set(this->Outer, this->Inner, this->HullRounding);
  for (const Occluder& occluder : occluders)
  {
    if (!this->Hull.IsBeyond(this->Walls->GetNumberOfCorners(occluder.Wall),
          [&](int corner) { return this->Walls->GetCorner(occluder.Wall, corner); }))
    {
      this->Occluders.push_back(occluder);
    }
  }
}

//------------------------------------------------------------------------------
bool PairVisibility::IsHiddenByOne(const std::vector<Occluder>& occluders, vtkIdType i, vtkIdType j)
{
  const auto set = [this](OccluderWalls::End& end, const Polygon& polygon, vtkIdType patch)
  {
    const auto first = polygon.Corners.begin();
    end.Set({ first, first + polygon.Count }, this->Walls->GetBodies().IsOutside(patch));
  };
  set(this->Ends[0], this->Outer, i);
  set(this->Ends[1], this->Inner, j);
  return this->Walls->FindHiding(
           occluders, [](const Occluder& occluder) { return occluder.Wall; }, this->Ends[0],
           this->Ends[1], false) >= 0;
}

//------------------------------------------------------------------------------
// Seen from the outer polygon, occluders at the fraction t of the way to the inner one let shadows
// move (1 - t) / t times as far as the point.
void PairVisibility::ChooseOuter()
{
  const Vector middle = this->Outer.GetMiddle();
  const Vector axis = this->Inner.GetMiddle() - middle;
  double sum = 0.0;
  for (const Occluder& occluder : this->Occluders)
  {
    const double position =
      (this->Walls->GetCentroid(occluder.Wall) - middle).dot(axis) / axis.squaredNorm();
    sum += std::min(1.0, std::max(0.0, position));
  }
  const double position = sum / static_cast<double>(this->Occluders.size());
  if (GetExtent(this->Outer) * (1.0 - position) > GetExtent(this->Inner) * position)
  {
    std::swap(this->Outer, this->Inner);
    std::swap(this->OuterPlane, this->InnerPlane);
  }
}

//------------------------------------------------------------------------------
void PairVisibility::SetFrame()
{
  this->Origin = this->Inner.GetMiddle();
  double longest = 0.0;
  for (int corner = 0; corner < this->Inner.Count; ++corner)
  {
    const Vector edge =
      this->Inner.Corners[(corner + 1) % this->Inner.Count] - this->Inner.Corners[corner];
    if (edge.squaredNorm() > longest)
    {
      longest = edge.squaredNorm();
      this->AxisW = edge;
    }
  }
  this->AxisH = this->Inner.Normal;
  // Aslant to the edges: a shadow's edge along the lines would cover or free a whole line at once.
  const Vector across = this->AxisH.cross(this->AxisW).normalized();
  double width = 0.0;
  for (int corner = 0; corner < this->Inner.Count; ++corner)
  {
    width = std::max(width, std::abs(across.dot(this->Inner.Corners[corner] - this->Origin)));
  }
  this->AxisW += Slant * 2.0 * width * across;
  this->AxisU = this->AxisW.cross(this->AxisH).normalized();
  this->AxisW = this->AxisH.cross(this->AxisU);
  this->Normal[0] = this->Outer.Normal.dot(this->AxisU);
  this->Normal[1] = this->Outer.Normal.dot(this->AxisW);
  this->Normal[2] = this->Outer.Normal.dot(this->AxisH);
}

//------------------------------------------------------------------------------
void PairVisibility::AddTarget()
{
  this->Target.Edges.clear();
  this->Target.Begin = 0.0;
  this->Target.End = 0.0;
  for (int corner = 0; corner < this->Inner.Count; ++corner)
  {
    const Vector begin = this->Inner.Corners[corner] - this->Origin;
    const Vector end = this->Inner.Corners[(corner + 1) % this->Inner.Count] - this->Origin;
    const double u = begin.dot(this->AxisU);
    const double run = end.dot(this->AxisU) - u;
    this->Target.Begin = std::min(this->Target.Begin, u);
    this->Target.End = std::max(this->Target.End, u);
    // An edge along the lines bounds none of them.
    if (std::abs(run) > AlongLines * (end - begin).norm())
    {
      const double w = begin.dot(this->AxisW);
      const double slope = (end.dot(this->AxisW) - w) / run;
      // Counter-clockwise: an edge that runs towards larger u is a lower one.
      this->Target.Edges.push_back({ w - slope * u, slope, run > 0.0 });
    }
  }
}

//------------------------------------------------------------------------------
template <typename GetCorner>
void PairVisibility::AddShape(int count, const GetCorner& getCorner)
{
  this->Corners.clear();
  for (int corner = 0; corner < count; ++corner)
  {
    const Vector offset = getCorner(corner) - this->Origin;
    this->Corners.push_back(
      { offset.dot(this->AxisU), offset.dot(this->AxisW), offset.dot(this->AxisH) });
  }
  this->Shapes.Add(this->Corners);
}

//------------------------------------------------------------------------------
void PairVisibility::AddShapes()
{
  this->Shapes.Clear();
  Polygon cut;
  for (const Occluder& occluder : this->Occluders)
  {
    if (!occluder.IsCut)
    {
      this->AddShape(this->Walls->GetNumberOfCorners(occluder.Wall),
        [&](int corner) { return this->Walls->GetCorner(occluder.Wall, corner); });
      continue;
    }
    if (this->ShapeOccluder(occluder, cut))
    {
      this->AddShape(cut.Count, [&](int corner) { return cut.Corners[corner]; });
    }
  }
}

//------------------------------------------------------------------------------
// What of an occluder is between the two polygons; false where nothing is.
bool PairVisibility::ShapeOccluder(const Occluder& occluder, Polygon& shape) const
{
  shape.Set(*this->Walls, occluder.Wall);
  return !occluder.IsCut ||
    (shape.Clip(this->OuterPlane) && shape.Clip(this->InnerPlane) &&
      !this->Hull.IsBeyond(shape.Count, [&](int corner) { return shape.Corners[corner]; }));
}

//------------------------------------------------------------------------------
bool PairVisibility::LookFrom(const Vector& place, ShadowRaster::View& view)
{
  const PatchSampler sampler(this->Key);
  const int index = this->NumberOfPoints++;
  const Vector offset = place - this->Origin;
  const double point[3] = { offset.dot(this->AxisU), offset.dot(this->AxisW),
    offset.dot(this->AxisH) };
  const double shift[2] = { sampler.Get(index, 0), sampler.Get(index, 1) };
  return ShadowRaster::Look(this->Target, this->Shapes, point, shift, view);
}

//------------------------------------------------------------------------------
Flux PairVisibility::See(const Vector& place)
{
  ShadowRaster::View view;
  this->LookFrom(place, view);
  return ShadowRaster::Weigh(view, this->Normal, this->Weights);
}

//------------------------------------------------------------------------------
// Calls visit(place, area) for the points of one grid until it returns false.
template <typename Visit>
bool PairVisibility::VisitGrid(int cuts, const Visit& visit) const
{
  bool goesOn = true;
  for (int corner = 1; corner + 1 < this->Outer.Count && goesOn; ++corner)
  {
    const Vector& origin = this->Outer.Corners[0];
    const Vector u = (this->Outer.Corners[corner] - origin) / cuts;
    const Vector v = (this->Outer.Corners[corner + 1] - origin) / cuts;
    // Three points for each triangle, which is half of a parallelogram.
    const double area = u.cross(v).norm() / 6.0;
    goesOn =
      VisitTriangle(origin, u, v, cuts, [&](const Vector& place) { return visit(place, area); });
  }
  return goesOn;
}

//------------------------------------------------------------------------------
// Calls visit(place) for the corners and the middles of the edges until it returns false.
template <typename Visit>
bool PairVisibility::VisitRim(const Visit& visit) const
{
  for (int corner = 0; corner < this->Outer.Count; ++corner)
  {
    const Vector& begin = this->Outer.Corners[corner];
    const Vector& end = this->Outer.Corners[(corner + 1) % this->Outer.Count];
    if (!visit(begin) || !visit(Vector(0.5 * (begin + end))))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// Whether no point of the first grid and of the rim sees anything. Most pairs with something in
// between are hidden, or seen at once: what points see is weighed only then.
bool PairVisibility::IsHidden()
{
  this->Views.resize(this->GetNumberOfGridPoints(Cuts[0]));
  bool hidden = true;
  this->VisitGrid(Cuts[0],
    [&](const Vector& place, double)
    {
      const int index = this->NumberOfPoints;
      hidden = !this->LookFrom(place, this->Views[index]) && hidden;
      return true;
    });
  const int points = this->NumberOfPoints;
  ShadowRaster::View view;
  hidden =
    hidden && this->VisitRim([&](const Vector& place) { return !this->LookFrom(place, view); });
  this->NumberOfPoints = points;
  return hidden;
}

//------------------------------------------------------------------------------
// Three for each triangle.
int PairVisibility::GetNumberOfGridPoints(int cuts) const
{
  return 3 * (this->Outer.Count - 2) * cuts * cuts;
}

//------------------------------------------------------------------------------
// Samples may share weights where the target is so far away that this is nothing beside the
// tolerance.
void PairVisibility::ChooseWeights(double tolerance)
{
  const double far = std::max(1.0, CoarseError / tolerance);
  const double apart = (this->Outer.GetMiddle() - this->Origin).norm() - GetExtent(this->Outer);
  const double extent = GetExtent(this->Inner);
  this->Weights = apart > 0.0 && apart * apart > far * extent * extent
    ? ShadowRaster::Weights::Coarse
    : ShadowRaster::Weights::Fine;
}

//------------------------------------------------------------------------------
// The visible part of the exchange by one grid.
double PairVisibility::SeeFromGrid(int cuts)
{
  Flux total;
  this->VisitGrid(cuts,
    [&](const Vector& place, double area)
    {
      total.Add(area, this->See(place));
      return true;
    });
  return total.GetShare();
}

//------------------------------------------------------------------------------
// The points of a grid lie inside: what only the rim sees shows at the corners and between them.
double PairVisibility::GetRimDifference(double share)
{
  double sum = 0.0;
  this->VisitRim(
    [&](const Vector& place)
    {
      sum += std::abs(this->See(place).GetShare(share) - share);
      return true;
    });
  return sum / (2.0 * this->Outer.Count);
}

//------------------------------------------------------------------------------
PairVisibility::Share PairVisibility::Look()
{
  if (this->WalledOff || this->IsHidden())
  {
    return { 0.0, 0.0 };
  }
  Share share;
  this->ChooseWeights(FirstError);
  Flux total;
  std::size_t index = 0;
  this->VisitGrid(Cuts[0],
    [&](const Vector&, double area)
    {
      total.Add(area, ShadowRaster::Weigh(this->Views[index++], this->Normal, this->Weights));
      return true;
    });
  share.Value = total.GetShare();
  if (this->AreClose && share.Value > 0.0)
  {
    return this->IntegrateExactly(1.0);
  }
  const double rim = share.Value > 0.0 ? 0.0 : this->GetRimDifference(share.Value);
  // What is seen at a grazing angle alone is worth nothing.
  const bool isDark = share.Value <= 0.0 && rim <= 0.0;
  share.Error = isDark ? 0.0 : std::max(FirstError, RimPart * rim);
  return share;
}

//------------------------------------------------------------------------------
PairVisibility::Share PairVisibility::IntegrateExactly(double tolerance)
{
  if (!this->IsExactReady)
  {
    this->Exact.Set(this->Outer, this->Inner, this->Open, this->HullRounding);
    Polygon shape;
    for (const Occluder& occluder : this->Occluders)
    {
      if (this->ShapeOccluder(occluder, shape))
      {
        this->Exact.AddOccluder(shape);
      }
    }
    this->IsExactReady = true;
  }
  const ExactVisibility::Estimate visible = this->Exact.Integrate(tolerance * this->Open);
  return { std::min(1.0, visible.Value / this->Open), visible.Error / this->Open };
}

//------------------------------------------------------------------------------
// Grids are combined by their numbers of points. The error is that of the latest grid against all
// before, which the new one has reduced.
PairVisibility::Share PairVisibility::Integrate(double tolerance, double looked)
{
  if (this->WalledOff)
  {
    return { 0.0, 0.0 };
  }
  if (this->AreClose)
  {
    return this->IntegrateExactly(tolerance);
  }
  this->ChooseWeights(tolerance);
  this->NumberOfPoints = 0;
  Share share;
  double sum = 0.0;
  double weights = 0.0;
  double previous = 0.0;
  double rim = -1.0; // not known yet
  for (const int cuts : Cuts)
  {
    const bool isKnown = cuts == Cuts[0] && looked > 0.0;
    this->NumberOfPoints += isKnown ? this->GetNumberOfGridPoints(cuts) : 0;
    const double latest = isKnown ? looked : this->SeeFromGrid(cuts);
    const double weight = cuts * cuts;
    const double change = weights > 0.0 ? std::abs(latest - sum / weights) : 1.0;
    sum += weight * latest;
    weights += weight;
    share.Value = sum / weights;
    // Two grids may agree by luck: never less than what they usually are off by.
    double usual = UsualPart * FirstError / weight +
      RasterError / std::sqrt(this->GetNumberOfGridPoints(1) * weights);
    if (share.Value <= 0.0)
    {
      rim = rim < 0.0 ? this->GetRimDifference(share.Value) : rim;
      usual = 0.0;
    }
    // What only a band at the rim sees, narrower than the grid.
    usual = share.Value * cuts < rim ? std::max(usual, RimPart * rim / cuts) : usual;
    share.Error = std::max(std::max(0.75 * change, 0.25 * previous), usual);
    previous = weights > weight ? change : 0.0;
    const double work = static_cast<double>(this->NumberOfPoints) * (this->Shapes.GetCount() + 8);
    if (share.Error <= tolerance || (work > MaximumWork && weights > weight))
    {
      break;
    }
  }
  if (share.Error > tolerance && this->Open > 0.0)
  {
    const Share exact = this->IntegrateExactly(tolerance);
    return exact.Error < share.Error ? exact : share;
  }
  return share;
}
} // namespace LightTransport
