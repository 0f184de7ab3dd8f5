// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Monte Carlo in media that vary: layers against exact tables and against adding-doubling,
// images of one value against uniform media, and what is refused.
#include "PhotonScatteringTesting.h"
#include "PhotonWalkTesting.h"
#include "Photons/FlatBoundaries.h"
#include "Photons/PhotonWalk.h"
#include "Photons/VaryingPath.h"
#include "RanksInThreads.h"
#include "Shared/GaussLegendre.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <Eigen/LU>

#include <array>
#include <functional>

using namespace LightTransport;
using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
void AddTo(vtkDataSetAttributes* attributes, const char* name, const std::vector<double>& values,
  int components = 1)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  attributes->AddArray(array);
}

//------------------------------------------------------------------------------
/// Of so many voxels between two corners.
vtkSmartPointer<vtkImageData> MakeImage(const Point& low, const Point& high,
  const std::array<int, 3>& voxels)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  // Indices need not begin with 0: the origin is that of index 0.
  double origin[3], spacing[3];
  int extent[6];
  for (int axis = 0; axis < 3; ++axis)
  {
    spacing[axis] = (high[axis] - low[axis]) / voxels[axis];
    origin[axis] = low[axis] - 7.0 * spacing[axis];
    extent[2 * axis] = 7;
    extent[2 * axis + 1] = 7 + voxels[axis];
  }
  image->SetExtent(extent);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  return image;
}

//------------------------------------------------------------------------------
/// A slab below z = 0 whose voxels, or layers of points, have these values from below.
vtkSmartPointer<vtkImageData> MakeLayers(double thickness, bool isOnPoints,
  const std::vector<double>& scattering, const std::vector<double>& absorption)
{
  constexpr double wide = 1e6;
  const auto layers = static_cast<int>(scattering.size()) - (isOnPoints ? 1 : 0);
  auto image = MakeImage({ -wide, -wide, -thickness }, { wide, wide, 0.0 }, { 1, 1, layers });
  const auto repeat = [isOnPoints](const std::vector<double>& values)
  {
    std::vector<double> all;
    for (const double value : values)
    {
      all.insert(all.end(), isOnPoints ? 4 : 1, value);
    }
    return all;
  };
  vtkDataSetAttributes* attributes =
    isOnPoints ? static_cast<vtkDataSetAttributes*>(image->GetPointData()) : image->GetCellData();
  AddTo(attributes, "Scattering", repeat(scattering));
  AddTo(attributes, "Absorption", repeat(absorption));
  return image;
}

//------------------------------------------------------------------------------
Sums Follow(const PhotonBoundary& boundary, const VaryingMedium& medium, double anisotropy,
  const Light& light, int seed)
{
  const PhotonWalk walk(boundary, light.Index, anisotropy);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Sums sums(1);
  PhotonWalk::Counts counts;
  for (int k = 0; k < PhotonsPerSeed; ++k)
  {
    PhotonRandom random(seed, k);
    VaryingPath path(medium);
    const Eigen::Vector3d direction = light.IsDiffuse ? walk.Enter(up, random) : -up;
    walk.Follow({ Eigen::Vector3d::Zero(), direction, 0 }, true, path, random, sums, counts);
  }
  return sums;
}

