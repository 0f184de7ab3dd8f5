// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenEXRWriter.h"

#include "Files/ChannelGroups.h"
#include "Files/CodecMemory.h"
#include "Files/PixelLevels.h"
#include "Files/ReplacementStream.h"
#include "Files/WrittenChannels.h"
#include "Shared/ArrayNames.h"
#include "Shared/FileReplacement.h"
#include "Shared/FilterMonitor.h"

#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenEXRWriter);

namespace
{
//------------------------------------------------------------------------------
PixelLevels::Size GetSize(vtkImageData* image)
{
  int dimensions[3];
  image->GetDimensions(dimensions);
  return { dimensions[0], dimensions[1] };
}

//------------------------------------------------------------------------------
Imath::Box2i GetDisplayWindow(vtkImageData* image, const Imath::Box2i& dataWindow)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(ArrayNames::DisplayWindow);
  if (!array || array->GetNumberOfValues() != 4)
  {
    return dataWindow;
  }
  const auto values = vtk::DataArrayValueRange(array);
  constexpr double largest = std::numeric_limits<int>::max();
  // Not a number or beyond int: OpenEXR refuses the window.
  const auto value = [&](int i)
  {
    const auto number = static_cast<double>(values[i]);
    return std::abs(number) <= largest ? static_cast<int>(number) : std::numeric_limits<int>::max();
  };
  const Imath::Box2i window({ value(0), value(2) }, { value(1), value(3) });
  return window.isEmpty() ? dataWindow : window;
}

//------------------------------------------------------------------------------
Outcome WriteLines(Imf::OStream& stream, const Imf::Header& header, PixelLevels& levels,
  const Monitor& monitor)
{
  const Imath::Box2i& window = header.dataWindow();
  const int height = window.max.y - window.min.y + 1;
  Imf::OutputFile file(stream, header);
  file.setFrameBuffer(levels.Take(window, false));
  // DWAB's, the tallest chunk.
  constexpr int block = 256;
  bool goesOn = true;
  for (int row = 0; row < height && goesOn; row += block)
  {
    const int count = std::min(block, height - row);
    file.writePixels(count);
    goesOn = monitor.Report(static_cast<double>(row + count) / height);
  }
  return Outcome::DoneUnlessAborted(goesOn);
}

