# ursula::lapack is the reference LAPACK and BLAS. Simbody's libraries load liblapack.so.3 and libblas.so.3, by default
# the machine's choice. OpenBLAS's starts threads when it is loaded, waits for ever for its buffers where memory is short,
# and gives other last digits. A program that loads the reference's own first gives these to Simbody. Their folders are
# an RPATH, which LD_LIBRARY_PATH does not overrule.
add_library(ursula_lapack INTERFACE)
add_library(ursula::lapack ALIAS ursula_lapack)
foreach(name lapack blas)
  find_file(URSULA_REFERENCE_${name} lib${name}.so.3 NO_DEFAULT_PATH
    PATHS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/${name} ${PROJECT_SOURCE_DIR}/.deps/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/${name})
  mark_as_advanced(URSULA_REFERENCE_${name})
endforeach()
if(URSULA_REFERENCE_lapack AND URSULA_REFERENCE_blas)
  cmake_path(GET URSULA_REFERENCE_lapack PARENT_PATH of_lapack)
  cmake_path(GET URSULA_REFERENCE_blas PARENT_PATH of_blas)
  set(reference_folders ${of_lapack} ${of_blas})
  list(APPEND CMAKE_BUILD_RPATH ${reference_folders})
  list(APPEND CMAKE_INSTALL_RPATH ${reference_folders})
  # One item, which CMake leaves together. No symbol of ours needs the libraries.
  target_link_libraries(ursula_lapack INTERFACE
    -Wl,--disable-new-dtags,--push-state,--no-as-needed,${URSULA_REFERENCE_lapack},${URSULA_REFERENCE_blas},--pop-state)
else()
  message(STATUS "The reference LAPACK is not there (Debian: liblapack3, libblas3): Simbody uses the machine's own")
endif()
