// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/PhotonSource.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace LightTransport
{
//------------------------------------------------------------------------------
PhotonSource::PhotonSource(const PatchScene& scene, const std::vector<double>& flux, int bands)
  : Scene(scene), Scales(flux.size()), Bands(bands)
{
  for (std::size_t k = 0; k < flux.size(); ++k)
  {
    this->Flux[k % bands] += flux[k];
  }
  double end = 0.0;
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    double* shares = &this->Scales[patch * bands];
    double mean = 0.0;
    for (int band = 0; band < bands; ++band)
    {
      shares[band] = flux[patch * bands + band] / this->Flux[band];
      mean += shares[band] / bands;
    }
    if (mean == 0.0)
    {
      continue;
    }
    std::for_each(shares, shares + bands, [mean](double& share) { share /= mean; });
    for (int corner = 1; corner + 1 < scene.GetNumberOfCorners(patch); ++corner)
    {
      const Vector& origin = scene.GetCorner(patch, 0);
      const Vector cross = (scene.GetCorner(patch, corner) - origin)
                             .cross(scene.GetCorner(patch, corner + 1) - origin);
      end +=
        mean * std::max(0.5 * cross.dot(scene.GetNormal(patch)), 0.0) / scene.GetAreas()[patch];
      this->Triangles.push_back({ patch, corner });
      this->Ends.push_back(end);
    }
  }
}

//------------------------------------------------------------------------------
PhotonSource::Photon PhotonSource::Start(double place, const PhotonWalk& walk,
  PhotonRandom& random) const
{
  const auto found =
    std::upper_bound(this->Ends.begin(), this->Ends.end() - 1, place * this->Ends.back());
  const Triangle& triangle = this->Triangles[found - this->Ends.begin()];
  double u = random.Get();
  double v = random.Get();
  if (u + v > 1.0)
  {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const Vector& origin = this->Scene.GetCorner(triangle.Patch, 0);
  Photon photon;
  photon.Start.Position = origin +
    u * (this->Scene.GetCorner(triangle.Patch, triangle.Corner) - origin) +
    v * (this->Scene.GetCorner(triangle.Patch, triangle.Corner + 1) - origin);
  photon.Start.Patch = triangle.Patch;
  photon.Start.Direction = walk.Enter(this->Scene.GetNormal(triangle.Patch), random);
  std::copy_n(&this->Scales[triangle.Patch * this->Bands], this->Bands, photon.Scales);
  return photon;
}
} // namespace LightTransport
