// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/OffScreenContext.h"

#include "Context/CurrentOpenGLContext.h"
#include "Context/OpenGLFunctions.h"

#include <vector>

namespace LightTransport
{
namespace
{
/// A context of Mesa's off-screen library, which draws into memory of ours.
class ContextOSMesa : public OffScreenContext
{
public:
  explicit ContextOSMesa(const OSMesaLibrary& mesa)
    : Mesa(mesa), Surface(4 * SurfaceSize * SurfaceSize)
  {
  }
  ~ContextOSMesa() override;

  bool Open();

  const char* GetBackendName() const override { return "OSMesa"; }
  void* GetHandle() const override { return this->Context; }
  bool MakeCurrent() override;
  bool IsCurrent() const override
  {
    return this->Context && this->Mesa.GetCurrentContext() == this->Context;
  }
  OpenGLProcedure GetProcAddress(const char* name) const override
  {
    return this->Mesa.GetProcAddress(name);
  }

private:
  const OSMesaLibrary Mesa;
  std::vector<unsigned char> Surface;
  OSMesaLibrary::Context Context = nullptr;
};

//------------------------------------------------------------------------------
ContextOSMesa::~ContextOSMesa()
{
  if (this->IsCurrent())
  {
    CurrentOpenGLContext::Release();
  }
  if (this->Context)
  {
    this->Mesa.DestroyContext(this->Context);
  }
}

//------------------------------------------------------------------------------
bool ContextOSMesa::Open()
{
  const int wanted[] = { OSMesaLibrary::Format, OSMesaLibrary::FormatRGBA, OSMesaLibrary::DepthBits,
    24, OSMesaLibrary::StencilBits, 8, OSMesaLibrary::Profile, OSMesaLibrary::CoreProfile,
    OSMesaLibrary::MajorVersion, 3, OSMesaLibrary::MinorVersion, 2, 0 };
  this->Context = this->Mesa.CreateContextAttribs(wanted, nullptr);
  const CurrentOpenGLContext before = CurrentOpenGLContext::Get();
  const bool usable = this->Context && this->MakeCurrent();
  before.Restore();
  return usable;
}

//------------------------------------------------------------------------------
bool ContextOSMesa::MakeCurrent()
{
  if (this->IsCurrent())
  {
    return true;
  }
  CurrentOpenGLContext::Release();
  return this->Mesa.MakeCurrent(this->Context, this->Surface.data(), GL_UNSIGNED_BYTE, SurfaceSize,
           SurfaceSize) == GL_TRUE;
}
} // namespace

//------------------------------------------------------------------------------
Outcome OffScreenContext::CreateOSMesa(std::unique_ptr<OffScreenContext>& context)
{
  const OSMesaLibrary* mesa = OSMesaLibrary::Get(true);
  if (!mesa)
  {
    return Outcome::Failed(
      "OSMesa: libOSMesa.so.8 cannot be loaded (Debian: apt install libosmesa6).");
  }
#ifdef GLEW_OK
  // GLEW finds OpenGL's functions through libGL alone.
  if (!mesa->IsPreloaded())
  {
    return Outcome::Failed("OSMesa: this VTK reaches it only when the process is started with "
                           "LD_PRELOAD=\"libOSMesa.so.8 liblighttransport_osmesa_preload.so\".");
  }
#endif
  auto opened = std::make_unique<ContextOSMesa>(*mesa);
  if (!opened->Open())
  {
    return Outcome::Failed(
      "OSMesa: the library offers no OpenGL 3.2 (Debian: apt install libosmesa6).");
  }
  context = std::move(opened);
  return Outcome::Done();
}
} // namespace LightTransport
