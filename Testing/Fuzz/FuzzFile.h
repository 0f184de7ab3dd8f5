// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the fuzz targets share: inputs as files, findings of their own, quiet, and what was said.
#ifndef FuzzFile_h
#define FuzzFile_h

#include "vtkCallbackCommand.h"
#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace LightTransportFuzz
{
//------------------------------------------------------------------------------
/// Ends the process, as a crash would, if something that must hold does not.
inline void Require(bool holds, const std::string& what)
{
  if (!holds)
  {
    std::fprintf(stderr, "WRONG: %s\n", what.c_str());
    std::abort();
  }
}

//------------------------------------------------------------------------------
/// Says nothing: the input is damaged nearly always. (With GlobalWarningDisplayOff there would be
/// no events for observers either.)
class SilentWindow : public vtkOutputWindow
{
public:
  static SilentWindow* New();
  vtkTypeMacro(SilentWindow, vtkOutputWindow);
  void DisplayText(const char*) override {}

protected:
  SilentWindow() = default;
};
vtkStandardNewMacro(SilentWindow);

//------------------------------------------------------------------------------
inline void BeQuiet()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<SilentWindow> window;
  vtkOutputWindow::SetInstance(window);
}

//------------------------------------------------------------------------------
/// How often an object has reported errors and warnings.
struct Messages
{
  int Errors = 0;
  int Warnings = 0;

  explicit Messages(vtkObject* object)
  {
    vtkNew<vtkCallbackCommand> counter;
    counter->SetClientData(this);
    counter->SetCallback(
      [](vtkObject*, unsigned long event, void* messages, void*)
      {
        auto* counts = static_cast<Messages*>(messages);
        (event == vtkCommand::ErrorEvent ? counts->Errors : counts->Warnings) += 1;
      });
    object->AddObserver(vtkCommand::ErrorEvent, counter);
    object->AddObserver(vtkCommand::WarningEvent, counter);
  }
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;
};

//------------------------------------------------------------------------------
/// A file in memory.
class MemoryFile
{
public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : Descriptor(memfd_create("fuzz", 0))
  {
    bool good = this->Descriptor >= 0;
    while (good && size > 0)
    {
      const ssize_t written = write(this->Descriptor, data, size);
      good = written > 0;
      data += good ? written : 0;
      size -= good ? static_cast<std::size_t>(written) : 0;
    }
    if (!good)
    {
      std::perror("the input cannot be kept in memory");
      std::_Exit(EXIT_FAILURE);
    }
  }
  ~MemoryFile() { close(this->Descriptor); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string GetName() const { return "/proc/self/fd/" + std::to_string(this->Descriptor); }

private:
  int Descriptor;
};
} // namespace LightTransportFuzz

#endif
