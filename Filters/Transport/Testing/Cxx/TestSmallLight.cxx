// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Light that is small or sharp: suns in pictures, strips of light, spots smaller than a patch,
// penumbras, all against closed forms or brute force; and what is told of the error.
#include "Geometry/SceneRayCaster.h"
#include "LightTransportTesting.h"
#include "Lighting/ShadowClipper.h"
#include "OutcomeTesting.h"
#include "vtkCallbackCommand.h"
#include "vtkDirectIrradiance.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkTestErrorObserver.h"

#include <algorithm>
#include <limits>
#include <random>

using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkLight> MakeLight(const Point& position, const Point& focus, bool positional)
{
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetPosition(position[0], position[1], position[2]);
  light->SetFocalPoint(focus[0], focus[1], focus[2]);
  light->SetPositional(positional);
  light->SetConeAngle(90.0);
  light->SetAttenuationValues(positional ? 0.0 : 1.0, 0.0, positional ? 1.0 : 0.0);
  return light;
}

//------------------------------------------------------------------------------
double GetValue(vtkDirectIrradiance* filter, const char* name = "DirectIrradiance",
  vtkIdType cell = 0)
{
  filter->Update();
  vtkDataArray* array = filter->GetPolyDataOutput()->GetCellData()->GetArray(name);
  return Check(array && array->GetNumberOfComponents() == 3, std::string(name) + " on cells")
    ? array->GetComponent(cell, 0)
    : vtkMath::Nan();
}

//------------------------------------------------------------------------------
/// The value is right within three times its error, which is what Tolerance asks for.
void CheckEstimated(vtkDirectIrradiance* filter, double right, double unshadowed,
  const std::string& what)
{
  const double value = GetValue(filter);
  const double error = GetValue(filter, "DirectIrradianceError");
  CheckClose(value - right, 0.0, 3.0 * error + 1e-3 * unshadowed, what);
  Check(error <= filter->GetTolerance() * unshadowed * 1.05, "Tolerance is kept: " + what);
}

//------------------------------------------------------------------------------
/// Moves polygons: turned, scaled, and then away from the origin.
struct Place
{
  double Turn = 0.0;
  double Scale = 1.0;
  double Offset = 0.0;
  bool Single = false;

  Point Get(const Point& p) const
  {
    const double c = std::cos(this->Turn);
    const double s = std::sin(this->Turn);
    const Point q = { c * p[0] - s * p[1], c * (s * p[0] + c * p[1]) - s * p[2],
      s * (s * p[0] + c * p[1]) + c * p[2] };
    Point moved;
    for (int axis = 0; axis < 3; ++axis)
    {
      moved[axis] = this->Scale * q[axis] + this->Offset * (axis + 1.0);
      moved[axis] = this->Single ? static_cast<float>(moved[axis]) : moved[axis];
    }
    return moved;
  }
  std::string GetName() const
  {
    return " (turned " + std::to_string(this->Turn) + ", scale " + std::to_string(this->Scale) +
      ", offset " + std::to_string(this->Offset) + (this->Single ? ", float)" : ")");
  }
};

//------------------------------------------------------------------------------
void AddRectangle(Surface& surface, const Place& place, double x0, double x1, double y0, double y1,
  double z, bool up = true)
{
  std::vector<Point> corners = { { x0, y0, z }, { x1, y0, z }, { x1, y1, z }, { x0, y1, z } };
  if (!up)
  {
    std::reverse(corners.begin(), corners.end());
  }
  for (Point& corner : corners)
  {
    corner = place.Get(corner);
  }
  surface.AddPolygon(corners);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> GetData(const Surface& surface, const Place& place)
{
  vtkSmartPointer<vtkPolyData> data = surface.Get();
  if (place.Single)
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToFloat();
    points->DeepCopy(data->GetPoints());
    data->SetPoints(points);
  }
  return data;
}

