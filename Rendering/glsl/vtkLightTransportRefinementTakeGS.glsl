//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What a pair has come to for a patch (vtkLightTransportRefinementTestVS.glsl), where it has.
layout(points) in;
layout(points, max_vertices = 1) out;

uniform int nodes;

in vec4 pair[];
in vec4 pairValue[];
in vec4 pairDeviation2[];

out vec4 part; // receiver, sender, what it is
out vec4 partValue;
out vec4 partDeviation2;

const int TAKE = 0;
const int TAKE_AND_DIVIDE = 3;
const float DIVIDED = 3.0;

void main()
{
  int action = int(pair[0].w);
  bool divides = action == TAKE_AND_DIVIDE && int(pair[0].x) >= nodes;
  if (action == TAKE || divides)
  {
    part = vec4(pair[0].xy, divides ? DIVIDED : pair[0].z, 0.0);
    partValue = pairValue[0];
    partDeviation2 = pairDeviation2[0];
    EmitVertex();
    EndPrimitive();
  }
}
