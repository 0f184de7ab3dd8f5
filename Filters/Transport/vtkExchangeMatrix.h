// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkExchangeMatrix
 * @brief the symmetric exchange G between all pairs of patches, stored once per pair
 *
 * G_ij is what links patch i and patch j in both directions: for radiosity G_ij = A_i F_ij = A_j
 * F_ji; for subsurface scattering the diffuse reflectance profile integrated over both patches.
 * Reciprocity is therefore a property of the storage, not of the code that fills it.
 *
 * There are one or more *kernels*: one where all bands share the exchange (radiosity), one per band
 * where each band has its own (scattering).
 *
 * The matrix is cut into square tiles of TileSize x TileSize; only tiles on and above the diagonal
 * exist. Diagonal tiles are stored in full (both triangles). A tile holds its kernels one after
 * another, each row by row, single precision; the padding of the last row and column of tiles is
 * zero. With several *parts* (the ranks of a parallel run) each part holds every NumberOfParts-th
 * tile and the sum over the parts is the matrix.
 *
 * Areas are in the units that the filler chose; the patch areas that belong to it are kept beside
 * it, so that G/A has no unit.
 */
#ifndef vtkExchangeMatrix_h
#define vtkExchangeMatrix_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkObject.h"

#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkExchangeMatrix : public vtkObject
{
public:
  static vtkExchangeMatrix* New();
  vtkTypeMacro(vtkExchangeMatrix, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Rows and columns of one tile.
  static constexpr int TileSize = 256;

  struct Tile
  {
    vtkIdType Row;    ///< first patch of the tile's rows divided by TileSize
    vtkIdType Column; ///< likewise for the columns; Row <= Column
    float* Values;    ///< NumberOfKernels blocks of TileSize x TileSize values, row by row
  };

  /**
   * Make a zero matrix for the given areas (one per patch, any unit). Returns false when the memory
   * is not there; the matrix is then empty. GetEstimatedBytes tells beforehand.
   */
  bool Allocate(const std::vector<double>& areas, int numberOfKernels, int part = 0,
    int numberOfParts = 1);

  /// Bytes that the tiles of one part take.
  static double GetEstimatedBytes(vtkIdType numberOfPatches, int numberOfKernels,
    int numberOfParts = 1);

  vtkIdType GetNumberOfPatches() const { return static_cast<vtkIdType>(this->Areas.size()); }
  int GetNumberOfKernels() const { return this->NumberOfKernels; }
  int GetNumberOfParts() const { return this->NumberOfParts; }
  /// Tiles along one side of the matrix.
  vtkIdType GetNumberOfTileRows() const;
  const std::vector<double>& GetAreas() const { return this->Areas; }

  ///@{
  /// The tiles of this part, in row-major order of the upper triangle.
  std::vector<Tile>& GetTiles() { return this->Tiles; }
  const std::vector<Tile>& GetTiles() const { return this->Tiles; }
  ///@}

  /// Row-major index of tile (row, column), row <= column, among all tiles of the upper triangle.
  vtkIdType GetTileIndex(vtkIdType row, vtkIdType column) const;

  /// G_ij of one kernel; 0 where another part holds the tile.
  double GetValue(vtkIdType i, vtkIdType j, int kernel = 0) const;

  /// Store G_ij = G_ji. The tile must belong to this part. Threads may fill different tiles at the
  /// same time.
  static void SetValue(Tile& tile, int row, int column, int kernel, double value);

  /// Bytes held in tiles.
  double GetNumberOfBytes() const;

protected:
  vtkExchangeMatrix();
  ~vtkExchangeMatrix() override;

private:
  vtkExchangeMatrix(const vtkExchangeMatrix&) = delete;
  void operator=(const vtkExchangeMatrix&) = delete;

  std::vector<double> Areas;
  std::vector<Tile> Tiles;
  struct FreeBlock
  {
    void operator()(float* block) const;
  };
  std::unique_ptr<float, FreeBlock> Storage; ///< all tiles, one after another
  int NumberOfKernels = 0;
  int Part = 0;
  int NumberOfParts = 1;
};

#endif
