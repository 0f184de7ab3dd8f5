// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenEXRWriter
 * @brief writes the point arrays of a two-dimensional vtkImageData as the channels of an OpenEXR
 * image
 *
 * The point scalars go to the channels Y (one component), R, G, B (three) or R, G, B, A (four);
 * OpenEXR programs show those. Every other point array, and scalars with another number of
 * components, goes to channels by its name: "name" (one component), "name.R", "name.G", "name.B"
 * (three), with "name.A" (four), else "name.0", "name.1" and so on. vtkOpenEXRReader puts them
 * together again. Values are written as they are; no transfer curve and no scaling, whatever the
 * array's type. vtkUnsignedIntArrays become unsigned integer channels, all others half or float
 * (see PixelType); arrays of other integers that half cannot hold exactly (above 2048) become
 * float, and are refused where float cannot either (above 16777216).
 *
 * The header keeps the name of the point scalars, so that vtkOpenEXRReader gives it back. Every
 * point array must have a value for each point and be of numbers, else nothing is written.
 *
 * The data window is the extent; the display window is the field data array "DisplayWindow" (int,
 * xmin, xmax, ymin, ymax) if there is one, else the extent too. Origin and spacing are not written.
 * Rows are turned round: OpenEXR starts with the topmost.
 *
 * With MipLevels the file holds a pyramid, as a GPU would make it: the image is level 0, and each
 * texel of a further level is the mean of the 2 x 2 (at a width or height of 1: two) texels below
 * it. An array that is a density over a surface needs a WeightArray, the surface's area in each
 * texel, for its mean to be that of the surface: sum of value times weight over sum of weight.
 * Texels of weight 0 do not count; a texel over such alone takes their plain mean. The weights
 * themselves are averaged plainly, so that value times weight is the plain mean of value times
 * weight at every level. Arrays of an integer type hold ids, which have no mean: each texel takes
 * the one at the lower left of those below it. Means are computed in double precision from level to
 * level and rounded once.
 *
 * The file appears under its name when it is complete: after an error (also a full disk) or an
 * abort an older file of that name is still there, and no new one. Symbolic links are followed and
 * stay, the older file's mode is kept; devices, pipes, folders, files with several hard links and
 * files that may not be written are refused.
 */
#ifndef vtkOpenEXRWriter_h
#define vtkOpenEXRWriter_h

#include "vtkLightTransportIOModule.h" // for export macro
#include "vtkWriter.h"

#include <string> // for std::string

namespace LightTransport
{
class FileReplacement;
class Outcome;
} // namespace LightTransport
class vtkImageData;

class VTKLIGHTTRANSPORTIO_EXPORT vtkOpenEXRWriter : public vtkWriter
{
public:
  static vtkOpenEXRWriter* New();
  vtkTypeMacro(vtkOpenEXRWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum PixelTypeType
  {
    PIXEL_TYPE_HALF = 0,
    PIXEL_TYPE_FLOAT = 1
  };

  /// In OpenEXR's own order. PXR24 shortens float values to 24 bits, B44 and B44A lose in half
  /// values, DWAA and DWAB in both.
  enum CompressionType
  {
    COMPRESSION_NONE = 0,
    COMPRESSION_RLE = 1,
    COMPRESSION_ZIPS = 2,
    COMPRESSION_ZIP = 3,
    COMPRESSION_PIZ = 4,
    COMPRESSION_PXR24 = 5,
    COMPRESSION_B44 = 6,
    COMPRESSION_B44A = 7,
    COMPRESSION_DWAA = 8,
    COMPRESSION_DWAB = 9
  };

  ///@{
  /// The file to write. No default.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * How values are stored. Default PIXEL_TYPE_FLOAT. Half keeps 11 significant bits; it is refused
   * for values above 65504 in magnitude, which it cannot hold.
   */
  vtkSetClampMacro(PixelType, int, PIXEL_TYPE_HALF, PIXEL_TYPE_FLOAT);
  vtkGetMacro(PixelType, int);
  void SetPixelTypeToHalf() { this->SetPixelType(PIXEL_TYPE_HALF); }
  void SetPixelTypeToFloat() { this->SetPixelType(PIXEL_TYPE_FLOAT); }
  ///@}

  ///@{
  /// See CompressionType. Default COMPRESSION_ZIP, which loses nothing.
  vtkSetClampMacro(Compression, int, COMPRESSION_NONE, COMPRESSION_DWAB);
  vtkGetMacro(Compression, int);
  void SetCompressionToNone() { this->SetCompression(COMPRESSION_NONE); }
  void SetCompressionToRLE() { this->SetCompression(COMPRESSION_RLE); }
  void SetCompressionToZIPS() { this->SetCompression(COMPRESSION_ZIPS); }
  void SetCompressionToZIP() { this->SetCompression(COMPRESSION_ZIP); }
  void SetCompressionToPIZ() { this->SetCompression(COMPRESSION_PIZ); }
  void SetCompressionToPXR24() { this->SetCompression(COMPRESSION_PXR24); }
  void SetCompressionToB44() { this->SetCompression(COMPRESSION_B44); }
  void SetCompressionToB44A() { this->SetCompression(COMPRESSION_B44A); }
  void SetCompressionToDWAA() { this->SetCompression(COMPRESSION_DWAA); }
  void SetCompressionToDWAB() { this->SetCompression(COMPRESSION_DWAB); }
  ///@}

  ///@{
  /// Whether the pixels are stored in tiles, in place of lines. Default off. MipLevels implies it.
  vtkSetMacro(Tiled, bool);
  vtkGetMacro(Tiled, bool);
  vtkBooleanMacro(Tiled, bool);
  ///@}

  ///@{
  /// Width and height of a tile in pixels, at most the image's own. Default 64, range 1 to 4096.
  vtkSetClampMacro(TileSize, int, 1, 4096);
  vtkGetMacro(TileSize, int);
  ///@}

  ///@{
  /**
   * Whether all mip levels down to one texel are computed and written. Default off. Width and
   * height must each be a power of two.
   */
  vtkSetMacro(MipLevels, bool);
  vtkGetMacro(MipLevels, bool);
  vtkBooleanMacro(MipLevels, bool);
  ///@}

  ///@{
  /**
   * The point array (float or double, one component, finite, not negative) by which mip levels are
   * weighted, such as "Area". Default none: plain means. Unused without MipLevels.
   */
  vtkSetStringMacro(WeightArray);
  vtkGetStringMacro(WeightArray);
  ///@}

protected:
  vtkOpenEXRWriter();
  ~vtkOpenEXRWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkOpenEXRWriter(const vtkOpenEXRWriter&) = delete;
  void operator=(const vtkOpenEXRWriter&) = delete;

  LightTransport::Outcome Fail(unsigned long errorCode, const std::string& problem);
  LightTransport::Outcome TryToWrite();
  LightTransport::Outcome WriteFile();
  LightTransport::Outcome CheckImage(vtkImageData* image) const;
  LightTransport::Outcome WriteImage(vtkImageData* image, LightTransport::FileReplacement& file);

  char* FileName = nullptr;
  int PixelType = PIXEL_TYPE_FLOAT;
  int Compression = COMPRESSION_ZIP;
  bool Tiled = false;
  int TileSize = 64;
  bool MipLevels = false;
  char* WeightArray = nullptr;
};

#endif
