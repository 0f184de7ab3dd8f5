// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The exchange matrix and the link operator on the CPU, against plain loops in double precision.
#include "LightTransportTesting.h"
#include "vtkDenseLinkOperator.h"
#include "vtkExchangeMatrix.h"
#include "vtkSMPTools.h"
#include "vtkTestErrorObserver.h"

#include <algorithm>
#include <random>
#include <set>

using namespace LightTransportTesting;

namespace
{
constexpr int N = vtkExchangeMatrix::TileSize;

//------------------------------------------------------------------------------
// A symmetric matrix whose values single precision holds exactly, so that the loops below see the
// same ones.
double GetEntry(vtkIdType i, vtkIdType j, int kernel)
{
  const vtkIdType low = std::min(i, j), high = std::max(i, j);
  return static_cast<double>((low * 7 + high * 13 + low * high + kernel * 5 + 1) % 64) / 64.0;
}

//------------------------------------------------------------------------------
void Fill(const vtkExchangeMatrix* matrix, vtkExchangeMatrix::Tile& tile)
{
  const vtkIdType n = matrix->GetNumberOfPatches();
  for (int row = 0; row < N && tile.Row * N + row < n; ++row)
  {
    for (int column = tile.Row == tile.Column ? row : 0; column < N && tile.Column * N + column < n;
         ++column)
    {
      for (int kernel = 0; kernel < matrix->GetNumberOfKernels(); ++kernel)
      {
        vtkExchangeMatrix::SetValue(tile, row, column, kernel,
          GetEntry(tile.Row * N + row, tile.Column * N + column, kernel));
      }
    }
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkExchangeMatrix> MakeMatrix(vtkIdType n, int kernels, int part = 0, int parts = 1)
{
  auto matrix = vtkSmartPointer<vtkExchangeMatrix>::New();
  Check(matrix->Allocate(std::vector<double>(n, 1.0), kernels, part, parts), "allocation");
  for (vtkExchangeMatrix::Tile& tile : matrix->GetTiles())
  {
    Fill(matrix, tile);
  }
  return matrix;
}

//------------------------------------------------------------------------------
std::vector<double> MakeVector(vtkIdType n, int bands, unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> values(n * bands);
  std::generate(values.begin(), values.end(), [&]() { return uniform(generator); });
  return values;
}

//------------------------------------------------------------------------------
double Compare(const std::vector<double>& a, const std::vector<double>& b)
{
  double worst = 0.0, size = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    worst = std::max(worst, std::abs(a[k] - b[k]));
    size = std::max(size, std::abs(b[k]));
  }
  return worst / size;
}

//------------------------------------------------------------------------------
std::vector<double> Multiply(const std::vector<double>& x, vtkIdType n, int bands, int kernels)
{
  std::vector<double> y(x.size(), 0.0);
  for (vtkIdType i = 0; i < n; ++i)
  {
    for (vtkIdType j = 0; j < n; ++j)
    {
      for (int band = 0; band < bands; ++band)
      {
        y[i * bands + band] += GetEntry(i, j, band % kernels) * x[j * bands + band];
      }
    }
  }
  return y;
}

//------------------------------------------------------------------------------
void TestProducts(vtkIdType n, int bands, int kernels)
{
  const std::string what = " (n " + std::to_string(n) + ", bands " + std::to_string(bands) +
    ", kernels " + std::to_string(kernels) + ")";
  auto matrix = MakeMatrix(n, kernels);
  vtkNew<vtkDenseLinkOperator> links;
  Check(links->Initialize(matrix, bands), "initialize" + what);
  const std::vector<double> x = MakeVector(n, bands, 1), left = MakeVector(n, bands, 2),
                            right = MakeVector(n, bands, 3);
  links->SetVector(0, x.data());
  links->SetVector(1, left.data());
  links->SetVector(2, right.data());
  std::vector<double> result(x.size());

  Check(links->Multiply(3, 0) && links->GetVector(3, result.data()), "multiply" + what);
  Check(Compare(result, Multiply(x, n, bands, kernels)) < 1e-13, "product" + what);

  std::vector<double> scaled = x;
  std::transform(x.begin(), x.end(), right.begin(), scaled.begin(), std::multiplies<double>());
  scaled = Multiply(scaled, n, bands, kernels);
  std::transform(scaled.begin(), scaled.end(), left.begin(), scaled.begin(),
    std::multiplies<double>());
  Check(links->Apply(3, 1, 2, 0, 4) && links->GetVector(3, result.data()), "apply" + what);
  Check(Compare(result, scaled) < 1e-13, "y = L G R x" + what);

  const std::vector<double> a = MakeVector(bands, 1, 4), b = MakeVector(bands, 1, 5);
  links->Combine(1, a.data(), 0, b.data(), 1);
  links->GetVector(1, result.data());
  std::vector<double> dot(bands), norm(bands), expectedDot(bands, 0.0), expectedNorm(bands, 0.0);
  links->Dot(0, 2, dot.data());
  links->MaxNorm(0, norm.data());
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    CheckClose(result[k], a[k % bands] * x[k] + b[k % bands] * left[k], 1e-12,
      "combination" + what);
    expectedDot[k % bands] += x[k] * right[k];
    expectedNorm[k % bands] = std::max(expectedNorm[k % bands], std::abs(x[k]));
  }
  for (int band = 0; band < bands; ++band)
  {
    Check(std::abs(dot[band] - expectedDot[band]) < 1e-12 * n, "dot product" + what);
    Check(norm[band] == expectedNorm[band], "largest value" + what);
  }
}

//------------------------------------------------------------------------------
// One sweep against the textbook's loop.
void TestSweep(vtkIdType n, int bands, int kernels)
{
  auto matrix = MakeMatrix(n, kernels);
  vtkNew<vtkDenseLinkOperator> links;
  links->Initialize(matrix, bands);
  std::vector<double> x = MakeVector(n, bands, 1), e = MakeVector(n, bands, 2),
                      left = MakeVector(n, bands, 3);
  for (double& value : left)
  {
    value /= static_cast<double>(n);
  }
  links->SetVector(0, x.data());
  links->SetVector(1, e.data());
  links->SetVector(2, left.data());
  links->Sweep(0, 1, 2);
  std::vector<double> result(x.size()), row(n);
  links->GetVector(0, result.data());
  for (vtkIdType i = 0; i < n; ++i)
  {
    for (int band = 0; band < bands; ++band)
    {
      links->GetRow(i, band, row.data());
      double sum = 0.0;
      for (vtkIdType j = 0; j < n; ++j)
      {
        Check(row[j] == GetEntry(i, j, band % kernels), "row of the matrix");
        sum += row[j] * x[j * bands + band];
      }
      x[i * bands + band] = e[i * bands + band] + left[i * bands + band] * sum;
    }
  }
  Check(Compare(result, x) < 1e-13, "Gauss-Seidel sweep");
}

//------------------------------------------------------------------------------
// The parts of a matrix add up to it, and each holds its share of the tiles.
void TestParts()
{
  constexpr vtkIdType n = 700;
  auto whole = MakeMatrix(n, 1);
  double bytes = 0.0;
  std::vector<vtkSmartPointer<vtkExchangeMatrix>> parts;
  for (int part = 0; part < 4; ++part)
  {
    parts.push_back(MakeMatrix(n, 1, part, 4));
    bytes += parts.back()->GetNumberOfBytes();
    Check(parts.back()->GetTiles().size() <= 2, "6 tiles over 4 parts");
  }
  CheckClose(bytes, whole->GetNumberOfBytes(), 1e-15, "bytes of the parts");
  CheckClose(whole->GetNumberOfBytes(), vtkExchangeMatrix::GetEstimatedBytes(n, 1), 1e-15,
    "bytes as estimated");
  for (vtkIdType i = 0; i < n; i += 13)
  {
    for (vtkIdType j = 0; j < n; j += 17)
    {
      double sum = 0.0;
      for (const auto& part : parts)
      {
        sum += part->GetValue(i, j);
      }
      Check(sum == GetEntry(i, j, 0) && whole->GetValue(j, i) == sum, "value of the parts");
    }
  }
}

//------------------------------------------------------------------------------
// Which tiles of a sparse matrix are there: some of the diagonal and some beside it.
bool IsStored(const vtkExchangeMatrix::Tile& tile)
{
  return (3 * tile.Row + 2 * tile.Column) % 4 != 1;
}

//------------------------------------------------------------------------------
// The same matrix twice: without the tiles that are zero, and with zeros.
std::pair<vtkSmartPointer<vtkExchangeMatrix>, vtkSmartPointer<vtkExchangeMatrix>>
MakeSparseAndDense(vtkIdType n, int kernels, int part = 0, int parts = 1)
{
  auto sparse = vtkSmartPointer<vtkExchangeMatrix>::New();
  auto dense = vtkSmartPointer<vtkExchangeMatrix>::New();
  sparse->AllocateSparse(std::vector<double>(n, 1.0), kernels, part, parts);
  Check(dense->Allocate(std::vector<double>(n, 1.0), kernels, part, parts), "dense allocation");
  Check(sparse->GetTiles().size() == dense->GetTiles().size(), "all tiles are listed");
  for (std::size_t t = 0; t < sparse->GetTiles().size(); ++t)
  {
    vtkExchangeMatrix::Tile& tile = sparse->GetTiles()[t];
    Check(tile.Values == nullptr, "a new sparse matrix stores nothing");
    if (IsStored(tile))
    {
      Check(sparse->AllocateTile(tile), "allocation of a tile");
      Fill(sparse, tile);
      Fill(dense, dense->GetTiles()[t]);
    }
  }
  return { sparse, dense };
}

//------------------------------------------------------------------------------
// Bit by bit, apart from the order in which threads add up a product.
void TestSparse(vtkIdType n, int bands, int kernels)
{
  const std::string what = " (sparse, n " + std::to_string(n) + ", bands " + std::to_string(bands) +
    ", kernels " + std::to_string(kernels) + ")";
  const auto matrices = MakeSparseAndDense(n, kernels);
  const std::vector<double> x = MakeVector(n, bands, 1), e = MakeVector(n, bands, 2),
                            left(n * bands, 1.0 / static_cast<double>(n));
  std::vector<double> products[2], sweeps[2], rows[2];
  int which = 0;
  for (vtkExchangeMatrix* matrix : { matrices.first.Get(), matrices.second.Get() })
  {
    vtkNew<vtkDenseLinkOperator> links;
    Check(links->Initialize(matrix, bands), "initialize" + what);
    links->SetVector(0, x.data());
    links->SetVector(1, e.data());
    links->SetVector(2, left.data());
    products[which].resize(x.size());
    sweeps[which].resize(x.size());
    Check(links->Apply(3, 2, 2, 0, 4) && links->GetVector(3, products[which].data()), "y" + what);
    Check(links->Sweep(0, 1, 2) && links->GetVector(0, sweeps[which].data()), "sweep" + what);
    for (vtkIdType i = 0; i < n; i += 97)
    {
      std::vector<double> row(n, -1.0);
      Check(links->GetRow(i, bands - 1, row.data()), "row" + what);
      rows[which].insert(rows[which].end(), row.begin(), row.end());
    }
    ++which;
  }
  Check(Compare(products[0], products[1]) < 1e-14, "product" + what);
  Check(Compare(sweeps[0], sweeps[1]) < 1e-14, "Gauss-Seidel sweep" + what);
  Check(rows[0] == rows[1], "rows" + what);
}

//------------------------------------------------------------------------------
void TestSparseParts()
{
  constexpr vtkIdType n = 1100;
  constexpr int parts = 4;
  const auto whole = MakeSparseAndDense(n, 2);
  std::vector<vtkSmartPointer<vtkExchangeMatrix>> matrices;
  vtkIdType stored = 0;
  for (int part = 0; part < parts; ++part)
  {
    matrices.push_back(MakeSparseAndDense(n, 2, part, parts).first);
    stored += matrices.back()->GetNumberOfStoredTiles();
  }
  Check(stored == whole.first->GetNumberOfStoredTiles(), "stored tiles of the parts");
  for (vtkIdType i = 0; i < n; i += 31)
  {
    for (vtkIdType j = 0; j < n; j += 37)
    {
      double sum = 0.0;
      for (const auto& part : matrices)
      {
        sum += part->GetValue(i, j, 1);
      }
      Check(sum == whole.second->GetValue(j, i, 1), "value of the sparse parts");
      Check(whole.first->GetValue(i, j, 1) == sum, "value of the sparse matrix");
    }
  }
}

//------------------------------------------------------------------------------
void TestStorage()
{
  constexpr vtkIdType n = 30 * N - 5;
  vtkNew<vtkExchangeMatrix> matrix;
  matrix->AllocateSparse(std::vector<double>(n, 1.0), 1);
  auto& tiles = matrix->GetTiles();
  Check(tiles.size() == 465 && matrix->GetNumberOfStoredTiles() == 0 &&
      matrix->GetNumberOfBytes() == 0.0 && matrix->GetValue(5, 7000) == 0.0,
    "a sparse matrix starts with nothing");

  // Threads allocate all tiles at the same time; no two may share memory.
  vtkSMPTools::LocalScope(vtkSMPTools::Config("STDThread"),
    [&]()
    {
      vtkSMPTools::For(0, static_cast<vtkIdType>(tiles.size()), 1,
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType t = begin; t < end; ++t)
          {
            matrix->AllocateTile(tiles[t]);
            std::fill_n(tiles[t].Values, N * N, static_cast<float>(t));
          }
        });
    });
  CheckClose(matrix->GetNumberOfBytes(), vtkExchangeMatrix::GetEstimatedBytes(n, 1), 1e-15,
    "bytes with all tiles stored");
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    const float* values = tiles[t].Values;
    Check(std::count(values, values + N * N, static_cast<float>(t)) == N * N, "shared memory");
  }

  // What is released is used again, and holds zeros again.
  const std::set<float*> before{ tiles[3].Values, tiles[400].Values };
  matrix->ReleaseTile(tiles[3]);
  matrix->ReleaseTile(tiles[400]);
  matrix->ReleaseTile(tiles[400]);
  Check(matrix->GetNumberOfStoredTiles() == 463 && !tiles[3].Values, "released tiles");
  CheckClose(matrix->GetNumberOfBytes(), 463.0 * N * N * sizeof(float), 0.0, "bytes after release");
  Check(matrix->AllocateTile(tiles[400]) && matrix->AllocateTile(tiles[3]), "allocation again");
  Check(before == std::set<float*>{ tiles[3].Values, tiles[400].Values }, "memory used again");
  Check(std::count(tiles[3].Values, tiles[3].Values + N * N, 0.0f) == N * N &&
      std::count(tiles[400].Values, tiles[400].Values + N * N, 0.0f) == N * N,
    "zeros in memory that is used again");
  Check(matrix->AllocateTile(tiles[1]) && tiles[1].Values[0] == 1.0f, "a stored tile stays");

  matrix->AllocateSparse({}, 1);
  Check(matrix->GetTiles().empty() && matrix->GetNumberOfBytes() == 0.0, "emptied");
}

