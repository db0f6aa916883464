# The Debian package: `cmake --build build --target package`, or cpack in the build folder.
if(NOT CMAKE_CROSSCOMPILING)
  # The man page and the completions are made from the definitions that --help shows.
  set(call_docs ${PROJECT_BINARY_DIR}/call_docs)
  set(wanted --man "--completion bash" "--completion zsh" "--completion fish")
  set(call_files ${call_docs}/ursula.1 ${call_docs}/ursula ${call_docs}/_ursula ${call_docs}/ursula.fish)
  foreach(options file IN ZIP_LISTS wanted call_files)
    separate_arguments(options)
    add_custom_command(OUTPUT ${file}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${call_docs}
      COMMAND ursula docs ${options} > ${file}
      DEPENDS ursula COMMENT "Writing ${file}" VERBATIM)
  endforeach()
  add_custom_target(call_docs ALL DEPENDS ${call_files})
  install(FILES ${call_docs}/ursula.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${call_docs}/ursula DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${call_docs}/_ursula DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
  install(FILES ${call_docs}/ursula.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR ursula)
set(CPACK_PACKAGE_CONTACT "The ursula authors <ursula@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "validates the closed-form dynamics of six-legged parallel manipulators")
set(CPACK_PACKAGE_DESCRIPTION "Computes actuator torques in closed form, builds the same mechanism independently as a
closed loop in Simbody, drives that loop with those torques, and gives a verdict with reasons. Holds the program, the
C++ library with its headers, and examples.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libeigen3-dev (>= 3.4), python3-numpy")  # for the headers; for the Python module
# CPack finds the packages of installed libraries, and names any LAPACK; the program loads the reference's.
if(reference_folders)
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "liblapack3, libblas3")
  string(REPLACE ";" ":" CPACK_URSULA_RPATH "${reference_folders}")
endif()
# Unpacked libraries are unknown to it, so their packages are named here.
if(unpacked_libraries)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${simbodys_folder})
  file(GLOB versioned ${simbodys_folder}/libSimTKsimbody.so.*)
  string(REGEX REPLACE ".*\\.so\\." "libsimbody" simbodys_package "${versioned}")
  list(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ${simbodys_package})
  list(JOIN CPACK_DEBIAN_PACKAGE_DEPENDS ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
endif()
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/without_rpath.cmake)
include(CPack)
