// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Links from rays in a file: all that comes of them is the same bits after loading, on any number
// of ranks, and no file is believed that is not whole.
#include "OutcomeTesting.h"
#include "RadiosityTesting.h"
#include "RanksInThreads.h"
#include "Scene/PatchScene.h"
#include "ViewFactorTesting.h"
#include "ViewFactors/RayHits.h"
#include "ViewFactors/RayHitsFile.h"
#include "ViewFactors/ViewFactorStore.h"
#include "vtkExecutive.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <random>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
namespace fs = std::filesystem;

// Where things are in the file (see RayHitsFile.h).
constexpr std::size_t Order = 40, Patches = 56, Rays = 64, Hits = 72;

/// A folder of the test's own, removed with all that is in it.
struct Folder
{
  fs::path Path = fs::temp_directory_path() /
    ("TestSampledViewFactorsFile-" + std::to_string(std::random_device()()));
  Folder() { fs::create_directory(this->Path); }
  ~Folder() { fs::remove_all(this->Path); }
  std::string Get(const std::string& name) const { return (this->Path / name).string(); }
};

//------------------------------------------------------------------------------
/// A box on a floor under the sky, so that rays meet fronts, backs and nothing, of points in single
/// precision on a map.
vtkSmartPointer<vtkPolyData> MakeYard(double offset = 6e4)
{
  const auto at = [offset](double x, double y, double z) {
    return Point{ offset + x, offset + y, z };
  };
  Surface yard(true);
  yard.AddGrid(at(0, 0, 0), at(40, 0, 0), at(0, 40, 0), 5, 5);
  AddBox(yard, at(10, 10, 0), at(20, 20, 14), 5.0, false);
  yard.AddGrid(at(30, 10, 0), at(30, 20, 0), at(30, 10, 8), 1, 1);
  auto data = yard.Get();
  AddArray(data, "Reflectance", { 0.6 });
  AddArray(data, "Emission", { 0.0 })->SetValue(2, 1.0);
  return data;
}

