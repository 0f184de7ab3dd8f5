// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLShooter.h"

#include "Context/LightTransportOpenGL.h"
#include "Shooting/HemisphereItems.h"
#include "Textures/FloatVectors.h"
#include "vtkLightTransportShootingSelectFS.h"

#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenGLShooter);

namespace
{
using Group = FloatTextures::Group;
using Vector = std::array<double, 3>;

enum Slot
{
  UNSHOT,
  SHOT, ///< what a patch would shoot: UNSHOT and its share of the ambient radiosity
  REFLECTANCE,
  REFLECTION, ///< reflectance / area
  AREA,       ///< in every band
  RECEIVED,   ///< power, by the shots under way
  POWER,      ///< all power received
  SCRATCH
};

/// Candidates for the next shots are left where a reduction ends: this many in each direction.
constexpr int CandidatesAcross = 4;
/// Texels that one fragment of a reduction looks at, in each direction.
constexpr int ReductionBlock = 16;
/// Candidates with less than this fraction of the best one's power wait.
constexpr float LeastPower = 0.5f;
/// Single precision counts up to here.
constexpr vtkIdType MaximumNumberOfPatches = vtkIdType(1) << 24;

struct Candidate
{
  float Power;
  int Patch;
};

//------------------------------------------------------------------------------
/// Three perpendicular axes whose sum points along a normal, turned around it by `angle`.
void MakeAxes(const double normal[3], double angle, float axes[3][3])
{
  double u[3];
  double v[3];
  vtkMath::Perpendiculars(normal, u, v, angle);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double turn = 2.0 * vtkMath::Pi() / 3.0 * axis;
    for (int k = 0; k < 3; ++k)
    {
      const double across = std::cos(turn) * u[k] + std::sin(turn) * v[k];
      axes[axis][k] =
        static_cast<float>(std::sqrt(1.0 / 3.0) * normal[k] + std::sqrt(2.0 / 3.0) * across);
    }
  }
}
} // namespace

struct vtkOpenGLShooter::Internals
{
  vtkSmartPointer<vtkOffScreenOpenGLRenderWindow> Window;
  std::string DeviceName = "OpenGL";

  // The scene, centred, with a diagonal of 1.
  std::vector<Vector> Points;
  std::vector<vtkIdType> Offsets;
  std::vector<vtkIdType> Corners;
  std::vector<double> Normals;
  std::vector<double> Areas; ///< fractions of the whole
  int Patches = 0;
  int Bands = 0;
  std::vector<double> Scales; ///< of each band: its largest source
  double FirstPower = 0.0;
  std::vector<double> Reflectance; ///< patches x bands
  std::vector<double> Losses;      ///< of each band: what does not come back of an ambient light
  std::vector<double> Ambient;     ///< of each band
  double Remainder = 0.0;          ///< squares of what was unshot a sweep ago
  vtkIdType ShotsOfSweep = 0;
  bool Overshoots = true;
  vtkTypeInt64 EyesSoFar = 0;
  vtkTypeInt64 BytesOfCandidates = 0;

  std::unique_ptr<FloatTextures> Engine;
  std::unique_ptr<FloatVectors> Vectors;
  std::unique_ptr<HemisphereItems> Items;
  std::vector<Group> Selections;

  void Clear()
  {
    this->Selections.clear();
    this->Vectors.reset();
    this->Items.reset();
    this->Engine.reset();
  }

  void SetScene(const vtkDeviceShooter::Patches& patches);
  bool AllocateScene(int resolution);
  bool AllocateSelections();
  bool SetMaterials(const double* source, const double* reflectance);

  bool DrawSelection(const Group& target, const Group& source, bool first);
  bool CheckOvershooting();
  bool ComputeShots();
  bool FindCandidates(std::vector<Candidate>& candidates);
  void AddEyes(int patch, int divisions, std::vector<HemisphereItems::Eye>& eyes);
  bool ShootFrom(const std::vector<Candidate>& shooters, double density);
  bool Collect();
  void TakeAway(int patch);
  /// From patches x bands as they are on the device to the unit of the source.
  void Unscale(double* values, vtkIdType size) const;
};

