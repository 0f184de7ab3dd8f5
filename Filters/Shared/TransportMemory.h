// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How much memory is there, asked before it is taken: a system that overcommits grants any amount
 * and ends the process later.
 */
#ifndef TransportMemory_h
#define TransportMemory_h

#include <vtksys/SystemInformation.hxx>

#include <cstddef>
#include <iomanip>
#include <new>
#include <sstream>
#include <string>

namespace LightTransport
{
namespace TransportMemory
{
/// Bytes for all the small things of an output: names, attributes, tables. VTK's containers are not
/// fit for use any more where one of those is refused.
constexpr double Margin = 1048576.0;

/// Bytes of main memory that nobody uses.
inline double GetAvailableBytes()
{
  vtksys::SystemInformation system;
  system.RunMemoryCheck();
  return 1024.0 * 1024.0 * static_cast<double>(system.GetAvailablePhysicalMemory());
}

/// Whether the limits of this process leave so many bytes, which shows only when they are asked
/// for. Nothing is kept.
inline bool IsWithinLimits(double bytes)
{
  // Volatile, so that no compiler leaves it out.
  char* volatile probe = new (std::nothrow) char[static_cast<std::size_t>(bytes) + 1];
  const bool granted = probe != nullptr;
  delete[] probe;
  return granted;
}

/// Whether so many bytes are there, in the system and within the limits of this process.
inline bool CanAllocate(double bytes)
{
  return bytes <= GetAvailableBytes() && IsWithinLimits(bytes);
}

/// Throws std::bad_alloc where so many bytes are not there. For what VTK allocates: some of its
/// builds end the process where they get nothing, so that it is asked for here just before.
inline void Require(double bytes)
{
  if (!CanAllocate(bytes + Margin))
  {
    throw std::bad_alloc();
  }
}

/// The same where nothing large is to come.
inline void RequireMargin()
{
  Require(0.0);
}

/// A number of bytes for messages.
inline std::string Format(double bytes)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << bytes / 1e9 << " GB";
  return text.str();
}
} // namespace TransportMemory
} // namespace LightTransport

#endif
