// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCPULinkOperator
 * @brief the vectors of link operators that compute on the CPU, and what they can do beyond others
 *
 * Vectors and sums are double precision. Threads come from vtkSMPTools (the STDThread backend where
 * nothing else was chosen). Forms of links: vtkDenseLinkOperator, vtkHierarchicalLinkOperator; New
 * for an exchange gives the one that takes it.
 */
#ifndef vtkCPULinkOperator_h
#define vtkCPULinkOperator_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkLinkOperator.h"
#include "vtkSmartPointer.h" // for return value

#include <map>    // for std::map
#include <vector> // for std::vector

class vtkMultiProcessController;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkCPULinkOperator : public vtkLinkOperator
{
public:
  vtkAbstractTypeMacro(vtkCPULinkOperator, vtkLinkOperator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// An operator for this form of exchange, which Initialize will take.
  static vtkSmartPointer<vtkCPULinkOperator> NewFor(vtkExchange* exchange);

  /// The ranks that hold the parts of the exchange; needed only when it has several.
  void SetController(vtkMultiProcessController* controller);

  const char* GetDeviceName() override { return "CPU"; }
  bool IsSinglePrecision() override { return false; }

  bool Initialize(vtkExchange* exchange, int numberOfBands) override;
  void Release() override;
  bool SetVector(int slot, const double* values) override;
  bool GetVector(int slot, double* values) override;
  bool Multiply(int y, int x) override;
  bool Combine(int z, const double* a, int x, const double* b, int y) override;
  bool Scale(int z, int x, int y) override;
  bool Dot(int x, int y, double* result) override;
  bool MaxNorm(int x, double* result) override;

  /// Row i of the kernel that a band uses: row[j] = G_ij for all patches j. The exchange must be in
  /// one part.
  bool GetRow(vtkIdType i, int band, double* row);

  /// Threads that a product uses.
  static int GetNumberOfThreads();

protected:
  vtkCPULinkOperator();
  ~vtkCPULinkOperator() override;

  using Vector = std::vector<double>; ///< band after band, each padded to Stride

  ///@{
  /// What the forms differ in: whether they take an exchange (null if not), the patches that a band
  /// is padded to, the product with this part, and a row.
  virtual bool TakeExchange(vtkExchange* exchange) = 0;
  virtual void DropExchange() = 0;
  virtual vtkIdType GetPaddedSize() = 0; ///< NumberOfPatches is set by then
  virtual void MultiplyPart(const Vector& x, Vector& y) = 0;
  virtual void FillRow(vtkIdType i, int kernel, double* row) = 0;
  ///@}

  /// Null, after reporting it, where the vector was not written yet.
  Vector* FindVector(int slot);
  Vector& MakeVector(int slot);

  int NumberOfKernels = 0;
  int NumberOfParts = 1;
  long Stride = 0;

private:
  vtkCPULinkOperator(const vtkCPULinkOperator&) = delete;
  void operator=(const vtkCPULinkOperator&) = delete;

  template <typename Operation>
  bool ForEachBand(int x, int y, Operation&& operation);

  vtkMultiProcessController* Controller = nullptr;
  std::map<int, Vector> Vectors;
};

#endif
