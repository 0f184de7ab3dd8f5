// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * View factors in a file. What is written is read back bit by bit; the tiles of the exchange matrix
 * that are not stored take no place in the file either.
 *
 * The format, in the byte order of the machine that writes, all counts 64 bits:
 *  - a line of 40 characters, "vtkLightTransport view factors" and the version, padded with blanks;
 *  - 0x0102030405060708, TileSize, fingerprint, tolerance, numbers of patches, summaries and tiles;
 *  - double precision, one per patch: areas, raw row sums, row sums, row errors, sky fractions,
 *    back face fractions, remainders of the diagonal (vtkExchangeMatrix::GetRemainders);
 *  - each summary: the length of its name, the name, the value;
 *  - each stored tile: row, column, TileSize x TileSize values in single precision, row by row; in
 *    the order of vtkExchangeMatrix::GetTiles;
 *  - a checksum of all that.
 */
#ifndef ViewFactorsFile_h
#define ViewFactorsFile_h

#include "ViewFactors/ViewFactorsResult.h"

#include <string>

namespace LightTransport
{
namespace ViewFactorsFile
{
/**
 * Write a whole result: a matrix of one kernel and one part, all arrays of rows complete, all
 * values finite. The file appears when it is complete; until then, and after an error, an older one
 * of that name stays as it was. Returns false with `error` naming the file, the problem and the
 * remedy.
 */
bool Write(const std::string& fileName, const ViewFactorsResult& result, std::string& error);

/**
 * Read a file of Write. Nothing in it is believed: a file that is cut short, damaged or made up
 * gives an error that names file, problem and remedy, no more memory is taken than there is, and
 * `result` stays as it was.
 */
bool Read(const std::string& fileName, ViewFactorsResult& result, std::string& error);
} // namespace ViewFactorsFile
} // namespace LightTransport

#endif
