// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkExchange
 * @brief the symmetric exchange G between all pairs of patches, in whatever form it is stored
 *
 * G_ij is what links patch i and patch j in both directions: for radiosity G_ij = A_i F_ij = A_j
 * F_ji; for subsurface scattering the diffuse reflectance profile integrated over both patches.
 * Reciprocity is therefore a property of the storage, not of the code that fills it.
 *
 * There are one or more *kernels*: one where all bands share the exchange (radiosity), one per band
 * where each band has its own (scattering). With several *parts* (the ranks of a parallel run) the
 * sum over the parts is the exchange.
 *
 * Forms: vtkExchangeMatrix (all pairs, in tiles) and vtkExchangeHierarchy (links between clusters
 * of patches). Link operators (vtkLinkOperator) apply it.
 *
 * The areas of the patches, in the unit that the filler chose, are kept beside it, so that G/A has
 * no unit.
 */
#ifndef vtkExchange_h
#define vtkExchange_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkObject.h"

#include <vector> // for std::vector

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkExchange : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkExchange, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkIdType GetNumberOfPatches() const { return static_cast<vtkIdType>(this->Areas.size()); }
  int GetNumberOfKernels() const { return this->NumberOfKernels; }
  int GetNumberOfParts() const { return this->NumberOfParts; }
  const std::vector<double>& GetAreas() const { return this->Areas; }

  /// G_ij of one kernel, as far as this part holds it.
  virtual double GetValue(vtkIdType i, vtkIdType j, int kernel = 0) const = 0;

  /// Bytes that this part takes as it is.
  virtual double GetNumberOfBytes() const = 0;

protected:
  vtkExchange();
  ~vtkExchange() override;

  std::vector<double> Areas;
  int NumberOfKernels = 0;
  int Part = 0;
  int NumberOfParts = 1;

private:
  vtkExchange(const vtkExchange&) = delete;
  void operator=(const vtkExchange&) = delete;
};

#endif
