// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ViewFactorGroups.h"

#include "Links/LinkOperators.h"
#include "Links/Links.h"
#include "Scene/CellArrays.h"
#include "Shared/Threads.h"
#include "Shared/TransportMemory.h"
#include "Shared/ZeroedArray.h"
#include "Support/Ranks.h"
#include "vtkCPULinkOperator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

namespace LightTransport
{
namespace
{
constexpr vtkIdType N = vtkExchangeMatrix::TileSize;
// Integers beyond this are not all doubles.
constexpr double LargestInteger = 9007199254740992.0;

const char* const GroupColumn = "Group";
const char* const AreaColumn = "Area";
const char* const SkyColumn = "Sky";
const char* const BackFaceColumn = "BackFace";

//------------------------------------------------------------------------------
struct Blocks
{
  std::vector<std::string> Names;
  std::vector<double> OfLeaves; // for each leaf that is not empty the number of its block
};

//------------------------------------------------------------------------------
std::string GetBlockName(vtkDataObjectTreeIterator* node, std::size_t number)
{
  const bool named =
    node->HasCurrentMetaData() && node->GetCurrentMetaData()->Has(vtkCompositeDataSet::NAME());
  const char* name = named ? node->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME()) : nullptr;
  return name && *name ? name : "Block " + std::to_string(number);
}

//------------------------------------------------------------------------------
// Empty blocks count, so that the ranks, each of which has other blocks, count alike.
Blocks ListBlocks(vtkDataObject* input)
{
  auto* tree = vtkDataObjectTree::SafeDownCast(input);
  if (!tree)
  {
    return { { "All" }, { 0.0 } };
  }
  Blocks blocks;
  unsigned int lastPiece = 0;
  if (vtkPartitionedDataSet::SafeDownCast(tree))
  {
    blocks.Names.emplace_back("All");
    lastPiece = std::numeric_limits<unsigned int>::max();
  }
  vtkSmartPointer<vtkDataObjectTreeIterator> node;
  node.TakeReference(tree->NewTreeIterator());
  node->VisitOnlyLeavesOff();
  node->SkipEmptyNodesOff();
  for (node->InitTraversal(); !node->IsDoneWithTraversal(); node->GoToNextItem())
  {
    vtkDataObject* data = node->GetCurrentDataObject();
    auto* pieces = vtkPartitionedDataSet::SafeDownCast(data);
    const bool isLeaf = !vtkCompositeDataSet::SafeDownCast(data);
    if ((pieces || isLeaf) && node->GetCurrentFlatIndex() > lastPiece)
    {
      blocks.Names.push_back(GetBlockName(node, blocks.Names.size()));
    }
    if (pieces)
    {
      lastPiece = node->GetCurrentFlatIndex() + pieces->GetNumberOfPartitions();
    }
    if (isLeaf && data)
    {
      blocks.OfLeaves.push_back(static_cast<double>(blocks.Names.size() - 1));
    }
  }
  return blocks;
}

//------------------------------------------------------------------------------
// Groups in the order of their ids; getName(id) where the name has not been given away.
template <typename Function>
void SortGroups(const std::vector<double>& ids, Function&& getName,
  ViewFactorGroups::Groups& groups)
{
  std::map<double, int> known;
  for (const double id : ids)
  {
    known.emplace(id, 0);
  }
  std::set<std::string> taken{ GroupColumn, AreaColumn, SkyColumn, BackFaceColumn };
  groups.Names.clear();
  for (auto& group : known)
  {
    group.second = static_cast<int>(groups.Names.size());
    const std::string name = getName(group.first);
    std::string unique = name;
    for (int count = 2; !taken.insert(unique).second; ++count)
    {
      unique = name + " (" + std::to_string(count) + ")";
    }
    groups.Names.push_back(unique);
  }
  groups.OfPatches.resize(ids.size());
  std::transform(ids.begin(), ids.end(), groups.OfPatches.begin(),
    [&](double id) { return known[id]; });
}

//------------------------------------------------------------------------------
// The exchange between groups, each pair of patches once: in one or the other order of its groups.
struct GroupSums
{
  const std::vector<vtkExchangeMatrix::Tile>& Tiles;
  const std::vector<int>& Groups;
  int NumberOfGroups;
  Threads::Local<std::vector<double>> Local;
  std::vector<double> Total;

