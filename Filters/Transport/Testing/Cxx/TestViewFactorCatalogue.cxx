// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// View factors against values that are known: catalogue configurations (Howell, A Catalog of
// Radiation Heat Transfer Configuration Factors) on meshes of several levels, scenes of rectangles
// of which every single factor is known, with and without a wall between them, and closed scenes.
// Wherever a whole row is known, Tolerance must bound the sum of the absolute errors in it, and
// ViewFactorError must cover that sum.
#include "Shared/GaussLegendre.h"
#include "ViewFactorTesting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
// The matrix is single precision: no factor, and no sum of factors, can be better than this.
constexpr double Single = 2e-7;

//------------------------------------------------------------------------------
template <typename... Values>
std::string Text(const Values&... values)
{
  std::ostringstream stream;
  (stream << ... << values);
  return stream.str();
}

//------------------------------------------------------------------------------
/// `errors`: of the first rows, sums of absolute errors.
void CheckRows(vtkViewFactors* factors, const std::vector<double>& errors, const std::string& what)
{
  const std::vector<double> estimates = GetCellValues(factors, "ViewFactorError");
  double worst = 0.0, lack = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    worst = std::max(worst, errors[i]);
    lack = std::max(lack, errors[i] - estimates[i]);
  }
  Check(worst <= factors->GetTolerance() + Single,
    Text(what, ": the error ", worst, " of a row keeps Tolerance ", factors->GetTolerance()));
  Check(lack <= Single, Text(what, ": the error of a row is ", lack, " above its estimate"));
}

//------------------------------------------------------------------------------
/// Rows that must sum to 1, and how far they are from it.
double CheckClosedRows(vtkViewFactors* factors, const Group& rows, const std::string& what)
{
  const std::vector<double> sums = GetCellValues(factors, "ViewFactorSum");
  std::vector<double> errors(rows.Begin);
  double square = 0.0;
  for (vtkIdType i = rows.Begin; i < rows.End; ++i)
  {
    errors.push_back(std::abs(sums[i] - 1.0));
    square += errors.back() * errors.back() / (rows.End - rows.Begin);
  }
  CheckRows(factors, errors, what);
  return std::sqrt(square);
}

//------------------------------------------------------------------------------
// Rectangles: every factor is known
//------------------------------------------------------------------------------

/// An axis-parallel rectangle.
struct Rectangle
{
  int Axis;
  Point Low;
  Point High;
};

//------------------------------------------------------------------------------
std::vector<Rectangle> GetRectangles(vtkPolyData* data)
{
  std::vector<Rectangle> rectangles(data->GetNumberOfCells());
  for (std::size_t cell = 0; cell < rectangles.size(); ++cell)
  {
    double bounds[6];
    data->GetCellBounds(static_cast<vtkIdType>(cell), bounds);
    Rectangle& rectangle = rectangles[cell];
    for (int axis = 0; axis < 3; ++axis)
    {
      rectangle.Low[axis] = bounds[2 * axis];
      rectangle.High[axis] = bounds[2 * axis + 1];
      rectangle.Axis = bounds[2 * axis] == bounds[2 * axis + 1] ? axis : rectangle.Axis;
    }
  }
  return rectangles;
}

//------------------------------------------------------------------------------
/// The sum over all ends of four ranges with alternating signs.
double SumCorners(const std::array<std::array<double, 2>, 4>& ranges,
  const std::function<double(double, double, double, double)>& term)
{
  double sum = 0.0;
  for (int k = 0; k < 16; ++k)
  {
    const int a = k & 1, b = k >> 1 & 1, c = k >> 2 & 1, d = k >> 3;
    sum += ((a + b + c + d) % 2 ? -1.0 : 1.0) *
      term(ranges[0][a], ranges[1][b], ranges[2][c], ranges[3][d]);
  }
  return sum / (2.0 * vtkMath::Pi());
}

//------------------------------------------------------------------------------
/// t atan(t / u) u, also where u = 0.
double AtanTerm(double t, double u)
{
  return u > 0.0 ? t * u * std::atan(t / u) : 0.0;
}

