// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkViewFactors
 * @brief view factors (form factors) between all patches of a surface, with occlusion
 *
 * F_ij is the fraction of what leaves patch i diffusely that reaches patch j. Surfaces are
 * one-sided: the front is where the counter-clockwise normal points; back faces block and absorb.
 * The exchange G_ij = A_i F_ij is computed once per pair, so A_i F_ij = A_j F_ji holds exactly.
 *
 * How a pair is computed: both patches are clipped to the half-space in front of the other; near
 * pairs use the contour integral (Sparrow 1963; the inner integral in closed form, the outer one by
 * adaptive Gauss quadrature), pairs further apart a product of Gauss rules, far pairs one point,
 * each where its error bound allows it. Where something may stand between the two patches, rays
 * (Embree) between stratified points decide which part of the exchange is visible, more rays only
 * where they disagree.
 *
 * Output (port 0): the input with the cell arrays
 *   - "ViewFactorSum" (1 component): sum_j F_ij as computed, before any closure. 1 in a closed
 * scene.
 *   - "ViewFactorError" (1): estimate of sum_j |error of F_ij|. It does not know of an occluder
 * that the first rays of a pair all miss.
 *   - "SkyFraction" (1): the part of the missing 1 - ViewFactorSum that leaves the scene.
 *   - "BackFaceFraction" (1): the part of it that meets back faces.
 * and field data: PairsExamined, PairsFacing, PairsPartlyVisible, RaysCast, ViewFactorSeconds,
 * ClosureChange, MatrixBytes.
 *
 * Errors: see vtkTransportAlgorithm; in addition the memory for n (n + 1) / 2 values of 4 bytes
 * must be there.
 */
#ifndef vtkViewFactors_h
#define vtkViewFactors_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"                // for vtkSmartPointer
#include "vtkTransportAlgorithm.h"

#include <functional> // for std::function
#include <vector>     // for std::vector

class vtkExchangeMatrix;
class vtkPatchScene;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkViewFactors : public vtkTransportAlgorithm
{
public:
  static vtkViewFactors* New();
  vtkTypeMacro(vtkViewFactors, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Bounds the sum over j of the absolute errors of F_ij of each row. The integration of unoccluded
   * pairs keeps it; where patches are partly visible the number of rays per pair is limited
   * (MaximumNumberOfRays), and "ViewFactorError" tells what was reached. Default 1e-4, range 1e-12
   * to 0.1.
   */
  vtkSetClampMacro(Tolerance, double, 1e-12, 0.1);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /// Most rays for one partly visible pair. Default 64, range 16 to 65536.
  vtkSetClampMacro(MaximumNumberOfRays, int, 16, 65536);
  vtkGetMacro(MaximumNumberOfRays, int);
  ///@}

  ///@{
  /**
   * Make the rows of patches that see no opening sum to 1, moving the exchange as little as
   * possible (least squares weighted with 1/G: van Leersum 1989) and keeping it symmetric. Rows
   * that see the sky or back faces stay as they are. Default off; the field data array
   * ClosureChange tells how far a row sum was moved at most.
   */
  vtkSetMacro(EnforceClosure, bool);
  vtkGetMacro(EnforceClosure, bool);
  vtkBooleanMacro(EnforceClosure, bool);
  ///@}

  /// F_ij after Update, patches counted as the input's polygons (all blocks, all ranks, ghosts left
  /// out). 0 where out of range and, on several ranks, where another rank holds the pair.
  double GetViewFactor(vtkIdType i, vtkIdType j);

  ///@{
  /**
   * For filters that work on view factors: bring them up to date for a scene, computing only when
   * the geometry or a property has changed. `progress` is called with fractions and returns false
   * to abort. Returns false after an error or an abort.
   */
  using ProgressFunction = std::function<bool(double)>;
  bool UpdateExchange(const vtkPatchScene& scene, const ProgressFunction& progress);
  vtkExchangeMatrix* GetExchange();
  const std::vector<double>& GetRowSums() const { return this->RowSums; }
  const std::vector<double>& GetRowErrors() const { return this->RowErrors; }
  /// Field data arrays that summarise the last computation.
  void AddSummaries(vtkFieldData* fields) const;
  ///@}

protected:
  vtkViewFactors();
  ~vtkViewFactors() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

private:
  vtkViewFactors(const vtkViewFactors&) = delete;
  void operator=(const vtkViewFactors&) = delete;

  struct Assembly;
  bool Assemble(const vtkPatchScene& scene, const ProgressFunction& progress);
  void CollectCounters(const Assembly& assembly);
  bool SumRows();
  bool CloseRows();
  bool FindOpenings(const vtkPatchScene& scene);

  double Tolerance = 1e-4;
  int MaximumNumberOfRays = 64;
  bool EnforceClosure = false;

  vtkSmartPointer<vtkExchangeMatrix> Exchange;
  std::vector<vtkIdType> Patches; ///< row of the exchange of each of the input's polygons
  std::vector<double> RawRowSums; ///< before closure
  std::vector<double> RowSums;    ///< of the exchange as it is
  std::vector<double> RowErrors;
  std::vector<double> SkyFractions;
  std::vector<double> BackFaceFractions;
  unsigned long long Fingerprint = 0;
  vtkTimeStamp BuildTime;

  double PairsExamined = 0.0;
  double PairsFacing = 0.0;
  double PairsPartlyVisible = 0.0;
  double RaysCast = 0.0;
  double Seconds = 0.0;
  double ClosureChange = 0.0;
};

#endif
