# Warnings, on for our own targets. VTK's headers come in as system headers.
add_library(lighttransport_warnings INTERFACE)
target_compile_options(lighttransport_warnings INTERFACE
  $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-Wall;-Wextra;-Wshadow;-Wnon-virtual-dtor;-Woverloaded-virtual>)
