// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The exchange of pairs of triangles of many kinds against an independent slow integration, of
// blocks against pairs, and of plates and closed boxes against exact values.

#include "LightTransportTesting.h"
#include "OutcomeTesting.h"
#include "Scene/PatchTree.h"
#include "ViewFactors/UnoccludedPairs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <sstream>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
using Vector = Eigen::Vector3d;
using Corners = std::vector<Vector>;

//------------------------------------------------------------------------------
// The same numbers on every platform.
class Random
{
public:
  explicit Random(std::uint64_t seed) : State(seed) {}
  double Uniform()
  {
    this->State = this->State * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>((this->State ^ this->State >> 29) >> 11 & 0xFFFFFFFFFFull) /
      static_cast<double>(0x10000000000ull);
  }
  double Uniform(double low, double high) { return low + (high - low) * this->Uniform(); }
  double Logarithmic(double low, double high)
  {
    return low * std::pow(high / low, this->Uniform());
  }
  Vector Direction()
  {
    const double z = this->Uniform(-1.0, 1.0);
    const double angle = this->Uniform(0.0, 2.0 * vtkMath::Pi());
    const double r = std::sqrt(1.0 - z * z);
    return { r * std::cos(angle), r * std::sin(angle), z };
  }
  Vector Point() { return { this->Uniform(-1, 1), this->Uniform(-1, 1), this->Uniform(-1, 1) }; }
  Eigen::Quaterniond Rotation()
  {
    return Eigen::Quaterniond(Eigen::AngleAxisd(this->Uniform(0.0, 6.0), this->Direction()));
  }
  /// In the plane z = 0, longest edge about `size`, `aspect` times longer than high.
  Corners Triangle(double size, double aspect)
  {
    return { { 0, 0, 0 }, { size, 0, 0 },
      { size * this->Uniform(0.1, 0.9), size * this->Uniform(0.5, 1.0) / aspect, 0 } };
  }

private:
  std::uint64_t State;
};

//------------------------------------------------------------------------------
Corners Transform(const Corners& corners, const Eigen::Quaterniond& rotation, const Vector& shift)
{
  Corners result;
  for (const Vector& corner : corners)
  {
    result.push_back(rotation * corner + shift);
  }
  return result;
}

//------------------------------------------------------------------------------
Corners Flip(const Corners& corners)
{
  return Corners(corners.rbegin(), corners.rend());
}

//------------------------------------------------------------------------------
Vector GetNormal(const Corners& corners)
{
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
}

