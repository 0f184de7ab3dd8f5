// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Single scattering against the closed form of a half space, and against photons that start in the
// same light and are counted when they were scattered once.
#include "LightTransportTesting.h"
#include "MessageLog.h"
#include "Photons/FlatBoundaries.h"
#include "Photons/MeshBoundary.h"
#include "Photons/PhotonWalk.h"
#include "Photons/UniformPath.h"
#include "RanksInThreads.h"
#include "Scattering/SingleScattering.h"
#include "Shared/Fresnel.h"
#include "VoxelBodies.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkSingleScattering.h"

#ifdef TEST_WITH_MESHING
#include "vtkPatchMesher.h"
#endif

#include <algorithm>
#include <sstream>

using namespace LightTransport;
using namespace LightTransportTesting;

namespace
{
using Vector = Eigen::Vector3d;

//------------------------------------------------------------------------------
void AddBox(Surface& surface, const Point& low, const Point& high, int n)
{
  const Point u = { high[0] - low[0], 0, 0 };
  const Point v = { 0, high[1] - low[1], 0 };
  const Point w = { 0, 0, high[2] - low[2] };
  surface.AddGrid({ low[0], low[1], high[2] }, u, v, n, n);
  surface.AddGrid(low, v, u, n, n);
  surface.AddGrid(low, u, w, n, n);
  surface.AddGrid({ low[0], high[1], low[2] }, w, u, n, n);
  surface.AddGrid(low, w, v, n, n);
  surface.AddGrid({ high[0], low[1], low[2] }, v, w, n, n);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeBox(const Point& low, const Point& high, int n,
  bool isSingle = false)
{
  Surface surface(isSingle);
  AddBox(surface, low, high, n);
  return surface.Get();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSphere(int levels)
{
  Surface surface;
  AddSphere(surface, 1.0, levels, false);
  return surface.Get();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeSky(int width, double radiance)
{
  auto sky = vtkSmartPointer<vtkImageData>::New();
  sky->SetDimensions(width, width / 2, 1);
  sky->AllocateScalars(VTK_DOUBLE, 1);
  for (vtkIdType pixel = 0; pixel < sky->GetNumberOfPoints(); ++pixel)
  {
    sky->GetPointData()->GetScalars()->SetComponent(pixel, 0, radiance);
  }
  return sky;
}

//------------------------------------------------------------------------------
struct Run
{
  vtkNew<vtkSingleScattering> Filter;
  vtkNew<MessageLog> Errors;
  vtkNew<MessageLog> Warnings;

  explicit Run(vtkDataObject* data)
  {
    this->Filter->SetInputDataObject(data);
    this->Filter->AddObserver(vtkCommand::ErrorEvent, this->Errors);
    this->Filter->AddObserver(vtkCommand::WarningEvent, this->Warnings);
    this->Filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Errors);
  }

  void SetMedium(const std::array<double, 3>& scattering, double absorption, double index)
  {
    this->Filter->SetScatteringCoefficient(scattering[0], scattering[1], scattering[2]);
    this->Filter->SetAbsorptionCoefficient(absorption, absorption, absorption);
    this->Filter->SetRefractiveIndex(index);
  }
  vtkLight* AddLight(const Vector& position, bool isPositional)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(position.x(), position.y(), position.z());
    light->SetPositional(isPositional);
    light->SetConeAngle(180.0);
    light->SetAttenuationValues(0, 0, isPositional ? 1 : 0);
    if (!isPositional)
    {
      light->SetAttenuationValues(1, 0, 0);
    }
    this->Filter->AddLight(light);
    return light;
  }
  void Update(const std::string& what)
  {
    this->Filter->Update();
    Check(this->Errors->GetAll().empty() && this->Warnings->GetAll().empty(),
      what + " says: " + this->Errors->GetAll() + this->Warnings->GetAll());
  }
  double Get(vtkIdType patch, int band, bool isError = false) const
  {
    auto* output = vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0));
    vtkDataArray* array = output
      ? output->GetCellData()->GetArray(
          isError ? "SingleScatteredIrradianceError" : "SingleScatteredIrradiance")
      : nullptr;
    return array ? array->GetComponent(patch, band) : vtkMath::Nan();
  }
  double GetFlux(int band) const
  {
    return this->Filter->GetOutputDataObject(0)
      ->GetFieldData()
      ->GetArray("SingleScatteredFlux")
      ->GetComponent(0, band);
  }
};

