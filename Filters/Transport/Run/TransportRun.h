// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * One run of a transport filter, from its input to its output: check, gather, read, link, compute,
 * write. A filter has a class of its own for the steps in which it differs, with what a run finds
 * on its way; what is kept from run to run belongs to the filter.
 */
#ifndef TransportRun_h
#define TransportRun_h

#include "Run/FilterProgress.h"
#include "Scene/PatchScene.h"
#include "Shared/Monitor.h"
#include "Shared/NumberProperties.h"
#include "Shared/Outcome.h"
#include "Support/Ranks.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkDataObject;
class vtkFieldData;
class vtkTable;
class vtkTransportAlgorithm;

namespace LightTransport
{
/// What a filter hands to its run.
struct RunPorts
{
  vtkTransportAlgorithm* Filter = nullptr;
  vtkDataObject* Input = nullptr;
  vtkDataObject* Output = nullptr;
  vtkTable* Table = nullptr;     ///< of port 1; nullptr where a filter has none
  double ProgressInterval = 0.0; ///< seconds between progress events within a long step
  bool LinksAlone = false;       ///< the links, and no light that they carry
};

class TransportRun
{
public:
  explicit TransportRun(const RunPorts& ports);
  virtual ~TransportRun();

  /// All steps in their order, until one is not done. The outcome is the same on all ranks.
  Outcome Go();

  /// What to say where a transport filter gets no memory, or a library gives up.
  static const Advice& GetAdvice();

protected:
  /// Properties that VTK clamps, for all that are no numbers to be refused first.
  virtual NumberProperties::List ListNumbers() const;
  /// Properties that contradict each other or are out of range, before any work.
  virtual Outcome Check() { return Outcome::Done(); }
  /// The scene from the input; in the spatial order, unless a filter needs another.
  virtual Outcome Gather();
  /// Arrays, lights and materials.
  virtual Outcome Read() = 0;
  /// Links between patches.
  virtual Outcome Link() { return Outcome::Done(); }
  virtual Outcome Compute() = 0;
  /// Arrays and summaries into the output.
  virtual void Write() = 0;

  /// Patches that were arranged before as they were.
  Outcome GatherInOrder(PatchScene::Order order,
    std::shared_ptr<const PatchArrangement> kept = nullptr);
  /// Gather in the order that links between clusters need, for a ClusterTree
  /// (vtkTransportAlgorithm::ClusterTreeType): Auto takes atlases where all surfaces have one.
  Outcome GatherForClusters(int clusterTree);

  /// Do something with each patch of this rank that costs about as much as `rays` rays, with
  /// progress up to a fraction. `finish`: then to be done with each, one after another.
  Outcome ForLocalPatches(double rays, double done,
    const std::function<void(vtkIdType patch)>& compute,
    const std::function<void(vtkIdType patch)>& finish = {});

  /// Of the surface that light enters.
  static Outcome CheckRefractiveIndex(double index);

  void Warn(const std::string& text) const;
  /// What is the same on all ranks, by the first of them.
  void WarnOnce(const std::vector<std::string>& warnings) const;
  /// The name of the array that a user chose for an input of the filter, else `defaultName`.
  std::string GetArrayName(int index, const char* defaultName) const;
  vtkFieldData* GetOutputFields() const;
  /// The square of the scene's unit of length in that of the input.
  double GetAreaUnit() const { return this->Scene.GetScale() * this->Scene.GetScale(); }

  /// 2 where the backs of polygons count: to be set before Gather.
  int NumberOfSides = 1;
  /// Whether the input may be texel images: to be set before Gather.
  bool TakesTexels = false;

  vtkTransportAlgorithm* Filter;
  vtkDataObject* Input;
  vtkDataObject* Output;
  vtkTable* Table;
  Ranks AllRanks;
  FilterProgress Progress;
  PatchScene Scene;

private:
  double ProgressInterval;

  Outcome CheckNumbers();
  Outcome WarnOfScene();
  Outcome Finish();
  Outcome CheckResults() const;
};
} // namespace LightTransport

#endif
