//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Hands what has become of a pair on to a geometry shader.
in vec4 entry;
in vec4 entryValue;
in vec4 entryDeviation2;

out vec4 pair;
out vec4 pairValue;
out vec4 pairDeviation2;

void main()
{
  pair = entry;
  pairValue = entryValue;
  pairDeviation2 = entryDeviation2;
}