//------------------------------------------------------------------------------
std::vector<Place> GetPlaces()
{
  std::vector<Place> places;
  for (const double turn : { 0.0, 0.3, 0.77, 1.9, 2.6 })
  {
    places.push_back({ turn, 1.0, 0.0, true });
    places.push_back({ turn, 1.0, 6e5, false });
  }
  places.push_back({ 0.4, 1e-6, 0.0, false });
  places.push_back({ 0.4, 1e6, 0.0, false });
  places.push_back({ 0.4, 1.0, 6e6, false });
  return places;
}

//------------------------------------------------------------------------------
/// Slats above a unit square leave strips open: a sixth of it is lit in one, in three, in a hundred
/// strips, all of them between any few points that could be asked.
void TestStrips()
{
  for (const Place& place : GetPlaces())
  {
    for (const int strips : { 1, 3, 100 })
    {
      Surface surface;
      AddRectangle(surface, place, 0.0, 1.0, 0.0, 1.0, 0.0);
      const double period = 1.0 / strips;
      for (int k = 0; k < strips; ++k)
      {
        AddRectangle(surface, place, (k + 1.0 / 6.0) * period, (k + 1) * period, -1.0, 2.0, 0.25,
          k % 2 == 0);
      }
      vtkNew<vtkDirectIrradiance> filter;
      filter->SetInputData(GetData(surface, place));
      // From straight above: the strips are those of the slats.
      filter->AddLight(MakeLight(place.Get({ 0, 0, 1 }), place.Get({ 0, 0, 0 }), false));
      // A direction of single points is worth as much as they are.
      CheckClose(GetValue(filter), 1.0 / 6.0, place.Single || place.Offset > 1e6 ? 1e-4 : 1e-8,
        std::to_string(strips) + " strips" + place.GetName());
    }
  }
}

