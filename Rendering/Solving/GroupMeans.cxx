// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Solving/GroupMeans.h"

#include "Context/OpenGLContextGuard.h"
#include "Device/DeviceErrors.h"
#include "Device/DeviceSession.h"
#include "vtkLightTransportSolvingGroupMeansFS.h"

#include "vtkShaderProgram.h"

namespace LightTransport
{
namespace
{
constexpr int Width = 1 << GroupMeans::WidthBits;

std::size_t CountTexels(const FloatTextures::Group& table)
{
  return static_cast<std::size_t>(table[0]->GetWidth()) * table[0]->GetHeight();
}
} // namespace

//------------------------------------------------------------------------------
GroupMeans::~GroupMeans()
{
  if (this->Engine.IsAlive())
  {
    const OpenGLContextGuard guard(this->Engine.GetWindow());
    this->Ranges.clear();
    this->Members.clear();
    this->Means.clear();
  }
}

//------------------------------------------------------------------------------
Outcome GroupMeans::Upload(const std::vector<vtkIdType>& starts,
  const std::vector<vtkIdType>& patches, const std::vector<double>& parts, int patchWidth)
{
  const DeviceSession session(this->Engine.GetWindow());
  const auto groups = static_cast<vtkIdType>(starts.size()) - 1;
  const auto members = static_cast<vtkIdType>(patches.size());
  if (members > FloatTextures::MaximumTexels)
  {
    return Outcome::Failed("more than 2^24 corners of patches");
  }
  const int lines = FloatTextures::DivideUp(groups, Width);
  Outcome allocated = this->Engine.Allocate(this->Ranges, 1, Width, lines);
  allocated = allocated ? this->Engine.Allocate(this->Means, 1, Width, lines) : allocated;
  allocated = allocated
    ? this->Engine.Allocate(this->Members, 1, Width, FloatTextures::DivideUp(members, Width))
    : allocated;
  if (!allocated)
  {
    return allocated;
  }
  std::vector<float> ranges(4 * CountTexels(this->Ranges), 0.0f);
  for (std::size_t group = 0; group + 1 < starts.size(); ++group)
  {
    ranges[4 * group] = static_cast<float>(starts[group]);
    ranges[4 * group + 1] = static_cast<float>(starts[group + 1]);
  }
  std::vector<float> places(4 * CountTexels(this->Members), 0.0f);
  for (std::size_t member = 0; member < patches.size(); ++member)
  {
    places[4 * member] = static_cast<float>(patches[member] % patchWidth);
    places[4 * member + 1] = static_cast<float>(patches[member] / patchWidth);
    places[4 * member + 2] = static_cast<float>(parts[member]);
  }
  this->Engine.UploadTable(this->Ranges, ranges);
  this->Engine.UploadTable(this->Members, places);
  return DeviceErrors::Check();
}

//------------------------------------------------------------------------------
Outcome GroupMeans::Draw(vtkTextureObject* values, const std::array<float, 4>& scales)
{
  const DeviceSession session(this->Engine.GetWindow());
  vtkShaderProgram* program = nullptr;
  if (Outcome used = this->Engine.Use(program, "GroupMeans", vtkLightTransportSolvingGroupMeansFS,
        FloatTextures::GetDefines(1, 1, Width));
      !used)
  {
    return used;
  }
  this->Engine.SetTextures(program, "ranges", this->Ranges);
  this->Engine.SetTextures(program, "members", this->Members);
  this->Engine.SetTextures(program, "values", { values });
  program->SetUniform4f("scales", scales.data());
  const int region[4] = { 0, 0, Width, static_cast<int>(this->Means[0]->GetHeight()) };
  this->Engine.Draw(this->Means, region);
  return DeviceErrors::Check();
}
} // namespace LightTransport
