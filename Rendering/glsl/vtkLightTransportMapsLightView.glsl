// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// A camera in a light (LightView), and how far along its axis it sees.
uniform vec3 viewOrigin;
uniform vec3 viewRight;
uniform vec3 viewUp;
uniform vec3 viewAhead;
uniform vec4 frame;
uniform vec2 range;
uniform int isPerspective;

// In its own axes.
vec3 TurnToView(vec3 path)
{
  return vec3(dot(path, viewRight), dot(path, viewUp), dot(path, viewAhead));
}
