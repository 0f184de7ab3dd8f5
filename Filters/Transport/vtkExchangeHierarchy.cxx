// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkExchangeHierarchy.h"

#include "Links/RowCompression.h"
#include "Shared/Pulse.h"
#include "Support/Ranks.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <new>
#include <utility>

using namespace LightTransport;

vtkStandardNewMacro(vtkExchangeHierarchy);

namespace
{
//------------------------------------------------------------------------------
template <typename Table>
double GetBytes(const Table& table)
{
  return static_cast<double>(table.size() * sizeof(table[0]));
}
} // namespace

//------------------------------------------------------------------------------
vtkExchangeHierarchy::vtkExchangeHierarchy() = default;

//------------------------------------------------------------------------------
vtkExchangeHierarchy::~vtkExchangeHierarchy() = default;

//------------------------------------------------------------------------------
void vtkExchangeHierarchy::Clear()
{
  this->Areas.clear();
  this->Nodes.clear();
  this->Levels.clear();
  this->Parents.clear();
  this->Weights.clear();
  this->ClearLinks();
}

//------------------------------------------------------------------------------
void vtkExchangeHierarchy::ClearLinks()
{
  this->Columns.clear();
  this->Values.clear();
  this->Coded = {};
  this->NumberOfLinks = 0;
  this->Symmetric = true;
  this->Offsets.assign(this->GetNumberOfSlots() + 1, 0);
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkExchangeHierarchy::SetTree(const std::vector<double>& areas, const std::vector<Node>& nodes,
  int part, int numberOfParts, int numberOfKernels)
{
  this->Areas = areas;
  this->Weights = areas;
  this->Nodes = nodes;
  this->NumberOfKernels = numberOfKernels;
  this->Part = part;
  this->NumberOfParts = numberOfParts;
  const bool good = this->FindParents();
  good ? this->ClearLinks() : this->Clear();
  return good;
}

//------------------------------------------------------------------------------
// Breadth first, the children of a level are the next one: they begin where those of the level
// before end.
bool vtkExchangeHierarchy::FindParents()
{
  const int nodes = this->GetNumberOfNodes();
  const int slots = this->GetNumberOfSlots();
  this->Parents.assign(slots, -1);
  int next = 1;
  bool good = nodes > 0;
  for (int node = 0; good && node < nodes; ++node)
  {
    const Node& children = this->Nodes[node];
    const bool arePatches = children.First >= nodes;
    good = children.First < children.Last && children.Last <= (arePatches ? slots : nodes) &&
      (arePatches || children.First == next);
    next = arePatches ? next : children.Last;
    for (int child = children.First; good && child < children.Last; ++child)
    {
      good = this->Parents[child] < 0;
      this->Parents[child] = node;
    }
  }
  for (int slot = 1; good && slot < slots; ++slot)
  {
    good = this->Parents[slot] >= 0;
  }
  this->Levels.assign(1, 0);
  for (int begin = 0, end = 1; good && begin < end;)
  {
    this->Levels.push_back(end);
    int last = end;
    for (int node = begin; node < end; ++node)
    {
      last = this->Nodes[node].First < nodes ? this->Nodes[node].Last : last;
    }
    begin = end;
    end = last;
  }
  return good;
}

//------------------------------------------------------------------------------
bool vtkExchangeHierarchy::SetLinks(const std::vector<Link>& links)
{
  this->ClearLinks();
  std::size_t step = 0;
  for (const Link& link : links)
  {
    Pulse::Beat(++step);
    ++this->Offsets[link.I + 1];
    this->Offsets[link.J + 1] += link.I == link.J ? 0 : 1;
  }
  for (std::size_t slot = 1; slot < this->Offsets.size(); ++slot)
  {
    this->Offsets[slot] += this->Offsets[slot - 1];
  }
  try
  {
    this->Columns.resize(this->Offsets.back());
    this->Values.resize(this->Offsets.back());
  }
  catch (const std::bad_alloc&)
  {
    this->ClearLinks();
    return false;
  }
  std::vector<std::int64_t> ends(this->Offsets.begin(), this->Offsets.end() - 1);
  const auto put = [&](int row, int column, float value)
  {
    const std::int64_t place = ends[row]++;
    this->Columns[place] = column;
    this->Values[place] = value;
  };
  for (const Link& link : links)
  {
    Pulse::Beat(++step);
    put(link.I, link.J, link.Value);
    if (link.I != link.J)
    {
      put(link.J, link.I, link.Value);
    }
  }
  this->NumberOfLinks = static_cast<vtkIdType>(links.size());
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkExchangeHierarchy::SetRows(std::vector<std::int64_t> offsets, std::vector<int> columns,
  std::vector<float> values, bool isSymmetric)
{
  this->ClearLinks();
  const int slots = this->GetNumberOfSlots();
  const bool good = offsets.size() == this->Offsets.size() && offsets.front() == 0 &&
    offsets.back() == static_cast<std::int64_t>(columns.size()) &&
    std::is_sorted(offsets.begin(), offsets.end()) &&
    values.size() == columns.size() * this->NumberOfKernels &&
    std::all_of(columns.begin(), columns.end(),
      [=](int slot) { return slot >= 0 && slot < slots; });
  if (good)
  {
    this->Offsets = std::move(offsets);
    this->Columns = std::move(columns);
    this->Values = std::move(values);
    this->NumberOfLinks = static_cast<vtkIdType>(this->Columns.size());
    this->Symmetric = isSymmetric;
    if (isSymmetric)
    {
      this->NumberOfLinks = (this->NumberOfLinks + this->CountLoops()) / 2;
    }
  }
  return good;
}

//------------------------------------------------------------------------------
// Links of a slot with itself.
vtkIdType vtkExchangeHierarchy::CountLoops() const
{
  vtkIdType loops = 0;
  for (int slot = 0; slot < this->GetNumberOfSlots(); ++slot)
  {
    const auto [first, last] = this->GetRow(slot);
    loops += std::count(this->Columns.begin() + first, this->Columns.begin() + last, slot);
  }
  return loops;
}

//------------------------------------------------------------------------------
bool vtkExchangeHierarchy::SetCodedRows(CodedRows rows)
{
  const int slots = this->GetNumberOfSlots();
  bool good =
    rows.Book.size() == static_cast<std::size_t>(CodedRows::BookSize) * this->NumberOfKernels;
  for (const CodedRows::Tile& tile : rows.Tiles)
  {
    good = good && tile.FirstRow >= 0 && tile.LastRow <= slots && tile.FirstSlot >= 0 &&
      tile.NumberOfSlots >= 0 && tile.NumberOfSlots <= CodedRows::BookSize && tile.Common >= 0 &&
      tile.FirstSlot + tile.NumberOfSlots <= static_cast<std::int64_t>(rows.Slots.size());
    if (good)
    {
      rows.VisitSlots(tile, [&](int, int slot) { good = good && slot >= 0 && slot < slots; });
    }
  }
  if (good)
  {
    this->NumberOfLinks += static_cast<vtkIdType>(rows.NumberOfLinks - this->Coded.NumberOfLinks);
    this->Coded = std::move(rows);
    if (this->Columns.empty())
    {
      std::vector<std::int64_t>().swap(this->Offsets);
    }
    this->Symmetric = false;
    this->Modified();
  }
  return good;
}

//------------------------------------------------------------------------------
double vtkExchangeHierarchy::CompressRows(double tolerance, vtkMultiProcessController* controller)
{
  return this->Coded.Book.empty() ? RowCompression::Compress(*this, tolerance, Ranks(controller))
                                  : 0.0;
}

//------------------------------------------------------------------------------
double vtkExchangeHierarchy::GetEstimatedBytes(double numberOfLinks)
{
  return GetEstimatedBytesOfRows(2.0 * numberOfLinks, 1);
}

//------------------------------------------------------------------------------
double vtkExchangeHierarchy::GetEstimatedBytesOfRows(double numberOfLinks, int numberOfKernels)
{
  return numberOfLinks * (sizeof(int) + numberOfKernels * sizeof(float));
}

//------------------------------------------------------------------------------
void vtkExchangeHierarchy::SetWeights(const std::vector<double>& weights)
{
  this->Weights = weights;
  this->Modified();
}

//------------------------------------------------------------------------------
double vtkExchangeHierarchy::GetValue(vtkIdType i, vtkIdType j, int kernel) const
{
  const auto getSlot = [this](vtkIdType patch)
  { return this->GetNumberOfNodes() + static_cast<int>(patch); };
  std::vector<int> others;
  for (int slot = getSlot(j); slot >= 0; slot = this->Parents[slot])
  {
    others.push_back(slot);
  }
  std::vector<int> rows;
  for (int slot = getSlot(i); slot >= 0; slot = this->Parents[slot])
  {
    rows.push_back(slot);
  }
  double sum = this->GetCodedValue(rows, others, kernel);
  for (const int slot : rows)
  {
    const auto [first, last] = this->GetRow(slot);
    for (std::int64_t link = first; link < last; ++link)
    {
      const bool isOther =
        std::find(others.begin(), others.end(), this->Columns[link]) != others.end();
      sum +=
        isOther ? static_cast<double>(this->Values[link * this->NumberOfKernels + kernel]) : 0.0;
    }
  }
  return this->Weights[i] * sum * this->Weights[j];
}

//------------------------------------------------------------------------------
double vtkExchangeHierarchy::GetCodedValue(const std::vector<int>& rows,
  const std::vector<int>& others, int kernel) const
{
  const auto isIn = [](const std::vector<int>& slots, int slot)
  { return std::find(slots.begin(), slots.end(), slot) != slots.end(); };
  double sum = 0.0;
  for (const CodedRows::Tile& tile : this->Coded.Tiles)
  {
    std::vector<int> slots;
    this->Coded.VisitSlots(tile, [&](int, int slot) { slots.push_back(slot); });
    const auto add = [&](int place, int code)
    {
      sum += isIn(others, slots[place])
        ? static_cast<double>(this->Coded.Book[code * this->NumberOfKernels + kernel])
        : 0.0;
    };
    this->Coded.VisitPieces(tile,
      [&](int row, const std::uint8_t* bytes, int pairs)
      {
        if (isIn(rows, row))
        {
          CodedRows::VisitLinks(tile, bytes, pairs, add);
        }
      });
  }
  return sum;
}

//------------------------------------------------------------------------------
double vtkExchangeHierarchy::GetNumberOfBytes() const
{
  return GetBytes(this->Nodes) + GetBytes(this->Parents) + GetBytes(this->Weights) +
    GetBytes(this->Areas) + this->GetNumberOfLinkBytes();
}

//------------------------------------------------------------------------------
double vtkExchangeHierarchy::GetNumberOfLinkBytes() const
{
  const CodedRows& coded = this->Coded;
  return GetBytes(this->Offsets) + GetBytes(this->Columns) + GetBytes(this->Values) +
    GetBytes(coded.Book) + GetBytes(coded.Slots) + GetBytes(coded.Tiles) + GetBytes(coded.Bytes);
}

//------------------------------------------------------------------------------
void vtkExchangeHierarchy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfNodes: " << this->GetNumberOfNodes() << "\n";
  os << indent << "NumberOfLinks: " << this->NumberOfLinks << "\n";
}
