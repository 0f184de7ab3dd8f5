// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * View factors of random scenes beside brute force: does "ViewFactorError" tell how far off they
 * are?
 *
 * What coordinates are not worth, no estimate tells: of a polygon that is w wide, touching others,
 * a share of some worth / w is on one side or the other of what it touches, and the two may choose
 * differently. That is allowed beside the estimate; at the origin in double precision it is
 * nothing.
 */
#ifndef ViewFactorProof_h
#define ViewFactorProof_h

#include "BruteForce.h"
#include "RandomScenes.h"
#include "ViewFactorTesting.h"

namespace LightTransportTesting
{
//------------------------------------------------------------------------------
/// What vtkViewFactors gives for polygons.
struct FactorTable
{
  std::size_t Size = 0;
  std::vector<double> Factors; ///< row by row
  std::vector<double> Sums, Errors, Sky, Back;
  double Get(std::size_t i, std::size_t j) const { return this->Factors[i * this->Size + j]; }
};

//------------------------------------------------------------------------------
inline FactorTable MakeFactorTable(const std::vector<Corners>& polygons, bool single,
  double tolerance)
{
  // Of random scenes there is much to warn of: back faces, openings, tolerances.
  const int warns = vtkObject::GetGlobalWarningDisplay();
  vtkObject::GlobalWarningDisplayOff();
  const auto factors = ComputeViewFactors(MakeData(polygons, single), tolerance);
  vtkObject::SetGlobalWarningDisplay(warns);
  FactorTable table;
  table.Size = polygons.size();
  table.Sums = GetCellValues(factors, "ViewFactorSum");
  table.Errors = GetCellValues(factors, "ViewFactorError");
  table.Sky = GetCellValues(factors, "SkyFraction");
  table.Back = GetCellValues(factors, "BackFaceFraction");
  for (std::size_t i = 0; i < table.Size; ++i)
  {
    for (std::size_t j = 0; j < table.Size; ++j)
    {
      table.Factors.push_back(
        factors->GetViewFactor(static_cast<vtkIdType>(i), static_cast<vtkIdType>(j)));
    }
  }
  return table;
}

//------------------------------------------------------------------------------
/// The error of one number of a row, and the standard error of what it is compared with.
struct Deviation
{
  std::string What;
  double Error = 0.0;
  double Sigma = 0.0;
  /// What of it standard errors do not explain, in estimates.
  double GetFactor(double estimate, double sigmas) const
  {
    return std::max(this->Error - sigmas * this->Sigma, 0.0) / estimate;
  }
};

//------------------------------------------------------------------------------
struct RowProof
{
  double Estimate = 0.0; ///< "ViewFactorError", and what coordinates are not worth
  Deviation Largest;     ///< of the entries
  Deviation Sum;         ///< of all entries
  Deviation Opening;     ///< the larger of sky and back faces
  /// Whether brute force is as exact as to tell.
  bool Tells() const
  {
    return std::max({ this->Largest.Sigma, this->Sum.Sigma, this->Opening.Sigma }) <=
      this->Estimate / 3.0;
  }
  /// More than 1 where the estimate is too small. Where standard errors are larger than it one in
  /// a hundred entries is off by three of them, hardly any by six.
  double GetFactor(const Deviation& deviation) const
  {
    return deviation.GetFactor(this->Estimate, this->Tells() ? 3.0 : 6.0);
  }
};

//------------------------------------------------------------------------------
/// What a row may be off by because polygons of these widths are given to a worth of coordinates.
inline double GetAmbiguity(const FactorTable& table, std::size_t row,
  const std::vector<double>& widths, double worth)
{
  double sum = 1.0 / widths[row];
  for (std::size_t j = 0; j < table.Size; ++j)
  {
    sum += table.Get(row, j) / widths[j];
  }
  return 4.0 * worth * sum;
}

//------------------------------------------------------------------------------
inline std::vector<double> GetWidths(const std::vector<Corners>& polygons)
{
  std::vector<double> widths;
  for (const Corners& polygon : polygons)
  {
    widths.push_back(GetWidth(polygon));
  }
  return widths;
}

//------------------------------------------------------------------------------
inline RowProof Compare(const FactorTable& table, std::size_t row, const BruteForceRow& right,
  double ambiguity)
{
  RowProof proof;
  // Single precision is what factors are stored in.
  proof.Estimate = table.Errors[row] + 1e-7 + ambiguity;
  const auto raise =
    [&](Deviation& deviation, const std::string& what, double value, double share, double sigma)
  {
    const double error = std::abs(value - share);
    if (error - 3.0 * sigma > deviation.Error - 3.0 * deviation.Sigma || deviation.What.empty())
    {
      deviation = { what + " " + std::to_string(value) + " right " + std::to_string(share), error,
        sigma };
    }
  };
  for (std::size_t j = 0; j < table.Size; ++j)
  {
    raise(proof.Largest, "to " + std::to_string(j), table.Get(row, j), right.Shares[j],
      right.Errors[j]);
  }
  raise(proof.Sum, "sum", table.Sums[row], right.Sum, right.SumError);
  raise(proof.Opening, "sky", table.Sky[row], right.Shares[right.GetSky()],
    right.Errors[right.GetSky()]);
  raise(proof.Opening, "back faces", table.Back[row], right.Shares[right.GetBack()],
    right.Errors[right.GetBack()]);
  return proof;
}
} // namespace LightTransportTesting

#endif
