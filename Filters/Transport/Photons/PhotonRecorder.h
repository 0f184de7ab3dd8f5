// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Who gets to know through which patches photons entered and left, beside the sums of what left.
#ifndef PhotonRecorder_h
#define PhotonRecorder_h

#include "Photons/PhotonMedium.h"
#include "vtkType.h"

#include <vector>

namespace LightTransport
{
class PhotonRecorder
{
public:
  struct Event
  {
    vtkIdType Entry;
    vtkIdType Exit;
    double Weights[MostPhotonBands];
  };

  virtual ~PhotonRecorder() = default;

  /// Some more, of this rank; the weights are those of these bands. Collective.
  virtual void Add(std::vector<Event>& events, const std::vector<int>& bands) = 0;
};
} // namespace LightTransport

#endif
