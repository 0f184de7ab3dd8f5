// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkExchangeHierarchy
 * @brief the exchange as links between clusters of patches, as plain tables
 *
 * The *slots* are the nodes of a cluster tree, breadth first (0 is the root, each level is a range,
 * children come after their parents and next to each other), followed by the patches: slot =
 * number of nodes + patch. A link of value K between the slots I and J stands for G_ij = w_i K w_j
 * for all patches i below I and j below J, where w is the weight of a patch (its area, unless rows
 * have been closed). So y = G x is three steps, each linear in what is stored:
 *
 *   - up: X_patch = w x, X_node = sum of X over its children;
 *   - gather: Y_I = sum over the links of I of K X_J;
 *   - down: Y_child += Y_parent, y = w Y_patch.
 *
 * Links join slots of any two levels; between two patches they are the matrix itself. Each is
 * stored in the rows of both its ends (once where both are the same), so that rows can be gathered
 * independently, on any device. Uniform links, adaptive links and hierarchical radiosity (Hanrahan,
 * Salzman and Aupperle 1991) differ in which links there are.
 *
 * Where links are applied once and not solved for, each receiver may choose whom it hears, and as
 * how large a cluster: SetRows takes links that serve one direction. What is stored is then no
 * longer symmetric, though what it stands for is, within the error of the links.
 *
 * Where each link has to take few bytes, its values may be an entry of a code book, and its slot an
 * entry of a short list that neighbouring rows share (CodedRows): two bytes a link, one where all
 * these rows have it. Links in either form add up.
 *
 * A tree may come from anywhere (PatchTree, or the quadtree of an atlas).
 */
#ifndef vtkExchangeHierarchy_h
#define vtkExchangeHierarchy_h

#include "vtkExchange.h"

#include <cstdint> // for std::int64_t
#include <utility> // for std::pair

class vtkMultiProcessController;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkExchangeHierarchy : public vtkExchange
{
public:
  static vtkExchangeHierarchy* New();
  vtkTypeMacro(vtkExchangeHierarchy, vtkExchange);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// A node of the tree: its children are the slots [First, Last), all nodes or all patches.
  struct Node
  {
    int First;
    int Last;
  };

  /// A link between two slots, given once for both directions.
  struct Link
  {
    int I;
    int J;
    float Value;
  };

  /**
   * Links in few bytes. A tile is a range of rows with the slots that they are linked with, at most
   * BookSize of them; the first of these slots, Common of them, are linked with every row of the
   * tile. Each row of each tile is a piece: the codes of the common slots, then the place in the
   * tile's slots, and the code, of every other link. Rows with more slots have several tiles.
   *
   * Numbers are written seven bits to a byte, lowest first, the eighth says that more follow: how
   * many links a piece has beside the common ones, before it, and slots, which ascend in the common
   * part and in the rest, as steps from the one before.
   */
  struct CodedRows
  {
    static constexpr int BookSize = 256;
    /// Common is a multiple of this: whole words for a device that reads them.
    static constexpr int CommonStep = 16;

    struct Tile
    {
      int FirstRow; ///< slots [first, last) that receive
      int LastRow;
      int NumberOfSlots; ///< that send
      int Common;
      std::int64_t FirstSlot; ///< in Slots
      std::int64_t FirstByte; ///< in Bytes
    };

    /// Values of entry e: Book[e * kernels + kernel]; of entry 0 they are 0.
    std::vector<float> Book;
    std::vector<Tile> Tiles; ///< those of the same rows one after the other
    std::vector<std::uint8_t> Slots;
    std::vector<std::uint8_t> Bytes;
    std::int64_t NumberOfLinks = 0;

    static void WriteNumber(std::uint32_t number, std::vector<std::uint8_t>& bytes)
    {
      for (; number > 127; number >>= 7)
      {
        bytes.push_back(static_cast<std::uint8_t>(number | 128));
      }
      bytes.push_back(static_cast<std::uint8_t>(number));
    }
    static std::uint32_t ReadNumber(const std::uint8_t*& bytes)
    {
      std::uint32_t number = *bytes & 127;
      for (int shift = 7; (*bytes++ & 128) != 0; shift += 7)
      {
        number |= static_cast<std::uint32_t>(*bytes & 127) << shift;
      }
      return number;
    }

    /// Whether a tile has the rows of the one before.
    bool Continues(std::size_t tile) const
    {
      return tile > 0 && this->Tiles[tile].FirstRow == this->Tiles[tile - 1].FirstRow;
    }

    /// The end of Slots becomes a tile's slots; `common` as above.
    void WriteSlots(const int* begin, const int* end, int common)
    {
      for (const int* slot = begin; slot != end; ++slot)
      {
        const bool isFirst = slot == begin || slot == begin + common;
        WriteNumber(static_cast<std::uint32_t>(isFirst ? *slot : *slot - slot[-1]), this->Slots);
      }
    }

    /// visitor(place in the tile's slots, slot) for each of them.
    template <typename Visitor>
    void VisitSlots(const Tile& tile, Visitor&& visitor) const
    {
      const std::uint8_t* bytes = this->Slots.data() + tile.FirstSlot;
      int slot = 0;
      for (int place = 0; place < tile.NumberOfSlots; ++place)
      {
        slot = (place == tile.Common ? 0 : slot) + static_cast<int>(ReadNumber(bytes));
        visitor(place, slot);
      }
    }

    /// visitor(row's slot, its bytes, pairs) for each piece of a tile.
    template <typename Visitor>
    void VisitPieces(const Tile& tile, Visitor&& visitor) const
    {
      const std::uint8_t* bytes = this->Bytes.data() + tile.FirstByte;
      for (int row = tile.FirstRow; row < tile.LastRow; ++row)
      {
        const int pairs = static_cast<int>(ReadNumber(bytes));
        visitor(row, bytes, pairs);
        bytes += tile.Common + 2 * static_cast<std::int64_t>(pairs);
      }
    }

