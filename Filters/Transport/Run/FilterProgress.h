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
  FilterProgress(vtkAlgorithm* filter, const Ranks& ranks);

  /// For the whole run; it must not outlive this. Time is counted from the first call on.
  Monitor GetMonitor();

private:
  bool Report(double done);
  void TellTimeLeft(double done);

  vtkAlgorithm* Filter;
  Ranks AllRanks;
  double StartTime = 0.0;
};
} // namespace LightTransport

#endif
