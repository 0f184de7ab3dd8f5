// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Checks and scenes that the tests of this module share.
#ifndef LightTransportTesting_h
#define LightTransportTesting_h

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPlatonicSolidSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace LightTransportTesting
{
inline int& Failures()
{
  static int failures = 0;
  return failures;
}

inline bool Check(bool ok, const std::string& what)
{
  if (!ok)
  {
    std::cerr << "FAILED: " << what << std::endl;
    ++Failures();
  }
  return ok;
}

/// |value - expected| <= tolerance * |expected|, or <= tolerance where 0 is expected.
inline bool CheckClose(double value, double expected, double tolerance, const std::string& what)
{
  const double scale = expected == 0.0 ? 1.0 : std::abs(expected);
  const bool ok = std::abs(value - expected) <= tolerance * scale;
  if (!ok)
  {
    std::cerr.precision(12);
    std::cerr << "FAILED: " << what << ": " << value << " instead of " << expected << " (off by "
              << (value - expected) / scale << ", allowed " << tolerance << ")" << std::endl;
    ++Failures();
  }
  return ok;
}

inline int Result()
{
  return Failures() == 0 ? 0 : 1;
}

using Point = std::array<double, 3>;

/// Builds a surface from polygons; equal points are shared. Points are double unless asked for
/// single.
class Surface
{
public:
  void AddPolygon(const std::vector<Point>& corners)
  {
    vtkNew<vtkIdList> ids;
    for (const Point& corner : corners)
    {
      const auto inserted = this->Known.emplace(corner, this->Points->GetNumberOfPoints());
      if (inserted.second)
      {
        this->Points->InsertNextPoint(corner.data());
      }
      ids->InsertNextId(inserted.first->second);
    }
    this->Polygons->InsertNextCell(ids);
  }

  /// A parallelogram cut into n x m; its front is where u x v points.
  void AddGrid(const Point& origin, const Point& u, const Point& v, int n, int m)
  {
    const auto at = [&](int i, int j)
    {
      Point point;
      for (int axis = 0; axis < 3; ++axis)
      {
        point[axis] = origin[axis] + u[axis] * i / n + v[axis] * j / m;
      }
      return point;
    };
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < m; ++j)
      {
        this->AddPolygon({ at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) });
      }
    }
  }

  vtkSmartPointer<vtkPolyData> Get() const
  {
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(this->Points);
    data->SetPolys(this->Polygons);
    return data;
  }

  explicit Surface(bool single = false)
  {
    this->Points->SetDataType(single ? VTK_FLOAT : VTK_DOUBLE);
  }

private:
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Polygons;
  std::map<Point, vtkIdType> Known;
};

/// The unit cube seen from inside, each face cut into n x n quadrilaterals; faces in the order -z,
/// +z, -y, +y, -x, +x.
inline vtkSmartPointer<vtkPolyData> MakeRoom(int n)
{
  Surface room;
  room.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
  room.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, n, n);
  room.AddGrid({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, n, n);
  room.AddGrid({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, n, n);
  room.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, n, n);
  room.AddGrid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, n, n);
  return room.Get();
}

/// An icosahedron whose triangles are cut into 4 `levels` times and projected onto the sphere;
/// inward: fronts face the centre.
inline void AddSphere(Surface& surface, double radius, int levels, bool inward)
{
  vtkNew<vtkPlatonicSolidSource> source;
  source->SetSolidTypeToIcosahedron();
  source->Update();
  const auto project = [radius](const Point& point)
  {
    const double norm = std::sqrt(vtkMath::Dot(point.data(), point.data()));
    return Point{ point[0] / norm * radius, point[1] / norm * radius, point[2] / norm * radius };
  };
  const auto middle = [&](const Point& a, const Point& b) {
    return project({ a[0] + b[0], a[1] + b[1], a[2] + b[2] });
  };
  const std::function<void(const Point&, const Point&, const Point&, int)> add =
    [&](const Point& a, const Point& b, const Point& c, int level)
  {
    if (level == 0)
    {
      inward ? surface.AddPolygon({ a, c, b }) : surface.AddPolygon({ a, b, c });
      return;
    }
    const Point ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    add(a, ab, ca, level - 1);
    add(ab, b, bc, level - 1);
    add(ca, bc, c, level - 1);
    add(ab, bc, ca, level - 1);
  };
  vtkPolyData* solid = source->GetOutput();
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < solid->GetNumberOfCells(); ++cell)
  {
    solid->GetCellPoints(cell, ids);
    Point corners[3];
    for (int k = 0; k < 3; ++k)
    {
      solid->GetPoint(ids->GetId(k), corners[k].data());
      corners[k] = project(corners[k]);
    }
    // The solid's own orientation does not matter: outward first.
    double u[3], v[3], normal[3];
    vtkMath::Subtract(corners[1].data(), corners[0].data(), u);
    vtkMath::Subtract(corners[2].data(), corners[0].data(), v);
    vtkMath::Cross(u, v, normal);
    if (vtkMath::Dot(normal, corners[0].data()) < 0.0)
    {
      std::swap(corners[1], corners[2]);
    }
    add(corners[0], corners[1], corners[2], levels);
  }
}

/// A cell array with the same tuple everywhere; returned to be changed.
inline vtkDoubleArray* AddArray(vtkPolyData* data, const char* name,
  const std::vector<double>& tuple)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(tuple.size()));
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    array->InsertNextTuple(tuple.data());
  }
  data->GetCellData()->AddArray(array);
  return array;
}

inline double GetSummary(vtkDataObject* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  Check(array != nullptr, std::string("field data has ") + name);
  return array ? array->GetComponent(0, 0) : vtkMath::Nan();
}

/// Of the field data; empty where there is none.
inline std::string GetText(vtkDataObject* data, const char* name)
{
  auto* text = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  return text ? text->GetValue(0) : "";
}

/// Tuple by tuple; empty where there is no array.
inline std::vector<double> GetValues(vtkDataArray* array)
{
  std::vector<double> values;
  const int components = array ? array->GetNumberOfComponents() : 1;
  for (vtkIdType k = 0; array && k < array->GetNumberOfValues(); ++k)
  {
    values.push_back(array->GetComponent(k / components, static_cast<int>(k % components)));
  }
  return values;
}

/// Root mean square of the worst of the components, relative; patches are of like size.
inline double CompareBands(const std::vector<double>& found, const std::vector<double>& expected,
  std::size_t components = 3)
{
  Check(found.size() == expected.size() && !found.empty(), "results to compare");
  std::vector<double> errors(components, 0.0);
  std::vector<double> squares(components, 0.0);
  for (std::size_t k = 0; k < std::min(found.size(), expected.size()); ++k)
  {
    errors[k % components] += std::pow(found[k] - expected[k], 2);
    squares[k % components] += std::pow(expected[k], 2);
  }
  double worst = 0.0;
  for (std::size_t component = 0; component < components; ++component)
  {
    worst = std::max(worst, std::sqrt(errors[component] / squares[component]));
  }
  return worst;
}
} // namespace LightTransportTesting

#endif