//------------------------------------------------------------------------------
Vector GetCentroid(const Corners& corners)
{
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

//------------------------------------------------------------------------------
double GetArea(const Corners& corners)
{
  return 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
}

//------------------------------------------------------------------------------
// The slow reference: over one triangle (what of it is in front of the other) the exact factor of a
// point to what the point sees of the other, clipped point by point, by Gauss rules with 3 x 3
// points in collapsed coordinates on triangles cut into four until nothing changes.
class Reference
{
public:
  // Around a corner of the outer triangle: points of a small one would lose digits far from zero.
  Reference(const Corners& outer, const Corners& inner)
    : OuterNormal(GetNormal(outer)), Outer(Cut(outer, inner[0], GetNormal(inner), outer[0])),
      Visible(Cut(inner, outer[0], this->OuterNormal, outer[0]))
  {
  }

  double Integrate(double tolerance)
  {
    double sum = 0.0;
    for (std::size_t corner = 1; corner + 1 < this->Outer.size() && this->Visible.size() > 2;
         ++corner)
    {
      const Corners part{ this->Outer[0], this->Outer[corner], this->Outer[corner + 1] };
      sum += this->Refine(part, this->IntegrateTriangle(part), tolerance, 0);
    }
    return sum;
  }

private:
  static Corners Cut(const Corners& polygon, const Vector& on, const Vector& normal,
    const Vector& origin)
  {
    Corners front;
    for (std::size_t corner = 0; corner < polygon.size(); ++corner)
    {
      const Vector& from = polygon[corner];
      const Vector& to = polygon[(corner + 1) % polygon.size()];
      const double heightFrom = (from - on).dot(normal);
      const double heightTo = (to - on).dot(normal);
      if (heightFrom >= 0.0)
      {
        front.push_back(from - origin);
      }
      if (heightFrom * heightTo < 0.0)
      {
        front.push_back(from - origin + heightFrom / (heightFrom - heightTo) * (to - from));
      }
    }
    return front;
  }

  double GetFactor(const Vector& x) const
  {
    double sum = 0.0;
    for (std::size_t corner = 0; corner < this->Visible.size(); ++corner)
    {
      const Vector from = this->Visible[corner] - x;
      const Vector to = this->Visible[(corner + 1) % this->Visible.size()] - x;
      const Vector normal = from.cross(to);
      const double sine = normal.norm();
      sum -=
        sine > 0.0 ? std::atan2(sine, from.dot(to)) * normal.dot(this->OuterNormal) / sine : 0.0;
    }
    return sum / (2.0 * vtkMath::Pi());
  }

  double IntegrateTriangle(const Corners& triangle) const
  {
    static const double nodes[4] = { 0.069431844202973712, 0.330009478207571868,
      0.669990521792428132, 0.930568155797026288 };
    static const double weights[4] = { 0.173927422568726929, 0.326072577431273071,
      0.326072577431273071, 0.173927422568726929 };
    double sum = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      const Vector left = triangle[0] + nodes[i] * (triangle[1] - triangle[0]);
      const Vector right = triangle[0] + nodes[i] * (triangle[2] - triangle[0]);
      for (int j = 0; j < 4; ++j)
      {
        sum += weights[i] * weights[j] * 2.0 * nodes[i] *
          this->GetFactor(left + nodes[j] * (right - left));
      }
    }
    return sum * GetArea(triangle);
  }

  double Refine(const Corners& triangle, double whole, double tolerance, int depth) const
  {
    const Vector ab = 0.5 * (triangle[0] + triangle[1]);
    const Vector bc = 0.5 * (triangle[1] + triangle[2]);
    const Vector ca = 0.5 * (triangle[2] + triangle[0]);
    const Corners parts[4] = { { triangle[0], ab, ca }, { ab, triangle[1], bc },
      { ca, bc, triangle[2] }, { bc, ca, ab } };
    double values[4];
    double sum = 0.0;
    for (int part = 0; part < 4; ++part)
    {
      values[part] = this->IntegrateTriangle(parts[part]);
      sum += values[part];
    }
    if ((std::abs(sum - whole) <= tolerance && depth > 1) || depth == 24)
    {
      return sum;
    }
    sum = 0.0;
    for (int part = 0; part < 4; ++part)
    {
      sum += this->Refine(parts[part], values[part], 0.5 * tolerance, depth + 1);
    }
    return sum;
  }

  Vector OuterNormal;
  Corners Outer;
  Corners Visible;
};

//------------------------------------------------------------------------------
enum Kind
{
  Far,
  Near,
  Corner,
  SharedEdge,
  PartOfEdge,
  Crossing,
  Sliver,
  Ratio,
  Parallel,
  Coplanar,
  BackFacing,
  NumberOfKinds
};
const char* const KindNames[NumberOfKinds] = { "far", "near", "corner", "shared edge",
  "part of an edge", "crossing", "sliver", "ratio", "parallel", "coplanar", "back-facing" };

struct TrianglePair
{
  Corners A;
  Corners B;
};

//------------------------------------------------------------------------------
// Turned so that they face each other, more or less.
TrianglePair Face(const Corners& a, const Corners& b)
{
  const Vector between = GetCentroid(b) - GetCentroid(a);
  return { between.dot(GetNormal(a)) < 0.0 ? Flip(a) : a,
    between.dot(GetNormal(b)) > 0.0 ? Flip(b) : b };
}

