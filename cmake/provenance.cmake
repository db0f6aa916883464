# ursula::provenance says what a build was made of (base/provenance.h). The commit is found at build time, once a tracked
# file or the commit has changed; the source is rewritten only if the answer changed.
string(TOUPPER "CMAKE_CXX_FLAGS_${CMAKE_BUILD_TYPE}" _ursula_flags_of_type)
set(_ursula_flags "-std=c++${CMAKE_CXX_STANDARD} ${CMAKE_CXX_FLAGS} ${${_ursula_flags_of_type}}")
if(URSULA_SANITIZE)
  string(APPEND _ursula_flags " -fsanitize=${URSULA_SANITIZE}")
endif()
string(REGEX REPLACE " +" " " _ursula_flags "${_ursula_flags}")
string(STRIP "${_ursula_flags}" _ursula_flags)

find_package(Git QUIET)
set(_ursula_provenance_source ${PROJECT_BINARY_DIR}/generated/provenance.cpp)
add_custom_command(OUTPUT ${_ursula_provenance_source}
  COMMAND ${CMAKE_COMMAND}
    -D SOURCE_DIR=${PROJECT_SOURCE_DIR}
    -D TEMPLATE=${PROJECT_SOURCE_DIR}/base/provenance.cpp.in
    -D OUTPUT=${_ursula_provenance_source}
    -D DEPFILE=${_ursula_provenance_source}.d
    -D GIT=$<IF:$<BOOL:${GIT_EXECUTABLE}>,${GIT_EXECUTABLE},>
    -D VERSION=${PROJECT_VERSION}
    -D COMPILER=${CMAKE_CXX_COMPILER_ID}\ ${CMAKE_CXX_COMPILER_VERSION}
    -D FLAGS=${_ursula_flags}
    -D BUILD_TYPE=${CMAKE_BUILD_TYPE}
    -D SIMBODY=$<IF:$<BOOL:${Simbody_VERSION}>,${Simbody_VERSION},unknown>
    -P ${PROJECT_SOURCE_DIR}/cmake/write_provenance.cmake
  DEPENDS ${PROJECT_SOURCE_DIR}/base/provenance.cpp.in ${PROJECT_SOURCE_DIR}/cmake/write_provenance.cmake
  DEPFILE ${_ursula_provenance_source}.d
  COMMENT "Asking for the commit" VERBATIM)

add_library(ursula_provenance STATIC ${_ursula_provenance_source})
add_library(ursula::provenance ALIAS ursula_provenance)
target_link_libraries(ursula_provenance PUBLIC ursula::options PRIVATE ursula::eigen)
