// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Loading this module's library, whose path is the argument, is enough for vtkDeviceLinkOperator to
 * be made; without it New() gives nothing, quietly.
 */
#include "vtkDeviceLinkOperator.h"

#include "vtkSmartPointer.h"

#include <dlfcn.h>

#include <cstdlib>
#include <iostream>

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  auto device = vtkSmartPointer<vtkDeviceLinkOperator>::Take(vtkDeviceLinkOperator::New());
  if (device)
  {
    std::cerr << "ERROR: there is a device operator without any module that has one\n";
    return EXIT_FAILURE;
  }
  if (argc != 2 || !dlopen(argv[1], RTLD_NOW | RTLD_LOCAL))
  {
    std::cerr << "ERROR: the library cannot be loaded\n";
    return EXIT_FAILURE;
  }
  device.TakeReference(vtkDeviceLinkOperator::New());
  if (!device || !device->IsA("vtkOpenGLLinkOperator"))
  {
    std::cerr << "ERROR: loading the library registers nothing\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
