// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Fraction of unpolarised light that a smooth boundary of a relative index reflects, seen from outside at this cosine.
float LightTransportFresnel(float cosine, float index)
{
  float inside = sqrt(max(index * index - 1.0 + cosine * cosine, 0.0));
  float parallel = (index * index * cosine - inside) / max(index * index * cosine + inside, 1e-9);
  float perpendicular = (cosine - inside) / max(cosine + inside, 1e-9);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}
