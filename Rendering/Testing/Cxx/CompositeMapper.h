// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The mapper that draws all blocks of composite data in one: VTK 9.3 has given it the shorter
/// name, which another one had before.
#ifndef CompositeMapper_h
#define CompositeMapper_h

#include "vtkVersion.h"

#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper2.h"
using CompositeMapper = vtkCompositePolyDataMapper2;
#else
#include "vtkCompositePolyDataMapper.h"
using CompositeMapper = vtkCompositePolyDataMapper;
#endif

#endif
