// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What the OpenEXR tests share.
#ifndef OpenEXRTestTools_h
#define OpenEXRTestTools_h

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenEXRReader.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTestUtilities.h"

#include <algorithm>
#include <array>
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

// One level of a file; null, and what is wrong, where it cannot be read.
inline vtkSmartPointer<vtkImageData> ReadFile(const std::string& path, int level = 0)
{
  vtkNew<vtkOpenEXRReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetLevel(level);
  reader->Update();
  return Check(reader->GetErrorCode() == 0, "level " + std::to_string(level) + " of " + path)
    ? reader->GetOutput()
    : nullptr;
}

inline int CountLevels(const std::string& path)
{
  vtkNew<vtkOpenEXRReader> reader;
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  return reader->GetNumberOfLevels();
}

inline bool HasExtent(vtkImageData* image, const std::array<int, 4>& expected)
{
  const int* extent = image->GetExtent();
  return std::equal(expected.begin(), expected.end(), extent) && extent[4] == 0 && extent[5] == 0;
}
} // namespace OpenEXRTestTools

#endif
