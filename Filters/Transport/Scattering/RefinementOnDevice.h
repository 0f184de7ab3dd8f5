// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The walks of ScatteringReceiver done by a device: which clusters are near, which are left out,
/// and which links there are beyond, some receivers at a time. What is near comes as patches, whose
/// integrals are the receiver's.
#ifndef RefinementOnDevice_h
#define RefinementOnDevice_h

#include "Shared/Outcome.h"
#include "vtkDeviceLinkRefiner.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

namespace LightTransport
{
class ScatteringClusters;

class RefinementOnDevice
{
public:
  using Part = vtkDeviceLinkRefiner::Part;

  /// What one receiver finds, in the order of the patches; a part that is divided comes before
  /// those below it.
  struct Walk
  {
    const Part* Begin;
    const Part* End;
  };

  /// Both must outlive this; the device is open.
  RefinementOnDevice(vtkDeviceLinkRefiner* device, const ScatteringClusters& clusters)
    : Device(device), Clusters(clusters)
  {
  }

  /// What is certainly below `leaveOut`, per mm^2, is; links from each slot may miss its limit
  /// (vtkDeviceLinkRefiner::Slot). A failure says why this device cannot.
  Outcome Initialize(double leaveOut, const std::vector<double>& limits);

  /// How many receivers to look from at a time: all that a device finds for them is kept, and that
  /// may be much for each.
  vtkIdType GetBatchSize() const { return this->BatchSize; }
  /// Look from patches [first, last).
  Outcome Refine(vtkIdType first, vtkIdType last);
  /// Of one of them.
  Walk GetWalk(vtkIdType patch) const;

  bool HasFailed() const { return this->Failed; }

private:
  static constexpr vtkIdType FirstBatch = 2048;

  Outcome Fail(const std::string& reason);
  void SortByReceivers(const std::vector<Part>& parts, vtkIdType last);
  bool SortWalk(Part* begin, Part* end) const;

  vtkDeviceLinkRefiner* Device;
  const ScatteringClusters& Clusters;
  vtkIdType BatchSize = FirstBatch;
  vtkIdType First = 0;
  std::vector<std::size_t> Offsets; ///< of each receiver from First on
  std::vector<Part> Parts;
  bool Failed = false;
};
} // namespace LightTransport

#endif