//------------------------------------------------------------------------------
/// A path that ends where it would be scattered again.
class OncePath : public UniformPath
{
public:
  using UniformPath::UniformPath;
  PhotonEvent Meet(PhotonRandom& random)
  {
    const PhotonEvent event = UniformPath::Meet(random);
    return this->GetNumberOfScatterings() < 2 ? event : PhotonEvent::ENDED;
  }
};

//------------------------------------------------------------------------------
/// What leaves through each patch after one scattering, of three bands.
class OnceListener : public PhotonListener
{
public:
  explicit OnceListener(vtkIdType patches) : Sums(3 * patches, 0.0), Squares(3 * patches, 0.0) {}
  void Start(const OncePath& path) { this->Path = &path; }
  void Leave(vtkIdType patch, const Vector&, const double* weights) override
  {
    for (int band = 0; this->Path->GetNumberOfScatterings() == 1 && band < 3; ++band)
    {
      this->Sums[3 * patch + band] += weights[band];
      this->Squares[3 * patch + band] += weights[band] * weights[band];
    }
  }
  void Escape(bool, const double*) override {}
  void Lose(const Vector&, const double*) override {}

private:
  const OncePath* Path = nullptr;

public:
  std::vector<double> Sums;
  std::vector<double> Squares;
};

//------------------------------------------------------------------------------
/// Photons of a light, each of which carries the same flux.
struct PhotonLight
{
  std::function<PhotonStart(PhotonRandom&)> Start;
  double Flux; ///< of all of them
  bool IsInside;
};

//------------------------------------------------------------------------------
OnceListener FollowOnce(const PhotonBoundary& boundary, vtkIdType patches,
  const std::vector<PhotonMedium>& media, double index, const PhotonLight& light, int photons)
{
  const PhotonWalk walk(boundary, index, media[0].Anisotropy);
  const UniformBands bands(media);
  OnceListener once(patches);
  PhotonWalk::Counts counts;
  for (int k = 0; k < photons; ++k)
  {
    PhotonRandom random(1, k);
    OncePath path(bands, k % 3);
    once.Start(path);
    walk.Follow(light.Start(random), light.IsInside, path, random, once, counts);
  }
  return once;
}

//------------------------------------------------------------------------------
/// The whole of a box's upper side, far from its edges, in free paths.
void TestHalfSpace()
{
  for (const double index : { 1.0, 1.3, 1.5 })
  {
    Run run(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 1));
    run.Filter->SetRefractiveIndex(index);
    run.Filter->SetScatteringCoefficient(0.2, 0.9, 0.999);
    run.Filter->SetAbsorptionCoefficient(0.8, 0.1, 0.001);
    run.Filter->SetMillimetersPerUnit(5000.0);
    run.Filter->SetNumberOfSamples(1024);
    run.AddLight({ 0, 0, 1 }, false);
    run.Update("a half space");
    const double albedos[3] = { 0.2, 0.9, 0.999 };
    for (int band = 0; band < 3; ++band)
    {
      const SingleScattering exact({ albedos[band], 1.0 - albedos[band], index });
      const double expected = exact.GetTotal() * (1.0 - Fresnel::GetReflectance(1.0, index));
      std::ostringstream name;
      name << "a half space of albedo " << albedos[band] << " and index " << index;
      CheckClose(run.Get(0, band), expected, 2e-3, name.str());
      Check(run.Get(0, band, true) < 4e-3 * expected, name.str() + " knows its error");
    }
  }
}

