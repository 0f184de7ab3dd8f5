// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Photons in half spaces and slabs against exact reflectances and transmittances (adding-doubling
// and H functions, 5 digits or more), and in meshes against what holds in every closed body.
#include "PhotonScatteringTesting.h"
#include "PhotonWalkTesting.h"
#include "Photons/FlatBoundaries.h"
#include "Photons/MeshBoundary.h"
#include "Photons/PhotonWalk.h"
#include "Photons/UniformPath.h"
#include "Shared/Fresnel.h"

#include <algorithm>
#include <sstream>

using namespace LightTransport;
using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
Sums Follow(const PhotonBoundary& boundary, const std::vector<PhotonMedium>& media,
  const Light& light, int seed, int photons)
{
  const PhotonWalk walk(boundary, light.Index, media[0].Anisotropy);
  const UniformBands bands(media);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Sums sums(bands.GetNumber());
  PhotonWalk::Counts counts;
  for (int k = 0; k < photons; ++k)
  {
    PhotonRandom random(seed, k);
    UniformPath path(bands, k % bands.GetNumber());
    const Eigen::Vector3d direction = light.IsDiffuse ? walk.Enter(up, random) : -up;
    walk.Follow({ Eigen::Vector3d::Zero(), direction, 0 }, true, path, random, sums, counts);
  }
  return sums;
}

//------------------------------------------------------------------------------
struct FlatCase
{
  double Albedo;
  double Index;
  double Anisotropy;
  double Thickness; ///< 0 for a half space
  bool IsDiffuse;
  double Reflected;
  double Transmitted; ///< with what is not scattered
};

//------------------------------------------------------------------------------
void TestFlat()
{
  const std::vector<FlatCase> cases = {
    { 0.2, 1.0, 0.0, 0.0, false, 0.035231, 0.0 },
    { 0.5, 1.0, 0.0, 0.0, false, 0.115226, 0.0 },
    { 0.5, 1.0, 0.0, 0.0, true, 0.146544, 0.0 },
    { 0.9, 1.5, 0.0, 0.0, false, 0.219919, 0.0 },
    { 0.9, 1.5, 0.0, 0.0, true, 0.216112, 0.0 },
    { 0.99, 1.0, 0.0, 0.0, true, 0.794564, 0.0 },
    { 0.99, 1.3, 0.0, 0.0, true, 0.630551, 0.0 },
    { 0.98, 1.4, 0.0, 0.0, false, 0.503781, 0.0 },
    { 0.9, 1.0, 0.75, 2.0, false, 0.097395, 0.660958 },
    { 0.99, 1.4, 0.75, 2.0, true, 0.244886, 0.607075 },
    { 1.0, 1.5, 0.9, 1.0, true, 0.140718, 0.767504 },
    { 0.5, 1.4, 0.0, 1.0, true, 0.053530, 0.314690 },
    { 0.9, 1.5, 0.9, 10.0, true, 0.029104, 0.083646 },
  };
  for (const FlatCase& test : cases)
  {
    const HalfSpaceBoundary halfSpace;
    const SlabBoundary slab(test.Thickness);
    const bool isSlab = test.Thickness > 0.0;
    const PhotonBoundary& boundary = isSlab ? static_cast<const PhotonBoundary&>(slab) : halfSpace;
    const Light light{ test.IsDiffuse, test.Index };
    const double entering = light.GetEntering();
    Deviations reflected, transmitted;
    for (int seed = 0; seed < Seeds; ++seed)
    {
      const Sums sums = Follow(boundary, { { test.Albedo, 1.0 - test.Albedo, test.Anisotropy } },
        light, seed, PhotonsPerSeed);
      // The tables' reflectance has what is not scattered and comes back from the other side.
      const bool isClear = isSlab && test.Index > 1.0;
      if (!isClear)
      {
        reflected.Add(sums.Left[0][0], sums.Squares[0][0], PhotonsPerSeed,
          test.Reflected / entering);
      }
      const double through = sums.Left[1][0] + sums.Unscattered[0];
      const double both = sums.Left[0][0] + through;
      const double squares = sums.Squares[0][0] + sums.Squares[1][0] + sums.Unscattered[0];
      if (isSlab)
      {
        transmitted.Add(isClear ? both : through, squares - (isClear ? 0.0 : sums.Squares[0][0]),
          PhotonsPerSeed, ((isClear ? test.Reflected : 0.0) + test.Transmitted) / entering);
      }
    }
    std::ostringstream name;
    name << "albedo " << test.Albedo << ", index " << test.Index << ", anisotropy "
         << test.Anisotropy << ", thickness " << test.Thickness
         << (test.IsDiffuse ? ", diffuse" : ", normal");
    reflected.CheckNormal("reflectance of " + name.str());
    transmitted.CheckNormal("transmittance of " + name.str());
  }
}

//------------------------------------------------------------------------------
/// Three bands of one walk, each against its own table.
void TestSharedPaths()
{
  const SlabBoundary slab(1.0);
  const std::vector<PhotonMedium> media = { { 0.9, 0.1, 0.75 }, { 1.8, 0.2, 0.75 },
    { 1.98, 0.02, 0.75 } };
  const double totals[3] = { 0.095613 + 0.594682, 0.103887 + 0.421492, 0.244886 + 0.607075 };
  const Light light{ true, 1.4 };
  for (int band = 0; band < 3; ++band)
  {
    Deviations both;
    for (int seed = 0; seed < Seeds; ++seed)
    {
      const Sums sums = Follow(slab, media, light, seed, PhotonsPerSeed);
      both.Add(sums.Left[0][band] + sums.Left[1][band] + sums.Unscattered[band],
        sums.Squares[0][band] + sums.Squares[1][band] +
          3.0 * sums.Unscattered[band], // an upper bound: of weights up to 3
        PhotonsPerSeed, totals[band] / light.GetEntering());
    }
    both.CheckNormal("band " + std::to_string(band) + " of three that share their paths");
  }
}

