// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewFactors.h"

#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkDenseLinkOperator.h"
#include "vtkExchangeMatrix.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPatchSampler.h"
#include "vtkPatchScene.h"
#include "vtkPolygonExchange.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSceneRayCaster.h"
#include "vtkTimerLog.h"
#include "vtkTransportThreads.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

vtkStandardNewMacro(vtkViewFactors);

namespace
{
using Vector = vtkPatchScene::Vector;

// The shares of Tolerance, a bound on the error of a whole row: errors of the rules are relative to
// area / (pi distance^2), which sums to a few over a row; contours are few per row (a patch has a
// few dozen near ones); partly visible pairs are a few per cent.
constexpr double RuleShare = 0.125;
constexpr double ContourShare = 0.01;
constexpr double VisibilityShare = 0.02;
// Rays for a first look at a pair, and from which view factor on it gets more of them.
constexpr int FewRays = 4;
constexpr int FirstRays = 16;
constexpr double LargeViewFactor = 1e-3;
// Rays per patch that tell sky from back faces.
constexpr int OpeningRays = 128;
// A plane has the scene in front of it when nothing is further behind than this (the scene's
// diagonal is 1).
constexpr double PlaneTolerance = 1e-7;
// Rows of a tile per unit of parallel work, and units between two looks at progress and abort.
constexpr int RowsPerUnit = 16;
constexpr vtkIdType UnitsPerBatch = 32;

//------------------------------------------------------------------------------
// The quadrature points of all patches, for each rule.
class RuleTable
{
public:
  explicit RuleTable(const vtkPatchScene& scene)
  {
    const vtkIdType patches = scene.GetNumberOfPatches();
    this->Triangles.resize(patches + 1, 0);
    for (vtkIdType patch = 0; patch < patches; ++patch)
    {
      this->Triangles[patch + 1] = this->Triangles[patch] + scene.GetNumberOfCorners(patch) - 2;
    }
    vtkPolygonExchange::Polygon polygon;
    for (int rule = 0; rule < vtkPolygonExchange::NumberOfRules; ++rule)
    {
      const int points = vtkPolygonExchange::GetNumberOfRulePoints(rule);
      this->Points[rule].resize(points * this->Triangles.back());
      this->Weights[rule].resize(points * this->Triangles.back());
      for (vtkIdType patch = 0; patch < patches; ++patch)
      {
        vtkPolygonExchange::MakePolygon(scene, patch, polygon);
        vtkPolygonExchange::MakeRule(polygon, rule,
          &this->Points[rule][points * this->Triangles[patch]],
          &this->Weights[rule][points * this->Triangles[patch]]);
      }
    }
  }

  vtkPolygonExchange::RulePoints Get(vtkIdType patch, int rule) const
  {
    const int points = vtkPolygonExchange::GetNumberOfRulePoints(rule);
    const vtkIdType first = points * this->Triangles[patch];
    const auto count =
      static_cast<int>(points * (this->Triangles[patch + 1] - this->Triangles[patch]));
    return { count, &this->Points[rule][first], &this->Weights[rule][first] };
  }

private:
  std::vector<vtkIdType> Triangles;
  std::vector<Vector> Points[vtkPolygonExchange::NumberOfRules];
  std::vector<double> Weights[vtkPolygonExchange::NumberOfRules];
};

//------------------------------------------------------------------------------
// A patch that has the whole scene in front of its plane (or on it) cannot come between two points
// of the scene: only the others are worth a ray. In a convex room none is.
std::vector<bool> FindOccluders(const vtkPatchScene& scene)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  std::map<std::tuple<int, int, int, int>, bool> planes;
  std::vector<bool> occluders(patches);
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    const Vector& normal = scene.GetNormal(patch);
    const double offset = normal.dot(scene.GetCorner(patch, 0));
    const auto round = [](double value) { return static_cast<int>(std::lround(value * 1e7)); };
    const auto inserted = planes.emplace(
      std::make_tuple(round(normal.x()), round(normal.y()), round(normal.z()), round(offset)),
      false);
    if (inserted.second)
    {
      const auto& points = scene.GetPoints();
      inserted.first->second = std::any_of(points.begin(), points.end(),
        [&](const Vector& point) { return normal.dot(point) - offset < -PlaneTolerance; });
    }
    occluders[patch] = inserted.first->second;
  }
  return occluders;
}

