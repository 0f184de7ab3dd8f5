// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAtlasToSurface.h"

#include "Atlas/TexelMaps.h"
#include "Atlas/TexelPieces.h"
#include "Common/MeshingRun.h"
#include "Shared/FilterMonitor.h"
#include "Shared/InputArrays.h"
#include "Shared/TransportMemory.h"
#include "Shared/ZeroedArray.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkAtlasToSurface);

namespace
{
//------------------------------------------------------------------------------
Outcome FindResolution(vtkImageData* image, int& resolution)
{
  std::array<int, 3> size;
  image->GetDimensions(size.data());
  if (image->GetNumberOfPoints() == 0)
  {
    return Outcome::Failed("The image has no points: give it one point per texel.");
  }
  if (size[0] != size[1] || size[2] != 1)
  {
    return Outcome::Failed("The image has " + std::to_string(size[0]) + " x " +
      std::to_string(size[1]) + " x " + std::to_string(size[2]) +
      " points: it must be square and have one layer, with one point per texel of the atlas.");
  }
  resolution = size[0];
  return Outcome::Done();
}

// Weighted means of the texels of one array.
class Means
{
public:
  Means(vtkDataArray* texels, vtkDataSetAttributes* data, vtkIdType size)
    : Texels(texels), Components(texels->GetNumberOfComponents())
  {
    this->Array->SetName(texels->GetName());
    this->Array->SetNumberOfComponents(this->Components);
    this->Array->CopyComponentNames(texels);
    ZeroedArray::Fill(this->Array, size);
    data->AddArray(this->Array);
  }

  // `share` is the part that the texel has in all that is known of the mean. Moving the mean by
  // that part of the difference leaves a constant exactly as it is.
  void Add(vtkIdType id, vtkIdType texel, double share)
  {
    double* mean = this->Array->GetPointer(id * this->Components);
    for (int i = 0; i < this->Components; ++i)
    {
      mean[i] += share * (this->Texels->GetComponent(texel, i) - mean[i]);
    }
  }

private:
  vtkDataArray* Texels;
  int Components;
  vtkSmartPointer<vtkDoubleArray> Array = vtkSmartPointer<vtkDoubleArray>::New();
};

//------------------------------------------------------------------------------
std::vector<vtkDataArray*> GetArrays(vtkImageData* image)
{
  std::vector<vtkDataArray*> arrays;
  for (int i = 0; i < image->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(i);
    if (array && array->GetName() && !TexelMaps::IsTexelMap(array->GetName()) &&
      std::strcmp(array->GetName(), vtkDataSetAttributes::GhostArrayName()) != 0)
    {
      arrays.push_back(array);
    }
  }
  return arrays;
}

//------------------------------------------------------------------------------
Outcome Transfer(vtkImageData* image, int resolution, vtkPolyData* surface, vtkPolyData* output,
  const Monitor& monitor)
{
  TransportMemory::RequireMargin();
  output->ShallowCopy(surface);
  std::vector<Means> ofCells;
  std::vector<Means> ofPoints;
  for (vtkDataArray* array : GetArrays(image))
  {
    ofCells.emplace_back(array, output->GetCellData(), output->GetNumberOfCells());
    ofPoints.emplace_back(array, output->GetPointData(), output->GetNumberOfPoints());
  }
  std::vector<double> weightOfPoint(surface->GetNumberOfPoints(), 0.0);
  vtkIdType cell = -1;
  double area = 0.0;
  TexelPieces::Visit(
    surface, resolution,
    [&](const TexelPieces::Piece& piece)
    {
      area = piece.Cell == cell ? area + piece.Area : piece.Area;
      cell = piece.Cell;
      for (Means& means : ofCells)
      {
        means.Add(cell, piece.Texel, piece.Area / area);
      }
      vtkIdType size;
      const vtkIdType* corners;
      surface->GetPolys()->GetCellAtId(cell, size, corners);
      for (int i = 0; i < 3; ++i)
      {
        // Never nothing, so that a point among triangles without area has a value, too.
        const double weight =
          std::max(piece.Weights[i] * piece.Area, std::numeric_limits<double>::min());
        weightOfPoint[corners[i]] += weight;
        for (Means& means : ofPoints)
        {
          means.Add(corners[i], piece.Texel, weight / weightOfPoint[corners[i]]);
        }
      }
    },
    monitor);
  return Outcome::Done();
}
} // namespace

//------------------------------------------------------------------------------
vtkAtlasToSurface::vtkAtlasToSurface()
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkAtlasToSurface::~vtkAtlasToSurface() = default;

//------------------------------------------------------------------------------
void vtkAtlasToSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
int vtkAtlasToSurface::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPolyData" : "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkAtlasToSurface::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector*)
{
  // A piece of the surface may have its texels anywhere in the image.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* image = inputs[1]->GetInformationObject(0);
  if (image->Has(Pipeline::WHOLE_EXTENT()))
  {
    image->Set(Pipeline::UPDATE_EXTENT(), image->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkAtlasToSurface::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  vtkPolyData* surface = vtkPolyData::GetData(inputs[0]);
  vtkImageData* image = vtkImageData::GetData(inputs[1]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  const Monitor monitor = MakeFilterMonitor(this);
  const MeshingRun::Advice advice = { "give an image with fewer arrays",
    "The texels could not be brought to the surface", "make the atlas again with vtkSurfaceAtlas" };
  int resolution = 0;
  MeshingRun::Steps steps(advice);
  steps.Take([&]() { return InputArrays::CheckLengths(surface); });
  steps.Take([&]() { return InputArrays::CheckLengths(image); });
  steps.Take([&]() { return FindResolution(image, resolution); });
  steps.Take([&]() { return TexelPieces::Check(surface, resolution, monitor); });
  steps.Take([&]() { return monitor.Check(0.1); });
  steps.Take(
    [&]() { return Transfer(image, resolution, surface, output, monitor.GetStage(0.1, 1.0)); });
  steps.Take([&]() { return monitor.Check(1.0); });
  const Outcome& outcome = steps.GetOutcome();
  if (!outcome)
  {
    output->Initialize();
  }
  if (outcome.HasFailed())
  {
    vtkErrorMacro(<< outcome.GetMessage());
    return 0;
  }
  return 1;
}
