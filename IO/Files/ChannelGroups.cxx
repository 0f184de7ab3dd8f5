// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/ChannelGroups.h"

#include <ImfChannelList.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <set>

namespace LightTransport
{
namespace
{
using Names = std::set<std::string>;

/// Attributes of the header that say which array the scalars were.
constexpr const char* ScalarsName = "scalarsName";
constexpr const char* ScalarsChannel = "scalarsChannel";

//------------------------------------------------------------------------------
// Layers ("" or "name.") in which some channels lie.
Names FindLayers(const Names& channels)
{
  Names layers{ "" };
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
// The channels of these three in a layer, with alpha if that is there; empty where one is missing.
std::vector<std::string> FindColors(const Names& channels, const std::string& layer,
  const std::array<const char*, 3>& suffixes)
{
  std::vector<std::string> group;
  for (const char* suffix : suffixes)
  {
    group.push_back(layer + suffix);
  }
  const bool complete = std::all_of(group.begin(), group.end(),
    [&](const std::string& channel) { return channels.count(channel) != 0; });
  if (!complete)
  {
    return {};
  }
  if (channels.count(layer + "A") != 0)
  {
    group.push_back(layer + "A");
  }
  return group;
}

//------------------------------------------------------------------------------
std::vector<std::string> FindNumbered(const Names& channels, const std::string& layer)
{
  std::vector<std::string> group;
  for (std::string next = layer + '0'; channels.count(next) != 0;
       next = layer + std::to_string(group.size()))
  {
    group.push_back(next);
  }
  return group.size() > 1 && !layer.empty() ? group : std::vector<std::string>();
}

//------------------------------------------------------------------------------
// Takes the channels of one kind apart into groups; `names` are those that are given.
class Grouping
{
public:
  Grouping(Names channels, Imf::PixelType type, Names& names, std::vector<ChannelGroup>& groups)
    : Channels(std::move(channels)), Type(type), GivenNames(names), Groups(groups)
  {
  }

  void Run()
  {
    using Meaning = ChannelGroup::Meaning;
    for (const std::string& layer : FindLayers(this->Channels))
    {
      this->Add(layer, FindColors(this->Channels, layer, { "R", "G", "B" }), Meaning::Values);
      if (this->Type == Imf::FLOAT)
      {
        this->Add(layer, FindColors(this->Channels, layer, { "RY", "Y", "BY" }),
          Meaning::LuminanceChroma);
      }
      this->Add(layer, FindNumbered(this->Channels, layer), Meaning::Values);
    }
    for (const std::string& channel : this->Channels)
    {
      this->Groups.push_back({ channel, { channel }, this->Type });
    }
  }

private:
  void Add(const std::string& layer, const std::vector<std::string>& group,
    ChannelGroup::Meaning kind)
  {
    std::string name = layer.substr(0, layer.empty() ? 0 : layer.size() - 1);
    if (name.empty())
    {
      name = group.size() == 4 ? "RGBA" : "RGB";
    }
    if (group.empty() || !this->GivenNames.insert(name).second)
    {
      return;
    }
    this->Groups.push_back({ name, group, this->Type, kind });
    for (const std::string& channel : group)
    {
      this->Channels.erase(channel);
    }
  }

  Names Channels;
  Imf::PixelType Type;
  Names& GivenNames;
  std::vector<ChannelGroup>& Groups;
};

//------------------------------------------------------------------------------
// Gives the scalars of vtkOpenEXRWriter their name back.
bool RestoreScalars(const Imf::Header& header, std::vector<ChannelGroup>& groups)
{
  const auto* name = header.findTypedAttribute<Imf::StringAttribute>(ScalarsName);
  const auto* channel = header.findTypedAttribute<Imf::StringAttribute>(ScalarsChannel);
  if (!name || !channel || name->value().empty())
  {
    return false;
  }
  const auto found = std::find_if(groups.begin(), groups.end(),
    [&](const ChannelGroup& group) { return group.Channels.front() == channel->value(); });
  if (found == groups.end())
  {
    return false;
  }
  const auto taken = std::find_if(groups.begin(), groups.end(),
    [&](const ChannelGroup& group) { return group.Name == name->value(); });
  if (taken != groups.end() && taken != found)
  {
    return false;
  }
  found->Name = name->value();
  found->IsScalars = true;
  return true;
}

//------------------------------------------------------------------------------
void ChooseScalars(std::vector<ChannelGroup>& groups)
{
  for (const char* name : { "RGBA", "RGB", "Y" })
  {
    const auto found = std::find_if(groups.begin(), groups.end(),
      [&](const ChannelGroup& group) { return group.Name == name; });
    if (found != groups.end())
    {
      found->IsScalars = true;
      return;
    }
  }
  groups.front().IsScalars = true;
}
} // namespace

//------------------------------------------------------------------------------
std::vector<ChannelGroup> ChannelGroups::Find(const Imf::Header& header)
{
  // Numbers and ids are never components of one array: float cannot hold all ids.
  Names numbers;
  Names ids;
  const Imf::ChannelList& list = header.channels();
  for (auto it = list.begin(); it != list.end(); ++it)
  {
    (it.channel().type == Imf::UINT ? ids : numbers).insert(it.name());
  }
  Names names = numbers;
  names.insert(ids.begin(), ids.end());
  std::vector<ChannelGroup> groups;
  Grouping(numbers, Imf::FLOAT, names, groups).Run();
  Grouping(ids, Imf::UINT, names, groups).Run();
  if (!RestoreScalars(header, groups))
  {
    ChooseScalars(groups);
  }
  return groups;
}

//------------------------------------------------------------------------------
void ChannelGroups::KeepScalars(Imf::Header& header, const std::string& name,
  const std::string& channel)
{
  header.insert(ScalarsName, Imf::StringAttribute(name));
  header.insert(ScalarsChannel, Imf::StringAttribute(channel));
}
} // namespace LightTransport