//------------------------------------------------------------------------------
/// Solid angle of a rectangle [x0, x1] x [y0, y1] at distance d below a point over the origin.
double GetSolidAngle(double x0, double x1, double y0, double y1, double d)
{
  const auto corner = [d](double x, double y)
  { return std::atan(x * y / (d * std::sqrt(x * x + y * y + d * d))); };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

//------------------------------------------------------------------------------
/// Irradiance of a point light times the area is the solid angle of what is lit.
void TestPointLight()
{
  for (const Place& place : GetPlaces())
  {
    const std::string name = place.GetName();
    Surface surface;
    AddRectangle(surface, place, -0.5, 0.5, -0.5, 0.5, 0.0);
    // A plate half way up casts a shadow twice as large.
    AddRectangle(surface, place, 0.01, 0.05, -0.02, 0.06, 0.5);
    vtkNew<vtkDirectIrradiance> filter;
    filter->SetInputData(GetData(surface, place));
    auto light = MakeLight(place.Get({ 0, 0, 1 }), place.Get({ 0, 0, 0 }), true);
    filter->AddLight(light);
    const double scale = place.Scale * place.Scale;
    const double right =
      GetSolidAngle(-0.5, 0.5, -0.5, 0.5, 1.0) - GetSolidAngle(0.02, 0.1, -0.04, 0.12, 1.0);
    CheckClose(scale * GetValue(filter), right, place.Single || place.Offset > 1e6 ? 1e-4 : 2e-5,
      "a plate below a point light" + name);
  }
}

//------------------------------------------------------------------------------
/// The other side of a sheet, meshed differently, does not shade it, whatever rounding makes of
/// their coordinates; a wall that stands on a patch shades it from its foot on.
void TestSheetAndWall()
{
  for (int turn = 0; turn < 20; ++turn)
  {
    for (const Place& place : { Place{ 0.31 * turn, 1.0, 0.0, true },
           Place{ 0.31 * turn, 1.0, 6e5, false }, Place{ 0.31 * turn, 1.0, 6e6, false } })
    {
      Surface surface;
      AddRectangle(surface, place, 0.0, 1.0, 0.0, 1.0, 0.0);
      for (int k = 0; k < 9; ++k)
      {
        AddRectangle(surface, place, k % 3 / 3.0, (k % 3 + 1) / 3.0, k / 3 / 3.0, (k / 3 + 1) / 3.0,
          0.0, false);
      }
      vtkNew<vtkDirectIrradiance> filter;
      filter->SetInputData(GetData(surface, place));
      filter->AddLight(MakeLight(place.Get({ -1, 0, 1 }), place.Get({ 0, 0, 0 }), false));
      CheckClose(GetValue(filter), std::sqrt(0.5), 1e-6, "the front of a sheet" + place.GetName());
      surface.AddPolygon({ place.Get({ 0.3, -1, 0 }), place.Get({ 0.3, 2, 0 }),
        place.Get({ 0.3, 2, 0.2 }), place.Get({ 0.3, -1, 0.2 }) });
      filter->SetInputData(GetData(surface, place));
      CheckClose(GetValue(filter), 0.8 * std::sqrt(0.5), 1e-5,
        "a wall on a sheet" + place.GetName());
    }
  }
}

//------------------------------------------------------------------------------
/// A lamp close to a large patch lights a small part of it very well.
void TestCloseLight()
{
  for (const double height : { 1.0, 0.1, 1e-2, 1e-3 })
  {
    Surface surface;
    AddRectangle(surface, Place(), -0.3, 0.7, -0.6, 0.4, 0.0);
    vtkNew<vtkDirectIrradiance> filter;
    filter->SetInputData(surface.Get());
    auto light = MakeLight({ 0, 0, height }, { 0, 0, 0 }, true);
    filter->AddLight(light);
    const double right = GetSolidAngle(-0.3, 0.7, -0.6, 0.4, height);
    const std::string name = " at " + std::to_string(height);
    CheckClose(GetValue(filter), right, 1e-3, "a lamp" + name);
    Check(std::abs(GetValue(filter) - right) <= GetValue(filter, "DirectIrradianceError") + 1e-12,
      "the error of a lamp" + name);
    // A spot far smaller than the patch, sharp or peaked: its flux is 2 pi (1 - cos^(e + 1)) / (e +
    // 1).
    for (const double exponent : { 0.0, 1.0, 40.0, 128.0 })
    {
      for (const double angle : { 0.2, 3.0, 16.0 })
      {
        light->SetConeAngle(angle);
        light->SetExponent(exponent);
        const double cosine = std::cos(vtkMath::RadiansFromDegrees(angle));
        CheckClose(GetValue(filter),
          2.0 * vtkMath::Pi() * (1.0 - std::pow(cosine, exponent + 1.0)) / (exponent + 1.0), 1e-3,
          "a spot of " + std::to_string(angle) + " degrees, exponent " + std::to_string(exponent) +
            name);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// A plate of many small polygons, some left out, over one large one: rays decide in part, and the
/// error is told.
void TestManyBlockers()
{
  const int n = 60;
  Surface surface;
  AddRectangle(surface, Place(), 0.0, 1.0, 0.0, 1.0, 0.0);
  double lit = 1.0;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      if ((i * i + 3 * j * j + i * j) % 7 < 5)
      {
        AddRectangle(surface, Place(), 0.1 + 0.6 * i / n, 0.1 + 0.6 * (i + 1) / n,
          0.2 + 0.7 * j / n, 0.2 + 0.7 * (j + 1) / n, 0.3);
        lit -= 0.6 * 0.7 / (n * n);
      }
    }
  }
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(surface.Get());
  filter->AddLight(MakeLight({ 0, 0, 1 }, { 0, 0, 0 }, false));
  for (const double tolerance : { 1e-2, 1e-3 })
  {
    filter->SetTolerance(tolerance);
    CheckEstimated(filter, lit, 1.0, "a perforated plate at " + std::to_string(tolerance));
  }
  Check(GetSummary(filter->GetOutput(), "DirectIrradianceRays") > 0.0, "rays help");
}

//------------------------------------------------------------------------------
/// Random sheets over a patch: what is cut out is what rays find.
void TestAgainstRays()
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  constexpr int rays = 4096;
  for (int trial = 0; trial < 40; ++trial)
  {
    Surface surface;
    AddRectangle(surface, Place(), -0.5, 0.5, -0.5, 0.5, 0.0);
    for (int sheet = 0; sheet < 2 + trial; ++sheet)
    {
      const Point at = { uniform(random), uniform(random), 0.6 * uniform(random) + 0.3 };
      Point corners[2];
      for (Point& corner : corners)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          corner[axis] = at[axis] + 0.5 * uniform(random);
        }
      }
      surface.AddPolygon({ at, corners[0], corners[1] });
    }
    LightTransport::PatchScene scene;
    LightTransport::SceneRayCaster caster;
    CheckDone(scene.Build(surface.Get(), LightTransport::Ranks()), "random sheets");
    CheckDone(caster.Build(scene), "rays through random sheets");
    const LightTransport::LitPatch patch(scene, &caster, 1.0, scene.GetPatch(0));
    const LightTransport::ShadowClipper clipper(patch);
    LightTransport::ShadowClipper::Origin light;
    light.IsPoint = trial % 2 == 0;
    light.Direction = -Eigen::Vector3d(uniform(random), uniform(random), 1.0).normalized();
    light.Position = patch.GetPoint(0) - 0.4 * light.Direction;
    LightTransport::ShadowClipper::Result result;
    clipper.Divide(clipper.GetWhole(), light, clipper.FindBlockers(clipper.GetWhole(), light), 0.0,
      result);
    double lit = 0.0;
    for (const auto& piece : result.Lit)
    {
      lit += LightTransport::ShadowClipper::GetArea(piece) /
        LightTransport::ShadowClipper::GetArea(clipper.GetWhole());
    }
    int seen = 0;
    for (int k = 0; k < rays; ++k)
    {
      const Eigen::Vector3d point = patch.GetPoint(k);
      const Eigen::Vector3d target =
        light.IsPoint ? light.Position : Eigen::Vector3d(point - 2.0 * light.Direction);
      seen += patch.IsBlocked(point, target) ? 0 : 1;
    }
    // The first 4,096 points are even to a few times 1 / 4,096 to the power of 3 / 4.
    CheckClose(lit - static_cast<double>(seen) / rays, 0.0, 1e-2,
      "random sheets " + std::to_string(trial));
  }
}

