// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The scenes of ViewFactorsBenchmark and RadiosityScaleBenchmark.
#ifndef ViewFactorScenes_h
#define ViewFactorScenes_h

#include "ViewFactorTesting.h"

namespace ViewFactorBenchmark
{
/// Which run a case belongs to; each includes the ones before.
enum Set
{
  QUICK,
  STANDARD,
  ALL
};

/// What is known of the factors between two groups of patches.
struct ExactFactor
{
  std::string Name;
  LightTransportTesting::Group From;
  LightTransportTesting::Group To;
  double Value;
};

struct Scene
{
  std::string Text;
  vtkSmartPointer<vtkPolyData> Data;
  /// Patches whose rows sum to 1.
  LightTransportTesting::Group Closed;
  std::vector<ExactFactor> Factors;
};

struct Case
{
  std::string Name;
  Set FirstSet;
  std::vector<double> Tolerances;
  std::function<Scene()> Make;
};

/// Values of the cell array "Part" of the furnished room.
enum RoomPart
{
  ROOM_WALLS, ///< with the floor and the ceiling
  ROOM_TABLE_AND_CHAIRS,
  ROOM_SHELF,
  ROOM_LAMP, ///< over the table
  ROOM_STANDING_LAMP
};

/// Height of its ceiling; the floor is at 0.
constexpr double RoomHeight = 2.6;

/**
 * A furnished room of rectangles with edges of at most `length` metres. All boxes are apart from
 * each other by at least half a centimetre (glides under the legs, joints), so that the scene is
 * closed and every row sums to 1.
 */
Scene MakeFurnishedRoom(double length);

#ifdef LIGHTTRANSPORT_HAS_MESHING
/// The Cornell box, meshed.
Scene MakeCornellBox(double length);
#endif

/// All cases, in the order in which they run; those of the dragon where its PLY file is given.
std::vector<Case> GetCases(const std::string& dragon);
} // namespace ViewFactorBenchmark

#endif
