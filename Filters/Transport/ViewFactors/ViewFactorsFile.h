// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * View factors of all pairs in a file (those from rays: RayHitsFile). What is written is read back
 * bit by bit; the tiles of the exchange matrix that are not stored take no place in the file
 * either.
 *
 * The format (CheckedFile):
 *  - "vtkLightTransport view factors", TileSize, fingerprint, tolerance, numbers of patches,
 *    summaries and tiles;
 *  - double precision, one per patch: areas, raw row sums, row sums, row errors, sky fractions,
 *    back face fractions, errors of the fractions, numbers of rays that met fronts and backs,
 *    remainders of the diagonal (vtkExchangeMatrix::GetRemainders);
 *  - each summary: the length of its name, the name, the value;
 *  - each stored tile: row, column, TileSize x TileSize values in single precision, row by row; in
 *    the order of vtkExchangeMatrix::GetTiles.
 */
#ifndef ViewFactorsFile_h
#define ViewFactorsFile_h

#include "Shared/Outcome.h"

#include <string>

namespace LightTransport
{
struct Links;

namespace ViewFactorsFile
{
/**
 * Write links that are whole: a matrix of one kernel and one part, all arrays of rows complete, all
 * values finite. The file appears when it is complete; until then, and after an error, an older one
 * of that name stays as it was.
 */
Outcome Write(const std::string& fileName, const Links& links);

/**
 * Read a file of Write. Nothing in it is believed: a file that is cut short, damaged or made up
 * fails, no more memory is taken than there is, and `links` stays as it was.
 */
Outcome Read(const std::string& fileName, Links& links);
} // namespace ViewFactorsFile
} // namespace LightTransport

#endif
