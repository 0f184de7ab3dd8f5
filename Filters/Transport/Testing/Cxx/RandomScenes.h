// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Random small scenes of what tools of view factors stumble over: sheets whose sides are meshed
 * differently, fins and kerbs on common edges, slivers, boxes that touch, rooms with a party wall,
 * floors with a slab in between. Each is made at the origin, about as large as 1, and then placed:
 * turned, scaled, shifted, rounded to single precision.
 */
#ifndef RandomScenes_h
#define RandomScenes_h

#include "LightTransportTesting.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace LightTransportTesting
{
struct RandomScene
{
  std::string Kind;
  std::vector<Corners> Polygons;
  double Narrowest = 1.0; ///< width of the narrowest polygon
};

struct Placement
{
  std::string Name;
  Eigen::Matrix3d Turn = Eigen::Matrix3d::Identity();
  double Scale = 1.0;
  Vector Offset = Vector::Zero();
  bool Single = false;
};

//------------------------------------------------------------------------------
/// The polygons as they are stored.
inline std::vector<Corners> Place(std::vector<Corners> polygons, const Placement& placement)
{
  for (Corners& polygon : polygons)
  {
    for (Vector& corner : polygon)
    {
      corner = placement.Scale * (placement.Turn * corner) + placement.Offset;
      if (placement.Single)
      {
        corner = corner.cast<float>().cast<double>();
      }
    }
  }
  return polygons;
}

//------------------------------------------------------------------------------
inline vtkSmartPointer<vtkPolyData> MakeData(const std::vector<Corners>& polygons, bool single)
{
  Surface surface(single);
  for (const Corners& polygon : polygons)
  {
    std::vector<Point> points;
    for (const Vector& corner : polygon)
    {
      points.push_back({ corner.x(), corner.y(), corner.z() });
    }
    surface.AddPolygon(points);
  }
  return surface.Get();
}

//------------------------------------------------------------------------------
/// Whether the edges of one convex polygon meet the inside of the other, or the other way round.
inline bool Crosses(const Corners& one, const Corners& two)
{
  const auto pierces = [](const Corners& edges, const Corners& polygon)
  {
    const Vector normal = (polygon[1] - polygon[0]).cross(polygon[2] - polygon[0]);
    for (std::size_t k = 0; k < edges.size(); ++k)
    {
      const Vector& from = edges[k];
      const Vector& to = edges[(k + 1) % edges.size()];
      const double before = (from - polygon[0]).dot(normal);
      const double after = (to - polygon[0]).dot(normal);
      if (before * after >= 0.0)
      {
        continue;
      }
      const Vector at = from + before / (before - after) * (to - from);
      bool inside = true;
      for (std::size_t l = 0; l < polygon.size(); ++l)
      {
        const Vector edge = polygon[(l + 1) % polygon.size()] - polygon[l];
        inside = inside && edge.cross(at - polygon[l]).dot(normal) > 0.0;
      }
      if (inside)
      {
        return true;
      }
    }
    return false;
  };
  return pierces(one, two) || pierces(two, one);
}

//------------------------------------------------------------------------------
/// The area of a convex polygon.
inline double GetArea(const Corners& polygon)
{
  Vector twice = Vector::Zero();
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
  {
    twice += (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]);
  }
  return 0.5 * twice.norm();
}

//------------------------------------------------------------------------------
/// How wide a polygon is across its longest edge, on average.
inline double GetWidth(const Corners& polygon)
{
  double longest = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    longest = std::max(longest, (polygon[(k + 1) % polygon.size()] - polygon[k]).norm());
  }
  return GetArea(polygon) / longest;
}

//------------------------------------------------------------------------------
/// The same surfaces told in another way, and which polygon each of its polygons is part of.
struct Retold
{
  std::vector<Corners> Polygons;
  std::vector<std::size_t> Parts;
};

