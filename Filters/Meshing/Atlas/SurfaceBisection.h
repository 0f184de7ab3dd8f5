// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cuts a piece of a surface into two, each connected as far as the piece was, of about the same
 * area, along a short line that follows creases where it can.
 *
 * Four corners of the piece (each the face farthest from those before) give coordinates: sums of
 * distances from two corners minus those from the other two. Their level lines are the candidates:
 * what is less than a level, and what is not, are both connected but for some crumbs, which change
 * sides. Pieces of different components are tied together by free links, so that a group of them
 * is divided as one piece.
 */
#ifndef SurfaceBisection_h
#define SurfaceBisection_h

#include "Atlas/AtlasSurface.h"

#include <array>
#include <vector>

namespace LightTransport
{
class SurfaceBisection
{
public:
  /**
   * `owners` tells the piece that each face of the surface belongs to: faces of other pieces are no
   * neighbours. `local` is room for one number per face; only those of the piece are touched, so
   * different pieces may be divided at the same time.
   */
  SurfaceBisection(const AtlasSurface& surface, const std::vector<int>& owners,
    std::vector<int>& local, const Watch& watch);

  /**
   * Halves of a piece of at least two faces. `share` is the smallest share of the area that a half
   * may have, below one half; it is missed where nothing else is possible. If it is 0, the
   * components of a piece are told apart before any of them is cut. `density` is the area
   * of the piece divided by the area that it should have: halves draw nearer to what they should
   * have themselves.
   */
  std::array<std::vector<int>, 2> Divide(const std::vector<int>& faces, double share,
    double density);

private:
  struct Cut;

  void Gather(const std::vector<int>& faces);
  void FindComponents();
  void TieComponents();
  std::vector<char> DivideComponents() const;
  std::vector<char> CutBetweenCorners(double share, double density) const;
  double GetDistanceAcross(int face, int edge, double distance) const;
  double GetTie(int from, int to) const;
  template <typename Visitor>
  void FollowTies(int start, const Visitor& reach) const;
  std::vector<double> FindDistances(int start) const;
  std::vector<std::array<double, 3>> FindCostsOfCreases() const;
  std::vector<double> FindDistancesOverPoints(int start) const;
  void LevelBundles(std::vector<double>& values) const;
  std::array<std::vector<double>, 4> FindDistancesFromCorners(bool overPoints) const;
  Cut FindBestCut(const std::vector<double>& values, double share, double density) const;
  double GetCost(int face, int edge) const;
  std::vector<double> FindCosts(const std::vector<int>& ranks) const;
  void JoinCrumbs(std::vector<char>& sides, char side) const;
  void Smooth(std::vector<char>& sides) const;

  const AtlasSurface& Surface;
  const std::vector<int>& Owners;
  std::vector<int>& Local;
  const Watch& Watcher;

  std::vector<int> Faces;
  /// The rest is numbered as Faces is.
  std::vector<std::array<int, 3>> Neighbors;
  std::vector<int> Components;
  int NumberOfComponents = 0;
  std::vector<int> TiedFaces; ///< one of each component; neighbours in this list are tied
  double Area = 0.0;
  bool IsThin = false; ///< whether many of the faces are
  double Crease = 0.0; ///< how far it is to cross one at a right angle
};
} // namespace LightTransport

#endif
