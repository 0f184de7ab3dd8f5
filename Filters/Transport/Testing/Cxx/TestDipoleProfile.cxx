// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The dipole of every preset against derived quantities computed independently, tails and moments
// against quadrature.
#include "LightTransportTesting.h"
#include "Scattering/DipoleProfile.h"
#include "vtkSubsurfaceScattering.h"

#include <cstring>
#include <limits>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
/// Values as text, so that each is compared to the digits given.
struct Row
{
  int Material;
  const char* Name;
  int Band;
  const char* Scattering;
  const char* Absorption;
  const char* Index;
  const char* Albedo;
  const char* RealDepth;
  const char* VirtualDepth;
  const char* DiffusionCoefficient;
  const char* TransportCoefficient;
  const char* DiffusionLength;
  const char* Total;
  const char* Peak;
  const char* AtOneMillimeter;
};

const Row Rows[] = {
  { 1, "Apple", 0, "2.29", "0.003", "1.3", "0.99869167", "0.436110", "1.949468", "0.145370",
    "0.143656", "6.9611", "0.8463994", "0.437302", "0.0405345" },
  { 1, "Apple", 1, "2.39", "0.0034", "1.3", "0.99857943", "0.417816", "1.867691", "0.139272",
    "0.156246", "6.4002", "0.8406579", "0.476252", "0.0406681" },
  { 1, "Apple", 2, "1.97", "0.046", "1.3", "0.97718254", "0.496032", "2.217327", "0.165344",
    "0.527454", "1.8959", "0.5278266", "0.317595", "0.0320355" },
  { 2, "Chicken1", 0, "0.15", "0.015", "1.3", "0.90909091", "6.060606", "27.091701", "2.020202",
    "0.086168", "11.6052", "0.3136628", "0.00181029", "0.00173581" },
  { 2, "Chicken1", 1, "0.21", "0.077", "1.3", "0.73170732", "3.484321", "15.575368", "1.161440",
    "0.257482", "3.8838", "0.1558012", "0.00373173", "0.00325959" },
  { 2, "Chicken1", 2, "0.38", "0.19", "1.3", "0.66666667", "1.754386", "7.842335", "0.584795",
    "0.570000", "1.7544", "0.1264418", "0.0127359", "0.00774127" },
  { 3, "Chicken2", 0, "0.19", "0.018", "1.3", "0.91346154", "4.807692", "21.491013", "1.602564",
    "0.105981", "9.4356", "0.3212218", "0.00290498", "0.00271925" },
  { 3, "Chicken2", 1, "0.25", "0.088", "1.3", "0.73964497", "2.958580", "13.225239", "0.986193",
    "0.298717", "3.3476", "0.1599340", "0.00526633", "0.00437893" },
  { 3, "Chicken2", 2, "0.32", "0.2", "1.3", "0.61538462", "1.923077", "8.596405", "0.641026",
    "0.558570", "1.7903", "0.1076296", "0.00941328", "0.0061221" },
  { 4, "Cream", 0, "7.38", "0.0002", "1.3", "0.99997290", "0.135498", "0.605692", "0.045166",
    "0.066544", "15.0276", "0.9757336", "4.55082", "0.0405435" },
  { 4, "Cream", 1, "5.47", "0.0028", "1.3", "0.99948838", "0.182722", "0.816790", "0.060907",
    "0.214410", "4.6640", "0.9000043", "2.49806", "0.0427662" },
  { 4, "Cream", 2, "3.15", "0.0163", "1.3", "0.99485204", "0.315826", "1.411784", "0.105275",
    "0.393487", "2.5414", "0.7247064", "0.8235", "0.038636" },
  { 5, "Ketchup", 0, "0.18", "0.061", "1.3", "0.74688797", "4.149378", "18.548260", "1.383126",
    "0.210007", "4.7617", "0.1638313", "0.00271993", "0.00247142" },
  { 5, "Ketchup", 1, "0.07", "0.97", "1.3", "0.06730769", "0.961538", "4.298203", "0.320513",
    "1.739655", "0.5748", "0.0063369", "0.00290819", "0.000590447" },
  { 5, "Ketchup", 2, "0.03", "1.45", "1.3", "0.02027027", "0.675676", "3.020359", "0.225225",
    "2.537321", "0.3941", "0.0018298", "0.00172771", "0.00011826" },
  { 6, "Marble", 0, "2.19", "0.0021", "1.5", "0.99904201", "0.456184", "2.865109", "0.152061",
    "0.117517", "8.5094", "0.8301671", "0.390743", "0.0348439" },
  { 6, "Marble", 1, "2.62", "0.0041", "1.5", "0.99843756", "0.381083", "2.393432", "0.127028",
    "0.179656", "5.5662", "0.7909318", "0.558783", "0.0343266" },
  { 6, "Marble", 2, "3", "0.0071", "1.5", "0.99763892", "0.332546", "2.088592", "0.110849",
    "0.253083", "3.9513", "0.7525784", "0.731886", "0.0336712" },
  { 7, "Potato", 0, "0.68", "0.0024", "1.3", "0.99648300", "1.465416", "6.550602", "0.488472",
    "0.070095", "14.2664", "0.7643989", "0.0384482", "0.0223054" },
  { 7, "Potato", 1, "0.7", "0.009", "1.3", "0.98730606", "1.410437", "6.304839", "0.470146",
    "0.138358", "7.2276", "0.6124718", "0.0403801", "0.0223992" },
  { 7, "Potato", 2, "0.55", "0.12", "1.3", "0.82089552", "1.492537", "6.671837", "0.497512",
    "0.491121", "2.0362", "0.2126985", "0.0246536", "0.0133199" },
  { 8, "Skimmilk", 0, "0.7", "0.0014", "1.3", "0.99800399", "1.425720", "6.373155", "0.475240",
    "0.054276", "18.4244", "0.8149265", "0.0408219", "0.0231431" },
  { 8, "Skimmilk", 1, "1.22", "0.0025", "1.3", "0.99795501", "0.817996", "3.656549", "0.272665",
    "0.095754", "10.4435", "0.8129646", "0.123991", "0.0349661" },
  { 8, "Skimmilk", 2, "1.9", "0.0142", "1.3", "0.99258176", "0.522411", "2.335247", "0.174137",
    "0.285561", "3.5019", "0.6822681", "0.298897", "0.0369243" },
  { 9, "Skin1", 0, "0.74", "0.032", "1.3", "0.95854922", "1.295337", "5.790325", "0.431779",
    "0.272235", "3.6733", "0.4359315", "0.0444305", "0.0220185" },
  { 9, "Skin1", 1, "0.88", "0.17", "1.3", "0.83809524", "0.952381", "4.257267", "0.317460",
    "0.731779", "1.3665", "0.2273220", "0.0628235", "0.0182332" },
  { 9, "Skin1", 2, "1.01", "0.48", "1.3", "0.67785235", "0.671141", "3.000088", "0.223714",
    "1.464787", "0.6827", "0.1309959", "0.0892562", "0.0100959" },
  { 10, "Skin2", 0, "1.09", "0.013", "1.3", "0.98821396", "0.906618", "4.052702", "0.302206",
    "0.207405", "4.8215", "0.6226023", "0.0979823", "0.0314856" },
  { 10, "Skin2", 1, "1.59", "0.07", "1.3", "0.95783133", "0.602410", "2.692850", "0.200803",
    "0.590424", "1.6937", "0.4332465", "0.20507", "0.0287517" },
  { 10, "Skin2", 2, "1.79", "0.145", "1.3", "0.92506460", "0.516796", "2.310145", "0.172265",
    "0.917456", "1.0900", "0.3434389", "0.258067", "0.0228079" },
  { 11, "Spectralon", 0, "11.6", "0", "1.3", "1.00000000", "0.086207", "0.385356", "0.028736",
    "0.000000", "inf", "1.0000000", "11.2438", "0.0316991" },
  { 11, "Spectralon", 1, "20.4", "0", "1.3", "1.00000000", "0.049020", "0.219124", "0.016340",
    "0.000000", "inf", "1.0000000", "34.7743", "0.0201397" },
  { 11, "Spectralon", 2, "14.9", "0", "1.3", "1.00000000", "0.067114", "0.300009", "0.022371",
    "0.000000", "inf", "1.0000000", "18.5511", "0.0262837" },
  { 12, "Wholemilk", 0, "2.55", "0.0011", "1.3", "0.99956881", "0.391988", "1.752237", "0.130663",
    "0.091753", "10.8988", "0.9076876", "0.542955", "0.0417639" },
  { 12, "Wholemilk", 1, "3.21", "0.0024", "1.3", "0.99925290", "0.311294", "1.391524", "0.103765",
    "0.152083", "6.5754", "0.8808549", "0.859963", "0.0426631" },
  { 12, "Wholemilk", 2, "3.77", "0.014", "1.3", "0.99630021", "0.264271", "1.181324", "0.088090",
    "0.398658", "2.5084", "0.7593894", "1.18153", "0.0397448" },
};