//------------------------------------------------------------------------------
// Triangles that meet at the origin, with the given dihedral angle around the x axis.
TrianglePair Meet(Random& random, Kind kind)
{
  const Corners a{ { 0, 0, 0 }, { 1, 0, 0 },
    { random.Uniform(-0.5, 1.5), random.Uniform(0.2, 1), 0 } };
  const double angle = random.Uniform(0.05, 0.95) * vtkMath::Pi();
  double begin = 0.0;
  double end = 1.0;
  if (kind == PartOfEdge)
  {
    begin = random.Uniform(-0.5, 0.8);
    end = begin + random.Logarithmic(0.01, 1.0);
  }
  const double height = random.Uniform(0.2, 1);
  const Corners b{ { end, 0, 0 }, { begin, 0, 0 },
    { random.Uniform(-0.5, 1.5), height * std::cos(angle), height * std::sin(angle) } };
  TrianglePair pair{ a, b };
  if (kind == Corner)
  {
    pair.B[0] = random.Point();
    pair.B[2] = random.Point();
    pair.B[1] = a[0];
  }
  return kind == Corner ? Face(pair.A, pair.B) : pair;
}

//------------------------------------------------------------------------------
TrianglePair MakePair(Random& random, Kind kind)
{
  const Corners a = random.Triangle(1.0, random.Logarithmic(1.0, 5.0));
  const Corners b = random.Triangle(random.Logarithmic(0.3, 1.0), random.Logarithmic(1.0, 5.0));
  const Eigen::Quaterniond turn = random.Rotation();
  switch (kind)
  {
    case Far:
      return Face(a, Transform(b, turn, random.Logarithmic(4.0, 100.0) * random.Direction()));
    case Near:
      return Face(a, Transform(b, turn, random.Uniform(1.2, 3.0) * random.Direction()));
    case Crossing:
      return Face(a, Transform(b, turn, { random.Uniform(1.0, 2.5), random.Uniform(-1, 1), 0.0 }));
    case Sliver:
      return Face(random.Triangle(1.0, 1e4),
        Transform(b, turn, random.Uniform(0.5, 2.0) * random.Direction()));
    case Ratio:
      return Face(a,
        Transform(random.Triangle(1e-6, 2.0), turn,
          { random.Uniform(0.2, 0.8), random.Uniform(0.0, 0.3), random.Logarithmic(2e-6, 1.0) }));
    case Parallel:
    {
      const Eigen::Quaterniond tilt(
        Eigen::AngleAxisd(random.Logarithmic(1e-9, 1e-2), random.Direction()));
      return Face(a, Transform(b, tilt, { 0.2, 0.0, random.Logarithmic(0.02, 1.0) }));
    }
    case Coplanar:
      return { Transform(a, turn, Vector::Zero()),
        Transform(b, turn, turn * Vector(random.Uniform(-2, 2), random.Uniform(-2, 2), 0)) };
    case BackFacing:
    {
      const Corners above = Transform(b, turn, { 0, 0, random.Uniform(1.2, 3.0) });
      return { Flip(a), above };
    }
    default:
      return Meet(random, kind);
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSurface(const std::vector<Corners>& polygons)
{
  Surface surface;
  for (const Corners& corners : polygons)
  {
    std::vector<Point> points;
    for (const Vector& corner : corners)
    {
      points.push_back({ corner.x(), corner.y(), corner.z() });
    }
    surface.AddPolygon(points);
  }
  return surface.Get();
}

//------------------------------------------------------------------------------
bool Build(PatchScene& scene, const std::vector<Corners>& polygons)
{
  return CheckDone(scene.Build(MakeSurface(polygons), Ranks()), "scene");
}

//------------------------------------------------------------------------------
Corners GetPatch(const PatchScene& scene, vtkIdType patch)
{
  Corners corners;
  for (int corner = 0; corner < scene.GetNumberOfCorners(patch); ++corner)
  {
    corners.push_back(scene.GetCorner(patch, corner));
  }
  return corners;
}

//------------------------------------------------------------------------------
void TestReference()
{
  const Corners lower{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  const Corners upper{ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } };
  const Corners wall{ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } };
  CheckClose(Reference(lower, upper).Integrate(1e-12), 0.199824895698387, 1e-11, "the reference");
  CheckClose(Reference(lower, wall).Integrate(1e-12), 0.200043776075403, 1e-11, "the reference");
}

//------------------------------------------------------------------------------
void TestPairs(Kind kind, int count)
{
  Random random(kind + 1);
  int facing = 0;
  for (int trial = 0; trial < count; ++trial)
  {
    const TrianglePair pair = MakePair(random, kind);
    PatchScene scene;
    if (!Build(scene, { pair.A, pair.B }))
    {
      return;
    }
    if (scene.GetAreas().size() < 2)
    {
      continue; // one lies on the other
    }
    const double tolerance = std::pow(10.0, -2.0 * (trial % 5 + 1));
    const PairIntegrals::Estimate result = UnoccludedPairs(scene, tolerance).Compute(0, 1);
    const bool swap = scene.GetAreas()[0] > scene.GetAreas()[1];
    const double smaller = scene.GetAreas()[swap ? 1 : 0];
    const Corners a = GetPatch(scene, swap ? 1 : 0);
    const Corners b = GetPatch(scene, swap ? 0 : 1);
    const bool none = kind == Coplanar || kind == BackFacing;
    const double aim = (1e-12 + 1e-7 * tolerance) * smaller;
    const double value = none ? 0.0 : Reference(a, b).Integrate(aim);
    if (trial % 10 == 0 && !none && kind != Ratio)
    {
      // The two ways round have nothing in common.
      const double back = Reference(b, a).Integrate(aim);
      Check(std::abs(value - back) <= 30.0 * aim, "the reference agrees with itself");
    }
    const double error = std::abs(result.Value - value);
    std::ostringstream what;
    what << KindNames[kind] << " pair " << trial << ", tolerance " << tolerance << ": "
         << result.Value / smaller << " (bound " << result.Error / smaller << ") instead of "
         << value / smaller << ", off by " << error / smaller;
    Check(error <= result.Error + 30.0 * aim, what.str());
    Check(result.Error <= tolerance * smaller, what.str() + ": asked for less");
    Check(result.Value >= 0.0 && result.Value <= smaller, what.str() + ": not between 0 and 1");
    facing += result.Value > 1e-12 * smaller ? 1 : 0;
  }
  const bool expected = kind != Coplanar && kind != BackFacing;
  Check(expected ? facing > count / 2 : facing == 0,
    std::string("facing pairs: ") + KindNames[kind]);
}

//------------------------------------------------------------------------------
// Polygons of 3 to 5 corners in all directions, some in common planes.
std::vector<Corners> MakeSoup(int count)
{
  Random random(99);
  std::vector<Corners> soup;
  for (int index = 0; index < count; ++index)
  {
    const int sides = index % 10 == 0 ? 5 : (index % 3 == 0 ? 4 : 3);
    const double size = random.Logarithmic(0.005, 0.1);
    Corners corners;
    for (int side = 0; side < sides; ++side)
    {
      const double angle = 2.0 * vtkMath::Pi() * (side + random.Uniform(0.0, 0.4)) / sides;
      corners.push_back({ size * std::cos(angle), size * std::sin(angle), 0.0 });
    }
    const bool floor = index % 4 == 0;
    Vector place = random.Point();
    place.z() = floor ? -1.0 : place.z();
    soup.push_back(
      Transform(corners, floor ? Eigen::Quaterniond::Identity() : random.Rotation(), place));
  }
  return soup;
}

struct Matrix
{
  std::vector<float> Values; ///< above the diagonal
  std::vector<double> Errors;
  UnoccludedPairs::Counters Counters;
};

//------------------------------------------------------------------------------
Matrix FillAll(const PatchScene& scene, double tolerance)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  const UnoccludedPairs exchange(scene, tolerance);
  Matrix matrix;
  matrix.Values.resize(patches * patches, 0.0f);
  matrix.Errors.resize(patches, 0.0);
  constexpr vtkIdType size = PatchTree::BlockSize;
  for (vtkIdType i = 0; i < patches; i += size)
  {
    for (vtkIdType j = i; j < patches; j += size)
    {
      const int nodeI = scene.GetTree().GetBlock(i / size);
      const int nodeJ = scene.GetTree().GetBlock(j / size);
      exchange.Fill(nodeI, nodeJ, &matrix.Values[i * patches + j], patches, &matrix.Errors[i],
        &matrix.Errors[j], matrix.Counters);
    }
  }
  return matrix;
}

