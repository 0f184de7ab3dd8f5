// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Fills this rank's part of an exchange matrix with the exchange between all patches of a scene, in
 * two stages:
 *
 *   1. *Look*: for each pair of blocks the exchange with nothing in between (UnoccludedPairs); then
 *      down both nodes of the tree with the list of walls that may be between them (ShaftCuller):
 *      where it becomes empty all pairs below are visible, where one of them stands in all ways
 *      they are hidden, where little is at stake rays judge (BlockRays), and whatever remains at a
 * pair is looked past from a few points (PairVisibility). Pairs that are then neither visible nor
 * hidden for certain are put down.
 *   2. *Refine*: how many such pairs a row has, and how large, says how exact each of them must be;
 *      those that are not yet are integrated until they are.
 */
#ifndef ViewFactorAssembly_h
#define ViewFactorAssembly_h

#include "Geometry/ShaftCuller.h"
#include "ViewFactors/BlockRays.h"
#include "ViewFactors/PairVisibility.h"
#include "ViewFactors/PartlyVisiblePair.h"
#include "ViewFactors/UnoccludedPairs.h"
#include "vtkExchangeMatrix.h"

#include <memory>
#include <vector>

namespace LightTransport
{
class Ranks;

class ViewFactorAssembly
{
public:
  ///@{ The shares of the tolerance, which bounds the error of a whole row.
  static constexpr double OpenShare = 0.2;
  static constexpr double VisibilityShare = 0.8;
  ///@}

  /// Pairs, each counted once. Open.Examined = Open.BackFacing + Open.Facing; of the facing ones
  /// some are Free, Hidden or PartlyVisible; the others have something near that hides nothing.
  struct Counters
  {
    UnoccludedPairs::Counters Open;
    double NotSending = 0.0;    ///< not examined, since neither sends anything
    double Free = 0.0;          ///< nothing reaches into the shaft between them
    double Hidden = 0.0;        ///< completely
    double PartlyVisible = 0.0; ///< or not certain
    double Rastered = 0.0;      ///< neither free nor hidden by a single wall: looked at from points
    void Add(const Counters& other);
  };

  /// `senders`: which patches send anything; null where all do.
  ViewFactorAssembly(const PatchScene& scene, double tolerance, const std::vector<bool>* senders);

  /// Make the plan for the tiles of a part. Returns how many may be other than zero.
  vtkIdType Plan(const vtkExchangeMatrix& structure);

  ///@{
  /**
   * Stage 1, in units of work: call it for all of them, in order, any number at a time. Returns
   * false when the memory for a tile is not there.
   */
  vtkIdType GetNumberOfUnits() const { return static_cast<vtkIdType>(this->Units.size()); }
  bool Look(vtkExchangeMatrix* exchange, vtkIdType begin, vtkIdType end);
  ///@}

  ///@{
  /// Stage 2. Prepare is collective: it divides the tolerance of a row among its pairs on all
  /// ranks.
  void PrepareRefinement(const Ranks& ranks);
  vtkIdType GetNumberOfPairs() const { return static_cast<vtkIdType>(this->Pairs.size()); }
  void Refine(vtkExchangeMatrix* exchange, vtkIdType begin, vtkIdType end);
  ///@}

  /// After both stages, of this rank.
  const std::vector<PartlyVisiblePair>& GetPairs() const { return this->Pairs; }
  const Counters& GetCounters() const { return this->Total; }
  /// And of all ranks together (collective), in units of exchange: see RowBudget.
  std::vector<double> GetRowErrors(const Ranks& ranks) const;

private:
  /// Two nodes of at most UnitSize patches, and the tile that holds their exchange.
  struct Unit
  {
    vtkIdType Tile; ///< index among the tiles of the part
    int I, J;
  };
  static constexpr int UnitSize = 64;
  /// Of the pairs of a row on which rays have given a verdict.
  struct VerdictErrors
  {
    double Sum = 0.0;
    double Squares = 0.0;
    void Add(double error)
    {
      this->Sum += error;
      this->Squares += error * error;
    }
    void Add(const VerdictErrors& other)
    {
      this->Sum += other.Sum;
      this->Squares += other.Squares;
    }
  };
  struct UnitResult;
  struct Looker;
  struct Refiner;

  void CountSenders();
  std::vector<int> GetQuarters(vtkIdType block) const;
  void AddUnits(vtkIdType tileIndex, const vtkExchangeMatrix::Tile& tile);
  void Collect(const Unit& unit, const UnitResult& result);
  void ReleaseTiles(vtkExchangeMatrix* exchange, vtkIdType begin, vtkIdType end);
  double GetWeight(const PartlyVisiblePair& pair, vtkIdType row) const;
  double GetBudget(vtkIdType row) const;
  double GetAllowedError(const PartlyVisiblePair& pair) const;

  const PatchScene& Scene;
  double Tolerance;
  const std::vector<bool>* Senders;
  std::vector<vtkIdType> NodeSenders;
  UnoccludedPairs Open;
  ShaftCuller Culler;
  std::unique_ptr<BlockRays> Rays; ///< where they may judge
  std::vector<Unit> Units;
  std::vector<bool> TilesWithPairs;
  std::vector<double> RowErrors; ///< of the exchange with nothing in between
  std::vector<VerdictErrors> Verdicts;
  std::vector<double> Allowances; ///< error for a unit of weight, of each row
  std::vector<PartlyVisiblePair> Pairs;
  Counters Total;
};
} // namespace LightTransport

#endif
