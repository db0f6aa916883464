# Tests of sweeps.
find_package(SQLite3 REQUIRED)
add_executable(sweep_tests
  sweep/slurm_test.cpp
  sweep/sweep_database_test.cpp
  sweep/sweep_file_test.cpp
  sweep/sweep_merge_test.cpp
  sweep/sweep_points_test.cpp
  sweep/sweep_run_test.cpp
  sweep/worker_pool_test.cpp
)
target_link_libraries(sweep_tests PRIVATE test_support test_components SQLite::SQLite3 GTest::gmock GTest::gtest_main)
target_compile_definitions(sweep_tests PRIVATE URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios")
ursula_test_suites(sweep_tests LONG SweepWorker)
