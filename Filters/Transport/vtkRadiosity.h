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
 *   - 2: temperature ["Temperature"], kelvin: E = emissivity * 5.670374419e-8 * T^4 W/m2. One
 * component only: over several bands sigma T^4 would be counted once per band.
 *   - 3: emissivity ["Emissivity"], 0 to 1: reflectance = 1 - emissivity
 *   - 4: direct irradiance ["DirectIrradiance"], optional, from vtkDirectIrradiance
 * Either Temperature and Emissivity are there, or Reflectance and at least one of Emission and
 * DirectIrradiance.
 *
 * Output port 0: the input with the cell and point arrays "Radiosity" (B), "Irradiance" (H, the
 * direct part included) and "NetFlux" (B - H, positive when it leaves the surface), double, one
 * component per band; in field data SolverUsed, DeviceUsed, NumberOfIterations, ErrorBound,
 * Converged, SolverSeconds and the summaries of vtkViewFactors. Output port 1: vtkTable
 * "Convergence" with a row per iteration: Iteration, Seconds (since the solver began), Residual
 * (largest |E + rho H - B|) and ErrorBound (largest |error of B|).
 *
 * The error bound is algebraic: with w > 0 such that d = (I - rho F) w > 0, |error_i| <= w_i max_j
 * |r_j| / d_j. w = 1 gives the row-sum bound; where that is infinite (rho times row sum reaches 1)
 * w is found by solving for a right-hand side of ones. The error of the discretisation (patches of
 * constant B) is another number and not in it.
 *
 * Solvers: Jacobi and Gauss-Seidel are those of Carr, Hall and Hart (2003). ConjugateGradient, the
 * choice of Auto, works on the symmetrised system (I - s G s) y = s G E with s = sqrt(rho / A) and
 * B = E + s y, all bands in lockstep. Gauss-Seidel and Southwell go from patch to patch and run on
 * the CPU of one process.
 */
#ifndef vtkRadiosity_h
#define vtkRadiosity_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"                // for vtkSmartPointer
#include "vtkTransportAlgorithm.h"

class vtkCPULinkOperator;
class vtkPatchScene;
class vtkTable;
class vtkViewFactors;
struct vtkRadiosityProblem;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkRadiosity : public vtkTransportAlgorithm
{
public:
  static vtkRadiosity* New();
  vtkTypeMacro(vtkRadiosity, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

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
  /// The solver. Default SOLVER_AUTO: conjugate gradients.
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
   * when SetViewFactors gave others. Defaults 1e-4 and off.
   */
  vtkSetClampMacro(ViewFactorTolerance, double, 1e-12, 0.1);
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
   * (unless EnforceClosure, which needs whole rows), so it computes again when patches that did not
   * send begin to.
   */
  virtual void SetViewFactors(vtkViewFactors* viewFactors);
  vtkGetObjectMacro(ViewFactors, vtkViewFactors);
  ///@}

  /// The table of port 1.
  vtkTable* GetConvergence();

  vtkMTimeType GetMTime() override;

protected:
  vtkRadiosity();
  ~vtkRadiosity() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

private:
  vtkRadiosity(const vtkRadiosity&) = delete;
  void operator=(const vtkRadiosity&) = delete;

  struct Problem;
  int GetChosenSolver() const;
  bool CheckSolver();
  bool ReadMaterials(vtkDataObject* input, const vtkPatchScene& scene, Problem& problem);
  vtkViewFactors* UpdateViewFactors(const vtkPatchScene& scene, const Problem& problem);
  bool Solve(vtkViewFactors* viewFactors, Problem& problem, vtkTable* convergence);
  void RecordConvergence(vtkRadiosityProblem& equation, vtkTable* convergence, double begin);
  bool Finish(vtkCPULinkOperator* links, Problem& problem);
  void Write(vtkDataObject* input, vtkPatchScene& scene, const Problem& problem,
    const vtkViewFactors* viewFactors, vtkDataObject* output);

  int Solver = SOLVER_AUTO;
  double Tolerance = 1e-4;
  int MaximumNumberOfIterations = 1000;
  int Device = DEVICE_AUTO;
  double ViewFactorTolerance = 1e-4;
  bool EnforceClosure = false;
  vtkViewFactors* ViewFactors = nullptr;
  vtkSmartPointer<vtkViewFactors> InternalViewFactors;
};

#endif
