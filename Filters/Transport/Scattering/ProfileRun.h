// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A run with a model that is a profile of distance, of a flat medium without end.
#ifndef ProfileRun_h
#define ProfileRun_h

#include "Scattering/ScatteringRun.h"

namespace LightTransport
{
struct AirShare;

class ProfileRun : public ScatteringRun
{
public:
  using ScatteringRun::ScatteringRun;

protected:
  Outcome Check() override;
  Outcome Gather() override;
  Outcome Link() override;
  void WriteScattered(const SceneOutput& output) override;
  const char* FindUseOfBody() const override;
  bool IsAnisotropic() const override { return this->IsTabulated(); }
  std::unique_ptr<LinkBuilder> MakeBuilder() const override;

private:
  bool IsTabulated() const;
  void CheckEnergy(const AirShare& air) const;
  void CheckThickness() const;
};
} // namespace LightTransport

#endif