//------------------------------------------------------------------------------
struct Counters
{
  double Examined = 0.0;
  double Facing = 0.0;
  double PartlyVisible = 0.0;
  double Rays = 0.0;
  std::vector<double> RowErrors; // in units of exchange

  void Add(const Counters& other)
  {
    this->Examined += other.Examined;
    this->Facing += other.Facing;
    this->PartlyVisible += other.PartlyVisible;
    this->Rays += other.Rays;
    for (std::size_t patch = 0; patch < other.RowErrors.size(); ++patch)
    {
      this->RowErrors[patch] += other.RowErrors[patch];
    }
  }
};
} // namespace

//------------------------------------------------------------------------------
// Fills the tiles of an exchange matrix, pair by pair; a functor over units of RowsPerUnit rows of
// a tile.
struct vtkViewFactors::Assembly
{
  const vtkPatchScene& Scene;
  RuleTable Rules;
  vtkSceneRayCaster Caster;
  bool HasOccluders = false;
  double Tolerance;
  int MaximumNumberOfRays;
  vtkExchangeMatrix* Exchange;
  vtkSMPThreadLocal<Counters> Local;
  Counters Total;

  Assembly(const vtkPatchScene& scene, double tolerance, int rays, vtkExchangeMatrix* exchange)
    : Scene(scene), Rules(scene), Tolerance(tolerance), MaximumNumberOfRays(rays),
      Exchange(exchange)
  {
    this->Total.RowErrors.resize(scene.GetNumberOfPatches(), 0.0);
  }

  static vtkIdType GetNumberOfUnits(std::size_t tiles)
  {
    return static_cast<vtkIdType>(tiles) * (vtkExchangeMatrix::TileSize / RowsPerUnit);
  }

  bool PrepareRays(std::string& error)
  {
    const std::vector<bool> occluders = FindOccluders(this->Scene);
    this->HasOccluders = std::find(occluders.begin(), occluders.end(), true) != occluders.end();
    return !this->HasOccluders || this->Caster.Build(this->Scene, error, &occluders);
  }

  void Initialize() { this->Local.Local().RowErrors.resize(this->Scene.GetNumberOfPatches(), 0.0); }

