// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Products/DenseProductGL.h"

#include "Context/OpenGLFunctions.h"
#include "vtkLightTransportProductsDensePartsFS.h"
#include "vtkLightTransportProductsDenseSumPartsFS.h"

#include "vtkExchangeMatrix.h"
#include "vtkShaderProgram.h"

#include <algorithm>

namespace LightTransport
{
namespace
{
constexpr int TileSize = vtkExchangeMatrix::TileSize;
/// Rows times ranges of columns that keep a large GPU busy.
constexpr vtkIdType WantedFragments = vtkIdType(1) << 18;
/// Below this a range of columns is not worth a fragment.
constexpr int MinimumTexelsPerSplit = 8;
/// Textures that one draw can write everywhere.
constexpr int MaximumOutputs = 8;

//------------------------------------------------------------------------------
// One kernel, or four of them side by side, of a tile of the matrix or of its transpose.
void CopyTile(const vtkExchangeMatrix::Tile& tile, bool transposed, int firstKernel, int kernels,
  int lanes, float* texels)
{
  const int rowStep = transposed ? 1 : TileSize;
  const int columnStep = transposed ? TileSize : 1;
  for (int lane = 0; lane < std::min(lanes, kernels - firstKernel); ++lane)
  {
    const float* values =
      tile.Values + static_cast<std::size_t>(firstKernel + lane) * TileSize * TileSize;
    for (int i = 0; i < TileSize; ++i)
    {
      for (int j = 0; j < TileSize; ++j)
      {
        texels[static_cast<std::size_t>((i * TileSize + j) * lanes + lane)] =
          values[i * rowStep + j * columnStep];
      }
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
DenseProductGL::DenseProductGL(FloatTextures& engine, const Layout& layout)
  : ProductGL(engine, layout)
{
}

//------------------------------------------------------------------------------
Outcome DenseProductGL::Initialize(vtkExchangeMatrix* exchange, const Pause& pause)
{
  this->SharedKernel = exchange->GetNumberOfKernels() == 1;
  this->Kernels = exchange->GetNumberOfKernels();
  this->MatrixGroups = FloatTextures::DivideUp(this->Kernels, 4);
  this->ColumnsPerTexel = this->SharedKernel ? 4 : 1;
  this->ChooseSizes();
  double texels = 0.0;
  for (const MatrixTile& tile : this->Tiles)
  {
    texels += static_cast<double>(tile.Rows) * tile.Texels;
  }
  const double bytes = texels * this->MatrixGroups * FloatTextures::BytesPerTexel;
  if (Outcome enough = this->CheckMemory(bytes); !enough)
  {
    return enough;
  }
  if (!this->Allocate(pause))
  {
    return this->RefuseMemory();
  }
  this->Upload(exchange, pause);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void DenseProductGL::ChooseSizes()
{
  const Layout& vectors = this->Vectors;
  const int texels = FloatTextures::DivideUp(vectors.Patches, this->ColumnsPerTexel);
  const int tileTexels = std::min(texels, vectors.MaximumSize);
  this->TilesAcross = FloatTextures::DivideUp(texels, tileTexels);
  for (this->RowsPerFragment = 4;
       this->RowsPerFragment > 1 && this->RowsPerFragment * vectors.Groups > MaximumOutputs;)
  {
    this->RowsPerFragment /= 2;
  }
  const int most = std::max(std::min(FloatTextures::DivideUp(tileTexels, MinimumTexelsPerSplit),
                              vectors.MaximumSize / vectors.Height),
    1);
  this->Splits = std::min(
    FloatTextures::DivideUp(WantedFragments * this->RowsPerFragment, vectors.Patches), most);
  this->TexelsPerSplit = FloatTextures::DivideUp(tileTexels, this->Splits);

  // Whole lines of the vector's textures, so that the rows of a tile are a rectangle of them.
  const vtkIdType rowsThatFit =
    std::min<vtkIdType>(vectors.MaximumSize, FloatTextures::MaximumTexels / tileTexels);
  const int tileRows =
    vectors.Width * static_cast<int>(std::max<vtkIdType>(rowsThatFit / vectors.Width, 1));
  for (int row = 0; row < vectors.Patches; row += tileRows)
  {
    for (int texel = 0; texel < texels; texel += tileTexels)
    {
      this->Tiles.push_back({ row, std::min(tileRows, vectors.Patches - row), texel,
        std::min(tileTexels, texels - texel), {} });
    }
  }
}

//------------------------------------------------------------------------------
Outcome DenseProductGL::Allocate(const Pause& pause)
{
  for (MatrixTile& tile : this->Tiles)
  {
    if (Outcome allocated = this->Engine.Allocate(tile.Textures,
          static_cast<std::size_t>(this->MatrixGroups), tile.Texels, tile.Rows);
        !allocated)
    {
      return allocated;
    }
    // What is not uploaded is zero.
    this->Engine.Clear(tile.Textures);
    pause();
  }
  const Layout& vectors = this->Vectors;
  Outcome allocated = this->Engine.Allocate(this->Parts,
    static_cast<std::size_t>(vectors.Groups * this->RowsPerFragment),
    vectors.Width / this->RowsPerFragment, vectors.Height * this->Splits);
  return allocated && this->TilesAcross > 1
    ? this->Engine.Allocate(this->Spare, static_cast<std::size_t>(vectors.Groups), vectors.Width,
        vectors.Height)
    : allocated;
}

//------------------------------------------------------------------------------
void DenseProductGL::Upload(vtkExchangeMatrix* exchange, const Pause& pause)
{
  const int lanes = this->SharedKernel ? 1 : 4;
  const int kernels = exchange->GetNumberOfKernels();
  std::vector<float> texels(static_cast<std::size_t>(lanes) * TileSize * TileSize);
  for (const vtkExchangeMatrix::Tile& tile : exchange->GetTiles())
  {
    const int row = static_cast<int>(tile.Row);
    const int column = static_cast<int>(tile.Column);
    for (int group = 0; tile.Values && group < this->MatrixGroups; ++group)
    {
      CopyTile(tile, false, 4 * group, kernels, lanes, texels.data());
      this->UploadBlock(row, column, group, texels.data());
      if (row != column)
      {
        CopyTile(tile, true, 4 * group, kernels, lanes, texels.data());
        this->UploadBlock(column, row, group, texels.data());
      }
    }
    if (row == column)
    {
      pause();
    }
  }
}

//------------------------------------------------------------------------------
void DenseProductGL::UploadBlock(int rowBlock, int columnBlock, int group, const float* texels)
{
  const int length = TileSize / this->ColumnsPerTexel;
  const int firstRow = rowBlock * TileSize;
  const int firstTexel = columnBlock * length;
  for (const MatrixTile& tile : this->Tiles)
  {
    const int rowBegin = std::max(firstRow, tile.FirstRow);
    const int rowEnd = std::min(firstRow + TileSize, tile.FirstRow + tile.Rows);
    const int texelBegin = std::max(firstTexel, tile.FirstTexel);
    const int texelEnd = std::min(firstTexel + length, tile.FirstTexel + tile.Texels);
    if (rowBegin < rowEnd && texelBegin < texelEnd)
    {
      const int region[4] = { texelBegin - tile.FirstTexel, rowBegin - tile.FirstRow,
        texelEnd - texelBegin, rowEnd - rowBegin };
      const int start = (rowBegin - firstRow) * length + (texelBegin - firstTexel);
      this->Engine.Upload(tile.Textures[static_cast<std::size_t>(group)], region, length,
        texels + 4 * start);
    }
  }
}

//------------------------------------------------------------------------------
int DenseProductGL::GetNumberOfLinkTextures() const
{
  return static_cast<int>(this->Tiles.size()) * this->MatrixGroups;
}

//------------------------------------------------------------------------------
std::string DenseProductGL::GetDefines(int outputs) const
{
  return this->Vectors.GetDefines(outputs) + "#define MATRIX_GROUPS " +
    std::to_string(this->MatrixGroups) + "\n#define ROWS " + std::to_string(this->RowsPerFragment) +
    "\n#define KERNELS " + std::to_string(this->Kernels) + "\n#define SHARED_KERNEL " +
    (this->SharedKernel ? "1\n" : "0\n");
}

//------------------------------------------------------------------------------
Outcome DenseProductGL::Draw(Group& target, const Group& source)
{
  Outcome drawn = Outcome::Done();
  for (int across = 0; across < this->TilesAcross && drawn; ++across)
  {
    drawn = this->DrawPartialProducts(source, across);
    if (across > 0)
    {
      std::swap(this->Spare, target);
    }
    drawn = drawn ? this->DrawSumOfParts(target, across > 0 ? &this->Spare : nullptr) : drawn;
  }
  return drawn;
}

//------------------------------------------------------------------------------
Outcome DenseProductGL::DrawPartialProducts(const Group& source, int across)
{
  vtkShaderProgram* program = nullptr;
  const std::string defines = this->GetDefines(static_cast<int>(this->Parts.size()));
  if (Outcome used =
        this->Engine.Use(program, "PartialProduct", vtkLightTransportProductsDensePartsFS, defines);
      !used)
  {
    return used;
  }
  const Layout& vectors = this->Vectors;
  program->SetUniformi("splits", this->Splits);
  program->SetUniformi("numberOfRows", vectors.Patches);
  program->SetUniformi("texelsPerSplit", this->TexelsPerSplit);
  for (std::size_t index = static_cast<std::size_t>(across); index < this->Tiles.size();
       index += static_cast<std::size_t>(this->TilesAcross))
  {
    const MatrixTile& tile = this->Tiles[index];
    this->Engine.SetTextures(program, "matrix", tile.Textures);
    this->Engine.SetTextures(program, "vector", source);
    program->SetUniformi("firstRow", tile.FirstRow);
    program->SetUniformi("firstColumn", tile.FirstTexel * this->ColumnsPerTexel);
    program->SetUniformi("numberOfTexels", tile.Texels);
    const int firstLine = tile.FirstRow / vectors.Width * this->Splits;
    const int lines = FloatTextures::DivideUp(tile.Rows, vectors.Width) * this->Splits;
    const int region[4] = { 0, firstLine, vectors.Width / this->RowsPerFragment, lines };
    this->Engine.Draw(this->Parts, region);
    // A bunch of work at a time: a GPU that draws a screen as well is taken away from whoever keeps
    // it for seconds.
    glFlush();
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome DenseProductGL::DrawSumOfParts(const Group& target, const Group* previous)
{
  const std::string accumulate = previous ? "#define ACCUMULATE 1\n" : "#define ACCUMULATE 0\n";
  vtkShaderProgram* program = nullptr;
  if (Outcome used = this->Engine.Use(program, previous ? "AddParts" : "SumParts",
        vtkLightTransportProductsDenseSumPartsFS,
        this->GetDefines(this->Vectors.Groups) + accumulate);
      !used)
  {
    return used;
  }
  this->Engine.SetTextures(program, "parts", this->Parts);
  if (previous)
  {
    this->Engine.SetTextures(program, "previous", *previous);
  }
  program->SetUniformi("splits", this->Splits);
  const int region[4] = { 0, 0, this->Vectors.Width, this->Vectors.Height };
  this->Engine.Draw(target, region);
  return Outcome::Done();
}
} // namespace LightTransport
