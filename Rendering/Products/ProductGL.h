// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The product y = G x on the GPU: what the forms of links differ in. The tables of an exchange are
 * put into textures once and stay there. All calls within a FloatTextures::Session.
 */
#ifndef ProductGL_h
#define ProductGL_h

#include "Textures/FloatTextures.h"
#include "Textures/FloatVectors.h"

#include <memory>
#include <string>

class vtkExchange;

namespace LightTransport
{
class ProductGL
{
public:
  using Group = FloatTextures::Group;
  using Layout = FloatVectors::Layout;

  virtual ~ProductGL();
  ProductGL(const ProductGL&) = delete;
  void operator=(const ProductGL&) = delete;

  /// The product with this exchange, its tables uploaded. When null, `reason` is what is wrong,
  /// without a full stop.
  static std::unique_ptr<ProductGL> New(vtkExchange* exchange, FloatTextures& engine,
    const Layout& layout, std::string& reason);

  /// target = G source. May exchange the textures of the target for others. False when a shader
  /// does not compile.
  virtual bool Draw(Group& target, const Group& source) = 0;

  /// Textures that hold the links.
  virtual int GetNumberOfLinkTextures() const = 0;

protected:
  ProductGL(FloatTextures& engine, const Layout& layout);

  /// True where `bytes` for the links of all patches are there, else with the reason.
  bool CheckMemory(double bytes, std::string& reason) const;
  std::string DescribeMemory() const;

  FloatTextures& Engine;
  const Layout Vectors;
};
} // namespace LightTransport

#endif
