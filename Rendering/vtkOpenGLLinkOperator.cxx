// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLLinkOperator.h"

#include "vtkFloatTextures.h"
#include "vtkFloatTexturesCombineFS.h"
#include "vtkFloatTexturesPartialProductFS.h"
#include "vtkFloatTexturesReduceFS.h"
#include "vtkFloatTexturesScaleFS.h"
#include "vtkFloatTexturesSumPartsFS.h"
#include "vtkLightTransportOpenGL.h"

#include "vtkExchangeMatrix.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <cmath>

// Registers this class with VTK's object factory whenever the library is loaded, also where nobody
// calls the module's own initialisation, as in a ParaView plugin.
VTK_MODULE_INIT(vtkLightTransportRendering);

vtkStandardNewMacro(vtkOpenGLLinkOperator);

namespace
{
using Group = vtkFloatTextures::Group;

constexpr int TileSize = vtkExchangeMatrix::TileSize;
/// Block that one fragment reduces, in each direction (vtkFloatTexturesReduceFS.glsl).
constexpr int ReductionBlock = 16;
/// No matrix texture is larger: drivers refuse huge ones long before the memory is full.
constexpr vtkIdType MaximumMatrixTexels = vtkIdType(1) << 24;
/// Rows times ranges of columns that keep a large GPU busy.
constexpr vtkIdType WantedFragments = vtkIdType(1) << 18;
/// Below this a range of columns is not worth a fragment.
constexpr int MinimumTexelsPerSplit = 8;
/// Textures that one draw can write everywhere.
constexpr int MaximumOutputs = 8;

constexpr int DivideUp(vtkIdType dividend, vtkIdType divisor)
{
  return static_cast<int>((dividend + divisor - 1) / divisor);
}

/// The largest power of two that is not above `limit`.
int FloorPowerOfTwo(vtkIdType limit)
{
  int power = 1;
  while (2 * static_cast<vtkIdType>(power) <= limit)
  {
    power *= 2;
  }
  return power;
}
} // namespace

struct vtkOpenGLLinkOperator::Internals
{
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

  vtkWeakPointer<vtkOpenGLRenderWindow> UserWindow;
  bool UsesUserWindow = false;
  vtkSmartPointer<vtkOffScreenOpenGLRenderWindow> SharedWindow;
  std::string DeviceName = "OpenGL";
  bool Hardware = false;

  std::unique_ptr<vtkFloatTextures> Engine;
  int Groups = 0;
  bool SharedKernel = true;
  int Rows = 0;
  int Width = 0;
  int Height = 0;
  int Splits = 0;
  /// Rows of the matrix that a fragment multiplies: 4, 2 or 1.
  int RowsPerFragment = 1;
  int TexelsPerSplit = 0;
  int MaximumSize = 0;
  int ColumnsPerTexel = 4;
  /// Row by row; the tiles of one column range lie TilesAcross apart.
  std::vector<MatrixTile> Tiles;
  int TilesAcross = 0;
  std::map<int, Group> Slots;
  Group Spare;
  Group Parts;
  std::vector<Group> Reductions;

  vtkOpenGLRenderWindow* GetWindow()
  {
    return this->UsesUserWindow ? this->UserWindow.Get() : this->SharedWindow.Get();
  }

  void Clear()
  {
    this->Tiles.clear();
    this->Slots.clear();
    this->Spare.clear();
    this->Parts.clear();
    this->Reductions.clear();
    this->Engine.reset();
  }

  std::string GetDefines(int outputs, const std::string& extra = "") const
  {
    return "#define GROUPS " + std::to_string(this->Groups) + "\n#define MATRIX_GROUPS " +
      std::to_string(this->SharedKernel ? 1 : this->Groups) + "\n#define ROWS " +
      std::to_string(this->RowsPerFragment) + "\n#define OUTPUTS " + std::to_string(outputs) +
      "\n#define SHARED_KERNEL " + (this->SharedKernel ? "1\n" : "0\n") + extra;
  }

