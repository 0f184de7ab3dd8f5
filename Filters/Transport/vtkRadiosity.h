// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkRadiosity
 * @brief radiosity, and thermal enclosure radiation, on the patches of a surface
 *
 * Solves B = E + rho H, H = F B + H_direct for every band, where B is the radiosity (radiant
 * exitance), E the emission, rho the diffuse reflectance, F the view factors (vtkViewFactors) and H
 * the irradiance, all per unit area (W/m2, or any unit that E is in). Radiance is B / pi.
 *
 * Input cell arrays (SetInputArrayToProcess; defaults in brackets), any number of components each:
 * 1 is used for all bands.
 *   - 0: emission ["Emission"], >= 0
 *   - 1: reflectance ["Reflectance"], 0 to 1
 *   - 2: temperature ["Temperature"], kelvin, one component: E = emissivity * 5.670374419e-8 * T^4
 * W/m2, with BandLimits the part of it that lies in each band
 *   - 3: emissivity ["Emissivity"], 0 to 1: reflectance = 1 - emissivity
 *   - 4: direct irradiance ["DirectIrradiance"], optional, from vtkDirectIrradiance
 *   - 5: boundary condition ["BoundaryCondition"], optional, read with temperatures only: 0 where
 * the temperature is given, 1 where the net flux is (the temperature there is not used)
 *   - 6: given net flux ["PrescribedNetFlux"], optional (0: adiabatic), W/m2, positive when it
 * leaves the surface: heat that is put into the patch from behind. One band only: it is the sum
 * over all wavelengths.
 * With TwoSided the back of each polygon has arrays of its own, whose names have the suffix "Back"
 * ("ReflectanceBack"); where there is none the front's holds for both. Without "EmissionBack" lamps
 * shine from both sides, which a warning says once; without "DirectIrradianceBack" no direct light
 * falls on backs, with a warning.
 * Either Temperature and Emissivity are there, or Reflectance (or Emissivity) and at least one of
 * Emission, DirectIrradiance and a background.
 *
 * Output port 0: the input with the cell and point arrays "Radiosity" (B), "Irradiance" (H, the
 * direct part included) and "NetFlux" (B - H, positive when it leaves the surface), double, one
 * component per band; with temperatures also "SurfaceTemperature" (kelvin; where the net flux q is
 * given, T with q = emissivity (sigma T^4 - H), and 0 with a warning where more is taken out than
 * any temperature allows; for an adiabatic patch of emissivity 0 the limit for small emissivities,
 * sigma T^4 = H) and in several bands "TotalNetFlux" (W/m2, their sum); the cell array
 * "SceneProblems" as vtkViewFactors writes it, with its EnclosureVerdict, IsClosed and LeakArea
 * (not where Southwell shoots on OpenGL); in field data SolverUsed, SolverExplanation (why this
 * one), SolverStatus, DeviceUsed, NumberOfIterations, ErrorBound, Converged, SolverSeconds, the
 * summaries of vtkViewFactors, and with temperatures NetPower: all net fluxes times areas (W where
 * lengths are in metres), which should be 0 in a closed scene and tells what errors of the view
 * factors do to the balance (EnforceClosure mends it). Output port 1: vtkTable "Convergence" with a
 * row per iteration: Iteration, Seconds (since the solver began), Residual (largest |E + rho H -
 * B|) and ErrorBound (largest |error of B|).
 *
 * The error bound is algebraic: with w > 0 such that d = (I - rho F) w > 0, |error_i| <= w_i max_j
 * |r_j| / d_j. w = 1 gives the row-sum bound; where that is infinite (rho times row sum reaches 1)
 * w is found by solving for a right-hand side of ones. The error of the discretisation (patches of
 * constant B) is another number and not in it.
 *
 * Solvers: Jacobi (B' = B + E - K B, K = I - rho F) and Gauss-Seidel are those of Carr, Hall and
 * Hart (2003). Southwell is progressive refinement (Cohen et al. 1988) with the overshooting of
 * Feda and Purgathofer (1992). Chebyshev needs no sums over vectors. ConjugateGradient works on the
 * symmetrised system (I - s G s) y = s G E with s = sqrt(rho / A) and B = E + s y, all bands in
 * lockstep. Auto takes conjugate gradients, or Jacobi where so little is reflected that it needs no
 * more products. Gauss-Seidel and Southwell go from patch to patch and run on the CPU of one
 * process.
 *
 * Southwell with Device OpenGL shoots without view factors (vtkDeviceShooter): what a patch sees is
 * drawn on the GPU when it shoots, so that memory grows with the number of patches and no more, and
 * the first shots already give a picture. ViewFactorTolerance, EnforceClosure and SetViewFactors
 * have no effect then, and there can be no background. Energy is kept; the irradiance of the
 * Cornell box is off by about 1 % (relative L2; vtkOpenGLShooter tells what that depends on), which
 * is not in ErrorBound: that is the largest unshot radiosity over 1 - rho, for the largest rho, and
 * bounds B and H; Residual is the largest unshot radiosity. "Convergence" has a row for every 16
 * shots, and Iteration counts shots; NumberOfIterations counts begun sweeps of as many shots as
 * there are patches, and NumberOfShots is in the field data.
 *
 * SolverStatus is "Converged", or with a warning that names the remedy: "IterationsUsedUp",
 * "Stagnated" (rounding lets the residual fall no further), "Diverged" (it grows). Where the
 * equation has no unique solution (a closed part reflects all that it receives, view factors of a
 * row sum to more than 1 / rho) or errors of the view factors decide what it is, an error names the
 * polygon where that is so. Warnings tell of what vtkViewFactors warns of, and with temperatures of
 * a sky at 0 K behind an open scene, a warmest temperature below 100 K (degrees Celsius?), and
 * power that a closed scene loses. A warning tells where they may change B by more than a tenth,
 * and where row sums say that patches overlap.
 */
#ifndef vtkRadiosity_h
#define vtkRadiosity_h

#include "vtkDeviceShooter.h"               // for ShotProblem
#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkTransportAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

class vtkTable;
class vtkViewFactors;

namespace LightTransport
{
class ViewFactorStore;
}

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkRadiosity : public vtkTransportAlgorithm
{
public:
  static vtkRadiosity* New();
  vtkTypeMacro(vtkRadiosity, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum LinkMethodType
  {
    LINK_METHOD_AUTO = 0,
    LINK_METHOD_DENSE = 1,
    LINK_METHOD_HIERARCHICAL = 2,
    LINK_METHOD_SAMPLED = 3
  };

  enum SolverType
  {
    SOLVER_AUTO = 0,
    SOLVER_JACOBI = 1,
    SOLVER_GAUSS_SEIDEL = 2,
    SOLVER_SOUTHWELL = 3,
    SOLVER_CHEBYSHEV = 4,
    SOLVER_CONJUGATE_GRADIENT = 5
  };

  ///@{
  /// The solver. Default SOLVER_AUTO: the one that needs fewest products with the links.
  vtkSetClampMacro(Solver, int, SOLVER_AUTO, SOLVER_CONJUGATE_GRADIENT);
  vtkGetMacro(Solver, int);
  void SetSolverToAuto() { this->SetSolver(SOLVER_AUTO); }
  void SetSolverToJacobi() { this->SetSolver(SOLVER_JACOBI); }
  void SetSolverToGaussSeidel() { this->SetSolver(SOLVER_GAUSS_SEIDEL); }
  void SetSolverToSouthwell() { this->SetSolver(SOLVER_SOUTHWELL); }
  void SetSolverToChebyshev() { this->SetSolver(SOLVER_CHEBYSHEV); }
  void SetSolverToConjugateGradient() { this->SetSolver(SOLVER_CONJUGATE_GRADIENT); }
  ///@}

  ///@{
  /// Stop when in every band the error bound is below this fraction of the largest B. Default 1e-4,
  /// range 1e-15 to 1.
  vtkSetClampMacro(Tolerance, double, 1e-15, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Iterations at most (for Southwell: sweeps of as many shots as there are patches). When they are
   * used up the result so far is the output, Converged is 0 and a warning tells the error bound.
   * Default 1000, at least 1.
   */
  vtkSetClampMacro(MaximumNumberOfIterations, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Limits of the spectral bands: wavelengths in micrometres, each longer than the one before, one
   * more than there are bands; 0 and infinity (or any large number) may be the ends. With them a
   * temperature emits in each band what a black body emits between its limits times the emissivity
   * in that band; what lies outside of all bands is left out. Default: none, one total band.
   */
  void AddBandLimit(double micrometers);
  void ClearBandLimits();
  int GetNumberOfBandLimits() const { return static_cast<int>(this->BandLimits.size()); }
  /// 0 where out of range.
  double GetBandLimit(int index) const;
  ///@}

  ///@{
  /**
   * What enters through the openings of the scene, the same from all directions: each patch
   * receives its "SkyFraction" (vtkViewFactors) times sigma T^4 W/m2, where T is the background's
   * temperature in kelvin (with BandLimits the part of each band), plus its sky fraction times pi
   * times the background's radiance, in the unit of the emission per steradian, one value per band
   * or one for all. It is part of "Irradiance", and enters no closed scene. Where rows are
   * closed (EnforceClosure, hierarchical links) a black scene as warm as its background exchanges
   * nothing with it, to rounding; else to a small part of ViewFactorTolerance. Defaults 0 K, range
   * 0 to 1e30, and none.
   */
  vtkSetClampMacro(BackgroundTemperature, double, 0.0, 1e30);
  vtkGetMacro(BackgroundTemperature, double);
  /// The same in all bands.
  void SetBackgroundRadiance(double radiance);
  /// Of the next band.
  void AddBackgroundRadiance(double radiance);
  void ClearBackgroundRadiances();
  int GetNumberOfBackgroundRadiances() const
  {
    return static_cast<int>(this->BackgroundRadiances.size());
  }
  /// 0 where out of range.
  double GetBackgroundRadiance(int band) const;
  ///@}

  ///@{
  /**
   * How patches are linked: Dense by a view factor for each pair (vtkExchangeMatrix), which takes
   * memory and time by the square of their number; Hierarchical by links between clusters of
   * patches (vtkExchangeHierarchy), whose number hardly grows with that of the patches, to an
   * accuracy of LinkTolerance; Sampled by what rays of each patch meet, and exact view factors of
   * the few patches that send most of the light (see Accuracy), which is the fastest where 1 % or
   * more is enough. Default LINK_METHOD_AUTO: what SetViewFactors gave; else what is asked
   * for decides, the first of: Dense with a solver that needs it (GaussSeidel), or a
   * ViewFactorTolerance; Hierarchical with RefineByBrightness or the ClusterTree Atlas; Sampled
   * with a LinkTolerance. Where nothing of that is asked for, Dense up to 1,000
   * patches and Sampled beyond 8,192, and between whichever is predicted to take less time for this
   * Accuracy (Dense up to half a second), by a short look at some pairs of patches. Field data
   * LinkMethodUsed says which, and LinkMethodExplanation why; a warning tells of a tolerance that
   * has no effect on the links.
   */
  vtkSetClampMacro(LinkMethod, int, LINK_METHOD_AUTO, LINK_METHOD_SAMPLED);
  vtkGetMacro(LinkMethod, int);
  void SetLinkMethodToAuto() { this->SetLinkMethod(LINK_METHOD_AUTO); }
  void SetLinkMethodToDense() { this->SetLinkMethod(LINK_METHOD_DENSE); }
  void SetLinkMethodToHierarchical() { this->SetLinkMethod(LINK_METHOD_HIERARCHICAL); }
  void SetLinkMethodToSampled() { this->SetLinkMethod(LINK_METHOD_SAMPLED); }
  ///@}

  ///@{
  /**
   * Error of the irradiance that hierarchical links are allowed, or what decides on the rays of
   * sampled ones (which then have no exact rows), see vtkViewFactors::SetLinkTolerance. Range 1e-5
   * to 1; default 0: as Accuracy asks.
   *
   * Hierarchical links keep it for a radiosity that is the same everywhere, or with
   * RefineByBrightness for one like that of a coarse solution, lamps included. What the light that
   * there is makes of it is LinkError in the field data, the error of B as Accuracy has it (and
   * AccuracyReached, which says how it is found); it misses it where a few patches of thousands
   * have most of it. A warning tells where it is more than 1.2 times the tolerance: for a small
   * lamp it is, by 2 to 7 times.
   */
  vtkSetClampMacro(LinkTolerance, double, 0.0, 1.0);
  vtkGetMacro(LinkTolerance, double);
  ///@}

  ///@{
  /**
   * How wrong the radiosity may be by its links: the root mean square, by area, of the error of B,
   * relative to that of B - E, of the worst band (of H, where nothing reflects). What a lamp emits
   * is given, and hides no error of what it lights. The patches' size (B is constant on each) is
   * another number and not in it, and the solver's Tolerance another. Default 1e-2, range 1e-5
   * to 1.
   *
   * Sampled links get as many rays, more of bright patches, and exact rows of as many of the
   * brightest, as keep it in the least time, by one standard error of their own (a warning tells
   * where memory or the most rays did not reach it). Other links take it as their tolerance where
   * that is 0. AccuracyReached in the field data tells what came out, whatever the links are; of a
   * matrix that this filter has not made in the same run (kept from the last one, or given) with
   * ComputeErrors alone, since that takes longer than the solution.
   */
  vtkSetClampMacro(Accuracy, double, 1e-5, 1.0);
  vtkGetMacro(Accuracy, double);
  ///@}

  ///@{
  /**
   * Add the cell and point arrays "RadiosityError", "IrradianceError" and "NetFluxError" (a
   * component per band), and with temperatures "SurfaceTemperatureError" (kelvin; 0 where the
   * temperature is given): one standard error each, by the links and the solver. Of sampled links
   * it comes from eight groups of their rays, and that of a single patch is known to a quarter
   * itself. Other links are compared with more exact rows of some patches, a sample by area and the
   * brightest: where nothing more is known all patches have the mean of the sample, and what is
   * reflected of it. The patches' size is not in it. Shots have none, nor
   * have links over the quadtree of an atlas, and a warning says so. Default off.
   */
  vtkSetMacro(ComputeErrors, bool);
  vtkGetMacro(ComputeErrors, bool);
  vtkBooleanMacro(ComputeErrors, bool);
  ///@}

  ///@{
  /**
   * Whether each polygon is two faces, front and back, each with a material and results of its own:
   * thin sheets are one polygon in most models. Outputs (cell and point arrays) of the backs have
   * the suffix "Back". No heat is conducted through a sheet: a temperature is that of the side, and
   * a given net flux holds for each side alone. View factors that are given (SetViewFactors) must
   * have the same setting. Default off: backs block and absorb.
   */
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  ///@}

  ///@{
  /**
   * What tree the clusters of hierarchical links are nodes of, see vtkViewFactors::SetClusterTree,
   * whose own decides where SetViewFactors gave one. Default CLUSTER_TREE_AUTO.
   */
  vtkSetClampMacro(ClusterTree, int, CLUSTER_TREE_AUTO, CLUSTER_TREE_ATLAS);
  vtkGetMacro(ClusterTree, int);
  void SetClusterTreeToAuto() { this->SetClusterTree(CLUSTER_TREE_AUTO); }
  void SetClusterTreeToSpatial() { this->SetClusterTree(CLUSTER_TREE_SPATIAL); }
  void SetClusterTreeToAtlas() { this->SetClusterTree(CLUSTER_TREE_ATLAS); }
  ///@}

  ///@{
  /**
   * Refine hierarchical links where light is: for the radiosity of a first, coarse solution (links
   * of four times LinkTolerance, 0.1 at most, or with a background LinkTolerance, which are kept)
   * instead of one that is the same everywhere. Fewer links for the same error where little of the
   * scene sends most of the light, but they serve this one distribution of light and are never
   * kept; what has been found of pairs of clusters is. Default off.
   */
  vtkSetMacro(RefineByBrightness, bool);
  vtkGetMacro(RefineByBrightness, bool);
  vtkBooleanMacro(RefineByBrightness, bool);
  ///@}

  ///@{
  /// Where the links are applied (vtkTransportAlgorithm::DeviceType). Default DEVICE_AUTO: OpenGL
  /// on a real GPU, else the CPU.
  vtkSetClampMacro(Device, int, DEVICE_AUTO, DEVICE_OPENGL);
  vtkGetMacro(Device, int);
  void SetDeviceToAuto() { this->SetDevice(DEVICE_AUTO); }
  void SetDeviceToCPU() { this->SetDevice(DEVICE_CPU); }
  void SetDeviceToOpenGL() { this->SetDevice(DEVICE_OPENGL); }
  ///@}

  ///@{
  /**
   * Tolerance and closure of the filter's own view factors (see vtkViewFactors); they are not used
   * when SetViewFactors gave others. Other links have LinkTolerance instead, and always close rows.
   * Defaults 0, which is Accuracy (0.1 at most), and off. The errors of many factors average out in
   * B: measured without what is emitted, root mean square over all patches, relative to B,
   *
   * | ViewFactorTolerance            |          1e-1 |          1e-2 |          1e-3 |
   * |--------------------------------|--------------:|--------------:|--------------:|
   * | Cornell box, 1930, lamp        | 7e-4 in 2.1 s | 4e-4 in 2.3 s | 4e-5 in 4.8 s |
   * | furnished room, 768, lamp      | 8e-4 in 0.4 s | 3e-4 in 0.8 s | 3e-5 in 3.9 s |
   * | city of boxes, 864, lit window | 5e-4 in 0.4 s | 3e-4 in 0.6 s | 3e-5 in 2.5 s |
   * | the same, even sky             | 1e-2 in 0.4 s | 1e-3 in 0.6 s | 8e-6 in 2.6 s |
   */
  vtkSetClampMacro(ViewFactorTolerance, double, 0.0, 0.1);
  vtkGetMacro(ViewFactorTolerance, double);
  vtkSetMacro(EnforceClosure, bool);
  vtkGetMacro(EnforceClosure, bool);
  vtkBooleanMacro(EnforceClosure, bool);
  ///@}

  ///@{
  /**
   * View factors to share with other filters. Default nullptr: an internal one. Either keeps its
   * result while the geometry stays the same, so that new emissions or reflectances only cost a
   * solution. The internal one leaves out the pairs of patches of which neither sends anything
   * (unless EnforceClosure or a background, which need whole rows), so it computes again when
   * patches that did not send begin to. Sampled links for an Accuracy serve other light as long as
   * that keeps it with them; else what is missing, rays or exact rows, is added.
   */
  virtual void SetViewFactors(vtkViewFactors* viewFactors);
  vtkGetObjectMacro(ViewFactors, vtkViewFactors);
  ///@}

  /// The table of port 1.
  vtkTable* GetConvergence();

  /// How often links have been made: not where kept ones served, and not by shots.
  vtkGetMacro(NumberOfLinkRuns, vtkIdType);

  /// All properties of another one, view factors that were given included; neither its input and
  /// the names of its arrays, nor its controller, nor its links.
  void CopyProperties(vtkRadiosity* source);

  ///@{
  /**
   * For those who shoot themselves, and show the solution while it comes (vtkRadiosityPass).
   * PrepareShots tells what there is to shoot, of a scene that need not be connected; solver, links
   * and Device do not matter. WriteShots makes the output of port 0 from the irradiance
   * (patches x bands) that shots have brought, without the direct one; `numberOfShots` is written
   * with it. The point array "SmoothGroup" of either output is the group of each point, -1 for
   * none: its radiosity is the sum over the group's members of Part times that of the patch.
   * `output` of PrepareShots has what WriteShots writes of the `ambient` irradiance: all that is
   * unshot, as if it were spread over the scene evenly. False after an error, which has been
   * reported, and an abort.
   */
  struct ShotProblem
  {
    vtkDeviceShooter::Patches Patches;
    int NumberOfBands = 0;
    std::vector<double> Source;      ///< patches x bands, the reflected direct light included
    std::vector<double> Reflectance; ///< patches x bands
    std::vector<double> Ambient;     ///< irradiance, one per band
    ///@{ Those of group g are members Starts[g] to Starts[g + 1].
    std::vector<vtkIdType> Starts;
    std::vector<vtkIdType> Members; ///< patches
    std::vector<double> Parts;
    ///@}
  };
  bool PrepareShots(vtkDataObject* scene, bool ambient, ShotProblem& problem,
    vtkDataObject* output);
  bool WriteShots(vtkDataObject* scene, const std::vector<double>& irradiance,
    vtkIdType numberOfShots, vtkDataObject* output);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkRadiosity();
  ~vtkRadiosity() override;

  std::unique_ptr<LightTransport::TransportRun> MakeRun(
    const LightTransport::RunPorts& ports) override;

private:
  vtkRadiosity(const vtkRadiosity&) = delete;
  void operator=(const vtkRadiosity&) = delete;

  class Run;
  struct OwnShots;

  bool RunShots(vtkDataObject* scene, OwnShots& shots, vtkDataObject* output);

  int Solver = SOLVER_AUTO;
  double Tolerance = 1e-4;
  int MaximumNumberOfIterations = 1000;
  std::vector<double> BandLimits;
  double BackgroundTemperature = 0.0;
  std::vector<double> BackgroundRadiances;
  int LinkMethod = LINK_METHOD_AUTO;
  double LinkTolerance = 0.0;
  double Accuracy = 1e-2;
  bool ComputeErrors = false;
  int ClusterTree = CLUSTER_TREE_AUTO;
  bool TwoSided = false;
  bool RefineByBrightness = false;
  int Device = DEVICE_AUTO;
  double ViewFactorTolerance = 0.0;
  bool EnforceClosure = false;
  vtkViewFactors* ViewFactors = nullptr;
  vtkIdType NumberOfLinkRuns = 0;
  /// Where none were given.
  std::unique_ptr<LightTransport::ViewFactorStore> OwnViewFactors;
};

#endif
