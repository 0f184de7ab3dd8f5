// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTransportAlgorithm
 * @brief what all light transport filters share: one scene from any input, progress, abort,
 * devices, ranks
 *
 * The input is a vtkPolyData, or a composite data set of them; whatever its structure it is *one*
 * scene. Ghost cells do not count. Polygons may have any shape and number of corners: concave ones,
 * and holes that a seam bridges to the border, are cut into convex pieces inside of the scene and
 * stay one patch with one result, the mean over its area. Polygons that leave their plane by more
 * than 1e-4 of their radius are cut into triangles; those without area (fewer than 3 corners too),
 * and with a border that crosses itself, are left out, with results of 0. Of faces that lie on each
 * other and face the same way the first counts, and those of which nothing is left beside it are
 * left out, too. A warning counts each kind and names the first of it, and an error tells where
 * nothing is left.
 *
 * Points may be float or double, at any place: what is in front of what is decided by what the
 * coordinates are worth (their type and size, and how far polygons are from plane). Two surfaces
 * nearer to each other than that, however they are meshed, are one place: they neither hide nor see
 * each other, and of two sides the one counts that faces what looks. A warning tells where points
 * are stored in steps of more than 1 % of the size of the median patch.
 *
 * In a parallel run (a
 * controller with several processes) the scene is gathered to every rank first, because a rank that
 * sees only its own piece gets wrong visibility; each rank then writes the results of its own
 * patches. The output has the structure of the input, all its arrays, and the results. Points are
 * duplicated where a crease (FeatureAngle) or a change of material meets them, so that no point
 * value is an average across either.
 *
 * Errors are reported with vtkErrorMacro and leave the output empty; on several ranks all agree on
 * an error before any of them enters a collective call.
 *
 * Progress is told ten times a second, whatever the filter is at; an observer that calls
 * SetAbortExecute(1) then ends the run, with an empty output and no error. The wish is that of the
 * run: the next one does not know of it. Several ranks hear it only where all of them report.
 */
#ifndef vtkTransportAlgorithm_h
#define vtkTransportAlgorithm_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkPassInputTypeAlgorithm.h"

#include <memory> // for std::unique_ptr

class vtkMultiProcessController;

namespace LightTransport
{
class Outcome;
class TransportRun;
struct RunPorts;
} // namespace LightTransport

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkTransportAlgorithm : public vtkPassInputTypeAlgorithm
{
public:
  vtkTypeMacro(vtkTransportAlgorithm, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Where the links are applied, for the filters that have a Device property.
  enum DeviceType
  {
    DEVICE_AUTO = 0,
    DEVICE_CPU = 1,
    DEVICE_OPENGL = 2
  };

  /// The cluster tree of hierarchical links, for the filters that have a ClusterTree property.
  enum ClusterTreeType
  {
    CLUSTER_TREE_AUTO = 0,
    CLUSTER_TREE_SPATIAL = 1,
    CLUSTER_TREE_ATLAS = 2
  };

  /// Measured materials of Jensen et al. 2001, for the filters that have a Material property.
  enum MaterialType
  {
    MATERIAL_CUSTOM = 0,
    MATERIAL_APPLE = 1,
    MATERIAL_CHICKEN1 = 2,
    MATERIAL_CHICKEN2 = 3,
    MATERIAL_CREAM = 4,
    MATERIAL_KETCHUP = 5,
    MATERIAL_MARBLE = 6,
    MATERIAL_POTATO = 7,
    MATERIAL_SKIMMILK = 8,
    MATERIAL_SKIN1 = 9,
    MATERIAL_SKIN2 = 10,
    MATERIAL_SPECTRALON = 11,
    MATERIAL_WHOLEMILK = 12
  };

  ///@{
  /**
   * Point values are not averaged across edges whose two normals differ by more than this angle, in
   * degrees. Default 60, range 0 to 180.
   */
  vtkSetClampMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  ///@{
  /// The processes that share the scene. Default: the global controller.
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

protected:
  vtkTransportAlgorithm();
  ~vtkTransportAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  /// Port 0 has the input's type; a port 1, where a filter has one, is a vtkTable.
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  /// Comes before each run.
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  /// Runs what MakeRun gives, and reports what comes of it.
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) final;

  /// One run of the filter, from its input to its output: a class of the filter's own for the steps
  /// in which it differs from others.
  virtual std::unique_ptr<LightTransport::TransportRun> MakeRun(
    const LightTransport::RunPorts& ports) = 0;

  /// One run, whose outcome has not been reported yet.
  LightTransport::Outcome Run(const LightTransport::RunPorts& ports);

  vtkMultiProcessController* Controller = nullptr;
  double FeatureAngle = 60.0;
  /// Seconds after which progress is told again, and an abort heard, within a step that takes long.
  double ProgressInterval = 0.1;

private:
  vtkTransportAlgorithm(const vtkTransportAlgorithm&) = delete;
  void operator=(const vtkTransportAlgorithm&) = delete;
};

#endif
