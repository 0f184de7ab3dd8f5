# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
# How the modules and their tests are compiled in a build of their own; a larger build that takes the modules in has its own choice.

# Warnings, on for the code of the modules (not for what is generated to wrap it).
set(LIGHTTRANSPORT_WARNINGS)
if (CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  set(LIGHTTRANSPORT_WARNINGS -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual)
endif ()

# A second build of the same is quick where ccache is there. What its manual asks for precompiled headers is in the environment.
find_program(CCACHE_EXECUTABLE ccache)
mark_as_advanced(CCACHE_EXECUTABLE)
if (CCACHE_EXECUTABLE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER AND NOT DEFINED CMAKE_C_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
    "CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime" "${CCACHE_EXECUTABLE}")
  set(CMAKE_C_COMPILER_LAUNCHER "${CCACHE_EXECUTABLE}")
endif ()
