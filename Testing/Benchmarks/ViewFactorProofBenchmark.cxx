// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The estimate "ViewFactorError" on random small scenes, beside brute force that shares no code
 * with the filters: in 99 % of all rows the error must not exceed it by more than three standard
 * errors of the brute force, whose standard error is at most a third of the estimate. Rows whose
 * estimate is so small that no brute force is that exact are counted apart (six standard errors are
 * allowed, because the estimate is nothing beside them).
 *
 * Per kind of scene and way of placing: rows, the share of those that fail by their largest entry,
 * by their sum, and by sky or back faces, the worst error in estimates (less three standard
 * errors), the rows apart and the share of those that fail. Then the worst scenes; --scene N tells
 * all of one.
 */
#include "ViewFactorProof.h"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <iomanip>
#include <map>
#include <sstream>

using namespace LightTransportTesting;

namespace
{
constexpr const char* Usage =
  "usage: ViewFactorProofBenchmark [--scenes N] [--first N] [--tolerances T,T,...] [--kind KIND]\n"
  "                                [--placement NAME] [--retold 1] [--sigma S] [--scene N]\n"
  "  --scenes      how many (default 10000)\n"
  "  --first       number of the first one (default 0)\n"
  "  --tolerances  of the view factors (default 1e-2,1e-3)\n"
  "  --kind        only scenes of that kind\n"
  "  --placement   only those placed that way, \"double\" or \"float, 10 off\" for example\n"
  "  --retold      1: polygons begin at other corners, and one of them is in pieces (default 0)\n"
  "  --sigma       standard error of the brute force at which it stops at the latest (default\n"
  "                3e-5: rows with an estimate of less than three times that are counted apart)\n"
  "  --scene       tell all of one scene\n";

struct Options
{
  int Scenes = 10000;
  int First = 0;
  std::vector<double> Tolerances = { 1e-2, 1e-3 };
  std::string Kind;
  std::string Placement;
  bool Retold = false;
  double Sigma = 3e-5;
  int Scene = -1;
};

struct Tally
{
  int Rows = 0, Largest = 0, Sum = 0, Opening = 0, Apart = 0, ApartFailed = 0;
  double Worst = 0.0;
  void Count(const RowProof& proof)
  {
    const double largest = proof.GetFactor(proof.Largest);
    const double sum = proof.GetFactor(proof.Sum);
    this->Worst = std::max({ this->Worst, largest, sum });
    if (!proof.Tells())
    {
      ++this->Apart;
      this->ApartFailed += std::max(largest, sum) > 1.0 ? 1 : 0;
      return;
    }
    ++this->Rows;
    this->Largest += largest > 1.0 ? 1 : 0;
    this->Sum += sum > 1.0 ? 1 : 0;
    this->Opening += proof.GetFactor(proof.Opening) > 1.0 ? 1 : 0;
  }
};

struct BadScene
{
  double Factor;
  int Number;
  std::string Text;
};

//------------------------------------------------------------------------------
bool ReadOptions(int argc, char* argv[], Options& options)
{
  for (int k = 1; k + 1 < argc; k += 2)
  {
    const std::string name = argv[k];
    const char* value = argv[k + 1];
    if (name == "--scenes")
    {
      options.Scenes = std::atoi(value);
    }
    else if (name == "--first")
    {
      options.First = std::atoi(value);
    }
    else if (name == "--kind")
    {
      options.Kind = value;
    }
    else if (name == "--placement")
    {
      options.Placement = value;
    }
    else if (name == "--retold")
    {
      options.Retold = std::atoi(value) != 0;
    }
    else if (name == "--sigma")
    {
      options.Sigma = std::atof(value);
    }
    else if (name == "--scene")
    {
      options.Scene = std::atoi(value);
    }
    else if (name == "--tolerances")
    {
      options.Tolerances.clear();
      std::istringstream list(value);
      for (std::string number; std::getline(list, number, ',');)
      {
        options.Tolerances.push_back(std::atof(number.c_str()));
      }
    }
    else
    {
      return false;
    }
  }
  return argc % 2 == 1;
}

//------------------------------------------------------------------------------
std::string GetKind(int number)
{
  const auto& kinds = SceneMaker::GetKinds();
  return kinds[number % kinds.size()];
}

//------------------------------------------------------------------------------
void PrintScene(const std::vector<Corners>& polygons, const RandomScene& scene,
  const Placement& placement)
{
  std::cout << scene.Kind << ", " << placement.Name << ", scale " << placement.Scale
            << ", narrowest " << scene.Narrowest << "\n";
  for (std::size_t k = 0; k < polygons.size(); ++k)
  {
    std::cout << "  polygon " << k << ", before it was placed:" << std::setprecision(6);
    for (const Vector& corner : scene.Polygons[k])
    {
      std::cout << " (" << corner.x() << ", " << corner.y() << ", " << corner.z() << ")";
    }
    std::cout << "\n    " << std::setprecision(17);
    for (const Vector& corner : polygons[k])
    {
      std::cout << " (" << corner.x() << ", " << corner.y() << ", " << corner.z() << ")";
    }
    std::cout << std::setprecision(6) << "\n";
  }
}

//------------------------------------------------------------------------------
void PrintRow(const FactorTable& table, std::size_t row, const BruteForceRow& right)
{
  std::cout << "  row " << row << ", estimate " << table.Errors[row] << ", sum " << table.Sums[row]
            << " right " << right.Sum << " +- " << right.SumError << ", sky " << table.Sky[row]
            << " right " << right.Shares[right.GetSky()] << ", back faces " << table.Back[row]
            << " right " << right.Shares[right.GetBack()] << "\n";
  for (std::size_t j = 0; j < table.Size; ++j)
  {
    const double error = std::abs(table.Get(row, j) - right.Shares[j]);
    if (error > 3.0 * right.Errors[j] + 1e-7)
    {
      std::cout << "    to " << j << ": " << table.Get(row, j) << " right " << right.Shares[j]
                << " +- " << right.Errors[j] << "\n";
    }
  }
}

//------------------------------------------------------------------------------
class Proof
{
public:
  explicit Proof(const Options& options) : Settings(options) {}

