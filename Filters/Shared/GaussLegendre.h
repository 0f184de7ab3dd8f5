// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Nodes and weights of the Gauss-Legendre rules on [0, 1].
 */
#ifndef GaussLegendre_h
#define GaussLegendre_h

#include "vtkMath.h"

#include <cmath>
#include <vector>

namespace LightTransport
{
struct GaussLegendre
{
  std::vector<double> Nodes;
  std::vector<double> Weights;

  explicit GaussLegendre(int points) : Nodes(points), Weights(points)
  {
    for (int i = 0; i < points; ++i)
    {
      double x = std::cos(vtkMath::Pi() * (i + 0.75) / (points + 0.5));
      double slope = 1.0;
      for (int iteration = 0; iteration < 100; ++iteration)
      {
        double previous = 1.0;
        double value = x;
        for (int degree = 2; degree <= points; ++degree)
        {
          const double next = ((2 * degree - 1) * x * value - (degree - 1) * previous) / degree;
          previous = value;
          value = next;
        }
        slope = points * (x * value - previous) / (x * x - 1.0);
        const double step = value / slope;
        x -= step;
        if (std::abs(step) < 1e-15)
        {
          break;
        }
      }
      this->Nodes[i] = 0.5 * (1.0 - x);
      this->Weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
  }
};
} // namespace LightTransport

#endif
