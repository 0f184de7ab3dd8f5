// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLLinkOperator.h"

#include "Products/ProductGL.h"
#include "Textures/FloatTextures.h"
#include "Textures/FloatVectors.h"

#include "vtkExchange.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"

using namespace LightTransport;

// Registers this class with VTK's object factory whenever the library is loaded, also where nobody
// calls the module's own initialisation, as in a ParaView plugin.
VTK_MODULE_INIT(vtkLightTransportRendering);

vtkStandardNewMacro(vtkOpenGLLinkOperator);

struct vtkOpenGLLinkOperator::Internals
{
  vtkWeakPointer<vtkOpenGLRenderWindow> UserWindow;
  bool UsesUserWindow = false;
  vtkSmartPointer<vtkOffScreenOpenGLRenderWindow> SharedWindow;
  std::string DeviceName = "OpenGL";
  bool Hardware = false;

  ///@{ All or none of them are there.
  std::unique_ptr<FloatTextures> Engine;
  std::unique_ptr<FloatVectors> Vectors;
  std::unique_ptr<ProductGL> Product;
  ///@}

  vtkOpenGLRenderWindow* GetWindow()
  {
    return this->UsesUserWindow ? this->UserWindow.Get() : this->SharedWindow.Get();
  }

  bool IsAlive() const { return this->Product && this->Engine->IsAlive(); }

  void Clear()
  {
    this->Product.reset();
    this->Vectors.reset();
    this->Engine.reset();
  }
};

//------------------------------------------------------------------------------
vtkOpenGLLinkOperator::vtkOpenGLLinkOperator() : Self(new Internals) {}

