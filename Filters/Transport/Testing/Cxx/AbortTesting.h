// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What tests of aborts share.
#ifndef AbortTesting_h
#define AbortTesting_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"

#include <algorithm>
#include <vector>

namespace LightTransportTesting
{
/// A filter that tells every beat.
template <typename Filter>
class Attentive : public Filter
{
public:
  static Attentive* New()
  {
    auto* filter = new Attentive;
    filter->InitializeObjectBase();
    return filter;
  }

protected:
  Attentive() { this->ProgressInterval = 0.0; }
};

/// Hears progress and aborts at one of its events.
class Listener : public vtkCommand
{
public:
  static Listener* New() { return new Listener; }

  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    auto* filter = static_cast<vtkAlgorithm*>(caller);
    this->Progress.push_back(filter->GetProgress());
    if (static_cast<int>(this->Progress.size()) == this->AbortAt)
    {
      filter->SetAbortExecute(1);
    }
  }

  /// Events with a progress in [begin, end).
  long Count(double begin, double end) const
  {
    return std::count_if(this->Progress.begin(), this->Progress.end(),
      [=](double progress) { return progress >= begin && progress < end; });
  }

  int AbortAt = 0;
  std::vector<double> Progress;
};
} // namespace LightTransportTesting

#endif