//------------------------------------------------------------------------------
inline void TurnCorners(Retold& retold, Random& numbers)
{
  for (Corners& polygon : retold.Polygons)
  {
    std::rotate(polygon.begin(), polygon.begin() + numbers.Index(static_cast<int>(polygon.size())),
      polygon.end());
  }
}

//------------------------------------------------------------------------------
/// Cut one polygon from a point inside to its corners, or a parallelogram along its diagonal.
inline void CutOne(Retold& retold, Random& numbers)
{
  const int which = numbers.Index(static_cast<int>(retold.Polygons.size()));
  const Corners polygon = retold.Polygons[which];
  const std::size_t part = retold.Parts[which];
  retold.Polygons.erase(retold.Polygons.begin() + which);
  retold.Parts.erase(retold.Parts.begin() + which);
  std::vector<Corners> pieces;
  if (polygon.size() == 4 && numbers.Chance(0.5))
  {
    pieces = { { polygon[0], polygon[1], polygon[2] }, { polygon[0], polygon[2], polygon[3] } };
  }
  else
  {
    const Vector middle = 0.4 * polygon[0] + 0.35 * polygon[1] + 0.25 * polygon[2];
    for (std::size_t k = 0; k < polygon.size(); ++k)
    {
      pieces.push_back({ middle, polygon[k], polygon[(k + 1) % polygon.size()] });
    }
  }
  for (const Corners& piece : pieces)
  {
    retold.Polygons.push_back(piece);
    retold.Parts.push_back(part);
  }
}

//------------------------------------------------------------------------------
/// Polygons that begin at other corners, and one of them in pieces.
inline Retold Retell(const std::vector<Corners>& polygons, int number)
{
  Random numbers(MixBits(number + 77));
  Retold retold;
  retold.Polygons = polygons;
  for (std::size_t k = 0; k < polygons.size(); ++k)
  {
    retold.Parts.push_back(k);
  }
  TurnCorners(retold, numbers);
  CutOne(retold, numbers);
  return retold;
}

//------------------------------------------------------------------------------
class SceneMaker
{
public:
  explicit SceneMaker(std::uint64_t seed) : Numbers(MixBits(seed + 0x5EED)) {}

  static const std::vector<std::string>& GetKinds()
  {
    static const std::vector<std::string> kinds = { "Sheets", "Fins", "Slivers", "Boxes", "Rooms",
      "Floors", "Mixed" };
    return kinds;
  }

  RandomScene Make(const std::string& kind)
  {
    this->Scene = RandomScene();
    this->Scene.Kind = kind;
    if (kind == "Sheets")
    {
      this->MakeSheets();
    }
    else if (kind == "Fins")
    {
      this->MakeFins();
    }
    else if (kind == "Slivers")
    {
      this->MakeSlivers();
    }
    else if (kind == "Boxes")
    {
      this->MakeBoxes();
    }
    else if (kind == "Rooms")
    {
      this->MakeRooms();
    }
    else if (kind == "Floors")
    {
      this->MakeFloors();
    }
    else
    {
      this->MakeMixture();
    }
    this->MeasureWidths();
    return this->Scene;
  }

  /// Of one in three scenes the points are single; large offsets are for double precision.
  Placement MakePlacement()
  {
    Random& numbers = this->Numbers;
    Placement placement;
    if (numbers.Chance(0.8))
    {
      placement.Turn = numbers.Rotation();
    }
    placement.Single = numbers.Chance(0.4);
    placement.Scale = numbers.Chance(0.3) ? 1.0 : numbers.Scale(1e-6, 1e6);
    if (placement.Single)
    {
      const double offsets[3] = { 0.0, 10.0, 100.0 };
      const int which = numbers.Index(3);
      placement.Offset = offsets[which] * placement.Scale * Vector(1.0, -0.5, 0.2);
      placement.Name = which == 0 ? "float" : which == 1 ? "float, 10 off" : "float, 100 off";
    }
    else if (numbers.Chance(0.3))
    {
      placement.Scale = numbers.Scale(1.0, 100.0);
      placement.Offset = { 6.1e5, 5.8e6, 758.0 };
      placement.Name = "double, map offset";
    }
    else
    {
      placement.Name = "double";
    }
    return placement;
  }

private:
  void Add(const Corners& polygon) { this->Scene.Polygons.push_back(polygon); }

