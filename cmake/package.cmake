# The Debian package: `cmake --build build --target package`, or cpack in the build folder.
if(Python3_FOUND AND NOT CMAKE_CROSSCOMPILING)
  set(man_page ${PROJECT_BINARY_DIR}/ursula.1)
  add_custom_command(OUTPUT ${man_page}
    COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tools/man_page.py $<TARGET_FILE:ursula> ${man_page}
    DEPENDS ursula ${PROJECT_SOURCE_DIR}/tools/man_page.py COMMENT "Writing the man page" VERBATIM)
  add_custom_target(man_page ALL DEPENDS ${man_page})
  install(FILES ${man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
install(FILES apps/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ursula)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR ursula)
set(CPACK_PACKAGE_CONTACT "The ursula authors <ursula@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "whether the dynamics of a six-legged parallel manipulator is right, and why")
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
include(CPack)
