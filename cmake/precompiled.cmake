# Headers that nearly every source includes are parsed once instead of a hundred times; they take most of a source's
# time. Each source still includes what it uses; the presets for development and clang-tidy compile without this.

# Without these settings ccache keeps no object that was compiled with the header, or only for this very folder.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  list(PREPEND CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1)
endif()

set(_ursula_carrier ${PROJECT_BINARY_DIR}/generated/precompiled.cpp)
file(CONFIGURE OUTPUT ${_ursula_carrier} CONTENT "// Carries the precompiled header.\n" @ONLY)
add_library(ursula_precompiled OBJECT ${_ursula_carrier})
target_link_libraries(ursula_precompiled PRIVATE ursula::options ursula::eigen fmt::fmt)
target_precompile_headers(ursula_precompiled PRIVATE
  <algorithm> <array> <cmath> <functional> <memory> <optional> <string> <vector>
  <fmt/format.h> <Eigen/Geometry> <Eigen/LU> <base/real50.h>)

# The header was parsed with fmt's definitions, so a target that uses it needs them, too.
function(ursula_use_precompiled target)
  target_precompile_headers(${target} REUSE_FROM ursula_precompiled)
  target_link_libraries(${target} PRIVATE ursula::eigen)
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
endfunction()
