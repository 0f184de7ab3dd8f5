// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What vtkOpenEXRWriter writes, vtkOpenEXRReader reads: exactly in float, to half precision in
// half; and the writer's errors.
#include "OpenEXRTestTools.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkOpenEXRReader.h"
#include "vtkOpenEXRWriter.h"
#include "vtkStringArray.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#if defined(__linux__)
#include <csignal>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

using namespace OpenEXRTestTools;

namespace
{
constexpr int Extent[6] = { -3, 33, 7, 71, 0, 0 };

//------------------------------------------------------------------------------
// The largest difference in units of max(|value|, smallest normal half); -1 where the arrays do not
// match at all.
double Compare(vtkDataArray* expected, vtkDataArray* found)
{
  if (!expected || !found || expected->GetNumberOfTuples() != found->GetNumberOfTuples() ||
    expected->GetNumberOfComponents() != found->GetNumberOfComponents())
  {
    return -1.0;
  }
  double largest = 0.0;
  for (vtkIdType i = 0; i < expected->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < expected->GetNumberOfComponents(); ++k)
    {
      const double value = expected->GetComponent(i, k);
      const double difference = std::abs(value - found->GetComponent(i, k));
      largest = std::max(largest, difference / std::max(std::abs(value), 6.103515625e-5));
    }
  }
  return largest;
}

//------------------------------------------------------------------------------
bool TestCompression(const std::string& path, int compression, int components)
{
  const vtkSmartPointer<vtkImageData> image = MakeImage(Extent, components);
  bool good = true;
  for (const int type : { vtkOpenEXRWriter::PIXEL_TYPE_HALF, vtkOpenEXRWriter::PIXEL_TYPE_FLOAT })
  {
    vtkNew<vtkOpenEXRWriter> writer;
    writer->SetInputData(image);
    writer->SetFileName(path.c_str());
    writer->SetPixelType(type);
    writer->SetCompression(compression);
    vtkNew<vtkOpenEXRReader> reader;
    reader->SetFileName(path.c_str());
    good &= Check(writer->Write() == 1, "the writer returns 1");
    reader->Update();
    const double error = Compare(image->GetPointData()->GetScalars(),
      reader->GetOutput()->GetPointData()->GetScalars());
    // Rounding to 11 significant bits.
    const double allowed = type == vtkOpenEXRWriter::PIXEL_TYPE_HALF ? 1.0 / 2048.0 : 0.0;
    good &= Check(error >= 0.0 && error <= allowed,
      "values survive compression " + std::to_string(compression) + " with " +
        std::to_string(components) + " components, pixel type " + std::to_string(type) +
        ": difference " + std::to_string(error));
    good &= Check(std::equal(Extent, Extent + 6, reader->GetOutput()->GetExtent()), "the extent");
  }
  return good;
}

//------------------------------------------------------------------------------
bool TestNamedChannels(const std::string& path)
{
  const vtkSmartPointer<vtkImageData> image = MakeImage(Extent, 4);
  vtkPointData* points = image->GetPointData();
  const vtkIdType count = image->GetNumberOfPoints();
  for (const int components : { 1, 2, 3, 4, 12 })
  {
    points->AddArray(MakeValues(("Layer" + std::to_string(components)).c_str(), components, count));
  }
  vtkNew<vtkUnsignedIntArray> ids;
  ids->SetName("PatchId");
  for (vtkIdType i = 0; i < count; ++i)
  {
    ids->InsertNextValue(4294967295u - static_cast<unsigned int>(i));
  }
  points->AddArray(ids);
  vtkNew<vtkIntArray> window;
  window->SetName("DisplayWindow");
  window->SetNumberOfComponents(4);
  const int corners[4] = { -10, 100, -20, 200 };
  window->InsertNextTypedTuple(corners);
  image->GetFieldData()->AddArray(window);

  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  vtkNew<vtkOpenEXRReader> reader;
  reader->SetFileName(path.c_str());
  bool good = Check(writer->Write() == 1, "an image with many arrays is written");
  reader->Update();
  vtkImageData* result = reader->GetOutput();
  good &= Check(result->GetPointData()->GetNumberOfArrays() == points->GetNumberOfArrays(),
    "as many arrays come back as were written");
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    const std::string name = points->GetArrayName(i);
    vtkDataArray* found = result->GetPointData()->GetArray(name.c_str());
    good &= Check(Compare(points->GetArray(i), found) == 0.0, "array " + name + " is the same");
  }
  good &= Check(result->GetPointData()->GetArray("PatchId")->GetDataType() == VTK_UNSIGNED_INT,
    "integers stay integers");
  vtkDataArray* windowBack = result->GetFieldData()->GetArray("DisplayWindow");
  good &= Check(Compare(window, windowBack) == 0.0, "the display window is the same");
  return good;
}

