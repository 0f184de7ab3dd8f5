// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The power that the seen patch receives, in every band.
uniform sampler2D unshot[GROUPS];
flat in ivec2 shooter;
flat in float share;

void main()
{
#define STORE(g) result[g] = share * texelFetch(unshot[g], shooter, 0);
  FOR_ALL_GROUPS(STORE)
}
