// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/DeviceErrors.h"

#include "Context/OpenGLFunctions.h"

#include "vtkObject.h"

namespace LightTransport
{
namespace
{
/// A context that has been lost may report errors for ever.
constexpr int MostErrors = 100;
} // namespace

//------------------------------------------------------------------------------
Outcome DeviceErrors::Check()
{
  const unsigned int code = glGetError();
  if (code == GL_NO_ERROR)
  {
    return Outcome::Done();
  }
  DeviceErrors::Clear();
  return Outcome::Failed(
    code == GL_OUT_OF_MEMORY ? "out of memory" : "error " + std::to_string(code));
}

//------------------------------------------------------------------------------
void DeviceErrors::Clear()
{
  for (int count = 0; count < MostErrors && glGetError() != GL_NO_ERROR;)
  {
    ++count;
  }
}

//------------------------------------------------------------------------------
bool DeviceErrors::Finish(vtkObject* reporter, const Outcome& work, const char* what,
  const std::string& device)
{
  const Outcome done = work ? DeviceErrors::Check() : work;
  if (!done)
  {
    vtkErrorWithObjectMacro(reporter,
      "OpenGL failed in " << what << " with " << done.GetMessage() << " on " << device
                          << ". Set Device to CPU.");
  }
  return static_cast<bool>(done);
}
} // namespace LightTransport