//------------------------------------------------------------------------------
void TestErrors()
{
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkDenseLinkOperator> links;
  links->AddObserver(vtkCommand::ErrorEvent, errors);
  const auto expect = [&](bool failed, const char* part)
  {
    Check(failed && errors->GetErrorMessage().find(part) != std::string::npos, part);
    errors->Clear();
  };
  auto matrix = MakeMatrix(10, 2);
  expect(!links->Multiply(1, 0), "call Initialize first");
  expect(!links->GetRow(0, 0, nullptr), "call Initialize");
  expect(!links->Initialize(nullptr, 1), "needs an exchange matrix");
  expect(!links->Initialize(matrix, 3), "2 kernels for 3 bands");
  expect(!links->Initialize(MakeMatrix(10, 1, 0, 2), 1), "2 parts");
  links->Initialize(matrix, 2);
  expect(!links->Multiply(1, 0), "before it was written");
  const std::vector<double> x(20, 1.0);
  links->SetVector(0, x.data());
  expect(!links->Multiply(0, 0), "two different vectors");
}
} // namespace

//------------------------------------------------------------------------------
int TestLinkOperator(int, char*[])
{
  for (const vtkIdType n : { 1, 2, 255, 257, 700 })
  {
    for (const int bands : { 1, 2, 3, 4, 5, 9 })
    {
      TestProducts(n, bands, 1);
    }
    TestProducts(n, 3, 3);
    TestProducts(n, 6, 3);
    TestProducts(n, 15, 3);
  }
  TestSweep(300, 3, 1);
  TestSweep(520, 2, 2);
  TestSweep(520, 6, 2);
  TestParts();
  TestSparse(700, 3, 1);
  TestSparse(1100, 2, 2);
  TestSparseParts();
  TestStorage();
  TestErrors();
  return Result();
}