//------------------------------------------------------------------------------
/// Part of a disc of radius 1 that lies beyond a chord at `height`.
double GetSegment(double height)
{
  const double h = std::min(1.0, std::max(-1.0, height));
  return (std::acos(h) - h * std::sqrt(1.0 - h * h)) / vtkMath::Pi();
}

//------------------------------------------------------------------------------
/// The edge of a roof 10 above a row of small squares: each sees a part of the sun.
void TestPenumbra()
{
  const double radius = std::sin(vtkMath::RadiansFromDegrees(0.265));
  for (const bool single : { false, true })
  {
    const Place place = { 0.6, 1.0, 0.0, single };
    Surface surface;
    const std::vector<double> heights = { -1.5, -0.95, -0.5, 0.0, 0.31, 0.8, 1.2 };
    for (const double height : heights)
    {
      const double x = height * 10.0 * radius;
      AddRectangle(surface, place, x - 1e-3, x + 1e-3, -1e-3, 1e-3, 0.0);
    }
    AddRectangle(surface, place, 0.0, 10.0, -5.0, 5.0, 10.0);
    vtkNew<vtkDirectIrradiance> filter;
    filter->SetInputData(GetData(surface, place));
    filter->SetLightAngularDiameter(0.53);
    filter->AddLight(MakeLight(place.Get({ 0, 0, 1 }), place.Get({ 0, 0, 0 }), false));
    for (std::size_t k = 0; k < heights.size(); ++k)
    {
      const double value = GetValue(filter, "DirectIrradiance", k);
      const double error = GetValue(filter, "DirectIrradianceError", k);
      CheckClose(value - GetSegment(heights[k]), 0.0, 3.0 * error + 1e-3,
        "penumbra at " + std::to_string(heights[k]) + place.GetName());
      Check(error <= 1e-2, "the error of a penumbra");
    }
  }
}

