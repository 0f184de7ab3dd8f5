// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceAtlas.h"

#include "Atlas/AtlasMetrics.h"
#include "Atlas/AtlasOutput.h"
#include "Atlas/AtlasQuadtree.h"
#include "Atlas/AtlasSurface.h"
#include "Atlas/TexelMaps.h"
#include "Common/MeshingRun.h"
#include "Common/TriangleSoup.h"
#include "Common/Watch.h"
#include "Shared/ArrayNames.h"
#include "Shared/FieldValues.h"
#include "Shared/FilterMonitor.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

using namespace LightTransport;

vtkStandardNewMacro(vtkSurfaceAtlas);

namespace
{
constexpr int LargestResolution = 16384;

//------------------------------------------------------------------------------
Outcome DescribeDefects(const TriangleSoup& soup, const Monitor& monitor, std::string& defects)
{
  return Watch::Run(monitor,
    [&](Watch&)
    {
      defects = soup.DescribeDefects();
      return Outcome::Done();
    });
}

//------------------------------------------------------------------------------
// Points with equal coordinates are one, unless only their being apart makes the surface a
// manifold, as where vtkPatchMesher split it.
Outcome ReadSurface(vtkPolyData* input, const Monitor& monitor, TriangleSoup& soup)
{
  std::string defects;
  for (const bool mergesPoints : { true, false })
  {
    TriangleSoup candidate;
    Outcome read = candidate.Read(input, mergesPoints);
    std::string defectsOfCandidate;
    read = read ? monitor.Check(0.0) : read;
    read = read ? DescribeDefects(candidate, monitor, defectsOfCandidate) : read;
    if (!read)
    {
      return read;
    }
    if (mergesPoints || defectsOfCandidate.empty())
    {
      soup = std::move(candidate);
      defects = defectsOfCandidate;
    }
    if (defects.empty())
    {
      break;
    }
  }
  if (soup.Triangles.empty())
  {
    return Outcome::Failed(
      "The surface has no area: all its polygons are degenerate or ghost cells.");
  }
  return defects.empty()
    ? Outcome::Done()
    : Outcome::Failed("The surface has " + defects + ": pass it through vtkPatchMesher first.");
}

//------------------------------------------------------------------------------
void WriteMetrics(const AtlasQuadtree& quadtree, const Monitor& monitor, vtkPolyData* output)
{
  const AtlasMetrics metrics(output, output->GetPointData()->GetTCoords(), monitor);
  vtkFieldData* fields = output->GetFieldData();
  FieldValues::Add(fields, "L2Stretch", metrics.L2Stretch);
  FieldValues::Add(fields, "LInfinityStretch", metrics.LInfinityStretch);
  FieldValues::Add(fields, "AreaDistortion", metrics.AreaDistortion);
  FieldValues::Add(fields, "TexelUse", metrics.TexelUse);
  int smallestBlock = quadtree.GetNodes().front().Size;
  for (const AtlasQuadtree::Chart& chart : quadtree.GetCharts())
  {
    smallestBlock = std::min(smallestBlock, quadtree.GetNodes()[chart.Node].Size);
  }
  FieldValues::AddAs<vtkIntArray>(fields, "DeepestLeakFreeLevel", { std::ilogb(smallestBlock) });
  FieldValues::AddAs<vtkIntArray>(fields, "NumberOfCharts",
    { static_cast<int>(quadtree.GetCharts().size()) });
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
const char* vtkSurfaceAtlas::GetCoordinatesArrayName()
{
  return ArrayNames::AtlasCoordinates;
}

//------------------------------------------------------------------------------
const char* vtkSurfaceAtlas::GetChartArrayName()
{
  return ArrayNames::ChartId;
}

//------------------------------------------------------------------------------
const char* vtkSurfaceAtlas::GetResolutionArrayName()
{
  return ArrayNames::AtlasResolution;
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
  const int side = this->TexelMaps ? std::clamp(this->Resolution, 0, LargestResolution) : 0;
  const int extent[6] = { 0, side - 1, 0, side - 1, 0, side > 0 ? 0 : -1 };
  outputs->GetInformationObject(2)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent,
    6);
  return 1;
}

//------------------------------------------------------------------------------
// What one run of the filter hands from step to step.
struct vtkSurfaceAtlas::Job
{
  vtkPolyData* Input;
  vtkPolyData* Output;
  vtkTable* Charts;
  vtkImageData* Maps;
  Monitor Watcher;
  double Start = vtkTimerLog::GetUniversalTime();
  TriangleSoup Soup;
  AtlasSurface Surface;
  std::unique_ptr<AtlasQuadtree> Quadtree;
};

//------------------------------------------------------------------------------
int vtkSurfaceAtlas::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  Job job;
  job.Input = vtkPolyData::GetData(inputs[0]);
  job.Output = vtkPolyData::GetData(outputs, 0);
  job.Charts = vtkTable::GetData(outputs, 1);
  job.Maps = vtkImageData::GetData(outputs, 2);
  job.Watcher = MakeFilterMonitor(this);
  if (MeshingRun::IsEmptyPiece(job.Input, outputs->GetInformationObject(0)))
  {
    return 1;
  }
  const MeshingRun::Advice advice = { "give a smaller Resolution, or a surface of fewer triangles",
    "The surface could not be unfolded", "pass it through vtkPatchMesher first" };
  MeshingRun::Steps steps(advice);
  steps.Take([&]() { return this->CheckProperties(); });
  steps.Take(
    [&]() { return ReadSurface(job.Input, job.Watcher.GetStage(0.02, 0.05), job.Soup); });
  steps.Take([&]() { return this->Unfold(job); });
  steps.Take([&]() { return this->Write(job); });
  const Outcome& outcome = steps.GetOutcome();
  if (!outcome)
  {
    job.Output->Initialize();
    job.Charts->Initialize();
    job.Maps->Initialize();
  }
  if (outcome.HasFailed())
  {
    vtkErrorMacro(<< outcome.GetMessage());
    return 0;
  }
  return 1;
}

