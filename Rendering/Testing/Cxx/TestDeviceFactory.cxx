// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The filters' abstract device operator, refiner of links and shooter are made by this module once
 * it is loaded, and open.
 */
#include "vtkDeviceLinkOperator.h"
#include "vtkDeviceLinkRefiner.h"
#include "vtkDeviceShooter.h"

#include "vtkSmartPointer.h"

#include <cstdlib>
#include <iostream>
#include <string>

//------------------------------------------------------------------------------
int TestDeviceFactory(int, char*[])
{
  auto device = vtkSmartPointer<vtkDeviceLinkOperator>::Take(vtkDeviceLinkOperator::New());
  if (!device || !device->IsA("vtkOpenGLLinkOperator"))
  {
    std::cerr << "ERROR: no factory gives a vtkOpenGLLinkOperator\n";
    return EXIT_FAILURE;
  }
  std::string reason;
  if (!device->Open(reason))
  {
    std::cerr << "ERROR: " << reason << "\n";
    return EXIT_FAILURE;
  }
  std::cout << device->GetDeviceName() << "\n";
  if (std::string(device->GetDeviceName()).find("OpenGL (") != 0 || !device->IsSinglePrecision())
  {
    std::cerr << "ERROR: " << device->GetDeviceName() << " is no OpenGL device\n";
    return EXIT_FAILURE;
  }
  auto refiner = vtkSmartPointer<vtkDeviceLinkRefiner>::Take(vtkDeviceLinkRefiner::New());
  if (!refiner || !refiner->IsA("vtkOpenGLLinkRefiner") || !refiner->Open(reason) ||
    std::string(refiner->GetDeviceName()) != device->GetDeviceName())
  {
    std::cerr << "ERROR: no factory gives a vtkOpenGLLinkRefiner that opens: " << reason << "\n";
    return EXIT_FAILURE;
  }
  auto shooter = vtkSmartPointer<vtkDeviceShooter>::Take(vtkDeviceShooter::New());
  if (!shooter || !shooter->IsA("vtkOpenGLShooter") || !shooter->Open(reason) ||
    std::string(shooter->GetDeviceName()) != device->GetDeviceName())
  {
    std::cerr << "ERROR: no factory gives a vtkOpenGLShooter that opens: " << reason << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
