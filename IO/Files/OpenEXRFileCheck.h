// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file OpenEXRFileCheck.h
 * @brief whether an OpenEXR file can hold what its header promises, found out without allocating
 * anything for it
 *
 * OpenEXR allocates attribute values, offset tables, line and tile buffers from numbers in the
 * header before it looks for the data. A small damaged or hostile file can so ask for gigabytes.
 * This walk over the header (the layout is in OpenEXR's "File Layout" document) compares each of
 * those numbers with the file's length first. Every attribute must have the size of its type: the
 * library reads on behind the value and not behind the size, and would find other attributes there.
 */
#ifndef OpenEXRFileCheck_h
#define OpenEXRFileCheck_h

#include "Shared/Outcome.h"

#include <string>
#include <vector>

namespace LightTransport
{
namespace OpenEXRFileCheck
{
/// What keeps the file from being read.
enum class Fault
{
  None,
  CannotOpen,
  NotOpenEXR,
  Truncated,
  Damaged,
  Unsupported,
  TooLarge,
  NoSuchPart
};

/// What is to be read, and the bytes that it may take.
struct Wish
{
  int Part = 0;
  int Level = 0;
  double MemoryLimit = 0.0;
};

/// What was found.
struct Findings
{
  Fault Kind = Fault::None;
  /// Empty for a part without a name; as many as parts, where the headers are sound.
  std::vector<std::string> PartNames;
};

/// Fails with what is wrong first, of the kind in `findings`.
Outcome Check(const std::string& fileName, const Wish& wish, Findings& findings);

/// Whether the file starts with OpenEXR's magic number.
bool HasMagicNumber(const std::string& fileName);
} // namespace OpenEXRFileCheck
} // namespace LightTransport

#endif
