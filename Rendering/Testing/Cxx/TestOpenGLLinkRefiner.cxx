// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Links of scattered light chosen by vtkOpenGLLinkRefiner against those that the CPU chooses: the
 * same clusters for each patch, but where a deviation is the threshold to rounding; their values,
 * and what scatters; one patch, none; aborts.
 */
#include "AbortTesting.h"
#include "LightTransportTesting.h"
#include "OutcomeTesting.h"
#include "Scattering/AirGaps.h"
#include "Scattering/RefinementOnDevice.h"
#include "Scattering/ScatteringClusters.h"
#include "Scattering/ScatteringIntegrals.h"
#include "Scattering/ScatteringMaterials.h"
#include "Scattering/ScatteringModels.h"
#include "Scattering/ScatteringPatches.h"
#include "Scattering/ScatteringReceiver.h"
#include "Scattering/ScatteringRefinement.h"
#include "Scattering/ScatteringRows.h"
#include "Scene/PatchScene.h"
#include "Shared/Monitor.h"
#include "Support/Ranks.h"
#include "vtkDeviceLinkRefiner.h"
#include "vtkExchangeHierarchy.h"
#include "vtkOpenGLLinkRefiner.h"
#include "vtkSubsurfaceScattering.h"

#include "vtkCell.h"
#include "vtkCommand.h"
#include "vtkDataSetAttributes.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTestErrorObserver.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

using namespace LightTransport;
using namespace LightTransportTesting;

namespace
{
using Scattering = vtkSubsurfaceScattering;

///@{ Of the links, how many may differ from the CPU's, and by how much of the limit where the
/// decision is another one.
constexpr double MostDifferences = 1e-3;
constexpr double NextToLimit = 1e-3;
/// And how many may differ for another reason: a cluster is next to what its pieces stand for.
constexpr double MostOthers = 1e-5;
///@}
/// Of values of links that both have, and of results: of the largest one.
constexpr double ValueTolerance = 1e-4;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSphere(int levels)
{
  Surface surface;
  AddSphere(surface, 1.0, levels, false);
  return surface.Get();
}

//------------------------------------------------------------------------------
// Two sheets in one place, back to back: centers at distance 0 that do not hold each other.
vtkSmartPointer<vtkPolyData> MakeTwoSidedSheet()
{
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 12, 12);
  surface.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 12, 12);
  return surface.Get();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> ReadBunny()
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(LIGHTTRANSPORT_DATA_DIRECTORY "/bunny.ply");
  reader->Update();
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
// On a map, in single precision.
vtkSmartPointer<vtkPolyData> MoveFarAway(vtkPolyData* data)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(6e5, 6e6, 20.0);
  transform->Scale(100.0, 100.0, 100.0);
  vtkNew<vtkTransformPolyDataFilter> move;
  move->SetTransform(transform);
  move->SetInputData(data);
  move->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  move->Update();
  return move->GetOutput();
}

//------------------------------------------------------------------------------
struct Case
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> Data;
  double Millimeters; ///< of the body's diagonal
  int Model;
  bool IsUniform;
  int Links;
  double Tolerance;
};

//------------------------------------------------------------------------------
/// All that links of a body are chosen by.
class Choice
{
public:
  explicit Choice(const Case& setting)
  {
    CheckDone(this->Scene.Build(setting.Data, Ranks(), PatchScene::Order::Surface), "scene");
    const ScatteringMaterial* marble = ScatteringMaterials::Find(Scattering::MATERIAL_MARBLE);
    std::vector<ScatteringMedium> bands;
    for (int band = 0; band < 3; ++band)
    {
      bands.push_back(
        { marble->Scattering[band], marble->Absorption[band], marble->RefractiveIndex });
    }
    CheckDone(
      ScatteringModels::MakeProfiles(setting.Model, ScatteringOptions(), bands, this->Profiles),
      "profiles");
    this->Patches = std::make_unique<ScatteringPatches>(this->Scene, setting.Millimeters);
    this->Integrals = std::make_unique<ScatteringIntegrals>(this->Profiles,
      1.01 * setting.Millimeters, 0.3 * setting.Tolerance);
    const double area = this->Patches->TotalArea;
    const double reference = this->Integrals->GetLargestShare(area);
    const double allowed = setting.Tolerance * reference;
    this->LeaveOut = 0.1 * allowed / area;
    this->Clusters = std::make_unique<ScatteringClusters>(this->Scene, *this->Patches,
      *this->Integrals,
      ScatteringClusters::Tolerances{ 0.3 * setting.Tolerance, this->LeaveOut, 0.0075 * allowed });
    this->Refinement = std::make_unique<ScatteringRefinement>(*this->Clusters, this->Patches->Areas,
      this->AnyLight, reference, this->LeaveOut);
    if (setting.IsUniform)
    {
      this->Refinement->ChooseUniform(setting.Links, setting.Tolerance);
    }
    else
    {
      this->Refinement->ChooseAdaptive(setting.Tolerance, setting.Links);
    }
  }

