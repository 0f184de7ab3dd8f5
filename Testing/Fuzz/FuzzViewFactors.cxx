// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Any file is refused with an error, or gives view factors that the filters can use.
#include "FuzzFile.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRadiosity.h"
#include "vtkViewFactors.h"

#include <algorithm>
#include <cstring>
#include <vector>

using namespace LightTransportFuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{
//------------------------------------------------------------------------------
// Two squares: those that the files of the corpus were computed for, one for each kind.
void MakeSquares(vtkPolyData* squares, bool facing)
{
  constexpr double corners[4][2] = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } };
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  for (int square = 0; square < 2; ++square)
  {
    const bool low = (square == 0) == facing;
    polygons->InsertNextCell(4);
    for (int k = 0; k < 4; ++k)
    {
      const double* corner = corners[square == 0 ? k : 3 - k];
      polygons->InsertCellPoint(points->InsertNextPoint(corner[0], corner[1], low ? 0.0 : 1.0));
    }
  }
  squares->SetPoints(points);
  squares->SetPolys(polygons);
  for (const char* name : { "Emission", "Reflectance" })
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName(name);
    values->SetNumberOfTuples(2);
    values->Fill(0.5);
    squares->GetCellData()->AddArray(values);
  }
}

//------------------------------------------------------------------------------
// As in ViewFactorsFile: header, rows, names and numbers, tiles, and a checksum of words of each of
// these; or as in RayHitsFile, where all are whole words. Mutated files are seldom read beyond a
// wrong one.
class ChecksumMender
{
public:
  explicit ChecksumMender(std::vector<std::uint8_t>& bytes) : Bytes(bytes) {}

  void Mend()
  {
    if (this->Bytes.size() < HeaderBytes + Word)
    {
      return;
    }
    this->End = this->Bytes.size() - Word;
    if (std::memcmp(this->Bytes.data(), Rays, std::strlen(Rays)) == 0)
    {
      this->Add(this->End);
      std::memcpy(this->Bytes.data() + this->End, &this->Sum, Word);
      return;
    }
    const std::uint64_t patches = this->Get(72), summaries = this->Get(80);
    this->Add(HeaderBytes);
    this->Add(patches < this->End / BytesPerPatch ? patches * BytesPerPatch : this->End);
    for (std::uint64_t k = 0; k < summaries && this->Place < this->End; ++k)
    {
      const std::uint64_t length = this->Get(this->Place);
      this->Add(Word);
      this->Add(length);
      this->Add(Word);
    }
    this->Add(this->End);
    std::memcpy(this->Bytes.data() + this->End, &this->Sum, Word);
  }

private:
  static constexpr char Rays[] = "vtkLightTransport view factor rays";
  static constexpr std::size_t Word = sizeof(std::uint64_t);
  static constexpr std::size_t HeaderBytes = 96;
  static constexpr std::size_t BytesPerPatch = 80;

  std::uint64_t Get(std::size_t place, std::size_t count = Word) const
  {
    std::uint64_t word = 0;
    std::memcpy(&word, this->Bytes.data() + place, std::min(count, this->Bytes.size() - place));
    return word;
  }

  void Add(std::uint64_t count)
  {
    const std::size_t end = this->Place + std::min<std::uint64_t>(count, this->End - this->Place);
    while (this->Place < end)
    {
      const std::size_t bytes = std::min(Word, end - this->Place);
      this->Sum = (this->Sum ^ this->Get(this->Place, bytes)) * 0x100000001b3;
      this->Sum ^= this->Sum >> 32;
      this->Place += bytes;
    }
  }

  std::vector<std::uint8_t>& Bytes;
  std::size_t Place = 0;
  std::size_t End = 0;
  std::uint64_t Sum = 0xcbf29ce484222325;
};

//------------------------------------------------------------------------------
void Use(vtkViewFactors* factors, bool facing)
{
  vtkNew<vtkPolyData> squares;
  MakeSquares(squares, facing);
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputData(squares);
  radiosity->SetViewFactors(factors);
  radiosity->SetDeviceToCPU();
  factors->SetInputData(squares);
  factors->Update();
  radiosity->Update();
  factors->GetViewFactor(0, 1);
}
} // namespace

//------------------------------------------------------------------------------
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  BeQuiet();
  std::vector<std::uint8_t> bytes(data, data + size);
  if (size > 0 && data[size - 1] % 4 != 0)
  {
    ChecksumMender(bytes).Mend();
  }
  const MemoryFile file(bytes.data(), bytes.size());
  vtkNew<vtkViewFactors> factors;
  if (factors->Load(file.GetName().c_str()))
  {
    Use(factors, true);
    Use(factors, false);
  }
  return 0;
}
