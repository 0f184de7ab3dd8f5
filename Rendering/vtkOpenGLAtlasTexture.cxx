// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLAtlasTexture.h"

#include "Context/LightTransportOpenGL.h"
#include "Textures/FloatTextures.h"
#include "vtkLightTransportAtlasPointsFS.h"
#include "vtkLightTransportAtlasSampleFS.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenGLAtlasTexture);

namespace
{
/// Points are sampled in textures of this width, and at most this many at a time.
constexpr int WidthBits = 10;
constexpr vtkIdType MostPoints = vtkIdType(1) << 20;

//------------------------------------------------------------------------------
// The sum of all areas; -1 where one is negative or not finite.
double SumAreas(vtkDataArray* areas)
{
  double sum = 0.0;
  for (vtkIdType texel = 0; texel < areas->GetNumberOfTuples(); ++texel)
  {
    const double area = areas->GetComponent(texel, 0);
    if (!(area >= 0.0) || !std::isfinite(area))
    {
      return -1.0;
    }
    sum += area;
  }
  return sum;
}

//------------------------------------------------------------------------------
// Value x area and area in single precision, areas relative to their mean. Empty where one is not
// finite.
std::vector<float> Weigh(vtkDataArray* values, vtkDataArray* areas, double meanArea)
{
  const vtkIdType texels = values->GetNumberOfTuples();
  const int last = values->GetNumberOfComponents() - 1;
  std::vector<float> weighed(static_cast<std::size_t>(4 * texels));
  for (vtkIdType texel = 0; texel < texels; ++texel)
  {
    float* rgba = &weighed[static_cast<std::size_t>(4 * texel)];
    rgba[3] = static_cast<float>(areas->GetComponent(texel, 0) / meanArea);
    for (int k = 0; k < 3; ++k)
    {
      rgba[k] = static_cast<float>(values->GetComponent(texel, std::min(k, last)) * rgba[3]);
      if (!std::isfinite(rgba[k]))
      {
        return {};
      }
    }
  }
  return weighed;
}

//------------------------------------------------------------------------------
// `components` of each of the tuples [first, first + count), in texels of a texture.
void Pack(vtkDataArray* array, vtkIdType first, vtkIdType count, int lane,
  std::vector<float>& texels)
{
  for (vtkIdType k = 0; k < count; ++k)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      texels[static_cast<std::size_t>(4 * k + lane + component)] =
        static_cast<float>(array->GetComponent(first + k, component));
    }
  }
}

//------------------------------------------------------------------------------
// A square of a power of two texels a side whose place is a multiple of it.
bool IsBlock(const double block[3], int resolution)
{
  const double size = block[2];
  bool good = size >= 1.0 && size <= resolution && std::exp2(std::round(std::log2(size))) == size;
  for (int axis = 0; axis < 2; ++axis)
  {
    good = good && block[axis] >= 0.0 && block[axis] < resolution &&
      std::floor(block[axis] / size) * size == block[axis];
  }
  return good;
}
} // namespace

struct vtkOpenGLAtlasTexture::Internals
{
  vtkSmartPointer<vtkOffScreenOpenGLRenderWindow> OffScreenWindow;
  std::unique_ptr<FloatTextures> Engine;
  FloatTextures::Group Atlas;
  int Resolution = 0;
  int Components = 0;

  void Clear()
  {
    this->ClearAtlas();
    this->Engine.reset();
    this->OffScreenWindow = nullptr;
  }

  void ClearAtlas()
  {
    if (this->Engine && this->Engine->IsAlive())
    {
      const OpenGLContextGuard guard(this->Engine->GetWindow());
      this->Atlas.clear();
    }
    this->Atlas.clear();
    this->Resolution = 0;
    this->Components = 0;
  }