  vtkSmartPointer<vtkExchangeHierarchy> Fill(RefinementOnDevice* device,
    ScatteringRows::Summary& summary) const
  {
    auto rows = vtkSmartPointer<vtkExchangeHierarchy>::New();
    rows->SetTree(this->Patches->Areas, this->Clusters->GetSlots().GetNodes(), 0, 1, 3);
    AirGaps gaps;
    CheckDone(gaps.Build(this->Scene), "gaps");
    CheckDone(ScatteringRows(*this->Refinement, this->Profiles, gaps)
                .Fill(Ranks(), Monitor(), device, rows, summary),
      "links");
    return rows;
  }

  const ScatteringClusters& GetClusters() const { return *this->Clusters; }

  /// Whether a decision on a slot is next to the other one.
  bool IsNextToLimit(vtkIdType patch, int slot) const
  {
    ScatteringReceiver receiver(*this->Clusters, this->LeaveOut);
    receiver.Look(patch);
    const double limit = this->Refinement->GetLimits()[slot];
    const double deviation = receiver.GetDeviation(receiver.GetPart(slot)).maxCoeff();
    const double bound = this->Clusters->GetBound(patch, slot);
    return std::abs(deviation / limit - 1.0) < NextToLimit ||
      std::abs(bound / this->LeaveOut - 1.0) < NextToLimit;
  }

private:
  PatchScene Scene;
  ScatteringProfiles Profiles;
  std::unique_ptr<ScatteringPatches> Patches;
  std::unique_ptr<ScatteringIntegrals> Integrals;
  std::unique_ptr<ScatteringClusters> Clusters;
  std::unique_ptr<ScatteringRefinement> Refinement;
  double LeaveOut = 0.0;
  const std::vector<double> AnyLight;
};

//------------------------------------------------------------------------------
/// Rows of links beside each other.
class Comparison
{
public:
  Comparison(const Choice& choice, vtkExchangeHierarchy* found, vtkExchangeHierarchy* expected)
    : Chosen(choice), Found(found), Expected(expected)
  {
    for (int slot = expected->GetNumberOfNodes(); slot < expected->GetNumberOfSlots(); ++slot)
    {
      this->CompareRow(slot);
    }
  }

  double Links = 0.0;       ///< of the expected ones
  double Differences = 0.0; ///< of these that were not found
  double Others = 0.0;      ///< found where no decision was next to the other one
  double WorstValue = 0.0;  ///< difference of what one link carries, of all a patch gets

private:
  void CompareRow(int row)
  {
    const std::vector<std::int64_t>& at = this->Expected->GetOffsets();
    const std::vector<std::int64_t>& foundAt = this->Found->GetOffsets();
    double sum = 0.0;
    for (std::int64_t link = at[row]; link < at[row + 1]; ++link)
    {
      sum += this->GetLight(this->Expected, link);
    }
    std::int64_t next = foundAt[row];
    for (std::int64_t link = at[row]; link < at[row + 1]; ++link)
    {
      this->Links += 1.0;
      const int slot = this->Expected->GetColumns()[link];
      const std::int64_t match = this->FindLink(slot, next, foundAt[row + 1]);
      if (match < 0)
      {
        this->Differences += 1.0;
        this->Others += this->IsExcused(row, slot) ? 0.0 : 1.0;
        continue;
      }
      next = match + 1;
      this->WorstValue = std::max(this->WorstValue,
        std::abs(this->GetLight(this->Found, match) - this->GetLight(this->Expected, link)) / sum);
    }
  }

  // In the order of both.
  std::int64_t FindLink(int slot, std::int64_t begin, std::int64_t end) const
  {
    const std::vector<int>& columns = this->Found->GetColumns();
    const auto found = std::find(columns.begin() + begin, columns.begin() + end, slot);
    return found == columns.begin() + end ? -1 : found - columns.begin();
  }