//------------------------------------------------------------------------------
/// Layers of one albedo are, from outside, a uniform slab of the same optical thickness, whatever
/// their extinctions are (adding-doubling, albedo 0.9, anisotropy 0.75, optical thickness 2).
void TestOpticalThickness()
{
  constexpr double anisotropy = 0.75, albedo = 0.9, thickness = 4.0;
  struct Case
  {
    const char* Name;
    bool IsOnPoints;
    std::vector<double> Extinctions;
    double Covered; ///< from above
  };
  std::vector<double> fine, knots;
  for (int k = 0; k <= 100; ++k)
  {
    fine.push_back(0.25 * (k % 5));
  }
  knots.assign(fine.begin(), fine.begin() + 41);
  fine.pop_back();
  const std::vector<Case> cases = { { "one layer", false, { 0.5 }, thickness },
    { "four layers, one of them empty", false, { 0.2, 1.5, 0.0, 0.3 }, thickness },
    { "a hundred layers", false, fine, thickness }, { "a ramp", true, { 0.0, 1.0 }, thickness },
    { "forty ramps", true, knots, thickness },
    { "two layers upon the medium around", false, { 0.9, 0.1 }, 2.0 } };
  for (const Case& test : cases)
  {
    std::vector<double> scattering, absorption;
    for (const double extinction : test.Extinctions)
    {
      scattering.push_back(extinction * albedo * (1.0 - anisotropy));
      absorption.push_back(extinction * (1.0 - albedo));
    }
    MediumImage image;
    Check(bool(image.Read(MakeLayers(test.Covered, test.IsOnPoints, scattering, absorption),
            { Eigen::Vector3d::Zero(), 1.0, 1.0 })),
      std::string(test.Name) + " are read");
    const VaryingMedium medium(image, { 0.5 * albedo, 0.5 * (1.0 - albedo), anisotropy }, 1);
    Deviations reflected, transmitted;
    for (int seed = 0; seed < Seeds; ++seed)
    {
      const Sums normal = Follow(SlabBoundary(thickness), medium, anisotropy, { false, 1.0 }, seed);
      reflected.Add(normal.Left[0][0], normal.Squares[0][0], PhotonsPerSeed, 0.097395);
      transmitted.Add(normal.Left[1][0] + normal.Unscattered[0],
        normal.Squares[1][0] + normal.Unscattered[0], PhotonsPerSeed, 0.660958);
    }
    reflected.CheckNormal(std::string("reflectance of ") + test.Name);
    transmitted.CheckNormal(std::string("transmittance of ") + test.Name);
  }
}

//------------------------------------------------------------------------------
struct Layer
{
  double Thickness, Scattering, Absorption;
};

//------------------------------------------------------------------------------
/// What layers that scatter isotropically do with light along the normal, by adding and doubling
/// (H. C. van de Hulst): matrices between directions, of which the first is the normal, and the
/// others those of Gauss's rule.
class Stack
{
public:
  explicit Stack(const Layer& layer)
  {
    constexpr int doublings = 20;
    const double depth =
      std::ldexp(layer.Thickness * (layer.Scattering + layer.Absorption), -doublings);
    const double scattered = std::ldexp(layer.Thickness * layer.Scattering, -doublings);
    this->Reflected = Matrix::Zero(Size, Size);
    this->Transmitted = Matrix::Zero(Size, Size);
    for (int to = 0; to < Size; ++to)
    {
      for (int from = 0; from < Size && to > 0; ++from)
      {
        this->Reflected(to, from) = 0.5 * scattered / GetCosine(to) * GetWeight(from);
      }
    }
    this->Transmitted = this->Reflected;
    for (int to = 0; to < Size; ++to)
    {
      this->Transmitted(to, to) += 1.0 - depth / GetCosine(to);
    }
    this->ReflectedBelow = this->Reflected;
    this->TransmittedUp = this->Transmitted;
    for (int k = 0; k < doublings; ++k)
    {
      this->Add(Stack(*this));
    }
  }

  /// Another one below.
  void Add(const Stack& below)
  {
    const Matrix one = Matrix::Identity(Size, Size);
    const Matrix down =
      (one - this->ReflectedBelow * below.Reflected).inverse() * this->Transmitted;
    const Matrix up =
      (one - below.Reflected * this->ReflectedBelow).inverse() * below.TransmittedUp;
    this->Reflected += this->TransmittedUp * below.Reflected * down;
    this->Transmitted = below.Transmitted * down;
    this->ReflectedBelow = below.ReflectedBelow + below.Transmitted * this->ReflectedBelow * up;
    this->TransmittedUp *= up;
  }

  double GetReflectance() const { return Sum(this->Reflected); }
  double GetTransmittance() const { return Sum(this->Transmitted); }

private:
  using Matrix = Eigen::MatrixXd;
  static constexpr int Size = 25;