//------------------------------------------------------------------------------
vtkOpenGLLinkOperator::~vtkOpenGLLinkOperator()
{
  this->Self->Clear();
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DeviceName: " << this->Self->DeviceName << "\n";
  os << indent << "MaximumTextureSize: " << this->MaximumTextureSize << "\n";
  os << indent << "NumberOfBytesRead: " << this->GetNumberOfBytesRead() << "\n";
  os << indent << "RenderWindow: " << this->GetRenderWindow() << "\n";
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::SetRenderWindow(vtkRenderWindow* window)
{
  if (window == this->GetRenderWindow() && this->Self->UsesUserWindow == (window != nullptr))
  {
    return;
  }
  this->Release();
  this->Self->UserWindow = vtkOpenGLRenderWindow::SafeDownCast(window);
  this->Self->UsesUserWindow = window != nullptr;
  this->Modified();
}

//------------------------------------------------------------------------------
vtkRenderWindow* vtkOpenGLLinkOperator::GetRenderWindow()
{
  return this->Self->UserWindow;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Open(std::string& reason)
{
  Internals& self = *this->Self;
  if (!self.UsesUserWindow && !self.SharedWindow)
  {
    self.SharedWindow = vtkGetSharedOffScreenWindow(reason);
  }
  vtkOpenGLRenderWindow* window = self.GetWindow();
  if (!window)
  {
    reason =
      self.UsesUserWindow ? "OpenGL: the render window is gone, or not an OpenGL window." : reason;
    return false;
  }
  auto* offScreen = vtkOffScreenOpenGLRenderWindow::SafeDownCast(window);
  if (offScreen && self.UsesUserWindow)
  {
    const CurrentOpenGLContext before = CurrentOpenGLContext::Get();
    const bool open = offScreen->Open(reason);
    before.Restore();
    if (!open)
    {
      return false;
    }
  }
  // Making the context of a window on a screen may abort the process, so that is left to the
  // window's owner.
  const std::string device = window->GetState()->GetRenderer();
  if (device.empty())
  {
    reason = "OpenGL: the render window has no context yet; let it render once first.";
    return false;
  }
  self.Hardware = vtkOpenGLDeviceIsHardware(device);
  self.DeviceName = "OpenGL (" + device + ")";
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::IsHardware()
{
  return this->Self->Hardware;
}

//------------------------------------------------------------------------------
const char* vtkOpenGLLinkOperator::GetDeviceName()
{
  return this->Self->DeviceName.c_str();
}

//------------------------------------------------------------------------------
int vtkOpenGLLinkOperator::GetNumberOfLinkTextures()
{
  return this->Self->Product ? this->Self->Product->GetNumberOfLinkTextures() : 0;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkOpenGLLinkOperator::GetNumberOfBytesRead()
{
  return this->Self->Vectors ? this->Self->Vectors->GetNumberOfBytesRead() : 0;
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::Release()
{
  this->Self->Clear();
  this->Self->SharedWindow = nullptr;
  this->NumberOfPatches = 0;
  this->NumberOfBands = 0;
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkOperator::ReleaseGraphicsResources(vtkWindow* window)
{
  if (window && window == this->Self->GetWindow())
  {
    this->Self->Clear();
  }
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Initialize(vtkExchange* exchange, int numberOfBands)
{
  this->Self->Clear();
  if (!exchange || exchange->GetNumberOfPatches() == 0)
  {
    vtkErrorMacro("The exchange is empty: fill it before Initialize().");
    return false;
  }
  const int kernels = exchange->GetNumberOfKernels();
  if (numberOfBands < 1 || numberOfBands > MaximumNumberOfBands ||
    (kernels != 1 && kernels != numberOfBands))
  {
    vtkErrorMacro(<< numberOfBands << " bands with " << kernels << " kernels: OpenGL takes 1 to "
                  << int(MaximumNumberOfBands)
                  << " bands, and one kernel or as many as bands. Set Device to CPU for more.");
    return false;
  }
  if (exchange->GetNumberOfParts() > 1)
  {
    vtkErrorMacro("OpenGL holds all links, not one of " << exchange->GetNumberOfParts()
                                                        << " parts of them: set Device to CPU in "
                                                           "parallel runs.");
    return false;
  }
  std::string reason;
  if (!this->Open(reason))
  {
    vtkErrorMacro("No OpenGL context: " << reason);
    return false;
  }
  this->NumberOfPatches = exchange->GetNumberOfPatches();
  this->NumberOfBands = numberOfBands;
  if (!this->InitializeOnDevice(exchange, reason))
  {
    vtkErrorMacro(<< reason << ": set Device to CPU.");
    this->Release();
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::InitializeOnDevice(vtkExchange* exchange, std::string& reason)
{
  Internals& self = *this->Self;
  self.Engine = std::make_unique<FloatTextures>(self.GetWindow());
  if (!self.Engine->IsAlive())
  {
    reason = "This OpenGL cannot make floating-point textures";
    return false;
  }
  const FloatTextures::Session session(self.GetWindow());
  self.Vectors = std::make_unique<FloatVectors>(*self.Engine);
  if (!self.Vectors->Initialize(this->NumberOfPatches, this->NumberOfBands,
        this->MaximumTextureSize, reason))
  {
    return false;
  }
  self.Product = ProductGL::New(exchange, *self.Engine, self.Vectors->GetLayout(), reason);
  if (self.Product && !FloatTextures::CheckErrors(reason))
  {
    reason = "OpenGL failed in taking the links with " + reason + " on " + self.DeviceName;
    return false;
  }
  return self.Product != nullptr;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::IsReady()
{
  if (!this->Self->IsAlive())
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
  if (!this->Self->Vectors->Has(slot))
  {
    vtkErrorMacro("Slot " << slot << " is read before it has been written.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Finish(bool drawn, const char* what)
{
  std::string text;
  if (!drawn)
  {
    vtkErrorMacro("OpenGL failed in " << what << ": a shader does not compile on "
                                      << this->Self->DeviceName << ". Set Device to CPU.");
    return false;
  }
  if (!FloatTextures::CheckErrors(text))
  {
    vtkErrorMacro("OpenGL failed in " << what << " with " << text << " on "
                                      << this->Self->DeviceName << ". Set Device to CPU.");
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
  const FloatTextures::Session session(this->Self->GetWindow());
  return this->Finish(this->Self->Vectors->Set(slot, values), "SetVector");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::GetVector(int slot, double* values)
{
  if (!this->IsReady(slot))
  {
    return false;
  }
  const FloatTextures::Session session(this->Self->GetWindow());
  this->Self->Vectors->Read(slot, values);
  return this->Finish(true, "GetVector");
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
  Internals& self = *this->Self;
  const FloatTextures::Session session(self.GetWindow());
  FloatVectors::Group& target = self.Vectors->Get(y);
  const bool drawn = !target.empty() && self.Product->Draw(target, self.Vectors->Get(x));
  return this->Finish(drawn, "Multiply");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Combine(int z, const double* a, int x, const double* b, int y)
{
  if (!this->IsReady(x) || !this->IsReady(y))
  {
    return false;
  }
  const FloatTextures::Session session(this->Self->GetWindow());
  return this->Finish(this->Self->Vectors->Combine(z, a, x, b, y), "Combine");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Scale(int z, int x, int y)
{
  if (!this->IsReady(x) || !this->IsReady(y))
  {
    return false;
  }
  const FloatTextures::Session session(this->Self->GetWindow());
  return this->Finish(this->Self->Vectors->Scale(z, x, y), "Scale");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::Dot(int x, int y, double* result)
{
  if (!this->IsReady(x) || !this->IsReady(y))
  {
    return false;
  }
  const FloatTextures::Session session(this->Self->GetWindow());
  return this->Finish(this->Self->Vectors->Dot(x, y, result), "Dot");
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkOperator::MaxNorm(int x, double* result)
{
  if (!this->IsReady(x))
  {
    return false;
  }
  const FloatTextures::Session session(this->Self->GetWindow());
  return this->Finish(this->Self->Vectors->MaxNorm(x, result), "MaxNorm");
}
