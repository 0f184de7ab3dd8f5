// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLLinkOperator.h"

#include "Device/DeviceErrors.h"
#include "Device/DeviceSession.h"
#include "Device/DeviceWindow.h"
#include "Products/ProductGL.h"
#include "Textures/FloatTextures.h"
#include "Textures/FloatVectors.h"

#include "vtkExchange.h"
#include "vtkObjectFactory.h"

#include <optional>

using namespace LightTransport;

// Registers this class with VTK's object factory whenever the library is loaded, also where nobody
// calls the module's own initialisation, as in a ParaView plugin.
VTK_MODULE_INIT(vtkLightTransportRendering);

vtkStandardNewMacro(vtkOpenGLLinkOperator);

namespace
{
bool Finish(vtkOpenGLLinkOperator* links, const Outcome& drawn, const char* method)
{
  return DeviceErrors::Finish(links, drawn, method, links->GetDeviceName());
}
} // namespace

struct vtkOpenGLLinkOperator::DeviceParts
{
  DeviceWindow Window;

  ///@{ All or none of them are there.
  std::unique_ptr<FloatTextures> Engine;
  std::unique_ptr<FloatVectors> Vectors;
  std::unique_ptr<ProductGL> Product;
  ///@}

  bool IsAlive() const { return this->Product && this->Engine->IsAlive(); }

  void Clear()
  {
    this->Product.reset();
    this->Vectors.reset();
    this->Engine.reset();
  }

  /// In the context of the window, which is open. Observers of progress get it now and then.
  Outcome Initialize(vtkExchange* exchange, int numberOfBands, int maximumTextureSize);
};

//------------------------------------------------------------------------------
Outcome vtkOpenGLLinkOperator::DeviceParts::Initialize(vtkExchange* exchange, int numberOfBands,
  int maximumTextureSize)
{
  this->Engine = std::make_unique<FloatTextures>(this->Window.Get());
  if (!this->Engine->IsAlive())
  {
    return Outcome::Failed("This OpenGL cannot make floating-point textures");
  }
  std::optional<DeviceSession> session(this->Window.Get());
  Outcome taken = Outcome::Done();
  const auto pause = [&]()
  {
    taken = taken ? DeviceErrors::Check() : taken;
    session.reset();
    vtkDeviceLinkOperator::Beat();
    session.emplace(this->Window.Get());
  };
  this->Vectors = std::make_unique<FloatVectors>(*this->Engine);
  if (Outcome initialized = this->Vectors->Initialize(exchange->GetNumberOfPatches(), numberOfBands,
        maximumTextureSize);
      !initialized)
  {
    return initialized;
  }
  if (Outcome made =
        ProductGL::Make(this->Product, exchange, *this->Engine, this->Vectors->GetLayout(), pause);
      !made)
  {
    return made;
  }
  taken = taken ? DeviceErrors::Check() : taken;
  return taken ? taken
               : Outcome::Failed("OpenGL failed in taking the links with " + taken.GetMessage() +
                   " on " + this->Window.GetDeviceName());
}

//------------------------------------------------------------------------------
vtkOpenGLLinkOperator::vtkOpenGLLinkOperator() : Device(new DeviceParts) {}

