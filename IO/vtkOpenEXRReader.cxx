// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenEXRReader.h"

#include "Files/ChannelGroups.h"
#include "Files/CodecMemory.h"
#include "Files/LuminanceChroma.h"
#include "Files/OpenEXRFileCheck.h"
#include "Shared/ArrayNames.h"
#include "Shared/FieldValues.h"
#include "Shared/FilterMonitor.h"
#include "Shared/TransportMemory.h"
#include "Shared/ZeroedArray.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
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
#include "vtkStringArray.h"
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
#include <map>
#include <new>
#include <optional>
#include <string>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenEXRReader);

namespace
{
constexpr std::size_t BytesPerValue = 4;
constexpr double BytesPerMiB = 1048576.0;
static_assert(sizeof(float) == BytesPerValue && sizeof(unsigned int) == BytesPerValue,
  "OpenEXR's float and unsigned integer pixels are read in place");

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataArray> NewArray(Imf::PixelType type)
{
  if (type == Imf::UINT)
  {
    return vtkSmartPointer<vtkUnsignedIntArray>::New();
  }
  return vtkSmartPointer<vtkFloatArray>::New();
}

//------------------------------------------------------------------------------
// An array for the group's values, all 0.
vtkSmartPointer<vtkDataArray> MakeArray(const ChannelGroup& group, const Imath::Box2i& window)
{
  const vtkIdType width = vtkIdType(window.max.x) - window.min.x + 1;
  const vtkIdType height = vtkIdType(window.max.y) - window.min.y + 1;
  vtkSmartPointer<vtkDataArray> array = NewArray(group.Type);
  array->SetName(group.Name.c_str());
  array->SetNumberOfComponents(static_cast<int>(group.Channels.size()));
  ZeroedArray::Fill(array, width * height);
  return array;
}

//------------------------------------------------------------------------------
// Has the array's values read in place.
void AddSlices(const ChannelGroup& group, const Imath::Box2i& window, vtkDataArray* array,
  Imf::FrameBuffer& target)
{
  const std::size_t step = group.Channels.size() * BytesPerValue;
  const std::size_t width = static_cast<std::size_t>(vtkIdType(window.max.x) - window.min.x + 1);
  for (std::size_t component = 0; component < group.Channels.size(); ++component)
  {
    void* first = array->GetVoidPointer(static_cast<vtkIdType>(component));
    target.insert(group.Channels[component],
      Imf::Slice::Make(group.Type, first, window, step, step * width));
  }
}

//------------------------------------------------------------------------------
// Of the chroma, RY and BY, alike; of no other channel.
Outcome CheckSampling(const Imf::ChannelList& channels, const std::vector<ChannelGroup>& groups)
{
  for (const ChannelGroup& group : groups)
  {
    const bool chroma = group.Kind == ChannelGroup::Meaning::LuminanceChroma;
    const Imf::Channel& first = *channels.findChannel(group.Channels.front());
    for (std::size_t i = 0; i < group.Channels.size(); ++i)
    {
      const Imf::Channel& channel = *channels.findChannel(group.Channels[i]);
      const bool whole = channel.xSampling == 1 && channel.ySampling == 1;
      const bool half = channel.xSampling == 2 && channel.ySampling == 2;
      const bool asFirst =
        channel.xSampling == first.xSampling && channel.ySampling == first.ySampling;
      if (!(chroma && i % 2 == 0 && i < 3 ? (whole || half) && asFirst : whole))
      {
        return Outcome::Failed("channel \"" + group.Channels[i] +
          "\" is subsampled; save the image with full-size channels");
      }
    }
  }
  return Outcome::Done();
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
// One part of a file, of lines or tiles, and its levels.
class Image
{
public:
  Image(const char* fileName, int part) : File(fileName), Part(part)
  {
    const Imf::Header& header = this->GetHeader();
    if (header.hasType() && header.type() == Imf::TILEDIMAGE)
    {
      this->Tiles.emplace(this->File, part);
    }
    else
    {
      this->Lines.emplace(this->File, part);
    }
  }

  const Imf::Header& GetHeader() const { return this->File.header(this->Part); }

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

  /// What an abort leaves unread stays as it is in the target.
  void Read(int level, const Imf::FrameBuffer& target, const Monitor& monitor)
  {
    if (this->Tiles)
    {
      this->ReadTiles(this->GetXLevel(level), this->GetYLevel(level), target, monitor);
    }
    else
    {
      this->ReadLines(target, monitor);
    }
  }

private:
  // Of a ripmap those levels are taken that a mipmap would have.
  int GetXLevel(int level) const { return std::min(level, this->Tiles->numXLevels() - 1); }
  int GetYLevel(int level) const { return std::min(level, this->Tiles->numYLevels() - 1); }

  void ReadTiles(int xLevel, int yLevel, const Imf::FrameBuffer& target, const Monitor& monitor)
  {
    this->Tiles->setFrameBuffer(target);
    const int rows = this->Tiles->numYTiles(yLevel);
    const int last = this->Tiles->numXTiles(xLevel) - 1;
    bool goesOn = true;
    for (int row = 0; row < rows && goesOn; ++row)
    {
      this->Tiles->readTiles(0, last, row, row, xLevel, yLevel);
      goesOn = monitor.Report(static_cast<double>(row + 1) / rows);
    }
  }

  void ReadLines(const Imf::FrameBuffer& target, const Monitor& monitor)
  {
    this->Lines->setFrameBuffer(target);
    const Imath::Box2i& window = this->GetHeader().dataWindow();
    const int height = window.max.y - window.min.y + 1;
    // DWAB, the tallest chunk, has 256 lines: no chunk is decoded twice.
    constexpr int block = 256;
    bool goesOn = true;
    for (int row = 0; row < height && goesOn; row += block)
    {
      const int last = std::min(row + block, height) - 1;
      this->Lines->readPixels(window.min.y + row, window.min.y + last);
      goesOn = monitor.Report(static_cast<double>(last + 1) / height);
    }
  }

  Imf::MultiPartInputFile File;
  int Part;
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
std::string vtkOpenEXRReader::GetPartName(int part) const
{
  const bool there = part >= 0 && part < this->GetNumberOfParts();
  return there ? this->PartNames[static_cast<std::size_t>(part)] : std::string();
}

//------------------------------------------------------------------------------
Outcome vtkOpenEXRReader::Fail(unsigned long errorCode, const std::string& problem)
{
  this->SetErrorCode(errorCode);
  return Outcome::Failed(problem);
}

//------------------------------------------------------------------------------
int vtkOpenEXRReader::Finish(const Outcome& outcome)
{
  if (outcome.HasFailed())
  {
    vtkErrorMacro("Cannot read the OpenEXR file \"" << (this->FileName ? this->FileName : "")
                                                    << "\": " << outcome.GetMessage() << '.');
    return 0;
  }
  return 1;
}

//------------------------------------------------------------------------------
Outcome vtkOpenEXRReader::CheckFile()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  this->PartNames.clear();
  if (!this->FileName || !*this->FileName)
  {
    return this->Fail(vtkErrorCode::NoFileNameError, "no file name is set; call SetFileName first");
  }
  using OpenEXRFileCheck::Fault;
  OpenEXRFileCheck::Findings findings;
  Outcome checked = OpenEXRFileCheck::Check(this->FileName,
    { this->Part, this->Level, BytesPerMiB * this->MemoryLimit }, findings);
  this->PartNames = findings.PartNames;
  switch (findings.Kind)
  {
    case Fault::None:
      return checked;
    case Fault::CannotOpen:
      return this->Fail(vtkErrorCode::CannotOpenFileError, checked.GetMessage());
    case Fault::NotOpenEXR:
      return this->Fail(vtkErrorCode::UnrecognizedFileTypeError, checked.GetMessage());
    case Fault::Truncated:
      return this->Fail(vtkErrorCode::PrematureEndOfFileError, checked.GetMessage());
    case Fault::NoSuchPart:
      return this->Fail(vtkErrorCode::UserError, checked.GetMessage());
    case Fault::TooLarge:
      return this->Fail(vtkErrorCode::UnknownError, checked.GetMessage());
    default:
      return this->Fail(vtkErrorCode::FileFormatError, checked.GetMessage());
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
  vtkInformation* info = outputs->GetInformationObject(0);
  return this->Finish(this->Try(&vtkOpenEXRReader::ReadHeader, info));
}

//------------------------------------------------------------------------------
// The border to OpenEXR: what it throws becomes a failure.
template <typename Target>
Outcome vtkOpenEXRReader::Try(Outcome (vtkOpenEXRReader::*read)(Target*), Target* target)
{
  try
  {
    Outcome checked = this->CheckFile();
    return checked ? (this->*read)(target) : checked;
  }
  catch (const std::bad_alloc&)
  {
    return this->Fail(vtkErrorCode::UnknownError,
      "there is not enough memory for its pixels; read it on a machine with more");
  }
  catch (const std::exception& exception)
  {
    return this->Fail(vtkErrorCode::FileFormatError, exception.what());
  }
}

//------------------------------------------------------------------------------
Outcome vtkOpenEXRReader::ReadHeader(vtkInformation* info)
{
  const Image image(this->FileName, this->Part);
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
  const double lift = (double(display.min.y) + display.max.y) - (double(whole.min.y) + whole.max.y);
  const std::array<int, 6> extent = GetExtent(window);
  double origin[3] = { 0.0, 0.0, 0.0 };
  double spacing[3] = { 1.0, 1.0, 1.0 };
  PlaceLevel(whole.min.x, whole.size().x + 1.0, window.size().x + 1.0, 0.0, origin[0], spacing[0]);
  PlaceLevel(whole.min.y, whole.size().y + 1.0, window.size().y + 1.0, lift, origin[1], spacing[1]);
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent.data(), 6);
  info->Set(vtkDataObject::ORIGIN(), origin, 3);
  info->Set(vtkDataObject::SPACING(), spacing, 3);
  const std::vector<ChannelGroup> groups = ChannelGroups::Find(header);
  if (Outcome checked = CheckSampling(header.channels(), groups); !checked)
  {
    return this->Fail(vtkErrorCode::FileFormatError, checked.GetMessage());
  }
  const auto scalars = std::find_if(groups.begin(), groups.end(),
    [](const ChannelGroup& group) { return group.IsScalars; });
  this->DataScalarType = scalars->Type == Imf::UINT ? VTK_UNSIGNED_INT : VTK_FLOAT;
  this->NumberOfScalarComponents = static_cast<int>(scalars->Channels.size());
  std::copy_n(extent.data(), 6, this->DataExtent);
  std::copy_n(origin, 3, this->DataOrigin);
  std::copy_n(spacing, 3, this->DataSpacing);
  vtkDataObject::SetPointDataActiveScalarInfo(info, this->DataScalarType,
    this->NumberOfScalarComponents);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
int vtkOpenEXRReader::RequestData(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs);
  const Outcome outcome = this->Try(&vtkOpenEXRReader::ReadLevel, output);
  if (!outcome)
  {
    output->Initialize();
  }
  return this->Finish(outcome);
}

//------------------------------------------------------------------------------
Outcome vtkOpenEXRReader::ReadLevel(vtkImageData* output)
{
  Image image(this->FileName, this->Part);
  const Imf::Header& header = image.GetHeader();
  const Imath::Box2i window = image.GetWindow(this->Level);
  const std::vector<ChannelGroup> groups = ChannelGroups::Find(header);
  if (Outcome checked = CheckSampling(header.channels(), groups); !checked)
  {
    return this->Fail(vtkErrorCode::FileFormatError, checked.GetMessage());
  }
  Imf::FrameBuffer target;
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  std::map<std::size_t, LuminanceChroma> converted;
  for (const ChannelGroup& group : groups)
  {
    arrays.push_back(MakeArray(group, window));
    if (group.Kind == ChannelGroup::Meaning::LuminanceChroma)
    {
      converted.try_emplace(arrays.size() - 1, header, group, window, target);
    }
    else
    {
      AddSlices(group, window, arrays.back(), target);
    }
  }
  CodecMemory::Require(header);
  image.Read(this->Level, target, MakeFilterMonitor(this));
  for (auto& [index, pixels] : converted)
  {
    pixels.Convert(static_cast<float*>(arrays[index]->GetVoidPointer(0)));
  }
  TransportMemory::RequireMargin();
  output->SetExtent(GetExtent(window).data());
  output->SetOrigin(this->DataOrigin);
  output->SetSpacing(this->DataSpacing);
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    TurnRows(arrays[i], vtkIdType(window.max.y) - window.min.y + 1);
    output->GetPointData()->AddArray(arrays[i]);
    if (groups[i].IsScalars)
    {
      output->GetPointData()->SetActiveScalars(groups[i].Name.c_str());
    }
  }
  const Imath::Box2i& display = header.displayWindow();
  const int corners[4] = { display.min.x, display.max.x, display.min.y, display.max.y };
  this->AddFields(corners, output->GetFieldData());
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void vtkOpenEXRReader::AddFields(const int display[4], vtkFieldData* fields)
{
  FieldValues::AddAs<vtkIntArray>(fields, ArrayNames::DisplayWindow,
    { display[0], display[1], display[2], display[3] });
  FieldValues::AddAs<vtkIntArray>(fields, "NumberOfLevels", { this->NumberOfLevels });
  FieldValues::AddAs<vtkIntArray>(fields, "Level", { this->Level });
  FieldValues::AddAs<vtkIntArray>(fields, "NumberOfParts", { this->GetNumberOfParts() });
  FieldValues::AddAs<vtkIntArray>(fields, "Part", { this->Part });
  vtkNew<vtkStringArray> names;
  names->SetName("PartNames");
  for (const std::string& name : this->PartNames)
  {
    names->InsertNextValue(name);
  }
  fields->AddArray(names);
}

//------------------------------------------------------------------------------
void vtkOpenEXRReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Level: " << this->Level << '\n';
  os << indent << "NumberOfLevels: " << this->NumberOfLevels << '\n';
  os << indent << "Part: " << this->Part << '\n';
  os << indent << "NumberOfParts: " << this->GetNumberOfParts() << '\n';
  os << indent << "MemoryLimit: " << this->MemoryLimit << '\n';
}
