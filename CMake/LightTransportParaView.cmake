# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
# Debian's ParaView since 5.13 says that its Python modules are vtkX.so, and the files are vtkX.cpython-313-x86_64-linux-gnu.so. CMake
# looks for each file that a package names, and refuses ParaView as a whole, and the VTK in it. A copy of the package's CMake files in
# the build folder, with the names that are there, becomes ParaView_DIR then. A ParaView that the caller has named is left alone.

# In `text`, the names of Python modules below `prefix` that are not there become those that are; `mended` tells whether there were any.
function (lighttransport_mend_module_names prefix text_variable mended_variable)
  set(text "${${text_variable}}")
  set(mended OFF)
  string(REGEX MATCHALL "_IMPORT_PREFIX}/[^\"]*/dist-packages/[^\"]*[.]so\"" names "${text}")
  list(REMOVE_DUPLICATES names)
  foreach (name IN LISTS names)
    string(REGEX REPLACE "^_IMPORT_PREFIX}(.*)[.]so\"$" "\\1" path "${name}")
    file(GLOB files "${prefix}${path}.cpython-*.so")
    if (files AND NOT EXISTS "${prefix}${path}.so")
      list(GET files 0 file)
      string(REPLACE "${prefix}" "_IMPORT_PREFIX}" file "${file}")
      string(REPLACE "${name}" "${file}\"" text "${text}")
      set(mended ON)
    endif ()
  endforeach ()
  set("${text_variable}" "${text}" PARENT_SCOPE)
  set("${mended_variable}" "${mended}" PARENT_SCOPE)
endfunction ()

# A copy of a folder of CMake files that were written to be read where they are.
function (lighttransport_mend_package prefix package copy)
  file(REMOVE_RECURSE "${copy}")
  file(COPY "${package}/" DESTINATION "${copy}")
  file(GLOB_RECURSE files RELATIVE "${copy}" "${copy}/*.cmake")
  foreach (file IN LISTS files)
    file(READ "${copy}/${file}" text)
    set(old "${text}")
    lighttransport_mend_module_names("${prefix}" text mended)
    get_filename_component(folder "${package}/${file}" DIRECTORY)
    string(REPLACE "get_filename_component(_IMPORT_PREFIX \"\${CMAKE_CURRENT_LIST_FILE}\" PATH)"
      "set(_IMPORT_PREFIX \"${folder}\")" text "${text}")
    string(REPLACE "set(_vtk_module_import_prefix \"\${CMAKE_CURRENT_LIST_DIR}\")"
      "set(_vtk_module_import_prefix \"${folder}\")" text "${text}")
    if (NOT text STREQUAL old)
      file(WRITE "${copy}/${file}" "${text}")
    endif ()
  endforeach ()
endfunction ()

# The folder of the copy, if there is one.
set(mended_paraview "${CMAKE_BINARY_DIR}/ParaViewPackage")
set(others "${ParaView_ROOT}")
if (NOT ParaView_DIR STREQUAL mended_paraview)
  list(APPEND others "${ParaView_DIR}")
endif ()
foreach (prefix IN LISTS CMAKE_PREFIX_PATH)
  file(GLOB found "${prefix}/lib*/cmake/paraview-*")
  list(APPEND others ${found})
endforeach ()
if (NOT others)
  file(GLOB targets "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-*/ParaViewPython-targets-*.cmake")
  foreach (file IN LISTS targets)
    file(READ "${file}" text)
    lighttransport_mend_module_names(/usr text mended)
    if (mended)
      get_filename_component(package "${file}" DIRECTORY)
      lighttransport_mend_package(/usr "${package}" "${mended_paraview}")
      set(ParaView_DIR "${mended_paraview}" CACHE PATH "The CMake package of ParaView" FORCE)
    endif ()
  endforeach ()
endif ()
