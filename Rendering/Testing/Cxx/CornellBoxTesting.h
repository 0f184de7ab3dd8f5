// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The Cornell box in triangles, and how far two solutions of it are apart, for tests and
/// benchmarks.
#ifndef CornellBoxTesting_h
#define CornellBoxTesting_h

#include "LightTransportTesting.h"
#include "vtkAdaptiveSubdivisionFilter.h"
#include "vtkTriangleFilter.h"
#include "vtkXMLPolyDataReader.h"

namespace LightTransportTesting
{
/// No edge is longer than `edge` millimetres; the room is about 550 large.
inline vtkSmartPointer<vtkPolyData> MakeCornellBox(double edge)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(LIGHTTRANSPORT_DATA_DIRECTORY "/cornell_box.vtp");
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkAdaptiveSubdivisionFilter> subdivide;
  subdivide->SetInputConnection(triangles->GetOutputPort());
  subdivide->SetMaximumEdgeLength(edge);
  subdivide->SetMaximumTriangleArea(VTK_DOUBLE_MAX);
  subdivide->SetMaximumNumberOfPasses(100);
  subdivide->Update();
  return subdivide->GetOutput();
}

/// Areas of planar convex polygons.
inline std::vector<double> GetAreas(vtkPolyData* scene)
{
  std::vector<double> areas;
  for (vtkIdType cell = 0; cell < scene->GetNumberOfCells(); ++cell)
  {
    vtkPoints* points = scene->GetCell(cell)->GetPoints();
    double sum = 0.0;
    for (vtkIdType corner = 1; corner + 1 < points->GetNumberOfPoints(); ++corner)
    {
      double a[3], b[3], c[3], u[3], v[3], cross[3];
      points->GetPoint(0, a);
      points->GetPoint(corner, b);
      points->GetPoint(corner + 1, c);
      vtkMath::Subtract(b, a, u);
      vtkMath::Subtract(c, a, v);
      vtkMath::Cross(u, v, cross);
      sum += 0.5 * vtkMath::Norm(cross);
    }
    areas.push_back(sum);
  }
  return areas;
}

/// The area-weighted relative L2 difference of values per patch and band.
inline double Compare(vtkPolyData* scene, const std::vector<double>& found,
  const std::vector<double>& expected)
{
  const std::vector<double> areas = GetAreas(scene);
  const std::size_t bands = expected.size() / areas.size();
  double difference = 0.0;
  double whole = 0.0;
  for (std::size_t k = 0; k < expected.size() && found.size() == expected.size(); ++k)
  {
    difference += areas[k / bands] * std::pow(found[k] - expected[k], 2);
    whole += areas[k / bands] * expected[k] * expected[k];
  }
  return whole > 0.0 ? std::sqrt(difference / whole) : 1.0;
}

/// The values of a cell array, tuple after tuple; empty where there is none.
inline std::vector<double> GetCellValues(vtkPolyData* data, const char* name)
{
  std::vector<double> values;
  vtkDataArray* array = data->GetCellData()->GetArray(name);
  Check(array != nullptr, std::string("there is no cell array ") + name);
  for (vtkIdType tuple = 0; array && tuple < array->GetNumberOfTuples(); ++tuple)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      values.push_back(array->GetComponent(tuple, component));
    }
  }
  return values;
}
} // namespace LightTransportTesting

#endif
