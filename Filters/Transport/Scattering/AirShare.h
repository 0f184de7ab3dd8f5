// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Of the light that scattering links carry the share that goes through air (AirGaps): of what
/// leaves the patches, or would leave them were such links not dropped.
#ifndef AirShare_h
#define AirShare_h

#include <vector>

namespace LightTransport
{
struct Links;

struct AirShare
{
  /// `entering` and `leaving`: light of the patches, patches x components, those of each band of
  /// one light or several.
  AirShare(const Links& links, const std::vector<double>& entering,
    const std::vector<double>& leaving);

  ///@{ One for each component. The error is one standard error, at least what one link of the
  /// sample would add; 0 where all links were looked at.
  std::vector<double> Shares;
  std::vector<double> Errors;
  ///@}
};
} // namespace LightTransport

#endif
