// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenEXRReader.h"

#include "Files/OpenEXRFileCheck.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedIntArray.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfTiledInputPart.h>

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenEXRReader);

namespace
{
constexpr std::size_t BytesPerValue = 4;
static_assert(sizeof(float) == BytesPerValue && sizeof(unsigned int) == BytesPerValue,
  "OpenEXR's float and unsigned integer pixels are read in place");

// One array of the output and the channels that are its components.
struct ArrayLayout
{
  std::string Name;
  std::vector<std::string> Channels;
};

//------------------------------------------------------------------------------
// Layers ("" or "name.") in which some channels lie.
std::set<std::string> FindLayers(const std::set<std::string>& channels)
{
  std::set<std::string> layers{ "" };
  for (const std::string& channel : channels)
  {
    const std::size_t dot = channel.rfind('.');
    if (dot != std::string::npos && dot > 0)
    {
      layers.insert(channel.substr(0, dot + 1));
    }
  }
  return layers;
}

//------------------------------------------------------------------------------
// The channels of a layer that make one array; empty where they do not.
std::vector<std::string> FindGroup(const std::set<std::string>& channels, const std::string& layer,
  bool colors)
{
  std::vector<std::string> group;
  const auto add = [&](const std::string& suffix)
  {
    const bool found = channels.count(layer + suffix) != 0;
    if (found)
    {
      group.push_back(layer + suffix);
    }
    return found;
  };
  if (colors)
  {
    if (!(add("R") && add("G") && add("B")))
    {
      return {};
    }
    add("A");
    return group;
  }
  while (add(std::to_string(group.size())))
  {
  }
  return group.size() > 1 && !layer.empty() ? group : std::vector<std::string>();
}

//------------------------------------------------------------------------------
std::vector<ArrayLayout> GroupChannels(const Imf::ChannelList& list)
{
  std::set<std::string> channels;
  for (auto it = list.begin(); it != list.end(); ++it)
  {
    channels.insert(it.name());
  }
  std::vector<ArrayLayout> arrays;
  std::set<std::string> names = channels;
  for (const std::string& layer : FindLayers(channels))
  {
    for (const bool colors : { true, false })
    {
      const std::vector<std::string> group = FindGroup(channels, layer, colors);
      std::string name = layer.substr(0, layer.empty() ? 0 : layer.size() - 1);
      if (name.empty())
      {
        name = group.size() == 4 ? "RGBA" : "RGB";
      }
      if (!group.empty() && names.insert(name).second)
      {
        arrays.push_back({ name, group });
        for (const std::string& channel : group)
        {
          channels.erase(channel);
        }
      }
    }
  }
  for (const std::string& channel : channels)
  {
    arrays.push_back({ channel, { channel } });
  }
  return arrays;
}

//------------------------------------------------------------------------------
const ArrayLayout& FindScalars(const std::vector<ArrayLayout>& arrays)
{
  for (const char* name : { "RGBA", "RGB", "Y" })
  {
    const auto found = std::find_if(arrays.begin(), arrays.end(),
      [&](const ArrayLayout& array) { return array.Name == name; });
    if (found != arrays.end())
    {
      return *found;
    }
  }
  return arrays.front();
}

//------------------------------------------------------------------------------
Imf::PixelType FindType(const Imf::ChannelList& list, const ArrayLayout& layout)
{
  const bool integers = std::all_of(layout.Channels.begin(), layout.Channels.end(),
    [&](const std::string& channel) { return list.findChannel(channel)->type == Imf::UINT; });
  return integers ? Imf::UINT : Imf::FLOAT;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataArray> MakeArray(const ArrayLayout& layout, Imf::PixelType type,
  const Imath::Box2i& window, Imf::FrameBuffer& target)
{
  const int components = static_cast<int>(layout.Channels.size());
  const vtkIdType width = vtkIdType(window.max.x) - window.min.x + 1;
  const vtkIdType height = vtkIdType(window.max.y) - window.min.y + 1;
  vtkSmartPointer<vtkDataArray> array;
  if (type == Imf::UINT)
  {
    array = vtkSmartPointer<vtkUnsignedIntArray>::New();
  }
  else
  {
    array = vtkSmartPointer<vtkFloatArray>::New();
  }
  array->SetName(layout.Name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(width * height);
  const std::size_t step = components * BytesPerValue;
  for (int component = 0; component < components; ++component)
  {
    target.insert(layout.Channels[component],
      Imf::Slice::Make(type, array->GetVoidPointer(component), window, step, step * width));
  }
  return array;
}

//------------------------------------------------------------------------------
// The first row of the file is the top one; VTK's first row is the bottom one.
void TurnRows(vtkDataArray* array, vtkIdType height)
{
  const std::size_t rowBytes =
    array->GetNumberOfValues() / static_cast<std::size_t>(height) * BytesPerValue;
  char* const data = static_cast<char*>(array->GetVoidPointer(0));
  for (vtkIdType row = 0; row < height / 2; ++row)
  {
    char* const lower = data + row * rowBytes;
    std::swap_ranges(lower, lower + rowBytes, data + (height - 1 - row) * rowBytes);
  }
}

//------------------------------------------------------------------------------
// The first part of a file, of lines or tiles, and its levels.
class Image
{
public:
  explicit Image(const char* fileName) : File(fileName)
  {
    const Imf::Header& header = this->GetHeader();
    if (header.hasType() && header.type() == Imf::TILEDIMAGE)
    {
      this->Tiles.emplace(this->File, 0);
    }
    else
    {
      this->Lines.emplace(this->File, 0);
    }
  }

  const Imf::Header& GetHeader() const { return this->File.header(0); }

  int GetNumberOfLevels() const
  {
    return this->Tiles ? std::max(this->Tiles->numXLevels(), this->Tiles->numYLevels()) : 1;
  }

  Imath::Box2i GetWindow(int level) const
  {
    return this->Tiles
      ? this->Tiles->dataWindowForLevel(this->GetXLevel(level), this->GetYLevel(level))
      : this->GetHeader().dataWindow();
  }

  /// `advance` takes the fraction that is done and gives false to stop.
  template <typename Advance>
  void Read(int level, const Imf::FrameBuffer& target, Advance advance)
  {
    if (this->Tiles)
    {
      this->ReadTiles(this->GetXLevel(level), this->GetYLevel(level), target, advance);
    }
    else
    {
      this->ReadLines(target, advance);
    }
  }

private:
  // Of a ripmap those levels are taken that a mipmap would have.
  int GetXLevel(int level) const { return std::min(level, this->Tiles->numXLevels() - 1); }
  int GetYLevel(int level) const { return std::min(level, this->Tiles->numYLevels() - 1); }

  template <typename Advance>
  void ReadTiles(int xLevel, int yLevel, const Imf::FrameBuffer& target, Advance advance)
  {
    this->Tiles->setFrameBuffer(target);
    const int rows = this->Tiles->numYTiles(yLevel);
    const int last = this->Tiles->numXTiles(xLevel) - 1;
    bool goOn = true;
    for (int row = 0; row < rows && goOn; ++row)
    {
      this->Tiles->readTiles(0, last, row, row, xLevel, yLevel);
      goOn = advance(static_cast<double>(row + 1) / rows);
    }
  }

  template <typename Advance>
  void ReadLines(const Imf::FrameBuffer& target, Advance advance)
  {
    this->Lines->setFrameBuffer(target);
    const Imath::Box2i& window = this->GetHeader().dataWindow();
    const int height = window.max.y - window.min.y + 1;
    // DWAB, the tallest chunk, has 256 lines: no chunk is decoded twice.
    constexpr int block = 256;
    bool goOn = true;
    for (int row = 0; row < height && goOn; row += block)
    {
      const int last = std::min(row + block, height) - 1;
      this->Lines->readPixels(window.min.y + row, window.min.y + last);
      goOn = advance(static_cast<double>(last + 1) / height);
    }
  }

  Imf::MultiPartInputFile File;
  std::optional<Imf::InputPart> Lines;
  std::optional<Imf::TiledInputPart> Tiles;
};

//------------------------------------------------------------------------------
std::array<int, 6> GetExtent(const Imath::Box2i& window)
{
  return { window.min.x, window.max.x, window.min.y, window.max.y, 0, 0 };
}

//------------------------------------------------------------------------------
// Origin and spacing in one direction: a level of `count` texels covers what the `wholeCount` of
// level 0 do, which lie at begin + offset, begin + 1 + offset and so on.
void PlaceLevel(int begin, double wholeCount, double count, double offset, double& origin,
  double& spacing)
{
  spacing = wholeCount / count;
  origin = offset + begin - 0.5 + (0.5 - begin) * spacing;
}

//------------------------------------------------------------------------------
void AddDisplayWindow(vtkImageData* output, const Imath::Box2i& window)
{
  vtkNew<vtkIntArray> array;
  array->SetName("DisplayWindow");
  array->SetNumberOfComponents(4);
  const int values[4] = { window.min.x, window.max.x, window.min.y, window.max.y };
  array->InsertNextTypedTuple(values);
  output->GetFieldData()->AddArray(array);
}

//------------------------------------------------------------------------------
void AddNumber(vtkImageData* output, const char* name, int value)
{
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  output->GetFieldData()->AddArray(array);
}
} // namespace

//------------------------------------------------------------------------------
vtkOpenEXRReader::vtkOpenEXRReader()
{
  this->FileDimensionality = 2;
}

//------------------------------------------------------------------------------
vtkOpenEXRReader::~vtkOpenEXRReader() = default;

//------------------------------------------------------------------------------
int vtkOpenEXRReader::CanReadFile(const char* fileName)
{
  return fileName && OpenEXRFileCheck::HasMagicNumber(fileName) ? 3 : 0;
}

//------------------------------------------------------------------------------
bool vtkOpenEXRReader::Fail(unsigned long errorCode, const std::string& problem)
{
  this->SetErrorCode(errorCode);
  vtkErrorMacro("Cannot read the OpenEXR file \"" << (this->FileName ? this->FileName : "")
                                                  << "\": " << problem << '.');
  return false;
}

//------------------------------------------------------------------------------
bool vtkOpenEXRReader::CheckFile()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->FileName || !*this->FileName)
  {
    return this->Fail(vtkErrorCode::NoFileNameError, "no file name is set; call SetFileName first");
  }
  std::string problem;
  using OpenEXRFileCheck::Fault;
  switch (OpenEXRFileCheck::Find(this->FileName, problem))
  {
    case Fault::None:
      return true;
    case Fault::CannotOpen:
      return this->Fail(vtkErrorCode::CannotOpenFileError, problem);
    case Fault::NotOpenEXR:
      return this->Fail(vtkErrorCode::UnrecognizedFileTypeError, problem);
    case Fault::Truncated:
      return this->Fail(vtkErrorCode::PrematureEndOfFileError, problem);
    default:
      return this->Fail(vtkErrorCode::FileFormatError, problem);
  }
}

