// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Points that stand for many: the code book of a vector quantiser (Y. Linde, A. Buzo, R. M. Gray,
 * IEEE Transactions on Communications 28, 84, 1980), trained so that the sum of weighted squared
 * distances is small. The same samples in the same order give the same book.
 */
#ifndef LinkCodeBook_h
#define LinkCodeBook_h

#include <cstddef>
#include <vector>

namespace LightTransport
{
class LinkCodeBook
{
public:
  /// At most `entries` points of so many coordinates. Sample s is points[s * dimensions + ...].
  LinkCodeBook(int dimensions, int entries, const std::vector<float>& points,
    const std::vector<double>& weights);

  int GetNumberOfEntries() const { return this->Entries; }
  float Get(int entry, int dimension) const
  {
    return this->Book[static_cast<std::size_t>(dimension) * this->Entries + entry];
  }

  /// The nearest entry; `distances` holds one number for each entry, anything before and after.
  int Find(const float* point, float* distances) const;

private:
  void Spread(const std::vector<float>& points, const std::vector<double>& weights);
  void Train(const std::vector<float>& points, const std::vector<double>& weights);
  void Center(const std::vector<float>& points, const std::vector<double>& weights);
  void MoveIdle(const std::vector<float>& points, const std::vector<double>& weights);

  int Dimensions;
  int Entries;
  std::vector<float> Book; ///< coordinate after coordinate
  ///@{ Of each sample.
  std::vector<int> Nearest;
  std::vector<float> Errors; ///< squared distance
  ///@}
};
} // namespace LightTransport

#endif