//------------------------------------------------------------------------------
void TestBlocks()
{
  PatchScene scene;
  if (!Build(scene, MakeSoup(700)))
  {
    return;
  }
  const vtkIdType patches = scene.GetNumberOfPatches();
  const UnoccludedPairs exact(scene, 1e-9);
  for (const double tolerance : { 1e-2, 1e-4, 1e-6 })
  {
    const Matrix matrix = FillAll(scene, tolerance);
    std::vector<double> errors(patches, 0.0);
    for (vtkIdType i = 0; i < patches; ++i)
    {
      for (vtkIdType j = i + 1; j < patches; ++j)
      {
        const double value = exact.Compute(i, j).Value;
        const double error =
          std::max(0.0, std::abs(matrix.Values[i * patches + j] - value) - 6e-8 * value);
        errors[i] += error;
        errors[j] += error;
      }
    }
    double worst = 0.0;
    double largest = 0.0;
    for (vtkIdType i = 0; i < patches; ++i)
    {
      worst = std::max(worst, errors[i] / (matrix.Errors[i] + 1e-9 * scene.GetAreas()[i]));
      largest = std::max(largest, matrix.Errors[i] / scene.GetAreas()[i]);
    }
    Check(worst <= 1.0, "errors of blocks are within their bounds: " + std::to_string(worst));
    Check(worst > 0.0 && largest <= tolerance, "bounds of blocks are within the tolerance");
    const UnoccludedPairs::Counters& counters = matrix.Counters;
    Check(counters.Examined == 0.5 * static_cast<double>(patches * (patches - 1)),
      "pairs examined");
    Check(counters.BackFacing + counters.Facing == counters.Examined, "pairs facing or not");
    Check(counters.Rules + counters.Contours == counters.Facing, "pairs by rules or contours");
    Check(counters.Contours > 0.0 && counters.Contours < 0.1 * counters.Facing, "contours");
  }
}