  bool ChooseSizes(vtkIdType patches, int bands, int kernels, int maximumSize);
  double GetMatrixBytes() const;
  bool AllocateMatrix();
  bool AllocateVectors();
  void UploadMatrix(vtkExchangeMatrix* exchange);
  void UploadBlock(int rowBlock, int columnBlock, int group, const float* texels);
  Group& GetSlot(int slot);
  void GetVector(const Group& vector, int bands, std::vector<float>& texels, double* values);

  bool DrawPartialProducts(const Group& vector, int across);
  bool DrawSumOfParts(const Group& target, const Group& previous, bool accumulate);
  bool DrawCombination(const Group& target, const Group& x, const Group& y,
    const std::vector<float>& a, const std::vector<float>& b);
  bool DrawProduct(const Group& target, const Group& x, const Group& y);
  bool DrawReduction(const Group& x, const Group& y, const char* name, const char* nextName);
  bool DrawReductionStep(const Group& target, const Group& x, const Group& y, const char* name);
};

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Internals::ChooseSizes(vtkIdType patches, int bands, int kernels,
  int maximumSize)
{
  this->MaximumSize = this->Engine->GetMaximumTextureSize();
  if (maximumSize > 0)
  {
    this->MaximumSize = std::min(this->MaximumSize, std::max(maximumSize, 4));
  }
  this->Groups = DivideUp(bands, 4);
  this->SharedKernel = kernels == 1;
  this->RowsPerFragment = std::min(FloorPowerOfTwo(std::max(MaximumOutputs / this->Groups, 1)), 4);
  this->ColumnsPerTexel = this->SharedKernel ? 4 : 1;
  this->Rows = static_cast<int>(patches);
  // A power of two: the rows of the vector's textures then hold whole matrix texels of four
  // columns.
  const vtkIdType widest = std::min(std::max<vtkIdType>(2 * patches - 1, 4), vtkIdType(1024));
  this->Width = FloorPowerOfTwo(std::min<vtkIdType>(widest, this->MaximumSize));
  this->Height = DivideUp(patches, this->Width);
  if (this->Height > this->MaximumSize)
  {
    return false;
  }
  const int texels = DivideUp(patches, this->ColumnsPerTexel);
  const int tileTexels = std::min(texels, this->MaximumSize);
  this->TilesAcross = DivideUp(texels, tileTexels);
  const int most = std::max(
    std::min(DivideUp(tileTexels, MinimumTexelsPerSplit), this->MaximumSize / this->Height), 1);
  this->Splits = std::min(DivideUp(WantedFragments * this->RowsPerFragment, patches), most);
  this->TexelsPerSplit = DivideUp(tileTexels, this->Splits);

  // Whole rows of the vector's textures, so that the rows of a tile are a rectangle of them.
  const vtkIdType rowsThatFit =
    std::min<vtkIdType>(this->MaximumSize, MaximumMatrixTexels / tileTexels);
  const int tileRows =
    static_cast<int>(std::max<vtkIdType>(rowsThatFit / this->Width, 1)) * this->Width;
  for (int row = 0; row < this->Rows; row += tileRows)
  {
    for (int texel = 0; texel < texels; texel += tileTexels)
    {
      this->Tiles.push_back({ row, std::min(tileRows, this->Rows - row), texel,
        std::min(tileTexels, texels - texel), {} });
    }
  }
  return true;
}