//------------------------------------------------------------------------------
bool ExpectError(vtkOpenEXRWriter* writer, const std::string& message)
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> executiveObserver;
  writer->AddObserver(vtkCommand::ErrorEvent, observer);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executiveObserver);
  bool good = Check(writer->Write() == 0, "the writer returns 0: " + message);
  good &= Check(observer->CheckErrorMessage(message) == 0, "the error says: " + message);
  writer->RemoveObserver(observer);
  return good;
}

//------------------------------------------------------------------------------
bool TestErrors(const std::string& path)
{
  std::filesystem::remove(path);
  vtkNew<vtkOpenEXRWriter> writer;
  vtkNew<vtkImageData> empty;
  writer->SetInputData(empty);
  bool good = ExpectError(writer, "no file name is set");
  writer->SetFileName(path.c_str());
  good &= ExpectError(writer, "the image is empty");

  const vtkSmartPointer<vtkImageData> image = MakeImage(Extent, 1);
  writer->SetInputData(image);
  image->GetPointData()->GetScalars()->SetComponent(5, 0, 70000.0);
  writer->SetPixelTypeToHalf();
  good &= ExpectError(writer, "values above 65504");
  writer->SetPixelTypeToFloat();

  image->GetPointData()->AddArray(MakeValues("Y", 1, image->GetNumberOfPoints()));
  good &= ExpectError(writer, "two arrays would both be written as channel \"Y\"");

  vtkNew<vtkImageData> bare;
  bare->SetDimensions(4, 4, 1);
  writer->SetInputData(bare);
  good &= ExpectError(writer, "no numeric point array");

  const int volume[6] = { 0, 3, 0, 3, 0, 3 };
  writer->SetInputData(MakeImage(volume, 1));
  good &= ExpectError(writer, "several slices");
  good &= Check(!std::filesystem::exists(path), "a failed writer leaves no file");

  writer->SetInputData(MakeImage(Extent, 3));
  writer->SetFileName((path + "/no/such/directory.exr").c_str());
  good &= ExpectError(writer, "Cannot write the OpenEXR file");
  return good;
}