//------------------------------------------------------------------------------
// Half a unit in the last digit of the text (and a little for its own rounding).
void CheckDigits(double value, const char* text, const std::string& what)
{
  const double expected = std::stod(text);
  if (!std::isfinite(expected))
  {
    Check(!std::isfinite(value), what);
    return;
  }
  const char* exponent = std::strchr(text, 'e');
  const char* point = std::strchr(text, '.');
  const std::size_t end = exponent ? exponent - text : std::strlen(text);
  const int digits = point ? static_cast<int>(end - (point - text) - 1) : 0;
  const int shift = exponent ? std::stoi(exponent + 1) : 0;
  const double allowed = 0.51 * std::pow(10.0, shift - digits);
  Check(std::abs(value - expected) <= allowed,
    what + ": " + std::to_string(value) + " instead of " + text);
}

//------------------------------------------------------------------------------
void TestPresets()
{
  for (const Row& row : Rows)
  {
    const std::string what = std::string(row.Name) + " band " + std::to_string(row.Band) + " ";
    double scattering[3], absorption[3], index;
    Check(
      vtkSubsurfaceScattering::GetMaterialProperties(row.Material, scattering, absorption, index),
      what + "exists");
    Check(std::string(vtkSubsurfaceScattering::GetMaterialName(row.Material)) == row.Name,
      what + "name");
    Check(scattering[row.Band] == std::stod(row.Scattering), what + "scattering");
    Check(absorption[row.Band] == std::stod(row.Absorption), what + "absorption");
    Check(index == std::stod(row.Index), what + "index");
    const DipoleProfile profile({ scattering[row.Band], absorption[row.Band], index });
    CheckDigits(profile.GetAlbedo(), row.Albedo, what + "albedo");
    CheckDigits(profile.GetRealDepth(), row.RealDepth, what + "real depth");
    CheckDigits(profile.GetVirtualDepth(), row.VirtualDepth, what + "virtual depth");
    CheckDigits(profile.GetDiffusionCoefficient(), row.DiffusionCoefficient, what + "diffusion");
    CheckDigits(profile.GetTransportCoefficient(), row.TransportCoefficient, what + "transport");
    CheckDigits(1.0 / profile.GetTransportCoefficient(), row.DiffusionLength, what + "length");
    CheckDigits(profile.GetTotal(), row.Total, what + "total");
    CheckDigits(profile.Evaluate(0.0), row.Peak, what + "peak");
    CheckDigits(profile.Evaluate(1.0), row.AtOneMillimeter, what + "at 1 mm");
  }
  double unused[3], index = 0.0;
  for (const int material : { -1, 0, 13 })
  {
    Check(!vtkSubsurfaceScattering::GetMaterialProperties(material, unused, unused, index),
      "no preset " + std::to_string(material));
  }
}

