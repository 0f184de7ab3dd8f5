# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
# What Python's tools want to know of the package: types of all classes for editors, and the entry points. Uses what
# Python/CMakeLists.txt has set. A wheel gets its metadata from pyproject.toml.
set(package_destination "${VTKLIGHTTRANSPORT_PYTHON_DESTINATION}/vtklighttransport")

# VTK's own generator loads the modules, so that it needs the VTK that they are built against.
set(stub_modules)
set(stubs "${package_directory}/__init__.pyi" "${package_directory}/py.typed")
set(stub_imports)
foreach (module IN LISTS modules)
  string(REGEX REPLACE ".*::" "" library "${module}")
  list(APPEND stub_modules "${library}")
  list(APPEND stub_targets "${library}Python")
  list(APPEND stubs "${package_directory}/${library}.pyi")
  string(APPEND stub_imports "from .${library} import *\n")
endforeach ()
file(WRITE "${package_directory}/py.typed" "")
configure_file("${CMAKE_CURRENT_SOURCE_DIR}/vtklighttransport/__init__.pyi.in" "${package_directory}/__init__.pyi" @ONLY)

# pip's isolated environments put themselves before the system's packages by PYTHONPATH.
set(plain_python "${CMAKE_COMMAND}" -E env "PYTHONPATH=${CMAKE_BINARY_DIR}/${VTKLIGHTTRANSPORT_PYTHON_DESTINATION}"
  "${Python3_EXECUTABLE}")
execute_process(
  COMMAND ${plain_python} -c
    "import vtkmodules.generate_pyi; from vtkmodules.vtkCommonCore import vtkVersion; print(vtkVersion.GetVTKVersion())"
  OUTPUT_VARIABLE python_vtk_version
  OUTPUT_STRIP_TRAILING_WHITESPACE
  ERROR_QUIET)
if (python_vtk_version STREQUAL VTK_VERSION)
  add_custom_command(
    OUTPUT "${package_directory}/stubs.stamp"
    COMMAND ${plain_python} -B -m vtkmodules.generate_pyi -p vtklighttransport -o "${package_directory}" ${stub_modules}
    COMMAND "${CMAKE_COMMAND}" -E touch "${package_directory}/stubs.stamp"
    DEPENDS ${stub_targets}
    COMMENT "Types of the wrapped classes"
    VERBATIM)
  add_custom_target(vtkLightTransportStubs ALL DEPENDS "${package_directory}/stubs.stamp")
  install(FILES ${stubs} DESTINATION "${package_destination}")
elseif (python_vtk_version)
  message(WARNING
    "Python finds VTK ${python_vtk_version}, and the package is built against VTK ${VTK_VERSION}: it would refuse to be "
    "loaded beside the other one. Set VTK_DIR to the VTK of this Python, or Python3_EXECUTABLE to the Python of this VTK.")
else ()
  message(STATUS "Python finds no VTK: types of the wrapped classes (.pyi) are left out")
endif ()

if (NOT SKBUILD)
  # As a wheel would be installed, so that PyVista and pip find the package.
  set(distribution vtklighttransport)
  set(distribution_license BSD-3-Clause)
  if (VTKLIGHTTRANSPORT_ENABLE_MESHING)
    set(distribution vtklighttransport-gpl)
    set(distribution_license GPL-3.0-or-later)
  endif ()
  string(REPLACE "-" "_" metadata_name "${distribution}")
  set(metadata_folder "${VTKLIGHTTRANSPORT_PYTHON_DESTINATION}/${metadata_name}-${PROJECT_VERSION}.dist-info")
  file(WRITE "${CMAKE_BINARY_DIR}/${metadata_folder}/METADATA"
    "Metadata-Version: 2.1\nName: ${distribution}\nVersion: ${PROJECT_VERSION}\nLicense: ${distribution_license}\n")
  file(WRITE "${CMAKE_BINARY_DIR}/${metadata_folder}/INSTALLER" "CMake\n")
  file(STRINGS "${PROJECT_SOURCE_DIR}/pyproject.toml" accessor REGEX "^light_transport = ")
  string(REPLACE "\"" "" accessor "${accessor}")
  file(WRITE "${CMAKE_BINARY_DIR}/${metadata_folder}/entry_points.txt" "[pyvista.accessors]\n${accessor}\n")
  install(
    DIRECTORY "${CMAKE_BINARY_DIR}/${metadata_folder}"
    DESTINATION "${VTKLIGHTTRANSPORT_PYTHON_DESTINATION}")
endif ()