//------------------------------------------------------------------------------
/// The exchange A F of two parallel or perpendicular rectangles in front of each other (Howell C-13
/// and C-15, as sums over corners).
double GetRectangleExchange(const Rectangle& p, const Rectangle& q)
{
  const auto range = [](const Rectangle& r, int axis) {
    return std::array<double, 2>{ r.Low[axis], r.High[axis] };
  };
  if (p.Axis == q.Axis)
  {
    const int x = (p.Axis + 1) % 3, y = (p.Axis + 2) % 3;
    const double z = std::abs(p.Low[p.Axis] - q.Low[p.Axis]);
    return z == 0.0 ? 0.0
                    : std::abs(SumCorners({ range(p, x), range(q, x), range(p, y), range(q, y) },
                        [z](double x1, double x2, double y1, double y2)
                        {
                          const double u = x1 - x2, v = y1 - y2;
                          return AtanTerm(v, std::hypot(u, z)) + AtanTerm(u, std::hypot(v, z)) -
                            0.5 * z * z * std::log(u * u + v * v + z * z);
                        }));
  }
  const int common = 3 - p.Axis - q.Axis;
  const double offsetX = q.Low[q.Axis], offsetXi = p.Low[p.Axis];
  return std::abs(
    SumCorners({ range(p, q.Axis), range(q, p.Axis), range(p, common), range(q, common) },
      [=](double x, double xi, double y, double eta)
      {
        const double c = std::hypot(x - offsetX, xi - offsetXi), d = y - eta;
        const double square = c * c + d * d;
        return square > 0.0 ? AtanTerm(d, c) - 0.25 * (c * c - d * d) * std::log(square) : 0.0;
      }));
}

//------------------------------------------------------------------------------
double GetArea(const Rectangle& r)
{
  return (r.High[(r.Axis + 1) % 3] - r.Low[(r.Axis + 1) % 3]) *
    (r.High[(r.Axis + 2) % 3] - r.Low[(r.Axis + 2) % 3]);
}

//------------------------------------------------------------------------------
/// Compare every factor of a scene of rectangles with what `exchange` says.
void CheckRectangles(vtkPolyData* data, double tolerance, const std::string& what,
  const std::function<double(const Rectangle&, const Rectangle&)>& exchange)
{
  auto factors = ComputeViewFactors(data, tolerance);
  const std::vector<Rectangle> rectangles = GetRectangles(data);
  const vtkIdType patches = data->GetNumberOfCells();
  std::vector<double> errors(patches);
  for (vtkIdType i = 0; i < patches; ++i)
  {
    for (vtkIdType j = 0; j < patches; ++j)
    {
      const double exact = exchange(rectangles[i], rectangles[j]) / GetArea(rectangles[i]);
      errors[i] += std::abs(factors->GetViewFactor(i, j) - exact);
    }
  }
  CheckRows(factors, errors, Text(what, ", Tolerance ", tolerance));
}

//------------------------------------------------------------------------------
void TestParallelPlates()
{
  const double rows[][4] = { { 1, 1, 1, 0.199824895698387 }, { 1, 1, 0.1, 0.826994522397257 },
    { 1, 1, 0.01, 0.980416602925973 }, { 1, 1, 0.001, 0.99800563190758 },
    { 0.1, 10, 1, 0.046708353330323 }, { 1, 1, 10, 0.0031620568387576 },
    { 1, 1, 100, 3.18288667328292e-5 }, { 2, 1, 1, 0.285875384850715 },
    { 1, 10, 1, 0.386382489266135 }, { 0.1, 0.1, 0.05, 0.415253283576 } };
  for (const auto& row : rows)
  {
    for (const int n : { 1, 3, 8 })
    {
      const double a = row[0], b = row[1], c = row[2];
      Surface plates;
      plates.AddGrid({ 0, 0, 0 }, { a, 0, 0 }, { 0, b, 0 }, n, n);
      plates.AddGrid({ 0, 0, c }, { 0, b, 0 }, { a, 0, 0 }, n, n);
      auto data = plates.Get();
      auto factors = ComputeViewFactors(data, 1e-8);
      const double factor =
        GetGroupFactor(factors, GetAreas(data), { 0, n * n }, { n * n, 2 * n * n });
      CheckClose(factor, row[3], Single,
        Text("parallel plates ", a, " x ", b, ", gap ", c, ", ", n, " x ", n));
    }
  }
}

