// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Which channels of a file become the components of one array: see vtkOpenEXRReader for the rules.
#ifndef ChannelGroups_h
#define ChannelGroups_h

#include <string>
#include <vector>

#include <ImfHeader.h>
#include <ImfPixelType.h>

namespace LightTransport
{
/// One array of the output and the channels that are its components.
struct ChannelGroup
{
  enum class Meaning
  {
    Values,
    /// RY, Y, BY (A) in place of R, G, B (A).
    LuminanceChroma
  };

  std::string Name;
  std::vector<std::string> Channels;
  /// What the values are read as: UINT or FLOAT, all channels of one kind.
  Imf::PixelType Type = Imf::FLOAT;
  Meaning Kind = Meaning::Values;
  /// Of one group: it is the point scalars.
  bool IsScalars = false;
};

namespace ChannelGroups
{
/// At least one group.
std::vector<ChannelGroup> Find(const Imf::Header& header);

/// Have the header say which array the scalars were: its name, and its first channel.
void KeepScalars(Imf::Header& header, const std::string& name, const std::string& channel);
} // namespace ChannelGroups
} // namespace LightTransport

#endif