//------------------------------------------------------------------------------
/// The same in even light, against photons, with anisotropy.
void TestDiffuseHalfSpace()
{
  constexpr int photons = 50000;
  for (const double index : { 1.0, 1.5 })
  {
    for (const double anisotropy : { 0.0, 0.7 })
    {
      const std::vector<PhotonMedium> media = { { 0.5, 0.5, anisotropy }, { 0.9, 0.1, anisotropy },
        { 0.9, 0.0, anisotropy } };
      const HalfSpaceBoundary halfSpace;
      const PhotonWalk walk(halfSpace, index, anisotropy);
      const PhotonLight light{ [&walk](PhotonRandom& random)
        {
          return PhotonStart{ Vector::Zero(), walk.Enter(Vector::UnitZ(), random), 0 };
        },
        1.0 - Fresnel::GetMeanExternalReflectance(index), true };
      const OnceListener once = FollowOnce(halfSpace, 1, media, index, light, photons);

      Run run(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 1));
      run.Filter->SetEnvironment(MakeSky(8, 1.0 / vtkMath::Pi()));
      run.Filter->SetScatteringCoefficient(0.5 * (1.0 - anisotropy), 0.9 * (1.0 - anisotropy),
        0.9 * (1.0 - anisotropy));
      run.Filter->SetAbsorptionCoefficient(0.5, 0.1, 0.0);
      run.Filter->SetAnisotropy(anisotropy, anisotropy, anisotropy);
      run.Filter->SetRefractiveIndex(index);
      run.Filter->SetMillimetersPerUnit(5000.0);
      run.Filter->SetNumberOfSamples(8192);
      run.Update("a half space in even light");
      for (int band = 0; band < 3; ++band)
      {
        const double mean = once.Sums[band] / photons;
        const double error = std::sqrt((once.Squares[band] / photons - mean * mean) / photons);
        std::ostringstream name;
        name << "even light, index " << index << ", anisotropy " << anisotropy << ", band " << band;
        const double expected = light.Flux * mean;
        const double mine = run.Get(0, band, true);
        Check(std::abs(run.Get(0, band) - expected) < 3.5 * std::hypot(light.Flux * error, mine),
          name.str() + ": " + std::to_string(run.Get(0, band)) + " instead of " +
            std::to_string(expected));
        Check(mine < 0.05 * expected, name.str() + ": error " + std::to_string(mine / expected));
      }
    }
  }
}

//------------------------------------------------------------------------------
/// What a body gives back, beside photons: in all, and patch by patch.
void CompareWithPhotons(Run& run, vtkPolyData* data, const std::vector<PhotonMedium>& media,
  double index, const PhotonLight& light, const std::string& name)
{
  constexpr int photons = 60000;
  PatchScene scene;
  MeshBoundary boundary;
  if (!Check(bool(scene.Build(data, Ranks())) && bool(boundary.Build(scene, 1.0)), name + " built"))
  {
    return;
  }
  run.Update(name);
  std::vector<PhotonMedium> scaled = media;
  for (PhotonMedium& medium : scaled)
  {
    medium.Scattering *= scene.GetScale();
    medium.Absorption *= scene.GetScale();
  }
  PhotonLight placed = light;
  placed.Start = [&light, &scene](PhotonRandom& random)
  {
    PhotonStart start = light.Start(random);
    start.Position = (start.Position - scene.GetCenter()) / scene.GetScale();
    return start;
  };
  const vtkIdType patches = scene.GetNumberOfPatches();
  const OnceListener once = FollowOnce(boundary, patches, scaled, index, placed, photons);
  for (int band = 0; band < 3; ++band)
  {
    double sum = 0.0, squares = 0.0, all = 0.0, counted = 0.0;
    for (vtkIdType patch = 0; patch < patches; ++patch)
    {
      const double left = once.Sums[3 * patch + band];
      const double left2 = once.Squares[3 * patch + band];
      sum += left;
      squares += left2;
      if (left < 15.0)
      {
        continue;
      }
      const double area = scene.GetAreas()[patch] * scene.GetScale() * scene.GetScale();
      const double value = light.Flux * left / photons / area;
      const double walked = light.Flux * std::sqrt(left2) / photons / area;
      const vtkIdType polygon = scene.GetPolygon(patch);
      const double error = std::hypot(walked, run.Get(polygon, band, true));
      all += std::pow((run.Get(polygon, band) - value) / error, 2);
      counted += 1.0;
    }
    const double total = light.Flux * sum / photons;
    const double error = std::sqrt(squares) / sum;
    const double excess = run.GetFlux(band) / total - 1.0;
    Check(std::abs(excess) < 4.0 * error,
      name + ": flux off by " + std::to_string(excess) + " +- " + std::to_string(error));
    Check(all / counted < 1.0 + 6.0 * std::sqrt(2.0 / counted),
      name + ": squares of deviations over errors " + std::to_string(all / counted));
  }
}

