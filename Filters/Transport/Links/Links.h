// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Links of a scene, and all that is known of them. Rows are in the order of the scene's patches
/// (PatchScene).
#ifndef Links_h
#define Links_h

#include "Links/LinkChoice.h"
#include "Links/LinksThroughAir.h"
#include "Links/RayNumbers.h"
#include "Shared/Outcome.h"
#include "vtkExchangeHierarchy.h"
#include "vtkExchangeMatrix.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkFieldData;

namespace LightTransport
{
class Ranks;

struct Links
{
  std::uint64_t Fingerprint = 0; ///< of the scene
  double Tolerance = 0.0;

  ///@{ One of the two.
  vtkSmartPointer<vtkExchangeMatrix> Matrix;
  vtkSmartPointer<vtkExchangeHierarchy> Hierarchy;
  ///@}
  /// Whichever is there, or nullptr.
  vtkExchange* GetExchange() const
  {
    return this->Hierarchy ? static_cast<vtkExchange*>(this->Hierarchy) : this->Matrix;
  }

  ///@{ Where the links are view factors: one per patch.
  std::vector<double> RawRowSums; ///< before any closure
  std::vector<double> RowSums;    ///< of the exchange as it is
  std::vector<double> RowErrors;  ///< estimate of sum_j |error of F_ij|
  std::vector<double> SkyFractions;
  std::vector<double> BackFaceFractions;
  std::vector<double> OpeningErrors; ///< estimate for the less exact of the two fractions
  bool AreRowsClosed = false;        ///< row sums, sky and back faces make 1
  bool AreRowsWhole = true;          ///< no pairs were left out
  ///@}

  ///@{ How often rays of other patches met a patch, where rays were cast: whole numbers.
  std::vector<double> FrontHits;
  std::vector<double> BackHits;
  ///@}

  ///@{ Where links are counts of photons, of each band: what one of them adds, and the area on
  /// which one has started.
  std::vector<double> PhotonSizes;
  std::vector<double> PhotonAreas;
  ///@}
  ///@{ Where links are those of a profile: its total, and the standard error of that, relative, of
  /// each band.
  std::vector<double> ProfileTotals;
  std::vector<double> ProfileErrors;
  ///@}
  ///@{ Of those, what goes through air (AirShare has the share of it). Dropped ones are not among
  /// the links.
  LinksThroughAir ThroughAir;
  bool AreThroughAirDropped = false;
  ///@}

  ///@{ What may be kept when patches move; nullptr where nothing can. Of the links the part that is
  /// from clusters that were chosen for patches elsewhere.
  std::shared_ptr<LinkChoice> Choice;
  double ReusedShare = 0.0;
  ///@}

  /// Names and values of the field data arrays that summarise how the links were made.
  std::vector<std::pair<std::string, double>> Summaries;
  /// And those that are text.
  std::vector<std::pair<std::string, std::string>> Remarks;
  std::string ClusterTree; ///< of the hierarchy: "Spatial" or "Atlas"

  ///@{ Where the hierarchy joins patches alone, by what rays have met: how many of each patch, and
  /// which patches have exact links (empty: none).
  RayNumbers Rays;
  std::vector<bool> ExactPatches;
  bool IsSampled() const { return this->Rays.Each > 0; }
  bool IsExact(vtkIdType patch) const
  {
    return !this->ExactPatches.empty() && this->ExactPatches[patch];
  }
  /// Whether the links of a patch are exact or by many rays: closing the others leaves them alone.
  bool IsApart(vtkIdType patch) const { return this->IsExact(patch) || this->Rays.IsBright(patch); }
  ///@}

  /// Not empty where users should doubt the links: why, and the remedy.
  std::string Warning;

  /// The value of a summary, 0 where there is none of that name.
  double GetSummary(const std::string& name) const;
  /// All of them, and the cluster tree.
  void AddSummaries(vtkFieldData* fields) const;

  /// Of each row with its openings: the largest of the errors of its view factors, of its two
  /// fractions, and of their sum.
  std::vector<double> GetErrors() const;

  /// Of each row sum. A row without openings that has been closed is as good as its sum. Rows of
  /// rays are wrong independently of each other: of them that of their mean.
  std::vector<double> GetRowSumErrors() const;

  /// Row sums of the exchange as it is, into RowSums. Collective.
  Outcome SumRows(const Ranks& ranks);
};
} // namespace LightTransport

#endif