//------------------------------------------------------------------------------
/// A disc that is seen as a whole gives what it does from its middle; a setting one does not.
void TestDisc()
{
  Surface surface;
  AddRectangle(surface, Place(), 0.0, 1.0, 0.0, 1.0, 0.0);
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(surface.Get());
  for (const double diameter : { 0.53, 10.0, 60.0 })
  {
    filter->SetLightAngularDiameter(diameter);
    for (const double angle : { 0.0, 40.0, 59.9 })
    {
      const double radians = vtkMath::RadiansFromDegrees(angle);
      filter->RemoveAllLights();
      filter->AddLight(MakeLight({ std::sin(radians), 0, std::cos(radians) }, { 0, 0, 0 }, false));
      CheckClose(GetValue(filter), std::cos(radians), 1e-12,
        "a disc of " + std::to_string(diameter) + " at " + std::to_string(angle));
    }
  }
  filter->SetLightAngularDiameter(0.53);
  filter->SetTolerance(1e-3);
  filter->RemoveAllLights();
  filter->AddLight(MakeLight({ 1, 0, 0 }, { 0, 0, 0 }, false));
  const double radius = std::sin(vtkMath::RadiansFromDegrees(0.265));
  CheckClose(GetValue(filter), radius * 2.0 / (3.0 * vtkMath::Pi()), 2e-2,
    "half of the sun has set");
  // All that enters glass from straight above.
  filter->SetRefractiveIndex(1.5);
  filter->RemoveAllLights();
  filter->AddLight(MakeLight({ 0, 0, 1 }, { 0, 0, 0 }, false));
  CheckClose(GetValue(filter, "TransmittedIrradiance"), 0.96, 1e-5, "the sun enters glass");
}

//------------------------------------------------------------------------------
/// A picture of one value, `peak` in the pixels that `inside` picks.
vtkSmartPointer<vtkImageData> MakePicture(int width, int height, double base, double peak,
  const std::function<bool(int, int)>& inside)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* values = static_cast<float*>(image->GetScalarPointer());
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      *values++ = static_cast<float>(inside(x, y) ? peak : base);
    }
  }
  return image;
}

//------------------------------------------------------------------------------
/// Flux through surfaces that face x, y and z by one pixel of a picture, bilinear around its
/// centre, where it is above the horizon: midpoints of a fine grid.
Point GetPixelFlux(int width, int height, int column, int row)
{
  constexpr int fine = 400;
  const double pi = vtkMath::Pi();
  Point flux = {};
  for (int j = 0; j < 2 * fine; ++j)
  {
    const double up = (j + 0.5) / fine - 1.0;
    const double latitude = ((row + 0.5 + up) / height - 0.5) * pi;
    for (int i = 0; i < 2 * fine; ++i)
    {
      const double right = (i + 0.5) / fine - 1.0;
      const double longitude = (column + 0.5 + right) / width * 2.0 * pi;
      const double weight = (1.0 - std::abs(up)) * (1.0 - std::abs(right)) * std::cos(latitude) *
        2.0 * pi / width * pi / height / (fine * fine);
      flux[0] += weight * std::max(0.0, std::cos(latitude) * std::cos(longitude));
      flux[1] += weight * std::max(0.0, std::cos(latitude) * std::sin(longitude));
      flux[2] += weight * std::max(0.0, std::sin(latitude));
    }
  }
  return flux;
}