//------------------------------------------------------------------------------
int vtkOpenEXRReader::RequestInformation(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputs)
{
  if (vtkImageData* output = vtkImageData::GetData(outputs))
  {
    output->Initialize();
  }
  this->NumberOfLevels = 0;
  if (!this->CheckFile())
  {
    return 0;
  }
  try
  {
    const Image image(this->FileName);
    const Imf::Header& header = image.GetHeader();
    const int levels = image.GetNumberOfLevels();
    this->NumberOfLevels = levels;
    if (this->Level >= levels)
    {
      return this->Fail(vtkErrorCode::UserError,
        "level " + std::to_string(this->Level) + " is wanted, but the last one is level " +
          std::to_string(levels - 1));
    }
    const Imath::Box2i& whole = header.dataWindow();
    const Imath::Box2i& display = header.displayWindow();
    const Imath::Box2i window = image.GetWindow(this->Level);
    const double lift =
      (double(display.min.y) + display.max.y) - (double(whole.min.y) + whole.max.y);
    const std::array<int, 6> extent = GetExtent(window);
    double origin[3] = { 0.0, 0.0, 0.0 };
    double spacing[3] = { 1.0, 1.0, 1.0 };
    PlaceLevel(whole.min.x, whole.size().x + 1.0, window.size().x + 1.0, 0.0, origin[0],
      spacing[0]);
    PlaceLevel(whole.min.y, whole.size().y + 1.0, window.size().y + 1.0, lift, origin[1],
      spacing[1]);
    vtkInformation* info = outputs->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent.data(), 6);
    info->Set(vtkDataObject::ORIGIN(), origin, 3);
    info->Set(vtkDataObject::SPACING(), spacing, 3);
    const std::vector<ArrayLayout> arrays = GroupChannels(header.channels());
    const ArrayLayout& scalars = FindScalars(arrays);
    const bool integers = FindType(header.channels(), scalars) == Imf::UINT;
    this->DataScalarType = integers ? VTK_UNSIGNED_INT : VTK_FLOAT;
    this->NumberOfScalarComponents = static_cast<int>(scalars.Channels.size());
    std::copy_n(extent.data(), 6, this->DataExtent);
    std::copy_n(origin, 3, this->DataOrigin);
    std::copy_n(spacing, 3, this->DataSpacing);
    vtkDataObject::SetPointDataActiveScalarInfo(info, this->DataScalarType,
      this->NumberOfScalarComponents);
  }
  catch (const std::exception& exception)
  {
    return this->Fail(vtkErrorCode::FileFormatError, exception.what());
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkOpenEXRReader::ReadLevel(vtkImageData* output)
{
  Image image(this->FileName);
  const Imf::Header& header = image.GetHeader();
  const Imath::Box2i window = image.GetWindow(this->Level);
  const std::vector<ArrayLayout> layouts = GroupChannels(header.channels());
  Imf::FrameBuffer target;
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  for (const ArrayLayout& layout : layouts)
  {
    arrays.push_back(MakeArray(layout, FindType(header.channels(), layout), window, target));
  }
  image.Read(this->Level, target,
    [this](double done)
    {
      this->UpdateProgress(done);
      return !this->AbortExecute;
    });
  output->SetExtent(GetExtent(window).data());
  output->SetOrigin(this->DataOrigin);
  output->SetSpacing(this->DataSpacing);
  for (vtkDataArray* array : arrays)
  {
    TurnRows(array, vtkIdType(window.max.y) - window.min.y + 1);
    output->GetPointData()->AddArray(array);
  }
  output->GetPointData()->SetActiveScalars(FindScalars(layouts).Name.c_str());
  AddDisplayWindow(output, header.displayWindow());
  AddNumber(output, "NumberOfLevels", image.GetNumberOfLevels());
  AddNumber(output, "Level", this->Level);
}

//------------------------------------------------------------------------------
int vtkOpenEXRReader::RequestData(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs);
  if (!this->CheckFile())
  {
    return 0;
  }
  try
  {
    this->ReadLevel(output);
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    this->Fail(vtkErrorCode::UnknownError, "there is not enough memory for its pixels");
  }
  catch (const std::exception& exception)
  {
    this->Fail(vtkErrorCode::FileFormatError, exception.what());
  }
  output->Initialize();
  return 0;
}

//------------------------------------------------------------------------------
void vtkOpenEXRReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Level: " << this->Level << '\n';
  os << indent << "NumberOfLevels: " << this->NumberOfLevels << '\n';
}
