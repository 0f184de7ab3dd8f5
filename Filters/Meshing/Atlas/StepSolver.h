// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The step to the minimum of a sum of quadratic forms, one per element of Size unknowns. Unknowns
/// may be -1: held fast.
#ifndef StepSolver_h
#define StepSolver_h

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace LightTransport
{
template <int Size>
class StepSolver
{
public:
  using Unknowns = std::array<int, Size>;
  using Hessian = Eigen::Matrix<double, Size, Size>;
  using Gradient = Eigen::Matrix<double, Size, 1>;

  StepSolver(std::vector<Unknowns> elements, int numberOfUnknowns)
    : Elements(std::move(elements)), Matrix(numberOfUnknowns, numberOfUnknowns),
      Slope(numberOfUnknowns)
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (const Unknowns& unknowns : this->Elements)
    {
      ForEachEntry(unknowns,
        [&](int i, int j) { entries.emplace_back(unknowns[i], unknowns[j], 0.0); });
    }
    this->Matrix.setFromTriplets(entries.begin(), entries.end());
    for (const Unknowns& unknowns : this->Elements)
    {
      ForEachEntry(unknowns,
        [&](int i, int j) { this->Slots.push_back(this->FindSlot(unknowns[i], unknowns[j])); });
    }
    this->Solver.analyzePattern(this->Matrix);
  }

  void Clear()
  {
    std::fill_n(this->Matrix.valuePtr(), this->Matrix.nonZeros(), 0.0);
    this->Slope.setZero();
    this->NextElement = 0;
    this->NextSlot = 0;
  }

  /// For the elements in their order.
  void Add(const Hessian& hessian, const Gradient& gradient)
  {
    const Unknowns& unknowns = this->Elements[this->NextElement++];
    ForEachEntry(unknowns,
      [&](int i, int j)
      { this->Matrix.valuePtr()[this->Slots[this->NextSlot++]] += hessian(i, j); });
    for (int i = 0; i < Size; ++i)
    {
      if (unknowns[i] >= 0)
      {
        this->Slope[unknowns[i]] += gradient[i];
      }
    }
  }

  bool Solve(Eigen::VectorXd& step)
  {
    this->Solver.factorize(this->Matrix);
    if (this->Solver.info() != Eigen::Success)
    {
      return false;
    }
    step = this->Solver.solve(-this->Slope);
    return step.allFinite();
  }

  const Eigen::VectorXd& GetSlope() const { return this->Slope; }

private:
  // The lower triangle, all that the solver reads.
  template <typename Visitor>
  static void ForEachEntry(const Unknowns& unknowns, Visitor&& visit)
  {
    for (int i = 0; i < Size; ++i)
    {
      for (int j = 0; j < Size; ++j)
      {
        if (unknowns[j] >= 0 && unknowns[i] >= unknowns[j])
        {
          visit(i, j);
        }
      }
    }
  }

  int FindSlot(int row, int column) const
  {
    const int* rows = this->Matrix.innerIndexPtr();
    const int* columns = this->Matrix.outerIndexPtr();
    return static_cast<int>(
      std::lower_bound(rows + columns[column], rows + columns[column + 1], row) - rows);
  }

  std::vector<Unknowns> Elements;
  Eigen::SparseMatrix<double> Matrix;
  Eigen::VectorXd Slope;
  std::vector<int> Slots;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> Solver;
  std::size_t NextElement = 0;
  std::size_t NextSlot = 0;
};
} // namespace LightTransport

#endif