  bool Open(vtkRenderWindow* window, std::string& reason);
  bool Upload(const std::vector<float>& texels, int levels);
  bool Sample(vtkDataArray* coordinates, vtkDataArray* blocks, vtkDataArray* levels,
    vtkDoubleArray* values);
  bool DrawPoints(const FloatTextures::Group& target, const FloatTextures::Group& points,
    const FloatTextures::Group& blocks, int height);
};

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::Internals::Open(vtkRenderWindow* window, std::string& reason)
{
  if (!window)
  {
    this->OffScreenWindow = vtkGetSharedOffScreenWindow(reason);
    window = this->OffScreenWindow;
  }
  auto* openGL = vtkOpenGLRenderWindow::SafeDownCast(window);
  if (!openGL || openGL->GetState()->GetRenderer().empty())
  {
    reason = window ? "the render window has none yet: render once." : reason;
    return false;
  }
  this->Engine = std::make_unique<FloatTextures>(openGL);
  reason = "this OpenGL cannot make floating-point textures.";
  return this->Engine->IsAlive();
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::Internals::Upload(const std::vector<float>& texels, int levels)
{
  std::string ignored;
  if (this->Resolution > this->Engine->GetMaximumTextureSize())
  {
    return false;
  }
  this->Atlas = this->Engine->Allocate(1, this->Resolution, this->Resolution);
  if (this->Atlas.empty())
  {
    return false;
  }
  // Shaders ask for whole levels: between two of them each needs its own coordinates.
  this->Atlas[0]->SetMinificationFilter(vtkTextureObject::LinearMipmapNearest);
  this->Atlas[0]->SetMagnificationFilter(vtkTextureObject::Linear);
  this->Atlas[0]->SetMaxLevel(levels - 1);
  const int region[4] = { 0, 0, this->Resolution, this->Resolution };
  this->Engine->Upload(this->Atlas[0], region, this->Resolution, texels.data());
  // vtkTextureObject makes levels only together with texels.
  this->Atlas[0]->Activate();
  glGenerateMipmap(GL_TEXTURE_2D);
  this->Atlas[0]->Deactivate();
  return FloatTextures::CheckErrors(ignored);
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::Internals::DrawPoints(const FloatTextures::Group& target,
  const FloatTextures::Group& points, const FloatTextures::Group& blocks, int height)
{
  const std::string defines =
    "#define GROUPS 1\n#define OUTPUTS 1\n#define WIDTH_BITS " + std::to_string(WidthBits) + "\n";
  const std::string body = vtkOpenGLAtlasTexture::GetShaderCode() + vtkLightTransportAtlasPointsFS;
  vtkShaderProgram* program = this->Engine->Use("Points", body.c_str(), defines);
  if (!program)
  {
    return false;
  }
  this->Engine->SetTextures(program, "atlas", this->Atlas);
  this->Engine->SetTextures(program, "points", points);
  this->Engine->SetTextures(program, "blocks", blocks);
  const int region[4] = { 0, 0, 1 << WidthBits, height };
  this->Engine->Draw(target, region);
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::Internals::Sample(vtkDataArray* coordinates, vtkDataArray* blocks,
  vtkDataArray* levels, vtkDoubleArray* values)
{
  const vtkIdType count = coordinates->GetNumberOfTuples();
  if (count == 0)
  {
    return true;
  }
  const int width = 1 << WidthBits;
  const int height = FloatTextures::DivideUp(std::min(count, MostPoints), width);
  const FloatTextures::Group textures = this->Engine->Allocate(3, width, height);
  bool good = !textures.empty();
  std::vector<float> texels(static_cast<std::size_t>(4 * width) * height);
  for (vtkIdType first = 0; first < count && good; first += MostPoints)
  {
    const vtkIdType part = std::min(count - first, MostPoints);
    const int region[4] = { 0, 0, width, height };
    Pack(coordinates, first, part, 0, texels);
    Pack(levels, first, part, 2, texels);
    this->Engine->Upload(textures[0], region, width, texels.data());
    Pack(blocks, first, part, 0, texels);
    this->Engine->Upload(textures[1], region, width, texels.data());
    good = this->DrawPoints({ textures[2] }, { textures[0] }, { textures[1] }, height);
    this->Engine->Download({ textures[2] }, 0, width, height, texels.data());
    for (vtkIdType k = 0; k < this->Components * part; ++k)
    {
      const vtkIdType point = k / this->Components;
      const auto component = static_cast<int>(k % this->Components);
      values->SetComponent(first + point, component,
        texels[static_cast<std::size_t>(4 * point + component)]);
    }
  }
  return good;
}

//------------------------------------------------------------------------------
vtkOpenGLAtlasTexture::vtkOpenGLAtlasTexture() : Self(new Internals) {}

//------------------------------------------------------------------------------
vtkOpenGLAtlasTexture::~vtkOpenGLAtlasTexture()
{
  this->Self->Clear();
}

//------------------------------------------------------------------------------
void vtkOpenGLAtlasTexture::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->GetResolution() << "\n";
  os << indent << "NumberOfComponents: " << this->GetNumberOfComponents() << "\n";
  os << indent << "NumberOfLevels: " << this->GetNumberOfLevels() << "\n";
}

//------------------------------------------------------------------------------
int vtkOpenGLAtlasTexture::GetResolution()
{
  return this->Self->Resolution;
}

//------------------------------------------------------------------------------
int vtkOpenGLAtlasTexture::GetNumberOfComponents()
{
  return this->Self->Components;
}

//------------------------------------------------------------------------------
int vtkOpenGLAtlasTexture::GetNumberOfLevels()
{
  int levels = 0;
  while ((this->Self->Resolution >> levels) > 0)
  {
    ++levels;
  }
  return levels;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::CheckMaps(vtkImageData* maps, const char* valueName,
  const char* areaName)
{
  if (!maps || !valueName || !areaName)
  {
    vtkErrorMacro("There is no image, or no name of an array: give the texel maps of an atlas.");
    return false;
  }
  int size[3];
  maps->GetDimensions(size);
  if (size[0] < 1 || size[0] != size[1] || size[2] != 1 || (size[0] & (size[0] - 1)) != 0)
  {
    vtkErrorMacro("The image has " << size[0] << " x " << size[1] << " x " << size[2]
                                   << " texels: an atlas is square with a power of two a side.");
    return false;
  }
  vtkDataArray* values = maps->GetPointData()->GetArray(valueName);
  vtkDataArray* areas = maps->GetPointData()->GetArray(areaName);
  if (!values || (values->GetNumberOfComponents() != 1 && values->GetNumberOfComponents() != 3))
  {
    vtkErrorMacro("The image needs a point array \"" << valueName << "\" with 1 or 3 components.");
    return false;
  }
  if (!areas || areas->GetNumberOfComponents() != 1)
  {
    vtkErrorMacro("The image needs a point array \""
      << areaName << "\" with 1 component, the area of surface in each texel.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::Build(vtkImageData* maps, const char* valueName, const char* areaName,
  vtkRenderWindow* window)
{
  Internals& self = *this->Self;
  self.Clear();
  if (!this->CheckMaps(maps, valueName, areaName))
  {
    return false;
  }
  vtkDataArray* values = maps->GetPointData()->GetArray(valueName);
  vtkDataArray* areas = maps->GetPointData()->GetArray(areaName);
  const double sum = SumAreas(areas);
  if (!(sum > 0.0))
  {
    vtkErrorMacro(
      "The areas in \"" << areaName << "\" must be finite, not negative, and not all 0.");
    return false;
  }
  const std::vector<float> texels =
    Weigh(values, areas, sum / static_cast<double>(areas->GetNumberOfTuples()));
  if (texels.empty())
  {
    vtkErrorMacro("A value of \"" << valueName << "\" is not finite in single precision.");
    return false;
  }
  std::string reason;
  if (!self.Open(window, reason))
  {
    self.Clear();
    vtkErrorMacro("No OpenGL context to sample the atlas in: " << reason);
    return false;
  }
  const FloatTextures::Session session(self.Engine->GetWindow());
  self.Resolution = maps->GetDimensions()[0];
  self.Components = values->GetNumberOfComponents();
  if (!self.Upload(texels, this->GetNumberOfLevels()))
  {
    vtkErrorMacro("An atlas of " << self.Resolution << " x " << self.Resolution
                                 << " texels does not fit into " << self.Engine->GetDeviceName()
                                 << ": choose a lower resolution.");
    self.ClearAtlas();
    return false;
  }
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::IsReady()
{
  const Internals& self = *this->Self;
  if (!self.Engine || !self.Engine->IsAlive() || self.Atlas.empty())
  {
    vtkErrorMacro("There is no texture, or its window has gone: call Build() first.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::ReadLevel(int level, vtkFloatArray* texels)
{
  if (!this->IsReady())
  {
    return false;
  }
  if (level < 0 || level >= this->GetNumberOfLevels())
  {
    vtkErrorMacro("There is no level " << level << ": the atlas has levels 0 to "
                                       << this->GetNumberOfLevels() - 1 << ".");
    return false;
  }
  const Internals& self = *this->Self;
  const FloatTextures::Session session(self.Engine->GetWindow());
  const vtkIdType side = self.Resolution >> level;
  texels->SetNumberOfComponents(4);
  texels->SetNumberOfTuples(side * side);
  vtkOpenGLState* state = self.Engine->GetWindow()->GetState();
  self.Atlas[0]->Activate();
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, 4);
  glGetTexImage(GL_TEXTURE_2D, level, GL_RGBA, GL_FLOAT, texels->GetPointer(0));
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, 1);
  self.Atlas[0]->Deactivate();
  std::string text;
  if (!FloatTextures::CheckErrors(text))
  {
    vtkErrorMacro("OpenGL failed in reading a level with " << text << ".");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::CheckPoints(vtkDataArray* coordinates, vtkDataArray* blocks,
  vtkDataArray* levels, vtkDoubleArray* values)
{
  if (!coordinates || !blocks || !levels || !values || coordinates->GetNumberOfComponents() != 2 ||
    blocks->GetNumberOfComponents() != 3 || levels->GetNumberOfComponents() != 1 ||
    blocks->GetNumberOfTuples() != coordinates->GetNumberOfTuples() ||
    levels->GetNumberOfTuples() != coordinates->GetNumberOfTuples())
  {
    vtkErrorMacro("Each point needs 2 coordinates, the 3 numbers of a block and 1 level.");
    return false;
  }
  for (vtkIdType point = 0; point < blocks->GetNumberOfTuples(); ++point)
  {
    double block[3];
    blocks->GetTuple(point, block);
    if (!IsBlock(block, this->Self->Resolution))
    {
      vtkErrorMacro("The block (" << block[0] << ", " << block[1] << "), size " << block[2]
                                  << ", of point " << point << " is no node of a quadtree of "
                                  << this->Self->Resolution << " texels a side.");
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::Sample(vtkDataArray* coordinates, vtkDataArray* blocks,
  vtkDataArray* levels, vtkDoubleArray* values)
{
  if (!this->IsReady() || !this->CheckPoints(coordinates, blocks, levels, values))
  {
    return false;
  }
  Internals& self = *this->Self;
  const FloatTextures::Session session(self.Engine->GetWindow());
  values->SetNumberOfComponents(self.Components);
  values->SetNumberOfTuples(coordinates->GetNumberOfTuples());
  std::string text = "too little memory";
  const bool good = self.Sample(coordinates, blocks, levels, values);
  if (!good || !FloatTextures::CheckErrors(text))
  {
    vtkErrorMacro("OpenGL failed in sampling an atlas with "
      << text << " on " << self.Engine->GetDeviceName() << ".");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
std::string vtkOpenGLAtlasTexture::GetShaderCode()
{
  return vtkLightTransportAtlasSampleFS;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::Activate(vtkShaderProgram* program, const char* name)
{
  if (!program || !name || !this->IsReady())
  {
    return false;
  }
  this->Self->Atlas[0]->Activate();
  return program->SetUniformi(name, this->Self->Atlas[0]->GetTextureUnit());
}

//------------------------------------------------------------------------------
void vtkOpenGLAtlasTexture::Deactivate()
{
  if (!this->Self->Atlas.empty())
  {
    this->Self->Atlas[0]->Deactivate();
  }
}

//------------------------------------------------------------------------------
void vtkOpenGLAtlasTexture::ReleaseGraphicsResources()
{
  this->Self->Clear();
}