//------------------------------------------------------------------------------
vtkOpenGLLinkOperator::~vtkOpenGLLinkOperator()
{
  this->Device->Clear();
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DeviceName: " << this->GetDeviceName() << "\n";
  os << indent << "MaximumTextureSize: " << this->MaximumTextureSize << "\n";
  os << indent << "NumberOfBytesRead: " << this->GetNumberOfBytesRead() << "\n";
  os << indent << "RenderWindow: " << this->GetRenderWindow() << "\n";
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::SetRenderWindow(vtkRenderWindow* window)
{
  if (!this->Device->Window.IsUserWindow(window))
  {
    this->Release();
    this->Device->Window.SetUserWindow(window);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkRenderWindow* vtkOpenGLLinkOperator::GetRenderWindow()
{
  return this->Device->Window.GetUserWindow();
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Open(std::string& reason)
{
  const Outcome open = this->Device->Window.Open();
  reason = open ? reason : open.GetMessage();
  return static_cast<bool>(open);
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::IsHardware()
{
  return this->Device->Window.IsHardware();
}

//------------------------------------------------------------------------------
const char* vtkOpenGLLinkOperator::GetDeviceName()
{
  return this->Device->Window.GetDeviceName().c_str();
}

//------------------------------------------------------------------------------
int vtkOpenGLLinkOperator::GetNumberOfLinkTextures()
{
  return this->Device->Product ? this->Device->Product->GetNumberOfLinkTextures() : 0;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkOpenGLLinkOperator::GetNumberOfLinkBytes()
{
  return this->Device->Product
    ? static_cast<vtkTypeInt64>(this->Device->Product->GetNumberOfLinkBytes())
    : 0;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkOpenGLLinkOperator::GetNumberOfBytesRead()
{
  return this->Device->Vectors ? this->Device->Vectors->GetNumberOfBytesRead() : 0;
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::Release()
{
  this->Device->Clear();
  this->Device->Window.Release();
  this->NumberOfPatches = 0;
  this->NumberOfBands = 0;
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::ReleaseGraphicsResources(vtkWindow* window)
{
  if (window && window == this->Device->Window.Get())
  {
    this->Device->Clear();
  }
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Check(vtkExchange* exchange, int numberOfBands)
{
  if (!exchange || exchange->GetNumberOfPatches() == 0)
  {
    vtkErrorMacro("The exchange is empty: fill it before Initialize().");
    return false;
  }
  const int kernels = exchange->GetNumberOfKernels();
  if (numberOfBands < 1 || numberOfBands > MaximumNumberOfBands || kernels < 1 ||
    numberOfBands % kernels != 0)
  {
    vtkErrorMacro(<< numberOfBands << " bands with " << kernels << " kernels: OpenGL takes 1 to "
                  << int(MaximumNumberOfBands)
                  << " bands, a multiple of the kernels. Set Device to CPU for more.");
    return false;
  }
  if (exchange->GetNumberOfParts() > 1)
  {
    vtkErrorMacro("OpenGL holds all links, not one of " << exchange->GetNumberOfParts()
                                                        << " parts of them: set Device to CPU in "
                                                           "parallel runs.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Initialize(vtkExchange* exchange, int numberOfBands)
{
  this->Device->Clear();
  if (!this->Check(exchange, numberOfBands))
  {
    return false;
  }
  if (Outcome open = this->Device->Window.Open(); !open)
  {
    vtkErrorMacro("No OpenGL context: " << open.GetMessage());
    return false;
  }
  this->NumberOfPatches = exchange->GetNumberOfPatches();
  this->NumberOfBands = numberOfBands;
  if (Outcome initialized =
        this->Device->Initialize(exchange, numberOfBands, this->MaximumTextureSize);
      !initialized)
  {
    vtkErrorMacro(<< initialized.GetMessage() << ": set Device to CPU.");
    this->Release();
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::IsReady()
{
  if (!this->Device->IsAlive())
  {
    vtkErrorMacro("There are no links, or their window has gone: call Initialize() first.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::IsReady(int slot)
{
  if (!this->IsReady())
  {
    return false;
  }
  if (!this->Device->Vectors->Has(slot))
  {
    vtkErrorMacro("Slot " << slot << " is read before it has been written.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::SetVector(int slot, const double* values)
{
  if (!this->IsReady())
  {
    return false;
  }
  const DeviceSession session(this->Device->Window.Get());
  return Finish(this, this->Device->Vectors->Set(slot, values), "SetVector");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::GetVector(int slot, double* values)
{
  if (!this->IsReady(slot))
  {
    return false;
  }
  const DeviceSession session(this->Device->Window.Get());
  this->Device->Vectors->Read(slot, values);
  return Finish(this, Outcome::Done(), "GetVector");
}

//------------------------------------------------------------------------------
vtkTextureObject* vtkOpenGLLinkOperator::GetVectorTexture(int slot)
{
  if (!this->IsReady())
  {
    return nullptr;
  }
  const DeviceSession session(this->Device->Window.Get());
  FloatVectors& vectors = *this->Device->Vectors;
  return Finish(this, vectors.Allocate(slot), "GetVectorTexture") ? vectors.Get(slot)[0].Get()
                                                                  : nullptr;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Multiply(int y, int x)
{
  if (!this->IsReady(x))
  {
    return false;
  }
  if (x == y)
  {
    vtkErrorMacro("Multiply needs two slots, not slot " << x << " twice.");
    return false;
  }
  const DeviceSession session(this->Device->Window.Get());
  FloatVectors& vectors = *this->Device->Vectors;
  const Outcome allocated = vectors.Allocate(y);
  return Finish(this,
    allocated ? this->Device->Product->Draw(vectors.Get(y), vectors.Get(x)) : allocated,
    "Multiply");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Combine(int z, const double* a, int x, const double* b, int y)
{
  if (!this->IsReady(x) || !this->IsReady(y))
  {
    return false;
  }
  const DeviceSession session(this->Device->Window.Get());
  return Finish(this, this->Device->Vectors->Combine(z, a, x, b, y), "Combine");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Scale(int z, int x, int y)
{
  if (!this->IsReady(x) || !this->IsReady(y))
  {
    return false;
  }
  const DeviceSession session(this->Device->Window.Get());
  return Finish(this, this->Device->Vectors->Scale(z, x, y), "Scale");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Dot(int x, int y, double* result)
{
  if (!this->IsReady(x) || !this->IsReady(y))
  {
    return false;
  }
  const DeviceSession session(this->Device->Window.Get());
  return Finish(this, this->Device->Vectors->Dot(x, y, result), "Dot");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::MaxNorm(int x, double* result)
{
  if (!this->IsReady(x))
  {
    return false;
  }
  const DeviceSession session(this->Device->Window.Get());
  return Finish(this, this->Device->Vectors->MaxNorm(x, result), "MaxNorm");
}
