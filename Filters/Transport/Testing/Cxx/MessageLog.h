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

  /// Without the verdict on the scene: small scenes of tests have openings, and tolerances that
  /// rays to them do not reach, on purpose.
  std::string GetAllButVerdict() const
  {
    std::string all;
    for (const std::string& line : this->Lines)
    {
      const bool isVerdict = line.find("meets back faces") != std::string::npos ||
        line.find("has a leak") != std::string::npos ||
        line.find("a sky at 0 K") != std::string::npos ||
        line.find("do not reach the tolerance") != std::string::npos;
      all += isVerdict ? "" : line;
    }
    return all;
  }

  void Clear() { this->Lines.clear(); }

private:
  std::vector<std::string> Lines;
};
} // namespace LightTransportTesting

#endif
