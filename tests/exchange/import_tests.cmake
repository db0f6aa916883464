# Random machines in every format, and refusals: the program against numbers that a second language made.
if(URSULA_HAS_PYTHON)
  foreach(name import import_refusal import_cases)
    add_test(NAME exchange.${name}
      COMMAND ${URSULA_PYTHON_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/${name}_test.py $<TARGET_FILE:ursula>)
    set_tests_properties(exchange.${name} PROPERTIES TIMEOUT 900)
  endforeach()
endif()

# The readers against the formats' own libraries, where these are installed.
add_executable(read_tests read_graph_test.cpp)
target_link_libraries(read_tests PRIVATE ursula::import fmt::fmt GTest::gmock GTest::gtest_main)
if(URSULA_MUJOCO AND URSULA_MUJOCO_INCLUDE_DIR AND URSULA_MUJOCO_LIBRARY)
  target_sources(read_tests PRIVATE read_mujoco_test.cpp)
  target_include_directories(read_tests SYSTEM PRIVATE ${URSULA_MUJOCO_INCLUDE_DIR})
  target_link_libraries(read_tests PRIVATE ${URSULA_MUJOCO_LIBRARY})
endif()
find_package(sdformat12 QUIET)
if(sdformat12_FOUND)
  target_sources(read_tests PRIVATE read_sdformat_test.cpp)
  target_link_libraries(read_tests PRIVATE sdformat12::sdformat12)
  set_source_files_properties(read_sdformat_test.cpp PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endif()
gtest_discover_tests(read_tests)
