// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Monte Carlo in bodies that are hollow, tiny, huge, thin, clear or all but clear, against what
// holds in every body, and light along a direction against diffuse light.
#include "PhotonScatteringTesting.h"
#include "PhotonWalkTesting.h"
#include "Photons/MeshBoundary.h"
#include "Photons/PhotonWalk.h"
#include "Photons/UniformPath.h"
#include "vtkImageData.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

using namespace LightTransport;
using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
/// Counts what is absorbed where it is, at each scattering.
class AbsorbingPath
{
public:
  AbsorbingPath(const UniformBands& bands, double albedo) : Path(bands, 0), Albedo(albedo) {}

  double ChooseStep(const Eigen::Vector3d& from, const Eigen::Vector3d& to, PhotonRandom& random)
  {
    return this->Path.ChooseStep(from, to, random);
  }
  void Advance(double distance) { this->Path.Advance(distance); }
  PhotonEvent Meet(PhotonRandom& random)
  {
    double weight;
    this->Path.GetWeights(&weight);
    this->Absorbed += weight * (1.0 - this->Albedo);
    return this->Path.Meet(random);
  }
  long long GetNumberOfEvents() const { return this->Path.GetNumberOfEvents(); }
  long long GetNumberOfScatterings() const { return this->Path.GetNumberOfScatterings(); }
  void GetWeights(double* weights) const { this->Path.GetWeights(weights); }

  double Absorbed = 0.0;

private:
  UniformPath Path;
  double Albedo;
};

//------------------------------------------------------------------------------
struct GoneListener : public PhotonListener
{
  double Escaped = 0.0;
  double Lost = 0.0;

  void Leave(vtkIdType, const Eigen::Vector3d&, const double*) override {}
  void Escape(bool, const double* weights) override { this->Escaped += weights[0]; }
  void Lose(const Eigen::Vector3d&, const double* weights) override { this->Lost += weights[0]; }
};

//------------------------------------------------------------------------------
/// What enters a bowl that nothing else lights leaves, or is absorbed: here, where it is, and
/// there, as weight that photons lack, many of them by chance.
void TestBowl()
{
  constexpr double index = 1.4;
  for (const double albedo : { 0.8, 0.6 })
  {
    PatchScene scene;
    MeshBoundary boundary;
    Check(bool(scene.Build(MakeBowl(0.3), Ranks())) && bool(boundary.Build(scene, 1.0)), "a bowl");
    const PhotonWalk walk(boundary, index, 0.3);
    const double scattering = 20.0; // in scene units
    const UniformBands bands({ { scattering, scattering * (1.0 / albedo - 1.0), 0.3 } });
    Deviations energy;
    PhotonWalk::Counts counts;
    double absorbed = 0.0;
    for (int seed = 0; seed < Seeds; ++seed)
    {
      double sum = 0.0, squares = 0.0;
      for (int k = 0; k < PhotonsPerSeed; ++k)
      {
        PhotonRandom random(seed, k);
        const auto patch = static_cast<vtkIdType>(random.Get() * scene.GetNumberOfPatches());
        const PhotonStart start{ scene.GetCentroid(patch),
          walk.Enter(scene.GetNormal(patch), random), patch };
        AbsorbingPath path(bands, albedo);
        GoneListener gone;
        walk.Follow(start, true, path, random, gone, counts);
        Check(gone.Lost == 0.0, "no photon is lost in a bowl");
        const double excess = gone.Escaped + path.Absorbed - 1.0;
        absorbed += path.Absorbed / (Seeds * PhotonsPerSeed);
        sum += excess;
        squares += excess * excess;
      }
      energy.Add(sum, squares, PhotonsPerSeed, 0.0);
    }
    const double entries = double(counts.Entries) / (Seeds * PhotonsPerSeed);
    std::cout << "bowl of albedo " << albedo << ": " << absorbed << " is absorbed, " << entries
              << " entries\n";
    Check(absorbed > 0.2 && entries > 1.05, "light is absorbed, and enters again");
    energy.CheckNormal("what leaves a bowl and what is absorbed in it");
  }
}

