// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Any file gives an image whose arrays are whole, or an error and nothing.
#include "FuzzFile.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenEXRReader.h"
#include "vtkPointData.h"

using namespace LightTransportFuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

//------------------------------------------------------------------------------
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  BeQuiet();
  const MemoryFile file(data, size);
  vtkNew<vtkOpenEXRReader> reader;
  int errors = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&errors);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { *static_cast<int*>(count) += 1; });
  reader->AddObserver(vtkCommand::ErrorEvent, counter);
  reader->SetFileName(file.GetName().c_str());
  reader->CanReadFile(reader->GetFileName());
  reader->UpdateInformation();
  // The last byte chooses a level, so that those beyond the first are read as well.
  const int levels = reader->GetNumberOfLevels();
  reader->SetLevel(levels > 1 ? data[size - 1] % levels : 0);
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const vtkIdType points = image->GetNumberOfPoints();
  vtkPointData* arrays = image->GetPointData();
  if (errors > 0)
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
