// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What part of the exchange between two planar convex polygons a few occluders let through.
 *
 * The exchange is an integral over both polygons. From a point of the *outer* one an occluder
 * throws a convex shadow onto the plane of the *inner* one, and what the shadows leave of the inner
 * polygon is found for hundreds of samples at once (ShadowRaster). Over the outer polygon that
 * is a continuous function: a symmetric rule on a grid of triangles, refined until it settles.
 * Every point moves the raster a little (low-discrepancy shifts), so that its spacing averages out.
 *
 * The outer polygon is the one that the occluders are far from: seen from there shadows move least.
 *
 * One object per thread: it keeps its buffers from pair to pair.
 */
#ifndef PairVisibility_h
#define PairVisibility_h

#include "Geometry/PairHull.h"
#include "Geometry/ShaftCuller.h"
#include "ViewFactors/ExactVisibility.h"
#include "ViewFactors/PairIntegrals.h"
#include "ViewFactors/ShadowRaster.h"

#include <array>
#include <cstdint>
#include <vector>

namespace LightTransport
{
class PatchScene;

class PairVisibility
{
public:
  using Polygon = LightTransport::Polygon;
  using Vector = Polygon::Vector;

  /// The visible part of the exchange, 0 to 1, and an estimate of its absolute error.
  struct Share
  {
    double Value = 1.0;
    double Error = 0.0;
  };

  /**
   * Begin with a pair of patches and the walls that may come between them. Returns false where none
   * of these is: nothing is between. Equal keys give equal samples. `open` is the exchange with
   * nothing in between; with it what the raster does not resolve is found by ExactVisibility. The
   * walls must outlive the pair.
   */
  bool SetPair(const PatchScene& scene, vtkIdType i, vtkIdType j, const OccluderWalls& walls,
    const std::vector<ShaftCuller::Occluder>& occluders, std::uint64_t key, double open = 0.0);

  /// Whether one wall hides the whole pair, for certain: what there is to see costs nothing then.
  bool IsWalledOff() const { return this->WalledOff; }

  /// A key of a pair's own.
  static std::uint64_t GetKey(vtkIdType i, vtkIdType j)
  {
    return static_cast<std::uint64_t>(i) << 32 ^ static_cast<std::uint64_t>(j);
  }

  /// A first look from a few points and, where all of them see nothing, from the corners and the
  /// middles of the edges. An error of 0 says that none of these sees anything. What all of them
  /// see is not known to be visible: something is between the two.
  Share Look();

  /// Integrate until the estimated error is below `tolerance`, or the work is used up. `looked`:
  /// what a first look at the same pair has found, where there was one; above 0 it is not done
  /// again.
  Share Integrate(double tolerance, double looked = 0.0);

private:
  using Occluder = ShaftCuller::Occluder;

  void SelectOccluders(const std::vector<Occluder>& occluders);
  bool IsHiddenByOne(const std::vector<Occluder>& occluders, vtkIdType i, vtkIdType j);
  void ChooseOuter();
  void SetFrame();
  void AddTarget();
  void AddShapes();
  template <typename GetCorner>
  void AddShape(int count, const GetCorner& getCorner);
  bool LookFrom(const Vector& place, ShadowRaster::View& view);
  ShadowRaster::Flux See(const Vector& place);
  template <typename Visit>
  bool VisitGrid(int cuts, const Visit& visit) const;
  template <typename Visit>
  bool VisitRim(const Visit& visit) const;
  bool IsHidden();
  int GetNumberOfGridPoints(int cuts) const;
  void ChooseWeights(double tolerance);
  double SeeFromGrid(int cuts);
  bool ShapeOccluder(const Occluder& occluder, Polygon& shape) const;
  Share IntegrateExactly(double tolerance);
  double GetRimDifference(double share);

  Polygon Outer, Inner;
  PatchPlane OuterPlane, InnerPlane;
  std::uint64_t Key = 0;
  double Open = 0.0;
  bool AreClose = false;
  bool WalledOff = false;
  const OccluderWalls* Walls = nullptr;
  int NumberOfPoints = 0;
  ShadowRaster::Weights Weights = ShadowRaster::Weights::Fine;
  std::vector<ShadowRaster::View> Views; ///< from the points of the first grid

  std::vector<Occluder> Occluders;
  OccluderWalls::End Ends[2]; ///< the two polygons
  PairHull Hull;
  double HullRounding = 0.0;

  // The inner polygon's frame.
  Vector Origin, AxisU, AxisW, AxisH;
  double Normal[3] = {};
  ShadowRaster::Target Target;
  ShadowRaster::Occluders Shapes;
  std::vector<std::array<double, 3>> Corners; ///< of one of them

  ExactVisibility Exact;
  bool IsExactReady = false;
};
} // namespace LightTransport

#endif