//------------------------------------------------------------------------------
/// Parallel light along -z, over a square that the body is in.
PhotonLight MakeBeam(double x, double y, double half, double high)
{
  return { [=](PhotonRandom& random)
    {
      const double u = 2.0 * random.Get() - 1.0;
      const double v = 2.0 * random.Get() - 1.0;
      return PhotonStart{ Vector(x + half * u, y + half * v, high), -Vector::UnitZ(), -1 };
    },
    4.0 * half * half, false };
}

//------------------------------------------------------------------------------
void TestSphere()
{
  // The last one is thin: much is reflected inside before it is scattered.
  for (const double freePaths : { 5.0, 0.5 })
  {
    for (const double index : { 1.0, 1.4 })
    {
      auto sphere = MakeSphere(2);
      Run run(sphere);
      run.SetMedium({ 0.5, 0.8, 1.0 }, 0.2, index);
      run.Filter->SetMillimetersPerUnit(freePaths);
      run.AddLight({ 0, 0, 1 }, false);
      const double scale = freePaths;
      const std::vector<PhotonMedium> media = { { 0.5 * scale, 0.2 * scale, 0.0 },
        { 0.8 * scale, 0.2 * scale, 0.0 }, { scale, 0.2 * scale, 0.0 } };
      std::ostringstream name;
      name << "a sphere of " << freePaths << " free paths and index " << index;
      CompareWithPhotons(run, sphere, media, index, MakeBeam(0, 0, 1.0, 2.0), name.str());
    }
  }
}

//------------------------------------------------------------------------------
/// Boxes send much light from side to side, and a horseshoe from leg to leg.
void TestBoxes()
{
  for (const bool isConcave : { false, true })
  {
    auto body = isConcave ? MakeCubes(MakeHorseshoe(), 2) : MakeCubes({ { 0, 0, 0 } }, 4);
    Run run(body);
    run.SetMedium({ 0.5, 0.8, 1.0 }, 0.2, 1.4);
    run.Filter->SetNumberOfSamples(512);
    const Vector towards(0.3, 0.5, 1.0);
    run.AddLight(towards, false);
    const std::vector<PhotonMedium> media = { { 0.5, 0.2, 0.0 }, { 0.8, 0.2, 0.0 },
      { 1.0, 0.2, 0.0 } };
    // Parallel light over a square that faces it.
    const Vector middle = isConcave ? Vector(1.5, 0.5, 1.5) : Vector(0.5, 0.5, 0.5);
    const double half = isConcave ? 2.5 : 1.0;
    const Vector axis = -towards.normalized();
    const PhotonLight light{ [=](PhotonRandom& random)
      {
        const Vector u = axis.unitOrthogonal();
        const double a = half * (2.0 * random.Get() - 1.0);
        const double b = half * (2.0 * random.Get() - 1.0);
        return PhotonStart{ middle + a * u + b * axis.cross(u) - 6.0 * axis, axis, -1 };
      },
      4.0 * half * half, false };
    CompareWithPhotons(run, body, media, 1.4, light, isConcave ? "a horseshoe" : "a box");
  }
}

