// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLScatteredMap.h"

#include "Atlas/AtlasTexture.h"
#include "Device/DeviceSession.h"
#include "Maps/AtlasDrawing.h"
#include "Maps/TexelImage.h"
#include "Shared/ArrayNames.h"
#include "Shared/Attempt.h"
#include "vtkLightTransportMapsEnterFS.h"
#include "vtkLightTransportMapsLeaveFS.h"
#include "vtkOpenGLAtlasTexture.h"
#include "vtkOpenGLLinkOperator.h"
#include "vtkOpenGLTransmittedMap.h"

#include "vtkDoubleArray.h"
#include "vtkExchange.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkShaderProgram.h"
#include "vtkSubsurfaceScattering.h"

#include <algorithm>
#include <string>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenGLScatteredMap);

namespace
{
constexpr Advice WithoutMemory = { "use a smaller ScatteredMapSize or fewer links",
  "OpenGL gave up", "try a newer driver" };
constexpr int Bands = 3;

/// Slots of the link operator.
enum Slot
{
  ENTERING,
  LEAVING
};

//------------------------------------------------------------------------------
int GetLevel(int size)
{
  int level = 0;
  while ((size >> level) > 1)
  {
    ++level;
  }
  return level;
}

} // namespace

struct vtkOpenGLScatteredMap::Parts
{
  vtkSmartPointer<vtkExchange> Exchange;
  ///@{ What they were made for.
  vtkMTimeType SurfaceTime = 0;
  vtkMTimeType MaterialTime = 0;
  int Resolution = 0;
  ///@}
  bool HasFailed = false;

  vtkNew<vtkOpenGLLinkOperator> Links;
  FloatTextures::Group Rows;   ///< by rows of the links: which texel
  FloatTextures::Group Owners; ///< by texels: which row
  bool IsUploaded = false;
  vtkMTimeType AppliedTime = 0; ///< of what enters; links were applied to it, or failed
  bool HasApplied = false;
};

//------------------------------------------------------------------------------
vtkOpenGLScatteredMap::vtkOpenGLScatteredMap() : Device(new Parts)
{
  this->Texture->IsDrawnInto = true;
}

//------------------------------------------------------------------------------
vtkOpenGLScatteredMap::~vtkOpenGLScatteredMap()
{
  this->ReleaseGraphicsResources();
}

//------------------------------------------------------------------------------
void vtkOpenGLScatteredMap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Material: " << this->Material.Get() << "\n";
  os << indent << "NumberOfLinkRuns: " << this->NumberOfLinkRuns << "\n";
  os << indent << "NumberOfScatteringRuns: " << this->NumberOfScatteringRuns << "\n";
}

