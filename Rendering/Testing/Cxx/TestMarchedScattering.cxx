// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Light that is scattered once, as vtkSubsurfaceScatteringPass marches it: half spaces and slabs
 * against Chandrasekhar's formulas, with Fresnel's factors; a box against an integral of its own,
 * under each kind of light, with what stands between; what is computed again when.
 */
#include "CompositeMapper.h"
#include "LightTransportTesting.h"
#include "ScatteringScene.h"

#include "vtkCubeSource.h"
#include "vtkFramebufferPass.h"
#include "vtkPixelBufferObject.h"
#include "vtkPlaneSource.h"
#include "vtkTestErrorObserver.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace
{
using namespace LightTransportTesting;
using namespace ScatteringScene;
using Vector = std::array<double, 3>;

constexpr int Side = 32;

Vector Scale(const Vector& a, double factor)
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}

Vector Add(const Vector& a, const Vector& b, double factor = 1.0)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector Normalize(const Vector& a)
{
  return Scale(a, 1.0 / std::sqrt(Dot(a, a)));
}

/// For what a boundary lets through that is met under an angle of this cosine outside.
double GetTransmittance(double cosine, double index)
{
  const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
  const double s = (cosine - index * inside) / (cosine + index * inside);
  const double p = (index * cosine - inside) / (index * cosine + inside);
  return 1.0 - 0.5 * (s * s + p * p);
}

/// Of a direction of light that enters a surface.
Vector Refract(const Vector& along, const Vector& normal, double index)
{
  const double cosine = -Dot(along, normal);
  const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
  return Add(Scale(along, 1.0 / index), normal, cosine / index - inside);
}

double GetPhase(double cosine, double g)
{
  return (1.0 - g * g) / (4.0 * vtkMath::Pi() * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
}

struct Medium
{
  Vector Scattering = { 1.0, 0.5, 2.0 }; ///< reduced, per length
  Vector Absorption = { 0.1, 0.7, 0.0 };
  Vector Anisotropy = { 0.0, 0.6, -0.3 };
  double Index = 1.3;

  double GetScattering(std::size_t band) const
  {
    return this->Scattering[band] / (1.0 - this->Anisotropy[band]);
  }
  double GetExtinction(std::size_t band) const
  {
    return this->GetScattering(band) + this->Absorption[band];
  }
};

/// A body in parallel projection, whose picture is read as numbers.
struct Picture
{
  vtkNew<vtkOffScreenOpenGLRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkLight> Light;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkSubsurfaceScattering> Material;
  vtkNew<vtkSubsurfaceScatteringPass> Pass;
  vtkNew<vtkFramebufferPass> Buffer;
  Vector Shift = {};

  Picture(vtkPolyData* surface, const Medium& medium)
  {
    this->Actor->GetProperty()->SetDiffuse(0.0);
    this->Actor->GetProperty()->SetAmbient(0.0);
    this->Renderer->AddActor(this->Actor);
    Picture::SetSurface(this->Actor, surface);
    this->SetMedium(medium);
    this->Light->SetLightTypeToSceneLight();
    this->Renderer->AddLight(this->Light);
    this->Pass->SetMaterial(this->Actor, this->Material);
    this->Pass->SetSingleScatteringToOnly();
    this->Pass->SetSingleScatteringSteps(64);
    this->Pass->SetOutputEncodingToLinear();
    this->Buffer->SetColorFormat(vtkTextureObject::Float32);
    this->Buffer->SetDelegatePass(this->Pass);
    this->Renderer->SetPass(this->Buffer);
    this->Renderer->GetActiveCamera()->ParallelProjectionOn();
    this->Renderer->GetActiveCamera()->SetParallelScale(1.0);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Side, Side);
    this->Window->AddRenderer(this->Renderer);
  }
  ~Picture()
  {
    this->Buffer->ReleaseGraphicsResources(this->Window);
    this->Renderer->SetPass(nullptr);
  }
  Picture(const Picture&) = delete;
  void operator=(const Picture&) = delete;

  static void SetSurface(vtkActor* actor, vtkPolyData* surface)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    actor->SetMapper(mapper);
  }

  /// A millimetre is a fifth of the unit.
  void SetMedium(const Medium& medium)
  {
    constexpr double MillimetersPerUnit = 5.0;
    const Vector scattering = Scale(medium.Scattering, 1.0 / MillimetersPerUnit);
    const Vector absorption = Scale(medium.Absorption, 1.0 / MillimetersPerUnit);
    this->Material->SetScatteringCoefficient(scattering.data());
    this->Material->SetAbsorptionCoefficient(absorption.data());
    this->Material->SetAnisotropy(medium.Anisotropy.data());
    this->Material->SetRefractiveIndex(medium.Index);
    this->Material->SetMillimetersPerUnit(MillimetersPerUnit);
  }

  void LookFrom(const Vector& towards, const Vector& focus = {})
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    const Vector at = Add(focus, this->Shift);
    camera->SetFocalPoint(at.data());
    camera->SetPosition(Add(at, Normalize(towards), 10.0).data());
    camera->SetViewUp(0.1, 0.2, 1.0);
    this->Renderer->ResetCameraClippingRange();
  }

  void Shine(const Vector& from, const Vector& at = {})
  {
    this->Light->SetPosition(Add(from, this->Shift).data());
    this->Light->SetFocalPoint(Add(at, this->Shift).data());
  }

  /// Four numbers a pixel.
  std::vector<double> Draw()
  {
    this->Window->Render();
    auto pixels =
      vtkSmartPointer<vtkPixelBufferObject>::Take(this->Buffer->GetColorTexture()->Download());
    std::vector<float> values(static_cast<std::size_t>(4) * Side * Side);
    unsigned int sides[2] = { Side, Side };
    vtkIdType increments[2] = { 0, 0 };
    pixels->Download2D(VTK_FLOAT, values.data(), sides, 4, increments);
    return { values.begin(), values.end() };
  }
};

