// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlainRays.h"

#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace
{
constexpr int Width = 16;
// Of the scene's diagonal.
constexpr double OffsetPart = 1e-6;
// Lamps of less than this part of the area cast this many rays more, by those of all patches.
constexpr double SmallLamp = 0.1;
constexpr double LampRays = 0.25;
// Digits of a direction's coordinates that the order of the points goes by.
constexpr int SortedDigits = 5;
// The iteration's part of the error.
constexpr double IterationError = 1e-4;

//------------------------------------------------------------------------------
// Sobol' points by the direction numbers of Joe and Kuo (2008).
std::array<std::uint32_t, 4> MakePoint(std::uint32_t index)
{
  constexpr std::uint32_t first[4][4] = { { 0x80000000u }, { 0x80000000u },
    { 0x80000000u, 0xC0000000u }, { 0x80000000u, 0xC0000000u, 0x20000000u } };
  std::array<std::uint32_t, 4> point{};
  for (int dimension = 0; dimension < 4; ++dimension)
  {
    std::uint32_t numbers[32];
    for (int bit = 0; bit < 32; ++bit)
    {
      if (dimension == 0)
      {
        numbers[bit] = 0x80000000u >> bit;
      }
      else if (bit < dimension)
      {
        numbers[bit] = first[dimension][bit];
      }
      else
      {
        // x + 1, x^2 + x + 1 and x^3 + x + 1.
        const std::uint32_t last = numbers[bit - dimension];
        numbers[bit] =
          last ^ last >> dimension ^ (dimension == 1 ? 0u : numbers[bit - dimension + 1]);
      }
      point[dimension] ^= index >> bit & 1u ? numbers[bit] : 0u;
    }
  }
  return point;
}

//------------------------------------------------------------------------------
// Cells of the square of directions one after the other, in Morton's order.
std::uint32_t GetCell(const std::array<std::uint32_t, 4>& point)
{
  std::uint32_t cell = 0;
  for (int digit = 0; digit < SortedDigits; ++digit)
  {
    cell = cell << 2 | (point[0] >> (31 - digit) & 1u) << 1 | (point[1] >> (31 - digit) & 1u);
  }
  return cell;
}

//------------------------------------------------------------------------------
std::uint32_t Hash(std::uint32_t x)
{
  x = (x ^ x >> 16) * 0x7FEB352Du;
  x = (x ^ x >> 15) * 0x846CA68Bu;
  return x ^ x >> 16;
}

//------------------------------------------------------------------------------
// Cosine and sine of u turns by polynomials that become vector instructions.
inline void Turn(float u, float& cosine, float& sine)
{
  const float quarters = std::floor(4.0f * u + 0.5f);
  const auto quarter = static_cast<int>(quarters);
  const float x = 6.2831853f * (u - 0.25f * quarters);
  const float y = x * x;
  const float c = 1.0f + y * (-0.5f + y * (0.041666638f + y * (-0.0013888397f + y * 2.4760e-5f)));
  const float s = x * (1.0f + y * (-0.16666667f + y * (0.0083333310f + y * -0.00019839335f)));
  const float first = quarter & 1 ? s : c;
  const float second = quarter & 1 ? c : s;
  cosine = (quarter + 1) & 2 ? -first : first;
  sine = quarter & 2 ? -second : second;
}
} // end of anonymous namespace

//------------------------------------------------------------------------------
struct PlainRays::Packet
{
  RTCRayHit16 Rays;
  int Valid[Width];

  Packet()
  {
    std::memset(&this->Rays, 0, sizeof(this->Rays));
    std::fill_n(this->Valid, Width, -1);
    std::fill_n(this->Rays.ray.mask, Width, ~0u);
  }