  /// A parallelogram whose front is where u x v points, in n x m.
  void AddGrid(const Vector& origin, const Vector& u, const Vector& v, int n, int m)
  {
    const auto at = [&](int i, int j) {
      return Vector(origin + u * (static_cast<double>(i) / n) + v * (static_cast<double>(j) / m));
    };
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < m; ++j)
      {
        this->Add({ at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) });
      }
    }
  }

  /// A parallelogram in one, a grid or two triangles.
  void AddMeshed(const Vector& origin, const Vector& u, const Vector& v)
  {
    const double kind = this->Numbers.Uniform();
    if (kind < 0.5)
    {
      this->AddGrid(origin, u, v, 1, 1);
    }
    else if (kind < 0.75)
    {
      const int n = 1 + this->Numbers.Index(3);
      this->AddGrid(origin, u, v, n, n == 1 ? 2 : 1 + this->Numbers.Index(2));
    }
    else
    {
      this->Add({ origin, origin + u, origin + u + v });
      this->Add({ origin, origin + u + v, origin + v });
    }
  }

  /// Both sides of a parallelogram.
  void AddSheet(const Vector& origin, const Vector& u, const Vector& v)
  {
    if (this->Numbers.Chance(0.5))
    {
      this->AddGrid(origin, u, v, 1, 1);
      Corners back = this->Scene.Polygons.back();
      std::reverse(back.begin(), back.end());
      this->Add(back);
    }
    else
    {
      this->AddMeshed(origin, u, v);
      this->AddMeshed(origin, v, u);
    }
  }

  /// Both sides of a triangle; the back may be in two.
  void AddSheet(const Vector& a, const Vector& b, const Vector& c, bool divided)
  {
    this->Add({ a, b, c });
    if (divided)
    {
      const Vector middle = a + this->Numbers.Uniform(0.3, 0.7) * (b - a);
      this->Add({ c, b, middle });
      this->Add({ c, middle, a });
    }
    else
    {
      this->Add({ c, b, a });
    }
  }

  /// A box seen from outside or inside; faces, one bit each: z-, z+, y-, y+, x-, x+.
  void AddBox(const Vector& low, const Vector& high, bool inside, int faces)
  {
    const Vector x(high.x() - low.x(), 0, 0), y(0, high.y() - low.y(), 0),
      z(0, 0, high.z() - low.z());
    const Vector origins[6] = { low, low + z, low, low + y, low, low + x };
    const Vector us[6] = { y, x, x, z, z, y };
    const Vector vs[6] = { x, y, z, x, y, z };
    for (int face = 0; face < 6; ++face)
    {
      if ((faces >> face & 1) != 0)
      {
        inside ? this->AddMeshed(origins[face], vs[face], us[face])
               : this->AddMeshed(origins[face], us[face], vs[face]);
      }
    }
  }

  bool IsFree(const std::vector<Corners>& polygons, std::size_t begin) const
  {
    for (std::size_t k = begin; k < polygons.size(); ++k)
    {
      for (std::size_t l = 0; l < begin; ++l)
      {
        if (Crosses(polygons[k], polygons[l]))
        {
          return false;
        }
      }
    }
    return true;
  }

  /// A sheet somewhere in a box that cuts nothing, if one is found.
  void AddFreeSheet(const Vector& low, const Vector& high, double size)
  {
    Random& numbers = this->Numbers;
    for (int attempt = 0; attempt < 30; ++attempt)
    {
      const std::size_t begin = this->Scene.Polygons.size();
      Vector middle;
      for (int axis = 0; axis < 3; ++axis)
      {
        middle[axis] = numbers.Uniform(low[axis], high[axis]);
      }
      const Vector u = size * numbers.Uniform(0.3, 1.0) * numbers.Point().normalized();
      const Vector v = size * numbers.Uniform(0.3, 1.0) * u.cross(numbers.Point()).normalized();
      numbers.Chance(0.7)
        ? this->AddSheet(middle - 0.5 * (u + v), u, v)
        : this->AddSheet(middle - 0.5 * u, middle + 0.5 * u, middle + v, numbers.Chance(0.5));
      bool contained = true;
      for (std::size_t k = begin; k < this->Scene.Polygons.size(); ++k)
      {
        for (const Vector& corner : this->Scene.Polygons[k])
        {
          contained =
            contained && (corner - low).minCoeff() >= 0.0 && (high - corner).minCoeff() >= 0.0;
        }
      }
      if (contained && this->IsFree(this->Scene.Polygons, begin))
      {
        return;
      }
      this->Scene.Polygons.resize(begin);
    }
  }

  void MakeSheets()
  {
    const int count = 2 + this->Numbers.Index(4);
    for (int k = 0; k < count; ++k)
    {
      this->AddFreeSheet(Vector::Constant(-0.8), Vector::Constant(0.8), 1.0);
    }
  }

  /// A floor, a kerb and one or two sheets stand on one edge, along y.
  void MakeFins()
  {
    Random& numbers = this->Numbers;
    const double degree = vtkMath::Pi() / 180.0;
    const auto away = [degree](double angle, double length)
    { return Vector(length * std::cos(angle * degree), 0.0, length * std::sin(angle * degree)); };
    const Vector y(0, 1, 0);
    const double opening = numbers.Chance(0.5) ? 90.0 : numbers.Uniform(50.0, 150.0);
    const double height = numbers.Scale(0.01, 1.0);
    // Fronts of both in the opening.
    this->AddMeshed(Vector::Zero(), away(0.0, numbers.Uniform(0.3, 1.0)), y);
    this->AddMeshed(Vector::Zero(), y, away(opening, height));
    const int fins = 1 + numbers.Index(2);
    for (int k = 0; k < fins; ++k)
    {
      const double angle = opening * (k + numbers.Uniform(0.3, 0.7)) / fins;
      const double begin = numbers.Chance(0.4) ? 0.0 : numbers.Uniform(0.0, 0.5);
      const double end = numbers.Chance(0.4) ? 1.0 : numbers.Uniform(begin + 0.2, 1.0);
      const double length = std::max(0.01 * (end - begin), height * numbers.Scale(0.05, 2.0));
      this->AddSheet(begin * y, (end - begin) * y, away(angle, length));
    }
  }

  /// Triangles with an edge on one line.
  void MakeSlivers()
  {
    Random& numbers = this->Numbers;
    const int count = 3 + numbers.Index(2);
    const double first = numbers.Uniform(0.0, 360.0);
    for (int k = 0; k < count; ++k)
    {
      const double angle =
        (first + (k + numbers.Uniform(0.0, 0.6)) * numbers.Uniform(200, 360) / count) *
        vtkMath::Pi() / 180.0;
      const double begin = numbers.Chance(0.6) ? 0.0 : numbers.Uniform(0.0, 0.4);
      const double end = numbers.Chance(0.6) ? 1.0 : numbers.Uniform(begin + 0.2, 1.0);
      const double height = (end - begin) * numbers.Scale(0.01, 1.0);
      const Vector tip(height * std::cos(angle), numbers.Uniform(begin, end),
        height * std::sin(angle));
      this->AddSheet({ 0, begin, 0 }, { 0, end, 0 }, tip, numbers.Chance(0.3));
    }
    // Two sheets in one half-plane would overlap.
    for (std::size_t k = 0; k < this->Scene.Polygons.size(); ++k)
    {
      if (!this->IsFree(this->Scene.Polygons, k))
      {
        this->Scene.Polygons.resize(k);
      }
    }
  }

  /// Boxes on a floor that may touch.
  void MakeBoxes()
  {
    Random& numbers = this->Numbers;
    this->AddGrid({ -0.3, -0.3, 0 }, { 1.6, 0, 0 }, { 0, 1.6, 0 }, 1 + numbers.Index(2),
      1 + numbers.Index(2));
    const bool touching = numbers.Chance(0.5);
    const int faces = numbers.Chance(0.5) ? 0x3F : 0x3E;
    const double end = numbers.Uniform(0.3, 0.5);
    this->AddBox({ 0, 0, 0 }, { end, numbers.Uniform(0.3, 1.0), numbers.Scale(0.05, 1.0) }, false,
      faces);
    const double begin = touching ? end : numbers.Uniform(end + 0.02, 0.8);
    const double back = numbers.Uniform(0.0, 0.2);
    this->AddBox({ begin, back, 0 },
      { begin + numbers.Uniform(0.1, 0.4), back + numbers.Uniform(0.2, 0.8),
        numbers.Scale(0.05, 1.0) },
      false, faces);
  }

  /// Two rooms side by side whose party wall has one polygon more on one side.
  void MakeRooms()
  {
    Random& numbers = this->Numbers;
    const double wall = numbers.Uniform(0.4, 0.7);
    const bool alike = numbers.Chance(0.5);
    const Vector one(wall, 1.0, numbers.Uniform(0.4, 1.0));
    const Vector two(1.2, alike ? 1.0 : numbers.Uniform(0.4, 1.0),
      alike ? one.z() : numbers.Uniform(0.4, 1.0));
    const int open = numbers.Chance(0.3) ? 0x3D : 0x3F;
    this->AddBox(Vector::Zero(), one, true, open);
    this->AddBox({ wall, 0, 0 }, two, true, open);
    if (numbers.Chance(0.5))
    {
      this->AddFreeSheet(Vector::Zero(), one, 0.4);
    }
  }

  /// Two floors that face each other, a slab in between, kerbs on the lower one's edges.
  void MakeFloors()
  {
    Random& numbers = this->Numbers;
    const double height = numbers.Scale(0.05, 1.0);
    const Vector x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    this->AddMeshed(Vector::Zero(), x, y);
    this->AddMeshed(height * z, y, x);
    const double left = numbers.Chance(0.5) ? 0.0 : numbers.Uniform(0.1, 0.4);
    this->AddSheet(left * x + numbers.Uniform(0.2, 0.8) * height * z, numbers.Uniform(0.2, 0.6) * x,
      y);
    if (numbers.Chance(0.5))
    {
      this->AddMeshed(Vector::Zero(), y, numbers.Uniform(0.02, 0.2) * height * z);
    }
  }

  /// A floor, a box with a fin on its upper edge, and sheets.
  void MakeMixture()
  {
    Random& numbers = this->Numbers;
    this->AddMeshed({ -0.5, -0.5, 0 }, { 1.5, 0, 0 }, { 0, 1.5, 0 });
    const Vector high(numbers.Uniform(0.2, 0.5), numbers.Uniform(0.2, 0.5),
      numbers.Uniform(0.1, 0.6));
    this->AddBox(Vector::Zero(), high, false, 0x3E);
    const double angle = numbers.Uniform(-80.0, 170.0) * vtkMath::Pi() / 180.0;
    const double length = high.y() * numbers.Scale(0.02, 1.0);
    if (length * std::sin(angle) > -high.z())
    {
      this->AddSheet({ high.x(), 0, high.z() }, { 0, high.y(), 0 },
        length * Vector(std::cos(angle), 0.0, std::sin(angle)));
    }
    const int sheets = numbers.Index(3);
    for (int k = 0; k < sheets; ++k)
    {
      this->AddFreeSheet({ -0.5, -0.5, 0.01 }, { 1.0, 1.0, 1.0 }, 0.5);
    }
  }

  void MeasureWidths()
  {
    for (const Corners& polygon : this->Scene.Polygons)
    {
      this->Scene.Narrowest = std::min(this->Scene.Narrowest, GetWidth(polygon));
    }
  }

  Random Numbers;
  RandomScene Scene;
};
} // namespace LightTransportTesting

#endif
