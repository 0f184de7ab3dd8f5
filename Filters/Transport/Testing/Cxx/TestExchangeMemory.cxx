// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The check for memory before an exchange matrix is made: on one rank and on several.
#include "Links/LinkOperators.h"
#include "OutcomeTesting.h"
#include "RanksInThreads.h"
#include "Support/Ranks.h"
#include "vtkExchangeMatrix.h"

using namespace LightTransport;
using namespace LightTransportTesting;

namespace
{
/// More tiles than any memory holds.
constexpr vtkIdType TooMany = vtkIdType(1) << 40;

using Matrix = vtkSmartPointer<vtkExchangeMatrix>;

//------------------------------------------------------------------------------
void TestOneRank()
{
  constexpr vtkIdType n = 1000;
  const std::vector<double> areas(n, 1.0);
  Matrix sparse, dense, refused;
  CheckDone(LinkOperators::AllocateSparseMatrix(areas, 10, Ranks(), sparse), "a sparse matrix");
  Check(sparse && sparse->GetNumberOfStoredTiles() == 0 && sparse->GetTiles().size() == 10 &&
      sparse->GetNumberOfKernels() == 1 && sparse->GetAreas() == areas,
    "a sparse matrix");
  CheckDone(LinkOperators::AllocateMatrix(areas, 3, "", Ranks(), dense), "a dense matrix");
  Check(dense && dense->GetNumberOfStoredTiles() == 10 && dense->GetNumberOfKernels() == 3,
    "a dense matrix");

  const Outcome outcome = LinkOperators::AllocateSparseMatrix(areas, TooMany, Ranks(), refused);
  Check(outcome.HasFailed(), "too many tiles");
  const std::string message = outcome.GetMessage();
  for (const char* part : { "1000 patches", "288230376.15 GB of memory", "are free",
         "LinkMethod to Hierarchical", "TargetEdgeLength", "more machines" })
  {
    Check(message.find(part) != std::string::npos, std::string(part) + " in: " + message);
  }
}

//------------------------------------------------------------------------------
// One rank that cannot is enough for all of them to refuse, with the same words.
void TestSeveralRanks()
{
  constexpr int ranks = 3;
  const std::vector<double> areas(1000, 1.0);
  std::string messages[ranks];
  vtkIdType tiles[ranks] = {};
  bool refused[ranks] = {};
  RunRanks(ranks,
    [&](vtkMultiProcessController* controller, int rank)
    {
      Matrix part, none;
      const Ranks all(controller);
      CheckDone(LinkOperators::AllocateSparseMatrix(areas, 4, all, part), "part of a matrix");
      tiles[rank] = part ? static_cast<vtkIdType>(part->GetTiles().size()) : 0;
      const Outcome outcome =
        LinkOperators::AllocateSparseMatrix(areas, rank == 1 ? TooMany : 4, all, none);
      refused[rank] = outcome.HasFailed();
      messages[rank] = outcome.GetMessage();
    });
  Check(tiles[0] == 4 && tiles[1] == 3 && tiles[2] == 3, "each rank has its part");
  Check(refused[0] && refused[1] && refused[2], "all ranks refuse");
  Check(messages[0].find("in one process") != std::string::npos && messages[0] == messages[1] &&
      messages[0] == messages[2],
    "the same message everywhere: " + messages[0]);
}
} // namespace

//------------------------------------------------------------------------------
int TestExchangeMemory(int, char*[])
{
  CheckClose(vtkExchangeMatrix::GetEstimatedSparseBytes(1000, 2, 7, 2),
    7 * 2 * 262144.0 + 5 * sizeof(vtkExchangeMatrix::Tile), 0.0, "bytes of a sparse matrix");
  TestOneRank();
  TestSeveralRanks();
  return Result();
}