//------------------------------------------------------------------------------
Outcome vtkSurfaceAtlas::CheckProperties() const
{
  const int side = this->Resolution;
  if (side < 1 || side > LargestResolution || (side & (side - 1)) != 0)
  {
    return Outcome::Failed("Resolution is " + std::to_string(side) +
      ": give a power of two up to " + std::to_string(LargestResolution) + ".");
  }
  if (!(this->MaximumStretch > 1.0))
  {
    return Outcome::Failed("MaximumStretch is " + std::to_string(this->MaximumStretch) +
      ": give a number above 1, the stretch of a map that keeps lengths.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkSurfaceAtlas::Unfold(Job& job) const
{
  return Watch::Run(job.Watcher.GetStage(0.05, 0.85),
    [&](Watch& watch)
    {
      watch.Report(0.0);
      if (Outcome built = job.Surface.Build(job.Soup, watch); !built)
      {
        return built;
      }
      job.Quadtree =
        std::make_unique<AtlasQuadtree>(job.Surface, this->Resolution, this->MaximumStretch);
      return job.Quadtree->Build(watch);
    });
}

//------------------------------------------------------------------------------
Outcome vtkSurfaceAtlas::Write(const Job& job) const
{
  const AtlasOutput writer(job.Input, job.Soup, job.Surface, *job.Quadtree);
  writer.WriteSurface(job.Output, job.Watcher.GetStage(0.85, 0.9));
  writer.WriteTable(job.Charts);
  if (!job.Watcher.Report(0.9))
  {
    return Outcome::Aborted();
  }
  vtkFieldData* fields = job.Output->GetFieldData();
  FieldValues::AddAs<vtkIntArray>(fields, ArrayNames::AtlasResolution, { this->Resolution });
  WriteMetrics(*job.Quadtree, job.Watcher.GetStage(0.9, 0.91), job.Output);
  const double unfolded = vtkTimerLog::GetUniversalTime();
  if (this->TexelMaps)
  {
    if (Outcome made = TexelMaps::Make(job.Output, this->Resolution, job.Maps,
          job.Watcher.GetStage(0.91, 1.0));
        !made)
    {
      return made;
    }
  }
  FieldValues::Add(fields, "AtlasSeconds", unfolded - job.Start);
  FieldValues::Add(fields, "TexelMapSeconds", vtkTimerLog::GetUniversalTime() - unfolded);
  return job.Watcher.Check(1.0);
}
