// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// All that a computation of view factors leaves behind: what vtkViewFactors keeps, saves and
/// loads. Rows are in the order of the scene's patches (PatchScene).
#ifndef ViewFactorsResult_h
#define ViewFactorsResult_h

#include "vtkExchangeHierarchy.h"
#include "vtkExchangeMatrix.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace LightTransport
{
/// Two patches with something partly between them.
struct PartlyVisiblePair
{
  vtkIdType I = 0; ///< I < J
  vtkIdType J = 0;
  double Open = 0.0;  ///< the exchange with nothing between, unit of the matrix
  double Value = 0.0; ///< the exchange as computed
  double Error = 0.0; ///< estimate of its absolute error
};

struct ViewFactorsResult
{
  std::uint64_t Fingerprint = 0; ///< of the scene
  double Tolerance = 0.0;
  ///@{ One of the two.
  vtkSmartPointer<vtkExchangeMatrix> Exchange;
  vtkSmartPointer<vtkExchangeHierarchy> Hierarchy;
  ///@}
  vtkExchange* GetExchange() const
  {
    return this->Hierarchy ? static_cast<vtkExchange*>(this->Hierarchy) : this->Exchange;
  }
  std::vector<double> RawRowSums; ///< before any closure
  std::vector<double> RowSums;    ///< of the exchange as it is
  std::vector<double> RowErrors;  ///< estimate of sum_j |error of F_ij|
  std::vector<double> SkyFractions;
  std::vector<double> BackFaceFractions;
  std::string ClusterTree; ///< of the hierarchy: "Spatial" or "Atlas"
  /// Names and values of the field data arrays that summarise the computation.
  std::vector<std::pair<std::string, double>> Summaries;
};
} // namespace LightTransport

#endif
