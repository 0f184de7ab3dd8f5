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

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfTiledOutputFile.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkOpenEXRWriter);

namespace
{
constexpr double LargestHalf = 65504.0;
// Beyond these some integers fall between two numbers.
constexpr double LargestHalfInteger = 2048.0;
constexpr double LargestFloatInteger = 16777216.0;

// What the disk, and not the image, is to blame for.
struct DiskError : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

struct Size
{
  vtkIdType Width = 0;
  vtkIdType Height = 0;

  Size GetHalf() const
  {
    return { std::max<vtkIdType>(this->Width / 2, 1), std::max<vtkIdType>(this->Height / 2, 1) };
  }
};

// How a texel of a mip level comes from those below it.
enum class Reduction
{
  Mean,
  WeightedMean,
  First
};

// One channel of the file: a component of an array.
struct Channel
{
  std::string Name;
  Imf::PixelType Type = Imf::FLOAT;
  vtkDataArray* Source = nullptr;
  int Component = 0;
  Reduction Rule = Reduction::Mean;
};

// A channel's values as the file has them: its type, its order of rows.
struct StoredChannel
{
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
bool HoldsIntegers(vtkDataArray* array)
{
  return array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE;
}

//------------------------------------------------------------------------------
// The largest finite magnitude.
double GetMagnitude(const Channel& channel)
{
  double range[2];
  channel.Source->GetFiniteRange(range, channel.Component);
  return range[0] > range[1] ? 0.0 : std::max(std::abs(range[0]), std::abs(range[1]));
}

//------------------------------------------------------------------------------
Imf::PixelType FindType(const Channel& channel, Imf::PixelType wanted)
{
  if (channel.Source->GetDataType() == VTK_UNSIGNED_INT)
  {
    return Imf::UINT;
  }
  const bool inexact = wanted == Imf::HALF && HoldsIntegers(channel.Source) &&
    GetMagnitude(channel) > LargestHalfInteger;
  return inexact ? Imf::FLOAT : wanted;
}

//------------------------------------------------------------------------------
std::vector<Channel> ListChannels(vtkImageData* image, Imf::PixelType type, vtkDataArray* weights)
{
  std::vector<Channel> channels;
  vtkPointData* points = image->GetPointData();
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = points->GetArray(i);
    const int components = array ? array->GetNumberOfComponents() : 0;
    for (int component = 0; component < components; ++component)
    {
      Channel channel;
      channel.Name = GetChannelName(array, component, array == points->GetScalars());
      channel.Source = array;
      channel.Component = component;
      channel.Type = FindType(channel, type);
      const bool weighted = weights && array != weights;
      channel.Rule = weighted ? Reduction::WeightedMean : Reduction::Mean;
      if (HoldsIntegers(array))
      {
        channel.Rule = Reduction::First;
      }
      channels.push_back(channel);
    }
  }
  return channels;
}

//------------------------------------------------------------------------------
std::vector<double> ReadComponent(vtkDataArray* array, int component)
{
  std::vector<double> values;
  values.reserve(array->GetNumberOfTuples());
  for (const auto tuple : vtk::DataArrayTupleRange(array))
  {
    values.push_back(tuple[component]);
  }
  return values;
}

//------------------------------------------------------------------------------
template <typename T>
const void* StoreRows(const std::vector<double>& values, const Size& size, std::vector<T>& target)
{
  target.reserve(values.size());
  for (vtkIdType row = size.Height - 1; row >= 0; --row)
  {
    const auto first = values.begin() + row * size.Width;
    std::transform(first, first + size.Width, std::back_inserter(target),
      [](double value) { return static_cast<T>(value); });
  }
  return target.data();
}

//------------------------------------------------------------------------------
const void* Store(const std::vector<double>& values, const Size& size, Imf::PixelType type,
  StoredChannel& target)
{
  switch (type)
  {
    case Imf::HALF:
      return StoreRows(values, size, target.Halves);
    case Imf::UINT:
      return StoreRows(values, size, target.Integers);
    default:
      return StoreRows(values, size, target.Floats);
  }
}

//------------------------------------------------------------------------------
// One texel over those of `fine` that begin at `first` and span `across` x `down`.
double Reduce(const std::vector<double>& fine, const std::vector<double>& weights, Reduction rule,
  vtkIdType first, vtkIdType width, const Size& span)
{
  if (rule == Reduction::First)
  {
    return fine[first];
  }
  double sum = 0.0;
  double weightedSum = 0.0;
  double weight = 0.0;
  for (vtkIdType row = 0; row < span.Height; ++row)
  {
    for (vtkIdType i = first + row * width; i < first + row * width + span.Width; ++i)
    {
      sum += fine[i];
      if (rule == Reduction::WeightedMean && weights[i] > 0.0)
      {
        weightedSum += weights[i] * fine[i];
        weight += weights[i];
      }
    }
  }
  return weight > 0.0 ? weightedSum / weight : sum / static_cast<double>(span.Width * span.Height);
}

//------------------------------------------------------------------------------
std::vector<double> Halve(const std::vector<double>& fine, const std::vector<double>& weights,
  Reduction rule, const Size& size)
{
  const Size coarse = size.GetHalf();
  const Size span{ size.Width / coarse.Width, size.Height / coarse.Height };
  std::vector<double> values;
  values.reserve(coarse.Width * coarse.Height);
  for (vtkIdType row = 0; row < coarse.Height; ++row)
  {
    for (vtkIdType column = 0; column < coarse.Width; ++column)
    {
      const vtkIdType first = row * span.Height * size.Width + column * span.Width;
      values.push_back(Reduce(fine, weights, rule, first, size.Width, span));
    }
  }
  return values;
}

//------------------------------------------------------------------------------
// The image's channels at one mip level after the other.
class Levels
{
public:
  Levels(std::vector<Channel> channels, vtkDataArray* weights, const Size& size)
    : Channels(std::move(channels)), Coarser(this->Channels.size()), LevelSize(size)
  {
    if (weights)
    {
      this->Weights = ReadComponent(weights, 0);
    }
  }