//------------------------------------------------------------------------------
void vtkOpenGLShooter::Internals::SetScene(const vtkDeviceShooter::Patches& patches)
{
  this->Offsets = patches.Offsets;
  this->Corners = patches.Corners;
  this->Normals = patches.Normals;
  this->Areas = patches.Areas;
  const double whole = std::accumulate(this->Areas.begin(), this->Areas.end(), 0.0);
  std::for_each(this->Areas.begin(), this->Areas.end(), [whole](double& area) { area /= whole; });

  Vector low;
  Vector high;
  low.fill(VTK_DOUBLE_MAX);
  high.fill(-VTK_DOUBLE_MAX);
  for (std::size_t k = 0; k < patches.Points.size(); ++k)
  {
    low[k % 3] = std::min(low[k % 3], patches.Points[k]);
    high[k % 3] = std::max(high[k % 3], patches.Points[k]);
  }
  const double diagonal = std::sqrt(vtkMath::Distance2BetweenPoints(low.data(), high.data()));
  this->Points.resize(patches.Points.size() / 3);
  for (std::size_t k = 0; k < patches.Points.size(); ++k)
  {
    this->Points[k / 3][k % 3] = (patches.Points[k] - 0.5 * (low[k % 3] + high[k % 3])) / diagonal;
  }
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::Internals::AllocateScene(int resolution)
{
  const int chosen = resolution > 0
    ? resolution
    : std::min(std::max(static_cast<int>(std::sqrt(this->Patches)), 64), 1024);
  std::vector<float> points;
  for (const Vector& point : this->Points)
  {
    points.insert(points.end(),
      { static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]) });
  }
  std::vector<unsigned int> triangles;
  std::vector<int> patches;
  for (int patch = 0; patch < this->Patches; ++patch)
  {
    const vtkIdType first = this->Offsets[patch];
    for (vtkIdType corner = first + 1; corner + 1 < this->Offsets[patch + 1]; ++corner)
    {
      for (vtkIdType at : { first, corner, corner + 1 })
      {
        triangles.push_back(static_cast<unsigned int>(this->Corners[at]));
      }
      patches.push_back(patch);
    }
  }
  this->Items = std::make_unique<HemisphereItems>(this->Engine.get());
  return this->Items->Allocate(points, triangles, patches, chosen / 2 * 2);
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::Internals::AllocateSelections()
{
  bool good = true;
  int width = this->Vectors->GetLayout().Width;
  int height = this->Vectors->GetLayout().Height;
  do
  {
    for (int* size : { &width, &height })
    {
      const int reduced = FloatTextures::DivideUp(*size, ReductionBlock);
      *size = std::min(*size, std::max(reduced, CandidatesAcross));
    }
    this->Selections.push_back(this->Engine->Allocate(1, width, height));
    good = good && !this->Selections.back().empty();
  } while (width > CandidatesAcross || height > CandidatesAcross);
  return good;
}

