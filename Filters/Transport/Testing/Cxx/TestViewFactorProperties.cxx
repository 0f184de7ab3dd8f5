// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What is true of view factors of every scene, on a thousand random ones: reciprocity, rows that
// sum to 1 with their openings, no more than with nothing in between, and the same factors for the
// same surfaces told in another way: polygons that begin at another corner, one of them cut in
// pieces (the other side of a sheet, of a party wall), elsewhere, turned, in other units, in single
// precision.
#include "ViewFactorProof.h"

#include <map>

using namespace LightTransportTesting;

namespace
{
constexpr int Scenes = 1000;
constexpr double Tolerance = 1e-2;
/// What storage in single precision may move in a row.
constexpr double Single = 2e-7;

//------------------------------------------------------------------------------
/// The table of the surfaces that another one tells in pieces.
FactorTable Merge(const FactorTable& pieces, const Retold& retold, std::size_t size)
{
  FactorTable table;
  table.Size = size;
  table.Factors.assign(size * size, 0.0);
  table.Sums = table.Errors = table.Sky = table.Back = std::vector<double>(size, 0.0);
  std::vector<double> areas(size, 0.0);
  for (std::size_t i = 0; i < pieces.Size; ++i)
  {
    areas[retold.Parts[i]] += GetArea(retold.Polygons[i]);
  }
  for (std::size_t i = 0; i < pieces.Size; ++i)
  {
    const std::size_t row = retold.Parts[i];
    const double share = GetArea(retold.Polygons[i]) / areas[row];
    table.Sums[row] += share * pieces.Sums[i];
    table.Errors[row] += share * pieces.Errors[i];
    table.Sky[row] += share * pieces.Sky[i];
    table.Back[row] += share * pieces.Back[i];
    for (std::size_t j = 0; j < pieces.Size; ++j)
    {
      table.Factors[row * size + retold.Parts[j]] += share * pieces.Get(i, j);
    }
  }
  return table;
}

//------------------------------------------------------------------------------
/// How often a property was asked for, and how often it did not hold.
class Ledger
{
public:
  void Note(const std::string& property, int scene, double factor, const std::string& text)
  {
    Entry& entry = this->Entries[property];
    ++entry.Rows;
    entry.Failed += factor > 1.0 ? 1 : 0;
    if (factor > entry.Worst)
    {
      entry.Worst = factor;
      entry.Text = "scene " + std::to_string(scene) + ", " + text;
    }
  }

