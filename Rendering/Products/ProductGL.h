// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The product y = G x on the GPU: what the forms of links differ in. The tables of an exchange are
 * put into textures once and stay there. All calls within a DeviceSession.
 */
#ifndef ProductGL_h
#define ProductGL_h

#include "Textures/FloatTextures.h"
#include "Textures/FloatVectors.h"

#include <functional>
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

  /// Called between pieces of an upload: others may use the context then.
  using Pause = std::function<void()>;

  virtual ~ProductGL();
  ProductGL(const ProductGL&) = delete;
  void operator=(const ProductGL&) = delete;

  /// The product with this exchange, its tables uploaded. The message of a failure has no full
  /// stop. A new form of links gets its line here.
  static Outcome Make(std::unique_ptr<ProductGL>& product, vtkExchange* exchange,
    FloatTextures& engine, const Layout& layout, const Pause& pause);

  /// target = G source. May exchange the textures of the target for others.
  virtual Outcome Draw(Group& target, const Group& source) = 0;

  /// Textures that hold the links.
  virtual int GetNumberOfLinkTextures() const = 0;

  /// Bytes that they take.
  double GetNumberOfLinkBytes() const { return this->LinkBytes; }

protected:
  ProductGL(FloatTextures& engine, const Layout& layout);

  /// Links will take `bytes`. A failure where the device has less.
  Outcome CheckMemory(double bytes);
  Outcome RefuseMemory() const;

  FloatTextures& Engine;
  const Layout Vectors;

private:
  double LinkBytes = 0.0;
};
} // namespace LightTransport

#endif