  static const GaussLegendre& GetRule()
  {
    static const GaussLegendre rule(Size - 1);
    return rule;
  }
  static double GetCosine(int direction)
  {
    return direction > 0 ? GetRule().Nodes[direction - 1] : 1.0;
  }
  static double GetWeight(int direction)
  {
    return direction > 0 ? GetRule().Weights[direction - 1] : 1.0;
  }
  static double Sum(const Matrix& matrix)
  {
    double sum = 0.0;
    for (int to = 0; to < Size; ++to)
    {
      sum += GetWeight(to) * GetCosine(to) * matrix(to, 0);
    }
    return sum;
  }

  ///@{ Of light from above and from below.
  Matrix Reflected, Transmitted;
  Matrix ReflectedBelow, TransmittedUp;
  ///@}
};

//------------------------------------------------------------------------------
void TestLayers()
{
  // Published.
  const Stack slab({ 2.0, 0.9, 0.1 });
  CheckClose(slab.GetReflectance(), 0.361649, 1e-5, "reflectance by adding-doubling");
  CheckClose(slab.GetTransmittance(), 0.356501, 1e-5, "transmittance by adding-doubling");
  const std::vector<std::vector<Layer>> cases = {
    { { 1.0, 0.0, 0.3 }, { 1.0, 5.0, 0.01 }, { 1.0, 0.2, 0.1 } },
    { { 0.5, 10.0, 0.1 }, { 0.5, 0.0, 0.0 }, { 0.5, 0.0, 2.0 }, { 0.5, 3.0, 0.0 } },
    { { 2.0, 1.0, 0.0 }, { 2.0, 0.1, 0.5 } },
  };
  for (std::size_t test = 0; test < cases.size(); ++test)
  {
    const std::vector<Layer>& layers = cases[test];
    std::vector<double> scattering, absorption;
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
    {
      scattering.push_back(layer->Scattering);
      absorption.push_back(layer->Absorption);
    }
    const double thickness = layers.size() * layers[0].Thickness;
    MediumImage image;
    Check(bool(image.Read(MakeLayers(thickness, false, scattering, absorption),
            { Eigen::Vector3d::Zero(), 1.0, 1.0 })),
      "layers are read");
    const VaryingMedium medium(image, { 7.0, 7.0, 0.0 }, 0);
    Stack stack(layers[0]);
    for (std::size_t k = 1; k < layers.size(); ++k)
    {
      stack.Add(Stack(layers[k]));
    }
    Deviations reflected, transmitted;
    for (int seed = 0; seed < Seeds; ++seed)
    {
      const Sums sums = Follow(SlabBoundary(thickness), medium, 0.0, { false, 1.0 }, seed);
      reflected.Add(sums.Left[0][0], sums.Squares[0][0], PhotonsPerSeed, stack.GetReflectance());
      transmitted.Add(sums.Left[1][0] + sums.Unscattered[0],
        sums.Squares[1][0] + sums.Unscattered[0], PhotonsPerSeed, stack.GetTransmittance());
    }
    reflected.CheckNormal("reflectance of layers " + std::to_string(test));
    transmitted.CheckNormal("transmittance of layers " + std::to_string(test));
  }
}

//------------------------------------------------------------------------------
void SetUniform(PhotonRun& run)
{
  run.Filter->SetScatteringCoefficient(2.0, 1.0, 0.5);
  run.Filter->SetAbsorptionCoefficient(0.1, 0.05, 0.2);
  run.Filter->SetAnisotropy(0.5, 0.5, 0.0);
  run.Filter->SetNumberOfPhotons(150000);
}

