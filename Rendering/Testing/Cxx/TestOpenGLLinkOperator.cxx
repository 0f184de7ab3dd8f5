// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Every operation of vtkOpenGLLinkOperator against plain loops in double precision, for matrices
 * and vectors that take one texture or many; what is read back; released and re-used operators; the
 * user's own window; errors.
 */
#include "LinkOperatorTesting.h"
#include "vtkOpenGLLinkOperator.h"

#include "vtkExchangeMatrix.h"
#include "vtkNew.h"
#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkTestErrorObserver.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace
{
using namespace LightTransportTesting;

/// Storage is single precision: a sum of terms is right to this fraction of the sum of their
/// absolute values.
constexpr double Tolerance = 3e-7;

/// With `sparse`, only every third tile is stored and not zero.
void FillMatrix(vtkExchangeMatrix* exchange, int patches, int kernels, bool sparse = false)
{
  exchange->AllocateSparse(Vector(static_cast<std::size_t>(patches), 1.0), kernels);
  std::mt19937 engine(7);
  for (vtkExchangeMatrix::Tile& tile : exchange->GetTiles())
  {
    if (sparse && (tile.Row + tile.Column) % 3 != 1)
    {
      continue;
    }
    exchange->AllocateTile(tile);
    for (int i = 0; i < vtkExchangeMatrix::TileSize; ++i)
    {
      for (int j = tile.Row == tile.Column ? i : 0; j < vtkExchangeMatrix::TileSize; ++j)
      {
        const bool inside = tile.Row * vtkExchangeMatrix::TileSize + i < patches &&
          tile.Column * vtkExchangeMatrix::TileSize + j < patches;
        for (int kernel = 0; kernel < kernels && inside; ++kernel)
        {
          vtkExchangeMatrix::SetValue(tile, i, j, kernel,
            static_cast<float>(engine() % 10007) / 10007.0f - 0.4f);
        }
      }
    }
  }
}

/// G x and the sums of the absolute terms.
void MultiplyExactly(vtkExchangeMatrix* exchange, int bands, const Vector& x, Vector& y,
  Vector& bound)
{
  const vtkIdType patches = exchange->GetNumberOfPatches();
  y.assign(x.size(), 0.0);
  bound.assign(x.size(), 0.0);
  for (vtkIdType i = 0; i < patches; ++i)
  {
    for (vtkIdType j = 0; j < patches; ++j)
    {
      for (int band = 0; band < bands; ++band)
      {
        const int kernel = band % exchange->GetNumberOfKernels();
        const double term =
          exchange->GetValue(i, j, kernel) * x[static_cast<std::size_t>(j * bands + band)];
        y[static_cast<std::size_t>(i * bands + band)] += term;
        bound[static_cast<std::size_t>(i * bands + band)] += std::abs(term);
      }
    }
  }
}

bool IsNear(const Vector& found, const Vector& expected, const Vector& bound,
  const std::string& what)
{
  return CheckWithinBound(found, expected, bound, Tolerance, what);
}

struct Case
{
  int Patches;
  int Bands;
  int Kernels;
  int MaximumTextureSize;
  int MatrixTextures;
};

std::string Describe(const Case& setting)
{
  return std::to_string(setting.Patches) + " patches, " + std::to_string(setting.Bands) +
    " bands, " + std::to_string(setting.Kernels) + " kernels, textures of at most " +
    std::to_string(setting.MaximumTextureSize);
}

bool TestProducts(vtkOpenGLLinkOperator* device, vtkExchangeMatrix* exchange, const Case& setting)
{
  const std::string name = Describe(setting);
  const auto size = static_cast<std::size_t>(setting.Patches) * setting.Bands;
  const Vector x = MakeVector<float>(size, 1);
  const Vector left = MakeVector<float>(size, 2);
  const Vector right = MakeVector<float>(size, 3);
  Vector expected;
  Vector bound;
  MultiplyExactly(exchange, setting.Bands, x, expected, bound);
  Vector found(size);
  bool good = device->SetVector(0, x.data()) && device->Multiply(1, 0) &&
    device->GetVector(1, found.data()) && IsNear(found, expected, bound, name + ", Multiply");

  Vector scaled(size);
  for (std::size_t index = 0; index < size; ++index)
  {
    scaled[index] = right[index] * x[index];
  }
  MultiplyExactly(exchange, setting.Bands, scaled, expected, bound);
  for (std::size_t index = 0; index < size; ++index)
  {
    expected[index] *= left[index];
    bound[index] *= std::abs(left[index]);
  }
  good = device->SetVector(2, left.data()) && device->SetVector(3, right.data()) &&
    device->Apply(4, 2, 3, 0, 5) && device->GetVector(4, found.data()) &&
    IsNear(found, expected, bound, name + ", Apply") && good;
  // The operands are what they were.
  return device->GetVector(0, found.data()) && Check(found == x, name + ", x is changed") && good;
}

bool TestVectorAlgebra(vtkOpenGLLinkOperator* device, const Case& setting)
{
  const std::string name = Describe(setting);
  const auto bands = static_cast<std::size_t>(setting.Bands);
  const std::size_t size = static_cast<std::size_t>(setting.Patches) * bands;
  const Vector x = MakeVector<float>(size, 4);
  const Vector y = MakeVector<float>(size, 5);
  const Vector a = MakeVector<float>(bands, 6);
  const Vector b = MakeVector<float>(bands, 7);
  Vector combined(size);
  Vector bound(size);
  Vector dot(bands, 0.0);
  Vector dotBound(bands, 0.0);
  Vector largest(bands, 0.0);
  for (std::size_t index = 0; index < size; ++index)
  {
    const std::size_t band = index % bands;
    combined[index] = a[band] * x[index] + b[band] * y[index];
    bound[index] = std::abs(a[band] * x[index]) + std::abs(b[band] * y[index]);
    dot[band] += x[index] * y[index];
    dotBound[band] += std::abs(x[index] * y[index]);
    largest[band] = std::max(largest[band], std::abs(x[index]));
  }
  Vector found(size);
  Vector perBand(bands);
  bool good = device->SetVector(0, x.data()) && device->SetVector(1, y.data()) &&
    device->Dot(0, 1, perBand.data()) && IsNear(perBand, dot, dotBound, name + ", Dot") &&
    device->MaxNorm(0, perBand.data()) &&
    Check(perBand == largest, name + ", MaxNorm is not exact") &&
    device->Combine(1, a.data(), 0, b.data(), 1) && device->GetVector(1, found.data()) &&
    IsNear(found, combined, bound, name + ", Combine");
  // Slot 1 now holds the combination: squared in place.
  for (std::size_t index = 0; index < size; ++index)
  {
    bound[index] = 4.0 * bound[index] * bound[index];
    combined[index] *= combined[index];
  }
  return device->Scale(1, 1, 1) && device->GetVector(1, found.data()) &&
    IsNear(found, combined, bound, name + ", Scale") && good;
}

bool TestCase(vtkOpenGLLinkOperator* device, const Case& setting)
{
  vtkNew<vtkExchangeMatrix> exchange;
  FillMatrix(exchange, setting.Patches, setting.Kernels);
  device->SetMaximumTextureSize(setting.MaximumTextureSize);
  if (!Check(device->Initialize(exchange, setting.Bands), Describe(setting) + ", Initialize"))
  {
    return false;
  }
  bool good = Check(device->GetNumberOfLinkTextures() == setting.MatrixTextures,
    Describe(setting) + ", " + std::to_string(device->GetNumberOfLinkTextures()) +
      " matrix textures");
  good = TestProducts(device, exchange, setting) && good;
  return TestVectorAlgebra(device, setting) && good;
}

/// Tiles that are not stored are zero, also in textures whose memory held another matrix before.
bool TestSparse(vtkOpenGLLinkOperator* device)
{
  bool good = true;
  for (const Case& setting : { Case{ 1000, 3, 1, 0, 1 }, Case{ 1000, 5, 5, 0, 2 },
         Case{ 1000, 3, 1, 64, 16 * 4 }, Case{ 200, 1, 1, 0, 1 } })
  {
    good = TestCase(device, setting) && good;
    vtkNew<vtkExchangeMatrix> sparse;
    FillMatrix(sparse, setting.Patches, setting.Kernels, true);
    good = Check(device->Initialize(sparse, setting.Bands), "a sparse matrix is refused") &&
      TestProducts(device, sparse, setting) && good;
  }
  return good;
}

/// A solver that diverges must see it: what is not finite stays so, in its own band.
bool TestNotFinite()
{
  vtkNew<vtkExchangeMatrix> exchange;
  FillMatrix(exchange, 300, 1);
  vtkNew<vtkOpenGLLinkOperator> device;
  bool good = device->Initialize(exchange, 3);
  for (double culprit : { std::nan(""), 1e300, -HUGE_VAL })
  {
    Vector x(3 * 300, 0.5);
    x[3 * 77 + 1] = culprit;
    Vector norm(3);
    Vector dot(3);
    good = good && device->SetVector(0, x.data()) && device->MaxNorm(0, norm.data()) &&
      device->Dot(0, 0, dot.data());
    good = Check(!std::isfinite(norm[1]) && !std::isfinite(dot[1]), "a NaN or infinity is lost") &&
      Check(norm[0] == 0.5 && norm[2] == 0.5 && dot[0] == 75.0, "it spreads to other bands") &&
      good;
  }
  return good;
}

/// A solver's iteration reads one number per band; only the answer is read whole.
bool TestBytesRead()
{
  vtkNew<vtkExchangeMatrix> exchange;
  FillMatrix(exchange, 300, 1);
  vtkNew<vtkOpenGLLinkOperator> device;
  const Vector x = MakeVector<float>(3 * 300, 1);
  const Vector one(3, 1.0);
  Vector numbers(3);
  bool good = device->Initialize(exchange, 3) && device->SetVector(0, x.data());
  for (int iteration = 0; iteration < 10; ++iteration)
  {
    good = good && device->Multiply(1, 0) && device->Scale(1, 1, 0) &&
      device->Combine(2, one.data(), 0, one.data(), 1);
  }
  good = Check(device->GetNumberOfBytesRead() == 0, "vectors travel while nobody asks") && good;
  good = good && device->Dot(0, 1, numbers.data()) && device->MaxNorm(2, numbers.data());
  good = Check(device->GetNumberOfBytesRead() == 32, "a number per band takes more than a texel") &&
    good;
  Vector whole(x.size());
  good = good && device->GetVector(2, whole.data());
  return Check(device->GetNumberOfBytesRead() == 32 + 512 * 16,
           "a vector of 300 patches takes " + std::to_string(device->GetNumberOfBytesRead()) +
             " bytes") &&
    good;
}

bool TestUserWindows()
{
  const Case setting = { 300, 3, 1, 0, 1 };
  std::string reason;
  vtkNew<vtkOpenGLLinkOperator> device;
  bool good = TestCase(device, setting);
  device->Release();
  good = TestCase(device, setting) && good;

  auto window = vtkSmartPointer<vtkOffScreenOpenGLRenderWindow>::New();
  device->SetRenderWindow(window);
  good =
    TestCase(device, setting) && Check(!window->IsCurrent(), "the context stays current") && good;
  auto second = vtkSmartPointer<vtkOffScreenOpenGLRenderWindow>::New();
  device->SetRenderWindow(second);
  window = nullptr;
  good = TestCase(device, setting) && good;

  // A context that was current before is current after.
  vtkNew<vtkOffScreenOpenGLRenderWindow> bystander;
  bystander->Open(reason);
  good =
    TestCase(device, setting) && Check(bystander->IsCurrent(), "another context is lost") && good;

  // The window lets go of its resources: an error, and a fresh start.
  vtkNew<vtkTest::ErrorObserver> observer;
  device->AddObserver(vtkCommand::ErrorEvent, observer);
  second->Finalize();
  good = Check(!device->Multiply(1, 0), "Multiply without a context") &&
    observer->CheckErrorMessage("Initialize()") == 0 && good;
  good = TestCase(device, setting) && good;
  second = nullptr;
  good = Check(!device->Multiply(1, 0), "Multiply without a window") &&
    observer->CheckErrorMessage("Initialize()") == 0 && good;
  good = Check(!device->Open(reason), "a window that is gone opens") && good;
  device->SetRenderWindow(nullptr);
  return TestCase(device, setting) && good;
}

bool TestErrors()
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkOpenGLLinkOperator> device;
  device->AddObserver(vtkCommand::ErrorEvent, observer);
  vtkNew<vtkExchangeMatrix> exchange;
  bool good = Check(!device->Initialize(exchange, 1), "an empty matrix is taken") &&
    observer->CheckErrorMessage("empty") == 0;
  FillMatrix(exchange, 300, 1);
  good = Check(!device->Initialize(exchange, 33), "33 bands are taken") &&
    observer->CheckErrorMessage("32") == 0 && good;
  device->SetMaximumTextureSize(4);
  good = Check(!device->Initialize(exchange, 1), "a vector that does not fit is taken") &&
    observer->CheckErrorMessage("Device to CPU") == 0 && good;
  device->SetMaximumTextureSize(0);
  good = Check(device->Initialize(exchange, 1), "the operator does not recover") &&
    Check(!device->Multiply(1, 0), "an unwritten slot is read") &&
    observer->CheckErrorMessage("Slot 0") == 0 && good;
  vtkNew<vtkExchangeMatrix> part;
  part->Allocate(Vector(300, 1.0), 1, 0, 2);
  good = Check(!device->Initialize(part, 1), "a part of a matrix is taken") &&
    observer->CheckErrorMessage("parts") == 0 && good;
  vtkNew<vtkExchangeMatrix> threeKernels;
  FillMatrix(threeKernels, 5, 3);
  return Check(!device->Initialize(threeKernels, 2), "three kernels for two bands are taken") &&
    observer->CheckErrorMessage("kernels") == 0 && good;
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenGLLinkOperator(int, char*[])
{
  const Case cases[] = { { 1, 1, 1, 0, 1 }, { 5, 3, 1, 0, 1 }, { 300, 1, 1, 0, 1 },
    { 300, 5, 1, 0, 1 }, { 1000, 3, 1, 0, 1 }, { 300, 32, 1, 0, 1 }, { 1, 3, 3, 0, 1 },
    { 5, 3, 3, 0, 1 }, { 300, 3, 3, 0, 1 }, { 1000, 3, 3, 0, 1 }, { 300, 32, 32, 0, 8 },
    { 300, 6, 3, 0, 1 }, { 1000, 24, 3, 0, 1 }, { 300, 10, 5, 0, 2 }, { 1000, 6, 3, 64, 16 * 16 },
    { 5, 3, 1, 64, 1 }, { 300, 3, 1, 64, 5 * 2 }, { 300, 5, 5, 64, 5 * 5 * 2 },
    { 1000, 3, 1, 64, 16 * 4 }, { 1000, 1, 1, 100, 16 * 3 }, { 1000, 3, 3, 64, 16 * 16 } };
  vtkNew<vtkOpenGLLinkOperator> device;
  bool good = true;
  for (const Case& setting : cases)
  {
    good = TestCase(device, setting) && good;
  }
  good = TestSparse(device) && good;
  good = TestNotFinite() && good;
  good = TestBytesRead() && good;
  good = TestUserWindows() && good;
  good = TestErrors() && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