//------------------------------------------------------------------------------
/// The same bowl by another way of walking, through an image of one value.
void TestBowlByImage()
{
  const auto bowl = MakeBowl(0.3);
  const auto set = [](PhotonRun& run, long long photons)
  {
    run.SetMedium(5.0, 0.3, 1.4);
    run.Filter->SetNumberOfPhotons(photons);
  };
  PhotonRun uniform(bowl);
  set(uniform, 50000);
  CheckWorks(uniform, "a bowl");
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  image->SetOrigin(-1.5, -1.5, -1.5);
  image->SetSpacing(1.5, 1.5, 1.5);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Scattering");
  values->SetNumberOfValues(8);
  values->FillValue(5.0);
  image->GetCellData()->AddArray(values);
  PhotonRun varying(bowl);
  set(varying, 150000);
  varying.Filter->SetInputData(1, image);
  varying.Filter->SetSeed(2);
  CheckWorks(varying, "a bowl by an image");
  CheckSame(uniform, varying, "a bowl by two ways of walking");
  Check(std::abs(uniform.GetNumber("LeavingShare") - varying.GetNumber("LeavingShare")) < 3.0 *
        std::hypot(uniform.GetNumber("LeavingShareError"), varying.GetNumber("LeavingShareError")),
    "what leaves a bowl, by two ways of walking");
}

//------------------------------------------------------------------------------
struct BoxCase
{
  const char* Name;
  Point Size;
  double Index;
  double Anisotropy;
  double Millimeters;
  int Photons;
};

//------------------------------------------------------------------------------
/// Without absorption, in even light: n^2 mu_s 4 V / (S (1 - F)) scatterings for each entry in any
/// convex body, however large, thin or clear.
void TestScatterings()
{
  const BoxCase cases[] = {
    { "a thousandth of a free path", { 1, 1, 1 }, 1.4, 0.0, 1e-3, 20000 },
    { "a needle", { 100, 0.01, 0.01 }, 1.4, 0.0, 1.0, 5000 },
    { "a thin sheet", { 10, 10, 1e-3 }, 1.4, 0.0, 1.0, 20000 },
    { "an index of 1", { 1, 1, 1 }, 1.0, 0.0, 30.0, 2000 },
    { "thirty free paths", { 1, 1, 1 }, 1.5, 0.0, 30.0, 2000 },
    { "backward scattering", { 1, 2, 1 }, 1.4, -0.9, 3.0, 2000 },
    { "forward scattering", { 1, 2, 1 }, 1.4, 0.99, 1.0, 2000 },
  };
  for (const BoxCase& test : cases)
  {
    const Point& size = test.Size;
    const double volume = size[0] * size[1] * size[2];
    const double area = 2.0 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
    const double expected = test.Index * test.Index * test.Millimeters / (1.0 - test.Anisotropy) *
      4.0 * volume / (area * (1.0 - Fresnel::GetMeanExternalReflectance(test.Index)));
    double sum = 0.0, squares = 0.0;
    for (int seed = 1; seed <= Seeds; ++seed)
    {
      PhotonRun run(MakeBox({ 0, 0, 0 }, size, 2));
      run.SetMedium(1.0, 0.0, test.Index);
      run.Filter->SetAnisotropy(test.Anisotropy, test.Anisotropy, test.Anisotropy);
      run.Filter->SetMillimetersPerUnit(test.Millimeters);
      run.Filter->SetNumberOfPhotons(test.Photons);
      run.Filter->SetSeed(seed);
      CheckWorks(run, test.Name);
      CheckClose(run.GetAccounted(), 1.0, 1e-6, std::string(test.Name) + ": all that enters");
      const double ratio =
        run.GetNumber("ScatteringsPerPhoton") / run.GetNumber("EntriesPerPhoton");
      sum += ratio / Seeds;
      squares += ratio * ratio / Seeds;
    }
    const double error = std::sqrt((squares - sum * sum) / (Seeds - 1));
    std::cout << test.Name << ": " << sum << " +- " << error << " scatterings of " << expected
              << "\n";
    Check(std::abs(sum - expected) < MostDeviations * error && error < 0.1 * expected,
      std::string("scatterings, ") + test.Name);
  }
}

