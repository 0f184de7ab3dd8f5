// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkHierarchicalLinkOperator
 * @brief the link operator on the CPU, over links between clusters
 *
 * A product sweeps up the tree of a vtkExchangeHierarchy, gathers over the links, and sweeps down:
 * its cost is that of the patches and of the links that there are, not of the pairs.
 */
#ifndef vtkHierarchicalLinkOperator_h
#define vtkHierarchicalLinkOperator_h

#include "vtkCPULinkOperator.h"

class vtkExchangeHierarchy;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkHierarchicalLinkOperator : public vtkCPULinkOperator
{
public:
  static vtkHierarchicalLinkOperator* New();
  vtkTypeMacro(vtkHierarchicalLinkOperator, vtkCPULinkOperator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkHierarchicalLinkOperator();
  ~vtkHierarchicalLinkOperator() override;

  bool TakeExchange(vtkExchange* exchange) override;
  void DropExchange() override;
  vtkIdType GetPaddedSize() override { return this->NumberOfPatches; }
  void MultiplyPart(const Vector& x, Vector& y) override;
  void FillRow(vtkIdType i, int kernel, double* row) override;

private:
  vtkHierarchicalLinkOperator(const vtkHierarchicalLinkOperator&) = delete;
  void operator=(const vtkHierarchicalLinkOperator&) = delete;

  void SweepUp(const Vector& x);
  void SweepDown(int bands);
  void FillCodedRow(vtkIdType i, int kernel);

  vtkSmartPointer<vtkExchangeHierarchy> Hierarchy;
  ///@{ What is sent and received: slot after slot, its bands side by side.
  std::vector<double> Sent;
  std::vector<double> Received;
  ///@}
};

#endif
