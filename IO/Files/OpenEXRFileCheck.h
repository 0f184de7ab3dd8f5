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
 * those numbers with the file's length first.
 */
#ifndef OpenEXRFileCheck_h
#define OpenEXRFileCheck_h

#include "Shared/Outcome.h"

#include <string>

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
  Unsupported
};

/// Fails with what is wrong first, of the kind `fault`.
Outcome Check(const std::string& fileName, Fault& fault);

/// Whether the file starts with OpenEXR's magic number.
bool HasMagicNumber(const std::string& fileName);
} // namespace OpenEXRFileCheck
} // namespace LightTransport

#endif