//------------------------------------------------------------------------------
std::string GetBytes(const std::string& fileName)
{
  std::ifstream stream(fileName, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

//------------------------------------------------------------------------------
void PutBytes(const std::string& fileName, const std::string& bytes)
{
  std::ofstream stream(fileName, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

//------------------------------------------------------------------------------
template <typename Value>
std::string Replace(std::string bytes, std::size_t offset, Value value)
{
  std::memcpy(&bytes[offset], &value, sizeof(value));
  return bytes;
}

//------------------------------------------------------------------------------
// The checksum written down a second time.
std::string Sign(const std::string& bytes)
{
  std::uint64_t sum = 0xcbf29ce484222325;
  for (std::size_t done = 0; done + 8 < bytes.size(); done += 8)
  {
    std::uint64_t word = 0;
    std::memcpy(&word, &bytes[done], 8);
    sum = (sum ^ word) * 0x100000001b3;
    sum ^= sum >> 32;
  }
  return Replace(bytes, bytes.size() - 8, sum);
}

/// View factors for a scene and radiosity with them.
struct Lit
{
  vtkNew<MessageLog> Log;
  vtkNew<vtkViewFactors> Factors;
  vtkNew<vtkRadiosity> Radiosity;

  explicit Lit(vtkPolyData* data)
  {
    this->Factors->AddObserver(vtkCommand::ErrorEvent, this->Log);
    this->Factors->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Log);
    this->Radiosity->AddObserver(vtkCommand::ErrorEvent, this->Log);
    this->Factors->SetInputData(data);
    this->Radiosity->SetInputData(data);
    this->Radiosity->SetViewFactors(this->Factors);
    this->Radiosity->SetDeviceToCPU();
    this->Radiosity->SetBackgroundRadiance(0.1);
    this->Radiosity->ComputeErrorsOn();
  }

  void Update()
  {
    this->Radiosity->Update();
    this->Factors->Update();
    Check(this->Log->GetAll().empty(), "no errors: " + this->Log->GetAll());
  }
};

//------------------------------------------------------------------------------
Vector GetResult(vtkRadiosity* radiosity, const char* name)
{
  vtkDataArray* array = radiosity->GetPolyDataOutput()->GetCellData()->GetArray(name);
  Check(array != nullptr, std::string(name) + " is there");
  return array ? ToVector(GetValues(array)) : Vector();
}

//------------------------------------------------------------------------------
void CheckSame(Lit& a, Lit& b, const std::string& what)
{
  for (const char* name : { "Radiosity", "Irradiance", "RadiosityError", "IrradianceError" })
  {
    Check(GetResult(a.Radiosity, name) == GetResult(b.Radiosity, name),
      what + ": " + name + " is the same");
  }
  for (const char* name :
    { "ViewFactorSum", "ViewFactorError", "SkyFraction", "BackFaceFraction", "SceneProblems" })
  {
    Check(GetCellValues(a.Factors, name) == GetCellValues(b.Factors, name),
      what + ": " + name + " is the same");
  }
  auto* here = a.Radiosity->GetPolyDataOutput();
  auto* there = b.Radiosity->GetPolyDataOutput();
  for (const char* name : { "AccuracyReached", "RaysPerPatch", "NumberOfLinks", "ClosureChange",
         "ClosureGap", "ClosureRest", "ErrorBound" })
  {
    CheckClose(GetSummary(there, name), GetSummary(here, name), 0.0, what + ": " + name);
  }
  Check(GetText(there, "LinkMethodUsed") == "Sampled", what + ": sampled links");
  Check(GetText(there, "EnclosureVerdict") == GetText(here, "EnclosureVerdict"),
    what + ": verdict");
  const vtkIdType faces = here->GetNumberOfCells();
  vtkNew<vtkDoubleArray> rows;
  rows->SetNumberOfComponents(static_cast<int>(faces));
  rows->SetNumberOfTuples(faces);
  bool same = a.Factors->GetViewFactors(0, rows);
  for (vtkIdType pair = 0; pair < faces * faces; ++pair)
  {
    same = same &&
      a.Factors->GetViewFactor(pair / faces, pair % faces) ==
        b.Factors->GetViewFactor(pair / faces, pair % faces) &&
      a.Factors->GetViewFactor(pair / faces, pair % faces) == rows->GetValue(pair);
  }
  Check(same, what + ": view factors are the same");
}

//------------------------------------------------------------------------------
/// Whatever the properties are, and also where more rays were cast before than the links have.
void TestRoundTrip(const Folder& folder)
{
  const std::string name = folder.Get("yard.factors");
  auto data = MakeYard();
  Lit run(data);
  run.Factors->SetLinkMethodToSampled();
  run.Factors->SetLinkTolerance(3e-2);
  run.Update();
  run.Factors->SetLinkTolerance(5e-2);
  run.Update();
  Check(run.Factors->Save(name.c_str()), "is saved");
  const auto patches = static_cast<double>(data->GetNumberOfCells());
  const double rays = GetSummary(run.Radiosity->GetPolyDataOutput(), "RaysPerPatch");
  CheckClose(static_cast<double>(fs::file_size(name)), Hits + patches * rays * 4 + 8, 0.0,
    "length of the file");

  for (const int method : { vtkViewFactors::LINK_METHOD_DENSE,
         vtkViewFactors::LINK_METHOD_HIERARCHICAL, vtkViewFactors::LINK_METHOD_SAMPLED })
  {
    Lit again(data);
    again.Factors->SetLinkMethod(method);
    Check(again.Factors->Load(name.c_str()), "is loaded");
    again.Update();
    CheckSame(run, again, "method " + std::to_string(method));
    CheckClose(again.Radiosity->GetNumberOfLinkRuns(), 0, 0.0, "no links are made");
    Check(again.Factors->Save(folder.Get("again").c_str()), "is saved again");
    Check(GetBytes(folder.Get("again")) == GetBytes(name), "the same file");

    // Another scene is not served, and this one afterwards as before.
    auto other = MakeYard(0.0);
    again.Factors->SetInputData(other);
    again.Factors->Update();
    Check(again.Log->GetAll().find("another geometry") != std::string::npos,
      "another scene: " + again.Log->GetAll());
    again.Log->Clear();
    again.Factors->SetInputData(data);
    again.Update();
    CheckSame(run, again, "once more");
    again.Factors->Load(nullptr);
    again.Factors->SetLinkMethodToSampled();
    again.Factors->SetLinkTolerance(0.3);
    again.Update();
    CheckClose(GetSummary(again.Radiosity->GetPolyDataOutput(), "RaysPerPatch"), 64.0, 0.0,
      "nothing of the file is left");
  }
}

//------------------------------------------------------------------------------
/// The file of three ranks is that of one, and three ranks have the same bits after loading either.
void TestRanks(const Folder& folder)
{
  auto data = MakeYard();
  const ViewFactorSettings settings{ 1e-3, false, LinkMethod::Sampled, 5e-2 };
  PatchScene scene;
  CheckDone(scene.Build(data, Ranks()), "scene");
  ViewFactorStore whole;
  CheckDone(whole.Update(scene, settings, {}, Ranks(), Monitor()), "links");
  CheckDone(whole.Save(folder.Get("one"), Ranks()), "one rank saves");
  std::mutex mutex;
  const auto check = [&](bool holds, const std::string& what)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    Check(holds, what);
  };
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int)
    {
      const Ranks ranks(controller);
      ViewFactorStore part;
      check(static_cast<bool>(part.Update(scene, settings, {}, ranks, Monitor())),
        "links of a rank");
      check(static_cast<bool>(part.Save(folder.Get("three"), ranks)), "three ranks save");
      for (const char* name : { "one", "three" })
      {
        ViewFactorStore loaded;
        check(static_cast<bool>(loaded.Load(folder.Get(name), ranks)), "three ranks load");
        check(static_cast<bool>(loaded.Update(scene, {}, {}, ranks, Monitor())), "loaded links");
        const Links& a = part.GetLinks();
        const Links& b = loaded.GetLinks();
        check(!loaded.WereMade() && a.Hierarchy->GetOffsets() == b.Hierarchy->GetOffsets() &&
            a.Hierarchy->GetColumns() == b.Hierarchy->GetColumns() &&
            a.Hierarchy->GetValues() == b.Hierarchy->GetValues() &&
            a.Hierarchy->GetWeights() == b.Hierarchy->GetWeights() && a.RowSums == b.RowSums &&
            a.SkyFractions == b.SkyFractions && a.OpeningErrors == b.OpeningErrors,
          "the same bits");
      }
      ViewFactorStore none;
      const Outcome missing = none.Load(folder.Get("missing"), ranks);
      check(missing.HasFailed(), "all ranks hear of a file that is not there");
      const Outcome nowhere = part.Save(folder.Get("no folder/file"), ranks);
      check(nowhere.GetMessage().find("cannot be written") != std::string::npos,
        "all ranks hear that nothing is written: " + nowhere.GetMessage());
    });
  Check(GetBytes(folder.Get("one")) == GetBytes(folder.Get("three")),
    "the same file of three ranks");
}

