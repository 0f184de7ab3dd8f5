// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What is known of a solver of the radiosity equation: a row of SolverTable. The solver is a file
 * in Radiosity/Solvers, whose entry has its name.
 */
#ifndef SolverEntry_h
#define SolverEntry_h

#include "Shared/Outcome.h"

class vtkDeviceShooter;

namespace LightTransport
{
class PatchScene;
class RadiosityIteration;
struct RadiosityEquation;
struct RadiositySolution;
struct SolverSettings;

struct SolverEntry
{
  /// How a step changes the patches.
  enum class Order
  {
    AllAtOnce,   ///< wherever the links are, on all processes
    PatchToPatch ///< one after the other
  };
  enum class Links
  {
    AnyForm,
    EachPair,     ///< one for each pair of patches: dense
    FoundOnDevice ///< none: a device finds what patches see while the solver goes
  };

  bool NeedsLinks() const { return this->LinksNeeded != Links::FoundOnDevice; }
  bool NeedsEachPair() const { return this->LinksNeeded == Links::EachPair; }
  /// Along links from patch to patch, which can be done on the CPU of one process only.
  bool NeedsOneCPU() const { return this->NeedsLinks() && this->StepOrder == Order::PatchToPatch; }

  int Type;         ///< vtkRadiosity::SolverType
  const char* Name; ///< for users
  Order StepOrder;
  Links LinksNeeded;

  /// Of a solver that needs links: goes on until Continue of the iteration says that it is over.
  void (*Iterate)(RadiosityIteration& state) = nullptr;
  /// Products with the links until errors have fallen by `tolerance`, where `radius` bounds the
  /// spectrum of rho F. Auto takes the least; nullptr: it does not think of this solver.
  double (*EstimateProducts)(double radius, double tolerance) = nullptr;
  /// Of a solver that needs none: with a shooter that has been opened. An iteration is one shot.
  Outcome (*Shoot)(vtkDeviceShooter* shooter, const PatchScene& scene,
    const RadiosityEquation& equation, const SolverSettings& settings,
    RadiositySolution& solution) = nullptr;
};
} // namespace LightTransport

#endif
