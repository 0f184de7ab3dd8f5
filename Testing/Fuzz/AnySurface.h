// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Surfaces as people's disks hold them, and worse, with arrays that fit or do not.
#ifndef AnySurface_h
#define AnySurface_h

#include "vtkSmartPointer.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataObject;

namespace LightTransportFuzz
{
class Choices;

/// Of any type and number of components, mostly with as many tuples, and values that are usual for
/// the name, or extreme.
vtkSmartPointer<vtkAbstractArray> MakeArray(Choices& choices, const std::string& name,
  vtkIdType tuples);

/// What a filter refuses surfaces without.
struct Needs
{
  bool IsClosed = false;
  std::vector<const char*> Arrays; ///< of cells

  bool AreSome() const { return this->IsClosed || !this->Arrays.empty(); }
};

/// A vtkPolyData, or (where `composite`, now and then) a vtkMultiBlockDataSet of up to three. Calm
/// choices give it what is needed.
vtkSmartPointer<vtkDataObject> MakeAnyInput(Choices& choices, bool composite, const Needs& needs);
} // namespace LightTransportFuzz

#endif