/// Pixels of one color.
void CheckEven(const std::vector<double>& picture, const Vector& expected, double tolerance,
  const std::string& what)
{
  double worst = 0.0;
  for (std::size_t k = 0; k < picture.size(); ++k)
  {
    if (k % 4 < 3)
    {
      worst = std::max(worst, std::abs(picture[k] / expected[k % 4] - 1.0));
    }
  }
  std::cout << what << ": off by " << worst << "\n";
  Check(worst <= tolerance, what + ": the radiance is another");
}

vtkSmartPointer<vtkPolyData> MakeBox(const Vector& size, bool isDouble = false)
{
  vtkNew<vtkCubeSource> box;
  box->SetXLength(size[0]);
  box->SetYLength(size[1]);
  box->SetZLength(size[2]);
  box->SetOutputPointsPrecision(isDouble ? 1 : 0);
  box->Update();
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(box->GetOutput()->GetPoints());
  surface->SetPolys(box->GetOutput()->GetPolys());
  return surface;
}

/// S. Chandrasekhar, Radiative Transfer, 1960, section 47, with what boundaries do.
void TestFlat()
{
  Medium medium;
  const Vector irradiance = { 1.5, 3.0, 0.75 };
  const Vector toEye = Normalize({ -0.5, 0.4, 1.0 });
  for (const double index : { 1.0, 1.3 })
  {
    medium.Index = index;
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-20.0, -20.0, 0.0);
    plane->SetPoint1(20.0, -20.0, 0.0);
    plane->SetPoint2(-20.0, 20.0, 0.0);
    plane->Update();
    const double thickness = 0.8;
    auto slab = MakeBox({ 40.0, 40.0, thickness });
    for (const double height : { 1.0, 0.2, -0.7 })
    {
      const Vector towards = Normalize({ 0.7, 0.3, height });
      const double outside[2] = { toEye[2], std::abs(towards[2]) };
      double inside[2];
      for (int k = 0; k < 2; ++k)
      {
        inside[k] = std::sqrt(1.0 - (1.0 - outside[k] * outside[k]) / (index * index));
      }
      const double through = GetTransmittance(outside[0], index) *
        GetTransmittance(outside[1], index) * outside[1] / (index * index);
      const Vector arriving =
        Refract(Scale(towards, -1.0), { 0.0, 0.0, height > 0.0 ? 1.0 : -1.0 }, index);
      const Vector leaving = Scale(Refract(Scale(toEye, -1.0), { 0.0, 0.0, 1.0 }, index), -1.0);
      Vector deep = {};
      Vector thin = {};
      for (std::size_t band = 0; band < 3; ++band)
      {
        const double extinction = medium.GetExtinction(band);
        const double phase = GetPhase(Dot(arriving, leaving), medium.Anisotropy[band]);
        const double source =
          irradiance[band] * through * phase * medium.GetScattering(band) / extinction;
        const double x = extinction * thickness;
        deep[band] = source / (inside[0] + inside[1]);
        thin[band] = height > 0.0 ? deep[band] * -std::expm1(-x / inside[0] - x / inside[1])
                                  : source * (std::exp(-x / inside[0]) - std::exp(-x / inside[1])) /
            (inside[0] - inside[1]);
      }
      const std::string what =
        "index " + std::to_string(index) + ", light at height " + std::to_string(height);
      const auto draw = [&](vtkPolyData* surface, double top, int steps)
      {
        Picture scene(surface, medium);
        scene.Pass->SetSingleScatteringSteps(steps);
        scene.Light->SetColor(0.5, 1.0, 0.25);
        scene.Light->SetIntensity(3.0);
        scene.Shine(towards);
        scene.LookFrom(toEye, { 0.0, 0.0, top });
        return scene.Draw();
      };
      if (height > 0.0)
      {
        CheckEven(draw(plane->GetOutput(), 0.0, 64), deep, 1e-3, "half space, " + what);
        CheckEven(draw(plane->GetOutput(), 0.0, 8), deep, 0.04, "8 steps, " + what);
      }
      CheckEven(draw(slab, 0.5 * thickness, 64), thin, 1e-3, "slab, " + what);
    }
  }
}