  void Take(int number)
  {
    const std::string kind = GetKind(number);
    if (!this->Settings.Kind.empty() && kind != this->Settings.Kind)
    {
      return;
    }
    SceneMaker maker(number);
    RandomScene scene = maker.Make(kind);
    const Placement placement = maker.MakePlacement();
    if (!this->Settings.Placement.empty() && placement.Name != this->Settings.Placement)
    {
      return;
    }
    if (this->Settings.Retold)
    {
      scene.Polygons = Retell(scene.Polygons, number).Polygons;
    }
    const std::vector<Corners> polygons = Place(scene.Polygons, placement);
    const bool tell = this->Settings.Scene >= 0;
    if (tell)
    {
      PrintScene(polygons, scene, placement);
    }
    const BruteForce force(polygons, BruteForce::GetWorth(polygons, placement.Single));
    std::vector<BruteForceRow> rows(polygons.size());
    for (std::size_t k = this->Settings.Tolerances.size(); k > 0; --k)
    {
      this->Compute(number, polygons, placement, this->Settings.Tolerances[k - 1], force, rows,
        kind, tell);
    }
  }

  void Print() const
  {
    for (const auto& [tolerance, tallies] : this->Tallies)
    {
      std::cout << "\nTolerance " << tolerance << "\n"
                << std::left << std::setw(30) << "scenes" << std::right << std::setw(8) << "rows"
                << std::setw(10) << "entry %" << std::setw(10) << "sum %" << std::setw(10)
                << "sky %" << std::setw(12) << "worst" << std::setw(8) << "apart" << std::setw(10)
                << "failed %"
                << "\n";
      for (const auto& [name, tally] : tallies)
      {
        const double rows = std::max(tally.Rows, 1);
        std::cout << std::left << std::setw(30) << name << std::right << std::setw(8) << tally.Rows
                  << std::setprecision(3) << std::setw(10) << 100.0 * tally.Largest / rows
                  << std::setw(10) << 100.0 * tally.Sum / rows << std::setw(10)
                  << 100.0 * tally.Opening / rows << std::setw(12) << tally.Worst << std::setw(8)
                  << tally.Apart << std::setw(10)
                  << 100.0 * tally.ApartFailed / std::max(tally.Apart, 1) << "\n";
      }
      auto bad = this->Bad.at(tolerance);
      std::sort(bad.begin(), bad.end(),
        [](const BadScene& a, const BadScene& b) { return a.Factor > b.Factor; });
      for (std::size_t k = 0; k < bad.size() && k < 10; ++k)
      {
        std::cout << "  scene " << bad[k].Number << ": " << bad[k].Text << "\n";
      }
    }
    std::cout << "seconds of vtkViewFactors " << this->Seconds << ", of brute force "
              << this->ForceSeconds << "\n";
  }

private:
  static double GetSeconds()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
  }

