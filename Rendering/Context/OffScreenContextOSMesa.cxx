// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/OffScreenContext.h"

#include "Context/LightTransportOpenGL.h"

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
  vtkOpenGLProcedure GetProcAddress(const char* name) const override
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
std::unique_ptr<OffScreenContext> OffScreenContext::CreateOSMesa(std::string& reason)
{
  const OSMesaLibrary* mesa = OSMesaLibrary::Get(true);
  if (!mesa)
  {
    reason = "OSMesa: libOSMesa.so.8 cannot be loaded (Debian: apt install libosmesa6).";
    return nullptr;
  }
#ifdef GLEW_OK
  // GLEW finds OpenGL's functions through libGL alone.
  if (!mesa->IsPreloaded())
  {
    reason = "OSMesa: this VTK reaches it only when the process is started with "
             "LD_PRELOAD=\"libOSMesa.so.8 liblighttransport_osmesa_preload.so\".";
    return nullptr;
  }
#endif
  auto context = std::make_unique<ContextOSMesa>(*mesa);
  if (!context->Open())
  {
    reason = "OSMesa: the library offers no OpenGL 3.2 (Debian: apt install libosmesa6).";
    return nullptr;
  }
  return context;
}
} // namespace LightTransport
