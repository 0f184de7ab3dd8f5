// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The product with a vtkExchangeMatrix, expanded to full rows. Two passes: partial sums over ranges
 * of columns, so that a GPU has enough to do at once, then their compensated sum. Where the matrix
 * is larger than the largest texture, in either direction, it is cut into tiles.
 */
#ifndef DenseProductGL_h
#define DenseProductGL_h

#include "Products/ProductGL.h"

class vtkExchangeMatrix;

namespace LightTransport
{
class DenseProductGL : public ProductGL
{
public:
  DenseProductGL(FloatTextures& engine, const Layout& layout);

  Outcome Initialize(vtkExchangeMatrix* exchange, const Pause& pause);
  Outcome Draw(Group& target, const Group& source) override;
  int GetNumberOfLinkTextures() const override;

private:
  /// A piece of the matrix: all rows from FirstRow that fit, and texels (columns, or four columns
  /// each) from FirstTexel.
  struct MatrixTile
  {
    int FirstRow;
    int Rows;
    int FirstTexel;
    int Texels;
    Group Textures;
  };

  void ChooseSizes();
  Outcome Allocate(const Pause& pause);
  void Upload(vtkExchangeMatrix* exchange, const Pause& pause);
  void UploadBlock(int rowBlock, int columnBlock, int group, const float* texels);
  std::string GetDefines(int outputs) const;
  Outcome DrawPartialProducts(const Group& source, int across);
  Outcome DrawSumOfParts(const Group& target, const Group* previous);

  bool SharedKernel = true;
  int Kernels = 1;
  int MatrixGroups = 1;
  int ColumnsPerTexel = 4;
  int Splits = 0;
  /// Rows of the matrix that a fragment multiplies: 4, 2 or 1.
  int RowsPerFragment = 1;
  int TexelsPerSplit = 0;
  /// Row by row; the tiles of one column range lie TilesAcross apart.
  std::vector<MatrixTile> Tiles;
  int TilesAcross = 0;
  Group Parts;
  Group Spare; ///< only with several tiles across
};
} // namespace LightTransport

#endif
