// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/SquareLayout.h"

#include "Atlas/StretchElement.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace LightTransport
{
namespace
{
using Coordinates = SquareMap::Coordinates;

constexpr double Infinite = std::numeric_limits<double>::infinity();

// Springs are not weaker than this, where 1.15 is what the edges of an even mesh have.
constexpr double WeakestSpring = 1e-4;

// Iterations end when the next one would lower the squared stretch by less than this fraction.
constexpr double LeastGain = 1e-4;

//------------------------------------------------------------------------------
double Cross(const Coordinates& a, const Coordinates& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

//------------------------------------------------------------------------------
double Dot(const Coordinates& a, const Coordinates& b)
{
  return a[0] * b[0] + a[1] * b[1];
}

//------------------------------------------------------------------------------
Coordinates Subtract(const Coordinates& a, const Coordinates& b)
{
  return { a[0] - b[0], a[1] - b[1] };
}

//------------------------------------------------------------------------------
std::vector<Coordinates> Add(const std::vector<Coordinates>& a, double factor,
  const std::vector<Coordinates>& b)
{
  std::vector<Coordinates> sum(a);
  for (std::size_t i = 0; i < sum.size(); ++i)
  {
    sum[i][0] += factor * b[i][0];
    sum[i][1] += factor * b[i][1];
  }
  return sum;
}

//------------------------------------------------------------------------------
// Numbers the coordinates that are not held by a side.
struct Freedom
{
  std::vector<std::array<int, 2>> Unknowns;
  std::array<int, 2> Numbers{ 0, 0 };

  explicit Freedom(const std::vector<unsigned char>& sides) : Unknowns(sides.size())
  {
    const int holders[2] = { SquareLayout::Left | SquareLayout::Right,
      SquareLayout::Bottom | SquareLayout::Top };
    for (std::size_t point = 0; point < sides.size(); ++point)
    {
      for (int axis = 0; axis < 2; ++axis)
      {
        this->Unknowns[point][axis] = (sides[point] & holders[axis]) ? -1 : this->Numbers[axis]++;
      }
    }
  }
};

//------------------------------------------------------------------------------
// The unknowns of a triangle: u and v of each corner, those of all v after those of all u.
StepSolver<6>::Unknowns GetUnknowns(const Freedom& freedom, const SquareMap::Triangle& triangle)
{
  StepSolver<6>::Unknowns unknowns;
  for (int j = 0; j < 6; ++j)
  {
    const int unknown = freedom.Unknowns[triangle[j / 2]][j % 2];
    unknowns[j] = unknown < 0 ? -1 : unknown + (j % 2) * freedom.Numbers[0];
  }
  return unknowns;
}

//------------------------------------------------------------------------------
// In the plane of the triangle, of the three functions that are one at a corner.
template <typename Shape>
Eigen::Matrix<double, 2, 3> GetShapeGradients(const Shape& shape)
{
  const Eigen::Vector2d second(1.0 / shape.Length, -shape.Apex[0] / (shape.Length * shape.Apex[1]));
  const Eigen::Vector2d third(0.0, 1.0 / shape.Apex[1]);
  Eigen::Matrix<double, 2, 3> gradients;
  gradients << -second - third, second, third;
  return gradients;
}
} // namespace

//------------------------------------------------------------------------------
SquareLayout::SquareLayout(const SquareMap::Disc& disc, const std::vector<unsigned char>& sides,
  const Watch& watch)
  : Surface(disc), Sides(sides), Watcher(watch)
{
  double area = 0.0;
  for (const auto& triangle : disc.Triangles)
  {
    this->Shapes.push_back(this->MakeShape(triangle));
    area += this->Shapes.back().Area;
  }
  for (Shape& shape : this->Shapes)
  {
    shape.Length /= std::sqrt(area);
    shape.Apex[0] /= std::sqrt(area);
    shape.Apex[1] /= std::sqrt(area);
    shape.Area /= area;
  }
}

//------------------------------------------------------------------------------
SquareLayout::Shape SquareLayout::MakeShape(const SquareMap::Triangle& triangle) const
{
  const auto point = [&](int corner)
  { return Eigen::Map<const Eigen::Vector3d>(this->Surface.Points[triangle[corner]].data()); };
  const Eigen::Vector3d first = point(1) - point(0);
  const Eigen::Vector3d second = point(2) - point(0);
  const double length = first.norm();
  const double height = first.cross(second).norm() / length;
  return { length, { first.dot(second) / length, height }, 0.5 * length * height };
}

//------------------------------------------------------------------------------
// Half the cotangents of the angles opposite to the edges; an edge's two halves may differ in sign,
// but their sum is kept positive.
void SquareLayout::MakeConformalSprings()
{
  struct Half
  {
    std::size_t From;
    std::size_t To;
    double* Spring;
  };
  std::vector<Half> halves;
  for (std::size_t i = 0; i < this->Shapes.size(); ++i)
  {
    const auto& triangle = this->Surface.Triangles[i];
    const Shape& shape = this->Shapes[i];
    const Coordinates corners[3] = { { 0.0, 0.0 }, { shape.Length, 0.0 }, shape.Apex };
    for (int j = 0; j < 3; ++j)
    {
      const int next = (j + 1) % 3;
      const int last = (j + 2) % 3;
      this->Springs[i][j] =
        Dot(Subtract(corners[next], corners[j]), Subtract(corners[last], corners[j])) /
        (4.0 * shape.Area);
      halves.push_back({ std::min(triangle[next], triangle[last]),
        std::max(triangle[next], triangle[last]), &this->Springs[i][j] });
    }
  }
  std::sort(halves.begin(), halves.end(),
    [](const Half& a, const Half& b) { return std::tie(a.From, a.To) < std::tie(b.From, b.To); });
  for (auto half = halves.begin(); half != halves.end();)
  {
    const auto other = half + 1;
    const bool paired = other != halves.end() && other->From == half->From && other->To == half->To;
    const double sum = *half->Spring + (paired ? *other->Spring : 0.0);
    if (sum < WeakestSpring)
    {
      *half->Spring = WeakestSpring;
      if (paired)
      {
        *other->Spring = 0.0;
      }
    }
    half += paired ? 2 : 1;
  }
}

//------------------------------------------------------------------------------
bool SquareLayout::Balance(SpringKind kind)
{
  this->Springs.assign(this->Shapes.size(), { 0.5, 0.5, 0.5 });
  if (kind == SpringKind::Conformal)
  {
    this->MakeConformalSprings();
  }
  return this->Solve(this->UV);
}

//------------------------------------------------------------------------------
// The equations of a coordinate have the same shape whatever the springs.
StepSolver<3>& SquareLayout::GetSolver(int axis, const std::vector<std::array<int, 2>>& unknowns,
  int numberOfUnknowns)
{
  if (!this->Solvers[axis])
  {
    std::vector<StepSolver<3>::Unknowns> elements;
    for (const auto& triangle : this->Surface.Triangles)
    {
      elements.push_back(
        { unknowns[triangle[0]][axis], unknowns[triangle[1]][axis], unknowns[triangle[2]][axis] });
    }
    this->Solvers[axis] =
      std::make_unique<StepSolver<3>>(std::move(elements), numberOfUnknowns);
  }
  return *this->Solvers[axis];
}

//------------------------------------------------------------------------------
// Both coordinates are found apart from each other, as steps from zero where they are free.
bool SquareLayout::Solve(std::vector<Coordinates>& uv)
{
  const Freedom freedom(this->Sides);
  uv.resize(this->Sides.size());
  for (std::size_t point = 0; point < uv.size(); ++point)
  {
    uv[point] = { this->Sides[point] & Right ? 1.0 : 0.0, this->Sides[point] & Top ? 1.0 : 0.0 };
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    this->Watcher.Check();
    StepSolver<3>& solver = this->GetSolver(axis, freedom.Unknowns, freedom.Numbers[axis]);
    solver.Clear();
    for (std::size_t i = 0; i < this->Springs.size(); ++i)
    {
      const auto& triangle = this->Surface.Triangles[i];
      const auto& k = this->Springs[i];
      StepSolver<3>::Hessian hessian;
      hessian << k[1] + k[2], -k[2], -k[1], -k[2], k[2] + k[0], -k[0], -k[1], -k[0], k[0] + k[1];
      solver.Add(hessian,
        hessian *
          Eigen::Vector3d(uv[triangle[0]][axis], uv[triangle[1]][axis], uv[triangle[2]][axis]));
    }
    Eigen::VectorXd step;
    if (!solver.Solve(step))
    {
      return false;
    }
    for (std::size_t point = 0; point < uv.size(); ++point)
    {
      if (freedom.Unknowns[point][axis] >= 0)
      {
        uv[point][axis] = step[freedom.Unknowns[point][axis]];
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void SquareLayout::Reweight(int maximumNumberOfIterations)
{
  double best = this->MeasureL2Stretch(this->UV);
  std::vector<Coordinates> uv = this->UV;
  for (int iteration = 0; iteration < maximumNumberOfIterations; ++iteration)
  {
    const std::vector<double> stretch = this->GetPointStretch(uv);
    for (std::size_t i = 0; i < this->Springs.size(); ++i)
    {
      const auto& triangle = this->Surface.Triangles[i];
      for (int j = 0; j < 3; ++j)
      {
        this->Springs[i][j] /= stretch[triangle[(j + 1) % 3]] * stretch[triangle[(j + 2) % 3]];
      }
    }
    if (!this->Solve(uv))
    {
      return;
    }
    const double next = this->MeasureL2Stretch(uv);
    if (!(next < best))
    {
      return;
    }
    best = next;
    this->UV = uv;
  }
}

//------------------------------------------------------------------------------
double SquareLayout::GetSquaredStretch(std::size_t triangle,
  const std::vector<Coordinates>& uv) const
{
  const auto& corners = this->Surface.Triangles[triangle];
  const Shape& shape = this->Shapes[triangle];
  const Coordinates first = Subtract(uv[corners[1]], uv[corners[0]]);
  const Coordinates second = Subtract(uv[corners[2]], uv[corners[0]]);
  const double twiceArea = Cross(first, second);
  if (!(twiceArea > 0.0))
  {
    return Infinite;
  }
  // The derivatives of the surface's point by u and by v, in the triangle's plane. Squares of these
  // add up without cancellation, unlike the products of edges' lengths.
  const double xu = shape.Length * second[1] - shape.Apex[0] * first[1];
  const double xv = shape.Apex[0] * first[0] - shape.Length * second[0];
  const double yu = shape.Apex[1] * first[1];
  const double yv = shape.Apex[1] * first[0];
  return 0.5 * (xu * xu + xv * xv + yu * yu + yv * yv) / (twiceArea * twiceArea);
}

//------------------------------------------------------------------------------
std::vector<double> SquareLayout::GetPointStretch(const std::vector<Coordinates>& uv) const
{
  std::vector<double> areas(uv.size(), 0.0);
  std::vector<double> stretch(uv.size(), 0.0);
  for (std::size_t i = 0; i < this->Shapes.size(); ++i)
  {
    const double squared = this->GetSquaredStretch(i, uv);
    for (std::size_t point : this->Surface.Triangles[i])
    {
      areas[point] += this->Shapes[i].Area;
      stretch[point] += this->Shapes[i].Area * squared;
    }
  }
  for (std::size_t point = 0; point < uv.size(); ++point)
  {
    stretch[point] = std::sqrt(stretch[point] / areas[point]);
  }
  return stretch;
}

//------------------------------------------------------------------------------
double SquareLayout::MeasureL2Stretch(const std::vector<Coordinates>& uv) const
{
  double sum = 0.0;
  for (std::size_t i = 0; i < this->Shapes.size(); ++i)
  {
    sum += this->Shapes[i].Area * this->GetSquaredStretch(i, uv);
  }
  return std::sqrt(sum);
}

//------------------------------------------------------------------------------
double SquareLayout::GetLInfinityStretch() const
{
  double largest = 0.0;
  for (std::size_t i = 0; i < this->Shapes.size(); ++i)
  {
    const auto& corners = this->Surface.Triangles[i];
    const double mean = this->GetSquaredStretch(i, this->UV);
    const double growth = 2.0 * this->Shapes[i].Area /
      Cross(Subtract(this->UV[corners[1]], this->UV[corners[0]]),
        Subtract(this->UV[corners[2]], this->UV[corners[0]]));
    // The squares of the singular values have this mean and the growth of the area as geometric
    // one.
    const double squared = mean + std::sqrt(std::max(0.0, (mean - growth) * (mean + growth)));
    largest = std::max(largest, std::sqrt(squared));
  }
  return largest;
}

//------------------------------------------------------------------------------
bool SquareLayout::IsOneToOne() const
{
  return this->MeasureL2Stretch(this->UV) < Infinite;
}

//------------------------------------------------------------------------------
// The multiple of the step at which the first triangle loses its area.
double SquareLayout::GetLargestStep(const std::vector<Coordinates>& step) const
{
  double largest = Infinite;
  for (const auto& corners : this->Surface.Triangles)
  {
    const Coordinates first = Subtract(this->UV[corners[1]], this->UV[corners[0]]);
    const Coordinates second = Subtract(this->UV[corners[2]], this->UV[corners[0]]);
    const Coordinates firstStep = Subtract(step[corners[1]], step[corners[0]]);
    const Coordinates secondStep = Subtract(step[corners[2]], step[corners[0]]);
    // The least positive root of a x^2 + b x + c, where c > 0.
    const double a = Cross(firstStep, secondStep);
    const double b = Cross(first, secondStep) + Cross(firstStep, second);
    const double c = Cross(first, second);
    const double discriminant = b * b - 4.0 * a * c;
    if (discriminant >= 0.0)
    {
      const double denominator = std::sqrt(discriminant) - b;
      if (denominator > 0.0)
      {
        largest = std::min(largest, 2.0 * c / denominator);
      }
    }
  }
  return largest;
}

//------------------------------------------------------------------------------
double SquareLayout::MeasureSquaredStretch(const std::vector<Coordinates>& uv) const
{
  const double stretch = this->MeasureL2Stretch(uv);
  return stretch * stretch;
}

//------------------------------------------------------------------------------
// Go along a step, whose slope is that of the squared stretch `value`, as far as it lowers that
// enough and no triangle loses its area. False if nothing is gained.
bool SquareLayout::Descend(const std::vector<Coordinates>& step, double slope, double& value)
{
  double length = std::min(1.0, 0.8 * this->GetLargestStep(step));
  std::vector<Coordinates> uv = Add(this->UV, length, step);
  double next = this->MeasureSquaredStretch(uv);
  while (!(next <= value + 1e-4 * length * slope))
  {
    this->Watcher.Check();
    length *= 0.5;
    if (length < 1e-8)
    {
      return false;
    }
    uv = Add(this->UV, length, step);
    next = this->MeasureSquaredStretch(uv);
  }
  this->UV = std::move(uv);
  value = next;
  return true;
}

//------------------------------------------------------------------------------
void SquareLayout::Minimize(int maximumNumberOfIterations)
{
  const Freedom freedom(this->Sides);
  std::vector<StepSolver<6>::Unknowns> elements;
  std::vector<Eigen::Matrix<double, 2, 3>> shapeGradients;
  for (std::size_t i = 0; i < this->Shapes.size(); ++i)
  {
    elements.push_back(GetUnknowns(freedom, this->Surface.Triangles[i]));
    shapeGradients.push_back(GetShapeGradients(this->Shapes[i]));
  }
  StepSolver<6> solver(std::move(elements), freedom.Numbers[0] + freedom.Numbers[1]);

  double value = this->MeasureSquaredStretch(this->UV);
  std::vector<Coordinates> step(this->UV.size());
  for (int iteration = 0; iteration < maximumNumberOfIterations; ++iteration)
  {
    this->Watcher.Check();
    solver.Clear();
    for (std::size_t i = 0; i < this->Shapes.size(); ++i)
    {
      Eigen::Matrix<double, 2, 3> uv;
      for (int j = 0; j < 3; ++j)
      {
        uv.col(j) =
          Eigen::Map<const Eigen::Vector2d>(this->UV[this->Surface.Triangles[i][j]].data());
      }
      const StretchElement element(shapeGradients[i], uv, this->Shapes[i].Area);
      solver.Add(element.Curvature, element.Slope);
    }
    Eigen::VectorXd unknowns;
    if (!solver.Solve(unknowns))
    {
      return;
    }
    for (std::size_t point = 0; point < step.size(); ++point)
    {
      for (int axis = 0; axis < 2; ++axis)
      {
        const int unknown = freedom.Unknowns[point][axis];
        step[point][axis] = unknown < 0 ? 0.0 : unknowns[unknown + axis * freedom.Numbers[0]];
      }
    }
    const double slope = solver.GetSlope().dot(unknowns);
    if (!this->Descend(step, slope, value) || !(-slope > LeastGain * value))
    {
      return;
    }
  }
}
} // namespace LightTransport
