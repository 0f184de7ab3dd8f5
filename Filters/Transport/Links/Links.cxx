// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Links/Links.h"

#include "Links/LinkOperators.h"
#include "Shared/FieldValues.h"
#include "Support/Ranks.h"
#include "vtkCPULinkOperator.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace LightTransport
{
namespace
{
// What sums of view factors lose by rounding in double precision.
constexpr double DoublePrecision = 1e-14;
} // namespace

//------------------------------------------------------------------------------
double Links::GetSummary(const std::string& name) const
{
  const auto found = std::find_if(this->Summaries.begin(), this->Summaries.end(),
    [&](const auto& summary) { return summary.first == name; });
  return found == this->Summaries.end() ? 0.0 : found->second;
}

//------------------------------------------------------------------------------
void Links::AddSummaries(vtkFieldData* fields) const
{
  for (const auto& summary : this->Summaries)
  {
    FieldValues::Add(fields, summary.first.c_str(), summary.second);
  }
  for (const auto& remark : this->Remarks)
  {
    FieldValues::Add(fields, remark.first.c_str(), remark.second);
  }
  if (this->Hierarchy && !this->IsSampled())
  {
    FieldValues::Add(fields, "ClusterTreeUsed", this->ClusterTree);
  }
}

//------------------------------------------------------------------------------
std::vector<double> Links::GetErrors() const
{
  std::vector<double> errors = this->RowErrors;
  for (std::size_t row = 0; row < errors.size() && this->AreRowsWhole; ++row)
  {
    const double sum = this->RowSums[row] + this->SkyFractions[row] + this->BackFaceFractions[row];
    errors[row] = std::max({ errors[row], this->OpeningErrors[row], std::abs(1.0 - sum) });
  }
  return errors;
}

//------------------------------------------------------------------------------
std::vector<double> Links::GetRowSumErrors() const
{
  std::vector<double> errors = this->RowErrors;
  errors.resize(this->RowSums.size(), 0.0);
  if (this->IsSampled())
  {
    double squares = 0.0;
    for (const double error : errors)
    {
      squares += error * error;
    }
    errors.assign(errors.size(), std::sqrt(squares) / static_cast<double>(errors.size()));
  }
  for (std::size_t row = 0; row < errors.size(); ++row)
  {
    if (this->AreRowsClosed && !this->IsSampled())
    {
      errors[row] = std::min(errors[row], std::abs(1.0 - this->RowSums[row]));
    }
    errors[row] = std::max(errors[row], DoublePrecision);
  }
  return errors;
}

//------------------------------------------------------------------------------
Outcome Links::SumRows(const Ranks& ranks)
{
  const std::vector<double>& areas = this->GetExchange()->GetAreas();
  const std::vector<double> ones(areas.size(), 1.0);
  this->RowSums.resize(areas.size());
  auto links = LinkOperators::MakeOnCPU(this->GetExchange(), 1, ranks);
  if (!links || !links->SetVector(0, ones.data()) || !links->Multiply(1, 0) ||
    !links->GetVector(1, this->RowSums.data()))
  {
    return Outcome::FailedAsReported();
  }
  std::transform(this->RowSums.begin(), this->RowSums.end(), areas.begin(), this->RowSums.begin(),
    std::divides<double>());
  return Outcome::Done();
}
} // namespace LightTransport
