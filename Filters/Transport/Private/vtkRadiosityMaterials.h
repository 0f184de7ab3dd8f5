// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the patches of a scene are made of, read from its cell arrays and checked: the numbers of
 * B = E + rho H for every patch and band.
 */
#ifndef vtkRadiosityMaterials_h
#define vtkRadiosityMaterials_h

#include "vtkType.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkPatchScene;

struct vtkRadiosityMaterials
{
  /// The input arrays of vtkRadiosity by their index.
  enum InputArray
  {
    EMISSION,
    REFLECTANCE,
    TEMPERATURE,
    EMISSIVITY,
    DIRECT_IRRADIANCE,
    NUMBER_OF_ARRAYS
  };
  static const char* GetDefaultName(int array);

  int NumberOfBands = 0;
  ///@{ patches x bands
  std::vector<double> Emission;
  std::vector<double> Reflectance;
  std::vector<double> DirectIrradiance;
  ///@}

  /**
   * Fill in all of the above. `names` are those of the input arrays. Returns false, on every rank
   * alike, with `error` naming the problem and the remedy.
   */
  bool Read(vtkDataObject* input, const vtkPatchScene& scene, const std::vector<std::string>& names,
    std::string& error);

  /// The patches that send anything, one way or the other.
  std::vector<bool> FindSenders() const;

  /**
   * What a patch is made of, as far as points are not averaged across a change of it: 2 values per
   * patch and band. That a patch emits is part of it, how much is not: temperatures and emissions
   * may vary from patch to patch.
   */
  std::vector<double> GetPointMaterials() const;
};

#endif
