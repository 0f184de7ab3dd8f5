// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * View factors from rays in a file: what the rays have met, of which links, their sums and errors
 * are made again, bit by bit, in a fraction of the time. It takes four bytes a ray, less than the
 * links; and since no rank needs more than the rays of its own patches, any number of ranks can
 * write it or read it.
 *
 * The format (CheckedFile):
 *  - "vtkLightTransport view factor rays", fingerprint of the scene, numbers of patches and of the
 *    rays of each;
 *  - each patch: what its rays have met (PatchRays::Hit), 32 bits each.
 */
#ifndef RayHitsFile_h
#define RayHitsFile_h

#include "Shared/Outcome.h"
#include "vtkType.h"

#include <string>

namespace LightTransport
{
class RayHits;
class Ranks;

namespace RayHitsFile
{
/// The first rays of each patch, of all ranks. The file appears when it is complete, as that of
/// ViewFactorsFile. Collective; the first rank writes.
Outcome Write(const std::string& fileName, const RayHits& hits, vtkIdType numberOfPatches,
  int raysPerPatch, const Ranks& ranks);

/// Whether a file, which need not be there, says that it is one of these.
bool Is(const std::string& fileName);

/// Read a file of Write: each rank those of its patches. Nothing in it is believed: a file that is
/// cut short, damaged or made up fails, no more memory is taken than there is, and `hits` and
/// `raysPerPatch` stay as they were. Collective.
Outcome Read(const std::string& fileName, const Ranks& ranks, RayHits& hits, int& raysPerPatch);
} // namespace RayHitsFile
} // namespace LightTransport

#endif