//------------------------------------------------------------------------------
/// A sun of one pixel, with and without a sky around it, on squares that face x, y and z.
void TestSunInPicture()
{
  Surface squares;
  squares.AddPolygon({ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } });
  squares.AddPolygon({ { 0, 10, 0 }, { 0, 10, 1 }, { 1, 10, 1 }, { 1, 10, 0 } });
  squares.AddPolygon({ { 0, 20, 0 }, { 1, 20, 0 }, { 1, 21, 0 }, { 0, 21, 0 } });
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(squares.Get());
  filter->ShadowsOff();
  constexpr int width = 720;
  constexpr int height = 360;
  for (const int row : { 190, 260, 350 })
  {
    for (const double sky : { 0.0, 20.0 })
    {
      const int column = 47;
      const double peak = 1e7;
      filter->SetEnvironment(MakePicture(width, height, sky, sky + peak,
        [=](int x, int y) { return x == column && y == row; }));
      const Point flux = GetPixelFlux(width, height, column, row);
      for (int axis = 0; axis < 3; ++axis)
      {
        const double right = peak * flux[axis] + vtkMath::Pi() * sky;
        const double value = GetValue(filter, "DirectIrradiance", axis);
        const double error = GetValue(filter, "DirectIrradianceError", axis);
        const std::string name = "sun in row " + std::to_string(row) + ", sky " +
          std::to_string(sky) + ", axis " + std::to_string(axis);
        CheckClose(value - right, 0.0, 3.0 * error + 1e-3 * right, name);
        CheckClose(value, right, 1e-2, name);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Each band of a coloured sun has its own irradiance.
void TestColoredSun()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(720, 360, 1);
  image->AllocateScalars(VTK_DOUBLE, 3);
  std::fill_n(static_cast<double*>(image->GetScalarPointer()), 720 * 360 * 3, 0.0);
  const double colors[] = { 1e7, 2e6, 0.0 };
  for (int band = 0; band < 3; ++band)
  {
    image->SetScalarComponentFromDouble(100, 300, 0, band, colors[band]);
  }
  Surface surface;
  AddRectangle(surface, Place(), 0.0, 1.0, 0.0, 1.0, 0.0);
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(surface.Get());
  filter->SetEnvironment(image);
  filter->Update();
  const double flux = GetPixelFlux(720, 360, 100, 300)[2];
  for (int band = 0; band < 3; ++band)
  {
    CheckClose(filter->GetPolyDataOutput()
                 ->GetCellData()
                 ->GetArray("DirectIrradiance")
                 ->GetComponent(0, band),
      colors[band] * flux, 1e-3, "band " + std::to_string(band) + " of a coloured sun");
  }
}

//------------------------------------------------------------------------------
/// A patch that a picture's sun lights in part, and one below a large plate: what is seen of an
/// even sky is pi less the solid angle of the plate, weighed by cosines.
void TestSkyInPart()
{
  Surface surface;
  AddRectangle(surface, Place(), -1e-3, 1e-3, -1e-3, 1e-3, 0.0);
  AddRectangle(surface, Place(), 0.0, 1.0, 0.0, 1.0, 1.0);
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(surface.Get());
  filter->SetEnvironment(MakePicture(64, 32, 1.0, 1.0, [](int, int) { return false; }));
  // View factor of a unit square from an element below one of its corners.
  const double root = std::sqrt(2.0);
  const double factor = 2.0 / (2.0 * vtkMath::Pi()) / root * std::atan(1.0 / root);
  for (const double tolerance : { 1e-2, 3e-3 })
  {
    filter->SetTolerance(tolerance);
    CheckEstimated(filter, vtkMath::Pi() * (1.0 - factor), vtkMath::Pi(),
      "even sky beside a plate at " + std::to_string(tolerance));
  }
  // A sixth of the square is lit between slats by a sun of one pixel in the zenith.
  Surface slats;
  AddRectangle(slats, Place(), 0.0, 1.0, 0.0, 1.0, 0.0);
  AddRectangle(slats, Place(), 0.0, 0.4, -1.0, 2.0, 1e-3);
  AddRectangle(slats, Place(), 0.4 + 1.0 / 6.0, 1.0, -1.0, 2.0, 1e-3);
  filter->SetInputData(slats.Get());
  filter->SetTolerance(1e-2);
  filter->SetEnvironment(MakePicture(720, 360, 0.0, 1e6, [](int, int y) { return y > 358; }));
  filter->ShadowsOff();
  const double whole = GetValue(filter);
  filter->ShadowsOn();
  CheckEstimated(filter, whole / 6.0, whole, "a sun between slats");
}

//------------------------------------------------------------------------------
/// Blocks of a data set are one scene; what one of them throws on the other is cut out.
void TestComposite()
{
  Surface ground, plate;
  AddRectangle(ground, Place(), 0.0, 1.0, 0.0, 1.0, 0.0);
  AddRectangle(plate, Place(), 0.25, 0.5, 0.25, 0.75, 0.5);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, ground.Get());
  blocks->SetBlock(1, plate.Get());
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputDataObject(blocks);
  filter->AddLight(MakeLight({ 0, 0, 1 }, { 0, 0, 0 }, false));
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  auto* lit = vtkPolyData::SafeDownCast(output->GetBlock(0));
  CheckClose(lit->GetCellData()->GetArray("DirectIrradiance")->GetComponent(0, 0), 1.0 - 0.125,
    1e-12, "a plate in another block");
}

//------------------------------------------------------------------------------
/// A floor with a corner inside is one polygon to the user: all of its parts are cut.
void TestConcave()
{
  Surface surface;
  surface.AddPolygon(
    { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 }, { 0, 2, 0 } });
  AddRectangle(surface, Place(), 0.5, 1.5, 0.5, 0.75, 0.3);
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(surface.Get());
  filter->AddLight(MakeLight({ 0, 0, 1 }, { 0, 0, 0 }, false));
  CheckClose(GetValue(filter), 1.0 - 0.25 / 3.0, 1e-12, "a plate over a concave floor");
}