//------------------------------------------------------------------------------
/// The legs of a horseshoe light each other under an even sky, too.
void TestHollowSky()
{
  auto body = MakeCubes(MakeHorseshoe(), 2);
  Run run(body);
  run.SetMedium({ 0.5, 0.8, 1.0 }, 0.2, 1.4);
  run.Filter->SetNumberOfSamples(512);
  run.Filter->SetEnvironment(MakeSky(8, 1.0 / vtkMath::Pi()));
  const std::vector<PhotonMedium> media = { { 0.5, 0.2, 0.0 }, { 0.8, 0.2, 0.0 },
    { 1.0, 0.2, 0.0 } };
  // From a sphere around it, even in all directions.
  const double radius = 2.3;
  const PhotonLight light{ [radius](PhotonRandom& random)
    {
      const Vector outward = random.GetDirection();
      const Vector tangent = outward.unitOrthogonal();
      double u, v;
      const double square = random.GetInCircle(u, v);
      const Vector direction =
        u * tangent + v * outward.cross(tangent) - std::sqrt(1.0 - square) * outward;
      return PhotonStart{ Vector(1.5, 0.5, 1.5) + radius * outward, direction, -1 };
    },
    4.0 * vtkMath::Pi() * radius * radius, false };
  CompareWithPhotons(run, body, media, 1.4, light, "a horseshoe under the sky");
}

//------------------------------------------------------------------------------
void TestPointLight()
{
  auto sphere = MakeSphere(2);
  Run run(sphere);
  run.SetMedium({ 0.5, 0.8, 1.0 }, 0.2, 1.4);
  run.Filter->SetMillimetersPerUnit(3.0);
  const Vector place(0.5, 0.0, 1.8);
  run.AddLight(place, true);
  const std::vector<PhotonMedium> media = { { 1.5, 0.6, 0.0 }, { 2.4, 0.6, 0.0 },
    { 3.0, 0.6, 0.0 } };
  // Into the cone that the sphere is in.
  const double distance = place.norm();
  const double cosine = std::sqrt(1.0 - 1.0 / (distance * distance));
  const Vector axis = -place / distance;
  const PhotonLight light{ [=](PhotonRandom& random)
    {
      const double height = 1.0 - (1.0 - cosine) * random.Get();
      const double angle = 2.0 * vtkMath::Pi() * random.Get();
      const Vector tangent = axis.unitOrthogonal();
      const double sine = std::sqrt(1.0 - height * height);
      return PhotonStart{ place,
        height * axis + sine * (std::cos(angle) * tangent + std::sin(angle) * axis.cross(tangent)),
        -1 };
    },
    2.0 * vtkMath::Pi() * (1.0 - cosine), false };
  CompareWithPhotons(run, sphere, media, 1.4, light, "a sphere and a point light");
}

#ifdef TEST_WITH_MESHING
//------------------------------------------------------------------------------
void TestBunny()
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(LIGHTTRANSPORT_DATA_DIRECTORY "/bunny.ply");
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputConnection(reader->GetOutputPort());
  mesher->SetTargetNumberOfPatches(500);
  mesher->Update();
  vtkPolyData* bunny = mesher->GetOutput();
  double bounds[6];
  bunny->GetBounds(bounds);
  const double size = bounds[5] - bounds[4];
  Run run(bunny);
  run.SetMedium({ 0.5, 0.8, 1.0 }, 0.2, 1.4);
  run.Filter->SetMillimetersPerUnit(20.0 / size);
  run.AddLight({ 0, 0, 1 }, false);
  const double scale = 20.0 / size;
  const std::vector<PhotonMedium> media = { { 0.5 * scale, 0.2 * scale, 0.0 },
    { 0.8 * scale, 0.2 * scale, 0.0 }, { scale, 0.2 * scale, 0.0 } };
  const double half = 0.5 * std::max(bounds[1] - bounds[0], bounds[3] - bounds[2]) + 1e-3 * size;
  CompareWithPhotons(run, bunny, media, 1.4,
    MakeBeam(0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]), half,
      bounds[5] + 0.1 * size),
    "the bunny");
}
#endif

