// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenEXRReader
 * @brief reads an OpenEXR image, with all its channels, into the point arrays of a vtkImageData
 *
 * Values are linear and come as they are in the file; half and float channels become float arrays,
 * unsigned integer channels become vtkUnsignedIntArray.
 *
 * Channels that belong together become one array:
 *
 * | channels in the file | array |
 * |---|---|
 * | R, G, B | "RGB", three components |
 * | R, G, B, A | "RGBA", four components |
 * | name.R, name.G, name.B (, name.A) | "name", three (four) components |
 * | name.0, name.1, ... name.N-1 | "name", N components |
 * | any other | an array with the channel's name, one component |
 *
 * Unsigned integers never share an array with other numbers, which would cost them digits: an
 * integer A beside half R, G, B is an array "A" of its own.
 *
 * The point scalars are "RGBA" or "RGB", else the channel "Y", else the first array.
 *
 * The extent is the file's data window, x and y numbers unchanged. An OpenEXR file starts with its
 * topmost row and a vtkImageData with its lowest, so rows are turned round within the data window.
 * The field data array "DisplayWindow" (int, xmin, xmax, ymin, ymax as in the file) holds the
 * display window; vtkOpenEXRWriter writes it back. The origin's y is such that images with
 * different data windows in the same display window lie over each other; it is zero where both
 * windows are the same. Spacing is 1.
 *
 * Of a tiled file with mip levels (or both kinds of ripmap levels: those of equal index in x and y)
 * one is read, see Level. Its extent starts where that of level 0 does and has the level's size;
 * origin and spacing are such that it covers the same area. All levels in Python:
 *
 *     reader.UpdateInformation()
 *     for level in range(reader.GetNumberOfLevels()):
 *         reader.SetLevel(level)
 *         reader.Update()
 *
 * The field data arrays "NumberOfLevels" and "Level" (int) tell what the file has and what was
 * read.
 *
 * Of a file in several parts one is read, see Part. The field data arrays "NumberOfParts", "Part"
 * (int) and "PartNames" (strings) tell what the file has and what was read.
 *
 * Luminance and chroma (Y, RY, BY, where RY and BY mostly have a value for every second pixel of
 * every second line) become "RGB" or, with A, "RGBA", or the layer's array, in half precision, as
 * OpenEXR's own RgbaInputFile reads them. Deep parts and other channels with subsampling are
 * refused by name.
 *
 * vtkOpenEXRWriter keeps the name of the point scalars in the header (the string attributes
 * "scalarsName" and "scalarsChannel"); they get it back.
 *
 * A file that is truncated, unfinished, damaged, or not OpenEXR gives one error that names the file
 * and the fault. Sizes named in the header are checked against the length of the file before
 * anything is allocated for them: the pixels of level 0 may be as many times larger than the file's
 * data as the compression can make of them at most (none 1, RLE 64, ZIPS and ZIP 1032, PIZ 454,
 * PXR24 1376, B44 and B44A 11, DWAA and DWAB 66048), and one tile or block of lines may take 64
 * MiB, or four times what the whole level 0 takes. What needs more than MemoryLimit, or more than
 * is free, is refused.
 */
#ifndef vtkOpenEXRReader_h
#define vtkOpenEXRReader_h

#include "vtkImageReader2.h"
#include "vtkLightTransportIOModule.h" // for export macro

#include <string> // for std::string
#include <vector> // for std::vector

namespace LightTransport
{
class Outcome;
}
class vtkFieldData;
class vtkImageData;

class VTKLIGHTTRANSPORTIO_EXPORT vtkOpenEXRReader : public vtkImageReader2
{
public:
  static vtkOpenEXRReader* New();
  vtkTypeMacro(vtkOpenEXRReader, vtkImageReader2);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// 3 (certainly) when the file starts as an OpenEXR file does, 0 otherwise.
  int CanReadFile(VTK_FILEPATH const char* fileName) override;

  const char* GetFileExtensions() override { return ".exr"; }
  const char* GetDescriptiveName() override { return "OpenEXR"; }

  ///@{
  /// The mip level to read, from 0, the whole image, which is the default. One that the file does
  /// not have gives an error.
  vtkSetClampMacro(Level, int, 0, VTK_INT_MAX);
  vtkGetMacro(Level, int);
  ///@}

  /// The levels that the file has; 1 unless it is tiled. 0 before UpdateInformation() and of a
  /// file that cannot be read.
  vtkGetMacro(NumberOfLevels, int);

  ///@{
  /// The part to read, from 0, which is the default. One that the file does not have gives an
  /// error.
  vtkSetClampMacro(Part, int, 0, VTK_INT_MAX);
  vtkGetMacro(Part, int);
  ///@}

  ///@{
  /// The parts that the file has, and the name of one; empty for a part without a name, or that is
  /// not there. Known after UpdateInformation(), also where the chosen part cannot be read; before,
  /// and of a file that is no OpenEXR file, 0.
  int GetNumberOfParts() const { return static_cast<int>(this->PartNames.size()); }
  std::string GetPartName(int part) const;
  ///@}

  ///@{
  /**
   * The memory that reading may take, in MiB: 4 bytes for each value of the pixels, and a tile or
   * block of lines. A small file can hold, or pretend to hold, a very large image; one that needs
   * more is refused. Default 8192, at least 0.
   */
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

protected:
  vtkOpenEXRReader();
  ~vtkOpenEXRReader() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

private:
  vtkOpenEXRReader(const vtkOpenEXRReader&) = delete;
  void operator=(const vtkOpenEXRReader&) = delete;

  LightTransport::Outcome Fail(unsigned long errorCode, const std::string& problem);
  int Finish(const LightTransport::Outcome& outcome);
  LightTransport::Outcome CheckFile();
  LightTransport::Outcome ReadHeader(vtkInformation* info);
  LightTransport::Outcome ReadLevel(vtkImageData* output);
  template <typename Target>
  LightTransport::Outcome Try(LightTransport::Outcome (vtkOpenEXRReader::*read)(Target*),
    Target* target);
  void AddFields(const int display[4], vtkFieldData* fields);

  int Level = 0;
  int NumberOfLevels = 0;
  int Part = 0;
  int MemoryLimit = 8192;
  std::vector<std::string> PartNames;
};

#endif
