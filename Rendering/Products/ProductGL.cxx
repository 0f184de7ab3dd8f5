// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Products/ProductGL.h"

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
std::unique_ptr<ProductGL> Make(Exchange* exchange, FloatTextures& engine,
  const ProductGL::Layout& layout, std::string& reason)
{
  auto product = std::make_unique<Product>(engine, layout);
  if (!product->Initialize(exchange, reason))
  {
    return nullptr;
  }
  return product;
}
} // namespace

//------------------------------------------------------------------------------
ProductGL::ProductGL(FloatTextures& engine, const Layout& layout) : Engine(engine), Vectors(layout)
{
}

//------------------------------------------------------------------------------
ProductGL::~ProductGL() = default;

//------------------------------------------------------------------------------
std::unique_ptr<ProductGL> ProductGL::New(vtkExchange* exchange, FloatTextures& engine,
  const Layout& layout, std::string& reason)
{
  if (auto* matrix = vtkExchangeMatrix::SafeDownCast(exchange))
  {
    return Make<DenseProductGL>(matrix, engine, layout, reason);
  }
  if (auto* hierarchy = vtkExchangeHierarchy::SafeDownCast(exchange))
  {
    return Make<HierarchicalProductGL>(hierarchy, engine, layout, reason);
  }
  reason = std::string("OpenGL does not apply a ") + exchange->GetClassName();
  return nullptr;
}

//------------------------------------------------------------------------------
std::string ProductGL::DescribeMemory() const
{
  return "The links of " + std::to_string(this->Vectors.Patches) +
    " patches do not fit into the memory of " + this->Engine.GetDeviceName();
}

//------------------------------------------------------------------------------
bool ProductGL::CheckMemory(double bytes, std::string& reason) const
{
  const double available = this->Engine.GetAvailableBytes();
  if (available >= 0.0 && bytes > available)
  {
    reason = this->DescribeMemory();
    return false;
  }
  return true;
}
} // namespace LightTransport
