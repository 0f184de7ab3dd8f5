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
 * Of a file in several parts the first is read. Deep images and channels with subsampling are
 * refused. Sizes named in the header are checked against the length of the file before anything is
 * allocated for them; a file that is truncated, damaged, or not OpenEXR gives one error that names
 * the file and the fault.
 */
#ifndef vtkOpenEXRReader_h
#define vtkOpenEXRReader_h

#include "vtkImageReader2.h"
#include "vtkLightTransportIOModule.h" // for export macro

#include <string> // for std::string

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

  bool Fail(unsigned long errorCode, const std::string& problem);
  bool CheckFile();
};

#endif