  // Points to rays, all at once.
  void Set(const Patch& patch, const std::array<std::uint32_t, 4>* points,
    const std::uint32_t* flips, float offset)
  {
    RTCRay16& ray = this->Rays.ray;
    float* const origin[3] = { ray.org_x, ray.org_y, ray.org_z };
    float* const direction[3] = { ray.dir_x, ray.dir_y, ray.dir_z };
    float u[4][Width];
    for (int k = 0; k < Width; ++k)
    {
      for (int dimension = 0; dimension < 4; ++dimension)
      {
        const std::uint32_t digits = points[k][dimension] ^ flips[dimension];
        u[dimension][k] = (static_cast<float>(digits >> 9) + 0.5f) * 0x1p-23f;
      }
    }
    for (int k = 0; k < Width; ++k)
    {
      const bool folds = patch.IsTriangle && u[2][k] + u[3][k] > 1.0f;
      const float a = folds ? 1.0f - u[2][k] : u[2][k];
      const float b = folds ? 1.0f - u[3][k] : u[3][k];
      float cosine, sine;
      Turn(u[1][k], cosine, sine);
      const float radius = std::sqrt(u[0][k]);
      const float height = std::sqrt(1.0f - u[0][k]);
      for (int axis = 0; axis < 3; ++axis)
      {
        direction[axis][k] =
          radius * (cosine * patch.Frame[0][axis] + sine * patch.Frame[1][axis]) +
          height * patch.Frame[2][axis];
        origin[axis][k] = patch.Corner[axis] + a * patch.Edges[0][axis] + b * patch.Edges[1][axis] +
          offset * patch.Frame[2][axis];
      }
    }
    std::fill_n(ray.tfar, Width, std::numeric_limits<float>::infinity());
    std::fill_n(this->Rays.hit.geomID, Width, RTC_INVALID_GEOMETRY_ID);
  }
};

//------------------------------------------------------------------------------
PlainRays::PlainRays(vtkPolyData* scene)
{
  double bounds[6];
  scene->GetBounds(bounds);
  this->Offset = static_cast<float>(OffsetPart * scene->GetLength());
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < scene->GetNumberOfCells(); ++cell)
  {
    scene->GetCellPoints(cell, ids);
    std::vector<std::array<double, 3>> corners(ids->GetNumberOfIds());
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      scene->GetPoint(ids->GetId(static_cast<vtkIdType>(k)), corners[k].data());
      for (int axis = 0; axis < 3; ++axis)
      {
        corners[k][axis] -= bounds[2 * axis];
      }
    }
    this->AddPatch(corners);
  }
  this->BuildTree();
}

//------------------------------------------------------------------------------
PlainRays::~PlainRays()
{
  rtcReleaseScene(this->Tree);
  rtcReleaseDevice(this->Device);
}

//------------------------------------------------------------------------------
void PlainRays::AddPatch(const std::vector<std::array<double, 3>>& corners)
{
  double edges[2][3], frame[3][3];
  vtkMath::Subtract(corners[1].data(), corners[0].data(), edges[0]);
  vtkMath::Subtract(corners.back().data(), corners[0].data(), edges[1]);
  vtkMath::Cross(edges[0], edges[1], frame[2]);
  const double area = vtkMath::Normalize(frame[2]);
  vtkMath::Perpendiculars(frame[2], frame[0], frame[1], 0.0);
  Patch patch;
  for (int axis = 0; axis < 3; ++axis)
  {
    patch.Corner[axis] = static_cast<float>(corners[0][axis]);
    for (int k = 0; k < 3; ++k)
    {
      patch.Frame[k][axis] = static_cast<float>(frame[k][axis]);
      patch.Edges[k % 2][axis] = static_cast<float>(edges[k % 2][axis]);
    }
  }
  patch.IsTriangle = corners.size() == 3;
  patch.Area = static_cast<float>(patch.IsTriangle ? 0.5 * area : area);
  this->Patches.push_back(patch);
}