//------------------------------------------------------------------------------
void TestPerpendicularPlates()
{
  const double rows[][4] = { { 1, 1, 1, 0.200043776075403 }, { 1, 2, 1, 0.116426301397681 },
    { 2, 1, 1, 0.232852602795362 }, { 0.1, 1, 1, 0.0432513694006859 },
    { 1, 0.1, 1, 0.432513694006859 }, { 0.01, 1, 1, 0.00489584926850668 },
    { 1, 0.01, 1, 0.489584926850668 }, { 10, 1, 1, 0.249209485790311 },
    { 1, 1, 10, 0.281887806787901 }, { 1, 1, 100, 0.291790067336922 } };
  for (const auto& row : rows)
  {
    for (const int n : { 1, 3, 8 })
    {
      const double h = row[0], w = row[1], l = row[2];
      // The second wall reaches as far below the floor as above it: what is below must not count.
      for (const double below : { 0.0, h })
      {
        Surface plates;
        plates.AddGrid({ 0, 0, 0 }, { w, 0, 0 }, { 0, l, 0 }, n, n);
        plates.AddGrid({ 0, 0, -below }, { 0, l, 0 }, { 0, 0, h + below }, n, n);
        auto data = plates.Get();
        auto factors = ComputeViewFactors(data, 1e-8);
        const double factor =
          GetGroupFactor(factors, GetAreas(data), { 0, n * n }, { n * n, 2 * n * n });
        CheckClose(factor, row[3], Single,
          Text("perpendicular plates h ", h, ", w ", w, ", l ", l, ", below ", below, ", ", n,
            " x ", n));
      }
    }
  }
  // Both a tenth away from the edge that their planes have in common.
  Surface apart;
  apart.AddGrid({ 0.1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  apart.AddGrid({ 0, 0, 0.1 }, { 0, 1, 0 }, { 0, 0, 1 }, 1, 1);
  CheckClose(ComputeViewFactors(apart.Get(), 1e-8)->GetViewFactor(0, 1), 0.154206868494109, Single,
    "perpendicular plates that do not touch");
}

//------------------------------------------------------------------------------
// Every pair of patches of a room and of a corridor, near, far and along edges, is known.
void TestRooms()
{
  for (const double tolerance : { 1e-2, 1e-3, 1e-4, 1e-6, 1e-8 })
  {
    CheckRectangles(MakeRoom(4), tolerance, "room", GetRectangleExchange);
    Surface corridor;
    AddBox(corridor, { 0, 0, 0 }, { 20, 1, 0.25 }, 1.0, true);
    CheckRectangles(corridor.Get(), tolerance, "corridor", GetRectangleExchange);
  }
}

//------------------------------------------------------------------------------
// A wall with a rectangular opening between two plates
//------------------------------------------------------------------------------

/// What stands between the plates: at height Level, open where Low < x, y < High.
struct Opening
{
  double Level;
  std::array<double, 2> Low;
  std::array<double, 2> High;
};

//------------------------------------------------------------------------------
/**
 * For one coordinate: how much of the lower patch [p0, p1] sees through the opening [a, b], in the
 * direction that moves by u up to the upper patch [q0, q1]. Piecewise linear in u; between the ends
 * of the parts the weighted Gauss points of each are given.
 */
std::vector<std::array<double, 2>> GetWindow(const std::array<double, 2>& p,
  const std::array<double, 2>& q, const std::array<double, 2>& opening, double level)
{
  static const GaussLegendre gauss(14);
  // Lines c - s u: the lower patch, the upper one, the opening.
  const std::array<double, 2> lines[] = { { p[0], 0 }, { p[1], 0 }, { q[0], 1 }, { q[1], 1 },
    { opening[0], level }, { opening[1], level } };
  std::vector<double> ends;
  for (const auto& first : lines)
  {
    for (const auto& second : lines)
    {
      if (first[1] < second[1])
      {
        ends.push_back((second[0] - first[0]) / (second[1] - first[1]));
      }
    }
  }
  std::sort(ends.begin(), ends.end());
  std::vector<std::array<double, 2>> window;
  for (std::size_t k = 1; k < ends.size(); ++k)
  {
    const double size = ends[k] - ends[k - 1];
    for (std::size_t n = 0; n < gauss.Nodes.size(); ++n)
    {
      const double u = ends[k - 1] + size * gauss.Nodes[n];
      const double length = std::min({ p[1], q[1] - u, opening[1] - level * u }) -
        std::max({ p[0], q[0] - u, opening[0] - level * u });
      if (length > 0.0)
      {
        window.push_back({ u, length * size * gauss.Weights[n] });
      }
    }
  }
  return window;
}

//------------------------------------------------------------------------------
/// The exchange of a patch of the lower plate and one of the upper, at height 1.
double GetExchangeThrough(const Opening& opening, const Rectangle& p, const Rectangle& q)
{
  std::vector<std::array<double, 2>> windows[2];
  for (int axis = 0; axis < 2; ++axis)
  {
    windows[axis] = GetWindow({ p.Low[axis], p.High[axis] }, { q.Low[axis], q.High[axis] },
      { opening.Low[axis], opening.High[axis] }, opening.Level);
  }
  double sum = 0.0;
  for (const auto& x : windows[0])
  {
    for (const auto& y : windows[1])
    {
      const double square = 1.0 + x[0] * x[0] + y[0] * y[0];
      sum += x[1] * y[1] / (square * square);
    }
  }
  return sum / vtkMath::Pi();
}

//------------------------------------------------------------------------------
/// Front to the upper plate; rectangles around the opening, none where that reaches the margin.
void AddWall(Surface& surface, const Opening& opening)
{
  constexpr double low = -4.0, high = 5.0;
  const double left = opening.Low[0], right = std::min(opening.High[0], high);
  const double front = std::max(opening.Low[1], low), back = std::min(opening.High[1], high);
  const auto add = [&](double x1, double x2, double y1, double y2)
  {
    if (x2 > x1 && y2 > y1)
    {
      surface.AddGrid({ x1, y1, opening.Level }, { x2 - x1, 0, 0 }, { 0, y2 - y1, 0 }, 1, 1);
    }
  };
  add(low, left, low, high);
  add(right, high, low, high);
  add(left, right, low, front);
  add(left, right, back, high);
}

//------------------------------------------------------------------------------
void TestOpening(const Opening& opening, int n, double tolerance, const std::string& what)
{
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
  surface.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, n, n);
  AddWall(surface, opening);
  CheckRectangles(surface.Get(), tolerance, Text(what, ", ", n, " x ", n),
    [&](const Rectangle& p, const Rectangle& q)
    {
      const Rectangle& lower = p.Low[2] < q.Low[2] ? p : q;
      const Rectangle& upper = p.Low[2] < q.Low[2] ? q : p;
      if (lower.Low[2] == upper.Low[2] || upper.Low[2] < 1.0)
      {
        return 0.0;
      }
      return lower.Low[2] > 0.0 ? GetRectangleExchange(lower, upper)
                                : GetExchangeThrough(opening, lower, upper);
    });
}

//------------------------------------------------------------------------------
// Through a slot, a window and past a straight edge: all partly visible pairs are known by a double
// integral of a smooth function.
void TestOpenings()
{
  constexpr double far = 1e3;
  // By symmetry half of what is exchanged without the screen: the integral itself is right.
  const Rectangle lower{ 2, { 0, 0, 0 }, { 1, 1, 0 } }, upper{ 2, { 0, 0, 1 }, { 1, 1, 1 } };
  CheckClose(GetExchangeThrough({ 0.5, { 0.5, -far }, { far, far } }, lower, upper),
    0.5 * 0.199824895698387, 1e-12, "half of the plates' exchange");
  CheckClose(GetExchangeThrough({ 0.3, { -far, -far }, { far, far } }, lower, upper),
    0.199824895698387, 1e-12, "all of the plates' exchange");
  for (const int n : { 1, 3 })
  {
    for (const double tolerance : { 1e-3, 1e-5 })
    {
      TestOpening({ 0.5, { 0.5, -far }, { far, far } }, n, tolerance, "half screen");
      TestOpening({ 0.3, { 0.9, -far }, { far, far } }, n, tolerance, "screen that hides most");
      TestOpening({ 0.5, { 0.05, -far }, { far, far } }, n, tolerance, "screen that hides little");
      TestOpening({ 0.4, { 0.3, -far }, { 0.45, far } }, n, tolerance, "slot");
      TestOpening({ 0.7, { 0.2, 0.35 }, { 0.6, 0.8 } }, n, tolerance, "window");
      TestOpening({ 0.5, { 0.5, 0.5 }, { 0.52, 0.53 } }, n, tolerance, "pinhole");
    }
  }
}

//------------------------------------------------------------------------------
// Round bodies: as meshes get finer
//------------------------------------------------------------------------------

/// The radius of the corners of a polygon that has the area of a circle.
double GetEqualAreaRadius(double radius, int corners)
{
  const double angle = 2.0 * vtkMath::Pi() / corners;
  return radius * std::sqrt(angle / std::sin(angle));
}

//------------------------------------------------------------------------------
/// As large as the disc it stands for, so that the error falls with the fourth power of the edge.
void AddDisc(Surface& surface, double radius, double height, int sectors, bool up)
{
  const double corner = GetEqualAreaRadius(radius, sectors);
  const auto at = [=](int k)
  {
    const double angle = 2.0 * vtkMath::Pi() * (k % sectors) / sectors;
    return Point{ corner * std::cos(angle), corner * std::sin(angle), height };
  };
  const Point center{ 0, 0, height };
  for (int k = 0; k < sectors; ++k)
  {
    up ? surface.AddPolygon({ center, at(k), at(k + 1) })
       : surface.AddPolygon({ center, at(k + 1), at(k) });
  }
}

//------------------------------------------------------------------------------
void TestDiscs()
{
  const double rows[][4] = { { 1, 1, 1, 0.381966011250105 }, { 1, 1, 0.1, 0.904875078027496 },
    { 1, 2, 1, 0.76393202250021 }, { 2, 1, 1, 0.190983005625053 }, { 1, 1, 3, 0.0916730868040161 },
    { 1, 1, 10, 0.0098048640721517 }, { 0.5, 1, 1, 0.468871125850725 } };
  for (const auto& row : rows)
  {
    for (const int sectors : { 24, 48, 96 })
    {
      Surface discs;
      AddDisc(discs, row[0], 0.0, sectors, true);
      AddDisc(discs, row[1], row[2], sectors, false);
      auto data = discs.Get();
      auto factors = ComputeViewFactors(data, 1e-6);
      const double factor =
        GetGroupFactor(factors, GetAreas(data), { 0, sectors }, { sectors, 2 * sectors });
      CheckClose(factor, row[3], 3e-6 * std::pow(96.0 / sectors, 4),
        Text("coaxial discs ", row[0], ", ", row[1], ", distance ", row[2], ", ", sectors));
    }
  }
}

//------------------------------------------------------------------------------
/// What values of a mesh and of one of half its edges tend to, whose errors fall with a power of
/// the edges.
double Extrapolate(double coarse, double fine, int power)
{
  return fine + (fine - coarse) / (std::pow(2.0, power) - 1.0);
}

//------------------------------------------------------------------------------
// From a sphere of any radius to a disc that looks at it.
void TestSphereToDisc()
{
  const double rows[][4] = { { 0.5, 1, 1, 0.146446609406726 }, { 0.9, 1, 2, 0.276393202250021 },
    { 1.0, 2, 1, 0.0527864045000421 } };
  for (const auto& row : rows)
  {
    double values[2];
    for (int level = 0; level < 2; ++level)
    {
      Surface surface;
      AddSphere(surface, row[0], level + 2, false);
      AddDisc(surface, row[2], row[1], 64, false);
      auto data = surface.Get();
      const vtkIdType cells = data->GetNumberOfCells();
      auto factors = ComputeViewFactors(data, 1e-8);
      values[level] =
        GetGroupFactor(factors, GetAreas(data), { 0, cells - 64 }, { cells - 64, cells });
    }
    CheckClose(Extrapolate(values[0], values[1], 2), row[3], 3e-5,
      Text("sphere ", row[0], " to disc ", row[2], " at ", row[1]));
  }
}

//------------------------------------------------------------------------------
// Similar triangulations: what the inner sphere sees of the outer one is 1, back 1/9, and 8/9 among
// the outer, past the inner one, whatever the level.
void TestConcentricSpheres()
{
  for (const int levels : { 1, 2 })
  {
    Surface spheres;
    AddSphere(spheres, 1.0, levels, false);
    AddSphere(spheres, 3.0, levels, true);
    auto data = spheres.Get();
    const vtkIdType cells = data->GetNumberOfCells();
    const Group inner{ 0, cells / 2 }, outer{ cells / 2, cells };
    auto factors = ComputeViewFactors(data, 1e-4);
    const std::vector<double> areas = GetAreas(data);
    const std::string what = Text("spheres, ", cells, " triangles: ");
    CheckClose(GetGroupFactor(factors, areas, inner, outer), 1.0, 1e-6, what + "inner to outer");
    CheckClose(GetGroupFactor(factors, areas, outer, inner), 1.0 / 9.0, 1e-6,
      what + "outer to inner");
    CheckClose(GetGroupFactor(factors, areas, outer, outer), 8.0 / 9.0, 1e-5,
      what + "outer to itself");
    Check(GetGroupFactor(factors, areas, inner, inner) == 0.0, what + "convex bodies");
    CheckClosedRows(factors, inner, what + "inner rows");
    const double error = CheckClosedRows(factors, outer, what + "outer rows");
    Check(error <= (levels == 1 ? 2e-5 : 1e-5),
      Text(what, "root mean square of the outer rows: ", error));
  }
}

//------------------------------------------------------------------------------
// Prisms whose walls are as large as those of the cylinders; only the ends are open. The errors of
// the polygons for circles fall with the second and the fourth power of the edges.
void TestConcentricCylinders()
{
  const double rows[][6] = { { 1, 2, 1, 0.464548996488, 0.232274498244, 0.137728613978 },
    { 1, 2, 2, 0.674212055038, 0.337106027519, 0.228481018988 },
    { 1, 4, 2, 0.358763765196, 0.0896909412991, 0.179833008822 },
    { 0.125, 0.25, 1, 0.910868433008, 0.455434216504, 0.405904210461 } };
  for (const auto& row : rows)
  {
    double values[3][3];
    for (int level = 0; level < 3; ++level)
    {
      const int sectors = 12 << level;
      const double stretch = vtkMath::Pi() / sectors / std::sin(vtkMath::Pi() / sectors);
      Surface surface;
      AddPrism(surface, row[0] * stretch, row[2], sectors, 2, false, false);
      AddPrism(surface, row[1] * stretch, row[2], sectors, 2, true, false);
      auto data = surface.Get();
      const Group inner{ 0, 2 * sectors }, outer{ 2 * sectors, 4 * sectors };
      auto factors = ComputeViewFactors(data, 1e-5);
      const std::vector<double> areas = GetAreas(data);
      values[level][0] = GetGroupFactor(factors, areas, inner, outer);
      values[level][1] = GetGroupFactor(factors, areas, outer, inner);
      values[level][2] = GetGroupFactor(factors, areas, outer, outer);
    }
    const char* names[] = { "inner to outer", "outer to inner", "outer to itself" };
    for (int k = 0; k < 3; ++k)
    {
      const double coarse = Extrapolate(values[0][k], values[1][k], 2);
      const double fine = Extrapolate(values[1][k], values[2][k], 2);
      CheckClose(Extrapolate(coarse, fine, 4), row[3 + k], 5e-5,
        Text("cylinders ", row[0], ", ", row[1], ", length ", row[2], ", ", names[k]));
    }
  }
}

//------------------------------------------------------------------------------
// What a crater misses of itself leaves through the opening: 1 - A_opening / A_crater for any mesh,
// (1 - cos b) / 2 in the limit.
void TestSphericalCaps()
{
  for (const double degrees : { 30.0, 45.0, 60.0, 90.0 })
  {
    double values[2];
    for (int level = 0; level < 2; ++level)
    {
      const int sectors = level ? 32 : 16, rings = level ? 12 : 6;
      const double half = vtkMath::RadiansFromDegrees(degrees);
      const auto at = [=](int ring, int k)
      {
        const double polar = half * ring / rings;
        const double angle = 2.0 * vtkMath::Pi() * (k % sectors) / sectors;
        return Point{ std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
          -std::cos(polar) };
      };
      Surface surface;
      for (int k = 0; k < sectors; ++k)
      {
        surface.AddPolygon({ at(0, 0), at(1, k), at(1, k + 1) });
        for (int ring = 1; ring < rings; ++ring)
        {
          surface.AddPolygon(
            { at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1) });
        }
      }
      auto data = surface.Get();
      const std::vector<double> areas = GetAreas(data);
      double area = 0.0;
      for (double part : areas)
      {
        area += part;
      }
      const double opening =
        0.5 * sectors * std::sin(2.0 * vtkMath::Pi() / sectors) * std::pow(std::sin(half), 2);
      const Group all{ 0, data->GetNumberOfCells() };
      values[level] = GetGroupFactor(ComputeViewFactors(data, 1e-7), areas, all, all);
      CheckClose(values[level], 1.0 - opening / area, 5e-7, Text("crater, ", degrees, " degrees"));
    }
    CheckClose(Extrapolate(values[0], values[1], 2),
      0.5 * (1.0 - std::cos(vtkMath::RadiansFromDegrees(degrees))), 2e-4,
      Text("smooth crater, ", degrees, " degrees"));
  }
}

