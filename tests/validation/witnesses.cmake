# The witnesses beside the replay: each shows that a wrong input fails it.
add_executable(witness_tests
  feedback_test.cpp
)
target_link_libraries(witness_tests PRIVATE test_support ursula::validation fmt::fmt GTest::gmock GTest::gtest_main)
gtest_discover_tests(witness_tests)
