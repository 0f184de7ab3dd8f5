// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DeviceErrors_h
#define DeviceErrors_h

#include "Shared/Outcome.h"

#include <string>

class vtkObject;

namespace LightTransport
{
namespace DeviceErrors
{
/// A failure names the first error that OpenGL has reported since the last call.
Outcome Check();

/// Forget what OpenGL has reported, which others have done.
void Clear();

/// True where `work` is done and OpenGL has reported no error either; else an error of `reporter`
/// that says in what (`what`, a gerund or a method's name) the device failed.
bool Finish(vtkObject* reporter, const Outcome& work, const char* what, const std::string& device);
} // namespace DeviceErrors
} // namespace LightTransport

#endif
