// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What is said of a scene: closed, open, with a leak or inside out, which polygons make it so, how
// large the opening is (all that leaves a convex room with a hole leaves by the hole: its area is
// known), what looks wrong with temperatures, and where a tolerance is not reached.
#include "MessageLog.h"
#include "ViewFactorTesting.h"
#include "vtkFieldData.h"
#include "vtkRadiosity.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkViewFactors.h"

#include <algorithm>

using namespace LightTransportTesting;

namespace
{
constexpr int MostlyBackFaces = 1;
constexpr int Leak = 2;
constexpr int ToleranceNotReached = 16;

//------------------------------------------------------------------------------
// Floor, lid (with a square hole of size `hole` in the middle, 1 for no lid), walls; n x n each.
vtkSmartPointer<vtkPolyData> MakeBox(double hole, bool isFloorTurned = false)
{
  constexpr int n = 3;
  Surface box;
  isFloorTurned ? box.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, n, n)
                : box.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
  box.AddGrid({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, n, n);
  box.AddGrid({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, n, n);
  box.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, n, n);
  box.AddGrid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, n, n);
  const double low = 0.5 * (1.0 - hole);
  const double high = 0.5 * (1.0 + hole);
  if (hole == 0.0)
  {
    box.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, n, n);
  }
  else if (hole < 1.0)
  {
    box.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { low, 0, 0 }, n, 1);
    box.AddGrid({ high, 0, 1 }, { 0, 1, 0 }, { 1.0 - high, 0, 0 }, n, 1);
    box.AddGrid({ low, 0, 1 }, { 0, low, 0 }, { hole, 0, 0 }, 1, 1);
    box.AddGrid({ low, high, 1 }, { 0, 1.0 - high, 0 }, { hole, 0, 0 }, 1, 1);
  }
  return box.Get();
}

//------------------------------------------------------------------------------
// Turned, in any size and place, with coordinates in single precision.
vtkSmartPointer<vtkPolyData> Place(vtkPolyData* data, double size, double offset)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(offset, 0.5 * offset, -0.2 * offset);
  transform->RotateWXYZ(37.0, 0.3, 0.5, 0.8);
  transform->Scale(size, size, size);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(data);
  filter->SetTransform(transform);
  filter->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  filter->Update();
  return filter->GetOutput();
}

//------------------------------------------------------------------------------
struct Verdict
{
  std::string Name;
  std::string Messages;
  double IsClosed, LeakArea;
  std::vector<int> Problems;

  explicit Verdict(vtkViewFactors* factors)
  {
    vtkNew<MessageLog> log;
    factors->AddObserver(vtkCommand::WarningEvent, log);
    factors->Update();
    this->Read(factors->GetPolyDataOutput(), log->GetAll());
  }
  explicit Verdict(vtkRadiosity* radiosity)
  {
    vtkNew<MessageLog> log;
    radiosity->AddObserver(vtkCommand::WarningEvent, log);
    radiosity->Update();
    this->Read(radiosity->GetPolyDataOutput(), log->GetAll());
  }
  void Read(vtkPolyData* output, const std::string& messages)
  {
    vtkAbstractArray* name = output->GetFieldData()->GetAbstractArray("EnclosureVerdict");
    this->Name = name ? std::string(name->GetVariantValue(0).ToString()) : "";
    this->IsClosed = GetSummary(output, "IsClosed");
    this->LeakArea = GetSummary(output, "LeakArea");
    vtkDataArray* problems = output->GetCellData()->GetArray("SceneProblems");
    for (vtkIdType cell = 0; problems && cell < problems->GetNumberOfTuples(); ++cell)
    {
      this->Problems.push_back(static_cast<int>(problems->GetComponent(cell, 0)));
    }
    this->Messages = messages;
  }
  bool Says(const char* text) const { return this->Messages.find(text) != std::string::npos; }
  int CountFlagged(int flag) const
  {
    return static_cast<int>(std::count_if(this->Problems.begin(), this->Problems.end(),
      [flag](int problems) { return problems & flag; }));
  }
};

//------------------------------------------------------------------------------
Verdict JudgeFactors(vtkPolyData* data, bool hierarchical = false)
{
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(data);
  factors->SetHierarchical(hierarchical);
  return Verdict(factors.Get());
}

