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
  : Filter(filter), AllRanks(ranks), StartTime(vtkTimerLog::GetUniversalTime())
{
  filter->SetProgressText(nullptr);
}

//------------------------------------------------------------------------------
Monitor FilterProgress::GetMonitor()
{
  return Monitor([this](double done) { return this->Report(done); });
}

//------------------------------------------------------------------------------
// One rank that leaves alone would let the others wait for it for ever.
bool FilterProgress::Report(double done)
{
  this->Done = done;
  const bool goesOn = this->TellFilter();
  return this->AllRanks.GetLargest(goesOn ? 0 : 1) == 0;
}

//------------------------------------------------------------------------------
bool FilterProgress::Repeat()
{
  return this->TellFilter() || this->AllRanks.AreSeveral();
}

//------------------------------------------------------------------------------
bool FilterProgress::TellFilter()
{
  this->TellTimeLeft();
  return MakeFilterMonitor(this->Filter).Report(this->Done);
}

//------------------------------------------------------------------------------
void FilterProgress::TellTimeLeft()
{
  const double elapsed = vtkTimerLog::GetUniversalTime() - this->StartTime;
  if (elapsed < LongTime || this->Done <= 0.0)
  {
    return;
  }
  const double left = elapsed * (1.0 - this->Done) / this->Done;
  std::ostringstream text;
  text << this->Filter->GetClassName() << ": about "
       << (left < ManySeconds ? std::ceil(left) : std::ceil(left / 60.0))
       << (left < ManySeconds ? " s left" : " min left");
  this->Filter->SetProgressText(text.str().c_str());
}
} // namespace LightTransport