//------------------------------------------------------------------------------
// An image that cannot be written leaves the older file as it was, and nothing beside it.
bool ExpectOldFile(vtkOpenEXRWriter* writer, const std::string& path, const std::string& message)
{
  const auto load = [&]()
  {
    std::ifstream stream(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  };
  const std::string before = load();
  bool good = ExpectError(writer, message);
  good &= Check(!before.empty() && load() == before, "the older file is still there: " + message);
  const std::filesystem::directory_iterator folder(std::filesystem::path(path).parent_path());
  const bool clean = std::none_of(begin(folder), end(folder),
    [](const auto& entry)
    { return entry.path().filename().string().rfind(".unfinished-", 0) == 0; });
  good &= Check(clean, "nothing unfinished stays: " + message);
  return good;
}

//------------------------------------------------------------------------------
bool TestFullDisk(const std::string& path)
{
  bool good = true;
#if defined(__linux__)
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(MakeImage(Extent, 3));
  writer->SetFileName(path.c_str());
  writer->SetCompressionToNone();
  // A write beyond the limit then fails as it does on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  for (const bool tiled : { false, true })
  {
    writer->SetTiled(tiled);
    good &= Check(writer->Write() == 1, "the disk has room");
    const std::uintmax_t size = std::filesystem::file_size(path);
    for (const std::uintmax_t room : { std::uintmax_t(0), std::uintmax_t(100), size / 2, size - 1 })
    {
      const rlimit limits{ static_cast<rlim_t>(room), before.rlim_max };
      setrlimit(RLIMIT_FSIZE, &limits);
      const bool kept = ExpectOldFile(writer, path, "make room on the disk");
      setrlimit(RLIMIT_FSIZE, &before);
      good &= Check(kept && writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError,
        "room for " + std::to_string(room) + " bytes");
    }
  }
  writer->SetFileName("/dev/full");
  good &= ExpectError(writer, "the name is that of a folder or device");
  good &= Check(std::filesystem::is_character_file("/dev/full"), "a device stays one");
#endif
  return good;
}

//------------------------------------------------------------------------------
bool TestPermissions(const std::string& path)
{
  bool good = true;
#if defined(__linux__)
  const std::filesystem::path folder = path + ".folder";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  const std::string inside = (folder / "image.exr").string();
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(MakeImage(Extent, 3));
  writer->SetFileName(inside.c_str());
  good &= Check(writer->Write() == 1, "a folder that may be written");
  // The administrator may write everywhere, so that the test must be somebody else for a while.
  constexpr uid_t nobody = 65534;
  const bool administrator = geteuid() == 0;
  using std::filesystem::perms;
  const perms readable = perms::owner_read | perms::owner_exec | perms::group_read |
    perms::group_exec | perms::others_read | perms::others_exec;
  std::filesystem::permissions(folder, readable);
  good &= Check(!administrator || seteuid(nobody) == 0, "another user");
  const bool visible = std::filesystem::exists(folder);
  good &=
    !visible || ExpectOldFile(writer, inside, administrator ? "may not be written" : "let you");
  good &= Check(!administrator || seteuid(0) == 0, "the user of before");
  std::filesystem::permissions(folder, perms::all);
  std::filesystem::permissions(inside, perms::owner_read | perms::group_read | perms::others_read);
  good &= Check(!administrator || seteuid(nobody) == 0, "another user");
  good &= !visible || ExpectOldFile(writer, inside, "the file is there and may not be written");
  good &= Check(!administrator || seteuid(0) == 0, "the user of before");
  std::filesystem::remove_all(folder);
#endif
  return good;
}

//------------------------------------------------------------------------------
// Modes stay, the umask is heard, links of both kinds are treated with care, and what is no file is
// left alone.
bool TestTargets(const std::string& path)
{
  bool good = true;
#if defined(__linux__)
  namespace fs = std::filesystem;
  const fs::path folder = path + ".targets";
  fs::remove_all(folder);
  fs::create_directory(folder);
  const fs::path file = folder / "image.exr";
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(MakeImage(Extent, 1));
  const auto write = [&](const fs::path& name)
  {
    writer->SetFileName(name.c_str());
    return writer->Write() == 1;
  };
  const auto getMode = [](const fs::path& name)
  { return static_cast<unsigned int>(fs::status(name).permissions()); };
  const mode_t before = umask(0027);
  good &= Check(write(file) && getMode(file) == 0640, "a new file has what the umask leaves");
  umask(before);
  fs::permissions(file, static_cast<fs::perms>(0604));
  good &= Check(write(file) && getMode(file) == 0604, "an older file's mode stays");

  // A chain of links, each relative to its own folder.
  fs::create_directory(folder / "deep");
  fs::create_symlink("../image.exr", folder / "deep" / "near");
  fs::create_symlink("deep/near", folder / "far");
  good &= Check(write(folder / "far") && fs::is_symlink(folder / "far") &&
      fs::is_symlink(folder / "deep" / "near") && getMode(file) == 0604,
    "links stay");
  fs::create_symlink("deep/new.exr", folder / "dangling");
  good &= Check(write(folder / "dangling") && fs::is_symlink(folder / "dangling") &&
      fs::is_regular_file(folder / "deep" / "new.exr"),
    "a link to what is not there yet");
  fs::create_symlink("loop", folder / "loop");
  writer->SetFileName((folder / "loop").c_str());
  good &= ExpectError(writer, "a symbolic link that leads nowhere");

  fs::create_hard_link(file, folder / "twin.exr");
  writer->SetFileName(file.c_str());
  good &= ExpectOldFile(writer, file, "the file has 2 names (hard links)");
  good &= Check(fs::hard_link_count(file) == 2, "hard links stay");
  const fs::path pipe = folder / "pipe";
  good &= Check(mkfifo(pipe.c_str(), 0600) == 0, "a pipe");
  writer->SetFileName(pipe.c_str());
  good &= ExpectError(writer, "the name is that of a folder or device");
  good &= Check(fs::is_fifo(pipe), "a pipe stays one");
  vtkNew<vtkOpenEXRReader> reader;
  good &= Check(reader->CanReadFile(pipe.c_str()) == 0, "nobody waits for a pipe");
  fs::remove_all(folder);
#endif
  return good;
}

//------------------------------------------------------------------------------
// Arrays that do not fit the image.
bool TestArrays(const std::string& path)
{
  const vtkSmartPointer<vtkImageData> image = MakeImage(Extent, 1);
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  bool good = true;
  for (const vtkIdType count : { image->GetNumberOfPoints() - 1, image->GetNumberOfPoints() + 1 })
  {
    image->GetPointData()->AddArray(MakeValues("Short", 1, count));
    good &= ExpectError(writer, "point array \"Short\" has " + std::to_string(count) + " values");
  }
  image->GetPointData()->RemoveArray("Short");
  vtkNew<vtkStringArray> names;
  names->SetName("Names");
  names->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(names);
  good &= ExpectError(writer, "point array \"Names\" holds no numbers");
  return good;
}

//------------------------------------------------------------------------------
bool TestReplacement(const std::string& path)
{
  std::filesystem::remove(path);
  const std::string link = path + ".link";
  std::filesystem::remove(link);
  std::filesystem::create_symlink(std::filesystem::absolute(path), link);
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(MakeImage(Extent, 1));
  writer->SetFileName(path.c_str());
  bool good = Check(writer->Write() == 1, "a file");
  writer->SetInputData(MakeImage(Extent, 3));
  writer->SetFileName(link.c_str());
  good &= Check(writer->Write() == 1, "a file through a link");
  good &= Check(std::filesystem::is_symlink(link), "the link stays");
  good &= Check(ReadFile(path)->GetPointData()->GetScalars()->GetNumberOfComponents() == 3,
    "what it leads to is replaced");
  std::filesystem::remove(link);
  writer->SetFileName(std::filesystem::path(path).parent_path().c_str());
  good &= ExpectError(writer, "the name is that of a folder or device");

  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn(); });
  writer->AddObserver(vtkCommand::ProgressEvent, abort);
  writer->SetFileName(path.c_str());
  writer->SetInputData(MakeImage(Extent, 4));
  good &= Check(writer->Write() == 0, "an aborted writer says so");
  good &= Check(ReadFile(path)->GetPointData()->GetScalars()->GetNumberOfComponents() == 3,
    "and the older file stays");
  return good;
}

