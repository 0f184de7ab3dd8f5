// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Turns the rows of a vtkExchangeHierarchy into coded ones (vtkExchangeHierarchy::CodedRows).
 *
 * The code book is trained on the hierarchy's own links. Values K_IJ of a link are vectors of all
 * kernels; those of a profile depend on little more than a distance, so they lie near a curve, and
 * not those of K times an area. Squared errors are weighted as they act on the result in even
 * light: with area I and (area J)^2, each kernel relative to the mean square of its row sums.
 *
 * Error is, of the worst kernel, sqrt(sum area_I (area_J dK)^2 / sum area_I (area_J K)^2) over all
 * links: the relative error of the result (L2) in light that comes from anywhere, where errors are
 * independent of each other. In even light more links add up and the error is smaller.
 *
 * With a tolerance above 0 the links that their entries miss by more than it stay as they were: in
 * each kernel area_J |dK| is then at most the tolerance times the mean of the link's own area_J |K|
 * and that of all links of its row. So in even light no sum of a row is off by more than the
 * tolerance, whatever the signs of the errors. Links that are not finite stay, too.
 */
#ifndef RowCompression_h
#define RowCompression_h

#include "Links/LinkCodeBook.h"
#include "vtkExchangeHierarchy.h"

#include <cstdint>
#include <vector>

namespace LightTransport
{
class Ranks;

class RowCompression
{
public:
  /// Replaces the links of `hierarchy`. Collective: every rank has whole rows, and all train the
  /// same book. Returns the error.
  static double Compress(vtkExchangeHierarchy& hierarchy, double tolerance, const Ranks& ranks);

private:
  using CodedRows = vtkExchangeHierarchy::CodedRows;

  RowCompression(vtkExchangeHierarchy& hierarchy, double tolerance, const Ranks& ranks);

  void SumAreas();
  void MeasureKernels();
  void TrainBook();
  void Code();
  void CodeRow(int row);
  bool IsMissed(std::int64_t link, const double* means) const;
  double GetError() const;
  void CutRows();
  bool AddToTile(int row);
  void CloseTile();
  void WriteTile(int common, int firstPlace, int lastPlace);
  void WritePiece(int row, int common, int firstPlace, int lastPlace);
  void Replace();

  const float* GetValues(std::int64_t link) const
  {
    return this->Hierarchy.GetValues().data() + link * this->Kernels;
  }
  bool IsCoded(std::int64_t link) const { return this->Codes[link] > 0; }

  vtkExchangeHierarchy& Hierarchy;
  const double Tolerance;
  const Ranks& AllRanks;
  const int Kernels;
  const std::vector<std::int64_t>& Offsets;
  const std::vector<int>& Columns;

  std::vector<double> Areas;       ///< of each slot
  std::vector<double> Scales;      ///< of each kernel: what makes its values comparable
  std::vector<std::int16_t> Codes; ///< of each link: entry of the book, 0 for nothing, or Exact
  std::vector<double> Errors;      ///< row by row, kernel by kernel: squared, weighted
  std::vector<double> Sizes;       ///< likewise
  LinkCodeBook Book;
  CodedRows Coded;

  ///@{ The tile that grows.
  int FirstRow = 0;
  int TileRows = 0;
  std::vector<int> TileSlots;
  std::vector<int> TileOf;               ///< of each slot: FirstRow of the tile that has it
  std::vector<int> RowOf;                ///< the last row that has it
  std::vector<int> Uses;                 ///< rows of the tile that have it
  std::vector<int> Places;               ///< in the tile's slots
  std::vector<std::uint8_t> CommonCodes; ///< of a piece
  std::vector<std::uint8_t> PairBytes;   ///< likewise
  ///@}
};
} // namespace LightTransport

#endif
