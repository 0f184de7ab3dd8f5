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
 * Of a file in several parts the first is read. Deep images and channels with subsampling are
 * refused. A file that is truncated, unfinished, damaged, or not OpenEXR gives one error that names
 * the file and the fault. Sizes named in the header are checked against the length of the file
 * before anything is allocated for them: the pixels of level 0 may be as many times larger than the
 * file's data as the compression can make of them at most (none 1, RLE 64, ZIPS and ZIP 1032, PIZ
 * 454, PXR24 1376, B44 and B44A 11, DWAA and DWAB 66048), and one tile or block of lines may take
 * 64 MiB, or four times what the whole level 0 takes.
 */
#ifndef vtkOpenEXRReader_h
#define vtkOpenEXRReader_h

#include "vtkImageReader2.h"
#include "vtkLightTransportIOModule.h" // for export macro

#include <string> // for std::string

namespace LightTransport
{
class Outcome;
}
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
  LightTransport::Outcome TryToReadHeader(vtkInformation* info);
  LightTransport::Outcome ReadHeader(vtkInformation* info);
  LightTransport::Outcome TryToReadLevel(vtkImageData* output);
  void ReadLevel(vtkImageData* output);

  int Level = 0;
  int NumberOfLevels = 0;
};

#endif
