// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Pictures as numbers, and render passes around others, for tests of passes.
#ifndef PictureTesting_h
#define PictureTesting_h

#include "vtkDualDepthPeelingPass.h"
#include "vtkFloatArray.h"
#include "vtkImageProcessingPass.h"
#include "vtkNew.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkSSAAPass.h"
#include "vtkSequencePass.h"
#include "vtkSmartPointer.h"
#include "vtkTranslucentPass.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

namespace PictureTesting
{
/// Each red value from 0 to 1, of a part of the window's columns.
inline std::vector<double> Draw(vtkRenderWindow* window, double left = 0.0, double right = 1.0)
{
  window->Render();
  const int* size = window->GetSize();
  const int first = static_cast<int>(left * size[0]);
  const int end = static_cast<int>(right * size[0]);
  vtkNew<vtkFloatArray> pixels;
  window->GetRGBAPixelData(first, 0, end - 1, size[1] - 1, 0, pixels);
  std::vector<double> values;
  for (vtkIdType pixel = 0; pixel < pixels->GetNumberOfTuples(); ++pixel)
  {
    values.push_back(pixels->GetComponent(pixel, 0));
  }
  return values;
}

inline double Mean(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

/// Largest difference between two pictures.
inline double GetLargestDifference(const std::vector<double>& a, const std::vector<double>& b)
{
  double largest = a.size() == b.size() ? 0.0 : 1.0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
  {
    largest = std::max(largest, std::abs(a[k] - b[k]));
  }
  return largest;
}

inline vtkSmartPointer<vtkRenderPass> MakeSequence(std::initializer_list<vtkRenderPass*> passes)
{
  vtkNew<vtkRenderPassCollection> collection;
  for (vtkRenderPass* pass : passes)
  {
    collection->AddItem(pass);
  }
  auto sequence = vtkSmartPointer<vtkSequencePass>::New();
  sequence->SetPasses(collection);
  return sequence;
}

/// The usual steps, with translucent layers in their order.
inline vtkSmartPointer<vtkRenderStepsPass> MakePeelingSteps()
{
  vtkNew<vtkDualDepthPeelingPass> peeling;
  peeling->SetTranslucentPass(vtkNew<vtkTranslucentPass>());
  auto steps = vtkSmartPointer<vtkRenderStepsPass>::New();
  steps->SetTranslucentPass(peeling);
  return steps;
}

///@{ Whatever calls its delegate so.
inline void Wrap(vtkSSAAPass* outer, vtkRenderPass* inner)
{
  outer->SetDelegatePass(inner);
}
inline void Wrap(vtkImageProcessingPass* outer, vtkRenderPass* inner)
{
  outer->SetDelegatePass(inner);
}
///@}
} // namespace PictureTesting

#endif
