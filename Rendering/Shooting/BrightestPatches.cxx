// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/BrightestPatches.h"

#include "vtkLightTransportShootingSelectFS.h"

#include "vtkShaderProgram.h"

#include <algorithm>

namespace LightTransport
{
namespace
{
/// Candidates are left where the reduction ends: this many in each direction.
constexpr int CandidatesAcross = 4;
/// Texels that one fragment looks at, in each direction.
constexpr int ReductionBlock = 16;
} // namespace

//------------------------------------------------------------------------------
Outcome BrightestPatches::Allocate(const FloatVectors::Layout& vectors)
{
  this->Vectors = vectors;
  Outcome allocated = Outcome::Done();
  int width = this->Vectors.Width;
  int height = this->Vectors.Height;
  do
  {
    for (int* size : { &width, &height })
    {
      const int reduced = FloatTextures::DivideUp(*size, ReductionBlock);
      *size = std::min(*size, std::max(reduced, CandidatesAcross));
    }
    this->Steps.emplace_back();
    allocated = this->Engine.Allocate(this->Steps.back(), 1, width, height);
  } while (allocated && (width > CandidatesAcross || height > CandidatesAcross));
  return allocated;
}

//------------------------------------------------------------------------------
Outcome BrightestPatches::Use(vtkShaderProgram*& program, bool first)
{
  return this->Engine.Use(program, first ? "SelectFirst" : "Select",
    vtkLightTransportShootingSelectFS,
    this->Vectors.GetDefines(1) + "#define FIRST_STEP " + (first ? "1\n" : "0\n"));
}

//------------------------------------------------------------------------------
void BrightestPatches::DrawStep(vtkShaderProgram* program, const FloatTextures::Group& source,
  const FloatTextures::Group& target)
{
  const int sourceSize[2] = { static_cast<int>(source[0]->GetWidth()),
    static_cast<int>(source[0]->GetHeight()) };
  const int region[4] = { 0, 0, static_cast<int>(target[0]->GetWidth()),
    static_cast<int>(target[0]->GetHeight()) };
  program->SetUniform2i("sourceSize", sourceSize);
  program->SetUniform2i("size", region + 2);
  this->Engine.Draw(target, region);
}

//------------------------------------------------------------------------------
Outcome BrightestPatches::DrawFirstStep(const FloatTextures::Group& radiosity,
  const FloatTextures::Group& areas)
{
  vtkShaderProgram* program = nullptr;
  const Outcome used = this->Use(program, true);
  if (used)
  {
    this->Engine.SetTextures(program, "unshot", radiosity);
    this->Engine.SetTextures(program, "areas", areas);
    this->DrawStep(program, radiosity, this->Steps[0]);
  }
  return used;
}

//------------------------------------------------------------------------------
Outcome BrightestPatches::DrawNextStep(std::size_t step)
{
  vtkShaderProgram* program = nullptr;
  const Outcome used = this->Use(program, false);
  if (used)
  {
    this->Engine.SetTextures(program, "found", this->Steps[step - 1]);
    this->DrawStep(program, this->Steps[step - 1], this->Steps[step]);
  }
  return used;
}

//------------------------------------------------------------------------------
Outcome BrightestPatches::Find(std::vector<Patch>& patches, const FloatTextures::Group& radiosity,
  const FloatTextures::Group& areas)
{
  Outcome drawn = this->DrawFirstStep(radiosity, areas);
  for (std::size_t step = 1; step < this->Steps.size() && drawn; ++step)
  {
    drawn = this->DrawNextStep(step);
  }
  if (drawn)
  {
    this->Read(patches);
  }
  return drawn;
}

//------------------------------------------------------------------------------
void BrightestPatches::Read(std::vector<Patch>& patches)
{
  const FloatTextures::Group& last = this->Steps.back();
  const int width = static_cast<int>(last[0]->GetWidth());
  const int height = static_cast<int>(last[0]->GetHeight());
  std::vector<float> texels(static_cast<std::size_t>(4) * width * height);
  this->Engine.Download(last, 0, width, height, texels.data());
  this->NumberOfBytesRead += static_cast<vtkTypeInt64>(texels.size() * sizeof(float));
  for (std::size_t k = 0; k < texels.size(); k += 4)
  {
    if (texels[k] > 0.0f)
    {
      patches.push_back({ texels[k], static_cast<int>(texels[k + 1]) });
    }
  }
  std::sort(patches.begin(), patches.end(),
    [](const Patch& a, const Patch& b)
    { return a.Power > b.Power || (a.Power == b.Power && a.Index < b.Index); });
}
} // namespace LightTransport
