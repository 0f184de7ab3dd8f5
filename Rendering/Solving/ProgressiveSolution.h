// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The radiosity of the actors of a renderer, solved a while at a time. A vtkRadiosity of its own
 * does what it does as a filter: on the CPU as SlicedWork with all its links; or it tells what
 * there is to shoot, and a vtkOpenGLShooter does that in the renderer's context. What is worked on
 * is a copy of the actors; what has changed since decides what is computed again.
 */
#ifndef ProgressiveSolution_h
#define ProgressiveSolution_h

#include "Solving/GroupMeans.h"
#include "Solving/SceneActors.h"
#include "Solving/SlicedWork.h"
#include "vtkOpenGLShooter.h"

#include "vtkDirectIrradiance.h"
#include "vtkNew.h"
#include "vtkRadiosity.h"
#include "vtkWeakPointer.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

class vtkObject;
class vtkRenderWindow;

namespace LightTransport
{
class ProgressiveSolution
{
public:
  struct Settings
  {
    vtkRadiosity* Radiosity = nullptr;
    bool Shadows = true;
    bool UsesAmbient = true;
  };

  ProgressiveSolution();
  ~ProgressiveSolution();
  ProgressiveSolution(const ProgressiveSolution&) = delete;
  void operator=(const ProgressiveSolution&) = delete;

  /// Goes on for this long, in the context of the renderer's window. A failure is told once for
  /// each state of the scene.
  Outcome Update(vtkRenderer* renderer, const Settings& settings, double seconds);

  /// What users should know, since the last call.
  std::vector<std::string> TakeWarnings();
  /// What GetOutput has failed with; empty where it has not.
  std::string TakeErrors();

  /// Whether there is nothing left to do.
  bool IsConverged() const { return this->State == Progress::Done; }

  /// What is drawn of an actor: a surface in world coordinates of when the actor had that matrix.
  struct Shown
  {
    vtkPolyData* Surface = nullptr;
    std::array<double, 16> Matrix = {};
    vtkPolyData* Source = nullptr; ///< what the actor's mapper would draw
  };
  /// For all blocks of an actor, of the estimate so far or of an earlier scene; none where there is
  /// none of one of them, or only of another shape.
  std::vector<Shown> FindShown(vtkActor* actor) const;

  /// Radiosity of the groups "SmoothGroup" of what is shown; nullptr where it is the array
  /// "Radiosity" instead.
  vtkTextureObject* GetGroups() const;

  /// All arrays of what has been computed so far; reads back what shots have brought.
  vtkPolyData* GetOutput(vtkActor* actor, int block);

  ///@{ Since the beginning.
  vtkIdType GetNumberOfLinkRuns() const { return this->Filter->GetNumberOfLinkRuns(); }
  vtkIdType GetNumberOfLightRuns() const { return this->LightRuns; }
  vtkIdType GetNumberOfSolverRuns() const { return this->SolverRuns; }
  vtkIdType GetNumberOfShots() const { return this->AllShots; }
  vtkTypeInt64 GetNumberOfBytesRead()
  {
    return this->BytesRead + this->Shooter->GetNumberOfBytesRead();
  }
  ///@}

  /// What has been shot is lost.
  void ReleaseGraphicsResources();

private:
  enum class Progress
  {
    Computing, ///< as sliced work
    Shooting,
    Done,
    Failed
  };
  struct Keys
  {
    std::uint64_t Shape = 0;
    std::uint64_t Material = 0;
    std::uint64_t Light = 0;
    vtkMTimeType Radiosity = 0;
    bool Shadows = false;
    bool UsesAmbient = false;

    bool operator==(const Keys& other) const;
  };

  bool IsFirstLightUnderWay(const Keys& keys) const;
  void Restart(const Keys& keys, const Settings& settings);
  Outcome Compute(bool needsLight, bool usesAmbient);
  bool Light();
  void AddLight();
  Outcome TakeWork();
  Outcome Fail(const std::string& message);

  bool IsShotIn(vtkRenderer* renderer) const;
  void ShowEstimate();
  void MakeShooter();
  Outcome BeginShots(vtkRenderer* renderer);
  Outcome Shoot(vtkRenderer* renderer, double seconds, bool usesAmbient);
  Outcome ShowShots(bool usesAmbient);
  bool IsEnough();

  ///@{ Of the filters and the shooter.
  void HearProgress(vtkObject* filter, unsigned long, void*);
  void HearError(vtkObject* filter, unsigned long, void* text);
  void HearWarning(vtkObject* filter, unsigned long, void* text);
  void Ignore(vtkObject*, unsigned long, void*) {}
  void Observe(vtkObject* teller);
  void Observe(vtkAlgorithm* filter);
  ///@}

  vtkSmartPointer<vtkRadiosity> Filter;
  vtkSmartPointer<vtkDirectIrradiance> Direct;
  vtkSmartPointer<vtkOpenGLShooter> Shooter;
  std::unique_ptr<GroupMeans> Means;

  SceneActors Actors;
  Keys Known;
  bool IsKnown = false;
  Progress State = Progress::Done;
  bool IsByShots = false;

  vtkSmartPointer<vtkMultiBlockDataSet> Scene;
  vtkSmartPointer<vtkMultiBlockDataSet> Lit; ///< of the last lights and shape
  vtkRadiosity::ShotProblem Problem;
  vtkSmartPointer<vtkMultiBlockDataSet> Estimate; ///< nullptr until there is one
  vtkSmartPointer<vtkMultiBlockDataSet> Solution;
  vtkSmartPointer<vtkMultiBlockDataSet> ReadBack; ///< of all shots so far; else nullptr
  vtkIdType Shots = 0;                            ///< of this solution
  vtkIdType UncheckedShots = 0;
  bool HaveShotsFailed = false;
  vtkWeakPointer<vtkRenderWindow> FailedIn; ///< there

  /// What is shown, and what it is of.
  vtkSmartPointer<vtkMultiBlockDataSet> ShownScene;
  std::vector<SceneActors::Member> ShownMembers;

  std::string Errors;
  std::vector<std::string> Warnings;
  std::vector<std::string> ToldWarnings;
  vtkIdType LightRuns = 0;
  vtkIdType SolverRuns = 0;
  vtkIdType AllShots = 0;
  vtkTypeInt64 BytesRead = 0;

  SlicedWork Work; ///< ends before all that it works on
};
} // namespace LightTransport

#endif
