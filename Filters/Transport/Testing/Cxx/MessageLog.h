// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// All errors and warnings of a filter, one after another.
#ifndef MessageLog_h
#define MessageLog_h

#include "vtkCommand.h"

#include <string>
#include <vector>

namespace LightTransportTesting
{
class MessageLog : public vtkCommand
{
public:
  static MessageLog* New() { return new MessageLog; }

  void Execute(vtkObject*, unsigned long, void* text) override
  {
    this->Lines.emplace_back(static_cast<const char*>(text));
  }

  std::string GetAll() const
  {
    std::string all;
    for (const std::string& line : this->Lines)
    {
      all += line;
    }
    return all;
  }

  /// Without what is said of openings: most small scenes of tests have some, on purpose.
  std::string GetAllButOpenings() const
  {
    std::string all;
    for (const std::string& line : this->Lines)
    {
      const bool isOfOpenings = line.find("meets back faces") != std::string::npos ||
        line.find("has a leak") != std::string::npos ||
        line.find("a sky at 0 K") != std::string::npos;
      all += isOfOpenings ? "" : line;
    }
    return all;
  }

private:
  std::vector<std::string> Lines;
};
} // namespace LightTransportTesting

#endif