  // The slot itself, or one above it, where decisions differ.
  bool IsExcused(int row, int slot) const
  {
    const vtkIdType patch = row - this->Expected->GetNumberOfNodes();
    const LinkSlots& slots = this->Chosen.GetClusters().GetSlots();
    for (int above = slot;; above = slots.GetParent(above))
    {
      if (this->Chosen.IsNextToLimit(patch, above))
      {
        return true;
      }
      if (above == 0)
      {
        return false;
      }
    }
  }

  double GetLight(vtkExchangeHierarchy* rows, std::int64_t link) const
  {
    return static_cast<double>(rows->GetValues()[3 * link]) *
      this->Chosen.GetClusters().GetArea(rows->GetColumns()[link]);
  }

  const Choice& Chosen;
  vtkExchangeHierarchy* Found;
  vtkExchangeHierarchy* Expected;
};

//------------------------------------------------------------------------------
void TestLinks(const Case& setting)
{
  const Choice choice(setting);
  auto refiner = vtkSmartPointer<vtkDeviceLinkRefiner>::Take(vtkDeviceLinkRefiner::New());
  std::string reason;
  if (!Check(refiner && refiner->Open(reason), "a refiner: " + reason))
  {
    return;
  }
  ScatteringRows::Summary summaries[2];
  RefinementOnDevice device(refiner, choice.GetClusters());
  const auto expected = choice.Fill(nullptr, summaries[0]);
  const auto found = choice.Fill(&device, summaries[1]);
  const Comparison rows(choice, found, expected);
  const std::string what = setting.Name + (setting.IsUniform ? ", uniform" : ", adaptive");
  std::cout << what << ": " << rows.Links / static_cast<double>(expected->GetNumberOfPatches())
            << " links a patch, " << rows.Differences << " of " << rows.Links << " differ, "
            << vtkOpenGLLinkRefiner::SafeDownCast(refiner)->GetNumberOfTests()
            << " tests, values to " << rows.WorstValue << std::endl;
  Check(rows.Links > 0.0 && rows.Differences <= MostDifferences * rows.Links,
    what + ": " + std::to_string(rows.Differences) + " links differ");
  Check(rows.Others <= MostOthers * rows.Links,
    what + ": " + std::to_string(rows.Others) + " of them without need");
  Check(std::abs(summaries[1].Links - rows.Links) <= 2.0 * MostDifferences * rows.Links,
    what + ": as many links");
  Check(std::abs(summaries[1].LeftOut - summaries[0].LeftOut) <= MostDifferences * rows.Links,
    what + ": as many are left out");
  Check(rows.WorstValue < ValueTolerance,
    what + ": values of links to " + std::to_string(rows.WorstValue));
}

//------------------------------------------------------------------------------
void SetUp(Scattering* filter, vtkDataObject* data, bool onDevice)
{
  filter->SetInputDataObject(data);
  filter->SetMaterialToMarble();
  filter->SetMillimetersPerUnit(10.0);
  filter->SetLinkMethodToAdaptive();
  filter->SetNumberOfLinks(64);
  filter->SetDevice(onDevice ? Scattering::DEVICE_OPENGL : Scattering::DEVICE_CPU);
}

//------------------------------------------------------------------------------
vtkSmartPointer<Scattering> MakeFilter(vtkDataObject* data, bool onDevice)
{
  auto filter = vtkSmartPointer<Scattering>::New();
  SetUp(filter, data, onDevice);
  return filter;
}

//------------------------------------------------------------------------------
std::vector<double> GetScattered(Scattering* filter)
{
  filter->Update();
  vtkDataObject* output = filter->GetOutputDataObject(0);
  const int kind = vtkImageData::SafeDownCast(output) ? vtkDataObject::POINT : vtkDataObject::CELL;
  vtkDataArray* array = output->GetAttributes(kind)->GetArray("ScatteredIrradiance");
  std::vector<double> values;
  for (vtkIdType k = 0; array && k < array->GetNumberOfValues(); ++k)
  {
    values.push_back(array->GetComponent(k / 3, static_cast<int>(k % 3)));
  }
  return values;
}

