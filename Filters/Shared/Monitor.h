// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How a long job says how far it is, and hears that nobody wants it any more. Handed down from the
 * filter; a stage of a job gets a monitor of its own, whose fractions are a part of the whole.
 */
#ifndef Monitor_h
#define Monitor_h

#include "Shared/Outcome.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace LightTransport
{
class Monitor
{
public:
  /// Gets the fraction that is done, 0 to 1; returns false when the job is to stop.
  using Function = std::function<bool(double)>;

  /// Nobody looks.
  Monitor() = default;
  explicit Monitor(Function report) : ReportToUser(std::move(report)) {}

  ///@{
  /// Say how far the job is, from the thread that it was started on; on several ranks on all of
  /// them alike. False (aborted) when it is to stop.
  bool Report(double fraction) const
  {
    const double within = std::min(std::max(fraction, 0.0), 1.0);
    return !this->ReportToUser ||
      this->ReportToUser(this->Begin + within * (this->End - this->Begin));
  }
  Outcome Check(double fraction) const
  {
    return Outcome::DoneUnlessAborted(this->Report(fraction));
  }
  ///@}

  /// For a stage that goes from the fraction `begin` to `end` of this job.
  Monitor GetStage(double begin, double end) const
  {
    Monitor stage(this->ReportToUser);
    stage.Begin = this->Begin + begin * (this->End - this->Begin);
    stage.End = this->Begin + end * (this->End - this->Begin);
    return stage;
  }

private:
  Function ReportToUser;
  double Begin = 0.0;
  double End = 1.0;
};
} // namespace LightTransport

#endif