    /// visitor(place in the tile's slots, code) for each link of a piece.
    template <typename Visitor>
    static void VisitLinks(const Tile& tile, const std::uint8_t* bytes, int pairs,
      Visitor&& visitor)
    {
      for (int place = 0; place < tile.Common; ++place)
      {
        visitor(place, bytes[place]);
      }
      bytes += tile.Common;
      for (int pair = 0; pair < pairs; ++pair)
      {
        visitor(bytes[2 * pair], bytes[2 * pair + 1]);
      }
    }
  };

  /**
   * The tree, without links. Every slot but the root must be the child of one node;
   * the children of a node must come after it and be on the level below it or patches. Returns
   * false where that does not hold; the hierarchy is then empty.
   */
  bool SetTree(const std::vector<double>& areas, const std::vector<Node>& nodes, int part = 0,
    int numberOfParts = 1, int numberOfKernels = 1);

  /// Replace the links of this part, of one kernel. Returns false when the memory for them is not
  /// there; there are then none.
  bool SetLinks(const std::vector<Link>& links);

  /// Replace the links of this part by rows as they are (GetOffsets and so on), each link serving
  /// one direction, or with `isSymmetric` being there twice, in the rows of both its ends. Returns
  /// false, and there are no links, where the tables do not fit the tree.
  bool SetRows(std::vector<std::int64_t> offsets, std::vector<int> columns,
    std::vector<float> values, bool isSymmetric = false);

  /// Rows beside those of SetRows, which drops them. Returns false, and nothing changes, where they
  /// do not fit the tree.
  bool SetCodedRows(CodedRows rows);

  /**
   * Turn rows, SetRows', into coded ones. The code book is trained on them; links that it misses by
   * more than `tolerance`, where that is above 0, stay rows: of each of the others the error is at
   * most the tolerance times the mean of the link itself and of all links of its row, each times
   * the area of its source. So in even light no row's sum is off by more than the tolerance.
   * Several parts train the same book, with the controller of the ranks that hold them; each must
   * have whole rows. A second time nothing changes, until there are other rows. Returns the error
   * that is left: sqrt(sum A_I (A_J dK)^2 / sum A_I (A_J K)^2) over all links, of the worst kernel.
   */
  double CompressRows(double tolerance, vtkMultiProcessController* controller = nullptr);

  /// Bytes that SetLinks takes for a number of links.
  static double GetEstimatedBytes(double numberOfLinks);
  /// Bytes that SetRows takes.
  static double GetEstimatedBytesOfRows(double numberOfLinks, int numberOfKernels);

  int GetNumberOfNodes() const { return static_cast<int>(this->Nodes.size()); }
  int GetNumberOfSlots() const
  {
    return this->GetNumberOfNodes() + static_cast<int>(this->GetNumberOfPatches());
  }
  const std::vector<Node>& GetNodes() const { return this->Nodes; }
  /// Nodes of level l are [levels[l], levels[l + 1]).
  const std::vector<int>& GetLevels() const { return this->Levels; }
  /// Of each slot; -1 for the root.
  const std::vector<int>& GetParents() const { return this->Parents; }

  /// Links of this part, each counted once.
  vtkIdType GetNumberOfLinks() const { return this->NumberOfLinks; }
  /// Whether each link is there in both directions.
  bool IsSymmetric() const { return this->Symmetric; }
  ///@{ Row r of the table: slots columns[k] and values[k * kernels + kernel] for offsets[r] <= k <
  /// offsets[r + 1]. No offsets where all rows are coded.
  const std::vector<std::int64_t>& GetOffsets() const { return this->Offsets; }
  const std::vector<int>& GetColumns() const { return this->Columns; }
  const std::vector<float>& GetValues() const { return this->Values; }
  ///@}
  /// Of a row: the first of its links, and that after the last.
  std::pair<std::int64_t, std::int64_t> GetRow(int slot) const
  {
    return this->Offsets.empty() ? std::pair<std::int64_t, std::int64_t>()
                                 : std::make_pair(this->Offsets[slot], this->Offsets[slot + 1]);
  }
  /// Without tiles unless SetCodedRows has been called.
  const CodedRows& GetCodedRows() const { return this->Coded; }

  /// Bytes of the links alone.
  double GetNumberOfLinkBytes() const;

  /// G_ij of this part: what the links between the two patches and all nodes above them sum to.
  double GetValue(vtkIdType i, vtkIdType j, int kernel = 0) const override;

  ///@{ Weights of the patches; SetTree makes them the areas.
  const std::vector<double>& GetWeights() const { return this->Weights; }
  void SetWeights(const std::vector<double>& weights);
  ///@}

  double GetNumberOfBytes() const override;

protected:
  vtkExchangeHierarchy();
  ~vtkExchangeHierarchy() override;

private:
  vtkExchangeHierarchy(const vtkExchangeHierarchy&) = delete;
  void operator=(const vtkExchangeHierarchy&) = delete;

  bool FindParents();
  vtkIdType CountLoops() const;
  double GetCodedValue(const std::vector<int>& rows, const std::vector<int>& others,
    int kernel) const;
  void Clear();
  void ClearLinks();

  std::vector<Node> Nodes;
  std::vector<int> Levels;
  std::vector<int> Parents;
  std::vector<double> Weights;
  std::vector<std::int64_t> Offsets;
  std::vector<int> Columns;
  std::vector<float> Values;
  CodedRows Coded;
  vtkIdType NumberOfLinks = 0;
  bool Symmetric = true;
};

#endif
