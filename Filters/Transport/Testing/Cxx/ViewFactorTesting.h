// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the tests and the benchmark of view factors share: scenes, and sums over groups of patches.
#ifndef ViewFactorTesting_h
#define ViewFactorTesting_h

#include "LightTransportTesting.h"
#include "vtkPolygon.h"
#include "vtkSMPTools.h"
#include "vtkViewFactors.h"

namespace LightTransportTesting
{
/// Patches Begin to End - 1.
struct Group
{
  vtkIdType Begin = 0;
  vtkIdType End = 0;
};

//------------------------------------------------------------------------------
inline vtkSmartPointer<vtkViewFactors> ComputeViewFactors(vtkPolyData* data, double tolerance)
{
  auto factors = vtkSmartPointer<vtkViewFactors>::New();
  factors->SetInputData(data);
  factors->SetTolerance(tolerance);
  factors->Update();
  return factors;
}

//------------------------------------------------------------------------------
inline std::vector<double> GetAreas(vtkPolyData* data)
{
  std::vector<double> areas(data->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  for (std::size_t cell = 0; cell < areas.size(); ++cell)
  {
    data->GetCellPoints(static_cast<vtkIdType>(cell), ids);
    double normal[3];
    areas[cell] =
      vtkPolygon::ComputeArea(data->GetPoints(), ids->GetNumberOfIds(), ids->GetPointer(0), normal);
  }
  return areas;
}

//------------------------------------------------------------------------------
/// A cell array of the output; not-a-number where it is missing.
inline std::vector<double> GetCellValues(vtkViewFactors* factors, const char* name)
{
  vtkPolyData* output = factors->GetPolyDataOutput();
  vtkDataArray* array = output->GetCellData()->GetArray(name);
  Check(array && array->GetNumberOfComponents() == 1, std::string("cell array ") + name);
  std::vector<double> values(output->GetNumberOfCells(), vtkMath::Nan());
  for (std::size_t cell = 0; array && cell < values.size(); ++cell)
  {
    values[cell] = array->GetComponent(static_cast<vtkIdType>(cell), 0);
  }
  return values;
}

//------------------------------------------------------------------------------
/// The factor from one group of patches to another.
inline double GetGroupFactor(vtkViewFactors* factors, const std::vector<double>& areas,
  const Group& from, const Group& to)
{
  std::vector<double> rows(from.End - from.Begin);
  vtkSMPTools::For(0, static_cast<vtkIdType>(rows.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        for (vtkIdType j = to.Begin; j < to.End; ++j)
        {
          rows[i] += factors->GetViewFactor(from.Begin + i, j);
        }
      }
    });
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    sum += areas[from.Begin + i] * rows[i];
    area += areas[from.Begin + i];
  }
  return sum / area;
}

//------------------------------------------------------------------------------
/// The wall of a prism around z, from -length/2 to length/2, with its corners at `radius`.
inline void AddPrism(Surface& surface, double radius, double length, int sectors, int slices,
  bool inward, bool triangles)
{
  const auto at = [=](int i, int k)
  {
    const double angle = 2.0 * vtkMath::Pi() * (i % sectors) / sectors;
    return Point{ radius * std::cos(angle), radius * std::sin(angle),
      length * (static_cast<double>(k) / slices - 0.5) };
  };
  const auto add = [&](std::vector<Point> corners)
  {
    surface.AddPolygon(
      inward ? std::vector<Point>(corners.rbegin(), corners.rend()) : std::move(corners));
  };
  for (int i = 0; i < sectors; ++i)
  {
    for (int k = 0; k < slices; ++k)
    {
      const Point a = at(i, k), b = at(i + 1, k), c = at(i + 1, k + 1), d = at(i, k + 1);
      if (triangles)
      {
        add({ a, b, c });
        add({ a, c, d });
      }
      else
      {
        add({ a, b, c, d });
      }
    }
  }
}

//------------------------------------------------------------------------------
/// A box with grids of edges of at most `length` on its faces; inward: a room.
inline void AddBox(Surface& surface, const Point& low, const Point& high, double length,
  bool inward)
{
  const auto count = [&](int axis)
  { return std::max(1, static_cast<int>(std::ceil((high[axis] - low[axis]) / length - 1e-9))); };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    Point u{ 0, 0, 0 }, v{ 0, 0, 0 };
    u[next] = high[next] - low[next];
    v[last] = high[last] - low[last];
    for (const bool upper : { false, true })
    {
      Point origin = low;
      origin[axis] = upper ? high[axis] : low[axis];
      // u x v points along the axis.
      upper != inward ? surface.AddGrid(origin, u, v, count(next), count(last))
                      : surface.AddGrid(origin, v, u, count(last), count(next));
    }
  }
}
} // namespace LightTransportTesting

#endif
