// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceAtlas.h"

#include "Atlas/AtlasMetrics.h"
#include "Atlas/AtlasOutput.h"
#include "Atlas/AtlasQuadtree.h"
#include "Atlas/AtlasSurface.h"
#include "Atlas/TexelMaps.h"
#include "Common/MeshingRun.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LightTransport;

vtkStandardNewMacro(vtkSurfaceAtlas);

namespace
{
using MeshingRun::Advice;
using MeshingRun::InputError;
using MeshingRun::Outcome;
using MeshingRun::Report;
using MeshingRun::Try;

constexpr int LARGEST_RESOLUTION = 16384;

//------------------------------------------------------------------------------
// Points with equal coordinates are one, unless only their being apart makes the surface a
// manifold, as where vtkPatchMesher split it.
TriangleSoup ReadSurface(vtkPolyData* input)
{
  TriangleSoup merged;
  merged.Read(input);
  if (merged.DescribeDefects().empty())
  {
    return merged;
  }
  TriangleSoup apart;
  apart.Read(input, false);
  return apart.DescribeDefects().empty() ? apart : merged;
}

//------------------------------------------------------------------------------
void CheckSurface(const TriangleSoup& soup)
{
  if (soup.Triangles.empty())
  {
    throw InputError("The surface has no area: all its polygons are degenerate or ghost cells.");
  }
  const std::string defects = soup.DescribeDefects();
  if (!defects.empty())
  {
    throw InputError("The surface has " + defects + ": pass it through vtkPatchMesher first.");
  }
}

//------------------------------------------------------------------------------
template <typename Array, typename Value>
void AddValue(vtkPolyData* output, const char* name, Value value)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->InsertNextValue(value);
  output->GetFieldData()->AddArray(array);
}

//------------------------------------------------------------------------------
void WriteMetrics(const AtlasQuadtree& quadtree, vtkPolyData* output)
{
  const AtlasMetrics metrics(output, output->GetPointData()->GetTCoords());
  AddValue<vtkDoubleArray>(output, "L2Stretch", metrics.L2Stretch);
  AddValue<vtkDoubleArray>(output, "LInfinityStretch", metrics.LInfinityStretch);
  AddValue<vtkDoubleArray>(output, "AreaDistortion", metrics.AreaDistortion);
  AddValue<vtkDoubleArray>(output, "TexelUse", metrics.TexelUse);
  int smallestBlock = quadtree.GetNodes().front().Size;
  for (const AtlasQuadtree::Chart& chart : quadtree.GetCharts())
  {
    smallestBlock = std::min(smallestBlock, quadtree.GetNodes()[chart.Node].Size);
  }
  AddValue<vtkIntArray>(output, "DeepestLeakFreeLevel", std::ilogb(smallestBlock));
  AddValue<vtkIntArray>(output, "NumberOfCharts", static_cast<int>(quadtree.GetCharts().size()));
}

} // namespace

//------------------------------------------------------------------------------
vtkSurfaceAtlas::vtkSurfaceAtlas()
{
  this->SetNumberOfOutputPorts(3);
}

//------------------------------------------------------------------------------
vtkSurfaceAtlas::~vtkSurfaceAtlas() = default;

//------------------------------------------------------------------------------
void vtkSurfaceAtlas::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "MaximumStretch: " << this->MaximumStretch << "\n";
  os << indent << "TexelMaps: " << (this->TexelMaps ? "on" : "off") << "\n";
}

//------------------------------------------------------------------------------
vtkTable* vtkSurfaceAtlas::GetCharts()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
vtkImageData* vtkSurfaceAtlas::GetMaps()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(2));
}

//------------------------------------------------------------------------------
int vtkSurfaceAtlas::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[3] = { "vtkPolyData", "vtkTable", "vtkImageData" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
int vtkSurfaceAtlas::RequestInformation(vtkInformation*, vtkInformationVector**,
  vtkInformationVector* outputs)
{
  const int side = this->TexelMaps ? this->Resolution : 0;
  const int extent[6] = { 0, side - 1, 0, side - 1, 0, side > 0 ? 0 : -1 };
  outputs->GetInformationObject(2)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent,
    6);
  return 1;
}

//------------------------------------------------------------------------------
int vtkSurfaceAtlas::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* surface = vtkPolyData::GetData(outputs, 0);
  vtkTable* charts = vtkTable::GetData(outputs, 1);
  vtkImageData* maps = vtkImageData::GetData(outputs, 2);
  if (MeshingRun::IsEmptyPiece(input, outputs->GetInformationObject(0)))
  {
    return 1;
  }
  const Advice advice = { "give a smaller Resolution, or a surface of fewer triangles",
    "The surface could not be unfolded", "pass it through vtkPatchMesher first" };
  const Outcome outcome = Try(advice,
    [&]()
    {
      this->CheckProperties();
      this->Unfold(input, surface, charts, maps);
    });
  if (!outcome.Done)
  {
    surface->Initialize();
    charts->Initialize();
    maps->Initialize();
  }
  if (outcome.Error.empty())
  {
    return 1;
  }
  vtkErrorMacro(<< outcome.Error);
  return 0;
}

//------------------------------------------------------------------------------
void vtkSurfaceAtlas::CheckProperties()
{
  const int side = this->Resolution;
  if (side < 1 || side > LARGEST_RESOLUTION || (side & (side - 1)) != 0)
  {
    throw InputError("Resolution is " + std::to_string(side) + ": give a power of two up to " +
      std::to_string(LARGEST_RESOLUTION) + ".");
  }
  if (!(this->MaximumStretch > 1.0))
  {
    throw InputError("MaximumStretch is " + std::to_string(this->MaximumStretch) +
      ": give a number above 1, the stretch of a map that keeps lengths.");
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceAtlas::Unfold(vtkPolyData* input, vtkPolyData* output, vtkTable* charts,
  vtkImageData* maps)
{
  const double start = vtkTimerLog::GetUniversalTime();
  const TriangleSoup soup = ReadSurface(input);
  CheckSurface(soup);
  Report(this, 0.05);
  const AtlasSurface surface(soup);
  const AtlasQuadtree quadtree(surface, this->Resolution, this->MaximumStretch,
    [this](double done) { Report(this, 0.05 + 0.8 * done); });

  const AtlasOutput writer(input, soup, surface, quadtree);
  writer.WriteSurface(output);
  writer.WriteTable(charts);
  Report(this, 0.9);
  AddValue<vtkIntArray>(output, GetResolutionArrayName(), this->Resolution);
  WriteMetrics(quadtree, output);
  const double unfolded = vtkTimerLog::GetUniversalTime();
  if (this->TexelMaps)
  {
    TexelMaps::Make(output, this->Resolution, maps);
  }
  AddValue<vtkDoubleArray>(output, "AtlasSeconds", unfolded - start);
  AddValue<vtkDoubleArray>(output, "TexelMapSeconds", vtkTimerLog::GetUniversalTime() - unfolded);
  this->UpdateProgress(1.0);
}
