// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDenseLinkOperator
 * @brief the link operator on the CPU, over all stored pairs
 *
 * The matrix is read once per product for up to four bands, and because only one triangle of it is
 * stored, half the bytes of a full matrix are read; tiles that are not stored cost nothing.
 *
 * It also sweeps, for Gauss-Seidel; that needs a matrix in one part.
 */
#ifndef vtkDenseLinkOperator_h
#define vtkDenseLinkOperator_h

#include "vtkCPULinkOperator.h"

class vtkExchangeMatrix;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkDenseLinkOperator : public vtkCPULinkOperator
{
public:
  static vtkDenseLinkOperator* New();
  vtkTypeMacro(vtkDenseLinkOperator, vtkCPULinkOperator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * One Gauss-Seidel sweep over all patches in their order: x_i = e_i + l_i sum_j G_ij x_j with the
   * newest values of x at every step. Off-diagonal tiles are products of all threads, the sweep
   * itself goes through the diagonal tiles.
   */
  bool Sweep(int x, int e, int left);

  /// The instruction set of the innermost loops, for reports.
  static const char* GetInstructionSet();

protected:
  vtkDenseLinkOperator();
  ~vtkDenseLinkOperator() override;

  bool TakeExchange(vtkExchange* exchange) override;
  void DropExchange() override;
  vtkIdType GetPaddedSize() override;
  void MultiplyPart(const Vector& x, Vector& y) override;
  void FillRow(vtkIdType i, int kernel, double* row) override;

private:
  vtkDenseLinkOperator(const vtkDenseLinkOperator&) = delete;
  void operator=(const vtkDenseLinkOperator&) = delete;

  void GatherOffDiagonal(vtkIdType tileRow, const Vector& x, Vector& sums);

  vtkSmartPointer<vtkExchangeMatrix> Exchange;
};

#endif
