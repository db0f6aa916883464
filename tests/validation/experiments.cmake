# The experiments beside the replay; each test shows that a wrong input fails them.
add_executable(witness_tests
  attribution_test.cpp
  extremes_test.cpp
  invariance_test.cpp
  ladder_test.cpp
  engines_test.cpp
  motion_sizes_test.cpp
  places_test.cpp
)
target_link_libraries(witness_tests PRIVATE
  test_support test_components ursula::mujoco fmt::fmt GTest::gmock GTest::gtest_main)
target_compile_definitions(witness_tests PRIVATE URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios")
ursula_test_suites(witness_tests LONG Attribution Places Scenarios/AtRest Scenarios/Budget Scenarios/Extremes WrongSimbody)

# The input that all formulations share: the commanded motion and the load.
add_executable(commanded_tests
  commanded_motion_test.cpp
)
target_link_libraries(commanded_tests PRIVATE test_support test_components fmt::fmt GTest::gmock GTest::gtest_main)
target_compile_definitions(commanded_tests PRIVATE URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios")
ursula_test_suites(commanded_tests)
