# Tests of a sweep's report.
add_executable(sweep_report_tests
  heat_map_test.cpp
  sweep_databases.cpp
  sweep_relations_test.cpp
  sweep_report_test.cpp
  sweep_rows_test.cpp)
target_link_libraries(sweep_report_tests PRIVATE
  test_components ursula::eigen fmt::fmt GTest::gmock GTest::gtest_main)
ursula_test_suites(sweep_report_tests)