//------------------------------------------------------------------------------
/// A hundred thousand free paths across: as a half space where light is absorbed; where none is,
/// photons are given up after so many steps, which is told.
void TestHuge()
{
  const auto box = MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2);
  Deviations totals;
  for (int seed = 1; seed <= Seeds; ++seed)
  {
    PhotonRun run(box);
    run.SetMedium(0.9, 0.1, 1.3);
    run.Filter->SetMillimetersPerUnit(1e5);
    run.Filter->SetNumberOfPhotons(PhotonsPerSeed);
    run.Filter->SetSeed(seed);
    CheckWorks(run, "a huge body");
    totals.AddMean(run.GetNumber("LeavingShare"), run.GetNumber("LeavingShareError"),
      0.288334 / (1.0 - Fresnel::GetMeanExternalReflectance(1.3)));
    Check(run.GetNumber("ScatteringsPerPhoton") < 50.0, "its photons do not walk for long");
  }
  totals.CheckNormal("what leaves a huge body");

  PhotonRun clear(box);
  clear.SetMedium(1.0, 0.0, 1.3);
  clear.Filter->SetMillimetersPerUnit(1e5);
  clear.Filter->SetNumberOfPhotons(1000);
  clear.Filter->Update();
  CheckClose(clear.GetAccounted(), 1.0, 1e-6, "all that enters a huge body");
  std::cout << "huge body without absorption: " << clear.GetNumber("ScatteringsPerPhoton")
            << " scatterings, lost " << clear.GetNumber("LostShare") << "\n";
  Check(clear.GetNumber("ScatteringsPerPhoton") < 3e4, "work is bounded");
  Check(clear.GetNumber("LostShare") < 0.01, "few photons are given up");

  PhotonRun beyond(box);
  beyond.Filter->SetMillimetersPerUnit(1e7);
  beyond.Filter->SetNumberOfPhotons(1000);
  beyond.Filter->Update();
  Check(beyond.Warnings->GetAll().find("free paths from end to end") != std::string::npos,
    "more free paths than coordinates can tell");
}

//------------------------------------------------------------------------------
void TestAllButClear()
{
  const auto follow = [](double absorption, int seed)
  {
    PhotonRun run(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2));
    run.SetMedium(1.0, absorption, 1.4);
    run.Filter->SetMillimetersPerUnit(10.0);
    run.Filter->SetSeed(seed);
    CheckWorks(run, "hardly any absorption");
    CheckClose(run.GetAccounted(), 1.0, 1e-6, "all that enters, with hardly any absorption");
    return std::make_pair(run.GetNumber("LeavingShare"), run.GetNumber("LeavingShareError"));
  };
  const auto none = follow(0.0, 1);
  const auto hardly = follow(1e-9, 2);
  Check(std::abs(none.first - hardly.first) < 3.0 * std::hypot(none.second, hardly.second),
    "hardly any absorption is none");
}

//------------------------------------------------------------------------------
/// Far from each other two bodies are what each is alone.
void TestTwoBodies()
{
  Surface surface;
  AddBox(surface, { 0, 0, 0 }, { 1, 1, 1 }, 2);
  AddBox(surface, { 40, 0, 0 }, { 41, 2, 3 }, 2);
  const auto both = surface.Get();
  AddArray(both, "Irradiance", { 1.0 });
  PhotonRun two(both);
  two.Filter->SetNumberOfPhotons(200000);
  CheckWorks(two, "two bodies");
  const vtkSmartPointer<vtkPolyData> boxes[2] = { MakeBox({ 0, 0, 0 }, { 1, 1, 1 }, 2),
    MakeBox({ 40, 0, 0 }, { 41, 2, 3 }, 2) };
  for (vtkIdType body = 0; body < 2; ++body)
  {
    PhotonRun one(boxes[body]);
    one.Filter->SetSeed(static_cast<int>(body) + 2);
    one.Filter->SetNumberOfPhotons(100000);
    CheckWorks(one, "one of two bodies");
    double squares = 0.0;
    for (vtkIdType patch = 0; patch < 24; ++patch)
    {
      const auto get = [](const PhotonRun& run, const char* name, vtkIdType k)
      { return run.Get(name)->GetComponent(k, 0); };
      const vtkIdType inBoth = 24 * body + patch;
      const double deviation =
        (get(two, "ScatteredIrradiance", inBoth) - get(one, "ScatteredIrradiance", patch)) /
        std::hypot(get(two, "ScatteredIrradianceError", inBoth),
          get(one, "ScatteredIrradianceError", patch));
      squares += deviation * deviation / 24.0;
      Check(std::abs(deviation) < 4.0, "a patch of one of two bodies");
    }
    CheckClose(squares, 1.0, MostDeviations * std::sqrt(2.0 / 24.0), "one of two bodies");
  }
}