//------------------------------------------------------------------------------
double vtkOpenGLLinkOperator::Internals::GetMatrixBytes() const
{
  double texels = 0.0;
  for (const MatrixTile& tile : this->Tiles)
  {
    texels += static_cast<double>(tile.Rows) * tile.Texels;
  }
  return texels * 4 * sizeof(float) * (this->SharedKernel ? 1 : this->Groups);
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Internals::AllocateMatrix()
{
  const auto count = static_cast<std::size_t>(this->SharedKernel ? 1 : this->Groups);
  for (MatrixTile& tile : this->Tiles)
  {
    tile.Textures = this->Engine->Allocate(count, tile.Texels, tile.Rows);
    if (tile.Textures.empty())
    {
      return false;
    }
    // What is not uploaded is zero.
    this->Engine->Clear(tile.Textures);
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Internals::AllocateVectors()
{
  const auto count = static_cast<std::size_t>(this->Groups);
  this->Spare = this->Engine->Allocate(count, this->Width, this->Height);
  this->Parts = this->Engine->Allocate(count * static_cast<std::size_t>(this->RowsPerFragment),
    this->Width / this->RowsPerFragment, this->Height * this->Splits);
  bool good = !this->Spare.empty() && !this->Parts.empty();
  int width = this->Width;
  int height = this->Height;
  do
  {
    width = DivideUp(width, ReductionBlock);
    height = DivideUp(height, ReductionBlock);
    this->Reductions.push_back(this->Engine->Allocate(count, width, height));
    good = good && !this->Reductions.back().empty();
  } while (width * height > 1);
  return good;
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::Internals::UploadMatrix(vtkExchangeMatrix* exchange)
{
  const std::size_t blockValues = static_cast<std::size_t>(TileSize) * TileSize;
  const int kernels = exchange->GetNumberOfKernels();
  std::vector<float> texels(this->SharedKernel ? blockValues : 4 * blockValues);
  const int groups = this->SharedKernel ? 1 : this->Groups;
  for (const vtkExchangeMatrix::Tile& tile : exchange->GetTiles())
  {
    if (!tile.Values)
    {
      continue;
    }
    const int row = static_cast<int>(tile.Row);
    const int column = static_cast<int>(tile.Column);
    for (int group = 0; group < groups; ++group)
    {
      const int lanes = this->SharedKernel ? 1 : 4;
      for (int transposed = 0; transposed < (row == column ? 1 : 2); ++transposed)
      {
        for (int lane = 0; lane < lanes && 4 * group + lane < kernels; ++lane)
        {
          const float* values = tile.Values + (4 * group + lane) * blockValues;
          for (int i = 0; i < TileSize; ++i)
          {
            for (int j = 0; j < TileSize; ++j)
            {
              texels[static_cast<std::size_t>((i * TileSize + j) * lanes + lane)] =
                transposed ? values[j * TileSize + i] : values[i * TileSize + j];
            }
          }
        }
        this->UploadBlock(transposed ? column : row, transposed ? row : column, group,
          texels.data());
      }
    }
  }
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::Internals::UploadBlock(int rowBlock, int columnBlock, int group,
  const float* texels)
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
      this->Engine->Upload(tile.Textures[static_cast<std::size_t>(group)], region, length,
        texels + 4 * start);
    }
  }
}

//------------------------------------------------------------------------------
Group& vtkOpenGLLinkOperator::Internals::GetSlot(int slot)
{
  Group& vector = this->Slots[slot];
  if (vector.empty())
  {
    vector =
      this->Engine->Allocate(static_cast<std::size_t>(this->Groups), this->Width, this->Height);
  }
  return vector;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Internals::DrawPartialProducts(const Group& vector, int across)
{
  for (std::size_t index = static_cast<std::size_t>(across); index < this->Tiles.size();
       index += static_cast<std::size_t>(this->TilesAcross))
  {
    const MatrixTile& tile = this->Tiles[index];
    vtkShaderProgram* program = this->Engine->Use("PartialProduct",
      vtkFloatTexturesPartialProductFS, this->GetDefines(static_cast<int>(this->Parts.size())));
    if (!program)
    {
      return false;
    }
    this->Engine->SetTextures(program, "matrix", tile.Textures);
    this->Engine->SetTextures(program, "vector", vector);
    program->SetUniformi("width", this->Width);
    program->SetUniformi("splits", this->Splits);
    program->SetUniformi("numberOfRows", this->Rows);
    program->SetUniformi("firstRow", tile.FirstRow);
    program->SetUniformi("firstColumn", tile.FirstTexel * this->ColumnsPerTexel);
    program->SetUniformi("numberOfTexels", tile.Texels);
    program->SetUniformi("texelsPerSplit", this->TexelsPerSplit);
    const int firstLine = tile.FirstRow / this->Width * this->Splits;
    const int lines = DivideUp(tile.Rows, this->Width) * this->Splits;
    const int region[4] = { 0, firstLine, this->Width / this->RowsPerFragment, lines };
    this->Engine->Draw(this->Parts, region);
    // A bunch of work at a time: a GPU that draws a screen as well is taken away from whoever keeps
    // it for seconds.
    glFlush();
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Internals::DrawSumOfParts(const Group& target, const Group& previous,
  bool accumulate)
{
  vtkShaderProgram* program =
    this->Engine->Use("SumParts", vtkFloatTexturesSumPartsFS, this->GetDefines(this->Groups));
  if (!program)
  {
    return false;
  }
  this->Engine->SetTextures(program, "parts", this->Parts);
  this->Engine->SetTextures(program, "previous", previous);
  program->SetUniformi("splits", this->Splits);
  program->SetUniformi("accumulate", accumulate ? 1 : 0);
  const int region[4] = { 0, 0, this->Width, this->Height };
  this->Engine->Draw(target, region);
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Internals::DrawCombination(const Group& target, const Group& x,
  const Group& y, const std::vector<float>& a, const std::vector<float>& b)
{
  vtkShaderProgram* program =
    this->Engine->Use("Combine", vtkFloatTexturesCombineFS, this->GetDefines(this->Groups));
  if (!program)
  {
    return false;
  }
  this->Engine->SetTextures(program, "x", x);
  this->Engine->SetTextures(program, "y", y);
  program->SetUniform4fv("a", this->Groups, a.data());
  program->SetUniform4fv("b", this->Groups, b.data());
  const int region[4] = { 0, 0, this->Width, this->Height };
  this->Engine->Draw(target, region);
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Internals::DrawProduct(const Group& target, const Group& x,
  const Group& y)
{
  vtkShaderProgram* program =
    this->Engine->Use("Scale", vtkFloatTexturesScaleFS, this->GetDefines(this->Groups));
  if (!program)
  {
    return false;
  }
  this->Engine->SetTextures(program, "x", x);
  this->Engine->SetTextures(program, "y", y);
  const int region[4] = { 0, 0, this->Width, this->Height };
  this->Engine->Draw(target, region);
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Internals::DrawReductionStep(const Group& target, const Group& x,
  const Group& y, const char* name)
{
  const std::string define = "#define " + std::string(name) + " 1\n";
  vtkShaderProgram* program =
    this->Engine->Use(name, vtkFloatTexturesReduceFS, this->GetDefines(this->Groups, define));
  if (!program)
  {
    return false;
  }
  this->Engine->SetTextures(program, "x", x);
  this->Engine->SetTextures(program, "y", y);
  const int size[2] = { static_cast<int>(x[0]->GetWidth()), static_cast<int>(x[0]->GetHeight()) };
  program->SetUniform2i("size", size);
  const int region[4] = { 0, 0, static_cast<int>(target[0]->GetWidth()),
    static_cast<int>(target[0]->GetHeight()) };
  this->Engine->Draw(target, region);
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Internals::DrawReduction(const Group& x, const Group& y,
  const char* name, const char* nextName)
{
  bool good = this->DrawReductionStep(this->Reductions[0], x, y, name);
  for (std::size_t step = 1; step < this->Reductions.size() && good; ++step)
  {
    const Group& source = this->Reductions[step - 1];
    good = this->DrawReductionStep(this->Reductions[step], source, source, nextName);
  }
  return good;
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::Internals::GetVector(const Group& vector, int bands,
  std::vector<float>& texels, double* values)
{
  const int width = static_cast<int>(vector[0]->GetWidth());
  const int height = static_cast<int>(vector[0]->GetHeight());
  const int count = std::min(this->Rows, width * height);
  texels.resize(static_cast<std::size_t>(4) * width * height);
  for (int group = 0; group < this->Groups; ++group)
  {
    this->Engine->Download(vector, static_cast<std::size_t>(group), width, height, texels.data());
    for (int patch = 0; patch < count; ++patch)
    {
      for (int lane = 0; lane < 4 && 4 * group + lane < bands; ++lane)
      {
        values[static_cast<vtkIdType>(patch) * bands + 4 * group + lane] =
          texels[static_cast<std::size_t>(4 * patch + lane)];
      }
    }
  }
}

//------------------------------------------------------------------------------
vtkOpenGLLinkOperator::vtkOpenGLLinkOperator() : Self(new Internals) {}

//------------------------------------------------------------------------------
vtkOpenGLLinkOperator::~vtkOpenGLLinkOperator()
{
  this->Self->Clear();
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DeviceName: " << this->Self->DeviceName << "\n";
  os << indent << "MaximumTextureSize: " << this->MaximumTextureSize << "\n";
  os << indent << "NumberOfBytesRead: " << this->NumberOfBytesRead << "\n";
  os << indent << "RenderWindow: " << this->GetRenderWindow() << "\n";
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::SetRenderWindow(vtkRenderWindow* window)
{
  if (window == this->GetRenderWindow() && this->Self->UsesUserWindow == (window != nullptr))
  {
    return;
  }
  this->Release();
  this->Self->UserWindow = vtkOpenGLRenderWindow::SafeDownCast(window);
  this->Self->UsesUserWindow = window != nullptr;
  this->Modified();
}

//------------------------------------------------------------------------------
vtkRenderWindow* vtkOpenGLLinkOperator::GetRenderWindow()
{
  return this->Self->UserWindow;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Open(std::string& reason)
{
  Internals& self = *this->Self;
  if (!self.UsesUserWindow && !self.SharedWindow)
  {
    self.SharedWindow = vtkGetSharedOffScreenWindow(reason);
  }
  vtkOpenGLRenderWindow* window = self.GetWindow();
  if (!window)
  {
    reason =
      self.UsesUserWindow ? "OpenGL: the render window is gone, or not an OpenGL window." : reason;
    return false;
  }
  auto* offScreen = vtkOffScreenOpenGLRenderWindow::SafeDownCast(window);
  if (offScreen && self.UsesUserWindow)
  {
    const vtkCurrentOpenGLContext before = vtkCurrentOpenGLContext::Get();
    const bool open = offScreen->Open(reason);
    before.Restore();
    if (!open)
    {
      return false;
    }
  }
  // Making the context of a window on a screen may abort the process, so that is left to the
  // window's owner.
  const std::string device = window->GetState()->GetRenderer();
  if (device.empty())
  {
    reason = "OpenGL: the render window has no context yet; let it render once first.";
    return false;
  }
  self.Hardware = vtkOpenGLDeviceIsHardware(device);
  self.DeviceName = "OpenGL (" + device + ")";
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::IsHardware()
{
  return this->Self->Hardware;
}

//------------------------------------------------------------------------------
const char* vtkOpenGLLinkOperator::GetDeviceName()
{
  return this->Self->DeviceName.c_str();
}

//------------------------------------------------------------------------------
int vtkOpenGLLinkOperator::GetNumberOfMatrixTextures()
{
  std::size_t count = 0;
  for (const Internals::MatrixTile& tile : this->Self->Tiles)
  {
    count += tile.Textures.size();
  }
  return static_cast<int>(count);
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::Release()
{
  this->Self->Clear();
  this->Self->SharedWindow = nullptr;
  this->NumberOfPatches = 0;
  this->NumberOfBands = 0;
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::ReleaseGraphicsResources(vtkWindow* window)
{
  if (window && window == this->Self->GetWindow())
  {
    this->Self->Clear();
  }
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Initialize(vtkExchange* exchange, int numberOfBands)
{
  this->Self->Clear();
  this->NumberOfBytesRead = 0;
  if (!exchange || exchange->GetNumberOfPatches() == 0)
  {
    vtkErrorMacro("The exchange matrix is empty: fill it before Initialize().");
    return false;
  }
  auto* matrix = vtkExchangeMatrix::SafeDownCast(exchange);
  if (!matrix)
  {
    vtkErrorMacro(<< "OpenGL does not apply a " << exchange->GetClassName()
                  << ": set Device to CPU.");
    return false;
  }
  const int kernels = exchange->GetNumberOfKernels();
  if (numberOfBands < 1 || numberOfBands > MaximumNumberOfBands ||
    (kernels != 1 && kernels != numberOfBands))
  {
    vtkErrorMacro(<< numberOfBands << " bands with " << kernels << " kernels: OpenGL takes 1 to "
                  << int(MaximumNumberOfBands)
                  << " bands, and one kernel or as many as bands. Set Device to CPU for more.");
    return false;
  }
  if (exchange->GetNumberOfParts() > 1)
  {
    vtkErrorMacro("OpenGL holds a whole matrix, not " << exchange->GetNumberOfParts()
                                                      << " parts of one: set Device to CPU in "
                                                         "parallel runs.");
    return false;
  }
  std::string reason;
  if (!this->Open(reason))
  {
    vtkErrorMacro("No OpenGL context: " << reason);
    return false;
  }
  this->NumberOfPatches = exchange->GetNumberOfPatches();
  this->NumberOfBands = numberOfBands;
  if (!this->InitializeOnDevice(matrix))
  {
    this->Release();
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::InitializeOnDevice(vtkExchangeMatrix* exchange)
{
  Internals& self = *this->Self;
  self.Engine = std::make_unique<vtkFloatTextures>(self.GetWindow());
  if (!self.Engine->IsAlive())
  {
    vtkErrorMacro("This OpenGL cannot make floating-point textures: set Device to CPU.");
    return false;
  }
  const vtkFloatTextures::Session session(self.GetWindow());
  if (!self.ChooseSizes(this->NumberOfPatches, this->NumberOfBands, exchange->GetNumberOfKernels(),
        this->MaximumTextureSize) ||
    self.Groups > self.Engine->GetMaximumGroupSize())
  {
    vtkErrorMacro(<< this->NumberOfPatches << " patches and " << this->NumberOfBands
                  << " bands are too many for OpenGL's textures of at most " << self.MaximumSize
                  << " texels a side: set Device to CPU.");
    return false;
  }
  const double available = self.Engine->GetAvailableBytes();
  const bool fits = available < 0.0 || self.GetMatrixBytes() < available;
  if (!fits || !self.AllocateMatrix() || !self.AllocateVectors())
  {
    vtkErrorMacro("The matrix of " << this->NumberOfPatches
                                   << " patches does not fit into the memory of " << self.DeviceName
                                   << ": set Device to CPU.");
    return false;
  }
  self.UploadMatrix(exchange);
  return this->Finish(true, "taking the matrix");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::IsReady(int slot)
{
  if (!this->Self->Engine || !this->Self->Engine->IsAlive())
  {
    vtkErrorMacro("There is no matrix, or its window has gone: call Initialize() first.");
    return false;
  }
  if (this->Self->Slots.count(slot) == 0)
  {
    vtkErrorMacro("Slot " << slot << " is read before it has been written.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Finish(bool drawn, const char* what)
{
  std::string text;
  if (!drawn)
  {
    vtkErrorMacro("OpenGL failed in " << what << ": a shader does not compile on "
                                      << this->Self->DeviceName << ". Set Device to CPU.");
    return false;
  }
  if (!vtkFloatTextures::CheckErrors(text))
  {
    vtkErrorMacro("OpenGL failed in " << what << " with " << text << " on "
                                      << this->Self->DeviceName << ". Set Device to CPU.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::SetVector(int slot, const double* values)
{
  Internals& self = *this->Self;
  if (!self.Engine || !self.Engine->IsAlive())
  {
    vtkErrorMacro("There is no matrix, or its window has gone: call Initialize() first.");
    return false;
  }
  const vtkFloatTextures::Session session(self.GetWindow());
  const Group& vector = self.GetSlot(slot);
  const int region[4] = { 0, 0, self.Width, self.Height };
  for (std::size_t group = 0; group < vector.size(); ++group)
  {
    std::vector<float> texels(static_cast<std::size_t>(4) * self.Width * self.Height, 0.0f);
    for (vtkIdType patch = 0; patch < this->NumberOfPatches; ++patch)
    {
      for (int band = 4 * static_cast<int>(group), lane = 0; lane < 4 && band < this->NumberOfBands;
           ++band, ++lane)
      {
        texels[static_cast<std::size_t>(4 * patch + lane)] =
          static_cast<float>(values[patch * this->NumberOfBands + band]);
      }
    }
    self.Engine->Upload(vector[group], region, self.Width, texels.data());
  }
  return this->Finish(!vector.empty(), "SetVector");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::GetVector(int slot, double* values)
{
  if (!this->IsReady(slot))
  {
    return false;
  }
  Internals& self = *this->Self;
  const vtkFloatTextures::Session session(self.GetWindow());
  std::vector<float> texels;
  self.GetVector(self.Slots[slot], this->NumberOfBands, texels, values);
  this->NumberOfBytesRead += static_cast<vtkTypeInt64>(texels.size() * sizeof(float)) * self.Groups;
  return this->Finish(true, "GetVector");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Multiply(int y, int x)
{
  if (!this->IsReady(x))
  {
    return false;
  }
  if (x == y)
  {
    vtkErrorMacro("Multiply needs two slots, not slot " << x << " twice.");
    return false;
  }
  Internals& self = *this->Self;
  const vtkFloatTextures::Session session(self.GetWindow());
  Group& target = self.GetSlot(y);
  bool drawn = !target.empty();
  for (int across = 0; across < self.TilesAcross && drawn; ++across)
  {
    drawn = self.DrawPartialProducts(self.Slots[x], across) &&
      self.DrawSumOfParts(self.Spare, target, across > 0);
    std::swap(self.Spare, target);
  }
  return this->Finish(drawn, "Multiply");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Combine(int z, const double* a, int x, const double* b, int y)
{
  if (!this->IsReady(x) || !this->IsReady(y))
  {
    return false;
  }
  Internals& self = *this->Self;
  const vtkFloatTextures::Session session(self.GetWindow());
  std::vector<float> factorsOfX(static_cast<std::size_t>(4) * self.Groups, 0.0f);
  std::vector<float> factorsOfY(factorsOfX);
  for (int band = 0; band < this->NumberOfBands; ++band)
  {
    factorsOfX[static_cast<std::size_t>(band)] = static_cast<float>(a[band]);
    factorsOfY[static_cast<std::size_t>(band)] = static_cast<float>(b[band]);
  }
  Group& target = self.GetSlot(z);
  const bool drawn = !target.empty() &&
    self.DrawCombination(self.Spare, self.Slots[x], self.Slots[y], factorsOfX, factorsOfY);
  std::swap(self.Spare, target);
  return this->Finish(drawn, "Combine");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Scale(int z, int x, int y)
{
  if (!this->IsReady(x) || !this->IsReady(y))
  {
    return false;
  }
  Internals& self = *this->Self;
  const vtkFloatTextures::Session session(self.GetWindow());
  Group& target = self.GetSlot(z);
  const bool drawn = !target.empty() && self.DrawProduct(self.Spare, self.Slots[x], self.Slots[y]);
  std::swap(self.Spare, target);
  return this->Finish(drawn, "Scale");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Dot(int x, int y, double* result)
{
  if (!this->IsReady(x) || !this->IsReady(y))
  {
    return false;
  }
  Internals& self = *this->Self;
  const vtkFloatTextures::Session session(self.GetWindow());
  const bool drawn =
    self.DrawReduction(self.Slots[x], self.Slots[y], "REDUCE_PRODUCT", "REDUCE_SUM");
  return this->ReadReduction(drawn, "Dot", result);
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::MaxNorm(int x, double* result)
{
  if (!this->IsReady(x))
  {
    return false;
  }
  Internals& self = *this->Self;
  const vtkFloatTextures::Session session(self.GetWindow());
  const bool drawn =
    self.DrawReduction(self.Slots[x], self.Slots[x], "REDUCE_MAXIMUM", "REDUCE_MAXIMUM");
  return this->ReadReduction(drawn, "MaxNorm", result);
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::ReadReduction(bool drawn, const char* what, double* result)
{
  Internals& self = *this->Self;
  if (drawn)
  {
    std::vector<float> texels;
    self.GetVector(self.Reductions.back(), this->NumberOfBands, texels, result);
    this->NumberOfBytesRead +=
      static_cast<vtkTypeInt64>(texels.size() * sizeof(float)) * self.Groups;
  }
  return this->Finish(drawn, what);
}
