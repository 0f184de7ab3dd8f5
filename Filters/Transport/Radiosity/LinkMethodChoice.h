// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How patches are linked, and why. What users ask for decides: view factors that are given, the
 * method, a solver that needs each pair, then what only one method has (a tolerance of its own,
 * clusters). Where nothing is asked for the method is open, and costs decide.
 */
#ifndef LinkMethodChoice_h
#define LinkMethodChoice_h

#include "Shared/Outcome.h"
#include "ViewFactors/ViewFactorStore.h"

#include <string>
#include <vector>

namespace LightTransport
{
class PatchScene;

class LinkMethodChoice
{
public:
  /// What users ask for.
  struct Wishes
  {
    ///@{ Links of a method that are given (SetViewFactors).
    bool AreGiven = false;
    LinkMethod Given = LinkMethod::Dense;
    ///@}
    int Method = 0;                   ///< of vtkRadiosity::LinkMethodType
    const char* PairSolver = nullptr; ///< the name of a solver that needs each pair
    ///@{ 0: as the accuracy asks.
    double ViewFactorTolerance = 0.0;
    double LinkTolerance = 0.0;
    ///@}
    bool RefinesByBrightness = false;
    bool UsesAtlas = false;
  };

  LinkMethodChoice() = default;
  explicit LinkMethodChoice(const Wishes& wishes);

  /// Dense or sampled, which both take patches in their spatial order.
  bool IsOpen() const { return this->Open; }
  /// Where the choice is open: whichever is predicted to take less time for this accuracy.
  Outcome DecideByCost(const PatchScene& scene, double accuracy);

  /// While the choice is open, what it begins with.
  LinkMethod Get() const { return this->Method; }
  /// "Dense: asked for"
  std::string Explain() const;

  /// What was asked for and has no effect with this method, a warning each.
  std::vector<std::string> ListUnheeded() const;

  static const char* GetName(LinkMethod method);

private:
  void Decide(LinkMethod method, const std::string& why);

  Wishes Asked;
  LinkMethod Method = LinkMethod::Dense;
  std::string Why;
  bool Open = false;
};
} // namespace LightTransport

#endif