//------------------------------------------------------------------------------
/// The result of a band on all patches.
std::vector<double> GetResult(vtkDataObject* data, const std::string& what,
  const std::function<void(Run&)>& change = {})
{
  Run run(data);
  run.SetMedium({ 0.5, 0.8, 1.0 }, 0.1, 1.4);
  run.Filter->SetNumberOfSamples(64);
  if (change)
  {
    change(run);
  }
  else
  {
    run.AddLight({ 1, 2, 3 }, false);
  }
  run.Update(what);
  std::vector<double> result;
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(run.Filter->GetOutputDataObject(0));
  for (unsigned int block = 0; block < (blocks ? blocks->GetNumberOfBlocks() : 1u); ++block)
  {
    auto* output = vtkPolyData::SafeDownCast(
      blocks ? blocks->GetBlock(block) : run.Filter->GetOutputDataObject(0));
    vtkDataArray* array = output->GetCellData()->GetArray("SingleScatteredIrradiance");
    Check(output->GetPointData()->HasArray("SingleScatteredIrradiance"), what + ": point array");
    for (vtkIdType cell = 0; array && cell < array->GetNumberOfTuples(); ++cell)
    {
      result.push_back(array->GetComponent(cell, 1));
    }
  }
  return result;
}

//------------------------------------------------------------------------------
double GetMean(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value / values.size();
  }
  return sum;
}

//------------------------------------------------------------------------------
void CheckAlike(const std::vector<double>& a, const std::vector<double>& b, double tolerance,
  const std::string& what)
{
  if (Check(a.size() == b.size(), what + ": as many patches"))
  {
    double off = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
    {
      off = std::max(off, std::abs(a[k] - b[k]));
    }
    CheckClose(off / GetMean(b), 0.0, tolerance, what);
  }
}

//------------------------------------------------------------------------------
/// The same body, as it may come.
void TestInputs()
{
  const auto box = GetResult(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 4), "a box");
  Check(GetMean(box) > 0.02, "a box gives something back");
  // Points in space are the same, so that only the coordinates' worth differs.
  CheckAlike(GetResult(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 4, true), "a box in single precision"),
    box, 1e-9, "single precision");
  CheckAlike(
    GetResult(MakeBox({ 6e6, 6e5, 1e6 }, { 6e6 + 1, 6e5 + 1, 1e6 + 1 }, 4), "a box far away"), box,
    1e-3, "far away");
  for (const int threads : { 1, 3 })
  {
    std::vector<double> result;
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads),
      [&result]() {
        result = GetResult(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 4), "threads");
      });
    CheckAlike(result, box, 0.0, std::to_string(threads) + " threads");
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 4));
  CheckAlike(GetResult(blocks, "a block"), box, 0.0, "a block");
  vtkNew<vtkMultiBlockDataSet> two;
  two->SetBlock(0, MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 4));
  two->SetBlock(1, MakeBox({ 5, 0, 0 }, { 6, 1, 1 }, 4));
  const auto both = GetResult(two, "two bodies");
  Check(both.size() == 2 * box.size(), "both bodies have results");
  CheckClose(GetMean(both), GetMean(box), 0.02, "two bodies that do not shade each other");

  Surface sheet;
  sheet.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  Run open(sheet.Get());
  open.AddLight({ 0, 0, 1 }, false);
  open.Filter->Update();
  Check(open.Errors->GetAll().find("The surface is open: 4 edges") != std::string::npos &&
      open.Errors->GetAll().find("the longest is at (0.5, ") != std::string::npos,
    "one patch, which is open, is refused with the place: " + open.Errors->GetAll());
  Run strange(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 1));
  strange.AddLight({ 0, 0, 1 }, false);
  strange.Filter->SetAnisotropy(0.0, 1.0, 0.0);
  strange.Filter->Update();
  Check(strange.Errors->GetAll().find("Component 1 of Anisotropy is 1") != std::string::npos,
    "an anisotropy of 1 is refused");
  Run dark(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 1));
  dark.Filter->Update();
  Check(dark.Warnings->GetAll().find("No light is on") != std::string::npos, "no light is told");
}

