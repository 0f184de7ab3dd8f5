// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Progress of a filter for its observers, with the time that is left in the progress text of long
/// runs, and the user's wish to abort, agreed on by all ranks.
#ifndef FilterProgress_h
#define FilterProgress_h

#include "Shared/Monitor.h"
#include "Support/Ranks.h"

class vtkAlgorithm;

namespace LightTransport
{
class FilterProgress
{
public:
  /// Time is counted from here on.
  FilterProgress(vtkAlgorithm* filter, const Ranks& ranks);

  /// For the whole run; it must not outlive this.
  Monitor GetMonitor();

  /// Say again how far the run is, between two reports, on this rank alone; several hear an abort
  /// at their next report. False when the run is to stop.
  bool Repeat();

private:
  bool Report(double done);
  bool TellFilter();
  void TellTimeLeft();

  vtkAlgorithm* Filter;
  Ranks AllRanks;
  double StartTime;
  double Done = 0.0;
};
} // namespace LightTransport

#endif