//------------------------------------------------------------------------------
/// Nothing is absorbed: all that enters leaves, to the last digit.
void TestConservation()
{
  for (const double anisotropy : { -0.9, 0.0, 0.99 })
  {
    const Sums sums =
      Follow(SlabBoundary(5.0), { { 1.0, 0.0, anisotropy } }, { true, 1.5 }, 1, 2000);
    CheckClose(sums.Left[0][0] + sums.Left[1][0] + sums.Unscattered[0], 2000.0, 1e-12,
      "all that enters, at anisotropy " + std::to_string(anisotropy));
  }
}

//------------------------------------------------------------------------------
/// An L-shaped bar: concave, so that light enters more than once.
vtkSmartPointer<vtkPolyData> MakeAngle()
{
  Surface surface;
  const std::vector<Point> outline = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 },
    { 1, 2, 0 }, { 0, 2, 0 } };
  std::vector<Point> low(outline.rbegin(), outline.rend());
  std::vector<Point> high = outline;
  for (Point& point : high)
  {
    point[2] = 1.0;
  }
  surface.AddPolygon(low);
  surface.AddPolygon(high);
  for (std::size_t k = 0; k < outline.size(); ++k)
  {
    const std::size_t next = (k + 1) % outline.size();
    surface.AddPolygon({ outline[k], outline[next], high[next], high[k] });
  }
  return surface.Get();
}

//------------------------------------------------------------------------------
/// Without absorption radiance is even in even light: scatterings for each entry are n^2 mu_s 4 V /
/// (S (1 - F)) in any closed body.
void TestScatteringsInBody(vtkPolyData* data, double volume, double area, const std::string& name)
{
  constexpr double index = 1.4;
  constexpr int photons = 4000;
  PatchScene scene;
  MeshBoundary boundary;
  if (!Check(bool(scene.Build(data, Ranks())) && bool(boundary.Build(scene, 1.0)), name + " built"))
  {
    return;
  }
  constexpr double scattering = 8.0; // in scene units
  const PhotonWalk walk(boundary, index, 0.5);
  const UniformBands bands({ { scattering, 0.0, 0.5 } });
  Deviations ratio;
  for (int seed = 0; seed < Seeds; ++seed)
  {
    Sums sums(1);
    double scatterings = 0.0, entries = 0.0, squares = 0.0;
    const double expected = index * index * scattering * 4.0 * volume / scene.GetScale() /
      (area * (1.0 - Fresnel::GetMeanExternalReflectance(index)));
    for (int k = 0; k < photons; ++k)
    {
      // Even light from a sphere around the scene.
      PhotonRandom random(seed, k);
      const Eigen::Vector3d place = random.GetDirection();
      double x, y;
      const double height = std::sqrt(1.0 - random.GetInCircle(x, y));
      const Eigen::Vector3d tangent = place.unitOrthogonal();
      const Eigen::Vector3d direction = x * tangent + y * place.cross(tangent) - height * place;
      UniformPath path(bands, 0);
      PhotonWalk::Counts counts;
      walk.Follow({ place, direction, -1 }, false, path, random, sums, counts);
      // The mean of this is 0 where the ratio of the means is the expected one.
      const double excess = counts.Scatterings - expected * counts.Entries;
      scatterings += counts.Scatterings;
      entries += counts.Entries;
      squares += excess * excess;
    }
    ratio.Add(scatterings - expected * entries, squares, photons, 0.0);
    Check(sums.Lost == 0.0, name + ": no photon is lost");
  }
  ratio.CheckNormal("scatterings for each entry in the " + name);
}

//------------------------------------------------------------------------------
/// Of a closed surface of plane polygons.
void Measure(vtkPolyData* data, double& volume, double& area)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, ids);
    const auto get = [&](vtkIdType k)
    {
      Eigen::Vector3d point;
      data->GetPoint(ids->GetId(k), point.data());
      return point;
    };
    for (vtkIdType k = 1; k + 1 < ids->GetNumberOfIds(); ++k)
    {
      const Eigen::Vector3d cross = 0.5 * (get(k) - get(0)).cross(get(k + 1) - get(0));
      area += cross.norm();
      volume += cross.dot(get(0)) / 3.0;
    }
  }
}

//------------------------------------------------------------------------------
void TestScatterings()
{
  Surface box;
  box.AddGrid({ 0, 0, 0 }, { 0, 2, 0 }, { 1, 0, 0 }, 3, 2);
  box.AddGrid({ 0, 0, 3 }, { 1, 0, 0 }, { 0, 2, 0 }, 3, 2);
  box.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 3 }, 3, 2);
  box.AddGrid({ 0, 2, 0 }, { 0, 0, 3 }, { 1, 0, 0 }, 2, 5);
  box.AddGrid({ 0, 0, 0 }, { 0, 0, 3 }, { 0, 2, 0 }, 1, 1);
  box.AddGrid({ 1, 0, 0 }, { 0, 2, 0 }, { 0, 0, 3 }, 3, 2);
  TestScatteringsInBody(box.Get(), 6.0, 22.0, "box");
  TestScatteringsInBody(MakeAngle(), 3.0, 14.0, "angle");
  const auto bowl = MakeBowl(0.3);
  double volume = 0.0;
  double area = 0.0;
  Measure(bowl, volume, area);
  TestScatteringsInBody(bowl, volume, area, "bowl");
}
} // namespace

//------------------------------------------------------------------------------
int TestPhotonWalk(int, char*[])
{
  TestFlat();
  TestSharedPaths();
  TestConservation();
  TestScatterings();
  return Result();
}
