// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Solving/ProgressiveSolution.h"

#include "Shared/ArrayNames.h"
#include "Shared/InputArrays.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkLight.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

namespace LightTransport
{
namespace
{
constexpr int Bands = 3;
/// Seconds between two questions whether time is up.
constexpr double Interval = 1e-3;
/// However small the budget is, something is done.
constexpr double LeastSeconds = 1e-3;
/// As many as the filter makes between two looks at what is left.
constexpr vtkIdType ShotsPerCheck = 16;
///@{ vtkRadiosity's arrays.
constexpr int EmissionArray = 0;
constexpr int ReflectanceArray = 1;
///@}

/// A filter that is within earshot often enough, and on one process.
template <typename Filter>
class Sliced : public Filter
{
public:
  static vtkSmartPointer<Filter> Make()
  {
    auto* filter = new Sliced;
    filter->InitializeObjectBase();
    return vtkSmartPointer<Filter>::Take(filter);
  }

protected:
  Sliced()
  {
    this->ProgressInterval = Interval;
    this->SetController(nullptr);
  }
};

//------------------------------------------------------------------------------
/// What vtkErrorMacro puts before a message is about places in the source.
std::string GetText(const void* message)
{
  std::string text = static_cast<const char*>(message);
  const std::size_t begin = text.find("): ");
  text = begin == std::string::npos ? text : text.substr(begin + 3);
  text.erase(text.find_last_not_of(" \n") + 1);
  return text;
}

//------------------------------------------------------------------------------
vtkPolyData* GetBlock(vtkMultiBlockDataSet* blocks, std::size_t index)
{
  return blocks && index < blocks->GetNumberOfBlocks()
    ? vtkPolyData::SafeDownCast(blocks->GetBlock(static_cast<unsigned int>(index)))
    : nullptr;
}

//------------------------------------------------------------------------------
/// What went wrong in drawing the means of shots.
Outcome Describe(const Outcome& drawn)
{
  return drawn ? drawn
               : Outcome::Failed("OpenGL failed in drawing the radiosity at points with " +
                   drawn.GetMessage() +
                   ": set Device of the vtkRadiosity to CPU, or use actors of fewer polygons.");
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkMultiBlockDataSet> Copy(vtkDataObject* blocks)
{
  auto copy = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  copy->ShallowCopy(blocks);
  return copy;
}

//------------------------------------------------------------------------------
std::size_t FindMember(const std::vector<SceneActors::Member>& members, vtkActor* actor, int block)
{
  const auto found = std::find_if(members.begin(), members.end(),
    [actor, block](const SceneActors::Member& member)
    { return member.Actor.Get() == actor && member.Block == block; });
  return static_cast<std::size_t>(found - members.begin());
}
} // namespace

//------------------------------------------------------------------------------
ProgressiveSolution::ProgressiveSolution()
  : Filter(Sliced<vtkRadiosity>::Make()), Direct(Sliced<vtkDirectIrradiance>::Make())
{
  this->Observe(this->Filter);
  this->Observe(this->Direct);
  this->MakeShooter();
}

//------------------------------------------------------------------------------
ProgressiveSolution::~ProgressiveSolution() = default;

//------------------------------------------------------------------------------
void ProgressiveSolution::MakeShooter()
{
  this->Shooter = vtkSmartPointer<vtkOpenGLShooter>::New();
  this->Observe(static_cast<vtkObject*>(this->Shooter));
}

//------------------------------------------------------------------------------
void ProgressiveSolution::Observe(vtkObject* teller)
{
  teller->AddObserver(vtkCommand::ErrorEvent, this, &ProgressiveSolution::HearError);
  teller->AddObserver(vtkCommand::WarningEvent, this, &ProgressiveSolution::HearWarning);
}

//------------------------------------------------------------------------------
// The executive says once more that its algorithm has failed.
void ProgressiveSolution::Observe(vtkAlgorithm* filter)
{
  this->Observe(static_cast<vtkObject*>(filter));
  filter->AddObserver(vtkCommand::ProgressEvent, this, &ProgressiveSolution::HearProgress);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this, &ProgressiveSolution::Ignore);
}

//------------------------------------------------------------------------------
void ProgressiveSolution::HearProgress(vtkObject* filter, unsigned long, void*)
{
  if (this->Work.IsUnderWay() && !this->Work.GoesOn())
  {
    vtkAlgorithm::SafeDownCast(filter)->SetAbortExecute(1);
  }
}

//------------------------------------------------------------------------------
void ProgressiveSolution::HearError(vtkObject*, unsigned long, void* text)
{
  this->Errors += (this->Errors.empty() ? "" : " ") + GetText(text);
}

//------------------------------------------------------------------------------
// Several runs look at one scene.
void ProgressiveSolution::HearWarning(vtkObject*, unsigned long, void* text)
{
  const std::string warning = GetText(text);
  auto& told = this->ToldWarnings;
  if (std::find(told.begin(), told.end(), warning) == told.end())
  {
    told.push_back(warning);
    this->Warnings.push_back(warning);
  }
}

//------------------------------------------------------------------------------
std::vector<std::string> ProgressiveSolution::TakeWarnings()
{
  std::vector<std::string> warnings;
  warnings.swap(this->Warnings);
  return warnings;
}

//------------------------------------------------------------------------------
std::string ProgressiveSolution::TakeErrors()
{
  std::string errors;
  errors.swap(this->Errors);
  return errors;
}

//------------------------------------------------------------------------------
Outcome ProgressiveSolution::Update(vtkRenderer* renderer, const Settings& settings, double seconds)
{
  const double begin = vtkTimerLog::GetUniversalTime();
  const SceneActors::Names names = { InputArrays::GetChosenName(settings.Radiosity, EmissionArray,
                                       "Emission"),
    InputArrays::GetChosenName(settings.Radiosity, ReflectanceArray, "Reflectance") };
  SceneActors found;
  std::vector<std::string> refusals;
  found.Find(renderer, names, refusals);
  const Keys keys = { found.GetShapeKey(), found.GetMaterialKey(), found.GetLightKey(),
    settings.Radiosity->GetMTime(), settings.Shadows, settings.UsesAmbient };
  const bool areSameActors = this->IsKnown && this->Actors.AreOfActorsOf(found);
  const bool isSame = areSameActors && keys == this->Known;
  if (isSame)
  {
    this->Actors = found;
  }
  else if (!areSameActors || !this->IsFirstLightUnderWay(keys))
  {
    this->Work.Stop();
    this->Actors = found;
    this->Restart(keys, settings);
  }
  for (std::string& refusal : refusals)
  {
    this->HearWarning(nullptr, 0, &refusal[0]);
  }
  if (this->State == Progress::Done && this->Means && !this->IsShotIn(renderer))
  {
    this->State = Progress::Shooting;
  }
  if (this->HaveShotsFailed && this->FailedIn != renderer->GetRenderWindow())
  {
    // Another window may be on another device.
    this->ShowEstimate();
    this->State = Progress::Shooting;
  }
  const auto getLeft = [&]()
  { return std::max(LeastSeconds, begin + seconds - vtkTimerLog::GetUniversalTime()); };
  Outcome done = Outcome::Done();
  if (this->State == Progress::Computing && this->Work.RunFor(getLeft()))
  {
    done = this->TakeWork();
  }
  if (done && this->State == Progress::Computing && this->Estimate && !this->Solution)
  {
    this->ShowEstimate();
  }
  if (done && this->State == Progress::Shooting)
  {
    done = this->Shoot(renderer, getLeft(), settings.UsesAmbient);
    this->HaveShotsFailed = !done;
    this->FailedIn = renderer->GetRenderWindow();
  }
  return this->State == Progress::Failed && done ? Outcome::FailedAsReported() : done;
}

//------------------------------------------------------------------------------
bool ProgressiveSolution::Keys::operator==(const Keys& other) const
{
  const auto tie = [](const Keys& keys)
  {
    return std::tie(keys.Shape, keys.Material, keys.Light, keys.Radiosity, keys.Shadows,
      keys.UsesAmbient);
  };
  return tie(*this) == tie(other);
}

//------------------------------------------------------------------------------
// Whether lights alone have changed, before there is an estimate in those that were there: a light
// that moves faster than light is computed would else show nothing new for ever.
bool ProgressiveSolution::IsFirstLightUnderWay(const Keys& keys) const
{
  Keys others = keys;
  others.Light = this->Known.Light;
  return others == this->Known && this->State == Progress::Computing && !this->Estimate;
}

//------------------------------------------------------------------------------
void ProgressiveSolution::ShowEstimate()
{
  this->ShownScene = this->Estimate;
  this->ShownMembers = this->Actors.GetMembers();
  this->Means.reset();
}

//------------------------------------------------------------------------------
// Of what was known only what is the same is kept.
void ProgressiveSolution::Restart(const Keys& keys, const Settings& settings)
{
  const bool needsLight = !this->Lit || keys.Shape != this->Known.Shape ||
    keys.Light != this->Known.Light || keys.Shadows != this->Known.Shadows;
  this->Known = keys;
  this->IsKnown = true;
  this->HaveShotsFailed = false;
  this->Errors.clear();
  this->Warnings.clear();
  this->Estimate = nullptr;
  this->Solution = nullptr;
  this->ReadBack = nullptr;
  this->Shots = 0;
  if (this->Actors.GetMembers().empty())
  {
    this->State = Progress::Done;
    this->ShownScene = nullptr;
    this->ShownMembers.clear();
    this->Means.reset();
    return;
  }
  this->Filter->CopyProperties(settings.Radiosity);
  this->IsByShots = settings.Radiosity->GetSolver() == vtkRadiosity::SOLVER_SOUTHWELL &&
    settings.Radiosity->GetDevice() == vtkRadiosity::DEVICE_OPENGL;
  // Contexts belong to the thread that draws.
  this->Filter->SetDeviceToCPU();
  this->Direct->SetShadows(settings.Shadows);
  this->State = Progress::Computing;
  std::string problem = settings.Radiosity->GetTwoSided()
    ? "TwoSided of the vtkRadiosity is on, and a vtkRadiosityPass shows both sides of a surface "
      "alike: switch it off and give each side an actor, or run the filter and draw its arrays."
    : "";
  this->Scene = problem.empty() ? this->Actors.MakeScene(problem) : nullptr;
  this->Lit = needsLight ? nullptr : this->Lit;
  this->Work.Begin(
    [this, problem, needsLight, usesAmbient = settings.UsesAmbient]() {
      return problem.empty() ? this->Compute(needsLight, usesAmbient) : Outcome::Failed(problem);
    });
}

//------------------------------------------------------------------------------
// On the thread of the work. Filters have told what is wrong.
Outcome ProgressiveSolution::Compute(bool needsLight, bool usesAmbient)
{
  if (needsLight && !this->Light())
  {
    return Outcome::FailedAsReported();
  }
  this->AddLight();
  auto estimate = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  if (!this->Filter->PrepareShots(this->Scene, usesAmbient, this->Problem, estimate))
  {
    return Outcome::FailedAsReported();
  }
  this->Estimate = estimate;
  if (this->IsByShots)
  {
    return Outcome::Done();
  }
  this->Filter->SetInputData(this->Scene);
  this->Filter->Update();
  auto* solved = vtkMultiBlockDataSet::SafeDownCast(this->Filter->GetOutputDataObject(0));
  if (!solved || solved->GetNumberOfBlocks() == 0)
  {
    return Outcome::FailedAsReported();
  }
  this->Solution = Copy(solved);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
bool ProgressiveSolution::Light()
{
  const auto lights = this->Actors.CopyLights();
  auto lit = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  if (!lights.empty())
  {
    this->Direct->RemoveAllLights();
    for (vtkLight* light : lights)
    {
      this->Direct->AddLight(light);
    }
    this->Direct->SetInputData(this->Scene);
    this->Direct->Update();
    lit = Copy(this->Direct->GetOutputDataObject(0));
    if (lit->GetNumberOfBlocks() == 0)
    {
      return false;
    }
  }
  this->Lit = lit;
  ++this->LightRuns;
  return true;
}

//------------------------------------------------------------------------------
void ProgressiveSolution::AddLight()
{
  for (std::size_t index = 0; index < this->Lit->GetNumberOfBlocks(); ++index)
  {
    vtkCellData* lit = GetBlock(this->Lit, index)->GetCellData();
    GetBlock(this->Scene, index)
      ->GetCellData()
      ->AddArray(lit->GetArray(ArrayNames::DirectIrradiance));
  }
}

//------------------------------------------------------------------------------
Outcome ProgressiveSolution::TakeWork()
{
  if (const Outcome& ended = this->Work.GetOutcome(); !ended)
  {
    return this->Fail(ended.GetMessage());
  }
  ++this->SolverRuns;
  const bool isDark = std::all_of(this->Problem.Source.begin(), this->Problem.Source.end(),
    [](double source) { return source == 0.0; });
  if (isDark)
  {
    std::string warning = "Nothing shines on the actors of the renderer: give it a light of type "
                          "scene light, or actors an ambient color or the cell array \"Emission\".";
    this->HearWarning(nullptr, 0, &warning[0]);
  }
  this->ShowEstimate();
  this->ShownScene = this->IsByShots ? this->Estimate : this->Solution;
  this->State = this->IsByShots ? Progress::Shooting : Progress::Done;
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Nothing is shown of what has failed. Without a message, with what has been heard.
Outcome ProgressiveSolution::Fail(const std::string& message)
{
  const std::string heard = this->TakeErrors();
  this->State = Progress::Failed;
  this->ShownScene = nullptr;
  this->ShownMembers.clear();
  this->Means.reset();
  return Outcome::Failed(message.empty() ? heard : message);
}

//------------------------------------------------------------------------------
bool ProgressiveSolution::IsShotIn(vtkRenderer* renderer) const
{
  return this->Means && this->Means->IsAlive() &&
    this->Shooter->GetRenderWindow() == renderer->GetRenderWindow();
}

//------------------------------------------------------------------------------
Outcome ProgressiveSolution::BeginShots(vtkRenderer* renderer)
{
  this->Means.reset();
  this->Shooter->SetRenderWindow(renderer->GetRenderWindow());
  this->BytesRead += this->Shooter->GetNumberOfBytesRead();
  this->Shots = 0;
  this->UncheckedShots = 0;
  if (!this->Shooter->Initialize(this->Problem.Patches, this->Problem.NumberOfBands,
        this->Problem.Source.data(), this->Problem.Reflectance.data()))
  {
    return Outcome::FailedAsReported();
  }
  vtkTextureObject* radiosity = this->Shooter->ComputeRadiosity(false);
  if (!radiosity)
  {
    return Outcome::FailedAsReported();
  }
  this->Means =
    std::make_unique<GroupMeans>(vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()));
  return Describe(this->Means->Upload(this->Problem.Starts, this->Problem.Members,
    this->Problem.Parts, static_cast<int>(radiosity->GetWidth())));
}

//------------------------------------------------------------------------------
Outcome ProgressiveSolution::Shoot(vtkRenderer* renderer, double seconds, bool usesAmbient)
{
  const double begin = vtkTimerLog::GetUniversalTime();
  if (!this->IsShotIn(renderer))
  {
    if (Outcome begun = this->BeginShots(renderer); !begun)
    {
      return this->Fail(begun.GetMessage());
    }
  }
  const double left = seconds - (vtkTimerLog::GetUniversalTime() - begin);
  if (left <= 0.0)
  {
    // Taking the scene has cost the whole frame.
    return this->ShowShots(usesAmbient);
  }
  this->ReadBack = nullptr;
  const double end = begin + seconds;
  for (double now = begin; now < end && this->State == Progress::Shooting;)
  {
    bool isOver = false;
    const vtkIdType shots = this->Shooter->ShootFor(end - now, isOver);
    if (shots < 0)
    {
      return this->Fail({});
    }
    this->Shots += shots;
    this->AllShots += shots;
    this->UncheckedShots += shots;
    if (isOver || (this->UncheckedShots >= ShotsPerCheck && this->IsEnough()))
    {
      this->State = Progress::Done;
    }
    const double before = now;
    now = vtkTimerLog::GetUniversalTime();
    // What comes next takes about as long as what has been.
    now = shots > 0 && now + (now - before) > end ? end : now;
  }
  return this->ShowShots(usesAmbient && this->State != Progress::Done);
}

//------------------------------------------------------------------------------
Outcome ProgressiveSolution::ShowShots(bool usesAmbient)
{
  vtkTextureObject* radiosity = this->Shooter->ComputeRadiosity(usesAmbient);
  std::array<float, 4> scales = {};
  for (int band = 0; band < Bands; ++band)
  {
    scales[band] = static_cast<float>(this->Shooter->GetBandScale(band));
  }
  const Outcome drawn =
    radiosity ? Describe(this->Means->Draw(radiosity, scales)) : Outcome::FailedAsReported();
  return drawn ? drawn : this->Fail(drawn.GetMessage());
}

//------------------------------------------------------------------------------
// As Southwell of vtkRadiosity ends: neither B nor H of any patch misses more than the largest
// unshot radiosity over 1 - rho, for the largest rho.
bool ProgressiveSolution::IsEnough()
{
  this->UncheckedShots = 0;
  double unshot[Bands] = {};
  if (!this->Shooter->GetLargestUnshot(unshot))
  {
    return false;
  }
  double brightest[Bands] = {};
  double largest[Bands] = {};
  for (std::size_t k = 0; k < this->Problem.Source.size(); ++k)
  {
    double& source = brightest[k % Bands];
    double& reflectance = largest[k % Bands];
    source = std::max(source, std::abs(this->Problem.Source[k]));
    reflectance = std::max(reflectance, this->Problem.Reflectance[k]);
  }
  bool isEnough = true;
  for (int band = 0; band < Bands; ++band)
  {
    isEnough = isEnough &&
      unshot[band] <= this->Filter->GetTolerance() * brightest[band] * (1.0 - largest[band]);
  }
  return isEnough;
}

//------------------------------------------------------------------------------
std::vector<ProgressiveSolution::Shown> ProgressiveSolution::FindShown(vtkActor* actor) const
{
  std::vector<Shown> all;
  for (const SceneActors::Member& member : this->Actors.GetMembers())
  {
    if (member.Actor.Get() != actor)
    {
      continue;
    }
    const std::size_t index = FindMember(this->ShownMembers, actor, member.Block);
    vtkPolyData* surface = GetBlock(this->ShownScene, index);
    if (!surface || this->ShownMembers[index].Shape != member.Shape)
    {
      return {};
    }
    all.push_back({ surface, this->ShownMembers[index].Matrix, member.Surface });
  }
  return all;
}

//------------------------------------------------------------------------------
vtkTextureObject* ProgressiveSolution::GetGroups() const
{
  return this->Means && this->Means->IsAlive() ? this->Means->GetTexture() : nullptr;
}

//------------------------------------------------------------------------------
vtkPolyData* ProgressiveSolution::GetOutput(vtkActor* actor, int block)
{
  const std::size_t index = FindMember(this->Actors.GetMembers(), actor, block);
  vtkMultiBlockDataSet* output = this->Solution ? this->Solution : this->Estimate;
  const bool isShot = this->State == Progress::Shooting || this->State == Progress::Done;
  if (this->IsByShots && isShot && this->GetGroups())
  {
    if (!this->ReadBack)
    {
      std::vector<double> irradiance(this->Problem.Source.size());
      auto readBack = vtkSmartPointer<vtkMultiBlockDataSet>::New();
      if (!this->Shooter->GetIrradiance(irradiance.data()) ||
        !this->Filter->WriteShots(this->Scene, irradiance, this->Shots, readBack))
      {
        return nullptr;
      }
      this->ReadBack = readBack;
    }
    output = this->ReadBack;
  }
  return GetBlock(output, index);
}

//------------------------------------------------------------------------------
void ProgressiveSolution::ReleaseGraphicsResources()
{
  this->Means.reset();
  this->BytesRead += this->Shooter->GetNumberOfBytesRead();
  this->MakeShooter();
  this->ReadBack = nullptr;
  if (this->IsByShots && this->State == Progress::Done && this->Estimate)
  {
    this->State = Progress::Shooting;
  }
}
} // namespace LightTransport