  // Called at the end of each batch.
  void Reduce()
  {
    for (Counters& counters : this->Local)
    {
      this->Total.Add(counters);
      counters = Counters();
    }
  }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    constexpr int N = vtkExchangeMatrix::TileSize;
    Counters& counters = this->Local.Local();
    for (vtkIdType unit = begin; unit < end; ++unit)
    {
      vtkExchangeMatrix::Tile& tile = this->Exchange->GetTiles()[unit / (N / RowsPerUnit)];
      const int firstRow = static_cast<int>(unit % (N / RowsPerUnit)) * RowsPerUnit;
      const vtkIdType patches = this->Scene.GetNumberOfPatches();
      for (int row = firstRow; row < firstRow + RowsPerUnit; ++row)
      {
        const vtkIdType i = tile.Row * N + row;
        const vtkIdType last = std::min<vtkIdType>(N, patches - tile.Column * N);
        for (int column = tile.Row == tile.Column ? row + 1 : 0; i < patches && column < last;
             ++column)
        {
          const vtkIdType j = tile.Column * N + column;
          const vtkPolygonExchange::Estimate pair = this->ComputePair(i, j, counters);
          counters.RowErrors[i] += pair.Error;
          counters.RowErrors[j] += pair.Error;
          vtkExchangeMatrix::SetValue(tile, row, column, 0, pair.Value);
        }
      }
    }
  }

  vtkPolygonExchange::Estimate ComputePair(vtkIdType i, vtkIdType j, Counters& counters) const
  {
    ++counters.Examined;
    const Vector between = this->Scene.GetCentroid(j) - this->Scene.GetCentroid(i);
    const double heightOfJ = between.dot(this->Scene.GetNormal(i));
    const double heightOfI = -between.dot(this->Scene.GetNormal(j));
    const double radiusI = this->Scene.GetRadius(i);
    const double radiusJ = this->Scene.GetRadius(j);
    if (heightOfJ <= -radiusJ || heightOfI <= -radiusI)
    {
      return {};
    }
    const double distance = between.norm();
    double errorI = 0.0;
    double errorJ = 0.0;
    const double share = RuleShare * this->Tolerance;
    const int ruleI = vtkPolygonExchange::ChooseRule(radiusI, distance - radiusJ, share, errorI);
    const int ruleJ = vtkPolygonExchange::ChooseRule(radiusJ, distance - radiusI, share, errorJ);
    vtkPolygonExchange::Estimate pair;
    if (ruleI >= 0 && ruleJ >= 0)
    {
      // The rules take the positive part of both cosines, so they need clipped patches only where a
      // horizon crosses.
      const bool crossing = heightOfJ < radiusJ || heightOfI < radiusI;
      pair.Value = crossing
        ? this->IntegrateClipped(i, ruleI, j, ruleJ)
        : vtkPolygonExchange::IntegrateRules(this->Rules.Get(i, ruleI), this->Scene.GetNormal(i),
            this->Rules.Get(j, ruleJ), this->Scene.GetNormal(j));
      pair.Error = (errorI + errorJ) * this->Scene.GetAreas()[i] * this->Scene.GetAreas()[j] /
        (vtkMath::Pi() * distance * distance);
    }
    else
    {
      pair = this->IntegrateNear(i, j);
    }
    if (pair.Value <= 0.0)
    {
      return {};
    }
    ++counters.Facing;
    return this->HasOccluders ? this->ApplyVisibility(i, j, pair, counters) : pair;
  }

  bool Clip(vtkIdType i, vtkIdType j, vtkPolygonExchange::Polygon& a,
    vtkPolygonExchange::Polygon& b) const
  {
    vtkPolygonExchange::MakePolygon(this->Scene, i, a);
    vtkPolygonExchange::MakePolygon(this->Scene, j, b);
    return vtkPolygonExchange::Clip(b, this->Scene.GetCorner(i, 0), a.Normal) &&
      vtkPolygonExchange::Clip(a, this->Scene.GetCorner(j, 0), b.Normal);
  }

  double IntegrateClipped(vtkIdType i, int ruleI, vtkIdType j, int ruleJ) const
  {
    vtkPolygonExchange::Polygon a, b;
    if (!this->Clip(i, j, a, b))
    {
      return 0.0;
    }
    constexpr int most = vtkPolygonExchange::MaximumRulePoints;
    Vector pointsA[most], pointsB[most];
    double weightsA[most], weightsB[most];
    vtkPolygonExchange::MakeRule(a, ruleI, pointsA, weightsA);
    vtkPolygonExchange::MakeRule(b, ruleJ, pointsB, weightsB);
    const int countA = vtkPolygonExchange::GetNumberOfRulePoints(ruleI) * (a.Count - 2);
    const int countB = vtkPolygonExchange::GetNumberOfRulePoints(ruleJ) * (b.Count - 2);
    return vtkPolygonExchange::IntegrateRules({ countA, pointsA, weightsA }, a.Normal,
      { countB, pointsB, weightsB }, b.Normal);
  }

  vtkPolygonExchange::Estimate IntegrateNear(vtkIdType i, vtkIdType j) const
  {
    vtkPolygonExchange::Polygon a, b;
    if (!this->Clip(i, j, a, b))
    {
      return {};
    }
    const double smaller = std::min(this->Scene.GetAreas()[i], this->Scene.GetAreas()[j]);
    return vtkPolygonExchange::IntegrateContours(a, b, ContourShare * this->Tolerance * smaller);
  }

  // The share of the exchange that nothing stands in the way of, by rays between points spread over
  // what of both patches lies in front of the other, each weighted with the exchange of its points.
  vtkPolygonExchange::Estimate ApplyVisibility(vtkIdType i, vtkIdType j,
    const vtkPolygonExchange::Estimate& open, Counters& counters) const
  {
    const vtkPatchSampler sampler(
      static_cast<std::uint64_t>(i) << 32 ^ static_cast<std::uint64_t>(j));
    const double smaller = std::min(this->Scene.GetAreas()[i], this->Scene.GetAreas()[j]);
    const double factor = open.Value / smaller;
    vtkPolygonExchange::Polygon a, b;
    this->Clip(i, j, a, b);
    int target = factor > LargeViewFactor ? FirstRays : FewRays;
    double total = 0.0;
    double visible = 0.0;
    int rays = 0;
    for (int sample = 0; sample < this->MaximumNumberOfRays; ++sample)
    {
      const Vector from = sampler.GetPoint(a, sample, 0);
      const Vector to = sampler.GetPoint(b, sample, 2);
      const Vector ray = to - from;
      const double squared = ray.squaredNorm();
      const double weight = std::max(0.0, ray.dot(this->Scene.GetNormal(i))) *
        std::max(0.0, -ray.dot(this->Scene.GetNormal(j))) / (squared * squared);
      if (weight > 0.0)
      {
        ++rays;
        total += weight;
        visible += this->Caster.IsOccluded(from, to, i, j) ? 0.0 : weight;
      }
      if (sample + 1 < target)
      {
        continue;
      }
      const double share = total > 0.0 ? visible / total : 1.0;
      const double error = std::sqrt(share * (1.0 - share) / target);
      if (error * factor <= VisibilityShare * this->Tolerance)
      {
        break;
      }
      target *= 2;
    }
    counters.Rays += rays;
    const double share = total > 0.0 ? visible / total : 1.0;
    if (share > 0.0 && share < 1.0)
    {
      ++counters.PartlyVisible;
    }
    const double spread = open.Value * std::sqrt(share * (1.0 - share) / std::max(rays, 1));
    return { share * open.Value, share * open.Error + spread };
  }
};

