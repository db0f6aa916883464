# The shared library for users in C++: all static parts in one, headers, and a CMake package. It passes on Eigen's
# headers and C++17, but no warnings, definitions or sanitizers, because the parts are linked privately.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(CheckTypeSize)

set(CMAKE_REQUIRED_LIBRARIES Eigen3::Eigen)
set(CMAKE_EXTRA_INCLUDE_FILES Eigen/Core)
check_type_size("char[alignof(Eigen::Matrix<double, 8, 8>)]" URSULA_EIGEN_ALIGNMENT LANGUAGE CXX)
set(CMAKE_EXTRA_INCLUDE_FILES vector)
check_type_size("std::vector<double>" URSULA_VECTOR_SIZE LANGUAGE CXX)
set(CMAKE_EXTRA_INCLUDE_FILES)
unset(CMAKE_EXTRA_INCLUDE_FILES)
unset(CMAKE_REQUIRED_LIBRARIES)

set(public_include ${PROJECT_BINARY_DIR}/include)
configure_file(include/ursula/build.h.in ${public_include}/ursula/build.h @ONLY)
# The headers are laid out at configuration, too, because targets compiled against them depend on their names.
set(lay_out_headers ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -D OUTPUT=${public_include}
  -D STAMP=${PROJECT_BINARY_DIR}/generated/public_headers
  -P ${PROJECT_SOURCE_DIR}/cmake/public_headers.cmake)
execute_process(COMMAND ${lay_out_headers} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE public_headers ${public_include}/ursula/*.h)
list(REMOVE_ITEM public_headers ${public_include}/ursula/build.h)
set(headers_stamp ${PROJECT_BINARY_DIR}/generated/public_headers)
add_custom_command(OUTPUT ${headers_stamp}
  COMMAND ${lay_out_headers}
  COMMAND ${CMAKE_COMMAND} -E touch ${headers_stamp}
  BYPRODUCTS ${public_headers}
  DEPENDS ${PROJECT_SOURCE_DIR}/cmake/public_headers.cmake
  DEPFILE ${headers_stamp}.d
  COMMENT "Laying out the public headers" VERBATIM)
add_custom_target(ursula_headers ALL DEPENDS ${headers_stamp})

# The library has all objects of the static parts, and one source that sees the headers as users do. The parts are also
# linked, for the libraries that they need.
get_property(built GLOBAL PROPERTY URSULA_BUILT_PARTS)
list(REMOVE_ITEM built ursula_prove ursula_random ursula_scenario_docs ursula_sweep)  # no public header has them
set(parts ursula_base ursula_model ursula_nocsolver ursula_loops ursula_simbody ursula_verdict ursula_subject ursula_limits ursula_samples
  ursula_replay ursula_evidence ursula_checks ursula_findings ursula_report ursula_validation ursula_outside ursula_provenance
  ursula_check_scenario ursula_closing ursula_maximal_loop ursula_mujoco ursula_mechanism ${built})
list(TRANSFORM parts REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
set(as_users_do ${PROJECT_BINARY_DIR}/generated/library.cpp)
file(CONFIGURE OUTPUT ${as_users_do} CONTENT "#include <ursula/ursula.h>\n")
add_library(ursula_library SHARED ${as_users_do} ${objects} $<TARGET_OBJECTS:ursula_part_rows>)
add_library(ursula::ursula ALIAS ursula_library)
add_dependencies(ursula_library ursula_headers)
set(symbols ${PROJECT_SOURCE_DIR}/cmake/ursula.map)
target_link_libraries(ursula_library PRIVATE ${parts} PUBLIC Eigen3::Eigen)
target_link_options(ursula_library PRIVATE LINKER:--version-script=${symbols} LINKER:--gc-sections)
if(URSULA_SANITIZE)  # clang leaves the sanitizers' functions to the program that loads the library
  target_link_options(ursula_library INTERFACE -fsanitize=${URSULA_SANITIZE})
else()
  target_link_options(ursula_library PRIVATE LINKER:--no-undefined)
endif()
target_include_directories(ursula_library INTERFACE
  $<BUILD_INTERFACE:${public_include}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_include_directories(ursula_library PRIVATE ${public_include})
target_compile_features(ursula_library PUBLIC cxx_std_17)
set_target_properties(ursula_library PROPERTIES
  OUTPUT_NAME ursula EXPORT_NAME ursula LINK_DEPENDS ${symbols}
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/ursula)
install(TARGETS ursula_library EXPORT ursula-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS ursula RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${public_include}/ursula DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT ursula-targets NAMESPACE ursula:: DESTINATION ${package_folder})
configure_package_config_file(cmake/ursula-config.cmake.in ${PROJECT_BINARY_DIR}/ursula-config.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS CMAKE_INSTALL_DATADIR)
# While the version starts with 0, a minor version may break its users.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ursula-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ursula-config.cmake ${PROJECT_BINARY_DIR}/ursula-config-version.cmake
  DESTINATION ${package_folder})
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" to_prefix ${to_prefix})
configure_file(cmake/ursula.pc.in ${PROJECT_BINARY_DIR}/ursula.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/ursula.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(DIRECTORY scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/ursula)
install(FILES docs/scenario.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/ursula)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The reference of the public headers, if Doxygen is installed; its warnings are errors.
find_program(URSULA_DOXYGEN doxygen)
mark_as_advanced(URSULA_DOXYGEN)
find_package(Python3 COMPONENTS Interpreter)
if(NOT URSULA_DOXYGEN OR NOT Python3_FOUND)
  add_custom_target(api_docs
    COMMAND ${CMAKE_COMMAND} -E echo "api_docs needs doxygen and python3; install them and configure again"
    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
else()
  set(api_folder ${PROJECT_BINARY_DIR}/api_docs)
  add_custom_target(api_docs
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${api_folder}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${api_folder}
    COMMAND ${CMAKE_COMMAND} -E env URSULA_VERSION=${PROJECT_VERSION} URSULA_API_OUTPUT=${api_folder}
            URSULA_API_HEADERS=${public_include}/ursula ${URSULA_DOXYGEN} docs/api/Doxyfile
    DEPENDS ursula_headers WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    COMMENT "Writing the reference of the public headers to ${api_folder}/html" VERBATIM)
endif()