//------------------------------------------------------------------------------
/// Of what enters the upper side of a cube, which part leaves scattered.
double GetLeaving(double side, double albedo, const Light& light, double& error)
{
  constexpr int photons = 100000;
  PatchScene scene;
  MeshBoundary boundary;
  Check(bool(scene.Build(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }), Ranks())) &&
      bool(boundary.Build(scene, 1.0)),
    "a cube");
  vtkIdType upper = 0;
  while (scene.GetNormal(upper).z() < 0.5)
  {
    ++upper;
  }
  const Eigen::Vector3d up = scene.GetNormal(upper);
  const Eigen::Vector3d origin = scene.GetCorner(upper, 0);
  const Eigen::Vector3d u = scene.GetCorner(upper, 1) - origin;
  const Eigen::Vector3d v = scene.GetCorner(upper, 3) - origin;
  const PhotonWalk walk(boundary, light.Index, 0.0);
  const double extinction = side / u.norm();
  const UniformBands bands({ { albedo * extinction, (1.0 - albedo) * extinction, 0.0 } });
  PhotonWalk::Counts counts;
  double sum = 0.0, squares = 0.0;
  for (int k = 0; k < photons; ++k)
  {
    PhotonRandom random(1, k);
    Sums one(1);
    UniformPath path(bands, 0);
    const double a = random.Get();
    const double b = random.Get();
    const Eigen::Vector3d direction = light.IsDiffuse ? walk.Enter(up, random) : -up;
    walk.Follow({ origin + a * u + b * v, direction, upper }, true, path, random, one, counts);
    const double left = one.Left[0][0] + one.Left[1][0];
    sum += left / photons;
    squares += left * left / photons;
  }
  error = std::sqrt((squares - sum * sum) / photons);
  return sum;
}

//------------------------------------------------------------------------------
/// Light along the normal goes deeper than diffuse light, and less of it comes back: in a half
/// space (H functions), and less so, or the other way round, in bodies.
void TestBeam()
{
  struct Case
  {
    double Side, Albedo, Index, Exact; ///< diffuse light over that along the normal, or 0
  };
  for (const Case& test : { Case{ 1e4, 0.5, 1.0, 0.146544 / 0.115226 },
         Case{ 1e4, 0.9, 1.5, 0.216112 / 0.219919 * 0.96 / (1.0 - 0.0917779) },
         Case{ 10.0, 0.5, 1.0, 0.0 }, Case{ 1.0, 0.5, 1.0, 0.0 }, Case{ 0.1, 0.5, 1.0, 0.0 },
         Case{ 10.0, 0.9, 1.5, 0.0 }, Case{ 1.0, 0.9, 1.5, 0.0 } })
  {
    double errors[2];
    const double diffuse = GetLeaving(test.Side, test.Albedo, { true, test.Index }, errors[0]);
    const double beam = GetLeaving(test.Side, test.Albedo, { false, test.Index }, errors[1]);
    const double ratio = diffuse / beam;
    const double error = ratio * std::hypot(errors[0] / diffuse, errors[1] / beam);
    std::ostringstream name;
    name << "cube of " << test.Side << " free paths, albedo " << test.Albedo << ", index "
         << test.Index;
    std::cout << name.str() << ": diffuse light " << diffuse << ", over that along the normal "
              << ratio << " +- " << error << "\n";
    if (test.Exact > 0.0)
    {
      Check(std::abs(ratio - test.Exact) < 3.0 * error, name.str() + ", entry");
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestPhotonBodies(int, char*[])
{
  TestBowl();
  TestBowlByImage();
  TestScatterings();
  TestHuge();
  TestAllButClear();
  TestTwoBodies();
  TestBeam();
  return Result();
}