//------------------------------------------------------------------------------
vtkViewFactors::vtkViewFactors() = default;

//------------------------------------------------------------------------------
vtkViewFactors::~vtkViewFactors() = default;

//------------------------------------------------------------------------------
bool vtkViewFactors::UpdateExchange(const vtkPatchScene& scene, const ProgressFunction& progress)
{
  if (this->Exchange && this->Fingerprint == scene.GetFingerprint() &&
    this->BuildTime > this->GetMTime())
  {
    return true;
  }
  const double begin = vtkTimerLog::GetUniversalTime();
  this->Exchange = nullptr;
  if (!this->Assemble(scene, progress) || !this->SumRows())
  {
    this->Exchange = nullptr;
    return false;
  }
  this->RawRowSums = this->RowSums;
  if (!this->FindOpenings(scene) || (this->EnforceClosure && !this->CloseRows()))
  {
    this->Exchange = nullptr;
    return false;
  }
  this->Fingerprint = scene.GetFingerprint();
  this->Patches.resize(scene.GetNumberOfPatches());
  for (std::size_t polygon = 0; polygon < this->Patches.size(); ++polygon)
  {
    this->Patches[polygon] = scene.GetPatch(static_cast<vtkIdType>(polygon));
  }
  this->BuildTime.Modified();
  this->Seconds = vtkTimerLog::GetUniversalTime() - begin;
  return true;
}

