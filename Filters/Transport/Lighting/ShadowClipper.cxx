// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/ShadowClipper.h"

#include "Scene/PatchScene.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
using Vector = ShadowClipper::Vector;

/// With more patches before it a piece is not cut at all, only halved until it is small: that would
/// take longer than a user who aborts should wait.
constexpr std::size_t MostBlockers = 30000;
/// With more patches before it a piece is halved.
constexpr std::size_t MostAtOnce = 32;
/// Pieces smaller than this part of the patch are rounding noise.
constexpr double LeastPart = 1e-15;
/// Of distances from lines, whose unit is the scene's diagonal.
constexpr double Rounding = 1e-15;

//------------------------------------------------------------------------------
/// A side of the space between a piece and a light: inside is where Normal . x >= Offset.
struct Wall
{
  Vector Normal;
  double Offset;
};

//------------------------------------------------------------------------------
/// The wall on an edge of a piece, towards a light far away that comes from all directions within a
/// radius: as far in as the directions that lean outwards most leave it. False where some of them
/// lie along the plane.
bool MakeWall(const Vector& point, const Vector& inwards, const Vector& normal,
  const Vector& towards, double radius, Wall& wall)
{
  const double across = inwards.dot(towards);
  const double up = normal.dot(towards);
  const double spread = std::tan(radius) / std::hypot(across, up);
  if (!(spread < 1.0))
  {
    return false;
  }
  // Of the projection on the plane that the two vectors span.
  const double angle = std::atan2(up, across) + std::asin(spread);
  wall.Normal = std::sin(angle) * inwards - std::cos(angle) * normal;
  wall.Offset = wall.Normal.dot(point);
  return angle > 0.0 && angle < std::acos(-1.0);
}

//------------------------------------------------------------------------------
bool MeetsNode(const std::vector<Wall>& walls, const PatchTree::Node& node)
{
  const Vector middle = 0.5 * (node.Lower + node.Upper);
  const Vector half = 0.5 * (node.Upper - node.Lower);
  return std::all_of(walls.begin(), walls.end(),
    [&](const Wall& wall)
    { return wall.Normal.dot(middle) + wall.Normal.cwiseAbs().dot(half) > wall.Offset; });
}

//------------------------------------------------------------------------------
bool MeetsPatch(const std::vector<Wall>& walls, const PatchScene& scene, vtkIdType patch)
{
  const int corners = scene.GetNumberOfCorners(patch);
  for (const Wall& wall : walls)
  {
    bool isInside = false;
    for (int corner = 0; corner < corners && !isInside; ++corner)
    {
      isInside = wall.Normal.dot(scene.GetCorner(patch, corner)) > wall.Offset;
    }
    if (!isInside)
    {
      return false;
    }
  }
  return true;
}
} // namespace

//------------------------------------------------------------------------------
ShadowClipper::ShadowClipper(const LitPatch& patch)
  : Lit(patch), Center(patch.GetScene().GetCentroid(patch.GetId()))
{
  this->Axes[0] = patch.GetNormal().unitOrthogonal();
  this->Axes[1] = patch.GetNormal().cross(this->Axes[0]);
  const Polygon& shape = patch.GetShape();
  for (int corner = 0; corner < shape.Count; ++corner)
  {
    const Vector offset = shape.Corners[corner] - this->Center;
    this->Whole.emplace_back(offset.dot(this->Axes[0]), offset.dot(this->Axes[1]));
  }
}