//------------------------------------------------------------------------------
// A unit square of 2 n^2 triangles, in a frame that is not along the axes.
void AddPlate(std::vector<Corners>& polygons, const Vector& origin, const Vector& u,
  const Vector& v, int n)
{
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized()));
  const auto at = [&](int i, int j) { return Vector(turn * (origin + u * i / n + v * j / n)); };
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      polygons.push_back({ at(i, j), at(i + 1, j), at(i + 1, j + 1) });
      polygons.push_back({ at(i, j), at(i + 1, j + 1), at(i, j + 1) });
    }
  }
}

//------------------------------------------------------------------------------
// What certainly does not face has no exchange.
void TestMayFace()
{
  std::vector<Corners> polygons = MakeSoup(100);
  AddPlate(polygons, Vector::Zero(), Vector::UnitX(), Vector::UnitY(), 7);
  AddPlate(polygons, Vector::Zero(), Vector::UnitY(), Vector::UnitZ(), 7);
  PatchScene scene;
  if (!Build(scene, polygons))
  {
    return;
  }
  const UnoccludedPairs exchange(scene, 1e-6);
  const std::vector<PatchTree::Node>& nodes = scene.GetTree().GetNodes();
  int apart = 0;
  for (int a = 0; a < static_cast<int>(nodes.size()); ++a)
  {
    for (int b = a; b < static_cast<int>(nodes.size()); ++b)
    {
      if (exchange.MayFace(a, b))
      {
        continue;
      }
      ++apart;
      double sum = 0.0;
      for (vtkIdType i = nodes[a].First; i < nodes[a].Last; ++i)
      {
        for (vtkIdType j = nodes[b].First; j < nodes[b].Last; ++j)
        {
          sum += i == j ? 0.0 : exchange.Compute(i, j).Value;
        }
      }
      Check(sum <= 1e-20, "nodes that do not face each other: " + std::to_string(sum));
    }
  }
  Check(apart > 500, "nodes that do not face each other: " + std::to_string(apart));
}

