# One interface target has the compile options of all our targets; nothing is set globally.
add_library(ursula_options INTERFACE)
add_library(ursula::options ALIAS ursula_options)
target_include_directories(ursula_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_features(ursula_options INTERFACE cxx_std_17)
# Everything may become part of the shared library. Its functions are not to be replaced from outside, so calls within
# it are inlined as in a program.
set_target_properties(ursula_options PROPERTIES INTERFACE_POSITION_INDEPENDENT_CODE ON)
target_compile_options(ursula_options INTERFACE -fno-semantic-interposition)
target_compile_options(ursula_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
# These warnings of GCC 12 are false alarms about fixed-size Eigen and Boost.Multiprecision code that it inlines (PR
# 105562 and similar).
target_compile_options(ursula_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overread -Wno-use-after-free>)
# GCC collects its garbage only beyond 1 GB, which few units reach. They compile in a tenth less time.
target_compile_options(ursula_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>)
# GoogleTest's macros need this.
target_compile_options(ursula_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-gnu-zero-variadic-macro-arguments>)
if(URSULA_WERROR)
  target_compile_options(ursula_options INTERFACE -Werror)
endif()
if(URSULA_SANITIZE)
  target_compile_options(ursula_options INTERFACE -fsanitize=${URSULA_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(ursula_options INTERFACE -fsanitize=${URSULA_SANITIZE})
endif()

# Headers of others, without our warnings.
add_library(ursula_eigen INTERFACE)
add_library(ursula::eigen ALIAS ursula_eigen)
target_include_directories(ursula_eigen SYSTEM INTERFACE
  $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES> ${Boost_INCLUDE_DIRS})
target_compile_definitions(ursula_eigen INTERFACE EIGEN_NO_AUTOMATIC_RESIZING)