//------------------------------------------------------------------------------
// By the filter, links and their product on the device or not.
void TestResults(const std::string& what, vtkDataObject* data, bool isUniform)
{
  const auto onCPU = MakeFilter(data, false);
  const auto onDevice = MakeFilter(data, true);
  for (Scattering* filter : { onCPU.Get(), onDevice.Get() })
  {
    filter->SetLinkMethod(
      isUniform ? Scattering::LINK_METHOD_UNIFORM : Scattering::LINK_METHOD_ADAPTIVE);
  }
  const std::vector<double> expected = GetScattered(onCPU);
  const std::vector<double> found = GetScattered(onDevice);
  Check(!expected.empty() && found.size() == expected.size(), what + ": results");
  double largest = 0.0;
  double worst = 0.0;
  for (std::size_t k = 0; k < std::min(found.size(), expected.size()); ++k)
  {
    largest = std::max(largest, std::abs(expected[k]));
    worst = std::max(worst, std::abs(found[k] - expected[k]));
  }
  std::cout << what << ": results to " << worst / largest << std::endl;
  Check(worst <= ValueTolerance * largest, what + ": results to " + std::to_string(worst));
  Check(GetText(onCPU->GetOutputDataObject(0), "LinksChosenOn") == "CPU", what + ": on the CPU");
  Check(GetText(onDevice->GetOutputDataObject(0), "LinksChosenOn").rfind("OpenGL (", 0) == 0,
    what + ": on OpenGL");
}

//------------------------------------------------------------------------------
void AddLight(vtkPolyData* data)
{
  vtkDoubleArray* light = AddArray(data, "Irradiance", { 0.0 });
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    data->GetCell(cell)->GetBounds(bounds);
    light->SetValue(cell, 1.0 + std::sin(3.0 * bounds[0]) + (cell % 7 == 0 ? 1.0 : 0.0));
  }
}

//------------------------------------------------------------------------------
// A bent sheet of texels; some have no surface.
vtkSmartPointer<vtkImageData> MakeTexels(int side)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(side, side, 1);
  const auto add = [&](const char* name, int components)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(image->GetNumberOfPoints());
    array->Fill(0.0);
    image->GetPointData()->AddArray(array);
    return array.Get();
  };
  vtkDoubleArray* positions = add("Position", 3);
  vtkDoubleArray* normals = add("Normal", 3);
  vtkDoubleArray* areas = add("Area", 1);
  vtkDoubleArray* light = add("Irradiance", 1);
  vtkNew<vtkIntArray> charts;
  charts->SetName("ChartId");
  charts->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(charts);
  for (vtkIdType texel = 0; texel < image->GetNumberOfPoints(); ++texel)
  {
    const double angle = 3.0 * static_cast<double>(texel % side) / side;
    const double height = static_cast<double>(texel / side) / side;
    const bool isEmpty = texel / side == 3;
    charts->SetValue(texel, isEmpty ? -1 : 0);
    positions->SetTuple3(texel, std::cos(angle), std::sin(angle), 3.0 * height);
    normals->SetTuple3(texel, std::cos(angle), std::sin(angle), 0.0);
    areas->SetValue(texel, isEmpty ? 0.0 : 9.0 / (side * side));
    light->SetValue(texel, 1.0 + std::sin(5.0 * angle) * std::cos(7.0 * height));
  }
  return image;
}

//------------------------------------------------------------------------------
// Refused alike.
void TestNothing()
{
  vtkNew<vtkPolyData> nothing;
  std::string messages[2];
  for (const bool onDevice : { false, true })
  {
    const auto filter = MakeFilter(nothing, onDevice);
    vtkNew<vtkTest::ErrorObserver> errors;
    vtkNew<vtkTest::ErrorObserver> pipeline;
    filter->AddObserver(vtkCommand::ErrorEvent, errors);
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipeline);
    Check(GetScattered(filter).empty() && errors->GetError(), "nothing comes of nothing");
    messages[onDevice ? 1 : 0] = errors->GetErrorMessage();
  }
  const auto getText = [](const std::string& message)
  { return message.substr(message.find("):")); };
  Check(getText(messages[0]) == getText(messages[1]), "the same error");
}