//------------------------------------------------------------------------------
Outcome WriteTiles(Imf::OStream& stream, const Imf::Header& header, PixelLevels& levels,
  const Monitor& monitor)
{
  Imf::TiledOutputFile file(stream, header);
  const int numberOfLevels = file.numLevels();
  int total = 0;
  for (int level = 0; level < numberOfLevels; ++level)
  {
    total += file.numYTiles(level);
  }
  int done = 0;
  for (int level = 0; level < numberOfLevels; ++level)
  {
    file.setFrameBuffer(levels.Take(file.dataWindowForLevel(level), level + 1 < numberOfLevels));
    for (int row = 0; row < file.numYTiles(level); ++row)
    {
      file.writeTiles(0, file.numXTiles(level) - 1, row, row, level);
      if (!monitor.Report(static_cast<double>(++done) / total))
      {
        return Outcome::Aborted();
      }
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
bool IsPowerOfTwo(vtkIdType value)
{
  return value > 0 && (value & (value - 1)) == 0;
}
} // namespace

//------------------------------------------------------------------------------
vtkOpenEXRWriter::vtkOpenEXRWriter() = default;

//------------------------------------------------------------------------------
vtkOpenEXRWriter::~vtkOpenEXRWriter()
{
  this->SetFileName(nullptr);
  this->SetWeightArray(nullptr);
}

//------------------------------------------------------------------------------
int vtkOpenEXRWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::WriteData()
{
  const Outcome outcome = this->TryToWrite();
  if (outcome.IsAborted())
  {
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  if (outcome.HasFailed())
  {
    vtkErrorMacro("Cannot write the OpenEXR file \"" << (this->FileName ? this->FileName : "")
                                                     << "\": " << outcome.GetMessage() << '.');
  }
}

//------------------------------------------------------------------------------
Outcome vtkOpenEXRWriter::Fail(unsigned long errorCode, const std::string& problem)
{
  this->SetErrorCode(errorCode);
  return Outcome::Failed(problem);
}

//------------------------------------------------------------------------------
// The border to OpenEXR: what it throws becomes a failure.
Outcome vtkOpenEXRWriter::TryToWrite()
{
  try
  {
    return this->WriteFile();
  }
  catch (const std::bad_alloc&)
  {
    return this->Fail(vtkErrorCode::UnknownError,
      "there is not enough memory; write a smaller image");
  }
  catch (const std::exception& exception)
  {
    return this->Fail(vtkErrorCode::CannotOpenFileError, exception.what());
  }
}

//------------------------------------------------------------------------------
Outcome vtkOpenEXRWriter::WriteFile()
{
  if (!this->FileName || !*this->FileName)
  {
    return this->Fail(vtkErrorCode::NoFileNameError, "no file name is set; call SetFileName first");
  }
  vtkImageData* image = vtkImageData::SafeDownCast(this->GetInput());
  if (Outcome checked = this->CheckImage(image); !checked)
  {
    return this->Fail(vtkErrorCode::FileFormatError, checked.GetMessage());
  }
  FileReplacement file;
  if (Outcome begun = file.Begin(this->FileName); !begun)
  {
    return this->Fail(vtkErrorCode::CannotOpenFileError, begun.GetMessage());
  }
  Outcome written = Outcome::Done();
  try
  {
    written = this->WriteImage(image, file);
  }
  catch (const Iex::BaseExc&)
  {
    if (!file.HasFailed())
    {
      throw;
    }
  }
  // OpenEXR writes the table of offsets last and says nothing where that fails.
  if (written)
  {
    written = file.Finish();
    return written ? written : this->Fail(vtkErrorCode::OutOfDiskSpaceError, written.GetMessage());
  }
  return written;
}

//------------------------------------------------------------------------------
Outcome vtkOpenEXRWriter::CheckImage(vtkImageData* image) const
{
  if (!image)
  {
    return Outcome::Failed("the input is not an image");
  }
  int extent[6];
  image->GetExtent(extent);
  if (image->GetNumberOfPoints() == 0)
  {
    return Outcome::Failed("the image is empty");
  }
  if (extent[4] != extent[5])
  {
    return Outcome::Failed(
      "the image has several slices; an OpenEXR file holds one in the xy plane");
  }
  if (Outcome arrays = WrittenChannels::CheckArrays(image); !arrays)
  {
    return arrays;
  }
  const Imf::PixelType type = this->PixelType == PIXEL_TYPE_HALF ? Imf::HALF : Imf::FLOAT;
  Outcome channels = WrittenChannels::Check(WrittenChannels::List(image, type, nullptr));
  if (!channels || !this->MipLevels)
  {
    return channels;
  }
  const PixelLevels::Size size = GetSize(image);
  if (!IsPowerOfTwo(size.Width) || !IsPowerOfTwo(size.Height))
  {
    return Outcome::Failed("mip levels need a width and height that are powers of two, not " +
      std::to_string(size.Width) + " x " + std::to_string(size.Height) +
      "; switch MipLevels off or resample the image");
  }
  const std::string weights = this->WeightArray ? this->WeightArray : "";
  return weights.empty()
    ? Outcome::Done()
    : WrittenChannels::CheckWeights(image->GetPointData()->GetArray(weights.c_str()), weights);
}

//------------------------------------------------------------------------------
Outcome vtkOpenEXRWriter::WriteImage(vtkImageData* image, FileReplacement& file)
{
  const PixelLevels::Size size = GetSize(image);
  const bool weighted = this->MipLevels && this->WeightArray && *this->WeightArray;
  vtkDataArray* weights = weighted ? image->GetPointData()->GetArray(this->WeightArray) : nullptr;
  const Imf::PixelType type = this->PixelType == PIXEL_TYPE_HALF ? Imf::HALF : Imf::FLOAT;
  const std::vector<WrittenChannel> channels = WrittenChannels::List(image, type, weights);
  int extent[6];
  image->GetExtent(extent);
  const Imath::Box2i window({ extent[0], extent[2] }, { extent[1], extent[3] });
  Imf::Header header(GetDisplayWindow(image, window), window);
  header.compression() = static_cast<Imf::Compression>(this->Compression);
  for (const WrittenChannel& channel : channels)
  {
    header.channels().insert(channel.Name, Imf::Channel(channel.Type));
  }
  const bool tiled = this->Tiled || this->MipLevels;
  if (tiled)
  {
    const vtkIdType side = this->TileSize;
    header.setTileDescription(
      Imf::TileDescription(static_cast<unsigned int>(std::min(side, size.Width)),
        static_cast<unsigned int>(std::min(side, size.Height)),
        this->MipLevels ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL, Imf::ROUND_DOWN));
  }

  if (vtkDataArray* scalars = image->GetPointData()->GetScalars(); scalars && scalars->GetName())
  {
    ChannelGroups::KeepScalars(header, scalars->GetName(),
      WrittenChannels::GetName(scalars, 0, true));
  }
  CodecMemory::Require(header);
  ReplacementStream stream(file, this->FileName);
  PixelLevels levels(channels, weights, size);
  const Monitor monitor = MakeFilterMonitor(this);
  return tiled ? WriteTiles(stream, header, levels, monitor)
               : WriteLines(stream, header, levels, monitor);
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n';
  os << indent << "PixelType: " << this->PixelType << '\n';
  os << indent << "Compression: " << this->Compression << '\n';
  os << indent << "Tiled: " << this->Tiled << '\n';
  os << indent << "TileSize: " << this->TileSize << '\n';
  os << indent << "MipLevels: " << this->MipLevels << '\n';
  os << indent << "WeightArray: " << (this->WeightArray ? this->WeightArray : "(none)") << '\n';
}