//------------------------------------------------------------------------------
/// Where the tolerance cannot be reached that is said, once, with the place and the remedy.
void TestWarning()
{
  Surface surface;
  AddRectangle(surface, Place(), 0.0, 1.0, 0.0, 1.0, 0.0);
  AddRectangle(surface, Place(), -0.3, 0.6, -0.3, 0.6, 0.5);
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(surface.Get());
  filter->SetEnvironment(MakePicture(64, 32, 1.0, 1.0, [](int, int) { return false; }));
  filter->SetEnvironmentSamples(8);
  vtkNew<vtkTest::ErrorObserver> messages;
  filter->AddObserver(vtkCommand::WarningEvent, messages);
  filter->Update();
  Check(messages->GetWarning(), "a warning");
  for (const char* part : { "Tolerance 0.01 was not reached on 1 of 2 polygons",
         "polygon 0 near (0.5, 0.5, 0)", "Raise EnvironmentSamples" })
  {
    Check(messages->GetWarningMessage().find(part) != std::string::npos,
      std::string(part) + " in " + messages->GetWarningMessage());
  }
  Check(GetSummary(filter->GetOutput(), "LargestDirectIrradianceError") > 1e-2 &&
      GetSummary(filter->GetOutput(), "DirectIrradianceError") > 0.0,
    "errors in the field data");
}

//------------------------------------------------------------------------------
/// Deep sampling is reported on, and heard to be stopped, as often as shallow one.
void TestProgress()
{
  Surface surface;
  for (int k = 0; k < 64; ++k)
  {
    AddRectangle(surface, Place(), k, k + 0.9, 0.0, 1.0, 0.01 * k);
  }
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(surface.Get());
  filter->SetEnvironment(MakePicture(64, 32, 1.0, 1.0, [](int, int) { return false; }));
  filter->SetEnvironmentSamples(65536);
  filter->SetTolerance(1e-6);
  double done = 0.0;
  vtkNew<vtkCallbackCommand> abort;
  abort->SetClientData(&done);
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      auto* algorithm = static_cast<vtkAlgorithm*>(caller);
      // The end of an update is told as 1, whatever became of it.
      const double progress = algorithm->GetProgress();
      *static_cast<double*>(data) += progress < 1.0 ? progress : 0.0;
      algorithm->SetAbortExecute(1);
    });
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  Check(done <= 1.0 / 32.0,
    "an abort is heard after one or two patches, not " + std::to_string(done));
  Check(!filter->GetPolyDataOutput()->GetCellData()->HasArray("DirectIrradiance"),
    "no result after an abort");
}
} // namespace

//------------------------------------------------------------------------------
int TestSmallLight(int, char*[])
{
  TestStrips();
  TestPointLight();
  TestSheetAndWall();
  TestCloseLight();
  TestManyBlockers();
  TestAgainstRays();
  TestPenumbra();
  TestDisc();
  TestSunInPicture();
  TestColoredSun();
  TestSkyInPart();
  TestComposite();
  TestConcave();
  TestWarning();
  TestProgress();
  return Result();
}
