// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Chooses from which clusters each patch receives scattered light (Jensen and Buhler 2002; Carr,
 * Hall and Hart 2003); ScatteringRows holds what comes of it. A link takes the light of a cluster
 * for its mean: it misses at most the deviation of the profile over the cluster times that of the
 * light. So from the top down a cluster is divided where
 *
 *   area x deviation of the profile > threshold
 *
 * in any band, with one threshold for all patches, and where it holds the receiver itself. What is
 * certainly too far away to matter is left out.
 *
 * *Uniform* links begin at the same clusters for all receivers, chosen so that each adds as much to
 * the squared error of a sample of receivers, and divide only those that hold the receiver: its own
 * branch of the tree. *Adaptive* links begin at the root.
 *
 * Of patches that have moved since, the choice may be kept (LinkChoice): each receiver looks at the
 * clusters that it had, and at what was left out, and these are divided by a threshold of their
 * own.
 *
 * The error that links have together is that of light which differs from its mean over each cluster
 * by Deviation of the mean, independently of the profile: the root of the sum of squares.
 *
 * Where the light is given (ClusterLight) its own deviation decides, in place of that one, and the
 * error is what links miss of it beside much finer ones: errors of links have the same sign where
 * both the light and the profile fall towards one side, so that squares would add up to too little.
 */
#ifndef ScatteringRefinement_h
#define ScatteringRefinement_h

#include "Scattering/ClusterLight.h"
#include "Scattering/ScatteringClusters.h"
#include "Scattering/ScatteringReceiver.h"
#include "Support/Ranks.h"

#include <limits>
#include <vector>

namespace LightTransport
{
struct LinkChoice;

class ScatteringRefinement
{
public:
  /// All must outlive this. Errors of links are relative to `reference`, what a patch receives in
  /// even light over the profile's total; with `light` (patches x bands of each of some lights;
  /// empty for any light) to what patches receive of that. What is certainly below `leaveOut`, per
  /// mm^2, is.
  ScatteringRefinement(const ScatteringClusters& clusters, const std::vector<double>& areas,
    const std::vector<double>& light, double reference, double leaveOut);

  ///@{ Which links there are. At most `mostLinks` (0: any number) on average. Where the light is
  /// given, errors about as large as the tolerance are told.
  void ChooseUniform(int clusters, double tolerance);
  void ChooseAdaptive(double tolerance, double mostLinks);
  ///@}

  ///@{ Or keep a choice, which must outlive this. False where it does not do any more, see
  /// ReuseLinks
  /// of vtkSubsurfaceScattering. Collective.
  bool KeepUniform(int clusters, const LinkChoice& kept, const Ranks& ranks);
  bool KeepAdaptive(double mostLinks, const LinkChoice& kept, const Ranks& ranks);
  ///@}
  bool IsKept() const { return this->Kept != nullptr; }
  /// What is to be kept when patches move, but for their rows.
  LinkChoice GetChoice() const;

  /// What the choice comes to, of a sample of receivers.
  struct Prospect
  {
    double Links = 0.0; ///< of a receiver, on average
    double Error = 0.0; ///< root mean square of the worst band, relative
  };
  const Prospect& GetProspect() const { return this->Expected; }
  /// Whether the number of links kept ChooseAdaptive from the tolerance.
  bool IsLimited() const { return this->Limited; }

  /// Of every slot: what a link from it may miss; negative where it is divided anyway.
  std::vector<double> GetLimits() const;

  ///@{ What rows are filled by: a look of a receiver, whether a part that it meets is divided, and
  /// the profiles' mean over one that is not.
  void Look(vtkIdType patch, ScatteringReceiver& receiver) const;
  bool Divides(const ScatteringReceiver& receiver, const ScatteringReceiver::Part& part) const
  {
    return this->Divides(receiver, part, this->Threshold);
  }
  ScatteringIntegrals::Bands GetValue(const ScatteringReceiver& receiver,
    const ScatteringReceiver::Part& part) const;
  ///@}

  const ScatteringClusters& GetClusters() const { return this->Clusters; }
  const std::vector<double>& GetAreas() const { return this->Areas; }
  double GetLeaveOut() const { return this->LeaveOut; }

private:
  bool Divides(const ScatteringReceiver& receiver, const ScatteringReceiver::Part& part,
    double threshold) const;
  vtkIdType GetSampleSize() const;
  vtkIdType GetSample(vtkIdType index) const;
  ScatteringIntegrals::Bands GetDeviation(const ScatteringReceiver& receiver,
    const ScatteringReceiver::Part& part) const;
  void Begin(double tolerance);
  void LookAround();
  void LookAtLight(double tolerance);
  template <typename Divide>
  std::vector<double> Receive(const Divide& divide) const;
  std::vector<double> GetSizes(const std::vector<double>& received) const;
  double GetLightError(const std::vector<double>& received) const;
  void StartFrom(const LinkChoice& kept, const Ranks& ranks);
  double GetMostLinks(const Prospect& others) const;
  bool IsAsGoodAs(const Prospect& others, double mostLinks) const;
  Prospect Measure(double threshold) const;
  double FindThreshold(double tolerance, double mostLinks, int steps) const;
  double GetClusterError(int slot) const;

  const ScatteringClusters& Clusters;
  const std::vector<double>& Areas;
  ClusterLight Light;
  const double Reference;
  const double LeaveOut;
  std::vector<ScatteringReceiver> Receivers; ///< some of all, by which rows are foreseen
  /// What receivers get by much finer links, receivers x components of the light; empty for any.
  std::vector<double> Received;
  /// Squared deviation of the profile, over its mean, from which on its mean over a cluster is the
  /// sum of parts; links for any light are narrow themselves.
  double WidestDeviation2 = std::numeric_limits<double>::infinity();
  /// Whether clusters that hold the receiver are, whatever their deviation.
  bool DividesOwn = true;
  /// Nodes that are divided for all receivers.
  std::vector<bool> AreDivided;
  double Threshold = 0.0;
  const LinkChoice* Kept = nullptr;
  double NewThreshold = std::numeric_limits<double>::infinity(); ///< of what is not kept
  /// With whom the sample is shared; of several ranks each looks at its own receivers.
  Ranks SharedWith;
  Prospect Expected;
  bool Limited = false;
};
} // namespace LightTransport

#endif