//------------------------------------------------------------------------------
// Ids must not become other ids.
bool TestIntegers(const std::string& path)
{
  const int extent[6] = { 0, 3, 0, 1, 0, 0 };
  const vtkSmartPointer<vtkImageData> image = MakeImage(extent, 1);
  vtkNew<vtkIntArray> ids;
  ids->SetName("ChartId");
  for (int i = 0; i < 8; ++i)
  {
    ids->InsertNextValue(16777216 - 3 * i);
  }
  image->GetPointData()->AddArray(ids);
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  writer->SetPixelTypeToHalf();
  bool good = Check(writer->Write() == 1, "ids are written");
  const vtkSmartPointer<vtkImageData> found = ReadFile(path);
  good &= Check(Compare(ids, found->GetPointData()->GetArray("ChartId")) == 0.0,
    "ids that half cannot hold are the same");
  ids->SetValue(3, -16777217);
  ids->Modified();
  good &= ExpectError(writer, "make it a vtkUnsignedIntArray");
  vtkNew<vtkDoubleArray> large;
  large->SetName("ChartId");
  large->SetNumberOfTuples(8);
  large->Fill(1e39);
  image->GetPointData()->AddArray(large);
  writer->SetPixelTypeToFloat();
  good &= ExpectError(writer, "values above 3.4e38");
  return good;
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenEXRWriter(int argc, char* argv[])
{
  const std::string path = GetPath(argc, argv, "TestOpenEXRWriter.exr");
  bool good = true;
  // PXR24, B44 and DWA lose bits by design, so that they say nothing here.
  for (int compression = vtkOpenEXRWriter::COMPRESSION_NONE;
       compression <= vtkOpenEXRWriter::COMPRESSION_PIZ; ++compression)
  {
    for (const int components : { 1, 2, 3, 4 })
    {
      if (components != 2 || compression == vtkOpenEXRWriter::COMPRESSION_ZIP)
      {
        good &= TestCompression(path, compression, components);
      }
    }
  }
  good &= TestNamedChannels(path);
  good &= TestIntegers(path);
  good &= TestReplacement(path);
  good &= TestTargets(path);
  good &= TestArrays(path);
  good &= TestFullDisk(path);
  good &= TestPermissions(path);
  good &= TestErrors(GetPath(argc, argv, "TestOpenEXRWriterErrors.exr"));
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
