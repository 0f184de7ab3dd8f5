// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenEXRWriter.h"

#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkUnsignedIntArray.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkOpenEXRWriter);

namespace
{
constexpr double LargestHalf = 65504.0;

// One channel of the file: a component of an array, its rows in the file's order.
struct ChannelData
{
  std::string Name;
  Imf::PixelType Type = Imf::FLOAT;
  vtkDataArray* Source = nullptr;
  int Component = 0;
  std::vector<half> Halves;
  std::vector<float> Floats;
  std::vector<unsigned int> Integers;
};

//------------------------------------------------------------------------------
std::string GetSuffix(int component, int components)
{
  if (components == 3 || components == 4)
  {
    return std::string(1, "RGBA"[component]);
  }
  return std::to_string(component);
}

//------------------------------------------------------------------------------
std::string GetChannelName(vtkDataArray* array, int component, bool scalars)
{
  const int components = array->GetNumberOfComponents();
  const bool colors = components == 3 || components == 4;
  if (scalars && (components == 1 || colors))
  {
    return components == 1 ? "Y" : GetSuffix(component, components);
  }
  const std::string name = array->GetName() ? array->GetName() : (scalars ? "Scalars" : "");
  return components == 1 || name.empty() ? name : name + '.' + GetSuffix(component, components);
}

//------------------------------------------------------------------------------
std::vector<ChannelData> ListChannels(vtkImageData* image, Imf::PixelType type)
{
  std::vector<ChannelData> channels;
  vtkPointData* points = image->GetPointData();
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = points->GetArray(i);
    const int components = array ? array->GetNumberOfComponents() : 0;
    for (int component = 0; component < components; ++component)
    {
      ChannelData channel;
      channel.Name = GetChannelName(array, component, array == points->GetScalars());
      channel.Type = vtkUnsignedIntArray::SafeDownCast(array) ? Imf::UINT : type;
      channel.Source = array;
      channel.Component = component;
      channels.push_back(std::move(channel));
    }
  }
  return channels;
}

//------------------------------------------------------------------------------
template <typename T>
void CopyComponent(const ChannelData& channel, vtkIdType width, std::vector<T>& target)
{
  const auto tuples = vtk::DataArrayTupleRange(channel.Source);
  const vtkIdType height = tuples.size() / width;
  target.reserve(tuples.size());
  for (vtkIdType row = height - 1; row >= 0; --row)
  {
    for (vtkIdType column = 0; column < width; ++column)
    {
      const double value = tuples[row * width + column][channel.Component];
      target.push_back(static_cast<T>(value));
    }
  }
}

//------------------------------------------------------------------------------
const void* FillChannel(ChannelData& channel, vtkIdType width)
{
  switch (channel.Type)
  {
    case Imf::HALF:
      CopyComponent(channel, width, channel.Halves);
      return channel.Halves.data();
    case Imf::UINT:
      CopyComponent(channel, width, channel.Integers);
      return channel.Integers.data();
    default:
      CopyComponent(channel, width, channel.Floats);
      return channel.Floats.data();
  }
}

//------------------------------------------------------------------------------
Imath::Box2i GetDisplayWindow(vtkImageData* image, const Imath::Box2i& dataWindow)
{
  vtkDataArray* array = image->GetFieldData()->GetArray("DisplayWindow");
  if (!array || array->GetNumberOfValues() != 4)
  {
    return dataWindow;
  }
  const auto values = vtk::DataArrayValueRange(array);
  const auto value = [&](int i) { return static_cast<int>(values[i]); };
  const Imath::Box2i window({ value(0), value(2) }, { value(1), value(3) });
  return window.isEmpty() ? dataWindow : window;
}