//------------------------------------------------------------------------------
// Bands are scaled to a largest source of 1: single precision has too few exponents for some, and
// the brightest patch is the brightest of all bands alike.
bool vtkOpenGLShooter::Internals::SetMaterials(const double* source, const double* reflectance)
{
  const std::size_t size = static_cast<std::size_t>(this->Patches) * this->Bands;
  this->Scales.assign(static_cast<std::size_t>(this->Bands), 0.0);
  for (std::size_t k = 0; k < size; ++k)
  {
    double& scale = this->Scales[k % this->Bands];
    scale = std::max(scale, std::abs(source[k]));
  }
  std::vector<double> unshot(size, 0.0);
  std::vector<double> reflection(size);
  std::vector<double> areas(size);
  this->FirstPower = 0.0;
  for (std::size_t k = 0; k < size; ++k)
  {
    const double scale = this->Scales[k % this->Bands];
    const double area = this->Areas[k / this->Bands];
    unshot[k] = scale > 0.0 ? source[k] / scale : 0.0;
    reflection[k] = reflectance[k] / area;
    areas[k] = area;
    this->FirstPower += area * std::abs(unshot[k]);
  }
  this->EyesSoFar = 0;
  this->BytesOfCandidates = 0;
  this->Reflectance.assign(reflectance, reflectance + size);
  this->Losses.assign(this->Scales.size(), 0.0);
  for (std::size_t k = 0; k < size; ++k)
  {
    this->Losses[k % this->Bands] += reflectance[k] * areas[k];
  }
  for (double& loss : this->Losses)
  {
    loss -= loss * loss;
  }
  this->Remainder = VTK_DOUBLE_MAX;
  this->ShotsOfSweep = this->Patches;
  const std::vector<double> nothing(size, 0.0);
  return this->Vectors->Set(UNSHOT, unshot.data()) &&
    this->Vectors->Set(REFLECTANCE, reflectance) &&
    this->Vectors->Set(REFLECTION, reflection.data()) && this->Vectors->Set(AREA, areas.data()) &&
    this->Vectors->Set(POWER, nothing.data()) && this->Vectors->Set(RECEIVED, nothing.data());
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::Internals::DrawSelection(const Group& target, const Group& source,
  bool first)
{
  vtkShaderProgram* program =
    this->Engine->Use(first ? "SelectFirst" : "Select", vtkLightTransportShootingSelectFS,
      this->Vectors->GetLayout().GetDefines(1) + "#define FIRST_STEP " + (first ? "1\n" : "0\n"));
  if (!program)
  {
    return false;
  }
  const int sourceSize[2] = { static_cast<int>(source[0]->GetWidth()),
    static_cast<int>(source[0]->GetHeight()) };
  const int region[4] = { 0, 0, static_cast<int>(target[0]->GetWidth()),
    static_cast<int>(target[0]->GetHeight()) };
  this->Engine->SetTextures(program, first ? "unshot" : "found", source);
  if (first)
  {
    this->Engine->SetTextures(program, "areas", { this->Vectors->Get(AREA)[0] });
  }
  program->SetUniform2i("sourceSize", sourceSize);
  program->SetUniform2i("size", region + 2);
  this->Engine->Draw(target, region);
  return true;
}

//------------------------------------------------------------------------------
// Shots of what is unshot alone always converge: where overshooting gains nothing over as many
// shots as there are patches, as where most light leaves the scene, it ends.
bool vtkOpenGLShooter::Internals::CheckOvershooting()
{
  if (!this->Overshoots || this->ShotsOfSweep < this->Patches)
  {
    return true;
  }
  std::vector<double> squares(this->Scales.size());
  const bool good = this->Vectors->Dot(UNSHOT, UNSHOT, squares.data());
  const double remainder = std::accumulate(squares.begin(), squares.end(), 0.0);
  this->Overshoots = remainder < this->Remainder;
  this->Remainder = remainder;
  this->ShotsOfSweep = 0;
  return good;
}

//------------------------------------------------------------------------------
// All unshot power, as if it were spread over the scene evenly and went on until it is lost.
bool vtkOpenGLShooter::Internals::ComputeShots()
{
  this->Ambient.assign(this->Scales.size(), 0.0);
  if (this->Overshoots && !this->Vectors->Dot(UNSHOT, AREA, this->Ambient.data()))
  {
    return false;
  }
  for (std::size_t band = 0; band < this->Ambient.size(); ++band)
  {
    const double loss = this->Losses[band];
    this->Ambient[band] = loss > 0.0 ? this->Ambient[band] / loss : 0.0;
  }
  const std::vector<double> ones(this->Scales.size(), 1.0);
  return this->Vectors->Combine(SHOT, ones.data(), UNSHOT, this->Ambient.data(), REFLECTANCE);
}

//------------------------------------------------------------------------------
// The patches with the most power, the greatest first.
bool vtkOpenGLShooter::Internals::FindCandidates(std::vector<Candidate>& candidates)
{
  bool good = this->CheckOvershooting() && this->ComputeShots();
  for (std::size_t step = 0; step < this->Selections.size() && good; ++step)
  {
    good = this->DrawSelection(this->Selections[step],
      step == 0 ? this->Vectors->Get(SHOT) : this->Selections[step - 1], step == 0);
  }
  if (!good)
  {
    return false;
  }
  const Group& last = this->Selections.back();
  const int width = static_cast<int>(last[0]->GetWidth());
  const int height = static_cast<int>(last[0]->GetHeight());
  std::vector<float> texels(static_cast<std::size_t>(4) * width * height);
  this->Engine->Download(last, 0, width, height, texels.data());
  this->BytesOfCandidates += static_cast<vtkTypeInt64>(texels.size() * sizeof(float));
  for (std::size_t k = 0; k < texels.size(); k += 4)
  {
    if (texels[k] > 0.0f)
    {
      candidates.push_back({ texels[k], static_cast<int>(texels[k + 1]) });
    }
  }
  std::sort(candidates.begin(), candidates.end(),
    [](const Candidate& a, const Candidate& b)
    { return a.Power > b.Power || (a.Power == b.Power && a.Patch < b.Patch); });
  return true;
}

//------------------------------------------------------------------------------
// The centroids of the equal parts that dividing the edges of the polygon's triangles gives.
void vtkOpenGLShooter::Internals::AddEyes(int patch, int divisions,
  std::vector<HemisphereItems::Eye>& eyes)
{
  const vtkIdType first = this->Offsets[patch];
  const vtkIdType end = this->Offsets[patch + 1];
  const double* normal = &this->Normals[3 * static_cast<std::size_t>(patch)];
  const Vector& a = this->Points[this->Corners[first]];
  std::vector<double> areas;
  for (vtkIdType corner = first + 1; corner + 1 < end; ++corner)
  {
    double u[3];
    double v[3];
    double cross[3];
    vtkMath::Subtract(this->Points[this->Corners[corner]].data(), a.data(), u);
    vtkMath::Subtract(this->Points[this->Corners[corner + 1]].data(), a.data(), v);
    vtkMath::Cross(u, v, cross);
    areas.push_back(vtkMath::Norm(cross));
  }
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  for (vtkIdType corner = first + 1; corner + 1 < end; ++corner)
  {
    const Vector& b = this->Points[this->Corners[corner]];
    const Vector& c = this->Points[this->Corners[corner + 1]];
    const double share = areas[corner - first - 1] / whole / (divisions * divisions);
    for (int i = 0; i < divisions; ++i)
    {
      for (int j = 0; j < 2 * (divisions - i) - 1; ++j)
      {
        // Upright triangles and those between them, alternating along a row.
        const double third = j % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
        const double s = (i + third) / divisions;
        const double t = (j / 2 + third) / divisions;
        HemisphereItems::Eye eye;
        for (int k = 0; k < 3; ++k)
        {
          eye.Position[k] = static_cast<float>((1.0 - s - t) * a[k] + s * b[k] + t * c[k]);
        }
        // Pixels fall differently each time, so that their errors average out.
        const double turns = 0.6180339887498949 * static_cast<double>(this->EyesSoFar++);
        MakeAxes(normal, 2.0 * vtkMath::Pi() * (turns - std::floor(turns)), eye.Axes);
        eye.Shooter = patch;
        eye.Power = share * this->Areas[patch];
        eyes.push_back(eye);
      }
    }
  }
}

//------------------------------------------------------------------------------
// What a patch has shot is no longer unshot there: what it overshot is missing.
void vtkOpenGLShooter::Internals::TakeAway(int patch)
{
  vtkOpenGLState* state = this->Window->GetState();
  const vtkOpenGLState::ScopedglScissor scissor(state);
  const int width = this->Vectors->GetLayout().Width;
  this->Engine->Bind(this->Vectors->Get(UNSHOT));
  state->vtkglScissor(patch % width, patch / width, 1, 1);
  state->vtkglEnable(GL_SCISSOR_TEST);
  for (int group = 0; group < this->Vectors->GetLayout().Groups; ++group)
  {
    float texel[4] = {};
    for (int lane = 0; lane < std::min(4, this->Bands - 4 * group); ++lane)
    {
      const int band = 4 * group + lane;
      const std::size_t k = static_cast<std::size_t>(patch) * this->Bands + band;
      texel[lane] = static_cast<float>(-this->Reflectance[k] * this->Ambient[band]);
    }
    glClearBufferfv(GL_COLOR, group, texel);
  }
  state->vtkglDisable(GL_SCISSOR_TEST);
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::Internals::ShootFrom(const std::vector<Candidate>& shooters, double density)
{
  std::vector<HemisphereItems::Eye> eyes;
  for (const Candidate& shooter : shooters)
  {
    const double wanted = density * shooter.Power / this->FirstPower;
    const auto triangles =
      static_cast<double>(this->Offsets[shooter.Patch + 1] - this->Offsets[shooter.Patch] - 2);
    const int divisions = static_cast<int>(std::ceil(std::sqrt(wanted / triangles)));
    this->AddEyes(shooter.Patch, std::max(divisions, 1), eyes);
  }
  this->ShotsOfSweep += static_cast<vtkIdType>(shooters.size());
  this->Engine->Clear(this->Vectors->Get(RECEIVED));
  bool good = true;
  for (std::size_t first = 0; first < eyes.size() && good; first += HemisphereItems::MostEyes)
  {
    const std::size_t end = std::min(first + HemisphereItems::MostEyes, eyes.size());
    good = this->Items->Shoot({ eyes.data() + first, eyes.data() + end },
      this->Vectors->GetLayout(), this->Vectors->Get(SHOT), this->Vectors->Get(RECEIVED));
  }
  for (const Candidate& shooter : shooters)
  {
    this->TakeAway(shooter.Patch);
  }
  return good && this->Collect();
}

//------------------------------------------------------------------------------
// What is received adds to all power, and what is reflected of it can be shot.
bool vtkOpenGLShooter::Internals::Collect()
{
  const std::vector<double> ones(static_cast<std::size_t>(this->Bands), 1.0);
  return this->Vectors->Combine(POWER, ones.data(), POWER, ones.data(), RECEIVED) &&
    this->Vectors->Scale(SCRATCH, REFLECTION, RECEIVED) &&
    this->Vectors->Combine(UNSHOT, ones.data(), UNSHOT, ones.data(), SCRATCH);
}

//------------------------------------------------------------------------------
void vtkOpenGLShooter::Internals::Unscale(double* values, vtkIdType size) const
{
  for (vtkIdType k = 0; k < size; ++k)
  {
    values[k] *= this->Scales[k % this->Bands];
  }
}

//------------------------------------------------------------------------------
vtkOpenGLShooter::vtkOpenGLShooter() : Self(new Internals) {}

//------------------------------------------------------------------------------
vtkOpenGLShooter::~vtkOpenGLShooter()
{
  this->Self->Clear();
}

//------------------------------------------------------------------------------
void vtkOpenGLShooter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DeviceName: " << this->Self->DeviceName << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Overshooting: " << this->Overshooting << "\n";
  os << indent << "EyePointDensity: " << this->EyePointDensity << "\n";
  os << indent << "NumberOfEyePoints: " << this->GetNumberOfEyePoints() << "\n";
  os << indent << "NumberOfBytesRead: " << this->GetNumberOfBytesRead() << "\n";
}

//------------------------------------------------------------------------------
void vtkOpenGLShooter::SetResolution(int resolution)
{
  const int clamped = resolution == 0 ? 0 : std::min(std::max(resolution, 16), 2048);
  if (clamped != this->Resolution)
  {
    this->Resolution = clamped;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkOpenGLShooter::GetNumberOfEyePoints()
{
  return this->Self->EyesSoFar;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkOpenGLShooter::GetNumberOfBytesRead()
{
  const Internals& self = *this->Self;
  return self.BytesOfCandidates + (self.Vectors ? self.Vectors->GetNumberOfBytesRead() : 0);
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::Open(std::string& reason)
{
  Internals& self = *this->Self;
  if (!self.Window)
  {
    self.Window = vtkGetSharedOffScreenWindow(reason);
  }
  if (!self.Window)
  {
    return false;
  }
  self.DeviceName = "OpenGL (" + self.Window->GetState()->GetRenderer() + ")";
  return true;
}

//------------------------------------------------------------------------------
const char* vtkOpenGLShooter::GetDeviceName()
{
  return this->Self->DeviceName.c_str();
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::Initialize(const Patches& patches, int numberOfBands, const double* source,
  const double* reflectance)
{
  Internals& self = *this->Self;
  self.Clear();
  const auto count = static_cast<vtkIdType>(patches.Areas.size());
  if (count < 1 || count > MaximumNumberOfPatches || numberOfBands < 1 ||
    numberOfBands > MaximumNumberOfBands)
  {
    vtkErrorMacro(<< count << " patches with " << numberOfBands << " bands: OpenGL takes 1 to "
                  << MaximumNumberOfPatches << " patches and 1 to " << int(MaximumNumberOfBands)
                  << " bands. Set Device to CPU for more.");
    return false;
  }
  std::string reason;
  if (!this->Open(reason))
  {
    vtkErrorMacro("No OpenGL context: " << reason);
    return false;
  }
  self.Engine = std::make_unique<FloatTextures>(self.Window);
  if (!self.Engine->IsAlive())
  {
    vtkErrorMacro("This OpenGL cannot make floating-point textures: set Device to CPU.");
    return false;
  }
  const FloatTextures::Session session(self.Window);
  self.Patches = static_cast<int>(count);
  self.Bands = numberOfBands;
  self.SetScene(patches);
  self.Overshoots = this->Overshooting;
  self.Vectors = std::make_unique<FloatVectors>(*self.Engine);
  if (!self.Vectors->Initialize(count, numberOfBands, 0, reason))
  {
    vtkErrorMacro(<< reason << ": set Device to CPU.");
    return false;
  }
  if (!self.AllocateSelections() || !self.AllocateScene(this->Resolution) ||
    !self.SetMaterials(source, reflectance))
  {
    vtkErrorMacro(<< count << " patches do not fit into the memory of " << self.DeviceName
                  << ": set Device to CPU.");
    return false;
  }
  return this->Finish(true, "taking the scene");
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::IsReady()
{
  if (!this->Self->Engine || !this->Self->Engine->IsAlive())
  {
    vtkErrorMacro("There is no scene, or its window has gone: call Initialize() first.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::Finish(bool drawn, const char* what)
{
  std::string text = "a shader that does not compile";
  if (!drawn || !FloatTextures::CheckErrors(text))
  {
    vtkErrorMacro("OpenGL failed in " << what << " with " << text << " on "
                                      << this->Self->DeviceName << ". Set Device to CPU.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
vtkIdType vtkOpenGLShooter::Shoot(vtkIdType numberOfShots)
{
  if (!this->IsReady())
  {
    return -1;
  }
  Internals& self = *this->Self;
  const FloatTextures::Session session(self.Window);
  vtkIdType shots = 0;
  while (shots < numberOfShots)
  {
    std::vector<Candidate> shooters;
    if (!this->Finish(self.FindCandidates(shooters), "choosing a shooter"))
    {
      return -1;
    }
    if (shooters.empty())
    {
      break;
    }
    const float least = LeastPower * shooters[0].Power;
    const auto end = std::partition_point(shooters.begin(), shooters.end(),
      [least](const Candidate& candidate) { return candidate.Power >= least; });
    const auto left = static_cast<std::ptrdiff_t>(numberOfShots - shots);
    shooters.erase(shooters.begin() + std::min(end - shooters.begin(), left), shooters.end());
    if (!this->Finish(self.ShootFrom(shooters, this->EyePointDensity), "shooting"))
    {
      return -1;
    }
    shots += static_cast<vtkIdType>(shooters.size());
  }
  return shots;
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::GetLargestUnshot(double* perBand)
{
  if (!this->IsReady())
  {
    return false;
  }
  Internals& self = *this->Self;
  const FloatTextures::Session session(self.Window);
  const bool drawn = self.Vectors->MaxNorm(UNSHOT, perBand);
  self.Unscale(perBand, self.Bands);
  return this->Finish(drawn, "looking for the largest unshot radiosity");
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::GetIrradiance(double* values)
{
  if (!this->IsReady())
  {
    return false;
  }
  Internals& self = *this->Self;
  const FloatTextures::Session session(self.Window);
  const vtkIdType size = static_cast<vtkIdType>(self.Patches) * self.Bands;
  self.Vectors->Read(POWER, values);
  self.Unscale(values, size);
  for (vtkIdType k = 0; k < size; ++k)
  {
    values[k] /= self.Areas[k / self.Bands];
  }
  return this->Finish(true, "reading the irradiance");
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::GetUnshot(double* values)
{
  if (!this->IsReady())
  {
    return false;
  }
  Internals& self = *this->Self;
  const FloatTextures::Session session(self.Window);
  self.Vectors->Read(UNSHOT, values);
  self.Unscale(values, static_cast<vtkIdType>(self.Patches) * self.Bands);
  return this->Finish(true, "reading the unshot radiosity");
}
