// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Outputs of the type that the input has, for filters that take composite data as one scene.
#ifndef OutputLikeInput_h
#define OutputLikeInput_h

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"

namespace LightTransport
{
namespace OutputLikeInput
{
/// The answer to a request for data objects, for the first ports. False where there is no input.
inline bool Make(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  if (!input)
  {
    return false;
  }
  if (vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
      !output || !output->IsA(input->GetClassName()))
  {
    vtkSmartPointer<vtkDataObject> copy;
    copy.TakeReference(input->NewInstance());
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), copy);
  }
  return true;
}
} // namespace OutputLikeInput
} // namespace LightTransport

#endif