/// A box with its middle at the origin, and a sheet that is wide and above it, up to x = Edge.
struct Box
{
  static constexpr double SheetHeight = 1.5;
  static constexpr double Edge = 0.1;
  Vector Half = { 0.6, 0.5, 0.4 };

  /// Where a ray from within leaves, and the face's normal.
  double Leave(const Vector& from, const Vector& along, Vector& normal) const
  {
    double nearest = 1e30;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double side = along[axis] > 0.0 ? 1.0 : -1.0;
      const double distance = (side * this->Half[axis] - from[axis]) / along[axis];
      if (distance < nearest)
      {
        nearest = distance;
        normal = {};
        normal[axis] = side;
      }
    }
    return nearest;
  }

  /// Where a ray from outside enters; false where it passes by.
  bool Enter(const Vector& from, const Vector& along, Vector& place, Vector& normal) const
  {
    double begin = -1e30;
    double end = 1e30;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double side = along[axis] > 0.0 ? -1.0 : 1.0;
      const double first = (side * this->Half[axis] - from[axis]) / along[axis];
      end = std::min(end, (-side * this->Half[axis] - from[axis]) / along[axis]);
      if (first > begin)
      {
        begin = first;
        normal = {};
        normal[axis] = side;
      }
    }
    place = Add(from, along, begin);
    // Beside the edges, where a pixel may see another face.
    int margins = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      margins += normal[axis] == 0.0 && this->Half[axis] - std::abs(place[axis]) < 0.02 ? 1 : 0;
    }
    return begin < end && margins == 0;
  }
};

/// What a light gives at a place: from which direction, how far away, and how much.
using Lamp =
  std::function<double(const Vector& place, double apparent, Vector& towards, double& distance)>;

/// The radiance of a box that is seen along a direction, in one band.
double Integrate(const Box& box, const Medium& medium, std::size_t band, const Lamp& lamp,
  bool hasSheet, const Vector& from, const Vector& normal, const Vector& along)
{
  constexpr int Steps = 1000;
  const Vector inner = Refract(along, normal, medium.Index);
  Vector side;
  const double whole = box.Leave(from, inner, side);
  double sum = 0.0;
  for (int k = 0; k < Steps; ++k)
  {
    const double way = whole * (k + 0.5) / Steps;
    const Vector place = Add(from, inner, way);
    Vector towards;
    double distance = 0.0;
    lamp(place, 0.0, towards, distance);
    Vector face;
    const double straight = box.Leave(place, towards, face);
    const double height = (Box::SheetHeight - place[2]) / towards[2];
    if (hasSheet && height > 0.0 && height < distance && place[0] + height * towards[0] < Box::Edge)
    {
      continue;
    }
    const double cosine = Dot(towards, face);
    const double refracted =
      std::sqrt(1.0 - (1.0 - cosine * cosine) / (medium.Index * medium.Index));
    const double inside = straight * cosine / refracted;
    const double strength =
      lamp(place, distance - straight + inside / medium.Index, towards, distance);
    const Vector arriving = Refract(Scale(towards, -1.0), face, medium.Index);
    sum += std::exp(-medium.GetExtinction(band) * (way + inside)) *
      GetPhase(-Dot(arriving, inner), medium.Anisotropy[band]) * strength * cosine / refracted *
      GetTransmittance(cosine, medium.Index);
  }
  return sum * medium.GetScattering(band) * whole / Steps *
    GetTransmittance(-Dot(along, normal), medium.Index) / (medium.Index * medium.Index);
}

