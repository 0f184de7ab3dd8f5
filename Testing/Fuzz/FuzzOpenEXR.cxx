// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Any file gives an image whose arrays are whole, or an error and nothing.
#include "FuzzFile.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenEXRReader.h"
#include "vtkPointData.h"

#include <algorithm>
#include <numeric>

using namespace LightTransportFuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{
//------------------------------------------------------------------------------
// A part of the file, and one of its levels.
void Choose(vtkOpenEXRReader* reader, unsigned int choice)
{
  const auto index = [&choice](int count)
  {
    const auto several = static_cast<unsigned int>(std::max(count, 1));
    const unsigned int chosen = choice % several;
    choice /= several;
    return static_cast<int>(chosen);
  };
  reader->UpdateInformation();
  reader->SetPart(index(reader->GetNumberOfParts()));
  reader->UpdateInformation();
  reader->SetLevel(index(reader->GetNumberOfLevels()));
}
} // namespace

//------------------------------------------------------------------------------
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  BeQuiet();
  const MemoryFile file(data, size);
  vtkNew<vtkOpenEXRReader> reader;
  Messages messages(reader);
  reader->SetFileName(file.GetName().c_str());
  reader->CanReadFile(reader->GetFileName());
  // Every mutation chooses anew, so that images beyond the first are read as well.
  Choose(reader, std::accumulate(data, data + size, 0u));
  // The first image may be one that cannot be read.
  messages.Errors = 0;
  reader->Modified();
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const vtkIdType points = image->GetNumberOfPoints();
  vtkPointData* arrays = image->GetPointData();
  if (messages.Errors > 0)
  {
    Require(points == 0 && arrays->GetNumberOfArrays() == 0, "an image in spite of an error");
    return 0;
  }
  Require(points > 0 && arrays->GetNumberOfArrays() > 0, "neither an image nor an error");
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    Require(arrays->GetArray(i)->GetNumberOfTuples() == points, "an array that is not whole");
  }
  return 0;
}