  void Initialize()
  {
    this->Local.Get().assign(static_cast<std::size_t>(this->NumberOfGroups) * this->NumberOfGroups,
      0.0);
  }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    std::vector<double>& sums = this->Local.Get();
    const auto patches = static_cast<vtkIdType>(this->Groups.size());
    for (vtkIdType index = begin; index < end; ++index)
    {
      const vtkExchangeMatrix::Tile& tile = this->Tiles[index];
      const vtkIdType rows = std::min(N, patches - tile.Row * N);
      const vtkIdType columns = std::min(N, patches - tile.Column * N);
      const int* groups = this->Groups.data() + tile.Column * N;
      for (vtkIdType row = 0; tile.Values && row < rows; ++row)
      {
        const float* values = tile.Values + row * N;
        const vtkIdType group = this->Groups[tile.Row * N + row];
        double* target = sums.data() + group * this->NumberOfGroups;
        vtkIdType column = 0;
        if (tile.Row == tile.Column)
        {
          target[groups[row]] += 0.5 * values[row];
          column = row + 1;
        }
        for (; column < columns; ++column)
        {
          target[groups[column]] += values[column];
        }
      }
    }
  }

  void Reduce()
  {
    this->Local.ForEach(
      [&](const std::vector<double>& sums)
      {
        std::transform(sums.begin(), sums.end(), this->Total.begin(), this->Total.begin(),
          std::plus<double>());
      });
  }
};

//------------------------------------------------------------------------------
// What the patches of each group have together.
template <typename Function>
std::vector<double> SumPatches(const ViewFactorGroups::Groups& groups, Function&& getValue)
{
  std::vector<double> sums(groups.Names.size(), 0.0);
  for (std::size_t patch = 0; patch < groups.OfPatches.size(); ++patch)
  {
    sums[groups.OfPatches[patch]] += getValue(patch);
  }
  return sums;
}

//------------------------------------------------------------------------------
// A column of getValue(row).
template <typename Function>
void AddColumn(vtkTable* table, const std::string& name, Function&& getValue)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name.c_str());
  ZeroedArray::Fill(column, table->GetNumberOfRows());
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    column->SetValue(row, getValue(row));
  }
  table->AddColumn(column);
}
} // namespace

//------------------------------------------------------------------------------
Outcome ViewFactorGroups::Gather(const CellArrays& arrays, vtkDataObject* input,
  const std::string& arrayName, Groups& groups)
{
  std::vector<double> ids;
  int components = 0;
  if (Outcome read = arrays.Read(arrayName, false, ids, components); !read)
  {
    return read;
  }
  if (ids.empty())
  {
    const Blocks blocks = ListBlocks(input);
    ids = arrays.SpreadBlockValues(blocks.OfLeaves);
    SortGroups(
      ids,
      [&](double id)
      {
        const auto block = static_cast<std::size_t>(id);
        return block < blocks.Names.size() ? blocks.Names[block] : "Block " + std::to_string(block);
      },
      groups);
  }
  else
  {
    const bool integers = components == 1 &&
      std::all_of(ids.begin(), ids.end(),
        [](double id) { return std::floor(id) == id && std::abs(id) <= LargestInteger; });
    if (!integers)
    {
      return Outcome::Failed("The cell array \"" + arrayName +
        "\" numbers the groups of view factors: it must have one component and integer values.");
    }
    SortGroups(
      ids, [](double id) { return std::to_string(static_cast<long long>(id)); }, groups);
  }
  if (groups.Names.size() > MaximumNumberOfGroups)
  {
    return Outcome::Failed("There are " + std::to_string(groups.Names.size()) +
      " groups for the table of view factors, but at most " +
      std::to_string(MaximumNumberOfGroups) + " make sense: give a cell array \"" + arrayName +
      "\" with fewer values.");
  }
  return Outcome::Done();
}