//------------------------------------------------------------------------------
// In the middle of two strips of width 1 that are 20,000 long: what is missing at the ends is 1e-8.
void TestStrips()
{
  const double rows[][2] = { { 30, 0.741180954897479 }, { 60, 0.5 }, { 90, 0.292893218813452 },
    { 120, 0.133974596215561 } };
  for (const auto& row : rows)
  {
    const double angle = vtkMath::RadiansFromDegrees(row[0]);
    Surface strips;
    strips.AddGrid({ 0, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 2);
    strips.AddGrid({ 0, -1e4, 0 }, { 0, 2e4, 0 }, { std::cos(angle), 0, std::sin(angle) }, 1, 3);
    auto data = strips.Get();
    auto factors = ComputeViewFactors(data, 1e-8);
    CheckClose(GetGroupFactor(factors, GetAreas(data), { 0, 6 }, { 6, 9 }), row[1], Single,
      Text("strips at ", row[0], " degrees"));
  }
}

//------------------------------------------------------------------------------
// Boxes that stand about in a room: it is closed, so every row sums to 1.
void TestFurnishedRoom()
{
  for (const double tolerance : { 1e-3, 1e-4 })
  {
    Surface room;
    AddBox(room, { 0, 0, 0 }, { 4, 3, 2.5 }, 0.75, true);
    AddBox(room, { 1, 1, 0.7 }, { 2.2, 1.8, 0.73 }, 0.5, false);
    AddBox(room, { 1.1, 1.1, 0.01 }, { 1.15, 1.15, 0.69 }, 0.5, false);
    AddBox(room, { 2.05, 1.65, 0.01 }, { 2.1, 1.7, 0.69 }, 0.5, false);
    AddBox(room, { 3.2, 0.2, 0.01 }, { 3.8, 2.4, 1.8 }, 0.9, false);
    AddBox(room, { 1.5, 1.3, 1.6 }, { 1.8, 1.6, 1.8 }, 0.5, false);
    auto data = room.Get();
    auto factors = ComputeViewFactors(data, tolerance);
    CheckClosedRows(factors, { 0, data->GetNumberOfCells() },
      Text("furnished room, Tolerance ", tolerance));
  }
}

//------------------------------------------------------------------------------
// Neither the unit nor the place of a scene changes a factor, also where something is in between.
void TestInvariance()
{
  const auto make = [](double scale, double shift)
  {
    Surface scene;
    const auto at = [&](double x, double y, double z) {
      return Point{ scale * (x + shift), scale * (y + shift), scale * (z + shift) };
    };
    scene.AddPolygon({ at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0) });
    scene.AddPolygon({ at(0, 0, 0), at(0, 1, 0), at(0, 1, 1) });
    scene.AddPolygon({ at(0.25, 0.25, 1), at(0.25, 0.75, 1), at(0.75, 0.5, 1) });
    scene.AddPolygon({ at(0.375, 0.375, 0.5), at(0.625, 0.375, 0.5), at(0.5, 0.625, 0.5) });
    return ComputeViewFactors(scene.Get(), 1e-6);
  };
  auto reference = make(1.0, 0.0);
  // All coordinates are eighths: no shift rounds them.
  const double settings[][2] = { { 1e-9, 0 }, { 1e-3, 0 }, { 1e9, 0 }, { 1.0, 1e9 }, { 1.0, -1e9 },
    { 0x1p-30, 1e9 }, { 1e6, -64.0 } };
  for (const auto& setting : settings)
  {
    auto factors = make(setting[0], setting[1]);
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < 4; ++j)
      {
        // Beside what far coordinates have lost.
        const double lost = 8.0 * std::numeric_limits<double>::epsilon() * std::abs(setting[1]);
        CheckClose(factors->GetViewFactor(i, j), reference->GetViewFactor(i, j), Single + lost,
          Text("factor ", i, ", ", j, ", scale ", setting[0], ", place ", setting[1]));
      }
    }
  }
}
} // end of anonymous namespace

//------------------------------------------------------------------------------
int TestViewFactorCatalogue(int, char*[])
{
  TestParallelPlates();
  TestPerpendicularPlates();
  TestRooms();
  TestOpenings();
  TestDiscs();
  TestSphereToDisc();
  TestConcentricSpheres();
  TestConcentricCylinders();
  TestSphericalCaps();
  TestStrips();
  TestFurnishedRoom();
  TestInvariance();
  return Result();
}