/// Each pixel that sees the box, away from its edges, against the integral.
void CheckBox(Picture& scene, const Medium& medium, const Lamp& lamp, bool hasSheet,
  const std::string& what)
{
  const Vector toEye = Normalize({ 0.8, -1.0, 0.9 });
  scene.LookFrom(toEye);
  const std::vector<double> picture = scene.Draw();
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  Vector right;
  Vector up;
  camera->OrthogonalizeViewUp();
  camera->GetViewUp(up.data());
  const Vector along = Scale(toEye, -1.0);
  vtkMath::Cross(along.data(), up.data(), right.data());
  const Box box;
  double worst = 0.0;
  double largest = 0.0;
  int count = 0;
  for (int pixel = 0; pixel < Side * Side; ++pixel)
  {
    const double x = (2.0 * (pixel % Side) + 1.0) / Side - 1.0;
    const double y = (2.0 * (pixel / Side) + 1.0) / Side - 1.0;
    Vector place;
    Vector normal;
    if (!box.Enter(Add(Add(Scale(toEye, 10.0), right, x), up, y), along, place, normal))
    {
      continue;
    }
    ++count;
    for (std::size_t band = 0; band < 3; ++band)
    {
      const double expected = Integrate(box, medium, band, lamp, hasSheet, place, normal, along);
      const double drawn = picture[static_cast<std::size_t>(4 * pixel) + band];
      worst = std::max(worst, std::abs(drawn - expected));
      largest = std::max(largest, expected);
    }
  }
  std::cout << what << ": " << count << " pixels, off by " << worst / largest
            << " of the largest\n";
  Check(count > 200, what + ": there is too little to see");
  Check(worst <= (hasSheet ? 0.03 : 0.005) * largest, what + ": the radiance is another");
}

void AddSheet(Picture& scene)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-9.0, -9.0, Box::SheetHeight);
  plane->SetPoint1(Box::Edge, -9.0, Box::SheetHeight);
  plane->SetPoint2(-9.0, 9.0, Box::SheetHeight);
  plane->Update();
  vtkNew<vtkActor> sheet;
  Picture::SetSurface(sheet, plane->GetOutput());
  sheet->GetProperty()->SetOpacity(0.001);
  sheet->GetProperty()->SetDiffuse(0.0);
  sheet->GetProperty()->SetAmbient(0.0);
  sheet->SetPosition(scene.Shift.data());
  scene.Renderer->AddActor(sheet);
}

