// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A run that ends with the links of texels, for those who apply them themselves: it reads no
/// light, and writes which row a texel is.
#ifndef TexelLinksRun_h
#define TexelLinksRun_h

#include "Scattering/ProfileRun.h"

namespace LightTransport
{
class TexelLinksRun : public ProfileRun
{
public:
  using ProfileRun::ProfileRun;

protected:
  Outcome Check() override;
  Outcome Read() override { return this->CheckTexels(); }
  Outcome ReadIrradiance() override { return Outcome::Done(); }
  Outcome Compute() override { return Outcome::Done(); }
  void Write() override;
};
} // namespace LightTransport

#endif
