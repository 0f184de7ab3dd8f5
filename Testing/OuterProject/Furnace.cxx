// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// A closed box whose faces emit 1 - rho and reflect rho: the radiosity is 1 everywhere.
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPlatonicSolidSource.h"
#include "vtkPolyData.h"
#include "vtkRadiosity.h"
#include "vtkReverseSense.h"

#include <cmath>
#include <cstdlib>
#include <iostream>

namespace
{
//------------------------------------------------------------------------------
void AddUniformCellArray(vtkPolyData* surface, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfValues(surface->GetNumberOfCells());
  array->Fill(value);
  surface->GetCellData()->AddArray(array);
}
} // namespace

//------------------------------------------------------------------------------
int main()
{
  vtkNew<vtkPlatonicSolidSource> cube;
  cube->SetSolidTypeToCube();
  vtkNew<vtkReverseSense> inward;
  inward->SetInputConnection(cube->GetOutputPort());
  inward->ReverseCellsOn();
  inward->ReverseNormalsOff();
  inward->Update();

  vtkNew<vtkPolyData> box;
  box->ShallowCopy(inward->GetOutput());
  AddUniformCellArray(box, "Emission", 0.3);
  AddUniformCellArray(box, "Reflectance", 0.7);

  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputData(box);
  radiosity->SetTolerance(1e-7);
  radiosity->Update();
  vtkPolyData* output = vtkPolyData::SafeDownCast(radiosity->GetOutputDataObject(0));
  vtkDataArray* result = output ? output->GetCellData()->GetArray("Radiosity") : nullptr;
  if (!result || result->GetNumberOfTuples() != 6)
  {
    std::cerr << "No radiosity on six faces.\n";
    return EXIT_FAILURE;
  }
  for (vtkIdType face = 0; face < 6; ++face)
  {
    const double value = result->GetComponent(face, 0);
    if (!(std::abs(value - 1.0) < 1e-5))
    {
      std::cerr << "Radiosity of face " << face << " is " << value << ", not 1.\n";
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}
