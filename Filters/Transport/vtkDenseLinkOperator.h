// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDenseLinkOperator
 * @brief the link operator on the CPU, over all stored pairs
 *
 * Threads come from vtkSMPTools (the STDThread backend where nothing else was chosen). The matrix
 * is read once per product for up to four bands, and because only one triangle of it is stored,
 * half the bytes of a full matrix are read; tiles that are not stored cost nothing. Vectors and
 * sums are double precision.
 *
 * For solvers that go from patch to patch (Gauss-Seidel, Southwell) it also sweeps and gives rows;
 * those need a matrix in one part.
 */
#ifndef vtkDenseLinkOperator_h
#define vtkDenseLinkOperator_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkLinkOperator.h"

#include <map>    // for std::map
#include <vector> // for std::vector

class vtkMultiProcessController;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkDenseLinkOperator : public vtkLinkOperator
{
public:
  static vtkDenseLinkOperator* New();
  vtkTypeMacro(vtkDenseLinkOperator, vtkLinkOperator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The ranks that hold the parts of the matrix; needed only when it has several.
  void SetController(vtkMultiProcessController* controller);

  bool Initialize(vtkExchangeMatrix* exchange, int numberOfBands) override;
  void Release() override;
  const char* GetDeviceName() override { return "CPU"; }
  bool IsSinglePrecision() override { return false; }

  bool SetVector(int slot, const double* values) override;
  bool GetVector(int slot, double* values) override;
  bool Multiply(int y, int x) override;
  bool Combine(int z, const double* a, int x, const double* b, int y) override;
  bool Scale(int z, int x, int y) override;
  bool Dot(int x, int y, double* result) override;
  bool MaxNorm(int x, double* result) override;

  /**
   * One Gauss-Seidel sweep over all patches in their order: x_i = e_i + l_i sum_j G_ij x_j with the
   * newest values of x at every step. Off-diagonal tiles are products of all threads, the sweep
   * itself goes through the diagonal tiles.
   */
  bool Sweep(int x, int e, int left);

  /// Row i of the kernel that a band uses: row[j] = G_ij for all patches j.
  bool GetRow(vtkIdType i, int band, double* row);

  /// The instruction set of the innermost loops, for reports.
  static const char* GetInstructionSet();
  /// Threads that a product uses.
  static int GetNumberOfThreads();

protected:
  vtkDenseLinkOperator();
  ~vtkDenseLinkOperator() override;

private:
  vtkDenseLinkOperator(const vtkDenseLinkOperator&) = delete;
  void operator=(const vtkDenseLinkOperator&) = delete;

  using Vector = std::vector<double>; ///< band after band, each padded to whole tiles

  Vector* FindVector(int slot);
  Vector& MakeVector(int slot);
  template <typename Operation>
  bool ForEachBand(int x, int y, Operation&& operation);
  void GatherOffDiagonal(vtkIdType tileRow, const Vector& x, Vector& sums);

  vtkExchangeMatrix* Exchange = nullptr;
  vtkMultiProcessController* Controller = nullptr;
  long Stride = 0;
  std::map<int, Vector> Vectors;
};

#endif
