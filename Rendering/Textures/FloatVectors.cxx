// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Textures/FloatVectors.h"

#include "vtkLightTransportTexturesCombineFS.h"
#include "vtkLightTransportTexturesReduceFS.h"
#include "vtkLightTransportTexturesScaleFS.h"

#include "vtkShaderProgram.h"

#include <algorithm>

namespace LightTransport
{
namespace
{
/// Block that one fragment reduces, in each direction (vtkLightTransportTexturesReduceFS.glsl).
constexpr int ReductionBlock = 16;
/// Texels of a line: at least one matrix texel of four columns.
constexpr int NarrowestVector = 4;
constexpr int WidestVector = 1024;
} // namespace

//------------------------------------------------------------------------------
std::string FloatVectors::Layout::GetDefines(int outputs) const
{
  return FloatTextures::GetDefines(this->Groups, outputs, this->Width);
}

//------------------------------------------------------------------------------
FloatVectors::FloatVectors(FloatTextures& engine) : Engine(engine) {}

//------------------------------------------------------------------------------
Outcome FloatVectors::Initialize(vtkIdType patches, int bands, int maximumSize)
{
  if (!this->ChooseSizes(patches, bands, maximumSize))
  {
    return Outcome::Failed(std::to_string(patches) + " patches and " + std::to_string(bands) +
      " bands are too many for OpenGL's textures of at most " +
      std::to_string(this->Shape.MaximumSize) + " texels a side");
  }
  if (!this->AllocateReductions())
  {
    return Outcome::Failed("Vectors of " + std::to_string(patches) +
      " patches do not fit into the memory of " + this->Engine.GetDeviceName());
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// False where they are too large.
bool FloatVectors::ChooseSizes(vtkIdType patches, int bands, int maximumSize)
{
  Layout& shape = this->Shape;
  shape.MaximumSize = this->Engine.GetMaximumTextureSize();
  if (maximumSize > 0)
  {
    shape.MaximumSize = std::min(shape.MaximumSize, std::max(maximumSize, NarrowestVector));
  }
  shape.Bands = bands;
  shape.Groups = FloatTextures::DivideUp(bands, 4);
  const vtkIdType widest = std::min<vtkIdType>(WidestVector, shape.MaximumSize);
  // No wider than the patches need.
  for (shape.Width = NarrowestVector; shape.Width < patches && 2 * shape.Width <= widest;)
  {
    shape.Width *= 2;
  }
  const vtkIdType height = (patches + shape.Width - 1) / shape.Width;
  if (height > shape.MaximumSize || shape.Groups > this->Engine.GetMaximumGroupSize())
  {
    return false;
  }
  shape.Patches = static_cast<int>(patches);
  shape.Height = static_cast<int>(height);
  return true;
}

//------------------------------------------------------------------------------
Outcome FloatVectors::AllocateReductions()
{
  const auto count = static_cast<std::size_t>(this->Shape.Groups);
  int width = this->Shape.Width;
  int lines = this->Shape.Height;
  Outcome allocated = this->Engine.Allocate(this->Spare, count, width, lines);
  while (allocated && (this->Reductions.empty() || width * lines > 1))
  {
    width = FloatTextures::DivideUp(width, ReductionBlock);
    lines = FloatTextures::DivideUp(lines, ReductionBlock);
    this->Reductions.emplace_back();
    allocated = this->Engine.Allocate(this->Reductions.back(), count, width, lines);
  }
  return allocated;
}

//------------------------------------------------------------------------------
Outcome FloatVectors::Allocate(int slot)
{
  Group& vector = this->Slots[slot];
  return vector.empty()
    ? this->Engine.Allocate(vector, static_cast<std::size_t>(this->Shape.Groups), this->Shape.Width,
        this->Shape.Height)
    : Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome FloatVectors::Set(int slot, const double* values)
{
  if (Outcome allocated = this->Allocate(slot); !allocated)
  {
    return allocated;
  }
  const Group& vector = this->Get(slot);
  const int bands = this->Shape.Bands;
  const int region[4] = { 0, 0, this->Shape.Width, this->Shape.Height };
  for (std::size_t group = 0; group < vector.size(); ++group)
  {
    std::vector<float> texels(static_cast<std::size_t>(4) * region[2] * region[3], 0.0f);
    const int firstBand = 4 * static_cast<int>(group);
    for (vtkIdType patch = 0; patch < this->Shape.Patches; ++patch)
    {
      for (int lane = 0; lane < std::min(4, bands - firstBand); ++lane)
      {
        texels[static_cast<std::size_t>(4 * patch + lane)] =
          static_cast<float>(values[patch * bands + firstBand + lane]);
      }
    }
    this->Engine.Upload(vector[group], region, region[2], texels.data());
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void FloatVectors::Read(int slot, double* values)
{
  this->Read(this->Slots[slot], values);
}

//------------------------------------------------------------------------------
void FloatVectors::Read(const Group& vector, double* values)
{
  const int bands = this->Shape.Bands;
  const int width = static_cast<int>(vector[0]->GetWidth());
  const int height = static_cast<int>(vector[0]->GetHeight());
  const int count = std::min(this->Shape.Patches, width * height);
  std::vector<float> texels(static_cast<std::size_t>(4) * width * height);
  for (int group = 0; group < this->Shape.Groups; ++group)
  {
    this->Engine.Download(vector, static_cast<std::size_t>(group), width, height, texels.data());
    for (int patch = 0; patch < count; ++patch)
    {
      for (int lane = 0; lane < 4 && 4 * group + lane < bands; ++lane)
      {
        values[static_cast<vtkIdType>(patch) * bands + 4 * group + lane] =
          texels[static_cast<std::size_t>(4 * patch + lane)];
      }
    }
    this->NumberOfBytesRead += static_cast<vtkTypeInt64>(texels.size() * sizeof(float));
  }
}

//------------------------------------------------------------------------------
Outcome FloatVectors::Use(vtkShaderProgram*& program, const char* name, const char* body,
  const Group& x, const Group& y, const std::string& extra)
{
  const Outcome used =
    this->Engine.Use(program, name, body, this->Shape.GetDefines(this->Shape.Groups) + extra);
  if (used)
  {
    this->Engine.SetTextures(program, "x", x);
    this->Engine.SetTextures(program, "y", y);
  }
  return used;
}

//------------------------------------------------------------------------------
// Drawn beside the slot, which may be an operand, and exchanged with it.
void FloatVectors::DrawIntoSlot(int slot)
{
  const int region[4] = { 0, 0, this->Shape.Width, this->Shape.Height };
  this->Engine.Draw(this->Spare, region);
  std::swap(this->Spare, this->Slots[slot]);
}

//------------------------------------------------------------------------------
Outcome FloatVectors::Combine(int z, const double* a, int x, const double* b, int y)
{
  std::vector<float> factorsOfX(static_cast<std::size_t>(4) * this->Shape.Groups, 0.0f);
  std::vector<float> factorsOfY(factorsOfX);
  for (int band = 0; band < this->Shape.Bands; ++band)
  {
    factorsOfX[static_cast<std::size_t>(band)] = static_cast<float>(a[band]);
    factorsOfY[static_cast<std::size_t>(band)] = static_cast<float>(b[band]);
  }
  if (Outcome allocated = this->Allocate(z); !allocated)
  {
    return allocated;
  }
  vtkShaderProgram* program = nullptr;
  Outcome used = this->Use(program, "Combine", vtkLightTransportTexturesCombineFS, this->Slots[x],
    this->Slots[y]);
  if (used)
  {
    program->SetUniform4fv("a", this->Shape.Groups, factorsOfX.data());
    program->SetUniform4fv("b", this->Shape.Groups, factorsOfY.data());
    this->DrawIntoSlot(z);
  }
  return used;
}

//------------------------------------------------------------------------------
Outcome FloatVectors::Scale(int z, int x, int y)
{
  if (Outcome allocated = this->Allocate(z); !allocated)
  {
    return allocated;
  }
  vtkShaderProgram* program = nullptr;
  Outcome used =
    this->Use(program, "Scale", vtkLightTransportTexturesScaleFS, this->Slots[x], this->Slots[y]);
  if (used)
  {
    this->DrawIntoSlot(z);
  }
  return used;
}

//------------------------------------------------------------------------------
Outcome FloatVectors::Dot(int x, int y, double* result)
{
  return this->DrawReduction(this->Slots[x], this->Slots[y], "REDUCE_PRODUCT", "REDUCE_SUM",
    result);
}

//------------------------------------------------------------------------------
Outcome FloatVectors::MaxNorm(int x, double* result)
{
  return this->DrawReduction(this->Slots[x], this->Slots[x], "REDUCE_MAXIMUM", "REDUCE_MAXIMUM",
    result);
}

//------------------------------------------------------------------------------
Outcome FloatVectors::DrawReduction(const Group& x, const Group& y, const char* name,
  const char* nextName, double* result)
{
  Outcome drawn = this->DrawReductionStep(this->Reductions[0], x, y, name);
  for (std::size_t step = 1; step < this->Reductions.size() && drawn; ++step)
  {
    const Group& source = this->Reductions[step - 1];
    drawn = this->DrawReductionStep(this->Reductions[step], source, source, nextName);
  }
  if (drawn)
  {
    this->Read(this->Reductions.back(), result);
  }
  return drawn;
}

//------------------------------------------------------------------------------
Outcome FloatVectors::DrawReductionStep(const Group& target, const Group& x, const Group& y,
  const char* name)
{
  const std::string define = "#define " + std::string(name) + " 1\n";
  vtkShaderProgram* program = nullptr;
  Outcome used = this->Use(program, name, vtkLightTransportTexturesReduceFS, x, y, define);
  if (used)
  {
    const int size[2] = { static_cast<int>(x[0]->GetWidth()), static_cast<int>(x[0]->GetHeight()) };
    program->SetUniform2i("size", size);
    const int region[4] = { 0, 0, static_cast<int>(target[0]->GetWidth()),
      static_cast<int>(target[0]->GetHeight()) };
    this->Engine.Draw(target, region);
  }
  return used;
}
} // namespace LightTransport