//------------------------------------------------------------------------------
// A cluster of more patches than geometry shaders can make pairs of.
void TestLimits()
{
  constexpr int patches = 100000;
  auto body = std::make_shared<vtkDeviceLinkRefiner::Body>();
  body->NumberOfNodes = 1;
  body->Slots.resize(1 + patches);
  for (vtkDeviceLinkRefiner::Slot& slot : body->Slots)
  {
    slot.Area = 1.0;
  }
  body->Slots[0].LastPatch = patches;
  body->Slots[0].FirstChild = 1;
  body->Slots[0].LastChild = 1 + patches;
  body->Profile.PieceBits = 6;
  body->Profile.Pieces.resize(10);
  vtkNew<vtkOpenGLLinkRefiner> refiner;
  std::string reason;
  std::vector<vtkDeviceLinkRefiner::Part> parts;
  Check(!refiner->Refine(0, 1, parts, reason) && !reason.empty(), "nothing to refine");
  reason.clear();
  Check(!refiner->Initialize(body, reason) && reason.find("100000 parts") != std::string::npos,
    "more children than the device takes: " + reason);
}

//------------------------------------------------------------------------------
// A software renderer is none that Auto takes.
void TestAuto(vtkPolyData* data)
{
  const auto filter = MakeFilter(data, true);
  filter->SetDeviceToAuto();
  Check(!GetScattered(filter).empty(), "Auto has a result");
  const std::string chosenOn = GetText(filter->GetOutputDataObject(0), "LinksChosenOn");
  vtkNew<vtkOpenGLLinkRefiner> refiner;
  std::string reason;
  const bool isHardware = refiner->Open(reason) && refiner->IsHardware();
  Check(isHardware ? chosenOn.rfind("OpenGL (", 0) == 0 : chosenOn == "CPU", "Auto: " + chosenOn);
}

//------------------------------------------------------------------------------
// Anywhere in a run; the next one of the same filter is whole.
void TestAborts(vtkPolyData* data)
{
  const auto filter = vtkSmartPointer<Attentive<Scattering>>::New();
  SetUp(filter, data, true);
  vtkNew<Listener> listener;
  filter->AddObserver(vtkCommand::ProgressEvent, listener);
  const std::vector<double> expected = GetScattered(filter);
  Check(!expected.empty(), "a whole run");
  for (const int event : { 3, 30, 300 })
  {
    listener->Progress.clear();
    listener->AbortAt = event;
    // Another tolerance: links anew.
    filter->SetLinkTolerance(2e-2);
    Check(GetScattered(filter).empty(), "aborted at event " + std::to_string(event));
    listener->AbortAt = 0;
    filter->SetAbortExecute(0);
    filter->SetLinkTolerance(0.0);
    Check(GetScattered(filter) == expected, "the next run is whole");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenGLLinkRefiner(int, char*[])
{
  const vtkSmartPointer<vtkPolyData> bunny = ReadBunny();
  const vtkSmartPointer<vtkPolyData> sphere = MakeSphere(3);
  const std::vector<Case> cases{
    { "bunny", bunny, 40.0, Scattering::MODEL_DIPOLE, false, 64, 1e-2 },
    { "bunny", bunny, 40.0, Scattering::MODEL_DIPOLE, true, 64, 1e-2 },
    { "small sphere", sphere, 1.0, Scattering::MODEL_DIPOLE, false, 0, 1e-2 },
    { "large sphere", MakeSphere(2), 500.0, Scattering::MODEL_DIPOLE, false, 0, 1e-2 },
    { "sphere far away", MoveFarAway(sphere), 20.0, Scattering::MODEL_PHOTON_BEAM_DIFFUSION, false,
      0, 1e-2 },
    { "two-sided sheet", MakeTwoSidedSheet(), 20.0, Scattering::MODEL_CHRISTENSEN_BURLEY, false, 64,
      1e-3 },
    { "two-sided sheet", MakeTwoSidedSheet(), 20.0, Scattering::MODEL_DIPOLE, true, 16, 1e-2 },
  };
  for (const Case& setting : cases)
  {
    TestLinks(setting);
  }
  const vtkSmartPointer<vtkPolyData> small = MakeSphere(2);
  AddLight(small);
  TestResults("sphere", small, false);
  TestResults("sphere", small, true);
  TestResults("texels", MakeTexels(16), false);
  Surface triangle;
  triangle.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  const vtkSmartPointer<vtkPolyData> one = triangle.Get();
  AddLight(one);
  TestResults("one patch", one, false);
  TestNothing();
  TestLimits();
  TestAuto(small);
  TestAborts(small);
  return Result();
}