//------------------------------------------------------------------------------
// Quadrilaterals, of which triangles are a special case.
void PlainRays::BuildTree()
{
  this->Device = rtcNewDevice("threads=1");
  this->Tree = rtcNewScene(this->Device);
  const std::size_t patches = this->Patches.size();
  RTCGeometry geometry = rtcNewGeometry(this->Device, RTC_GEOMETRY_TYPE_QUAD);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
    RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * patches));
  auto* quads = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX,
    0, RTC_FORMAT_UINT4, 4 * sizeof(std::uint32_t), patches));
  for (std::size_t index = 0; index < patches; ++index)
  {
    const Patch& patch = this->Patches[index];
    for (std::uint32_t corner = 0; corner < 4; ++corner)
    {
      const bool isLast = patch.IsTriangle && corner == 3;
      const auto point = static_cast<std::uint32_t>(4 * index + (isLast ? 2 : corner));
      quads[4 * index + corner] = point;
      const bool alongFirst = corner == 1 || (corner == 2 && !patch.IsTriangle);
      for (int axis = 0; axis < 3; ++axis)
      {
        points[3 * (4 * index + corner) + axis] = patch.Corner[axis] +
          (alongFirst ? patch.Edges[0][axis] : 0.0f) + (corner >= 2 ? patch.Edges[1][axis] : 0.0f);
      }
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(this->Tree, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(this->Tree);
}

//------------------------------------------------------------------------------
// Flips of digits keep points of one cell together.
void PlainRays::MakePoints(std::uint32_t rays)
{
  this->Points.resize(rays);
  for (std::uint32_t index = 0; index < rays; ++index)
  {
    this->Points[index] = MakePoint(index);
  }
  std::sort(this->Points.begin(), this->Points.end(),
    [](const auto& a, const auto& b) { return GetCell(a) < GetCell(b); });
}

//------------------------------------------------------------------------------
// Calls visit(patch) for each front that is hit, and visit(-1) for the sky.
template <typename Visit>
void PlainRays::Cast(std::uint32_t patch, std::uint32_t rays, std::uint32_t seed,
  const Visit& visit) const
{
  std::uint32_t flips[4];
  for (std::uint32_t dimension = 0; dimension < 4; ++dimension)
  {
    flips[dimension] = Hash(Hash(seed + 4 * patch + dimension) + dimension);
  }
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
  Packet packet;
  for (std::uint32_t first = 0; first < rays; first += Width)
  {
    packet.Set(this->Patches[patch], &this->Points[first], flips, this->Offset);
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
    rtcIntersect16(packet.Valid, this->Tree, &packet.Rays, &arguments);
#else
    rtcIntersect16(packet.Valid, this->Tree, &context, &packet.Rays);
#endif
    const RTCRay16& ray = packet.Rays.ray;
    const RTCHit16& hit = packet.Rays.hit;
    for (int k = 0; k < Width; ++k)
    {
      const std::uint32_t other = hit.primID[k];
      if (hit.geomID[k] == RTC_INVALID_GEOMETRY_ID)
      {
        visit(-1);
      }
      else if (ray.dir_x[k] * this->Patches[other].Frame[2][0] +
          ray.dir_y[k] * this->Patches[other].Frame[2][1] +
          ray.dir_z[k] * this->Patches[other].Frame[2][2] <
        0.0f)
      {
        visit(static_cast<std::int64_t>(other));
      }
    }
  }
}

//------------------------------------------------------------------------------
void PlainRays::CastRows(std::uint32_t rays, std::uint32_t seed)
{
  this->Entries.clear();
  this->Begins.assign(1, 0);
  this->Sky.clear();
  const float weight = 1.0f / static_cast<float>(rays);
  std::vector<std::uint32_t> counts(this->Patches.size(), 0), touched;
  for (std::uint32_t patch = 0; patch < this->Patches.size(); ++patch)
  {
    std::uint32_t sky = 0;
    this->Cast(patch, rays, seed,
      [&](std::int64_t other)
      {
        if (other < 0)
        {
          ++sky;
        }
        else if (counts[other]++ == 0)
        {
          touched.push_back(static_cast<std::uint32_t>(other));
        }
      });
    for (const std::uint32_t other : touched)
    {
      this->Entries.push_back({ other, weight * static_cast<float>(counts[other]) });
      counts[other] = 0;
    }
    touched.clear();
    this->Begins.push_back(this->Entries.size());
    this->Sky.push_back(weight * static_cast<float>(sky));
  }
}

//------------------------------------------------------------------------------
// The irradiance that lamps send, by the counts of both ends.
void PlainRays::CastFromLamps(std::uint32_t rays, std::uint32_t seed, const Values& emission)
{
  std::vector<std::uint32_t> lamps;
  double lampArea = 0.0, sceneArea = 0.0;
  for (std::uint32_t patch = 0; patch < this->Patches.size(); ++patch)
  {
    sceneArea += this->Patches[patch].Area;
    if (emission[patch] > 0.0f)
    {
      lamps.push_back(patch);
      lampArea += this->Patches[patch].Area;
    }
  }
  this->Direct.clear();
  if (lamps.empty() || lampArea > SmallLamp * sceneArea)
  {
    return;
  }
  const double each =
    LampRays * rays * static_cast<double>(this->Patches.size()) / static_cast<double>(lamps.size());
  const std::uint32_t lampRays = Width * static_cast<std::uint32_t>(each / Width + 1.0);
  this->MakePoints(lampRays);
  // Millions of rays from a lamp are too many to be added up in single precision.
  std::vector<double> direct(this->Patches.size(), 0.0);
  const auto receive = [&](std::uint32_t lamp, std::uint32_t patch, float count)
  {
    const float area = this->Patches[patch].Area;
    const float density =
      static_cast<float>(lampRays) / this->Patches[lamp].Area + static_cast<float>(rays) / area;
    direct[patch] += emission[lamp] * count / (density * area);
  };
  for (const std::uint32_t lamp : lamps)
  {
    this->Cast(lamp, lampRays, seed,
      [&](std::int64_t patch)
      {
        if (patch >= 0)
        {
          receive(lamp, static_cast<std::uint32_t>(patch), 1.0f);
        }
      });
  }
  for (std::uint32_t patch = 0; patch < this->Patches.size(); ++patch)
  {
    for (std::size_t k = this->Begins[patch]; k < this->Begins[patch + 1]; ++k)
    {
      const Entry& entry = this->Entries[k];
      if (emission[entry.Patch] > 0.0f)
      {
        receive(entry.Patch, patch, entry.Weight * static_cast<float>(rays));
      }
    }
  }
  this->Direct.assign(direct.begin(), direct.end());
}

//------------------------------------------------------------------------------
PlainRays::Values PlainRays::Gather(const Values& sent) const
{
  Values received(this->Patches.size());
  for (std::size_t patch = 0; patch < received.size(); ++patch)
  {
    float sum = 0.0f;
    for (std::size_t k = this->Begins[patch]; k < this->Begins[patch + 1]; ++k)
    {
      sum += this->Entries[k].Weight * sent[this->Entries[k].Patch];
    }
    received[patch] = sum;
  }
  return received;
}

//------------------------------------------------------------------------------
PlainRays::Values PlainRays::Solve(std::uint32_t rays, std::uint32_t seed, const Values& emission,
  const Values& reflectance, float sky)
{
  this->MakePoints(rays);
  this->CastRows(rays, Hash(seed));
  this->CastFromLamps(rays, Hash(seed + 1), emission);
  // What comes first; then what is reflected, until the rest can be left out.
  const std::size_t patches = this->Patches.size();
  const Values first = this->Direct.empty() ? this->Gather(emission) : this->Direct;
  Values source(patches), sent;
  for (std::size_t k = 0; k < patches; ++k)
  {
    source[k] = reflectance[k] * (first[k] + sky * this->Sky[k]);
  }
  const double largest = *std::max_element(reflectance.begin(), reflectance.end());
  const double allowed = std::pow(IterationError * std::max(1.0 - largest, 1e-6), 2);
  sent = source;
  for (double change = 1.0, whole = 0.0; change > allowed * whole;)
  {
    const Values received = this->Gather(sent);
    change = whole = 0.0;
    for (std::size_t k = 0; k < patches; ++k)
    {
      const float value = source[k] + reflectance[k] * received[k];
      change += this->Patches[k].Area * std::pow(value - sent[k], 2);
      whole += this->Patches[k].Area * std::pow(value, 2);
      sent[k] = value;
    }
  }
  std::transform(sent.begin(), sent.end(), emission.begin(), sent.begin(), std::plus<float>());
  return sent;
}