//------------------------------------------------------------------------------
/// Three ranks, the last without anything, get what one gets.
void TestRanks()
{
  auto data = MakeCubes(MakeHorseshoe(), 2);
  const auto one = GetResult(data, "one rank");
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      vtkNew<vtkPolyData> part;
      part->DeepCopy(data);
      part->BuildLinks();
      std::vector<double> expected;
      for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
      {
        if (rank == (cell < 50 ? 0 : 1))
        {
          expected.push_back(one[cell]);
        }
        else
        {
          part->DeleteCell(cell);
        }
      }
      part->RemoveDeletedCells();
      const auto mine = GetResult(part, "three ranks",
        [controller](Run& run)
        {
          run.Filter->SetController(controller);
          run.AddLight({ 1, 2, 3 }, false);
        });
      Check(rank < 2 ? !mine.empty() : mine.empty(), "two of three ranks have patches");
      for (std::size_t k = 0; k < mine.size() && k < expected.size(); ++k)
      {
        CheckClose(mine[k], expected[k], 1e-9, "three ranks");
      }
    });
}

//------------------------------------------------------------------------------
/// What is not followed is missing, and no more than that.
void TestMinimumContribution()
{
  auto box = MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2);
  std::vector<double> means;
  for (const double least : { 1e-8, 1e-4, 0.1 })
  {
    means.push_back(GetMean(GetResult(box, "a minimum",
      [least](Run& run)
      {
        run.AddLight({ 1, 2, 3 }, false);
        run.Filter->SetMinimumContribution(least);
      })));
  }
  CheckClose(means[1], means[0], 1e-3, "the default of MinimumContribution");
  CheckClose(means[2], means[0], 0.2, "the largest MinimumContribution");
  Check(means[2] < 0.999 * means[0], "a large MinimumContribution costs light");
}

//------------------------------------------------------------------------------
/// Where edges of bodies meet, rays that leave one and enter another at once come to an end.
void TestTouchingEdges()
{
  Surface bodies;
  AddBox(bodies, { 1, 0, 0 }, { 2, 1, 1 }, 1);
  AddBox(bodies, { 2, 0, 0 }, { 3, 1, 1e-6 }, 1);
  AddBox(bodies, { 1, 1, 0 }, { 2, 2, 1 }, 1);
  Run run(bodies.Get());
  run.SetMedium({ 1, 1, 10 }, 0.0, 1.0);
  run.Filter->SetNumberOfSamples(1024);
  run.AddLight({ 1, 2, 3 }, false);
  run.Filter->Update();
  Check(run.Errors->GetAll().empty() && run.GetFlux(1) > 0.0, "edges that touch");
}

//------------------------------------------------------------------------------
void TestMedia()
{
  auto box = MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2);
  const auto black = GetResult(box, "albedo 0",
    [](Run& run)
    {
      run.AddLight({ 0, 0, 1 }, false);
      run.SetMedium({ 0, 0, 0 }, 1.0, 1.4);
    });
  CheckClose(*std::max_element(black.begin(), black.end()), 0.0, 0.0, "albedo 0 gives nothing");
  // Where next to nothing is scattered it is scattered once, the more the longer the way.
  const auto getThin = [](double size)
  {
    Run run(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2));
    run.SetMedium({ 0.5, 0.8, 1.0 }, 0.1, 1.4);
    run.Filter->SetMillimetersPerUnit(size);
    run.AddLight({ 1, 2, 3 }, false);
    run.Update("a thin body");
    return run.GetFlux(1) / size;
  };
  CheckClose(getThin(1e-4), getThin(1e-6), 1e-2, "thin bodies");
  Check(getThin(1e-18) >= 0.0, "a body that is next to nothing");
  // Bands that differ a thousandfold share their rays.
  const auto get = [&box](double other)
  {
    return GetMean(GetResult(box, "bands",
      [other](Run& run)
      {
        run.AddLight({ 0, 0, 1 }, false);
        run.SetMedium({ other, 0.8, 0.8 }, 0.1, 1.4);
        run.Filter->SetNumberOfSamples(1024);
      }));
  };
  CheckClose(get(800.0), get(0.8), 0.02, "beside a band that scatters much more");
}

