#What `ursula export` writes, as the readers of other tools understand it; those that are installed.
add_library(export_support STATIC export_support.cpp)
    target_compile_definitions(export_support PUBLIC URSULA_SOURCE = "${PROJECT_SOURCE_DIR}") target_link_libraries(
        export_support PUBLIC ursula::options ursula::model_export ursula::nocsolver PRIVATE fmt::fmt)

        function(ursula_export_test format) add_executable(export_${format} _tests export_${format} _test.cpp)
            target_link_libraries(export_${format} _tests PRIVATE export_support ${ARGN} GTest::gmock GTest::gtest_main)
                gtest_discover_tests(export_${format} _tests) endfunction()

                    find_package(tinyxml2 REQUIRED)
ursula_export_test(graph tinyxml2::tinyxml2) if (URSULA_MUJOCO AND URSULA_MUJOCO_INCLUDE_DIR AND URSULA_MUJOCO_LIBRARY)
                        ursula_export_test(mujoco ${URSULA_MUJOCO_LIBRARY})
                            target_sources(export_mujoco_tests PRIVATE export_simulation_test.cpp)
  target_include_directories(export_mujoco_tests SYSTEM PRIVATE ${URSULA_MUJOCO_INCLUDE_DIR})
                                endif() find_package(sdformat12 QUIET) if (sdformat12_FOUND)
                                    ursula_export_test(sdf sdformat12::sdformat12) endif()
                                        find_package(urdfdom QUIET) if (urdfdom_FOUND)
                                            ursula_export_test(urdf urdfdom::urdfdom_model) endif()