  /// The level's pixels, placed in `window`; valid until the next call. With `further` the next
  /// call gives the next level.
  Imf::FrameBuffer Take(const Imath::Box2i& window, bool further)
  {
    this->Stored.clear();
    this->Stored.resize(this->Channels.size());
    Imf::FrameBuffer pixels;
    for (std::size_t i = 0; i < this->Channels.size(); ++i)
    {
      const Channel& channel = this->Channels[i];
      const std::vector<double> values = this->Coarser[i].empty()
        ? ReadComponent(channel.Source, channel.Component)
        : std::move(this->Coarser[i]);
      const std::size_t step = channel.Type == Imf::HALF ? 2 : 4;
      const void* stored = Store(values, this->LevelSize, channel.Type, this->Stored[i]);
      pixels.insert(channel.Name,
        Imf::Slice::Make(channel.Type, stored, window, step, step * this->LevelSize.Width));
      if (further)
      {
        this->Coarser[i] = Halve(values, this->Weights, channel.Rule, this->LevelSize);
      }
    }
    if (further && !this->Weights.empty())
    {
      this->Weights = Halve(this->Weights, {}, Reduction::Mean, this->LevelSize);
    }
    this->LevelSize = this->LevelSize.GetHalf();
    return pixels;
  }

private:
  std::vector<Channel> Channels;
  std::vector<std::vector<double>> Coarser;
  std::vector<StoredChannel> Stored;
  std::vector<double> Weights;
  Size LevelSize;
};

//------------------------------------------------------------------------------
Size GetSize(vtkImageData* image)
{
  int dimensions[3];
  image->GetDimensions(dimensions);
  return { dimensions[0], dimensions[1] };
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
// False where the user has aborted.
bool Advance(vtkAlgorithm* algorithm, int done, int total)
{
  algorithm->UpdateProgress(static_cast<double>(done) / total);
  return !algorithm->GetAbortExecute();
}

//------------------------------------------------------------------------------
bool WriteLines(Imf::OStream& stream, const Imf::Header& header, Levels& levels,
  vtkAlgorithm* algorithm)
{
  const Imath::Box2i& window = header.dataWindow();
  const int height = window.max.y - window.min.y + 1;
  Imf::OutputFile file(stream, header);
  file.setFrameBuffer(levels.Take(window, false));
  // DWAB's, the tallest chunk.
  constexpr int block = 256;
  bool goOn = true;
  for (int row = 0; row < height && goOn; row += block)
  {
    const int count = std::min(block, height - row);
    file.writePixels(count);
    goOn = Advance(algorithm, row + count, height);
  }
  return goOn;
}

//------------------------------------------------------------------------------
bool WriteTiles(Imf::OStream& stream, const Imf::Header& header, Levels& levels,
  vtkAlgorithm* algorithm)
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
      if (!Advance(algorithm, ++done, total))
      {
        return false;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
std::string FindValueProblem(const Channel& channel)
{
  const double magnitude = GetMagnitude(channel);
  const std::string named = "channel \"" + channel.Name + "\" has ";
  if (channel.Type == Imf::HALF && magnitude > LargestHalf)
  {
    return named + "values above 65504, which half pixels cannot hold; use float pixels";
  }
  if (channel.Type == Imf::FLOAT && HoldsIntegers(channel.Source) &&
    magnitude > LargestFloatInteger)
  {
    return named +
      "integers above 16777216, which float pixels cannot hold; make it a vtkUnsignedIntArray";
  }
  if (channel.Type == Imf::FLOAT && magnitude > std::numeric_limits<float>::max())
  {
    return named + "values above 3.4e38, which float pixels cannot hold; scale them";
  }
  return std::string();
}

//------------------------------------------------------------------------------
std::string FindChannelProblem(const std::vector<Channel>& channels)
{
  if (channels.empty())
  {
    return "the image has no numeric point array";
  }
  std::set<std::string> names;
  for (const Channel& channel : channels)
  {
    if (channel.Name.empty() || channel.Name.size() > 255)
    {
      return "a point array's name is missing or longer than 255 characters; rename it";
    }
    if (!names.insert(channel.Name).second)
    {
      return "two arrays would both be written as channel \"" + channel.Name + "\"; rename one";
    }
    const std::string problem = FindValueProblem(channel);
    if (!problem.empty())
    {
      return problem;
    }
  }
  return std::string();
}

//------------------------------------------------------------------------------
std::string FindWeightProblem(vtkDataArray* weights, const std::string& name)
{
  if (!weights || weights->GetNumberOfComponents() != 1 || HoldsIntegers(weights))
  {
    return "WeightArray \"" + name + "\" must be a float or double point array of one component";
  }
  const auto values = vtk::DataArrayValueRange<1>(weights);
  const bool good = std::all_of(values.begin(), values.end(),
    [](double value) { return std::isfinite(value) && value >= 0.0; });
  return good ? std::string()
              : "WeightArray \"" + name + "\" has values that are negative or not finite";
}

//------------------------------------------------------------------------------
bool IsPowerOfTwo(vtkIdType value)
{
  return value > 0 && (value & (value - 1)) == 0;
}

//------------------------------------------------------------------------------
// An older file, or what else has the name, must be one that may be replaced.
std::string FindTargetProblem(const std::filesystem::path& target)
{
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(target, ignored);
  if (!std::filesystem::exists(status))
  {
    return std::string();
  }
  if (!std::filesystem::is_regular_file(status))
  {
    return "the name is that of a folder or device; choose another";
  }
  const std::ofstream writable(target, std::ios::binary | std::ios::in | std::ios::out);
  return writable ? std::string() : "the file is there and may not be written";
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
void vtkOpenEXRWriter::Fail(unsigned long errorCode, const std::string& problem)
{
  this->SetErrorCode(errorCode);
  vtkErrorMacro("Cannot write the OpenEXR file \"" << (this->FileName ? this->FileName : "")
                                                   << "\": " << problem << '.');
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
  const std::string problem = FindChannelProblem(
    ListChannels(image, this->PixelType == PIXEL_TYPE_HALF ? Imf::HALF : Imf::FLOAT, nullptr));
  if (!problem.empty() || !this->MipLevels)
  {
    return problem;
  }
  const Size size = GetSize(image);
  if (!IsPowerOfTwo(size.Width) || !IsPowerOfTwo(size.Height))
  {
    return "mip levels need a width and height that are powers of two, not " +
      std::to_string(size.Width) + " x " + std::to_string(size.Height) +
      "; switch MipLevels off or resample the image";
  }
  const std::string weights = this->WeightArray ? this->WeightArray : "";
  return weights.empty()
    ? std::string()
    : FindWeightProblem(image->GetPointData()->GetArray(weights.c_str()), weights);
}

//------------------------------------------------------------------------------
bool vtkOpenEXRWriter::WriteImage(vtkImageData* image, const std::string& fileName)
{
  int extent[6];
  image->GetExtent(extent);
  const Size size = GetSize(image);
  const bool weighted = this->MipLevels && this->WeightArray && *this->WeightArray;
  vtkDataArray* weights = weighted ? image->GetPointData()->GetArray(this->WeightArray) : nullptr;
  const std::vector<Channel> channels =
    ListChannels(image, this->PixelType == PIXEL_TYPE_HALF ? Imf::HALF : Imf::FLOAT, weights);

  const Imath::Box2i window({ extent[0], extent[2] }, { extent[1], extent[3] });
  Imf::Header header(GetDisplayWindow(image, window), window);
  header.compression() = static_cast<Imf::Compression>(this->Compression);
  for (const Channel& channel : channels)
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

  std::ofstream file(fileName, std::ios::binary);
  if (!file)
  {
    throw std::runtime_error("it cannot be created; the folder must exist and let you write");
  }
  Imf::StdOFStream stream(file, fileName.c_str());
  Levels levels(channels, weights, size);
  bool complete = false;
  try
  {
    complete =
      tiled ? WriteTiles(stream, header, levels, this) : WriteLines(stream, header, levels, this);
  }
  catch (const Iex::BaseExc&)
  {
    if (file)
    {
      throw;
    }
  }
  // OpenEXR writes the table of offsets last and says nothing where that fails.
  file.close();
  if (!file)
  {
    throw DiskError("the data cannot be written; make room on the disk");
  }
  return complete;
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::WriteData()
{
  if (!this->FileName || !*this->FileName)
  {
    this->Fail(vtkErrorCode::NoFileNameError, "no file name is set; call SetFileName first");
    return;
  }
  vtkImageData* image = vtkImageData::SafeDownCast(this->GetInput());
  std::string problem = image ? this->FindProblem(image) : "the input is not an image";
  if (!problem.empty())
  {
    this->Fail(vtkErrorCode::FileFormatError, problem);
    return;
  }
  std::error_code ignored;
  std::filesystem::path target = std::filesystem::weakly_canonical(this->FileName, ignored);
  if (target.empty())
  {
    target = this->FileName;
  }
  problem = FindTargetProblem(target);
  if (!problem.empty())
  {
    this->Fail(vtkErrorCode::CannotOpenFileError, problem);
    return;
  }
  const std::filesystem::path unfinished(target.string() + ".part");
  try
  {
    if (this->WriteImage(image, unfinished.string()))
    {
      std::filesystem::rename(unfinished, target);
      return;
    }
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  catch (const DiskError& error)
  {
    this->Fail(vtkErrorCode::OutOfDiskSpaceError, error.what());
  }
  catch (const std::bad_alloc&)
  {
    this->Fail(vtkErrorCode::UnknownError, "there is not enough memory; write a smaller image");
  }
  catch (const std::exception& exception)
  {
    this->Fail(vtkErrorCode::CannotOpenFileError, exception.what());
  }
  std::filesystem::remove(unfinished, ignored);
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
