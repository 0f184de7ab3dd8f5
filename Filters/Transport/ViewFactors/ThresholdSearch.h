// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Thresholds for the links of one pass after another, until the error of all of them keeps a
/// tolerance: the error is about a power of the threshold, which two passes tell.
#ifndef ThresholdSearch_h
#define ThresholdSearch_h

namespace LightTransport
{
class ThresholdSearch
{
public:
  /// `squaredScale`: what a squared error is relative to.
  ThresholdSearch(double tolerance, double squaredScale);

  /// Of the squared error of a link.
  double GetThreshold() const { return this->Threshold; }

  /// After a pass: true where the error is small enough; otherwise the threshold is a new one.
  bool IsReached(double error);

private:
  double Tolerance;
  double Threshold;
  double LastThreshold = 0.0;
  double Error = 0.0; ///< of the last pass; 0 for none
};
} // namespace LightTransport

#endif
