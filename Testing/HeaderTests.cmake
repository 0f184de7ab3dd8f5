# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
# Each public header alone, included twice: it must bring all that it needs, and be guarded. Compiled when the test runs, not by
# the ordinary build.
set(header_sources)
set(header_modules)
foreach (module IN LISTS modules)
  string(REGEX REPLACE "^.*::" "" target "${module}")
  list(APPEND header_modules "${module}")
  get_property(folder TARGET "${target}" PROPERTY SOURCE_DIR)
  file(GLOB headers CONFIGURE_DEPENDS "${folder}/vtk*.h")
  foreach (header IN LISTS headers)
    get_filename_component(name "${header}" NAME)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/HeaderTests/${name}.cxx")
    file(GENERATE OUTPUT "${source}" CONTENT "#include \"${name}\"\n#include \"${name}\"\n")
    list(APPEND header_sources "${source}")
  endforeach ()
endforeach ()
add_library(HeaderTests OBJECT EXCLUDE_FROM_ALL ${header_sources})
target_link_libraries(HeaderTests PRIVATE ${header_modules})
target_compile_options(HeaderTests PRIVATE ${LIGHTTRANSPORT_WARNINGS})
target_compile_options(HeaderTests PRIVATE -O0 -Werror)
add_test(NAME PublicHeadersAreSelfContained
  COMMAND "${CMAKE_COMMAND}" --build "${CMAKE_BINARY_DIR}" --target HeaderTests)
set_tests_properties(PublicHeadersAreSelfContained PROPERTIES RESOURCE_LOCK build)
