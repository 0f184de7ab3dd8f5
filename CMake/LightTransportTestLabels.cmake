# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
# Labels of tests, for ctest -L and -LE: what a test needs (gl: OpenGL, python, paraview) is said where its folder ends; whether
# it is slow (some ten seconds or more on two busy cores) or fast, here.
set(LIGHTTRANSPORT_SLOW_TESTS
  "Build(Benchmarks|OnlyIO|OuterProjectWithTransportOnly)"
  PublicHeadersAreSelfContained
  RunOnlyIO
  TestHostileInput
  TestLinkRefinement
  "TestOpenGLShooter(-OSMesa)?"
  "TestParallel-.*"
  TestPatchMesherSizing
  TestPipeline
  TestReport
  TestSurfacesInOnePlace
  "TestViewFactor(Catalogue|Estimate|Properties)")
# Tests that need OpenGL in folders where the others do not.
set(LIGHTTRANSPORT_GL_TESTS "Gallery-.*" "Panel-.*" TestPluginAlone TestReport)
foreach (list IN ITEMS LIGHTTRANSPORT_SLOW_TESTS LIGHTTRANSPORT_GL_TESTS)
  string(REPLACE ";" "|" ${list} "(^|-)(${${list}})$")
endforeach ()

# Labels all tests of the folder that calls; the arguments are what they need.
function (lighttransport_label_tests)
  get_property(tests DIRECTORY PROPERTY TESTS)
  foreach (test IN LISTS tests)
    set(speed fast)
    if (test MATCHES "${LIGHTTRANSPORT_SLOW_TESTS}")
      set(speed slow)
    endif ()
    set(needs ${ARGN})
    if (test MATCHES "${LIGHTTRANSPORT_GL_TESTS}")
      list(APPEND needs gl)
    endif ()
    set_property(TEST "${test}" APPEND PROPERTY LABELS "${speed}" ${needs})
  endforeach ()
endfunction ()
