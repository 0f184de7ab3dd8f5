// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * LT_CLONES before a function: one clone for each instruction set, from which GCC on x86-64 Linux
 * chooses when the library loads. LT_INLINE for what such a function calls, so that it belongs to
 * each clone. (Not under the thread sanitizer: the choice is made before its library is there.)
 */
#ifndef InstructionSets_h
#define InstructionSets_h

namespace LightTransport
{
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) &&   \
  !defined(__SANITIZE_THREAD__)
#define LT_CLONES __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#define LT_X86_CLONES 1
#else
#define LT_CLONES
#endif
#if defined(__GNUC__)
#define LT_INLINE inline __attribute__((always_inline))
#else
#define LT_INLINE inline
#endif
} // namespace LightTransport

#endif
