# Headers that nearly every source includes are parsed once instead of a hundred times; they take most of a source's
# time. Each source still includes what it uses; the presets for development and clang-tidy compile without this.

# Without these settings ccache keeps no object that was compiled with the header, or only for this very folder.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  list(PREPEND CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1)
endif()

# GCC keeps the optimisation of the header for every source that uses it: Eigen's headers have a function with
# __attribute__((optimize)), and with it the header's options become the default, which a later -O1 does not change. So
# there are two headers. Code that computes is hot and optimised as the build type says; all else is cold, at -O1.
foreach(heat hot cold)
  set(_ursula_carrier ${PROJECT_BINARY_DIR}/generated/precompiled_${heat}.cpp)
  file(CONFIGURE OUTPUT ${_ursula_carrier} CONTENT "// Carries the precompiled header.\n" @ONLY)
  add_library(ursula_precompiled_${heat} OBJECT ${_ursula_carrier})
  target_link_libraries(ursula_precompiled_${heat} PRIVATE ursula::options ursula::eigen fmt::fmt)
  target_precompile_headers(ursula_precompiled_${heat} PRIVATE
    <algorithm> <array> <cmath> <functional> <memory> <optional> <string> <vector>
    <fmt/format.h> <Eigen/Geometry> <Eigen/LU>)
endforeach()
target_precompile_headers(ursula_precompiled_cold PRIVATE <base/real50.h>)  # no hot code has 50 digits
target_compile_options(ursula_precompiled_cold PRIVATE -O1)

# The header was parsed with fmt's definitions, so a target that uses it needs them, too.
function(ursula_use_header target heat)
  target_precompile_headers(${target} REUSE_FROM ursula_precompiled_${heat})
  target_link_libraries(${target} PRIVATE ursula::eigen)
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
endfunction()

# For code that computes.
function(ursula_use_hot target)
  ursula_use_header(${target} hot)
endfunction()

# For texts, files, judgements and all that runs once.
function(ursula_use_cold target)
  ursula_use_header(${target} cold)
  target_compile_options(${target} PRIVATE -O1)
endfunction()