void TestBox()
{
  Medium medium;
  const Box box;
  const Vector size = Scale(box.Half, 2.0);
  const Vector direction = Normalize({ 0.3, 0.5, 0.9 });
  const Lamp distant = [&](const Vector&, double, Vector& towards, double& distance)
  {
    towards = direction;
    distance = 1e30;
    return 2.0;
  };
  const Vector place = { 1.2, 0.7, 1.9 };
  const Vector axis = Normalize(Scale(place, -1.0));
  const double coneCosine = std::cos(vtkMath::RadiansFromDegrees(14.0));
  const auto makeLamp = [&](bool isSpot) -> Lamp
  {
    return [&, isSpot](const Vector& at, double apparent, Vector& towards, double& distance)
    {
      const Vector path = Add(place, at, -1.0);
      distance = std::sqrt(Dot(path, path));
      towards = Normalize(path);
      const double along = -Dot(towards, axis);
      const double cone = !isSpot ? 1.0 : (along >= coneCosine ? std::pow(along, 3.0) : 0.0);
      return 2.0 * cone / (0.1 + 0.2 * apparent + 0.7 * apparent * apparent);
    };
  };
  for (const double index : { 1.0, 1.3 })
  {
    medium.Index = index;
    const std::string with = ", index " + std::to_string(index);
    Picture scene(MakeBox(size), medium);
    scene.Light->SetIntensity(2.0);
    scene.Shine(direction);
    CheckBox(scene, medium, distant, false, "a box under a distant light" + with);
    scene.Light->PositionalOn();
    scene.Light->SetConeAngle(180.0);
    scene.Light->SetAttenuationValues(0.1, 0.2, 0.7);
    scene.Shine(place);
    CheckBox(scene, medium, makeLamp(false), false, "a near light" + with);
  }
  {
    Picture scene(MakeBox(size, true), medium);
    scene.Light->SetIntensity(2.0);
    scene.Light->PositionalOn();
    scene.Light->SetConeAngle(14.0);
    scene.Light->SetExponent(3.0);
    scene.Light->SetAttenuationValues(0.1, 0.2, 0.7);
    scene.Pass->SetSingleScatteringSteps(256);
    scene.Shine(place);
    // Its edge falls between steps.
    CheckBox(scene, medium, makeLamp(true), true, "a spot light");
  }
  for (const std::string where : { "", ", on a map", ", on a map by its points" })
  {
    const double shift = where.empty() ? 0.0 : 6e6;
    const bool isByPoints = where.size() > std::string(", on a map").size();
    auto surface = MakeBox(size, isByPoints);
    Picture scene(surface, medium);
    scene.Shift = { 0.1 * shift, shift, 0.0 };
    scene.Actor->SetPosition(scene.Shift.data());
    if (isByPoints)
    {
      scene.Actor->SetPosition(0.0, 0.0, 0.0);
      for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
      {
        Vector at;
        surface->GetPoint(point, at.data());
        surface->GetPoints()->SetPoint(point, Add(at, scene.Shift).data());
      }
    }
    scene.Light->SetIntensity(2.0);
    scene.Pass->SetSingleScatteringSteps(256);
    AddSheet(scene);
    scene.Shine(direction);
    CheckBox(scene, medium, distant, true, "a sheet between" + where);
  }
}

/// Through the other part of a body light comes dimmed, and not at all through another body.
void TestParts()
{
  Medium medium;
  medium.Index = 1.0;
  medium.Anisotropy = {};
  auto lower = MakeBox({ 40.0, 40.0, 0.5 });
  auto both = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const double height : { 0.0, 2.0 })
  {
    const vtkIdType first = points->GetNumberOfPoints();
    for (vtkIdType point = 0; point < lower->GetNumberOfPoints(); ++point)
    {
      double place[3];
      lower->GetPoint(point, place);
      points->InsertNextPoint(place[0], place[1], place[2] + height);
    }
    for (vtkIdType cell = 0; cell < lower->GetNumberOfCells(); ++cell)
    {
      vtkNew<vtkIdList> ids;
      lower->GetCellPoints(cell, ids);
      cells->InsertNextCell(ids->GetNumberOfIds());
      for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
      {
        cells->InsertCellPoint(first + ids->GetId(k));
      }
    }
  }
  both->SetPoints(points);
  both->SetPolys(cells);
  // From below, light from above.
  const Vector toEye = { 0.6, 0.0, -0.8 };
  const Vector towards = { 0.0, 0.6, 0.8 };
  Picture scene(both, medium);
  scene.Shine(towards);
  scene.LookFrom(toEye, { 0.0, 0.0, -0.25 });
  const double light = 0.5 / towards[2];
  Vector expected;
  for (std::size_t band = 0; band < 3; ++band)
  {
    const double extinction = medium.GetExtinction(band);
    // Both ways through the lower one are as long, at each depth together.
    expected[band] = medium.GetScattering(band) / (4.0 * vtkMath::Pi()) * light *
      std::exp(-2.0 * extinction * light);
  }
  CheckEven(scene.Draw(), expected, 2e-3, "through another part");
  vtkNew<vtkActor> other;
  Picture::SetSurface(other, MakeBox({ 40.0, 40.0, 0.5 }));
  other->SetPosition(0.0, 0.0, 4.0);
  scene.Renderer->AddActor(other);
  const std::vector<double> dark = scene.Draw();
  Check(*std::max_element(dark.begin(), dark.begin() + 3) == 0.0, "there is light behind a body");
  // Coefficients are those of the mapper's unit.
  scene.Renderer->RemoveActor(other);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, both);
  vtkNew<CompositeMapper> mapper;
  mapper->SetInputDataObject(blocks);
  scene.Actor->SetMapper(mapper);
  scene.Actor->SetScale(2.0);
  scene.LookFrom(toEye, { 0.0, 0.0, -0.5 });
  CheckEven(scene.Draw(), expected, 2e-3, "a block, twice as large");
}

