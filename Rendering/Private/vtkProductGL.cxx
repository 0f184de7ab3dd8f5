// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkProductGL.h"

#include "vtkDenseProductGL.h"
#include "vtkHierarchicalProductGL.h"

#include "vtkExchangeHierarchy.h"
#include "vtkExchangeMatrix.h"

namespace
{
//------------------------------------------------------------------------------
template <typename Product, typename Exchange>
std::unique_ptr<vtkProductGL> Make(Exchange* exchange, vtkFloatTextures& engine,
  const vtkProductGL::Layout& layout, std::string& reason)
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
vtkProductGL::vtkProductGL(vtkFloatTextures& engine, const Layout& layout)
  : Engine(engine), Vectors(layout)
{
}

//------------------------------------------------------------------------------
vtkProductGL::~vtkProductGL() = default;

//------------------------------------------------------------------------------
std::unique_ptr<vtkProductGL> vtkProductGL::New(vtkExchange* exchange, vtkFloatTextures& engine,
  const Layout& layout, std::string& reason)
{
  if (auto* matrix = vtkExchangeMatrix::SafeDownCast(exchange))
  {
    return Make<vtkDenseProductGL>(matrix, engine, layout, reason);
  }
  if (auto* hierarchy = vtkExchangeHierarchy::SafeDownCast(exchange))
  {
    return Make<vtkHierarchicalProductGL>(hierarchy, engine, layout, reason);
  }
  reason = std::string("OpenGL does not apply a ") + exchange->GetClassName();
  return nullptr;
}

//------------------------------------------------------------------------------
std::string vtkProductGL::DescribeMemory() const
{
  return "The links of " + std::to_string(this->Vectors.Patches) +
    " patches do not fit into the memory of " + this->Engine.GetDeviceName();
}

//------------------------------------------------------------------------------
bool vtkProductGL::CheckMemory(double bytes, std::string& reason) const
{
  const double available = this->Engine.GetAvailableBytes();
  if (available >= 0.0 && bytes > available)
  {
    reason = this->DescribeMemory();
    return false;
  }
  return true;
}