//------------------------------------------------------------------------------
void TestOpenings()
{
  for (const double size : { 1e-6, 1.0, 1e6 })
  {
    for (const double offset : { 0.0, 100.0 * size })
    {
      for (const bool hierarchical : { false, true })
      {
        const std::string what = hierarchical ? " by clusters" : " by pairs";
        const double area = size * size;
        const Verdict closed = JudgeFactors(Place(MakeBox(0.0), size, offset), hierarchical);
        Check(closed.Name == "Closed" && closed.IsClosed == 1.0 && closed.LeakArea == 0.0 &&
            closed.Messages.empty() && closed.CountFlagged(~0) == 0,
          "a closed box" + what + closed.Messages);
        const Verdict open = JudgeFactors(Place(MakeBox(1.0), size, offset), hierarchical);
        Check(open.Name == "Open" && open.IsClosed == 0.0, "a box without a lid" + what);
        CheckClose(open.LeakArea, area, 0.02, "the area of the lid" + what);
        const Verdict leaking = JudgeFactors(Place(MakeBox(0.2), size, offset), hierarchical);
        Check(leaking.Name == "Leaking" && leaking.IsClosed == 0.0 && leaking.Says("has a leak"),
          "a box with a hole" + what);
        CheckClose(leaking.LeakArea, 0.04 * area, 0.1, "the area of the hole" + what);
        const int flagged = leaking.CountFlagged(Leak);
        // What is opposite of the hole or beside it, not the room.
        Check(flagged > 0 && 4 * flagged < static_cast<int>(leaking.Problems.size()),
          "those that see most of the hole" + what);
      }
    }
  }
}

//------------------------------------------------------------------------------
void TestNormals()
{
  const Verdict turned = JudgeFactors(MakeBox(0.0, true));
  Check(turned.Name == "InsideOut" && turned.Says("FlipNormals"), "a floor upside down");
  for (std::size_t cell = 0; cell < turned.Problems.size(); ++cell)
  {
    const bool isFlagged = turned.Problems[cell] & MostlyBackFaces;
    Check(isFlagged == (cell < 9), "the floor, and nothing else, is flagged");
  }
  Surface outwards;
  AddBox(outwards, { 0, 0, 0 }, { 1, 1, 1 }, 0.5, false);
  const Verdict all = JudgeFactors(outwards.Get());
  Check(all.Name == "InsideOut" && all.Says("No polygon sees any other"), "a box inside out");
  Surface plate;
  plate.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  const Verdict one = JudgeFactors(plate.Get());
  Check(one.Name == "Open" && one.Messages.empty(), "one patch: " + one.Messages);
  CheckClose(one.LeakArea, 1.0, 1e-12, "of one patch everything leaves");
}

//------------------------------------------------------------------------------
Verdict JudgeHeat(vtkPolyData* data, double temperature, double background)
{
  AddArray(data, "Temperature", { temperature });
  AddArray(data, "Emissivity", { 0.9 });
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputData(data);
  radiosity->SetBackgroundTemperature(background);
  return Verdict(radiosity.Get());
}

//------------------------------------------------------------------------------
void TestHeat()
{
  const Verdict good = JudgeHeat(MakeBox(0.0), 300.0, 0.0);
  Check(good.Name == "Closed" && good.Messages.empty(), "a warm room: " + good.Messages);
  const Verdict celsius = JudgeHeat(MakeBox(0.0), 20.0, 0.0);
  Check(celsius.Says("degrees Celsius"), "20 degrees: " + celsius.Messages);
  const Verdict cold = JudgeHeat(MakeBox(1.0), 300.0, 0.0);
  Check(cold.Says("a sky at 0 K"), "an open room in the cold: " + cold.Messages);
  const Verdict warm = JudgeHeat(MakeBox(1.0), 300.0, 300.0);
  Check(warm.Name == "Open" && !warm.Says("0 K"), "an open room in the warm: " + warm.Messages);
  const Verdict turned = JudgeHeat(MakeBox(0.0, true), 300.0, 0.0);
  Check(turned.Name == "InsideOut" && turned.Says("NetPower"), "a balance: " + turned.Messages);
  Surface outwards;
  AddBox(outwards, { 0, 0, 0 }, { 1, 1, 1 }, 0.5, false);
  const Verdict body = JudgeHeat(outwards.Get(), 350.0, 300.0);
  Check(body.Says("right for a body") && !body.Says("NetPower"), "a hot box: " + body.Messages);
}

//------------------------------------------------------------------------------
// Many small plates between two large ones, and a tolerance that no work reaches.
void TestTolerance()
{
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  surface.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  for (int k = 0; k < 25; ++k)
  {
    const double x = 0.2 * (k % 5) + 0.03, y = 0.2 * (k / 5) + 0.05, z = 0.3 + 0.016 * k;
    surface.AddPolygon({ { x, y, z }, { x + 0.11, y + 0.02, z }, { x + 0.07, y + 0.12, z } });
    surface.AddPolygon({ { x, y, z }, { x + 0.07, y + 0.12, z }, { x + 0.11, y + 0.02, z } });
  }
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(surface.Get());
  factors->SetTolerance(1e-9);
  const Verdict verdict(factors.Get());
  Check(verdict.CountFlagged(ToleranceNotReached) >= 2 &&
      verdict.Says("do not reach the tolerance"),
    "a tolerance that is not reached: " + verdict.Messages);
}
} // namespace

//------------------------------------------------------------------------------
int TestEnclosureVerdict(int, char*[])
{
  TestOpenings();
  TestNormals();
  TestHeat();
  TestTolerance();
  return Result();
}