  void Compute(int number, const std::vector<Corners>& polygons, const Placement& placement,
    double tolerance, const BruteForce& force, std::vector<BruteForceRow>& rows,
    const std::string& kind, bool tell)
  {
    double begin = GetSeconds();
    const FactorTable table = MakeFactorTable(polygons, placement.Single, tolerance);
    this->Seconds += GetSeconds() - begin;
    begin = GetSeconds();
    BadScene worst = { 1.0, number, "" };
    const std::vector<double> widths = GetWidths(polygons);
    const double worth = BruteForce::GetWorth(polygons, placement.Single);
    for (std::size_t row = 0; row < polygons.size(); ++row)
    {
      // As exact as this tolerance needs; what is there from a smaller one may do.
      const double ambiguity = GetAmbiguity(table, row, widths, worth);
      const double sigma =
        std::max((table.Errors[row] + ambiguity + 1e-7) / 3.0, this->Settings.Sigma);
      BruteForceRow& right = rows[row];
      if (right.Shares.empty() || right.SumError > sigma ||
        *std::max_element(right.Errors.begin(), right.Errors.end()) > sigma)
      {
        right = force.Count(row, sigma, number);
      }
      const RowProof proof = Compare(table, row, right, ambiguity);
      for (const std::string& name : { kind + ", " + placement.Name, std::string("all") })
      {
        this->Tallies[tolerance][name].Count(proof);
      }
      if (tell)
      {
        PrintRow(table, row, right);
      }
      for (const Deviation& deviation : { proof.Largest, proof.Sum })
      {
        const double factor = proof.GetFactor(deviation);
        if (factor > worst.Factor)
        {
          std::ostringstream text;
          text << kind << ", " << placement.Name << ", scale " << placement.Scale << ", row " << row
               << " " << deviation.What << ", estimate " << proof.Estimate << ", " << factor
               << " times";
          worst = { factor, number, text.str() };
        }
      }
    }
    this->ForceSeconds += GetSeconds() - begin;
    auto& bad = this->Bad[tolerance];
    if (worst.Factor > 1.0)
    {
      bad.push_back(worst);
    }
  }

  Options Settings;
  std::map<double, std::map<std::string, Tally>> Tallies;
  std::map<double, std::vector<BadScene>> Bad;
  double Seconds = 0.0;
  double ForceSeconds = 0.0;
};
} // namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Options options;
  if (!ReadOptions(argc, argv, options))
  {
    std::cerr << Usage;
    return EXIT_FAILURE;
  }
  Proof proof(options);
  if (options.Scene >= 0)
  {
    proof.Take(options.Scene);
  }
  else
  {
    for (int number = options.First; number < options.First + options.Scenes; ++number)
    {
      proof.Take(number);
    }
  }
  proof.Print();
  return EXIT_SUCCESS;
}
