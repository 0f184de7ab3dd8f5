// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What texels are made of: position x area and area, normal x area and chart x area, of a sample.
in vec3 scenePosition;
flat in vec3 sceneNormal;
flat in vec2 shareOfAtlas;
uniform float weight;

void main()
{
  float area = weight * shareOfAtlas.x;
  result[0] = area * vec4(scenePosition, 1.0);
  result[1] = area * vec4(sceneNormal, shareOfAtlas.y);
}
