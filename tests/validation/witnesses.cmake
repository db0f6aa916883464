# The witnesses beside the replay: each shows that a wrong input fails it.
add_executable(witness_tests
  attribution_test.cpp
  extremes_test.cpp
  feedback_test.cpp
  invariance_test.cpp
  judge_ladder_test.cpp
  ladder_test.cpp
  prove_kinds_test.cpp
  prove_test.cpp
  roads_test.cpp
  windows_test.cpp
)
target_link_libraries(witness_tests PRIVATE
  test_support test_rooms ursula::mujoco fmt::fmt GTest::gmock GTest::gtest_main)
target_compile_definitions(witness_tests PRIVATE URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios")
gtest_discover_tests(witness_tests)

# One program and one test: every defect is judged once.
add_executable(prove_tests prove_defects_test.cpp)
target_link_libraries(prove_tests PRIVATE test_support test_rooms ursula::mujoco GTest::gtest_main)
target_compile_definitions(prove_tests PRIVATE URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios")
# Minutes: ./dev prove. What prove_test.cpp has of it runs with all tests.
add_test(NAME prove COMMAND prove_tests CONFIGURATIONS Proof)

# What all roads share: the commanded motion, the load, the numbers as read.
add_executable(commanded_tests
  commanded_motion_test.cpp
  independent_reading_test.cpp
  load_check_test.cpp
  motion_in_doubles_test.cpp
)
target_link_libraries(commanded_tests PRIVATE test_support test_rooms fmt::fmt GTest::gmock GTest::gtest_main)
target_compile_definitions(commanded_tests PRIVATE URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios")
gtest_discover_tests(commanded_tests)