//------------------------------------------------------------------------------
void vtkOpenGLScatteredMap::SetMaterial(vtkSubsurfaceScattering* material)
{
  if (this->Material != material)
  {
    this->Material = material;
    this->Device->MaterialTime = 0;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkSubsurfaceScattering* vtkOpenGLScatteredMap::GetMaterial()
{
  return this->Material;
}

//------------------------------------------------------------------------------
vtkOpenGLAtlasTexture* vtkOpenGLScatteredMap::GetTexture()
{
  return this->Texture;
}

//------------------------------------------------------------------------------
vtkImageData* vtkOpenGLScatteredMap::GetTexels()
{
  return this->Texels;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkOpenGLScatteredMap::GetNumberOfBytesRead()
{
  return this->Device->Links->GetNumberOfBytesRead();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkOpenGLScatteredMap::GetNumberOfLinkBytes()
{
  return this->Device->Links->GetNumberOfLinkBytes();
}

//------------------------------------------------------------------------------
void vtkOpenGLScatteredMap::ReleaseGraphicsResources()
{
  AtlasTexture& texture = *this->Texture->Texture;
  if (texture.IsOpen())
  {
    const OpenGLContextGuard guard(texture.GetEngine().GetWindow());
    this->Device->Rows.clear();
    this->Device->Owners.clear();
  }
  this->Device->Rows.clear();
  this->Device->Owners.clear();
  this->Device->Links->Release();
  this->Device->IsUploaded = false;
  // What did not fit may fit now.
  this->Device->HasFailed = this->Device->HasFailed && !this->Device->Exchange;
  this->Texture->Texture->Clear();
}

//------------------------------------------------------------------------------
bool vtkOpenGLScatteredMap::Update(vtkOpenGLTransmittedMap* entering)
{
  if (!this->Material || !entering || !entering->GetDrawing())
  {
    vtkErrorMacro("There is no material, or no map of what enters: set the one, and update the "
                  "other.");
    return false;
  }
  const Outcome done = Attempt([&]() { return this->Refresh(entering); }, WithoutMemory);
  if (done.HasFailed() && !done.GetMessage().empty())
  {
    vtkErrorMacro(<< done.GetMessage());
  }
  return static_cast<bool>(done);
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLScatteredMap::Refresh(vtkOpenGLTransmittedMap* entering)
{
  Parts& parts = *this->Device;
  const bool areLinked = parts.SurfaceTime == entering->GetSurfaceTime() &&
    parts.MaterialTime == this->Material->GetMTime() && parts.Resolution == this->Resolution;
  if (areLinked && parts.HasFailed)
  {
    return Outcome::FailedAsReported();
  }
  Outcome done = this->Open(entering);
  // Failed until it is done: memory may end it by an exception.
  if (done && !areLinked)
  {
    parts.HasFailed = true;
    done = this->MakeLinks(entering);
    parts.HasFailed = !done;
  }
  if (done && !(parts.IsUploaded && this->Texture->Texture->IsThere()))
  {
    parts.HasFailed = true;
    parts.AppliedTime = 0;
    done = this->Upload();
    parts.IsUploaded = static_cast<bool>(done);
    parts.HasFailed = !done;
  }
  if (!done || parts.AppliedTime == entering->GetRunTime())
  {
    return done && !parts.HasApplied ? Outcome::FailedAsReported() : done;
  }
  parts.AppliedTime = entering->GetRunTime();
  parts.HasApplied = false;
  done = this->Apply(entering);
  parts.HasApplied = static_cast<bool>(done);
  this->NumberOfScatteringRuns += parts.HasApplied ? 1 : 0;
  return done;
}

//------------------------------------------------------------------------------
// In the context that the map of what enters lives in.
Outcome vtkOpenGLScatteredMap::Open(vtkOpenGLTransmittedMap* entering)
{
  AtlasTexture& texture = *this->Texture->Texture;
  vtkOpenGLRenderWindow* window = entering->Texture->Texture->GetEngine().GetWindow();
  if (texture.IsOpen() && texture.GetEngine().GetWindow() == window)
  {
    return Outcome::Done();
  }
  this->ReleaseGraphicsResources();
  this->Device->Links->SetRenderWindow(window);
  const Outcome open = texture.Open(window);
  return open ? open : Outcome::Failed("No OpenGL context to scatter in: " + open.GetMessage());
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLScatteredMap::MakeLinks(vtkOpenGLTransmittedMap* entering)
{
  Parts& parts = *this->Device;
  parts.SurfaceTime = entering->GetSurfaceTime();
  parts.MaterialTime = this->Material->GetMTime();
  parts.Resolution = this->Resolution;
  parts.Exchange = nullptr;
  parts.IsUploaded = false;
  this->Texture->Texture->ClearTexture();
  AtlasDrawing& drawing = *entering->GetDrawing();
  if (Outcome checked = drawing.CheckSize(this->Resolution, "ScatteredMapSize"); !checked)
  {
    return checked;
  }
  vtkNew<vtkImageData> texels;
  {
    const DeviceSession session(this->Texture->Texture->GetEngine().GetWindow());
    if (Outcome made =
          MakeTexelImage(drawing, this->Texture->Texture->GetEngine(), this->Resolution, texels);
        !made)
    {
      return Outcome::Failed("OpenGL failed in drawing the texels of an atlas with " +
        made.GetMessage() + ": choose a smaller ScatteredMapSize.");
    }
  }
  parts.Exchange = this->Material->MakeTexelLinks(texels, this->Texels);
  ++this->NumberOfLinkRuns;
  return parts.Exchange ? Outcome::Done() : Outcome::FailedAsReported();
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLScatteredMap::Upload()
{
  Parts& parts = *this->Device;
  AtlasTexture& texture = *this->Texture->Texture;
  FloatTextures& engine = texture.GetEngine();
  if (!parts.Links->Initialize(parts.Exchange, Bands))
  {
    return Outcome::FailedAsReported();
  }
  vtkTextureObject* vector = parts.Links->GetVectorTexture(ENTERING);
  if (!vector)
  {
    return Outcome::FailedAsReported();
  }
  const DeviceSession session(engine.GetWindow());
  const int width = static_cast<int>(vector->GetWidth());
  const int height = static_cast<int>(vector->GetHeight());
  Outcome allocated = texture.AllocateWithinMemory(this->Resolution, "ScatteredMapSize");
  allocated = allocated ? engine.Allocate(parts.Rows, 1, width, height) : allocated;
  allocated =
    allocated ? engine.Allocate(parts.Owners, 1, this->Resolution, this->Resolution) : allocated;
  if (!allocated)
  {
    return allocated;
  }
  this->UploadTables(width, height);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void vtkOpenGLScatteredMap::UploadTables(int width, int height)
{
  Parts& parts = *this->Device;
  vtkPointData* maps = this->Texels->GetPointData();
  vtkDataArray* rows = maps->GetArray(ArrayNames::LinkRow);
  vtkDataArray* areas = maps->GetArray(ArrayNames::TexelArea);
  const std::vector<double>& linkedAreas = parts.Exchange->GetAreas();
  const vtkIdType texels = areas->GetNumberOfTuples();
  double whole = 0.0;
  for (vtkIdType texel = 0; texel < texels; ++texel)
  {
    whole += areas->GetComponent(texel, 0);
  }
  const double meanArea = whole / static_cast<double>(texels);
  std::vector<float> places(static_cast<std::size_t>(4) * width * height, 0.0f);
  std::vector<float> owners(static_cast<std::size_t>(4 * texels), 0.0f);
  for (vtkIdType texel = 0; texel < texels; ++texel)
  {
    const auto row = static_cast<std::size_t>(rows->GetComponent(texel, 0));
    if (row == 0)
    {
      continue;
    }
    float* place = &places[4 * (row - 1)];
    place[0] = static_cast<float>(texel % this->Resolution);
    place[1] = static_cast<float>(texel / this->Resolution);
    place[2] = 1.0f;
    float* owner = &owners[static_cast<std::size_t>(4 * texel)];
    owner[0] = static_cast<float>(row);
    owner[1] = static_cast<float>(1.0 / linkedAreas[row - 1]);
    owner[2] = static_cast<float>(areas->GetComponent(texel, 0) / meanArea);
  }
  FloatTextures& engine = this->Texture->Texture->GetEngine();
  engine.UploadTable(parts.Rows, places);
  engine.UploadTable(parts.Owners, owners);
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLScatteredMap::Apply(vtkOpenGLTransmittedMap* entering)
{
  Parts& parts = *this->Device;
  AtlasTexture& texture = *this->Texture->Texture;
  FloatTextures& engine = texture.GetEngine();
  AtlasTexture& source = *entering->Texture->Texture;
  const FloatTextures::Group sent = { parts.Links->GetVectorTexture(ENTERING) };
  const int width = static_cast<int>(sent[0]->GetWidth());
  const std::string defines = FloatTextures::GetDefines(1, 1, width);
  const int levels = GetLevel(source.GetResolution()) - GetLevel(this->Resolution);
  vtkShaderProgram* program = nullptr;
  {
    const DeviceSession session(engine.GetWindow());
    if (Outcome used = engine.Use(program, "Enter", vtkLightTransportMapsEnterFS, defines); !used)
    {
      return used;
    }
    engine.SetTextures(program, "rows", parts.Rows);
    engine.SetTextures(program, "entering", source.GetTexels());
    program->SetUniformi("level", std::max(levels, 0));
    program->SetUniformi("shift", std::max(-levels, 0));
    const int region[4] = { 0, 0, width, static_cast<int>(sent[0]->GetHeight()) };
    engine.Draw(sent, region);
  }
  if (!parts.Links->Multiply(LEAVING, ENTERING))
  {
    return Outcome::FailedAsReported();
  }
  const FloatTextures::Group received = { parts.Links->GetVectorTexture(LEAVING) };
  const DeviceSession session(engine.GetWindow());
  // Vectors of another width need another program.
  const std::string name = "Leave" + std::to_string(width);
  if (Outcome used = engine.Use(program, name, vtkLightTransportMapsLeaveFS, defines); !used)
  {
    return used;
  }
  engine.SetTextures(program, "texels", parts.Owners);
  engine.SetTextures(program, "leaving", received);
  const int region[4] = { 0, 0, this->Resolution, this->Resolution };
  engine.Draw(texture.GetTexels(), region);
  return texture.MakeLevels();
}
