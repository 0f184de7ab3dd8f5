// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Surfaces that fell into pieces: most of their triangles have no neighbours.
#ifndef LooseTriangles_h
#define LooseTriangles_h

#include "Common/TriangleSoup.h"
#include "Mesher/SideJoiner.h"

#include <string>

namespace LightTransport
{
namespace LooseTriangles
{
/// A sentence that says so, with the tolerance that may help; empty where there are few.
std::string Describe(const TriangleSoup& soup, const SideJoiner& joiner);
} // namespace LooseTriangles
} // namespace LightTransport

#endif
