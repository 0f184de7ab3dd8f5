// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Monte Carlo in meshes, through the filter: its errors, its totals, and bodies of every kind.
#include "Links/Links.h"
#include "PhotonScatteringTesting.h"
#include "Photons/PhotonLinks.h"
#include "RanksInThreads.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkReverseSense.h"

#include <algorithm>
#include <functional>

using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSphere(int levels)
{
  Surface surface;
  AddSphere(surface, 1.0, levels, false);
  auto data = surface.Get();
  AddArray(data, "Irradiance", { 1.0 });
  return data;
}

//------------------------------------------------------------------------------
void TestSums()
{
  PhotonRun run(MakeSphere(3));
  run.Filter->SetMaterialToMarble();
  run.Filter->SetMillimetersPerUnit(3.77);
  CheckWorks(run, "a sphere of marble");
  CheckClose(run.GetNumber("PhotonsTraced"), 20000, 0.0, "photons as asked for");
  CheckClose(run.GetNumber("LeavingFlux") / run.GetNumber("EnteringFlux"),
    run.GetNumber("LeavingShare"), 1e-9, "what leaves patches leaves the body");
}

//------------------------------------------------------------------------------
/// Nothing bends the light at an index of 1: near edges it could leave through one face and enter
/// through the other for ever.
void TestEdges()
{
  PhotonRun run(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  run.SetMedium(1.0, 0.005, 1.0);
  run.Filter->SetMillimetersPerUnit(60.0);
  run.Filter->SetNumberOfPhotons(400000);
  CheckWorks(run, "edges at an index of 1");
  CheckClose(run.GetNumber("EntriesPerPhoton"), 1.0, 1e-5, "a box is entered once");
}

//------------------------------------------------------------------------------
void TestTarget()
{
  PhotonRun run(MakeSphere(1));
  run.Filter->SetNumberOfPhotons(0);
  run.Filter->SetTargetError(0.02);
  CheckWorks(run, "a target of 2 %");
  const double photons = run.GetNumber("PhotonsTraced");
  Check(run.GetNumber("RelativeError") <= 0.02 && run.GetNumber("RelativeError") > 0.01,
    "an error of " + std::to_string(run.GetNumber("RelativeError")) + " where 0.02 was asked for");
  run.Filter->SetTargetError(0.01);
  run.Filter->Update();
  CheckClose(run.GetNumber("PhotonsTraced") / photons, 4.0, 0.2, "photons for half the error");
}

//------------------------------------------------------------------------------
std::vector<double> GetResult(int threads, int seed)
{
  PhotonRun run(MakeBox({ 0, 0, 0 }, { 1, 2, 3 }, 3));
  run.Filter->SetSeed(seed);
  run.Filter->SetAnisotropy(0.0, 0.5, 0.5);
  return run.GetValues("ScatteredIrradiance", threads);
}

//------------------------------------------------------------------------------
void TestSameBits()
{
  const std::vector<double> one = GetResult(1, 1);
  Check(one == GetResult(3, 1), "the same bits on three threads");
  Check(one != GetResult(1, 2), "other photons with another seed");
}

//------------------------------------------------------------------------------
/// Nothing is absorbed: all must come out again, whatever the body.
void TestBodies()
{
  const auto check = [](vtkDataObject* data, const std::string& what,
                       const std::function<void(vtkSubsurfaceScattering*)>& change = {})
  {
    PhotonRun run(data);
    run.SetMedium(1.0, 0.0, 1.4);
    if (change)
    {
      change(run.Filter);
    }
    CheckWorks(run, what);
    CheckClose(run.GetAccounted(), 1.0, 1e-6, what + ": all that enters");
    Check(run.GetNumber("LostShare") < 1e-4, what + ": nothing is lost");
  };
  check(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }), "a box");
  check(MakeBox({ 6e6, -4e6, 2e6 }, { 6e6 + 10, -4e6 + 10, 2e6 + 10 }, 3), "a box far away");
  check(MakeBox({ 0.1, 0.7, 0.3 }, { 1.3, 1.9, 1.7 }, 3, true), "a box in single precision");
  check(MakeBox({ 0, 0, 0 }, { 100, 0.01, 0.01 }, 1), "a needle");
  check(MakeBox({ 0, 0, 0 }, { 10, 10, 1e-3 }, 4), "a thin sheet");
  check(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2), "a body of a thousandth of a mean free path",
    [](vtkSubsurfaceScattering* filter) { filter->SetMillimetersPerUnit(1e-3); });
  check(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2), "an index of 1",
    [](vtkSubsurfaceScattering* filter) { filter->SetRefractiveIndex(1.0); });
  for (const double anisotropy : { -0.9, 0.99 })
  {
    check(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2), "anisotropy " + std::to_string(anisotropy),
      [anisotropy](vtkSubsurfaceScattering* filter)
      { filter->SetAnisotropy(anisotropy, anisotropy, anisotropy); });
  }

  Surface two;
  AddBox(two, { 0, 0, 0 }, { 1, 1, 1 }, 2);
  AddBox(two, { 1.2, 0, 0 }, { 2, 1, 1 }, 3);
  auto bodies = two.Get();
  AddArray(bodies, "Irradiance", { 1.0 });
  check(bodies, "two bodies");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2));
  blocks->SetBlock(1, MakeBox({ 1, 0, 0 }, { 2, 1, 1 }, 3));
  check(blocks, "two bodies that touch, in two blocks");

  // One face of the box is cut otherwise than its neighbors.
  Surface cut;
  cut.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 3, 2);
  cut.AddGrid({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 5, 5);
  cut.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 7, 2);
  cut.AddGrid({ 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, 1, 1);
  cut.AddGrid({ 0, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, 4, 3);
  cut.AddGrid({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 2, 2);
  auto unlike = cut.Get();
  AddArray(unlike, "Irradiance", { 1.0 });
  check(unlike, "faces that are meshed differently");
}

//------------------------------------------------------------------------------
/// Links, once made, give for any light what photons of that light give.
void TestLinks()
{
  const auto makeBody = []()
  {
    Surface surface;
    AddBox(surface, { 0, 0, 0 }, { 1, 2, 3 }, 3);
    AddBox(surface, { 1.3, 0, 0 }, { 2, 2, 1 }, 2);
    return surface.Get();
  };
  auto even = makeBody();
  AddArray(even, "Irradiance", { 1.0, 1.0, 1.0 });
  PhotonRun links(even);
  links.Filter->SetLinkMethodToDense();
  links.Filter->SetNumberOfPhotons(1000000);
  links.Filter->SetScatteringCoefficient(2.0, 1.0, 0.5);
  CheckWorks(links, "links of photons");
  CheckClose(links.GetNumber("LinksReused"), 0.0, 0.0, "links are new");
  Check(links.GetNumber("LinkErrorBound") < 0.02, "links have an error");

  auto uneven = makeBody();
  vtkDoubleArray* light = AddArray(uneven, "Irradiance", { 1.0, 0.5, 0.1 });
  light->SetComponent(3, 0, 5.0);
  light->SetComponent(60, 2, 5.0);
  links.Filter->SetInputData(uneven);
  CheckWorks(links, "links of photons in other light");
  CheckClose(links.GetNumber("LinksReused"), 1.0, 0.0, "links are kept");

  PhotonRun photons(uneven);
  photons.Filter->SetNumberOfPhotons(1000000);
  photons.Filter->SetSeed(2);
  photons.Filter->SetScatteringCoefficient(2.0, 1.0, 0.5);
  CheckWorks(photons, "photons in other light");
  double squares = 0.0;
  int beyond = 0;
  const vtkIdType values = 3 * uneven->GetNumberOfCells();
  for (vtkIdType k = 0; k < values; ++k)
  {
    const auto get = [k](const PhotonRun& run, const char* name)
    { return run.Get(name)->GetComponent(k / 3, k % 3); };
    const double deviation =
      (get(links, "ScatteredIrradiance") - get(photons, "ScatteredIrradiance")) /
      std::hypot(get(links, "ScatteredIrradianceError"), get(photons, "ScatteredIrradianceError"));
    squares += deviation * deviation / values;
    beyond += std::abs(deviation) > 3.0;
  }
  CheckClose(squares, 1.0, 0.25, "squares of deviations over errors, of links");
  Check(beyond <= 4, std::to_string(beyond) + " of 234 values beyond three errors");
}

//------------------------------------------------------------------------------
void TestMedia()
{
  PhotonRun nothing(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  nothing.SetMedium(0.0, 0.5, 1.3);
  CheckWorks(nothing, "a medium that does not scatter");
  double range[2];
  nothing.Get("ScatteredIrradiance")->GetRange(range);
  CheckClose(range[1], 0.0, 0.0, "nothing comes out of it scattered");
  nothing.Get("ScatteredIrradianceError")->GetRange(range);
  CheckClose(range[1], 0.0, 0.0, "and that is certain");
  Check(nothing.GetNumber("UnscatteredShare") > 0.1, "but some runs through");

  PhotonRun dark(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  AddArray(vtkPolyData::SafeDownCast(dark.Filter->GetInputDataObject(0, 0)), "Irradiance", { 0.0 });
  CheckWorks(dark, "no light");
  CheckClose(dark.GetNumber("PhotonsTraced"), 0.0, 0.0, "no photons without light");

  // Only what is lit starts photons, and the far side has the error of one where none arrives.
  PhotonRun lit(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  lit.SetMedium(1.0, 0.1, 1.3);
  lit.Filter->SetMillimetersPerUnit(200.0);
  auto* light = vtkPolyData::SafeDownCast(lit.Filter->GetInputDataObject(0, 0));
  AddArray(light, "Irradiance", { 0.0 })->SetComponent(0, 0, 1.0);
  CheckWorks(lit, "one lit face");
  Check(lit.Get("ScatteredIrradiance")->GetComponent(0, 0) > 0.2, "it is bright");
  CheckClose(lit.Get("ScatteredIrradiance")->GetComponent(1, 0), 0.0, 0.0, "the far side is not");
  CheckClose(lit.Get("ScatteredIrradianceError")->GetComponent(1, 0),
    lit.GetNumber("EnteringFlux") / 20000.0, 1e-9, "the far side's error");
}

//------------------------------------------------------------------------------
/// Photons and links are the same to the last bit on one rank and on three.
void TestRanks()
{
  using namespace LightTransport;
  auto body = MakeBox({ 0, 0, 0 }, { 1, 2, 3 }, 3);
  const std::vector<ScatteringMedium> media = { { 1.0, 0.1, 1.3 }, { 2.0, 0.1, 1.3 },
    { 1.0, 0.2, 1.3, 0.3 } };
  PhotonScattering::Settings settings;
  settings.NumberOfPhotons = 20000;
  const auto compute = [&](const Ranks& ranks, std::vector<double>& result)
  {
    PatchScene scene;
    Check(bool(scene.Build(body, Ranks())), "scene built");
    const std::size_t values = 3 * scene.GetNumberOfPatches();
    const PhotonScattering scattering(scene, PhotonScattering::GetMedia(media, scene.GetScale()),
      1.3, nullptr);
    PhotonScattering::Result photons;
    Check(
      bool(scattering.Run(std::vector<double>(values, 1.0), settings, ranks, Monitor(), photons)),
      "photons followed");
    result = photons.Scattered;
    result.insert(result.end(), photons.Errors.begin(), photons.Errors.end());
    Links links;
    const PhotonLinks builder(media, 1.0, settings, nullptr);
    Check(bool(builder.Build(scene, ranks, Monitor(), links)), "links built");
    std::vector<double> all;
    for (std::size_t k = 0; k < values * values / 3; ++k)
    {
      const auto patches = static_cast<vtkIdType>(values / 3);
      const auto pair = static_cast<vtkIdType>(k / 3);
      all.push_back(
        links.Matrix->GetValue(pair / patches, pair % patches, static_cast<int>(k % 3)));
    }
    ranks.Sum(all);
    result.insert(result.end(), all.begin(), all.end());
  };
  std::vector<double> one, three[3];
  compute(Ranks(), one);
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    { compute(Ranks(controller), three[rank]); });
  for (const std::vector<double>& result : three)
  {
    Check(result == one, "three ranks get the bits of one");
  }
}

//------------------------------------------------------------------------------
void TestRefusals()
{
  Surface lid;
  AddBox(lid, { 0, 0, 0 }, { 1, 1, 1 });
  auto box = lid.Get();
  Surface open;
  open.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  auto sheet = open.Get();
  AddArray(sheet, "Irradiance", { 1.0 });
  PhotonRun hole(sheet);
  CheckFails(hole, "The surface is open: 8 edges", "a sheet of one side");

  vtkNew<vtkReverseSense> turn;
  turn->SetInputData(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  turn->Update();
  PhotonRun inside(turn->GetOutput());
  CheckFails(inside, "The surface around (0.5, 0.5, 0.5) is inside out", "an inside-out box");

  // A sheet of two sides in one place.
  Surface both;
  both.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  both.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 2, 2);
  auto sides = both.Get();
  AddArray(sides, "Irradiance", { 1.0 });
  PhotonRun flat(sides);
  CheckFails(flat, "has no inside", "a sheet of two sides");

  Surface crossing;
  AddBox(crossing, { 0, 0, 0 }, { 1, 1, 1 }, 2);
  AddBox(crossing, { 0.5, 0.3, 0.3 }, { 1.7, 0.8, 0.8 }, 2);
  auto crossed = crossing.Get();
  AddArray(crossed, "Irradiance", { 1.0 });
  PhotonRun across(crossed);
  CheckFails(across, "the surface crosses itself", "bodies that cross");

  AddArray(box, "Irradiance", { -1.0 });
  PhotonRun negative(box);
  CheckFails(negative, "negative", "negative light");

  PhotonRun strange(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  strange.Filter->SetAnisotropy(0.0, 1.0, 0.0);
  CheckFails(strange, "Component 1 of Anisotropy is 1", "an anisotropy of 1");

  PhotonRun device(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  device.Filter->SetDeviceToOpenGL();
  device.Filter->Update();
  Check(!device.Errors->GetAll().empty(), "OpenGL is refused");
}
} // namespace

//------------------------------------------------------------------------------
int TestPhotonScattering(int, char*[])
{
  TestSums();
  TestEdges();
  TestTarget();
  TestSameBits();
  TestBodies();
  TestLinks();
  TestMedia();
  TestRefusals();
  TestRanks();
  return Result();
}
