// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The product y = G x on the GPU: what the forms of links differ in. The tables of an exchange are
 * put into textures once and stay there. All calls within a vtkFloatTextures::Session.
 */
#ifndef vtkProductGL_h
#define vtkProductGL_h

#include "vtkFloatTextures.h"
#include "vtkFloatVectors.h"

#include <memory>
#include <string>

class vtkExchange;

class vtkProductGL
{
public:
  using Group = vtkFloatTextures::Group;
  using Layout = vtkFloatVectors::Layout;

  virtual ~vtkProductGL();
  vtkProductGL(const vtkProductGL&) = delete;
  void operator=(const vtkProductGL&) = delete;

  /// The product with this exchange, its tables uploaded. When null, `reason` is what is wrong,
  /// without a full stop.
  static std::unique_ptr<vtkProductGL> New(vtkExchange* exchange, vtkFloatTextures& engine,
    const Layout& layout, std::string& reason);

  /// target = G source. May exchange the textures of the target for others. False when a shader
  /// does not compile.
  virtual bool Draw(Group& target, const Group& source) = 0;

  /// Textures that hold the links.
  virtual int GetNumberOfLinkTextures() const = 0;

protected:
  vtkProductGL(vtkFloatTextures& engine, const Layout& layout);

  /// True where `bytes` for the links of all patches are there, else with the reason.
  bool CheckMemory(double bytes, std::string& reason) const;
  std::string DescribeMemory() const;

  vtkFloatTextures& Engine;
  const Layout Vectors;
};

#endif
