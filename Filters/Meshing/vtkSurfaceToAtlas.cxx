// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceToAtlas.h"

#include "Atlas/TexelMaps.h"
#include "Atlas/TexelPieces.h"
#include "Common/MeshingRun.h"
#include "Shared/ArrayNames.h"
#include "Shared/FilterMonitor.h"
#include "Shared/InputArrays.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkSurfaceToAtlas);

namespace
{
//------------------------------------------------------------------------------
// 0 when neither the property nor the surface says it.
int ChooseResolution(int wanted, vtkPolyData* surface)
{
  if (wanted != 0 || !surface)
  {
    return wanted;
  }
  vtkDataArray* made = surface->GetFieldData()->GetArray(ArrayNames::AtlasResolution);
  const double value = made && made->GetNumberOfValues() == 1 ? made->GetComponent(0, 0) : 0.0;
  return std::abs(value) <= std::numeric_limits<int>::max() ? static_cast<int>(value) : 0;
}

//------------------------------------------------------------------------------
Outcome CheckResolution(int resolution)
{
  return resolution != 0
    ? Outcome::Done()
    : Outcome::Failed("The surface has no field data array \"AtlasResolution\" that says how many "
                      "texels a side its atlas is made for: set Resolution.");
}

//------------------------------------------------------------------------------
// Whether a mean of the array's values says anything.
bool HasMeans(vtkDataSetAttributes* data, int index)
{
  static const std::set<std::string> skipped = { ArrayNames::AtlasCoordinates,
    ArrayNames::OriginalCellIds, ArrayNames::OriginalPointIds,
    vtkDataSetAttributes::GhostArrayName() };
  vtkDataArray* array = data->GetArray(index);
  if (!array || !array->GetName())
  {
    return false;
  }
  const int attribute = data->IsArrayAnAttribute(index);
  return (attribute < 0 || attribute == vtkDataSetAttributes::SCALARS ||
           attribute == vtkDataSetAttributes::VECTORS ||
           attribute == vtkDataSetAttributes::TENSORS) &&
    !TexelMaps::IsTexelMap(array->GetName()) && skipped.count(array->GetName()) == 0;
}

//------------------------------------------------------------------------------
std::vector<TexelMaps::Source> GetSources(vtkPolyData* surface)
{
  std::vector<TexelMaps::Source> sources;
  std::set<std::string> names;
  const auto add = [&](vtkDataSetAttributes* data, bool ofPoints)
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      if (HasMeans(data, i) && names.insert(data->GetArray(i)->GetName()).second)
      {
        sources.push_back({ data->GetArray(i), ofPoints });
      }
    }
  };
  add(surface->GetCellData(), false);
  add(surface->GetPointData(), true);
  return sources;
}
} // namespace

//------------------------------------------------------------------------------
vtkSurfaceToAtlas::vtkSurfaceToAtlas() = default;

//------------------------------------------------------------------------------
vtkSurfaceToAtlas::~vtkSurfaceToAtlas() = default;

//------------------------------------------------------------------------------
void vtkSurfaceToAtlas::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
}

//------------------------------------------------------------------------------
int vtkSurfaceToAtlas::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkSurfaceToAtlas::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  if (this->Resolution == 0)
  {
    // Filters of images need to know the extent before anything is computed.
    int port;
    vtkAlgorithm* producer = this->GetInputAlgorithm(0, 0, port);
    producer->Update(port);
  }
  const int resolution = ChooseResolution(this->Resolution, vtkPolyData::GetData(inputs[0]));
  const double spacing = resolution > 0 ? 1.0 / resolution : 1.0;
  vtkInformation* info = outputs->GetInformationObject(0);
  const int side = std::clamp(resolution, 0, TexelPieces::MaximumResolution);
  const int extent[6] = { 0, side - 1, 0, side - 1, 0, 0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::SPACING(), spacing, spacing, spacing);
  info->Set(vtkDataObject::ORIGIN(), 0.5 * spacing, 0.5 * spacing, 0.0);
  return 1;
}

//------------------------------------------------------------------------------
int vtkSurfaceToAtlas::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  vtkPolyData* surface = vtkPolyData::GetData(inputs[0]);
  vtkImageData* maps = vtkImageData::GetData(outputs);
  const int resolution = ChooseResolution(this->Resolution, surface);
  const Monitor monitor = MakeFilterMonitor(this);
  const MeshingRun::Advice advice = { "set a smaller Resolution",
    "The texel maps could not be made", "make the atlas again with vtkSurfaceAtlas" };
  MeshingRun::Steps steps(advice);
  steps.Take([&]() { return CheckResolution(resolution); });
  steps.Take([&]() { return InputArrays::CheckLengths(surface); });
  steps.Take([&]() { return TexelPieces::Check(surface, resolution, monitor); });
  steps.Take([&]() { return monitor.Check(0.1); });
  steps.Take(
    [&]()
    {
      return TexelMaps::Make(surface, resolution, maps, monitor.GetStage(0.1, 1.0),
        GetSources(surface));
    });
  steps.Take([&]() { return monitor.Check(1.0); });
  const Outcome& outcome = steps.GetOutcome();
  if (!outcome)
  {
    maps->Initialize();
  }
  if (outcome.HasFailed())
  {
    vtkErrorMacro(<< outcome.GetMessage());
    return 0;
  }
  return 1;
}
