// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/TexelGathering.h"

#include "Scene/Leaves.h"
#include "Scene/PatchTree.h"
#include "Scene/TexelShape.h"
#include "Shared/ArrayNames.h"
#include "Shared/BitHash.h"
#include "Shared/InputArrays.h"
#include "Shared/Pulse.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

namespace LightTransport
{
namespace
{
using Vector = TexelShape::Vector;

/// An array of a texel image, and where its components are among the numbers of a texel.
struct TexelArray
{
  const char* Name;
  int Components;
  vtkDataArray* Array;
};

/// Texels with surface, one after another.
struct Texels
{
  /// Which image, column, row, chart.
  using Place = std::array<vtkIdType, 4>;
  /// Position, normal, area.
  using Numbers = std::array<double, 7>;

  std::vector<vtkIdType> Places;
  std::vector<double> Values;

  std::size_t GetNumber() const { return this->Places.size() / std::tuple_size<Place>::value; }
  void Add(const Place& place, const Numbers& numbers)
  {
    this->Places.insert(this->Places.end(), place.begin(), place.end());
    this->Values.insert(this->Values.end(), numbers.begin(), numbers.end());
  }
  Place GetPlace(std::size_t texel) const { return Get<Place>(this->Places, texel); }
  Numbers GetNumbers(std::size_t texel) const { return Get<Numbers>(this->Values, texel); }
  Vector GetPosition(std::size_t texel) const
  {
    return Vector(&this->Values[texel * std::tuple_size<Numbers>::value]);
  }
  bool AreEqual(std::size_t a, std::size_t b) const
  {
    return this->GetPlace(a) == this->GetPlace(b) && this->GetNumbers(a) == this->GetNumbers(b);
  }

private:
  template <typename Tuple, typename Value>
  static Tuple Get(const std::vector<Value>& values, std::size_t texel)
  {
    Tuple tuple;
    std::copy_n(values.begin() + texel * tuple.size(), tuple.size(), tuple.begin());
    return tuple;
  }
};

/// What a rank has read: its texels, and where they are.
struct LocalTexels : Texels
{
  std::vector<LocalCell> Cells;
};

//------------------------------------------------------------------------------
Outcome FailAt(const TexelArray& array, const std::string& what, vtkIdType point)
{
  return Outcome::Failed(std::string("The point array \"") + array.Name +
    "\" has a value that is " + what + " at point " + std::to_string(point) +
    ": make the texel image again with vtkSurfaceToAtlas.");
}

//------------------------------------------------------------------------------
Outcome FindArrays(vtkImageData* image, std::array<TexelArray, 4>& arrays)
{
  std::string missing;
  for (TexelArray& texels : arrays)
  {
    vtkAbstractArray* array = image->GetPointData()->GetAbstractArray(texels.Name);
    texels.Array = vtkDataArray::SafeDownCast(array);
    if (array && (!texels.Array || array->GetNumberOfComponents() != texels.Components))
    {
      return Outcome::Failed(std::string("The point array \"") + texels.Name +
        "\" of the texel image must have " + std::to_string(texels.Components) +
        (texels.Components == 1 ? " component" : " components") +
        " of numbers: make the image with vtkSurfaceToAtlas.");
    }
    missing += array ? "" : std::string(missing.empty() ? "\"" : ", \"") + texels.Name + "\"";
  }
  return missing.empty()
    ? Outcome::Done()
    : Outcome::Failed("The image has no point array " + missing +
        ": give a texel image, as vtkSurfaceToAtlas makes it of a surface, or the surface.");
}

//------------------------------------------------------------------------------
Outcome CheckLayer(vtkImageData* image)
{
  int size[3];
  image->GetDimensions(size);
  return size[2] == 1 ? Outcome::Done()
                      : Outcome::Failed("The image has " + std::to_string(size[0]) + " x " +
                          std::to_string(size[1]) + " x " + std::to_string(size[2]) +
                          " points: a texel image has one layer, with one point for each texel.");
}

//------------------------------------------------------------------------------
Outcome ReadNumbers(const std::array<TexelArray, 4>& arrays, vtkIdType point,
  Texels::Numbers& numbers)
{
  auto* number = numbers.begin();
  for (std::size_t k = 1; k < arrays.size(); ++k)
  {
    for (int component = 0; component < arrays[k].Components; ++component, ++number)
    {
      // Adding zero turns -0 into 0: equal numbers then have equal bits.
      *number = arrays[k].Array->GetComponent(point, component) + 0.0;
      if (!std::isfinite(*number))
      {
        return FailAt(arrays[k], "not finite", point);
      }
    }
  }
  return numbers.back() < 0.0 ? FailAt(arrays.back(), "negative", point) : Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome ReadImage(vtkImageData* image, int block, vtkIdType number, LocalTexels& texels,
  double& precision)
{
  std::array<TexelArray, 4> arrays = { { { ArrayNames::ChartId, 1, nullptr },
    { ArrayNames::TexelPosition, 3, nullptr }, { ArrayNames::TexelNormal, 3, nullptr },
    { ArrayNames::TexelArea, 1, nullptr } } };
  Outcome read = InputArrays::CheckLengths(image);
  read = read ? CheckLayer(image) : read;
  read = read ? FindArrays(image, arrays) : read;
  if (!read)
  {
    return read;
  }
  precision = std::max(precision, PolygonGathering::GetPrecision(arrays[1].Array));
  auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
    image->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  constexpr unsigned char skipped =
    vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;
  int extent[6];
  image->GetExtent(extent);
  const vtkIdType columns = extent[1] - extent[0] + 1;
  for (vtkIdType point = 0; point < image->GetNumberOfPoints(); ++point)
  {
    Pulse::Beat(point);
    const double chart = arrays[0].Array->GetComponent(point, 0);
    if (!std::isfinite(chart))
    {
      return FailAt(arrays[0], "not finite", point);
    }
    if (chart < 0.0 || (ghosts && (ghosts->GetValue(point) & skipped)))
    {
      continue;
    }
    Texels::Numbers numbers;
    if (read = ReadNumbers(arrays, point, numbers); !read)
    {
      return read;
    }
    if (numbers.back() > 0.0)
    {
      texels.Cells.push_back({ block, point });
      texels.Add({ number, extent[0] + point % columns, extent[2] + point / columns,
                   static_cast<vtkIdType>(chart) },
        numbers);
    }
  }
  return read;
}

//------------------------------------------------------------------------------
Outcome ReadLocal(vtkDataObject* input, LocalTexels& texels, double& precision)
{
  const std::vector<vtkDataSet*> leaves = Leaves::Get(input);
  const std::vector<vtkIdType> numbers = Leaves::GetNumbers(input);
  for (std::size_t block = 0; block < leaves.size(); ++block)
  {
    auto* image = vtkImageData::SafeDownCast(leaves[block]);
    if (!image)
    {
      return Outcome::Failed("The input has texel images, and blocks that are none: give either "
                             "images or surfaces.");
    }
    if (image->GetNumberOfPoints() > 0)
    {
      if (Outcome read =
            ReadImage(image, static_cast<int>(block), numbers[block], texels, precision);
          !read)
      {
        return read;
      }
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
/// The texels of all ranks, each of them once.
class TexelGrid
{
public:
  /// Rank r has [starts[r], starts[r + 1]) of `texels`, which must outlive this.
  TexelGrid(const Texels& texels, const std::vector<vtkIdType>& starts)
    : All(texels), Starts(starts)
  {
    this->FindAtlases();
    for (int rank = 0; rank < this->GetNumberOfRanks(); ++rank)
    {
      this->FirstOfRank.push_back(static_cast<vtkIdType>(this->Unique.size()));
      for (vtkIdType texel = starts[rank]; texel < starts[rank + 1]; ++texel)
      {
        Pulse::Beat(texel);
        const Key key = this->GetKey(texel, rank);
        if (this->Known.emplace(key, static_cast<vtkIdType>(this->Unique.size())).second)
        {
          this->Unique.push_back(texel);
          this->Keys.push_back(key);
        }
      }
    }
    this->FirstOfRank.push_back(static_cast<vtkIdType>(this->Unique.size()));
  }

  /// Texels of this rank that are its own, and those that a rank before has.
  void Divide(const std::vector<LocalCell>& cells, int rank, GatheredPolygons& polygons) const
  {
    polygons.FirstLocal = this->FirstOfRank[rank];
    for (std::size_t k = 0; k < cells.size(); ++k)
    {
      const vtkIdType texel = this->Starts[rank] + static_cast<vtkIdType>(k);
      const vtkIdType polygon = this->Known.at(this->GetKey(texel, rank));
      if (this->Unique[polygon] == texel)
      {
        polygons.LocalCells.push_back(cells[k]);
      }
      else
      {
        polygons.CopiedCells.push_back({ cells[k], polygon });
      }
    }
  }

  void AddPolygons(GatheredPolygons& polygons) const
  {
    const auto count = static_cast<vtkIdType>(this->Unique.size());
    polygons.Counts.assign(count, 4);
    BitHash topology;
    for (const Key& key : this->Keys)
    {
      topology.AddAll(key);
    }
    polygons.Topology = topology.Get();
    polygons.Coordinates.reserve(12 * count);
    for (vtkIdType polygon = 0; polygon < count; ++polygon)
    {
      Pulse::Beat(polygon);
      const Texels::Numbers numbers = this->All.GetNumbers(this->Unique[polygon]);
      const Vector position(&numbers[0]);
      const Vector normal(&numbers[3]);
      const Vector steps[2] = { this->GetStep(polygon, 0), this->GetStep(polygon, 1) };
      const TexelShape shape(position, normal, numbers[6], steps);
      for (int corner = 0; corner < 4; ++corner)
      {
        const Vector place = shape.GetCorner(corner);
        polygons.Coordinates.insert(polygons.Coordinates.end(), place.data(), place.data() + 3);
      }
    }
  }

  /// Codes of the centres of texels; only their order and their common beginnings count.
  void AddCodes(GatheredPolygons& polygons) const
  {
    vtkIdType low = 0;
    vtkIdType high = 0;
    for (const Key& key : this->Keys)
    {
      low = std::min({ low, key[2], key[3] });
      high = std::max({ high, key[2], key[3] });
    }
    double side = 1.0;
    while (side <= static_cast<double>(high - low))
    {
      side *= 2.0;
    }
    const auto place = [&](vtkIdType index)
    { return (static_cast<double>(index - low) + 0.5) / side; };
    for (const Key& key : this->Keys)
    {
      polygons.Codes.push_back(PatchTree::GetCode(place(key[2]), place(key[3])));
      polygons.Surfaces.push_back(key[0] * this->GetNumberOfRanks() + key[1]);
    }
  }

private:
  /// Which image, and whose (0 where all have the same), column, row.
  using Key = std::array<vtkIdType, 4>;
  struct KeyHash
  {
    std::size_t operator()(const Key& key) const
    {
      std::uint64_t hash = 0;
      for (const vtkIdType part : key)
      {
        hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15ull;
        hash ^= hash >> 32;
      }
      return static_cast<std::size_t>(hash);
    }
  };

  int GetNumberOfRanks() const { return static_cast<int>(this->Starts.size()) - 1; }

  Key GetKey(vtkIdType texel, int rank) const
  {
    const Texels::Place place = this->All.GetPlace(texel);
    return { place[0], this->Divided.count(place[0]) > 0 ? rank : 0, place[1], place[2] };
  }

  /// Which images are others on other ranks.
  void FindAtlases()
  {
    std::unordered_map<Key, vtkIdType, KeyHash> known;
    for (vtkIdType texel = this->GetNumberOfRanks() > 1 ? 0 : this->Starts.back();
         texel < this->Starts.back(); ++texel)
    {
      Pulse::Beat(texel);
      const auto found = known.emplace(this->GetKey(texel, 0), texel);
      if (!found.second && !this->All.AreEqual(found.first->second, texel))
      {
        this->Divided.insert(this->All.GetPlace(texel)[0]);
      }
    }
  }

  /// The texel beside one, where there is one of the same chart; else the texel itself.
  vtkIdType GetNeighbour(vtkIdType polygon, int axis, int step) const
  {
    Key key = this->Keys[polygon];
    key[2 + axis] += step;
    const auto found = this->Known.find(key);
    const bool isOfChart = found != this->Known.end() &&
      this->All.GetPlace(this->Unique[found->second])[3] ==
        this->All.GetPlace(this->Unique[polygon])[3];
    return isOfChart ? found->second : polygon;
  }

  Vector GetStep(vtkIdType polygon, int axis) const
  {
    const vtkIdType before = this->GetNeighbour(polygon, axis, -1);
    const vtkIdType after = this->GetNeighbour(polygon, axis, 1);
    const int steps = (before != polygon ? 1 : 0) + (after != polygon ? 1 : 0);
    return steps == 0 ? Vector(Vector::Zero())
                      : Vector((this->All.GetPosition(this->Unique[after]) -
                                 this->All.GetPosition(this->Unique[before])) /
                          steps);
  }

  const Texels& All;
  const std::vector<vtkIdType>& Starts;
  std::set<vtkIdType> Divided; ///< images that are others on other ranks
  std::unordered_map<Key, vtkIdType, KeyHash> Known;
  std::vector<vtkIdType> FirstOfRank;
  ///@{ Of each polygon: the first texel that it is, and where.
  std::vector<vtkIdType> Unique;
  std::vector<Key> Keys;
  ///@}
};
} // namespace

//------------------------------------------------------------------------------
bool TexelGathering::HasImages(vtkDataObject* input, const Ranks& ranks)
{
  const std::vector<vtkDataSet*> leaves = Leaves::Get(input);
  const bool isMine = std::any_of(leaves.begin(), leaves.end(),
    [](vtkDataSet* leaf) { return vtkImageData::SafeDownCast(leaf) != nullptr; });
  return ranks.GetLargest(isMine ? 1 : 0) != 0;
}

//------------------------------------------------------------------------------
Outcome TexelGathering::Gather(vtkDataObject* input, const Ranks& ranks, bool withAtlas,
  GatheredPolygons& polygons)
{
  LocalTexels mine;
  if (Outcome read = ranks.Agree(ReadLocal(input, mine, polygons.Precision)); !read)
  {
    return read;
  }
  std::vector<vtkIdType> starts =
    ranks.Gather(std::vector<vtkIdType>{ static_cast<vtkIdType>(mine.GetNumber()) });
  starts.insert(starts.begin(), 0);
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  Texels all;
  all.Places = ranks.Gather(mine.Places);
  all.Values = ranks.Gather(mine.Values);
  polygons.Precision = ranks.GetLargest(polygons.Precision);
  polygons.AreTexels = true;
  const TexelGrid grid(all, starts);
  grid.Divide(mine.Cells, ranks.GetMine(), polygons);
  grid.AddPolygons(polygons);
  if (withAtlas)
  {
    grid.AddCodes(polygons);
  }
  return Outcome::Done();
}
} // namespace LightTransport