//------------------------------------------------------------------------------
void TestPlates(const Vector& origin, const Vector& u, const Vector& v, double expected)
{
  for (const int n : { 3, 7, 15 })
  {
    std::vector<Corners> polygons;
    AddPlate(polygons, Vector::Zero(), Vector::UnitX(), Vector::UnitY(), n);
    AddPlate(polygons, origin, u, v, n - 1);
    PatchScene scene;
    if (!Build(scene, polygons))
    {
      return;
    }
    for (const double tolerance : { 1e-3, 1e-5 })
    {
      const Matrix matrix = FillAll(scene, tolerance);
      double sum = 0.0;
      for (const float value : matrix.Values)
      {
        sum += value;
      }
      sum *= scene.GetScale() * scene.GetScale();
      CheckClose(sum, expected, 1e-3 * tolerance + 2e-8, "plates of " + std::to_string(n));
      const double facing = 4.0 * n * n * (n - 1.0) * (n - 1.0);
      Check(matrix.Counters.Facing == facing, "pairs in one plane do not face each other");
    }
  }
}

//------------------------------------------------------------------------------
void TestRoom()
{
  PatchScene scene;
  CheckDone(scene.Build(MakeRoom(8), Ranks()), "scene");
  const vtkIdType patches = scene.GetNumberOfPatches();
  // Values of 1/64 of a wall hold 6e-8 of themselves.
  for (const double tolerance : { 1e-2, 1e-4, 1e-6, 1e-10 })
  {
    const Matrix matrix = FillAll(scene, tolerance);
    const UnoccludedPairs exchange(scene, tolerance);
    for (vtkIdType i = 0; i < patches; i += 5)
    {
      double row = 0.0;
      double exact = 0.0;
      for (vtkIdType j = 0; j < patches; ++j)
      {
        row += matrix.Values[std::min(i, j) * patches + std::max(i, j)];
        exact += i == j ? 0.0 : exchange.Compute(i, j).Value;
      }
      const double area = scene.GetAreas()[i];
      CheckClose(row / area, 1.0, std::max(1e-3 * tolerance, 6e-8), "row sum of a room");
      CheckClose(exact / area, 1.0, std::max(1e-3 * tolerance, 1e-12), "row sum of a room, pairs");
      Check(matrix.Errors[i] <= tolerance * area, "bound of a room's row");
    }
  }
}

//------------------------------------------------------------------------------
// From either side the same; and down to rounding where that is asked for.
void TestReciprocity()
{
  Random random(7);
  for (int trial = 0; trial < 100; ++trial)
  {
    const TrianglePair pair = MakePair(random, static_cast<Kind>(trial % Coplanar));
    PatchScene scene;
    if (!Build(scene, { pair.A, pair.B }))
    {
      return;
    }
    const UnoccludedPairs exchange(scene, 1e-12);
    const PairIntegrals::Estimate there = exchange.Compute(0, 1);
    const PairIntegrals::Estimate back = exchange.Compute(1, 0);
    const double smaller = std::min(scene.GetAreas()[0], scene.GetAreas()[1]);
    CheckClose(there.Value, back.Value, 1e-13, "reciprocity");
    Check(there.Error <= 1e-12 * smaller,
      std::string("rounding of a pair: ") + KindNames[trial % Coplanar] + " " +
        std::to_string(there.Error / smaller * 1e12) + "e-12");
  }
}
} // namespace

int TestUnoccludedPairs(int, char*[])
{
  TestReference();
  for (int kind = 0; kind < NumberOfKinds; ++kind)
  {
    TestPairs(static_cast<Kind>(kind), 200);
  }
  TestBlocks();
  TestMayFace();
  TestPlates({ 0, 0, 1 }, Vector::UnitY(), Vector::UnitX(), 0.199824895698387);
  TestPlates({ 0, 0, 0 }, Vector::UnitY(), Vector::UnitZ(), 0.200043776075403);
  TestRoom();
  TestReciprocity();
  return Result();
}