//------------------------------------------------------------------------------
/// An image of one value, around a part of the body or all of it, is the uniform medium.
void TestConstant()
{
  const auto body = MakeBox({ 0, 0, 0 }, { 1, 2, 3 }, 3);
  PhotonRun uniform(body);
  SetUniform(uniform);
  CheckWorks(uniform, "a uniform medium");

  auto part = MakeImage({ -0.2, 0.3, -0.4 }, { 0.7, 2.5, 1.9 }, { 3, 40, 5 });
  std::vector<double> values;
  for (vtkIdType voxel = 0; voxel < part->GetNumberOfCells(); ++voxel)
  {
    values.insert(values.end(), { 2.0, 1.0, 0.5 });
  }
  AddTo(part->GetCellData(), "Scattering", values, 3);
  PhotonRun inPart(body);
  SetUniform(inPart);
  inPart.Filter->SetInputData(1, part);
  inPart.Filter->SetSeed(2);
  inPart.Filter->SetNumberOfPhotons(450000);
  CheckWorks(inPart, "an image around a part of the body");
  CheckClose(inPart.GetNumber("PhotonsTraced"), 450000, 0.0,
    "each band has a third of the photons");
  CheckSame(uniform, inPart, "an image around a part of the body");

  // Other coefficients around it have no influence.
  auto all = MakeImage({ -1, -1, -1 }, { 2, 3, 4 }, { 2, 2, 2 });
  AddTo(all->GetPointData(), "Scattering", std::vector<double>(27, 1.0));
  AddTo(all->GetCellData(), "Absorption", std::vector<double>(8, 0.05));
  PhotonRun within(body);
  within.SetMedium(100.0, 100.0, 1.3);
  within.Filter->SetInputData(1, all);
  within.Filter->SetSeed(3);
  within.Filter->SetNumberOfPhotons(450000);
  CheckWorks(within, "an image around the body");
  uniform.SetMedium(1.0, 0.05, 1.3);
  uniform.Filter->SetAnisotropy(0.0, 0.0, 0.0);
  CheckWorks(uniform, "another uniform medium");
  CheckSame(uniform, within, "an image around the body");
}

//------------------------------------------------------------------------------
/// Two halves of different media are, far from the border, like bodies of one of them. The image is
/// turned: its first axis runs along z; and it all lies far away.
void TestHalves()
{
  const Point low = { 6e5, 6e6, 0 };
  const auto body = MakeBox(low, { low[0] + 1, low[1] + 1, low[2] + 2 }, 4);
  auto image = MakeImage({ 0, 0, 0 }, { 2, 1, 1 }, { 2, 1, 1 });
  image->SetDirectionMatrix(0, 1, 0, 0, 0, 1, 1, 0, 0);
  image->SetOrigin(low[0] - 7.0, low[1] - 7.0, low[2] - 7.0);
  AddTo(image->GetCellData(), "Scattering", { 1.0, 3.0 });
  AddTo(image->GetCellData(), "Absorption", { 0.2, 0.05 });
  const auto set = [&](PhotonRun& run, int seed)
  {
    run.SetMedium(50.0, 50.0, 1.3);
    run.Filter->SetMillimetersPerUnit(30.0);
    run.Filter->SetNumberOfPhotons(120000);
    run.Filter->SetSeed(seed);
  };
  PhotonRun halves(body);
  set(halves, 1);
  halves.Filter->SetInputData(1, image);
  CheckWorks(halves, "two halves");
  const auto getHeight = [&](vtkIdType patch)
  {
    double bounds[6];
    body->GetCellBounds(patch, bounds);
    return 0.5 * (bounds[4] + bounds[5]);
  };
  PhotonRun lower(body);
  set(lower, 2);
  lower.SetMedium(1.0, 0.2, 1.3);
  CheckWorks(lower, "a body like the lower half");
  CheckSame(halves, lower, "the lower half", [&](vtkIdType k) { return getHeight(k) < 0.6; });
  PhotonRun upper(body);
  set(upper, 3);
  upper.SetMedium(3.0, 0.05, 1.3);
  CheckWorks(upper, "a body like the upper half");
  CheckSame(halves, upper, "the upper half", [&](vtkIdType k) { return getHeight(k) > 1.6; });
}