//------------------------------------------------------------------------------
void WriteImage(vtkImageData* image, const std::string& fileName, Imf::PixelType type,
  int compression)
{
  int extent[6];
  image->GetExtent(extent);
  const Imath::Box2i window({ extent[0], extent[2] }, { extent[1], extent[3] });
  Imf::Header header(GetDisplayWindow(image, window), window);
  header.compression() = static_cast<Imf::Compression>(compression);
  Imf::FrameBuffer source;
  std::vector<ChannelData> channels = ListChannels(image, type);
  const vtkIdType width = vtkIdType(extent[1]) - extent[0] + 1;
  for (ChannelData& channel : channels)
  {
    const std::size_t step = channel.Type == Imf::HALF ? 2 : 4;
    header.channels().insert(channel.Name, Imf::Channel(channel.Type));
    const void* values = FillChannel(channel, width);
    source.insert(channel.Name, Imf::Slice::Make(channel.Type, values, window, step, step * width));
  }
  Imf::OutputFile file(fileName.c_str(), header);
  file.setFrameBuffer(source);
  file.writePixels(extent[3] - extent[2] + 1);
}

//------------------------------------------------------------------------------
bool ExceedsHalf(const ChannelData& channel)
{
  const auto tuples = vtk::DataArrayTupleRange(channel.Source);
  return std::any_of(tuples.begin(), tuples.end(),
    [&](const auto& tuple)
    {
      const double value = std::abs(static_cast<double>(tuple[channel.Component]));
      return std::isfinite(value) && value > LargestHalf;
    });
}
} // namespace

//------------------------------------------------------------------------------
vtkOpenEXRWriter::vtkOpenEXRWriter() = default;

//------------------------------------------------------------------------------
vtkOpenEXRWriter::~vtkOpenEXRWriter()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
int vtkOpenEXRWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
std::string vtkOpenEXRWriter::FindProblem(vtkImageData* image)
{
  int extent[6];
  image->GetExtent(extent);
  if (image->GetNumberOfPoints() == 0)
  {
    return "the image is empty";
  }
  if (extent[4] != extent[5])
  {
    return "the image has several slices; an OpenEXR file holds one in the xy plane";
  }
  const std::vector<ChannelData> channels =
    ListChannels(image, this->PixelType == PIXEL_TYPE_HALF ? Imf::HALF : Imf::FLOAT);
  if (channels.empty())
  {
    return "the image has no numeric point array";
  }
  std::set<std::string> names;
  for (const ChannelData& channel : channels)
  {
    if (channel.Name.empty() || channel.Name.size() > 255)
    {
      return "a point array's name is missing or longer than 255 characters; rename it";
    }
    if (!names.insert(channel.Name).second)
    {
      return "two arrays would both be written as channel \"" + channel.Name + "\"; rename one";
    }
    if (channel.Type == Imf::HALF && ExceedsHalf(channel))
    {
      return "channel \"" + channel.Name +
        "\" has values above 65504, which half pixels cannot hold; use float pixels";
    }
  }
  return std::string();
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::WriteData()
{
  const auto fail = [this](unsigned long code, const std::string& problem)
  {
    this->SetErrorCode(code);
    vtkErrorMacro("Cannot write the OpenEXR file \"" << (this->FileName ? this->FileName : "")
                                                     << "\": " << problem << '.');
  };
  if (!this->FileName || !*this->FileName)
  {
    fail(vtkErrorCode::NoFileNameError, "no file name is set; call SetFileName first");
    return;
  }
  vtkImageData* image = vtkImageData::SafeDownCast(this->GetInput());
  const std::string problem = image ? this->FindProblem(image) : "the input is not an image";
  if (!problem.empty())
  {
    fail(vtkErrorCode::FileFormatError, problem);
    return;
  }
  const std::filesystem::path target(this->FileName);
  const std::filesystem::path unfinished(target.string() + ".part");
  try
  {
    WriteImage(image, unfinished.string(),
      this->PixelType == PIXEL_TYPE_HALF ? Imf::HALF : Imf::FLOAT, this->Compression);
    std::filesystem::rename(unfinished, target);
  }
  catch (const std::exception& exception)
  {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    fail(vtkErrorCode::CannotOpenFileError, exception.what());
  }
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n';
  os << indent << "PixelType: " << this->PixelType << '\n';
  os << indent << "Compression: " << this->Compression << '\n';
}
