# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
# Whole builds of other shapes: modules switched off, and the checkout inside a larger project. What is expensive to build is only
# configured.
set(configuration_options
  "-DVTK_DIR=${VTK_DIR}"
  "-DParaView_DIR=${ParaView_DIR}"
  "-DPython3_EXECUTABLE=${Python3_EXECUTABLE}"
  "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
  "-DCMAKE_C_COMPILER=${CMAKE_C_COMPILER}"
  "-DCMAKE_BUILD_TYPE=Debug"
  "-DCMAKE_CXX_FLAGS_DEBUG=-O0"
  "-DVTKLIGHTTRANSPORT_TEST_CONFIGURATIONS=OFF")
set(configurations "${CMAKE_CURRENT_BINARY_DIR}/Configurations")

# Configure, then build `TARGETS` (none: configure only) and run `TEST_COMMAND`.
function (lighttransport_add_configuration_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "SOURCE" "OPTIONS;TARGETS;TEST_COMMAND")
  set(build "${configurations}/${name}")
  add_test(NAME "Configure${name}"
    COMMAND "${CMAKE_COMMAND}" -S "${test_SOURCE}" -B "${build}" -G "${CMAKE_GENERATOR}"
      ${configuration_options} ${test_OPTIONS})
  set_tests_properties("Configure${name}" PROPERTIES FIXTURES_SETUP "Configured${name}")
  if (test_TARGETS)
    add_test(NAME "Build${name}" COMMAND "${CMAKE_COMMAND}" --build "${build}" --target ${test_TARGETS})
    set_tests_properties("Build${name}" PROPERTIES
      FIXTURES_REQUIRED "Configured${name}"
      FIXTURES_SETUP "Built${name}")
  endif ()
  if (test_TEST_COMMAND)
    add_test(NAME "Run${name}"
      COMMAND "${CMAKE_COMMAND}" -E env ${test_TEST_COMMAND}
      WORKING_DIRECTORY "${build}")
    set_tests_properties("Run${name}" PROPERTIES FIXTURES_REQUIRED "Built${name}")
  endif ()
endfunction ()

foreach (without IN ITEMS Meshing Rendering IO)
  string(TOUPPER "${without}" switch)
  lighttransport_add_configuration_test("Without${without}"
    SOURCE "${PROJECT_SOURCE_DIR}"
    OPTIONS "-DVTKLIGHTTRANSPORT_ENABLE_${switch}=OFF")
endforeach ()
lighttransport_add_configuration_test(WithoutWrapping
  SOURCE "${PROJECT_SOURCE_DIR}"
  OPTIONS -DVTKLIGHTTRANSPORT_WRAP_PYTHON=OFF -DVTKLIGHTTRANSPORT_BUILD_PARAVIEW_PLUGIN=OFF)

# The smallest combination is built and tested: one module, without the transport filters.
lighttransport_add_configuration_test(OnlyIO
  SOURCE "${PROJECT_SOURCE_DIR}"
  OPTIONS
    -DVTKLIGHTTRANSPORT_ENABLE_TRANSPORT=OFF
    -DVTKLIGHTTRANSPORT_ENABLE_MESHING=OFF
    -DVTKLIGHTTRANSPORT_ENABLE_RENDERING=OFF
    -DVTKLIGHTTRANSPORT_BUILD_PARAVIEW_PLUGIN=OFF
  TARGETS all
  TEST_COMMAND "${CMAKE_CTEST_COMMAND}" --output-on-failure --no-tests=error)

lighttransport_add_configuration_test(OuterProject
  SOURCE "${CMAKE_CURRENT_SOURCE_DIR}/OuterProject"
  OPTIONS "-DLIGHTTRANSPORT_SOURCE_DIR=${PROJECT_SOURCE_DIR}"
  TARGETS UmbrellaHeaders)
lighttransport_add_configuration_test(OuterProjectWithTransportOnly
  SOURCE "${CMAKE_CURRENT_SOURCE_DIR}/OuterProject"
  OPTIONS
    "-DLIGHTTRANSPORT_SOURCE_DIR=${PROJECT_SOURCE_DIR}"
    "-DREJECT_MODULES=LightTransport::vtkLightTransportMeshing$<SEMICOLON>LightTransport::vtkLightTransportRendering$<SEMICOLON>LightTransport::vtkLightTransportIO"
  TARGETS Furnace
  TEST_COMMAND "${configurations}/OuterProjectWithTransportOnly/bin/Furnace")

# Installed, then used by another project.
if (VTKLIGHTTRANSPORT_ENABLE_TRANSPORT)
  set(installation "${configurations}/Installation")
  add_test(NAME InstallPackage
    COMMAND "${CMAKE_COMMAND}" --install "${CMAKE_BINARY_DIR}" --prefix "${installation}")
  set_tests_properties(InstallPackage PROPERTIES FIXTURES_SETUP InstalledPackage)
  lighttransport_add_configuration_test(InstalledPackage
    SOURCE "${CMAKE_CURRENT_SOURCE_DIR}/InstalledPackage"
    OPTIONS "-DCMAKE_PREFIX_PATH=${installation}"
    TARGETS Furnace
    TEST_COMMAND "${configurations}/InstalledPackage/Furnace")
  set_tests_properties(ConfigureInstalledPackage PROPERTIES FIXTURES_REQUIRED InstalledPackage)
endif ()
