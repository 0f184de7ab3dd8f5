// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a scene looks like from the inside: closed, open, an enclosure with a leak, or inside out,
 * with the polygons that make it so. It follows from the openings that the patches see, and from
 * which side rays have met them.
 */
#ifndef EnclosureVerdict_h
#define EnclosureVerdict_h

#include "vtkType.h"

#include <string>
#include <vector>

class vtkFieldData;

namespace LightTransport
{
class PatchScene;
struct Links;

class EnclosureVerdict
{
public:
  /// Flags of "SceneProblems" beside those of SceneFaces.
  enum Problem
  {
    MOSTLY_BACK_FACES = 1, ///< sees them, or is seen from behind
    LEAK = 2,              ///< sees most of it
    TOLERANCE_NOT_REACHED = 16
  };

  EnclosureVerdict(const PatchScene& scene, const Links& links);

  /// "Closed", "Open", "Leaking" or "InsideOut".
  const std::string& GetName() const { return this->Name; }
  bool IsOpen() const { return this->Name != "Closed"; }
  /// Of all that leaves the patches, what leaves the scene.
  double GetSkyShare() const { return this->SkyShare; }
  /// Of each face, with those of the scene.
  const std::vector<int>& GetProblems() const { return this->Problems; }
  /// What users should know, a line each.
  const std::vector<std::string>& GetWarnings() const { return this->Warnings; }

  /// "EnclosureVerdict", "IsClosed" (0 or 1) and "LeakArea": the area through which as much leaves
  /// a closed scene as leaves this one, in the input's unit.
  void AddTo(vtkFieldData* fields) const;

private:
  void SumOpenings();
  void Judge();
  void JudgeBackFaces();
  void JudgeLeak();
  void JudgeErrors();
  bool IsTurnedOutwards() const;
  void Flag(vtkIdType patch, Problem problem);
  std::string Describe(vtkIdType patch) const;

  const PatchScene& Scene;
  const Links& AllLinks;
  std::string Name = "Closed";
  double Area = 0.0;
  double SkyShare = 0.0;
  double BackShare = 0.0;
  std::vector<int> Problems;
  std::vector<std::string> Warnings;
};
} // namespace LightTransport

#endif
