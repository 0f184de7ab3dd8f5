// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Links between clusters, and products with them, against the dense matrix that they stand for.
#include "LightTransportTesting.h"
#include "RanksInThreads.h"
#include "vtkDenseLinkOperator.h"
#include "vtkExchangeHierarchy.h"
#include "vtkExchangeMatrix.h"
#include "vtkHierarchicalLinkOperator.h"
#include "vtkTestErrorObserver.h"

#include <Eigen/Core>

#include <algorithm>
#include <mutex>
#include <random>

using namespace LightTransportTesting;

namespace
{
using Node = vtkExchangeHierarchy::Node;
using Link = vtkExchangeHierarchy::Link;
using Matrix = Eigen::MatrixXd;
// Values as the operators take them: the bands of a patch side by side.
using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

//------------------------------------------------------------------------------
struct Tree
{
  std::vector<Node> Nodes;
  std::vector<double> Areas;
  std::vector<double> Weights;
  std::vector<Link> Links;

  int GetNumberOfSlots() const { return static_cast<int>(this->Nodes.size() + this->Areas.size()); }
};

//------------------------------------------------------------------------------
// Nodes of one to four children, leaves of one to six patches on any level; the patches of the
// leaves lie in another order than the leaves.
Tree MakeTree(int mostNodes, unsigned seed)
{
  std::mt19937 generator(seed);
  const auto choose = [&](int low, int high)
  { return std::uniform_int_distribution<int>(low, high)(generator); };
  Tree tree;
  std::vector<std::size_t> leaves;
  int nodes = 1;
  for (int node = 0; node < nodes; ++node)
  {
    const int children = choose(1, 4);
    const bool divides = nodes + children <= mostNodes && (node + 1 == nodes || choose(0, 3) > 0);
    tree.Nodes.push_back({ nodes, nodes + children });
    if (divides)
    {
      nodes += children;
    }
    else
    {
      leaves.push_back(tree.Nodes.size() - 1);
    }
  }
  std::shuffle(leaves.begin(), leaves.end(), generator);
  int next = nodes;
  for (const std::size_t leaf : leaves)
  {
    tree.Nodes[leaf] = { next, next + choose(1, 6) };
    next = tree.Nodes[leaf].Last;
  }
  std::uniform_real_distribution<double> uniform(0.1, 2.0);
  for (int patch = nodes; patch < next; ++patch)
  {
    tree.Areas.push_back(uniform(generator));
    tree.Weights.push_back(tree.Areas.back() * uniform(generator));
  }
  return tree;
}

//------------------------------------------------------------------------------
// Between slots of any two levels, a tenth of them of a slot with itself.
void AddLinks(Tree& tree, int count, unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_int_distribution<int> slot(0, tree.GetNumberOfSlots() - 1);
  std::uniform_real_distribution<float> value(0.0f, 1.0f);
  for (int k = 0; k < count; ++k)
  {
    const int i = slot(generator);
    const int j = k % 10 == 0 ? i : slot(generator);
    tree.Links.push_back({ i, j, value(generator) });
  }
}

//------------------------------------------------------------------------------
void FindPatches(const Tree& tree, int slot, std::vector<int>& patches)
{
  const int nodes = static_cast<int>(tree.Nodes.size());
  if (slot >= nodes)
  {
    patches.push_back(slot - nodes);
    return;
  }
  for (int child = tree.Nodes[slot].First; child < tree.Nodes[slot].Last; ++child)
  {
    FindPatches(tree, child, patches);
  }
}

//------------------------------------------------------------------------------
// G_ij = w_i K w_j for all i below I and j below J, and the other way round.
Matrix MakeMatrix(const Tree& tree)
{
  const auto patches = static_cast<Eigen::Index>(tree.Areas.size());
  std::vector<std::vector<int>> below(tree.GetNumberOfSlots());
  for (int slot = 0; slot < tree.GetNumberOfSlots(); ++slot)
  {
    FindPatches(tree, slot, below[slot]);
  }
  Matrix matrix = Matrix::Zero(patches, patches);
  for (const Link& link : tree.Links)
  {
    for (const int i : below[link.I])
    {
      for (const int j : below[link.J])
      {
        const double value = tree.Weights[i] * static_cast<double>(link.Value) * tree.Weights[j];
        matrix(i, j) += value;
        matrix(j, i) += link.I == link.J ? 0.0 : value;
      }
    }
  }
  return matrix;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkExchangeHierarchy> MakeHierarchy(const Tree& tree, int part = 0, int parts = 1)
{
  auto hierarchy = vtkSmartPointer<vtkExchangeHierarchy>::New();
  std::vector<Link> mine;
  for (std::size_t k = part; k < tree.Links.size(); k += parts)
  {
    mine.push_back(tree.Links[k]);
  }
  Check(hierarchy->SetTree(tree.Areas, tree.Nodes, part, parts), "tree taken");
  Check(hierarchy->SetLinks(mine), "links taken");
  hierarchy->SetWeights(tree.Weights);
  return hierarchy;
}

//------------------------------------------------------------------------------
Values MakeValues(Eigen::Index patches, int bands, unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Values values(patches, bands);
  std::generate(values.data(), values.data() + values.size(), [&]() { return uniform(generator); });
  return values;
}

//------------------------------------------------------------------------------
Values Multiply(vtkLinkOperator* links, const Values& x)
{
  Values y = Values::Zero(x.rows(), x.cols());
  Check(links->SetVector(0, x.data()) && links->Multiply(1, 0) && links->GetVector(1, y.data()),
    "product");
  return y;
}

//------------------------------------------------------------------------------
double Compare(const Matrix& found, const Matrix& expected)
{
  return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

//------------------------------------------------------------------------------
void CheckRefused(const std::vector<Node>& nodes, std::size_t patches, const std::string& what)
{
  vtkNew<vtkExchangeHierarchy> hierarchy;
  Check(hierarchy->SetTree({ 1.0, 1.0 }, { { 1, 3 } }) && hierarchy->SetLinks({ { 1, 2, 0.5f } }) &&
      hierarchy->GetNumberOfLinks() == 1,
    "a good tree before " + what);
  Check(!hierarchy->SetTree(std::vector<double>(patches, 1.0), nodes), what + " is refused");
  Check(hierarchy->GetNumberOfPatches() == 0 && hierarchy->GetNumberOfNodes() == 0 &&
      hierarchy->GetNumberOfSlots() == 0 && hierarchy->GetNumberOfLinks() == 0 &&
      hierarchy->GetParents().empty() && hierarchy->GetWeights().empty(),
    "nothing is left after " + what);
}

//------------------------------------------------------------------------------
void TestTrees()
{
  // Root 0, nodes 1 and 2, patches from 3 on.
  CheckRefused({}, 2, "a tree without nodes");
  CheckRefused({ { 1, 1 } }, 0, "a tree without patches");
  CheckRefused({ { 1, 3 }, { 3, 3 }, { 3, 5 } }, 2, "a leaf without patches");
  CheckRefused({ { 1, 3 }, { 5, 3 }, { 3, 5 } }, 2, "a range that runs backwards");
  CheckRefused({ { 1, 3 }, { 3, 5 }, { 4, 6 } }, 3, "a patch in two leaves");
  CheckRefused({ { 1, 3 }, { 3, 4 }, { 5, 6 } }, 3, "a patch in no leaf");
  CheckRefused({ { 1, 3 }, { 3, 5 }, { 5, 7 } }, 3, "a patch that is not there");
  CheckRefused({ { 1, 2 }, { 3, 4 }, { 4, 5 } }, 2, "a node that is no child");
  CheckRefused({ { 2, 3 }, { 3, 4 }, { 4, 5 } }, 2, "a hole before the first child");
  CheckRefused({ { 1, 4 }, { 3, 4 }, { 4, 5 } }, 2, "children of both kinds");
  CheckRefused({ { 1, 2 }, { 0, 1 } }, 1, "a root with a parent");
  CheckRefused({ { -1, 2 }, { 2, 3 } }, 1, "a negative slot");
  CheckRefused({ { 1, 3 }, { 4, 5 }, { 3, 4 }, { 5, 6 }, { 6, 7 } }, 2, "children out of order");

  vtkNew<vtkExchangeHierarchy> hierarchy;
  Check(hierarchy->SetTree({ 2.0 }, { { 1, 2 } }), "one patch");
  Check(hierarchy->GetParents() == std::vector<int>({ -1, 0 }), "parents of one patch");
  Check(hierarchy->SetTree({ 1.0, 2.0 }, { { 1, 2 }, { 2, 3 }, { 3, 5 } }), "a chain");
  Check(hierarchy->GetLevels() == std::vector<int>({ 0, 1, 2, 3 }), "levels of a chain");
  Check(hierarchy->SetTree({ 3.0, 4.0, 5.0 }, { { 1, 3 }, { 5, 6 }, { 3, 5 }, { 7, 8 }, { 6, 7 } }),
    "leaves on two levels");
  Check(hierarchy->GetParents() == std::vector<int>({ -1, 0, 0, 2, 2, 1, 4, 3 }), "parents");
  Check(hierarchy->GetLevels() == std::vector<int>({ 0, 1, 3, 5 }), "levels");
  Check(hierarchy->GetWeights() == hierarchy->GetAreas(), "the weights are the areas");
  Check(hierarchy->GetNumberOfKernels() == 1 && hierarchy->GetNumberOfParts() == 1, "one kernel");
}

//------------------------------------------------------------------------------
void TestProducts(const Tree& tree, const Matrix& matrix, int bands)
{
  const std::string what =
    " (" + std::to_string(tree.Areas.size()) + " patches, " + std::to_string(bands) + " bands)";
  auto hierarchy = MakeHierarchy(tree);
  vtkNew<vtkHierarchicalLinkOperator> links;
  Check(links->Initialize(hierarchy, bands), "initialize" + what);
  const Values x = MakeValues(matrix.rows(), bands, 1);
  const Values y = MakeValues(matrix.rows(), bands, 2);
  const Values gx = Multiply(links, x);
  const Values gy = Multiply(links, y);
  Check(Compare(gx, matrix * x) < 1e-12, "product" + what);
  for (int band = 0; band < bands; ++band)
  {
    CheckClose(x.col(band).dot(gy.col(band)), y.col(band).dot(gx.col(band)),
      1e-12 * gx.col(band).norm(), "symmetry" + what);
  }
  // Rows between two products disturb neither.
  Eigen::RowVectorXd row(matrix.cols());
  for (const Eigen::Index i : { Eigen::Index(0), matrix.rows() / 3, matrix.rows() - 1 })
  {
    Check(links->GetRow(i, bands - 1, row.data()), "row");
    Check(Compare(row, matrix.row(i)) < 1e-12, "row" + what);
    for (Eigen::Index j = 0; j < matrix.cols(); j += 7)
    {
      CheckClose(hierarchy->GetValue(i, j), matrix(i, j), 1e-12, "value" + what);
      Check(std::abs(hierarchy->GetValue(i, j) - hierarchy->GetValue(j, i)) <= 1e-14 * row[j],
        "reciprocity" + what);
    }
  }
  Check(Multiply(links, x) == gx, "the same product again" + what);
}

//------------------------------------------------------------------------------
// Links that serve one direction, with a kernel for each band: the tree's links in the rows of
// their first ends.
void TestRows(const Tree& tree)
{
  constexpr int kernels = 3;
  std::vector<std::int64_t> offsets(tree.GetNumberOfSlots() + 1, 0);
  std::vector<int> columns;
  std::vector<float> values;
  std::vector<Matrix> matrices(kernels, Matrix::Zero(tree.Areas.size(), tree.Areas.size()));
  for (int slot = 0; slot < tree.GetNumberOfSlots(); ++slot)
  {
    for (const Link& link : tree.Links)
    {
      std::vector<int> rows;
      std::vector<int> others;
      FindPatches(tree, link.I, rows);
      FindPatches(tree, link.J, others);
      for (int kernel = 0; link.I == slot && kernel < kernels; ++kernel)
      {
        values.push_back(link.Value / static_cast<float>(1 + kernel));
        for (const int i : rows)
        {
          for (const int j : others)
          {
            matrices[kernel](i, j) +=
              tree.Weights[i] * static_cast<double>(values.back()) * tree.Weights[j];
          }
        }
      }
      columns.insert(columns.end(), link.I == slot ? 1 : 0, link.J);
    }
    offsets[slot + 1] = static_cast<std::int64_t>(columns.size());
  }
  vtkNew<vtkExchangeHierarchy> hierarchy;
  Check(hierarchy->SetTree(tree.Areas, tree.Nodes, 0, 1, kernels) && hierarchy->IsSymmetric(),
    "a tree of three kernels");
  Check(!hierarchy->SetRows(offsets, columns, { 1.0f }) && hierarchy->GetNumberOfLinks() == 0,
    "rows without their values are refused");
  Check(hierarchy->SetRows(offsets, columns, values) && !hierarchy->IsSymmetric() &&
      hierarchy->GetNumberOfLinks() == static_cast<vtkIdType>(tree.Links.size()),
    "rows");
  hierarchy->SetWeights(tree.Weights);
  vtkNew<vtkHierarchicalLinkOperator> links;
  Check(links->Initialize(hierarchy, kernels), "initialize with rows");
  const Values x = MakeValues(static_cast<Eigen::Index>(tree.Areas.size()), kernels, 5);
  const Values y = Multiply(links, x);
  Eigen::RowVectorXd row(x.rows());
  for (int kernel = 0; kernel < kernels; ++kernel)
  {
    Check(Compare(y.col(kernel), matrices[kernel] * x.col(kernel)) < 1e-12, "product of rows");
    Check(links->GetRow(1, kernel, row.data()), "row of a kernel");
    Check(Compare(row, matrices[kernel].row(1)) < 1e-12, "row of each kernel");
    CheckClose(hierarchy->GetValue(1, 2, kernel), matrices[kernel](1, 2), 1e-12, "value");
  }
  // Several lights side by side, as they are gathered at a time and more: each as if it were alone.
  for (const int lights : { 2, 3, 4, 7 })
  {
    const Values many = MakeValues(x.rows(), lights * kernels, 6);
    vtkNew<vtkHierarchicalLinkOperator> together;
    Check(together->Initialize(hierarchy, lights * kernels), "initialize for several lights");
    const Values all = Multiply(together, many);
    for (int light = 0; light < lights; ++light)
    {
      const Values one = many.middleCols(light * kernels, kernels);
      Check(all.middleCols(light * kernels, kernels) == Multiply(links, one),
        "lights beside others");
    }
    Check(together->GetRow(1, kernels + 1, row.data()), "row of a band of another light");
    Check(Compare(row, matrices[1].row(1)) < 1e-12, "row of its kernel");
  }
  Check(hierarchy->SetLinks({}) && hierarchy->IsSymmetric(), "no links are symmetric");
}

//------------------------------------------------------------------------------
// More rows than one thread takes at a time.
void TestThreads()
{
  Tree tree = MakeTree(1500, 8);
  AddLinks(tree, 20000, 9);
  Check(tree.GetNumberOfSlots() > 4096, "enough slots for several threads");
  auto hierarchy = MakeHierarchy(tree);
  vtkNew<vtkHierarchicalLinkOperator> links;
  links->Initialize(hierarchy, 3);
  const Values x = MakeValues(static_cast<Eigen::Index>(tree.Areas.size()), 3, 3);
  Values results[2];
  for (const int threads : { 1, 4 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&]() { results[threads / 4] = Multiply(links, x); });
  }
  Check(results[0] == results[1], "a product does not depend on the number of threads");
  Check(Compare(results[0], MakeMatrix(tree) * x) < 1e-12, "product of many slots");
}

//------------------------------------------------------------------------------
void TestBytes(Tree tree)
{
  auto hierarchy = MakeHierarchy(tree);
  const double with = hierarchy->GetNumberOfBytes();
  const vtkIdType selves = std::count_if(tree.Links.begin(), tree.Links.end(),
    [](const Link& link) { return link.I == link.J; });
  Check(hierarchy->GetNumberOfLinks() == static_cast<vtkIdType>(tree.Links.size()), "links");
  Check(hierarchy->SetLinks({}) && hierarchy->GetNumberOfLinks() == 0, "no links");
  CheckClose(with - hierarchy->GetNumberOfBytes(),
    vtkExchangeHierarchy::GetEstimatedBytes(tree.Links.size() - 0.5 * selves), 1e-15,
    "bytes of the links");
  const double least = static_cast<double>(tree.Areas.size()) * 2 * sizeof(double) +
    tree.Nodes.size() * sizeof(Node) + tree.GetNumberOfSlots() * sizeof(int);
  Check(hierarchy->GetNumberOfBytes() >= least && hierarchy->GetNumberOfBytes() < 2 * least,
    "bytes of the tree");
  Check(hierarchy->GetValue(0, 1) == 0.0, "no links, no exchange");
}

//------------------------------------------------------------------------------
void TestRefusals(const Tree& tree)
{
  const auto check =
    [](vtkCPULinkOperator* links, vtkExchange* exchange, int bands, const std::string& message)
  {
    vtkNew<vtkTest::ErrorObserver> observer;
    links->AddObserver(vtkCommand::ErrorEvent, observer);
    Check(!links->Initialize(exchange, bands), "refused: " + message);
    Check(observer->GetErrorMessage().find(message) != std::string::npos,
      "\"" + message + "\" in: " + observer->GetErrorMessage());
  };
  vtkNew<vtkExchangeMatrix> dense;
  dense->Allocate({ 1.0, 1.0 }, 1);
  auto hierarchy = MakeHierarchy(tree);
  check(vtkNew<vtkHierarchicalLinkOperator>(), dense, 1,
    "vtkHierarchicalLinkOperator does not apply a vtkExchangeMatrix: use vtkCPULinkOperator");
  check(vtkNew<vtkDenseLinkOperator>(), hierarchy, 1,
    "vtkDenseLinkOperator does not apply a vtkExchangeHierarchy: use vtkCPULinkOperator");
  check(vtkNew<vtkHierarchicalLinkOperator>(), hierarchy, 0, "at least one band");
  check(vtkNew<vtkHierarchicalLinkOperator>(), MakeHierarchy(tree, 1, 3), 1, "is in 3 parts");
  Check(vtkHierarchicalLinkOperator::SafeDownCast(vtkCPULinkOperator::NewFor(hierarchy)) &&
      vtkDenseLinkOperator::SafeDownCast(vtkCPULinkOperator::NewFor(dense)),
    "NewFor gives the operator that takes an exchange");
}

//------------------------------------------------------------------------------
// Last: ranks make vtkSMPTools sequential.
void TestParts(const Tree& tree, const Matrix& matrix)
{
  constexpr int ranks = 3;
  const Values x = MakeValues(matrix.rows(), 2, 4);
  double worst = 0.0;
  Matrix sum = Matrix::Zero(matrix.rows(), matrix.cols());
  std::mutex mutex;
  RunRanks(ranks,
    [&](vtkMultiProcessController* controller, int rank)
    {
      auto hierarchy = MakeHierarchy(tree, rank, ranks);
      vtkNew<vtkHierarchicalLinkOperator> links;
      links->SetController(controller);
      const bool good = links->Initialize(hierarchy, 2);
      const Values y = Multiply(links, x);
      const std::lock_guard<std::mutex> lock(mutex);
      Check(good, "initialize with parts");
      worst = std::max(worst, Compare(y, matrix * x));
      for (Eigen::Index k = 0; k < sum.size(); ++k)
      {
        sum(k) += hierarchy->GetValue(k % sum.rows(), k / sum.rows());
      }
    });
  Check(worst < 1e-12, "the parts add up in products");
  Check(Compare(sum, matrix) < 1e-12, "the parts add up in values");
}
} // namespace

//------------------------------------------------------------------------------
int TestExchangeHierarchy(int, char*[])
{
  TestTrees();
  Tree tree;
  Matrix matrix;
  for (const int nodes : { 1, 2, 9, 120 })
  {
    tree = MakeTree(nodes, 10 + nodes);
    AddLinks(tree, 10 * nodes, nodes);
    matrix = MakeMatrix(tree);
    for (const int bands : { 1, 3, 4, 5 })
    {
      TestProducts(tree, matrix, bands);
    }
  }
  TestRows(tree);
  TestThreads();
  TestBytes(tree);
  TestRefusals(tree);
  TestParts(tree, matrix);
  return Result();
}
