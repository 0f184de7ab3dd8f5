# Warnings, on for the code of the modules (not for what is generated to wrap it). A larger build that takes the modules in has its
# own choice.
set(LIGHTTRANSPORT_WARNINGS)
if (CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  set(LIGHTTRANSPORT_WARNINGS -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual)
endif ()
