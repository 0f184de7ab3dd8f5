// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The mapper that draws all blocks of composite data in one: VTK 9.3 has given it the shorter
/// name, which another one had before, and VTK 9.6 has only that.
#ifndef CompositeMapper_h
#define CompositeMapper_h

#if __has_include("vtkCompositePolyDataMapper2.h")
#include "vtkCompositePolyDataMapper2.h"
using CompositeMapper = vtkCompositePolyDataMapper2;
#else
#include "vtkCompositePolyDataMapper.h"
using CompositeMapper = vtkCompositePolyDataMapper;
#endif

#endif
