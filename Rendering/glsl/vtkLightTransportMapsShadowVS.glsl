// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces as a light sees them.
//VTK::System::Dec
//VTK::LightTransport::View
in vec3 position;
uniform mat4 toScene;
out float depth;

void main()
{
  vec3 seen = TurnToView((toScene * vec4(position, 1.0)).xyz - viewOrigin);
  depth = (seen.z - range.x) / (range.y - range.x);
  // Of what is seen in perspective only that it is not too near matters: the fragment shader writes the depth.
  gl_Position = isPerspective != 0 ? vec4(seen.xy / frame.zw, seen.z - 2.0 * range.x, seen.z)
                                   : vec4((seen.xy - frame.xy) / frame.zw, 2.0 * depth - 1.0, 1.0);
}
