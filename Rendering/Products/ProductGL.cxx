// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Products/ProductGL.h"

#include "Device/DeviceMemory.h"
#include "Products/DenseProductGL.h"
#include "Products/HierarchicalProductGL.h"

#include "vtkExchangeHierarchy.h"
#include "vtkExchangeMatrix.h"

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
template <typename Product, typename Exchange>
Outcome MakeProduct(std::unique_ptr<ProductGL>& product, Exchange* exchange, FloatTextures& engine,
  const ProductGL::Layout& layout, const ProductGL::Pause& pause)
{
  auto made = std::make_unique<Product>(engine, layout);
  Outcome initialized = made->Initialize(exchange, pause);
  if (initialized)
  {
    product = std::move(made);
  }
  return initialized;
}
} // namespace

//------------------------------------------------------------------------------
ProductGL::ProductGL(FloatTextures& engine, const Layout& layout) : Engine(engine), Vectors(layout)
{
}

//------------------------------------------------------------------------------
ProductGL::~ProductGL() = default;

//------------------------------------------------------------------------------
Outcome ProductGL::Make(std::unique_ptr<ProductGL>& product, vtkExchange* exchange,
  FloatTextures& engine, const Layout& layout, const Pause& pause)
{
  if (auto* matrix = vtkExchangeMatrix::SafeDownCast(exchange))
  {
    return MakeProduct<DenseProductGL>(product, matrix, engine, layout, pause);
  }
  if (auto* hierarchy = vtkExchangeHierarchy::SafeDownCast(exchange))
  {
    return MakeProduct<HierarchicalProductGL>(product, hierarchy, engine, layout, pause);
  }
  return Outcome::Failed(std::string("OpenGL does not apply a ") + exchange->GetClassName());
}

//------------------------------------------------------------------------------
Outcome ProductGL::RefuseMemory() const
{
  return Outcome::Failed("The links of " + std::to_string(this->Vectors.Patches) +
    " patches do not fit into the memory of " + this->Engine.GetDeviceName());
}

//------------------------------------------------------------------------------
Outcome ProductGL::CheckMemory(double bytes)
{
  this->LinkBytes = bytes;
  const double available = GetAvailableDeviceBytes(this->Engine.GetWindow());
  return available >= 0.0 && bytes > available ? this->RefuseMemory() : Outcome::Done();
}
} // namespace LightTransport