//------------------------------------------------------------------------------
/// Voxels that are empty, thin or dense.
vtkSmartPointer<vtkImageData> MakeContrasts(double absorption)
{
  auto image = MakeImage({ 0, 0, 0 }, { 1, 2, 3 }, { 5, 6, 7 });
  std::vector<double> scattering(210), absorbing(210);
  const double values[] = { 0.0, 0.3, 2.0, 40.0 };
  for (int voxel = 0; voxel < 210; ++voxel)
  {
    scattering[voxel] = values[voxel * 37 % 11 % 4];
    absorbing[voxel] = absorption * (voxel % 3);
  }
  AddTo(image->GetCellData(), "Scattering", scattering);
  AddTo(image->GetCellData(), "Absorption", absorbing);
  return image;
}

//------------------------------------------------------------------------------
void TestConservation()
{
  PhotonRun run(MakeBox({ 0, 0, 0 }, { 1, 2, 3 }, 2));
  run.SetMedium(1.0, 0.0, 1.4);
  run.Filter->SetInputData(1, MakeContrasts(0.0));
  CheckWorks(run, "voxels of all kinds");
  CheckClose(run.GetAccounted(), 1.0, 1e-6, "all that enters a medium without absorption");
  CheckClose(run.GetNumber("LostShare"), 0.0, 1e-6, "nothing is lost");

  PhotonRun clear(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  auto empty = MakeImage({ -1, -1, -1 }, { 2, 2, 2 }, { 1, 1, 1 });
  AddTo(empty->GetCellData(), "Scattering", { 0.0 });
  AddTo(empty->GetCellData(), "Absorption", { 0.0 });
  clear.Filter->SetInputData(1, empty);
  clear.Filter->SetRefractiveIndex(1.0);
  CheckWorks(clear, "an empty body");
  CheckClose(clear.GetNumber("UnscatteredShare"), 1.0, 1e-9, "all runs through an empty body");
}

//------------------------------------------------------------------------------
std::vector<double> GetResult(int threads)
{
  PhotonRun run(MakeBox({ 0, 0, 0 }, { 1, 2, 3 }, 3));
  run.Filter->SetInputData(1, MakeContrasts(0.1));
  return run.GetValues("ScatteredIrradiance", threads);
}

//------------------------------------------------------------------------------
/// Links know the image that they were made with.
void TestLinks()
{
  const auto body = MakeBox({ 0, 0, 0 }, { 1, 2, 3 }, 3);
  auto image = MakeContrasts(0.1);
  PhotonRun links(body);
  links.Filter->SetInputData(1, image);
  links.Filter->SetLinkMethodToDense();
  links.Filter->SetNumberOfPhotons(300000);
  CheckWorks(links, "links in a medium that varies");
  AddArray(body, "Irradiance", { 1.0 })->SetComponent(3, 0, 5.0);
  body->Modified();
  CheckWorks(links, "links in other light");
  CheckClose(links.GetNumber("LinksReused"), 1.0, 0.0, "links are kept for other light");
  PhotonRun photons(body);
  photons.Filter->SetInputData(1, image);
  photons.Filter->SetNumberOfPhotons(300000);
  photons.Filter->SetSeed(2);
  CheckWorks(photons, "photons in a medium that varies");
  CheckSame(links, photons, "links in a medium that varies");

  image->GetCellData()->GetArray("Scattering")->SetComponent(100, 0, 3.0);
  image->Modified();
  CheckWorks(links, "links in another medium");
  CheckClose(links.GetNumber("LinksReused"), 0.0, 0.0, "links are made anew for another image");
  image->SetOrigin(0.1, 0.1, 0.1);
  CheckWorks(links, "links in a medium elsewhere");
  CheckClose(links.GetNumber("LinksReused"), 0.0, 0.0, "and for one that lies elsewhere");
  links.Filter->SetInputConnection(1, nullptr);
  CheckWorks(links, "links without an image");
  CheckClose(links.GetNumber("LinksReused"), 0.0, 0.0, "and for none");
}

//------------------------------------------------------------------------------
/// Two ranks with a body each, and the whole image: as one rank with both.
void TestRanks()
{
  const auto makeBody = [](bool hasFirst, bool hasSecond)
  {
    Surface surface;
    if (hasFirst)
    {
      AddBox(surface, { 0, 0, 0 }, { 1, 1, 1 }, 2);
    }
    if (hasSecond)
    {
      AddBox(surface, { 0, 1.2, 0 }, { 1, 2, 2 }, 2);
    }
    auto data = surface.Get();
    AddArray(data, "Irradiance", { 1.0 });
    return data;
  };
  PhotonRun alone(makeBody(true, true));
  alone.Filter->SetInputData(1, MakeContrasts(0.1));
  CheckWorks(alone, "two bodies in a medium that varies");
  const double share = alone.GetNumber("LeavingShare");
  RunRanks(2,
    [&](vtkMultiProcessController* controller, int rank)
    {
      PhotonRun run(makeBody(rank == 0, rank == 1));
      run.Filter->SetController(controller);
      run.Filter->SetInputData(1, MakeContrasts(0.1));
      CheckWorks(run, "a medium that varies, on two ranks");
      CheckClose(run.GetNumber("LeavingShare"), share, 1e-12, "two ranks give what one does");
      run.Filter->SetInputData(1, MakeContrasts(0.1 * rank));
      CheckFails(run, "The medium is not the same on all ranks", "another medium on each rank");
    });
}

//------------------------------------------------------------------------------
void TestRefusals()
{
  const auto check = [](const std::function<void(vtkImageData*)>& change, const std::string& part)
  {
    PhotonRun run(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
    auto image = MakeImage({ 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 });
    change(image);
    run.Filter->SetInputData(1, image);
    CheckFails(run, part, "a medium");
  };
  const std::vector<double> ones(8, 1.0);
  check([](vtkImageData*) {}, R"(neither "Scattering" nor "Absorption")");
  check([&](vtkImageData* image) { AddTo(image->GetCellData(), "scatterring", ones); },
    R"(no "Scattering". There is "scatterring")");
  check(
    [&](vtkImageData* image) {
      AddTo(image->GetCellData(), "Scattering", { 1, 1, -1, 1, 1, 1, 1, 1 });
    },
    "The cell array \"Scattering\" of the medium is -1 at cell 2");
  check(
    [&](vtkImageData* image)
    {
      AddTo(image->GetPointData(), "Absorption", std::vector<double>(27, std::nan("")));
      AddTo(image->GetCellData(), "Scattering", ones);
    },
    "The point array \"Absorption\" of the medium is nan at point 0");
  check(
    [&](vtkImageData* image) {
      AddTo(image->GetCellData(), "Scattering", { 1, 2, 3 });
    },
    "In the medium the cell array \"Scattering\" has 3 tuples where there are 8");
  check([&](vtkImageData* image)
    { AddTo(image->GetCellData(), "Scattering", std::vector<double>(16, 1.0), 2); },
    "has 2 components");
  check(
    [&](vtkImageData* image)
    {
      vtkNew<vtkStringArray> words;
      words->SetName("Scattering");
      words->SetNumberOfValues(8);
      image->GetCellData()->AddArray(words);
    },
    "holds no numbers");
  check([](vtkImageData* image) { image->SetExtent(0, 2, 0, 0, 0, 2); },
    "The medium is flat or empty: 3 x 1 x 3 points");
  check([](vtkImageData* image) { image->Initialize(); }, "The medium is flat or empty");

  PhotonRun blocks(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  vtkNew<vtkMultiBlockDataSet> images;
  images->SetBlock(0, MakeContrasts(0.0));
  blocks.Filter->SetInputData(1, images);
  CheckFails(blocks, "is a vtkMultiBlockDataSet: it must be one vtkImageData", "blocks of media");

  PhotonRun profile(MakeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  profile.Filter->SetInputData(1, MakeContrasts(0.0));
  profile.Filter->SetModelToDipole();
  CheckFails(profile, "set Model to MonteCarlo", "a medium with a profile");
}
} // namespace

//------------------------------------------------------------------------------
int TestVaryingMedia(int, char*[])
{
  TestOpticalThickness();
  TestLayers();
  TestConstant();
  TestHalves();
  TestConservation();
  Check(GetResult(1) == GetResult(3), "the same bits on three threads");
  TestLinks();
  TestRefusals();
  TestRanks();
  return Result();
}
