// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkExchangeMatrix
 * @brief the exchange stored once for each pair of patches
 *
 * The matrix is cut into square tiles of TileSize x TileSize; only tiles on and above the diagonal
 * exist. Diagonal tiles are stored in full (both triangles). A tile holds its kernels one after
 * another, each row by row, single precision; the padding of the last row and column of tiles is
 * zero. With several *parts* (the ranks of a parallel run) each part holds every NumberOfParts-th
 * tile and the sum over the parts is the matrix.
 *
 * A tile without storage is zero: patches that are numbered by place see each other in blocks, and
 * the blocks that do not are not worth their memory. Allocate gives storage to all tiles,
 * AllocateSparse to none; AllocateTile and ReleaseTile change one.
 */
#ifndef vtkExchangeMatrix_h
#define vtkExchangeMatrix_h

#include "vtkExchange.h"

#include <memory> // for std::unique_ptr
#include <mutex>  // for std::mutex
#include <vector> // for std::vector

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkExchangeMatrix : public vtkExchange
{
public:
  static vtkExchangeMatrix* New();
  vtkTypeMacro(vtkExchangeMatrix, vtkExchange);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Rows and columns of one tile.
  static constexpr int TileSize = 256;

  struct Tile
  {
    vtkIdType Row;    ///< first patch of the tile's rows divided by TileSize
    vtkIdType Column; ///< likewise for the columns; Row <= Column
    float* Values;    ///< NumberOfKernels blocks of TileSize x TileSize values, row by row;
                      ///< nullptr where all are zero and none is stored
  };

  /**
   * Make a zero matrix for the given areas (one per patch, any unit). Returns false when the memory
   * is not there; the matrix is then empty. GetEstimatedBytes tells beforehand.
   */
  bool Allocate(const std::vector<double>& areas, int numberOfKernels, int part = 0,
    int numberOfParts = 1);

  /// Likewise with no tile stored: a zero matrix that takes next to no memory.
  void AllocateSparse(const std::vector<double>& areas, int numberOfKernels, int part = 0,
    int numberOfParts = 1);

  ///@{
  /**
   * Storage for one tile of this part, filled with zeros; a tile that has storage keeps it and its
   * values. Returns false when the memory is not there. ReleaseTile makes a tile zero again; its
   * storage serves the next AllocateTile. Threads may call both at the same time for different
   * tiles.
   */
  bool AllocateTile(Tile& tile);
  void ReleaseTile(Tile& tile);
  ///@}

  /// Bytes that the tiles of one part take when all of them are stored.
  static double GetEstimatedBytes(vtkIdType numberOfPatches, int numberOfKernels,
    int numberOfParts = 1);

  /// Bytes that one part takes with `numberOfTiles` tiles stored: they and the list of all tiles.
  static double GetEstimatedSparseBytes(vtkIdType numberOfPatches, int numberOfKernels,
    vtkIdType numberOfTiles, int numberOfParts = 1);

  /// Tiles along one side of the matrix.
  vtkIdType GetNumberOfTileRows() const;

  ///@{
  /// The tiles of this part, in row-major order of the upper triangle.
  std::vector<Tile>& GetTiles() { return this->Tiles; }
  const std::vector<Tile>& GetTiles() const { return this->Tiles; }
  ///@}

  /// Row-major index of tile (row, column), row <= column, among all tiles of the upper triangle.
  vtkIdType GetTileIndex(vtkIdType row, vtkIdType column) const;

  /// G_ij of one kernel; 0 where the tile is not stored or another part holds it.
  double GetValue(vtkIdType i, vtkIdType j, int kernel = 0) const override;

  /// Store G_ij = G_ji. The tile must belong to this part and be stored. Threads may fill different
  /// tiles at the same time.
  static void SetValue(Tile& tile, int row, int column, int kernel, double value);

  ///@{
  /**
   * What is added to the diagonal, one value per patch, in double precision: what rows that must
   * keep an exact sum have lost in the rounding of their entries (about 1e-7 of the area, either
   * sign). None by default. For matrices of one kernel; of several parts each adds what is on its
   * own tiles. Operators in single precision leave it out.
   */
  void SetRemainders(const std::vector<double>& remainders);
  const std::vector<double>& GetRemainders() const { return this->Remainders; }
  ///@}

  ///@{
  /// Tiles of this part that are stored, and their bytes. Not while threads allocate or release.
  vtkIdType GetNumberOfStoredTiles() const;
  double GetNumberOfBytes() const override;
  ///@}

protected:
  vtkExchangeMatrix();
  ~vtkExchangeMatrix() override;

private:
  vtkExchangeMatrix(const vtkExchangeMatrix&) = delete;
  void operator=(const vtkExchangeMatrix&) = delete;

  struct FreeChunk
  {
    void operator()(float* chunk) const;
  };

  bool AddChunk(vtkIdType numberOfTiles);

  std::vector<Tile> Tiles;
  std::vector<double> Remainders;
  /// Memory is had in chunks that many tiles are cut from.
  std::vector<std::unique_ptr<float, FreeChunk>> Chunks;
  std::vector<float*> FreeTiles; ///< cut but not in use, the next one last
  vtkIdType TilesOfNextChunk = 0;
  std::mutex StorageMutex;
};

#endif