//------------------------------------------------------------------------------
void TestDamaged(const Folder& folder)
{
  const std::string name = folder.Get("damaged");
  const std::string good = GetBytes(folder.Get("one"));
  Check(Sign(good) == good, "the checksum is what its description says");
  const auto expect = [&](const std::string& bytes, const std::string& problem, const char* what)
  {
    PutBytes(name, bytes);
    RayHits hits;
    int rays = 7;
    const Outcome read = RayHitsFile::Read(name, Ranks(), hits, rays);
    Check(read.HasFailed() && rays == 7 && hits.GetLast() == 0, std::string(what) + " is refused");
    Check(read.GetMessage().find(name) != std::string::npos &&
        read.GetMessage().find(problem) != std::string::npos,
      std::string(what) + " gives the message: " + read.GetMessage());
  };
  for (const std::size_t length :
    { std::size_t(35), Order, Patches, Hits - 1, Hits, Hits + 4, good.size() - 9, good.size() - 1 })
  {
    expect(good.substr(0, length), "cut short", "a part");
  }
  expect(good + 'x', "behind its end", "more");
  expect(Replace(good, 35, '2'), "not version 1", "another version");
  std::string swapped = good;
  std::reverse(&swapped[Order], &swapped[Order] + 8);
  expect(swapped, "order of bytes", "another byte order");
  for (const std::uint64_t count : { std::uint64_t(0), std::uint64_t(1) << 40, ~std::uint64_t(0),
         std::uint64_t(1) << 60, std::uint64_t(96), std::uint64_t(1) << 17 })
  {
    expect(Sign(Replace(good, Rays, count)), "damaged", "rays that cannot be");
    expect(Sign(Replace(good, Patches, count)), "", "patches that are not there");
  }
  expect(Sign(Replace(good, Rays, std::uint64_t(65536))), "cut short", "rays that are not there");
  const std::int32_t patches = static_cast<std::int32_t>(MakeYard()->GetNumberOfCells());
  for (const std::int32_t hit : { patches, -2 - patches, 1 << 30, -(1 << 30) })
  {
    expect(Sign(Replace(good, Hits + 4 * 77, hit)), "not there", "a patch that is not there");
  }
  std::mt19937_64 generator(3);
  for (int k = 0; k < 300; ++k)
  {
    const std::size_t offset = k < int(Hits) ? k : generator() % good.size();
    expect(Replace(good, offset, static_cast<char>(good[offset] ^ (1 << generator() % 8))), "",
      "a changed bit");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestSampledViewFactorsFile(int, char*[])
{
  const Folder folder;
  TestRoundTrip(folder);
  TestRanks(folder);
  TestDamaged(folder);
  return Result();
}
