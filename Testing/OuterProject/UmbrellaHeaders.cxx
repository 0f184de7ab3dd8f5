// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// One class of each module, reached through the umbrella.
#include "vtkOpenEXRReader.h"
#include "vtkPatchMesher.h"
#include "vtkRadiosity.h"
#include "vtkRadiosityPass.h"

#include "vtkNew.h"

int CountNewObjects()
{
  vtkNew<vtkOpenEXRReader> reader;
  vtkNew<vtkPatchMesher> mesher;
  vtkNew<vtkRadiosity> radiosity;
  vtkNew<vtkRadiosityPass> pass;
  return reader->GetReferenceCount() + mesher->GetReferenceCount() +
    radiosity->GetReferenceCount() + pass->GetReferenceCount();
}