//------------------------------------------------------------------------------
/// A disc, a sun in a picture and a far lamp are a directional light, and samples converge.
void TestLights()
{
  auto sphere = MakeSphere(1);
  const Vector towards(1.0, 0.5, 1.0);
  const auto light = [&](const std::function<void(Run&)>& change)
  {
    return GetResult(sphere, "lights",
      [&](Run& run)
      {
        run.Filter->SetNumberOfSamples(256);
        change(run);
      });
  };
  const auto even = light([&](Run& run) { run.AddLight(towards, false); });
  CheckAlike(light(
               [&](Run& run)
               {
                 run.AddLight(towards, false);
                 run.Filter->SetLightAngularDiameter(0.5);
               }),
    even, 0.04, "a disc");
  CheckAlike(light([&](Run& run)
               { run.AddLight(1e5 * towards, true)->SetIntensity(1e10 * towards.squaredNorm()); }),
    even, 5e-3, "a far lamp");
  CheckAlike(light(
               [&](Run& run)
               {
                 auto sky = MakeSky(720, 0.0);
                 const double latitude = std::asin(towards.normalized().z());
                 const int row = static_cast<int>((latitude / vtkMath::Pi() + 0.5) * 360);
                 const int column = static_cast<int>(std::atan2(0.5, 1.0) / vtkMath::Pi() * 360);
                 const double size = std::pow(vtkMath::Pi() / 360, 2) *
                   std::cos((row + 0.5 - 180) * vtkMath::Pi() / 360);
                 sky->GetPointData()->GetScalars()->SetComponent(row * 720 + column, 0, 1.0 / size);
                 run.Filter->SetEnvironment(sky);
               }),
    even, 0.05, "a sun in a picture");
}

//------------------------------------------------------------------------------
/// Errors are what results differ by from those of many samples, and fall with their number.
void TestErrors()
{
  auto sphere = MakeSphere(1);
  for (const bool isSky : { false, true })
  {
    const auto make = [&](Run& run, int samples)
    {
      run.SetMedium({ 0.5, 0.8, 1.0 }, 0.1, 1.4);
      run.Filter->SetNumberOfSamples(samples);
      isSky ? run.Filter->SetEnvironment(MakeSky(8, 0.3)) : void(run.AddLight({ 0, 0, 1 }, false));
      run.Update("a sphere");
    };
    Run reference(sphere);
    make(reference, 512);
    double last = 0.0;
    for (const int samples : { 32, 128 })
    {
      Run run(sphere);
      make(run, samples);
      double squares = 0.0, expected = 0.0;
      for (vtkIdType patch = 0; patch < sphere->GetNumberOfCells(); ++patch)
      {
        squares += std::pow(run.Get(patch, 1) - reference.Get(patch, 1), 2);
        expected +=
          std::pow(run.Get(patch, 1, true), 2) + std::pow(reference.Get(patch, 1, true), 2);
      }
      const std::string name =
        (isSky ? "a sky, " : "a light, ") + std::to_string(samples) + " samples";
      CheckClose(std::sqrt(squares / expected), 0.9, 0.35, name + ": differences over errors");
      Check(last == 0.0 || squares < 0.4 * last, name + ": less than with a quarter of them");
      last = squares;
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestSingleScattering(int, char*[])
{
  TestHalfSpace();
  TestDiffuseHalfSpace();
  TestSphere();
  TestBoxes();
  TestHollowSky();
  TestPointLight();
#ifdef TEST_WITH_MESHING
  TestBunny();
#endif
  TestInputs();
  TestMedia();
  TestLights();
  TestErrors();
  TestMinimumContribution();
  TestTouchingEdges();
  TestRanks();
  return Result();
}