//------------------------------------------------------------------------------
void TestMatchedIndex()
{
  const DipoleProfile matched({ 1.0, 0.0, 1.0 });
  CheckClose(matched.GetVirtualDepth(), 7.0 / 3.0, 1e-14, "virtual depth at index 1");
}

//------------------------------------------------------------------------------
// Midpoint rule over r = sinh(t): doubly fine for functions that fall like powers.
void TestTailAndMoments()
{
  for (const Row& row : Rows)
  {
    const DipoleProfile profile(
      { std::stod(row.Scattering), std::stod(row.Absorption), std::stod(row.Index) });
    for (const double over : { 0.01, 0.3, 1.0, 7.0, 100.0 })
    {
      const double depth = profile.GetRealDepth();
      const double radius = over * depth;
      const int steps = 4000;
      const double step = std::asinh(over) / steps;
      double expected[3] = {};
      for (int k = 0; k < steps; ++k)
      {
        const double r = depth * std::sinh((k + 0.5) * step);
        const double weighted =
          profile.Evaluate(r) * r * step * depth * std::cosh((k + 0.5) * step);
        expected[0] += weighted;
        expected[1] += weighted * r;
        expected[2] += weighted * r * r;
      }
      double moments[3];
      profile.GetMoments(radius, moments);
      const std::string what =
        std::string(row.Name) + " within " + std::to_string(over) + " depths: ";
      for (int k = 0; k < 3; ++k)
      {
        CheckClose(moments[k], expected[k], 1e-5, what + "moment " + std::to_string(k));
      }
      CheckClose(profile.GetTotal() - profile.GetTail(radius), 2.0 * vtkMath::Pi() * moments[0],
        1e-9, what + "tail");
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestDipoleProfile(int, char*[])
{
  TestPresets();
  TestMatchedIndex();
  TestTailAndMoments();
  return Result();
}
