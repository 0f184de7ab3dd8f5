// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceTransfer.h"

#include "Geometry/SceneRayCaster.h"
#include "Lighting/LightSource.h"
#include "Run/TransportRun.h"
#include "Scene/SceneOutput.h"
#include "Scene/SmoothPoints.h"
#include "Shared/ArrayNames.h"
#include "Shared/Attempt.h"
#include "Shared/EnvironmentPicture.h"
#include "Shared/FieldValues.h"
#include "Shared/SphericalHarmonics.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <array>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkRadianceTransfer);

namespace
{
// The integrals as a fraction of the progress.
constexpr double TransferDone = 0.97;
constexpr int MostHarmonics =
  (vtkRadianceTransfer::LargestDegree + 1) * (vtkRadianceTransfer::LargestDegree + 1);
} // namespace

//------------------------------------------------------------------------------
class vtkRadianceTransfer::Run : public TransportRun
{
public:
  Run(vtkRadianceTransfer* owner, const RunPorts& ports)
    : TransportRun(ports), Owner(owner), StartTime(vtkTimerLog::GetUniversalTime()),
      Count(SphericalHarmonics::GetCount(owner->Degree)),
      Kernel(SphericalHarmonics::GetCosineKernel(owner->Degree, owner->RefractiveIndex))
  {
    this->NumberOfSides = owner->TwoSided ? 2 : 1;
  }

protected:
  Outcome Check() override;
  Outcome Read() override { return Outcome::Done(); }
  Outcome Compute() override;
  void Write() override;

private:
  void ComputePatch(vtkIdType patch);

  vtkRadianceTransfer* Owner;
  double StartTime;
  std::size_t Count;          ///< of harmonics
  std::vector<double> Kernel; ///< of each degree
  SceneRayCaster Caster;
  std::vector<double> Transfer; ///< patches x harmonics
  std::vector<double> Rays;     ///< of each patch
};

//------------------------------------------------------------------------------
Outcome vtkRadianceTransfer::Run::Check()
{
  return TransportRun::CheckRefractiveIndex(this->Owner->RefractiveIndex);
}

//------------------------------------------------------------------------------
// Each rank computes its own patches.
Outcome vtkRadianceTransfer::Run::Compute()
{
  const Outcome built = this->Owner->Shadows ? this->Caster.Build(this->Scene) : Outcome::Done();
  if (Outcome agreed = this->AllRanks.Agree(built); !agreed)
  {
    return agreed;
  }
  const std::size_t patches = this->Scene.GetAreas().size();
  this->Transfer.assign(patches * this->Count, 0.0);
  this->Rays.assign(patches, 0.0);
  if (Outcome computed = this->ForLocalPatches(this->Owner->Samples, TransferDone,
        [this](vtkIdType patch) { this->ComputePatch(patch); });
      !computed)
  {
    return computed;
  }
  this->AllRanks.Sum(this->Transfer);
  this->AllRanks.Sum(this->Rays);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// The whole hemisphere has a closed form; rays take away from it what is hidden.
void vtkRadianceTransfer::Run::ComputePatch(vtkIdType patch)
{
  const LitPatch lit(this->Scene, this->Owner->Shadows ? &this->Caster : nullptr,
    this->Owner->RefractiveIndex, patch);
  double* transfer = &this->Transfer[static_cast<std::size_t>(patch) * this->Count];
  std::array<double, MostHarmonics> harmonics;
  SphericalHarmonics::Evaluate(this->Owner->Degree, lit.GetNormal().data(), harmonics.data());
  for (std::size_t degree = 0; degree < this->Kernel.size(); ++degree)
  {
    for (std::size_t k = degree * degree; k < (degree + 1) * (degree + 1); ++k)
    {
      transfer[k] = this->Kernel[degree] * harmonics[k];
    }
  }
  if (!lit.HasBlockers())
  {
    return;
  }
  const int samples = this->Owner->Samples;
  for (int sample = 0; sample < samples; ++sample)
  {
    // Even in projected solid angle.
    const LitPatch::Vector direction = lit.GetDirection(sample);
    const LitPatch::Vector point = lit.GetPoint(sample);
    if (lit.IsBlocked(point, point + LightSource::OutOfScene * direction))
    {
      const double weight =
        vtkMath::Pi() / samples * lit.GetTransmittance(direction.dot(lit.GetNormal()));
      SphericalHarmonics::Evaluate(this->Owner->Degree, direction.data(), harmonics.data());
      for (std::size_t k = 0; k < this->Count; ++k)
      {
        transfer[k] -= weight * harmonics[k];
      }
    }
  }
  this->Rays[patch] = samples;
}

//------------------------------------------------------------------------------
void vtkRadianceTransfer::Run::Write()
{
  const SmoothPoints points(this->Scene, this->Owner->FeatureAngle);
  const SceneOutput output(this->Scene, &points, this->Input, this->Output);
  output.AddArray(ArrayNames::RadianceTransfer, this->Transfer, static_cast<int>(this->Count));
  double rays = 0.0;
  for (const double some : this->Rays)
  {
    rays += some;
  }
  vtkFieldData* fields = this->GetOutputFields();
  FieldValues::Add(fields, ArrayNames::RefractiveIndex, this->Owner->RefractiveIndex);
  FieldValues::Add(fields, "RadianceTransferRays", rays);
  FieldValues::Add(fields, "RadianceTransferSeconds",
    vtkTimerLog::GetUniversalTime() - this->StartTime);
}

//------------------------------------------------------------------------------
vtkRadianceTransfer::vtkRadianceTransfer() = default;

//------------------------------------------------------------------------------
vtkRadianceTransfer::~vtkRadianceTransfer() = default;

//------------------------------------------------------------------------------
std::unique_ptr<TransportRun> vtkRadianceTransfer::MakeRun(const RunPorts& ports)
{
  return std::make_unique<Run>(this, ports);
}

//------------------------------------------------------------------------------
bool vtkRadianceTransfer::ProjectEnvironment(vtkImageData* environment,
  vtkDoubleArray* coefficients)
{
  if (!environment || !coefficients)
  {
    vtkErrorMacro("There is no environment, or no array for its coefficients: give both.");
    return false;
  }
  const Outcome projected = Attempt(
    [&]()
    {
      EnvironmentPicture picture;
      Outcome read = picture.Read(environment);
      if (read)
      {
        const std::vector<double> values = picture.Project(this->Degree);
        coefficients->SetNumberOfComponents(EnvironmentPicture::Bands);
        coefficients->SetNumberOfTuples(
          static_cast<vtkIdType>(values.size()) / EnvironmentPicture::Bands);
        std::copy(values.begin(), values.end(), coefficients->GetPointer(0));
      }
      return read;
    },
    TransportRun::GetAdvice());
  if (!projected)
  {
    vtkErrorMacro(<< projected.GetMessage());
  }
  return static_cast<bool>(projected);
}

//------------------------------------------------------------------------------
void vtkRadianceTransfer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Degree: " << this->Degree << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
  os << indent << "TwoSided: " << this->TwoSided << "\n";
  os << indent << "RefractiveIndex: " << this->RefractiveIndex << "\n";
}
