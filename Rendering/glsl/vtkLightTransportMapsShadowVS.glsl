// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces as a light sees them; see LightView.
//VTK::System::Dec
in vec3 position;
uniform mat4 toScene;
uniform vec3 viewOrigin;
uniform vec3 viewRight;
uniform vec3 viewUp;
uniform vec3 viewAhead;
uniform vec4 frame;
uniform vec2 range;
uniform int isPerspective;
out float depth;

void main()
{
  vec3 path = (toScene * vec4(position, 1.0)).xyz - viewOrigin;
  vec3 seen = vec3(dot(path, viewRight), dot(path, viewUp), dot(path, viewAhead));
  depth = (seen.z - range.x) / (range.y - range.x);
  // Of what is seen in perspective only that it is not too near matters: the fragment shader writes the depth.
  gl_Position = isPerspective != 0 ? vec4(seen.xy / frame.zw, seen.z - 2.0 * range.x, seen.z)
                                   : vec4((seen.xy - frame.xy) / frame.zw, 2.0 * depth - 1.0, 1.0);
}