//------------------------------------------------------------------------------
double ShadowClipper::GetArea(const Piece& piece)
{
  double twice = 0.0;
  for (std::size_t corner = 1; corner + 1 < piece.size(); ++corner)
  {
    const Place a = piece[corner] - piece[0];
    const Place b = piece[corner + 1] - piece[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

//------------------------------------------------------------------------------
ShadowClipper::Place ShadowClipper::Choose(const Piece& piece, double u, double v)
{
  double left = u * GetArea(piece);
  for (std::size_t corner = 1;; ++corner)
  {
    const double area = GetArea({ piece[0], piece[corner], piece[corner + 1] });
    if (left <= area || corner + 2 == piece.size())
    {
      // Even on a triangle: the root of what is before it, from its first corner.
      const double root = std::sqrt(area > 0.0 ? std::min(left / area, 1.0) : 0.0);
      return piece[0] +
        root * ((1.0 - v) * (piece[corner] - piece[0]) + v * (piece[corner + 1] - piece[0]));
    }
    left -= area;
  }
}

//------------------------------------------------------------------------------
// Heights are distances, but where the plane is (nearly) parallel to that of the patch.
ShadowClipper::Line ShadowClipper::MakeLine(const Vector& point, const Vector& normal) const
{
  const Place slope(normal.dot(this->Axes[0]), normal.dot(this->Axes[1]));
  const double offset = normal.dot(this->Center - point);
  const double size = std::max(slope.norm(), std::abs(offset));
  return size > 0.0 ? Line{ slope / size, offset / size } : Line{ slope, -1.0 };
}

//------------------------------------------------------------------------------
void ShadowClipper::Split(const Piece& piece, const std::vector<double>& heights, Piece& front,
  Piece& behind)
{
  for (std::size_t corner = 0; corner < piece.size(); ++corner)
  {
    const std::size_t next = (corner + 1) % piece.size();
    if (heights[corner] >= 0.0)
    {
      front.push_back(piece[corner]);
    }
    if (heights[corner] <= 0.0)
    {
      behind.push_back(piece[corner]);
    }
    if ((heights[corner] > 0.0 && heights[next] < 0.0) ||
      (heights[corner] < 0.0 && heights[next] > 0.0))
    {
      const double part = heights[corner] / (heights[corner] - heights[next]);
      const Place cut = piece[corner] + part * (piece[next] - piece[corner]);
      front.push_back(cut);
      behind.push_back(cut);
    }
  }
}

//------------------------------------------------------------------------------
void ShadowClipper::Cut(const Vector& point, const Vector& normal, Piece& piece) const
{
  const Line line = this->MakeLine(point, normal);
  std::vector<double> heights;
  for (const Place& corner : piece)
  {
    heights.push_back(line.GetHeight(corner));
  }
  Piece front, behind;
  Split(piece, heights, front, behind);
  piece = front;
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> ShadowClipper::FindBlockers(const Piece& piece, const Origin& light,
  double radius) const
{
  const PatchScene& scene = this->Lit.GetScene();
  const Vector& normal = this->Lit.GetNormal();
  std::vector<vtkIdType> found;
  if (!this->Lit.HasShadows() || piece.size() < 3)
  {
    return found;
  }
  std::vector<Wall> walls = { { normal, normal.dot(this->Center) } };
  for (std::size_t corner = 0; corner < piece.size(); ++corner)
  {
    const Vector point = this->GetPoint(piece[corner]);
    const Vector edge = this->GetPoint(piece[(corner + 1) % piece.size()]) - point;
    const Vector inwards = normal.cross(edge).normalized();
    Wall wall;
    if (light.IsPoint)
    {
      const Vector across = (light.Position - point).cross(edge).normalized();
      wall.Normal = across.dot(inwards) < 0.0 ? -across : across;
      wall.Offset = wall.Normal.dot(point);
      walls.push_back(wall);
    }
    else if (MakeWall(point, inwards, normal, -light.Direction, radius, wall))
    {
      walls.push_back(wall);
    }
  }
  std::vector<int> open(1, 0);
  while (!open.empty())
  {
    const PatchTree::Node& node = scene.GetTree().GetNode(open.back());
    open.pop_back();
    if (!MeetsNode(walls, node))
    {
      continue;
    }
    if (!node.IsLeaf())
    {
      open.push_back(node.Left);
      open.push_back(node.Left + 1);
      continue;
    }
    for (vtkIdType patch = node.First; patch < node.Last; ++patch)
    {
      if (patch != this->Lit.GetId() && MeetsPatch(walls, scene, patch) &&
        this->Lit.IsInFront(patch))
      {
        found.push_back(patch);
      }
    }
  }
  return found;
}

//------------------------------------------------------------------------------
// False where the patch hides nothing from the light: it is seen edge-on, or the light touches it.
bool ShadowClipper::MakeShadow(vtkIdType blocker, const Origin& light, Shadow& shadow) const
{
  const PatchScene& scene = this->Lit.GetScene();
  const PatchPlane plane = scene.GetPlane(blocker);
  const double height =
    light.IsPoint ? plane.GetCertainHeight(light.Position) : -plane.Normal.dot(light.Direction);
  if (std::abs(height) <= (light.IsPoint ? LightSource::Clearance : Rounding))
  {
    return false;
  }
  const double side = height > 0.0 ? 1.0 : -1.0;
  const int corners = scene.GetNumberOfCorners(blocker);
  for (int corner = 0; corner < corners; ++corner)
  {
    const Vector& begin = scene.GetCorner(blocker, corner);
    const Vector edge = scene.GetCorner(blocker, (corner + 1) % corners) - begin;
    const Vector ray = light.IsPoint ? Vector(begin - light.Position) : light.Direction;
    shadow.Lines.push_back(this->MakeLine(begin, -side * ray.cross(edge).normalized()));
  }
  // Not scaled, for its heights are compared with the tolerance.
  const Vector normal = -side * plane.Normal;
  shadow.Lines.push_back({ Place(normal.dot(this->Axes[0]), normal.dot(this->Axes[1])),
    normal.dot(this->Center - plane.Origin) });
  const Vector offset = plane.Origin - this->Center;
  shadow.Foot = Place(offset.dot(this->Axes[0]), offset.dot(this->Axes[1]));
  shadow.Above = offset.dot(this->Lit.GetNormal());
  shadow.Rounding = plane.Rounding;
  shadow.Slope = plane.Slope;
  return true;
}

//------------------------------------------------------------------------------
double ShadowClipper::Shadow::GetTolerance(const Place& place) const
{
  return this->Rounding +
    this->Slope * std::sqrt((place - this->Foot).squaredNorm() + this->Above * this->Above);
}

//------------------------------------------------------------------------------
bool ShadowClipper::Misses(const Shadow& shadow, const Piece& piece)
{
  return std::any_of(shadow.Lines.begin(), shadow.Lines.end(),
    [&](const Line& line)
    {
      const double least = &line == &shadow.Lines.back() ? shadow.Rounding : Rounding;
      return std::all_of(piece.begin(), piece.end(),
        [&](const Place& corner) { return line.GetHeight(corner) <= least; });
    });
}

//------------------------------------------------------------------------------
bool ShadowClipper::Covers(const Shadow& shadow, const Piece& piece)
{
  return std::all_of(shadow.Lines.begin(), shadow.Lines.end(),
    [&](const Line& line)
    {
      const bool isPlane = &line == &shadow.Lines.back();
      return std::all_of(piece.begin(), piece.end(),
        [&](const Place& corner)
        { return line.GetHeight(corner) >= (isPlane ? shadow.GetTolerance(corner) : -Rounding); });
    });
}

//------------------------------------------------------------------------------
void ShadowClipper::Divide(const Piece& piece, const Origin& light,
  const std::vector<vtkIdType>& blockers, double least, Result& result) const
{
  if (blockers.size() > MostBlockers)
  {
    Scatter(piece, least, result);
    return;
  }
  std::vector<Shadow> shadows;
  shadows.reserve(blockers.size());
  for (const vtkIdType blocker : blockers)
  {
    Shadow shadow;
    if (this->MakeShadow(blocker, light, shadow))
    {
      shadows.push_back(std::move(shadow));
    }
  }
  Shadows all;
  for (const Shadow& shadow : shadows)
  {
    all.push_back(&shadow);
  }
  this->DividePiece(piece, all, least, result);
}

//------------------------------------------------------------------------------
void ShadowClipper::DividePiece(const Piece& piece, const Shadows& before, double least,
  Result& result) const
{
  const double area = GetArea(piece);
  if (area <= LeastPart * GetArea(this->Whole))
  {
    return;
  }
  Shadows shadows;
  for (const Shadow* shadow : before)
  {
    if (Misses(*shadow, piece))
    {
      continue;
    }
    if (Covers(*shadow, piece))
    {
      return;
    }
    shadows.push_back(shadow);
  }
  if (shadows.empty())
  {
    result.Lit.push_back(piece);
  }
  else if (shadows.size() <= MostAtOnce)
  {
    this->CutShadow(piece, shadows, least, result);
  }
  else if (area <= least)
  {
    result.Undecided.push_back(piece);
  }
  else
  {
    for (const Piece& half : Halve(piece))
    {
      this->DividePiece(half, shadows, least, result);
    }
  }
}

//------------------------------------------------------------------------------
void ShadowClipper::Scatter(const Piece& piece, double least, Result& result)
{
  if (GetArea(piece) <= least)
  {
    result.Undecided.push_back(piece);
    return;
  }
  for (const Piece& half : Halve(piece))
  {
    Scatter(half, least, result);
  }
}

//------------------------------------------------------------------------------
// Across its longer side.
std::array<ShadowClipper::Piece, 2> ShadowClipper::Halve(const Piece& piece)
{
  Place low = piece[0];
  Place high = piece[0];
  for (const Place& corner : piece)
  {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const int axis = high.x() - low.x() > high.y() - low.y() ? 0 : 1;
  const double middle = 0.5 * (low[axis] + high[axis]);
  std::vector<double> heights;
  for (const Place& corner : piece)
  {
    heights.push_back(corner[axis] - middle);
  }
  std::array<Piece, 2> halves;
  Split(piece, heights, halves[0], halves[1]);
  return halves;
}

//------------------------------------------------------------------------------
// What is outside one line after another goes on without the shadow; what is inside all is dark.
void ShadowClipper::CutShadow(const Piece& piece, const Shadows& shadows, double least,
  Result& result) const
{
  const Shadow& shadow = *shadows[0];
  const Shadows others(shadows.begin() + 1, shadows.end());
  Piece rest = piece;
  for (const Line& line : shadow.Lines)
  {
    const bool isPlane = &line == &shadow.Lines.back();
    std::vector<double> heights;
    bool isDark = false;
    bool isLit = false;
    for (const Place& corner : rest)
    {
      const double height = line.GetHeight(corner);
      const double most = isPlane ? shadow.GetTolerance(corner) : Rounding;
      heights.push_back(std::abs(height) <= most ? 0.0 : height);
      isDark = isDark || heights.back() > 0.0;
      isLit = isLit || heights.back() < 0.0;
    }
    if (!isDark)
    {
      this->DividePiece(rest, others, least, result);
      return;
    }
    if (isLit)
    {
      Piece front, behind;
      Split(rest, heights, front, behind);
      this->DividePiece(behind, others, least, result);
      rest = front;
    }
  }
}
} // namespace LightTransport
