// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Run/FilterProgress.h"

#include "Shared/FilterMonitor.h"
#include "vtkAlgorithm.h"
#include "vtkTimerLog.h"

#include <cmath>
#include <sstream>

namespace LightTransport
{
namespace
{
// Seconds from which on a user wants to know how long it takes.
constexpr double LongTime = 2.0;
// Seconds from which on they are told in minutes.
constexpr double ManySeconds = 120.0;
} // namespace

//------------------------------------------------------------------------------
FilterProgress::FilterProgress(vtkAlgorithm* filter, const Ranks& ranks)
  : Filter(filter), AllRanks(ranks)
{
}

//------------------------------------------------------------------------------
Monitor FilterProgress::GetMonitor()
{
  if (this->StartTime == 0.0)
  {
    this->StartTime = vtkTimerLog::GetUniversalTime();
    this->Filter->SetProgressText(nullptr);
  }
  return Monitor([this](double done) { return this->Report(done); });
}

//------------------------------------------------------------------------------
// One rank that leaves alone would let the others wait for it for ever.
bool FilterProgress::Report(double done)
{
  this->TellTimeLeft(done);
  const bool goesOn = MakeFilterMonitor(this->Filter).Report(done);
  return this->AllRanks.GetLargest(goesOn ? 0 : 1) == 0;
}

//------------------------------------------------------------------------------
void FilterProgress::TellTimeLeft(double done)
{
  const double elapsed = vtkTimerLog::GetUniversalTime() - this->StartTime;
  if (elapsed < LongTime || done <= 0.0)
  {
    return;
  }
  const double left = elapsed * (1.0 - done) / done;
  std::ostringstream text;
  text << this->Filter->GetClassName() << ": about "
       << (left < ManySeconds ? std::ceil(left) : std::ceil(left / 60.0))
       << (left < ManySeconds ? " s left" : " min left");
  this->Filter->SetProgressText(text.str().c_str());
}
} // namespace LightTransport