namespace
{
//------------------------------------------------------------------------------
// Exchange between groups, each pair of patches counted once, from tiles.
bool SumTiles(const Links& links, const ViewFactorGroups::Groups& groups, const Ranks& ranks,
  std::vector<double>& exchange)
{
  const std::size_t count = groups.Names.size();
  const std::vector<vtkExchangeMatrix::Tile>& tiles = links.Matrix->GetTiles();
  GroupSums sums{ tiles, groups.OfPatches, static_cast<int>(count), {},
    std::vector<double>(count * count, 0.0) };
  Threads::For(0, static_cast<vtkIdType>(tiles.size()), 0, sums);
  exchange = sums.Total;
  return ranks.Sum(exchange);
}

//------------------------------------------------------------------------------
// The same from products with links between clusters, one for each group.
bool SumProducts(const Links& links, const ViewFactorGroups::Groups& groups, const Ranks& ranks,
  std::vector<double>& exchange)
{
  const std::size_t count = groups.Names.size();
  exchange.assign(count * count, 0.0);
  auto product = LinkOperators::MakeOnCPU(links.Hierarchy, 1, ranks);
  std::vector<double> values(groups.OfPatches.size());
  bool good = product != nullptr;
  for (std::size_t group = 0; good && group < count; ++group)
  {
    std::transform(groups.OfPatches.begin(), groups.OfPatches.end(), values.begin(),
      [&](int other) { return other == static_cast<int>(group) ? 0.5 : 0.0; });
    good = product->SetVector(0, values.data()) && product->Multiply(1, 0) &&
      product->GetVector(1, values.data());
    for (std::size_t patch = 0; good && patch < values.size(); ++patch)
    {
      exchange[groups.OfPatches[patch] * count + group] += values[patch];
    }
  }
  return good;
}
} // namespace

//------------------------------------------------------------------------------
Outcome ViewFactorGroups::FillTable(const Links& links, const Groups& groups, double scale,
  const Ranks& ranks, vtkTable* table)
{
  const std::size_t count = groups.Names.size();
  std::vector<double> exchange;
  if (!(links.Hierarchy ? SumProducts(links, groups, ranks, exchange)
                        : SumTiles(links, groups, ranks, exchange)))
  {
    return Outcome::FailedAsReported();
  }
  const std::vector<double>& areas = links.GetExchange()->GetAreas();
  const std::vector<double> groupAreas =
    SumPatches(groups, [&](std::size_t patch) { return areas[patch]; });
  TransportMemory::RequireMargin();
  table->Initialize();
  vtkNew<vtkStringArray> names;
  names->SetName(GroupColumn);
  for (const std::string& name : groups.Names)
  {
    names->InsertNextValue(name);
  }
  table->AddColumn(names);
  AddColumn(table, AreaColumn, [&](vtkIdType row) { return groupAreas[row] * scale * scale; });
  for (std::size_t to = 0; to < count; ++to)
  {
    AddColumn(table, groups.Names[to],
      [&](vtkIdType from)
      { return (exchange[from * count + to] + exchange[to * count + from]) / groupAreas[from]; });
  }
  const auto addFractions = [&](const char* name, const std::vector<double>& fractions)
  {
    const std::vector<double> parts =
      SumPatches(groups, [&](std::size_t patch) { return areas[patch] * fractions[patch]; });
    AddColumn(table, name, [&](vtkIdType row) { return parts[row] / groupAreas[row]; });
  };
  addFractions(SkyColumn, links.SkyFractions);
  addFractions(BackFaceColumn, links.BackFaceFractions);
  return Outcome::Done();
}
} // namespace LightTransport
