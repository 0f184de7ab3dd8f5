# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
# The private sources of a module, those in the folders `ROOMS`, as one object library <library>Objects. The module and its tests both
# link it, so that tests reach private classes although no symbol of theirs is exported. (A test's process then holds that code twice:
# it must not keep static state.) A new file in a room needs no line here: ROOMS are looked through again before each build.
function (lighttransport_add_objects library)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ROOMS;SOURCES;INCLUDES;LINKS")
  set(patterns)
  foreach (room IN LISTS arg_ROOMS)
    list(APPEND patterns "${CMAKE_CURRENT_SOURCE_DIR}/${room}/*.cxx" "${CMAKE_CURRENT_SOURCE_DIR}/${room}/*.h")
  endforeach ()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  add_library("${library}Objects" OBJECT ${sources} ${arg_SOURCES})
  set_target_properties("${library}Objects" PROPERTIES
    POSITION_INDEPENDENT_CODE ON
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  target_compile_features("${library}Objects" PUBLIC cxx_std_17)
  target_compile_definitions("${library}Objects" PRIVATE "${library}_EXPORTS")
  target_compile_options("${library}Objects" PRIVATE ${LIGHTTRANSPORT_WARNINGS})
  # Includes say the room: "Scene/PatchScene.h".
  target_include_directories("${library}Objects"
    PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}" ${arg_INCLUDES})
  target_link_libraries("${library}Objects" PUBLIC ${arg_LINKS})
endfunction ()
