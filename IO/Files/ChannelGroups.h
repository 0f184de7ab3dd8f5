// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Which channels of a file become the components of one array: see vtkOpenEXRReader for the rules.
#ifndef ChannelGroups_h
#define ChannelGroups_h

#include <string>
#include <vector>

#include <ImfChannelList.h>
#include <ImfPixelType.h>

namespace LightTransport
{
/// One array of the output and the channels that are its components.
struct ChannelGroup
{
  std::string Name;
  std::vector<std::string> Channels;
};

namespace ChannelGroups
{
std::vector<ChannelGroup> Find(const Imf::ChannelList& list);

/// The one of the groups, at least one, that the point scalars are.
const ChannelGroup& FindScalars(const std::vector<ChannelGroup>& groups);

/// The type that the values of a group are read as.
Imf::PixelType FindType(const Imf::ChannelList& list, const ChannelGroup& group);
} // namespace ChannelGroups
} // namespace LightTransport

#endif