double GetDifference(const std::vector<double>& a, const std::vector<double>& b,
  const std::vector<double>& added)
{
  double largest = a.size() == b.size() && a.size() == added.size() ? 0.0 : 1e30;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    largest = std::max(largest, k % 4 < 3 ? std::abs(a[k] - b[k] - added[k]) : 0.0);
  }
  return largest;
}

/// What is drawn beside the map, and what is not made anew.
void TestSum()
{
  Scene scene;
  vtkNew<vtkFramebufferPass> buffer;
  buffer->SetColorFormat(vtkTextureObject::Float32);
  buffer->SetDelegatePass(scene.Pass);
  scene.Renderer->SetPass(buffer);
  scene.Renderer->ResetCamera();
  scene.Window->SetSize(Side, Side);
  const auto draw = [&]()
  {
    scene.Window->Render();
    auto pixels =
      vtkSmartPointer<vtkPixelBufferObject>::Take(buffer->GetColorTexture()->Download());
    std::vector<float> values(static_cast<std::size_t>(4) * Side * Side);
    unsigned int sides[2] = { Side, Side };
    vtkIdType increments[2] = { 0, 0 };
    pixels->Download2D(VTK_FLOAT, values.data(), sides, 4, increments);
    return std::vector<double>(values.begin(), values.end());
  };
  const std::vector<double> none(static_cast<std::size_t>(4) * Side * Side, 0.0);
  const auto getRuns = [&]() -> std::array<vtkIdType, 4>
  {
    return { scene.Pass->GetNumberOfIrradianceRuns(), scene.Pass->GetNumberOfLinkRuns(),
      scene.Pass->GetNumberOfScatteringRuns(), scene.Pass->GetNumberOfShadowRuns() };
  };
  scene.Pass->SetSingleScatteringToOnly();
  const std::vector<double> only = draw();
  Check(getRuns() == std::array<vtkIdType, 4>{ 0, 0, 0, 1 }, "maps are made that nobody sees");
  Check(GetDifference(only, none, none) > 0.01, "there is nothing to see");
  scene.Pass->SetExposure(2.0);
  Check(GetDifference(draw(), only, only) <= 1e-6, "twice the exposure is not twice the light");
  scene.Pass->SetExposure(1.0);
  scene.Pass->SetSingleScatteringToOff();
  const std::vector<double> off = draw();
  scene.Pass->SetSingleScatteringToAdded();
  const std::vector<double> added = draw();
  Check(GetDifference(added, off, only) <= 1e-6, "the sum is another");
  scene.Pass->SetSingleScatteringToOff();
  Check(draw() == off, "off: other bits");
  scene.Pass->SetSingleScatteringToAdded();
  scene.Pass->DirectShadowsOn();
  Check(GetDifference(draw(), added, none) <= 1e-6, "with shadows of a reflection: another sum");
  const auto before = getRuns();
  scene.Renderer->GetActiveCamera()->Azimuth(30.0);
  Check(GetDifference(draw(), added, none) > 0.01, "the camera does not move");
  Check(getRuns() == before, "something is made anew where the camera moves");
  scene.Pass->SetSingleScatteringToOnly();
  scene.Pass->DirectShadowsOff();
  vtkNew<vtkTest::ErrorObserver> observer;
  scene.Pass->AddObserver(vtkCommand::ErrorEvent, observer);
  int errors = 0;
  scene.Light->SetColor(-1.0, 0.0, 0.0);
  for (int frame = 0; frame < 3; ++frame)
  {
    draw();
    errors += observer->GetError() ? 1 : 0;
    observer->Clear();
  }
  scene.Light->SetColor(1.0, 1.0, 1.0);
  scene.Material->SetScatteringCoefficient(-1.0, 1.0, 1.0);
  for (int frame = 0; frame < 3; ++frame)
  {
    draw();
    errors += observer->GetError() ? 1 : 0;
    observer->Clear();
  }
  Check(errors == 2, "what is no good is not told of once");
  buffer->ReleaseGraphicsResources(scene.Window);
  scene.Renderer->SetPass(nullptr);
}
} // namespace

//------------------------------------------------------------------------------
int TestMarchedScattering(int, char*[])
{
  TestFlat();
  TestBox();
  TestParts();
  TestSum();
  return Result();
}