  /// At most a share of the rows may fail.
  void Check(const std::string& property, double share) const
  {
    const auto found = this->Entries.find(property);
    if (!LightTransportTesting::Check(found != this->Entries.end(), property + " was asked for"))
    {
      return;
    }
    const Entry& entry = found->second;
    LightTransportTesting::Check(entry.Failed <= share * entry.Rows,
      property + " does not hold in " + std::to_string(entry.Failed) + " of " +
        std::to_string(entry.Rows) + ", worst " + std::to_string(entry.Worst) +
        " times what is allowed: " + entry.Text);
  }

private:
  struct Entry
  {
    int Rows = 0;
    int Failed = 0;
    double Worst = 0.0;
    std::string Text;
  };
  std::map<std::string, Entry> Entries;
};

//------------------------------------------------------------------------------
std::string Describe(const RandomScene& scene, const Placement& placement, std::size_t row)
{
  return scene.Kind + ", " + placement.Name + ", row " + std::to_string(row);
}

//------------------------------------------------------------------------------
/// What moving corners by what coordinates lost changes in a row, for corners about 1 apart.
double GetLoss(const RandomScene& scene, const Placement& placement)
{
  const double worth =
    BruteForce::GetWorth(Place(scene.Polygons, placement), placement.Single) / placement.Scale;
  return 10.0 * worth / scene.Narrowest;
}

//------------------------------------------------------------------------------
void CheckRows(const FactorTable& table, const std::vector<Corners>& polygons, int number,
  const RandomScene& scene, const Placement& placement, Ledger& ledger)
{
  const double loss = GetLoss(scene, placement);
  for (std::size_t i = 0; i < table.Size; ++i)
  {
    const std::string text = Describe(scene, placement, i);
    const double identity = std::abs(table.Sums[i] + table.Sky[i] + table.Back[i] - 1.0);
    ledger.Note("F + sky + back faces = 1", number, identity / (table.Errors[i] + Single), text);
    ledger.Note("F + sky + back faces = 1 but for 0.02", number, identity / 0.02, text);
    for (std::size_t j = 0; j < i; ++j)
    {
      const double here = GetArea(polygons[i]) * table.Get(i, j);
      const double there = GetArea(polygons[j]) * table.Get(j, i);
      const double allowed = (Single + loss) * std::max(here, there);
      if (allowed > 0.0)
      {
        ledger.Note("reciprocity", number, std::abs(here - there) / allowed,
          text + " and " + std::to_string(j));
      }
    }
  }
}

//------------------------------------------------------------------------------
/// The factor with nothing in between, of a random pair.
void CheckUnobstructed(const FactorTable& table, const std::vector<Corners>& polygons, int number,
  const RandomScene& scene, const Placement& placement, Random& numbers, Ledger& ledger)
{
  const std::size_t i = numbers.Index(static_cast<int>(polygons.size()));
  const std::size_t j = numbers.Index(static_cast<int>(polygons.size()));
  if (i == j)
  {
    return;
  }
  const FactorTable pair =
    MakeFactorTable({ polygons[i], polygons[j] }, placement.Single, Tolerance);
  const double allowed =
    table.Errors[i] + pair.Errors[0] + Single + GetLoss(scene, placement) * pair.Get(0, 1);
  ledger.Note("F at most unobstructed", number,
    std::max(table.Get(i, j) - pair.Get(0, 1), 0.0) / allowed, Describe(scene, placement, i));
}

//------------------------------------------------------------------------------
/// The same surfaces in another way: both estimates together cover what changes.
void CheckRetold(const FactorTable& table, const Retold& retold, int number,
  const RandomScene& scene, const Placement& before, const Placement& placement, Ledger& ledger)
{
  const Retold placed = { Place(retold.Polygons, placement), retold.Parts };
  const FactorTable other =
    Merge(MakeFactorTable(placed.Polygons, placement.Single, Tolerance), placed, table.Size);
  const double loss = GetLoss(scene, before) + GetLoss(scene, placement);
  for (std::size_t i = 0; i < table.Size; ++i)
  {
    double change = 0.0;
    for (std::size_t j = 0; j < table.Size; ++j)
    {
      change += std::abs(table.Get(i, j) - other.Get(i, j));
    }
    const double allowed = table.Errors[i] + other.Errors[i] + Single + loss;
    ledger.Note("the same surfaces, the same factors", number, change / allowed,
      Describe(scene, before, i) + " and " + placement.Name);
  }
}

//------------------------------------------------------------------------------
void TestScene(int number, Ledger& ledger)
{
  SceneMaker maker(number);
  const auto& kinds = SceneMaker::GetKinds();
  const RandomScene scene = maker.Make(kinds[number % kinds.size()]);
  const Placement placement = maker.MakePlacement();
  const auto polygons = Place(scene.Polygons, placement);
  const FactorTable table = MakeFactorTable(polygons, placement.Single, Tolerance);
  Random numbers(MixBits(number + 77));
  CheckRows(table, polygons, number, scene, placement, ledger);
  CheckUnobstructed(table, polygons, number, scene, placement, numbers, ledger);
  const Retold retold = Retell(scene.Polygons, number);
  CheckRetold(table, retold, number, scene, placement, maker.MakePlacement(), ledger);
}
} // namespace

//------------------------------------------------------------------------------
int TestViewFactorProperties(int, char*[])
{
  Ledger ledger;
  for (int number = 0; number < Scenes; ++number)
  {
    TestScene(number, ledger);
  }
  ledger.Check("reciprocity", 0.0);
  ledger.Check("F + sky + back faces = 1", 0.005);
  ledger.Check("F + sky + back faces = 1 but for 0.02", 0.0);
  ledger.Check("F at most unobstructed", 0.0);
  ledger.Check("the same surfaces, the same factors", 0.002);
  return Result();
}
