// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The scenes of ViewFactorsBenchmark.
#ifndef ViewFactorScenes_h
#define ViewFactorScenes_h

#include "ViewFactorTesting.h"

namespace ViewFactorBenchmark
{
/// Which run a case belongs to; each includes the ones before.
enum Set
{
  QUICK,
  STANDARD,
  ALL
};

/// What is known of the factors between two groups of patches.
struct ExactFactor
{
  std::string Name;
  LightTransportTesting::Group From;
  LightTransportTesting::Group To;
  double Value;
};

struct Scene
{
  std::string Text;
  vtkSmartPointer<vtkPolyData> Data;
  /// Patches whose rows sum to 1.
  LightTransportTesting::Group Closed;
  std::vector<ExactFactor> Factors;
};

struct Case
{
  std::string Name;
  Set FirstSet;
  std::vector<double> Tolerances;
  std::function<Scene()> Make;
};

/// All cases, in the order in which they run; those of the dragon where its PLY file is given.
std::vector<Case> GetCases(const std::string& dragon);
} // namespace ViewFactorBenchmark

#endif
