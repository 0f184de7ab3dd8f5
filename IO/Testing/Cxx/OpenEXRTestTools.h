// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What the OpenEXR tests share.
#ifndef OpenEXRTestTools_h
#define OpenEXRTestTools_h

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTestUtilities.h"

#include <iostream>
#include <string>

namespace OpenEXRTestTools
{
// The path of a file in the tests' scratch directory.
inline std::string GetPath(int argc, char* argv[], const char* name)
{
  char* directory =
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary");
  const std::string path = std::string(directory) + '/' + name;
  delete[] directory;
  return path;
}

inline bool Check(bool good, const std::string& what)
{
  if (!good)
  {
    std::cerr << "FAILED: " << what << "\n";
  }
  return good;
}

// An array of values that are neither round nor small in number, the same for every run.
inline vtkSmartPointer<vtkFloatArray> MakeValues(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    const unsigned int scrambled = (static_cast<unsigned int>(i) + 7u) * 2654435761u;
    array->SetValue(i, static_cast<float>(scrambled) / 4294967296.0f * 3.0f - 1.0f);
  }
  return array;
}

inline vtkSmartPointer<vtkImageData> MakeImage(const int extent[6], int components)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(const_cast<int*>(extent));
  image->GetPointData()->SetScalars(MakeValues("Scalars", components, image->GetNumberOfPoints()));
  return image;
}
} // namespace OpenEXRTestTools

#endif
