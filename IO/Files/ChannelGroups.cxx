// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/ChannelGroups.h"

#include <algorithm>
#include <set>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
// Layers ("" or "name.") in which some channels lie.
std::set<std::string> FindLayers(const std::set<std::string>& channels)
{
  std::set<std::string> layers{ "" };
  for (const std::string& channel : channels)
  {
    const std::size_t dot = channel.rfind('.');
    if (dot != std::string::npos && dot > 0)
    {
      layers.insert(channel.substr(0, dot + 1));
    }
  }
  return layers;
}

//------------------------------------------------------------------------------
// The channels of a layer that make one array; empty where they do not.
std::vector<std::string> FindGroup(const std::set<std::string>& channels, const std::string& layer,
  bool colors)
{
  std::vector<std::string> group;
  const auto add = [&](const std::string& suffix)
  {
    const bool found = channels.count(layer + suffix) != 0;
    if (found)
    {
      group.push_back(layer + suffix);
    }
    return found;
  };
  if (colors)
  {
    if (!(add("R") && add("G") && add("B")))
    {
      return {};
    }
    add("A");
    return group;
  }
  while (add(std::to_string(group.size())))
  {
  }
  return group.size() > 1 && !layer.empty() ? group : std::vector<std::string>();
}
} // namespace

//------------------------------------------------------------------------------
std::vector<ChannelGroup> ChannelGroups::Find(const Imf::ChannelList& list)
{
  std::set<std::string> channels;
  for (auto it = list.begin(); it != list.end(); ++it)
  {
    channels.insert(it.name());
  }
  std::vector<ChannelGroup> arrays;
  std::set<std::string> names = channels;
  for (const std::string& layer : FindLayers(channels))
  {
    for (const bool colors : { true, false })
    {
      const std::vector<std::string> group = FindGroup(channels, layer, colors);
      std::string name = layer.substr(0, layer.empty() ? 0 : layer.size() - 1);
      if (name.empty())
      {
        name = group.size() == 4 ? "RGBA" : "RGB";
      }
      if (!group.empty() && names.insert(name).second)
      {
        arrays.push_back({ name, group });
        for (const std::string& channel : group)
        {
          channels.erase(channel);
        }
      }
    }
  }
  for (const std::string& channel : channels)
  {
    arrays.push_back({ channel, { channel } });
  }
  return arrays;
}

//------------------------------------------------------------------------------
const ChannelGroup& ChannelGroups::FindScalars(const std::vector<ChannelGroup>& arrays)
{
  for (const char* name : { "RGBA", "RGB", "Y" })
  {
    const auto found = std::find_if(arrays.begin(), arrays.end(),
      [&](const ChannelGroup& array) { return array.Name == name; });
    if (found != arrays.end())
    {
      return *found;
    }
  }
  return arrays.front();
}

//------------------------------------------------------------------------------
Imf::PixelType ChannelGroups::FindType(const Imf::ChannelList& list, const ChannelGroup& group)
{
  const bool integers = std::all_of(group.Channels.begin(), group.Channels.end(),
    [&](const std::string& channel) { return list.findChannel(channel)->type == Imf::UINT; });
  return integers ? Imf::UINT : Imf::FLOAT;
}
} // namespace LightTransport