//------------------------------------------------------------------------------
bool vtkViewFactors::Assemble(const vtkPatchScene& scene, const ProgressFunction& progress)
{
  vtkSmartPointer<vtkExchangeMatrix> exchange = this->MakeExchange(scene.GetAreas(), 1);
  if (!exchange)
  {
    return false;
  }
  Assembly assembly(scene, this->Tolerance, this->MaximumNumberOfRays, exchange);
  std::string error;
  const bool ready = assembly.PrepareRays(error);
  if (!vtkPatchScene::Agree(this->Controller, ready, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  // All ranks count the batches of the one with the most tiles: progress is a collective call.
  const vtkIdType rows = exchange->GetNumberOfTileRows();
  const int parts = exchange->GetNumberOfParts();
  const vtkIdType most = Assembly::GetNumberOfUnits((rows * (rows + 1) / 2 + parts - 1) / parts);
  const vtkIdType mine = Assembly::GetNumberOfUnits(exchange->GetTiles().size());
  for (vtkIdType unit = 0; unit < most; unit += UnitsPerBatch)
  {
    if (!progress(static_cast<double>(unit) / static_cast<double>(most)))
    {
      return false;
    }
    if (unit < mine)
    {
      vtkTransportThreads::For(unit, std::min(unit + UnitsPerBatch, mine), 1, assembly);
    }
  }
  this->CollectCounters(assembly);
  this->Exchange = exchange;
  return true;
}

//------------------------------------------------------------------------------
void vtkViewFactors::CollectCounters(const Assembly& assembly)
{
  const Counters& counters = assembly.Total;
  std::vector<double> totals = counters.RowErrors;
  totals.insert(totals.end(),
    { counters.Examined, counters.Facing, counters.PartlyVisible, counters.Rays });
  if (this->GetNumberOfRanks() > 1)
  {
    const std::vector<double> part = totals;
    this->Controller->AllReduce(part.data(), totals.data(), static_cast<vtkIdType>(part.size()),
      vtkCommunicator::SUM_OP);
  }
  const std::vector<double>& areas = assembly.Scene.GetAreas();
  this->PairsExamined = totals[areas.size()];
  this->PairsFacing = totals[areas.size() + 1];
  this->PairsPartlyVisible = totals[areas.size() + 2];
  this->RaysCast = totals[areas.size() + 3];
  this->RowErrors.resize(areas.size());
  std::transform(areas.begin(), areas.end(), totals.begin(), this->RowErrors.begin(),
    [](double area, double error) { return error / area; });
}

//------------------------------------------------------------------------------
bool vtkViewFactors::SumRows()
{
  vtkNew<vtkDenseLinkOperator> links;
  links->SetController(this->Controller);
  const std::vector<double>& areas = this->Exchange->GetAreas();
  const std::vector<double> ones(areas.size(), 1.0);
  this->RowSums.resize(areas.size());
  if (!links->Initialize(this->Exchange, 1) || !links->SetVector(0, ones.data()) ||
    !links->Multiply(1, 0) || !links->GetVector(1, this->RowSums.data()))
  {
    return false;
  }
  std::transform(this->RowSums.begin(), this->RowSums.end(), areas.begin(), this->RowSums.begin(),
    std::divides<double>());
  return true;
}

namespace
{
//------------------------------------------------------------------------------
// Where the rays of a patch go that meet no front: into the sky or onto back faces.
struct Openings
{
  const vtkPatchScene& Scene;
  const vtkSceneRayCaster& Caster;
  double* Sky;
  double* Back;

  void operator()(vtkIdType begin, vtkIdType end) const
  {
    for (vtkIdType patch = begin; patch < end; ++patch)
    {
      const vtkPatchSampler sampler(static_cast<std::uint64_t>(patch));
      vtkPolygonExchange::Polygon polygon;
      vtkPolygonExchange::MakePolygon(this->Scene, patch, polygon);
      int sky = 0;
      int back = 0;
      for (int ray = 0; ray < OpeningRays; ++ray)
      {
        bool front = false;
        const vtkIdType hit = this->Caster.FindHit(sampler.GetPoint(polygon, ray, 0),
          sampler.GetDirection(polygon.Normal, ray, 2), patch, front);
        sky += hit < 0 ? 1 : 0;
        back += hit >= 0 && !front ? 1 : 0;
      }
      this->Sky[patch] = static_cast<double>(sky) / OpeningRays;
      this->Back[patch] = static_cast<double>(back) / OpeningRays;
    }
  }
};
} // namespace

//------------------------------------------------------------------------------
bool vtkViewFactors::FindOpenings(const vtkPatchScene& scene)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  this->SkyFractions.assign(patches, 0.0);
  this->BackFaceFractions.assign(patches, 0.0);
  vtkSceneRayCaster caster;
  std::string error;
  const bool ready = caster.Build(scene, error);
  if (!vtkPatchScene::Agree(this->Controller, ready, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  Openings openings{ scene, caster, this->SkyFractions.data(), this->BackFaceFractions.data() };
  vtkTransportThreads::For(0, patches, 64, openings);
  // Rays only tell how the missing part divides; how much is missing the row sum knows better.
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    const double both = this->SkyFractions[patch] + this->BackFaceFractions[patch];
    const double missing = std::max(0.0, 1.0 - this->RowSums[patch]);
    const double scale = both > 0.0 ? missing / both : 0.0;
    this->SkyFractions[patch] *= scale;
    this->BackFaceFractions[patch] *= scale;
  }
  return true;
}

//------------------------------------------------------------------------------
// G_ij (1 + l_i + l_j) with the smallest sum of (change)^2 / G_ij that gives closed rows their sum:
// (D + G) l = A - row sums, where D is the diagonal of row sums; D + G is positive semi-definite,
// so conjugate gradients solve it.
bool vtkViewFactors::CloseRows()
{
  const std::vector<double>& areas = this->Exchange->GetAreas();
  const auto patches = static_cast<Eigen::Index>(areas.size());
  using Map = Eigen::Map<const Eigen::ArrayXd>;
  const Eigen::ArrayXd sums = Map(this->RowSums.data(), patches) * Map(areas.data(), patches);
  const Eigen::ArrayXd closed =
    (Map(this->SkyFractions.data(), patches) + Map(this->BackFaceFractions.data(), patches) == 0.0)
      .cast<double>();
  vtkNew<vtkDenseLinkOperator> links;
  links->SetController(this->Controller);
  links->Initialize(this->Exchange, 1);
  const auto apply = [&](const Eigen::ArrayXd& x)
  {
    Eigen::ArrayXd product(patches);
    links->SetVector(0, x.data());
    links->Multiply(1, 0);
    links->GetVector(1, product.data());
    return Eigen::ArrayXd(closed * (product + sums * x));
  };
  Eigen::ArrayXd change = Eigen::ArrayXd::Zero(patches);
  Eigen::ArrayXd residual = closed * (Map(areas.data(), patches) - sums);
  Eigen::ArrayXd direction = residual;
  const double goal = 1e-24 * (Map(areas.data(), patches) * Map(areas.data(), patches)).sum();
  double squared = (residual * residual).sum();
  for (int iteration = 0; iteration < 200 && squared > goal; ++iteration)
  {
    const Eigen::ArrayXd image = apply(direction);
    const double curvature = (direction * image).sum();
    if (!(curvature > 0.0))
    {
      break;
    }
    change += squared / curvature * direction;
    residual -= squared / curvature * image;
    const double next = (residual * residual).sum();
    direction = residual + next / squared * direction;
    squared = next;
  }
  constexpr int N = vtkExchangeMatrix::TileSize;
  for (vtkExchangeMatrix::Tile& tile : this->Exchange->GetTiles())
  {
    for (int row = 0; row < N && tile.Row * N + row < patches; ++row)
    {
      for (int column = 0; column < N && tile.Column * N + column < patches; ++column)
      {
        const double factor = 1.0 + change[tile.Row * N + row] + change[tile.Column * N + column];
        tile.Values[row * N + column] *= static_cast<float>(std::max(0.0, factor));
      }
    }
  }
  if (!this->SumRows())
  {
    return false;
  }
  this->ClosureChange =
    (Map(this->RowSums.data(), patches) - Map(this->RawRowSums.data(), patches)).abs().maxCoeff();
  return true;
}

//------------------------------------------------------------------------------
vtkExchangeMatrix* vtkViewFactors::GetExchange()
{
  return this->Exchange;
}

//------------------------------------------------------------------------------
double vtkViewFactors::GetViewFactor(vtkIdType i, vtkIdType j)
{
  const vtkIdType patches = this->Exchange ? this->Exchange->GetNumberOfPatches() : 0;
  if (i < 0 || j < 0 || i >= patches || j >= patches)
  {
    return 0.0;
  }
  const vtkIdType row = this->Patches[i];
  return this->Exchange->GetValue(row, this->Patches[j]) / this->Exchange->GetAreas()[row];
}

//------------------------------------------------------------------------------
void vtkViewFactors::AddSummaries(vtkFieldData* fields) const
{
  AddSummary(fields, "PairsExamined", this->PairsExamined);
  AddSummary(fields, "PairsFacing", this->PairsFacing);
  AddSummary(fields, "PairsPartlyVisible", this->PairsPartlyVisible);
  AddSummary(fields, "RaysCast", this->RaysCast);
  AddSummary(fields, "ViewFactorSeconds", this->Seconds);
  AddSummary(fields, "ClosureChange", this->ClosureChange);
  AddSummary(fields, "MatrixBytes", this->Exchange->GetNumberOfBytes());
}

//------------------------------------------------------------------------------
int vtkViewFactors::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
  vtkPatchScene scene;
  std::string error;
  if (!scene.Build(input, this->Controller, error))
  {
    vtkErrorMacro(<< error);
    return 0;
  }
  this->SetProgressStage(0.0, 1.0);
  if (!this->UpdateExchange(scene, [this](double done) { return this->ReportProgress(done); }))
  {
    return 0;
  }
  output->ShallowCopy(input);
  scene.AddCellArray(output, "ViewFactorSum", this->RawRowSums, 1);
  scene.AddCellArray(output, "ViewFactorError", this->RowErrors, 1);
  scene.AddCellArray(output, "SkyFraction", this->SkyFractions, 1);
  scene.AddCellArray(output, "BackFaceFraction", this->BackFaceFractions, 1);
  this->AddSummaries(output->GetFieldData());
  return 1;
}

//------------------------------------------------------------------------------
void vtkViewFactors::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfRays: " << this->MaximumNumberOfRays << "\n";
  os << indent << "EnforceClosure: " << this->EnforceClosure << "\n";
  os << indent << "PairsExamined: " << this->PairsExamined << "\n";
  os << indent << "PairsFacing: " << this->PairsFacing << "\n";
  os << indent << "PairsPartlyVisible: " << this->PairsPartlyVisible << "\n";
  os << indent << "RaysCast: " << this->RaysCast << "\n";
  os << indent << "ClosureChange: " << this->ClosureChange << "\n";
}
