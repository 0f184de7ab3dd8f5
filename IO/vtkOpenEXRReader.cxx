// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenEXRReader.h"

#include "vtkOpenEXRFileCheck.h"

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
#include <ImfInputFile.h>

#include <algorithm>
#include <exception>
#include <set>
#include <string>
#include <vector>

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
void AddDisplayWindow(vtkImageData* output, const Imath::Box2i& window)
{
  vtkNew<vtkIntArray> array;
  array->SetName("DisplayWindow");
  array->SetNumberOfComponents(4);
  const int values[4] = { window.min.x, window.max.x, window.min.y, window.max.y };
  array->InsertNextTypedTuple(values);
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
  return fileName && vtkOpenEXRFileCheck::HasMagicNumber(fileName) ? 3 : 0;
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
  using vtkOpenEXRFileCheck::Fault;
  switch (vtkOpenEXRFileCheck::Find(this->FileName, problem))
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
  if (!this->CheckFile())
  {
    return 0;
  }
  try
  {
    const Imf::InputFile file(this->FileName);
    const Imath::Box2i& data = file.header().dataWindow();
    const Imath::Box2i& display = file.header().displayWindow();
    const std::vector<ArrayLayout> arrays = GroupChannels(file.header().channels());
    const ArrayLayout& scalars = FindScalars(arrays);
    const int extent[6] = { data.min.x, data.max.x, data.min.y, data.max.y, 0, 0 };
    const double lift = (double(display.min.y) + display.max.y) - (double(data.min.y) + data.max.y);
    const double origin[3] = { 0.0, lift, 0.0 };
    const double spacing[3] = { 1.0, 1.0, 1.0 };
    vtkInformation* info = outputs->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    info->Set(vtkDataObject::ORIGIN(), origin, 3);
    info->Set(vtkDataObject::SPACING(), spacing, 3);
    const bool integers = FindType(file.header().channels(), scalars) == Imf::UINT;
    this->DataScalarType = integers ? VTK_UNSIGNED_INT : VTK_FLOAT;
    this->NumberOfScalarComponents = static_cast<int>(scalars.Channels.size());
    std::copy_n(extent, 6, this->DataExtent);
    std::copy_n(origin, 3, this->DataOrigin);
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
    Imf::InputFile file(this->FileName);
    const Imf::Header& header = file.header();
    const Imath::Box2i& window = header.dataWindow();
    const std::vector<ArrayLayout> layouts = GroupChannels(header.channels());
    Imf::FrameBuffer target;
    std::vector<vtkSmartPointer<vtkDataArray>> arrays;
    for (const ArrayLayout& layout : layouts)
    {
      arrays.push_back(MakeArray(layout, FindType(header.channels(), layout), window, target));
    }
    file.setFrameBuffer(target);
    const vtkIdType height = vtkIdType(window.max.y) - window.min.y + 1;
    // DWAB, the tallest chunk, has 256 lines: no chunk is decoded twice.
    constexpr vtkIdType block = 256;
    for (vtkIdType row = 0; row < height && !this->AbortExecute; row += block)
    {
      const vtkIdType last = std::min(row + block, height) - 1;
      file.readPixels(static_cast<int>(window.min.y + row), static_cast<int>(window.min.y + last));
      this->UpdateProgress(static_cast<double>(last + 1) / static_cast<double>(height));
    }
    output->SetExtent(window.min.x, window.max.x, window.min.y, window.max.y, 0, 0);
    output->SetOrigin(this->DataOrigin);
    output->SetSpacing(1.0, 1.0, 1.0);
    for (vtkDataArray* array : arrays)
    {
      TurnRows(array, height);
      output->GetPointData()->AddArray(array);
    }
    output->GetPointData()->SetActiveScalars(FindScalars(layouts).Name.c_str());
    AddDisplayWindow(output, header.displayWindow());
  }
  catch (const std::exception& exception)
  {
    output->Initialize();
    return this->Fail(vtkErrorCode::FileFormatError, exception.what());
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkOpenEXRReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
