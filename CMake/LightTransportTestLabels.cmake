# Labels of tests, for ctest -L and -LE: what a test needs (gl: OpenGL, python, paraview) is said where its folder ends; whether
# it is slow (some ten seconds or more on two busy cores) or fast, here.
set(LIGHTTRANSPORT_SLOW_TESTS
  "Build(Benchmarks|OnlyIO|OuterProjectWithTransportOnly)"
  PublicHeadersAreSelfContained
  RunOnlyIO
  TestAtlasTree
  TestHierarchicalRadiosity
  TestLinkRefinement
  TestOpenGLShooter
  TestOpenGLShooter-OSMesa
  "TestPatchMesherMeshes-(cheese|dragon_vrip_res3|mannequin-devil)"
  "TestSurfaceAtlas-(dragon_vrip_res3|mannequin-devil|turbine)"
  "TestSurfaceAtlasShapes-(Handles|Open|Thin)"
  "TestParallel-.*"
  TestPipeline
  TestReport)
string(REPLACE ";" "|" LIGHTTRANSPORT_SLOW_TESTS "(^|-)(${LIGHTTRANSPORT_SLOW_TESTS})$")

# Labels all tests of the folder that calls; the arguments are what they need.
function (lighttransport_label_tests)
  get_property(tests DIRECTORY PROPERTY TESTS)
  foreach (test IN LISTS tests)
    set(speed fast)
    if (test MATCHES "${LIGHTTRANSPORT_SLOW_TESTS}")
      set(speed slow)
    endif ()
    set_property(TEST "${test}" APPEND PROPERTY LABELS "${speed}" ${ARGN})
  endforeach ()
endfunction ()
