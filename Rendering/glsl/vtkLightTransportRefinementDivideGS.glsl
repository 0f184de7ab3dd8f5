//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The pairs that follow a pair (vtkLightTransportRefinementTestVS.glsl): with the children of its receiver, or of its sender.
// WIDTH_BITS: of the number of texels in a line. MOST_PAIRS that follow one.
//VTK::LightTransport::Define
layout(points) in;
layout(points, max_vertices = MOST_PAIRS) out;

uniform sampler2D children[1];
uniform int nodes;

in vec4 pair[];
in vec4 pairValue[];
in vec4 pairDeviation2[];

out vec4 follower; // receiver, sender, state

const int TAKE = 0;
const int DIVIDE_RECEIVER = 1;
const int TAKE_AND_DIVIDE = 3;
const float DIVIDED = 3.0;

void main()
{
  int action = int(pair[0].w);
  if (action == TAKE)
  {
    return;
  }
  bool isReceiver = action == DIVIDE_RECEIVER;
  int divided = int(isReceiver ? pair[0].x : pair[0].y);
  vec2 range = texelFetch(children[0], ivec2(divided & ((1 << WIDTH_BITS) - 1), divided >> WIDTH_BITS), 0).xy;
  for (float child = range.x; child < range.y; ++child)
  {
    follower = isReceiver ? vec4(child, pair[0].yz, 0.0) : vec4(pair[0].x, child, pair[0].z, 0.0);
    EmitVertex();
    EndPrimitive();
  }
  if (action == TAKE_AND_DIVIDE && int(pair[0].x) < nodes)
  {
    follower = vec4(pair[0].xy, DIVIDED, 0.0);
    EmitVertex();
    EndPrimitive();
  }
}
