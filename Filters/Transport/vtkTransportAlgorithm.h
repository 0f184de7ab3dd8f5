// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTransportAlgorithm
 * @brief what all light transport filters share: one scene from any input, progress, abort,
 * devices, ranks
 *
 * The input is a vtkPolyData, or a composite data set of them, of planar convex polygons; whatever
 * its structure it is *one* scene. Ghost cells do not count. In a parallel run (a controller with
 * several processes) the scene is gathered to every rank first, because a rank that sees only its
 * own piece gets wrong visibility; each rank then writes the results of its own patches. The output
 * has the structure of the input, all its arrays, and the results. Points are duplicated where a
 * crease (FeatureAngle) or a change of material meets them, so that no point value is an average
 * across either.
 *
 * Errors are reported with vtkErrorMacro and leave the output empty; on several ranks all agree on
 * an error before any of them enters a collective call.
 */
#ifndef vtkTransportAlgorithm_h
#define vtkTransportAlgorithm_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkPassInputTypeAlgorithm.h"
#include "vtkSmartPointer.h" // for return value

#include <string> // for std::string
#include <vector> // for std::vector

class vtkCPULinkOperator;
class vtkDeviceLinkOperator;
class vtkExchange;
class vtkExchangeMatrix;
class vtkFieldData;
class vtkLinkOperator;
class vtkMultiProcessController;

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

  /// Number of processes that share the scene; 1 without a controller.
  int GetNumberOfRanks() const;

  /// Whether a scene with hierarchical links is in the order of its atlases, for a ClusterTree
  /// (ClusterTreeType): Auto where all surfaces have "AtlasCoordinates". Collective.
  bool UsesAtlas(vtkDataObject* input, int clusterTree);

  ///@{
  /**
   * Progress within the stage set last (fractions of the whole run; the first begins at 0). In long
   * runs the progress text tells how much time is left. Returns false when the user has aborted.
   * Call it from one thread; on several ranks call it on all of them alike: they agree on the
   * answer.
   */
  void SetProgressStage(double begin, double end);
  bool ReportProgress(double fraction);
  ///@}

  /**
   * An empty exchange matrix for these patch areas, or this rank's part of it. Returns nullptr
   * after an error, which has been reported on all ranks alike: the memory is not there.
   */
  vtkSmartPointer<vtkExchangeMatrix> MakeExchange(const std::vector<double>& areas,
    int numberOfKernels);

  /**
   * Likewise with one kernel and no tile stored yet. `numberOfTiles` is the most that this rank
   * will store; the memory for them must be there.
   */
  vtkSmartPointer<vtkExchangeMatrix> MakeSparseExchange(const std::vector<double>& areas,
    vtkIdType numberOfTiles);

  /**
   * False, after reporting why, when the device is DEVICE_OPENGL and cannot be had. Asked before
   * any work starts: a user who insists on a device does not want to wait for the links to hear
   * that it is not there.
   */
  bool CheckDevice(int device);

  /**
   * The operator for a device (see DeviceType), initialised. DEVICE_AUTO takes OpenGL on a real GPU
   * and the CPU otherwise; `explanation` says which one and why. Returns nullptr after an error,
   * which has been reported.
   */
  vtkSmartPointer<vtkLinkOperator> MakeLinkOperator(int device, vtkExchange* exchange,
    int numberOfBands, std::string& explanation);

  /// The operator on the CPU for an exchange, initialised. Returns nullptr after an error, which
  /// has been reported.
  vtkSmartPointer<vtkCPULinkOperator> MakeCPULinkOperator(vtkExchange* exchange, int numberOfBands);

  ///@{
  /// One-tuple summaries of a run go into the output's field data.
  static void AddSummary(vtkFieldData* fields, const char* name, double value);
  static void AddSummary(vtkFieldData* fields, const char* name, const double values[3]);
  static void AddSummary(vtkFieldData* fields, const char* name, const std::string& value);
  ///@}

  vtkMultiProcessController* Controller = nullptr;
  double FeatureAngle = 60.0;

private:
  vtkTransportAlgorithm(const vtkTransportAlgorithm&) = delete;
  void operator=(const vtkTransportAlgorithm&) = delete;

  int GetRank() const;
  template <typename Allocation>
  vtkSmartPointer<vtkExchangeMatrix> AllocateExchange(std::size_t numberOfPatches, double bytes,
    const std::string& remedy, Allocation&& allocate);
  vtkSmartPointer<vtkDeviceLinkOperator> OpenDevice(int device, std::string& reason);

  void SetTimeLeft(double done);

  double StageBegin = 0.0;
  double StageEnd = 1.0;
  double StartTime = 0.0;
};

#endif
