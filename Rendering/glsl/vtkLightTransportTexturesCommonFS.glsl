//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#extension GL_ARB_explicit_attrib_location : enable
#extension GL_ARB_gpu_shader5 : enable

// GROUPS: textures per vector, four bands each. OUTPUTS: textures written. WIDTH_BITS: of the number of texels in a line. Products
// define more.
//VTK::LightTransport::Define

const int WIDTH = 1 << WIDTH_BITS;

ivec2 GetPlace(int texel)
{
  return ivec2(texel & (WIDTH - 1), texel >> WIDTH_BITS);
}

// Keeps the compiler from simplifying compensated sums away, where the context knows how.
#ifdef GL_ARB_gpu_shader5
#define EXACT precise
#else
#define EXACT
#endif

// Samplers may be indexed by constants alone, so loops over groups are written out by the preprocessor.
#if GROUPS > 1
#define GROUP_1(STEP) STEP(1)
#else
#define GROUP_1(STEP)
#endif
#if GROUPS > 2
#define GROUP_2(STEP) STEP(2)
#else
#define GROUP_2(STEP)
#endif
#if GROUPS > 3
#define GROUP_3(STEP) STEP(3)
#else
#define GROUP_3(STEP)
#endif
#if GROUPS > 4
#define GROUP_4(STEP) STEP(4)
#else
#define GROUP_4(STEP)
#endif
#if GROUPS > 5
#define GROUP_5(STEP) STEP(5)
#else
#define GROUP_5(STEP)
#endif
#if GROUPS > 6
#define GROUP_6(STEP) STEP(6)
#else
#define GROUP_6(STEP)
#endif
#if GROUPS > 7
#define GROUP_7(STEP) STEP(7)
#else
#define GROUP_7(STEP)
#endif
#define FOR_ALL_GROUPS(STEP) STEP(0) GROUP_1(STEP) GROUP_2(STEP) GROUP_3(STEP) GROUP_4(STEP) GROUP_5(STEP) GROUP_6(STEP) GROUP_7(STEP)

#ifdef GL_ARB_explicit_attrib_location
layout(location = 0) out vec4 result[OUTPUTS];
#else
out vec4 result[OUTPUTS];
#endif

// sum += value, with what rounding takes away collected in lost (Knuth's exact sum of two).
void AddCompensated(inout vec4 sum, inout vec4 lost, vec4 value)
{
  EXACT vec4 total = sum + value;
  EXACT vec4 added = total - sum;
  EXACT vec4 error = (sum - (total - added)) + (value - added);
  sum = total;
  lost += error;
}
