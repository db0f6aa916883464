# What sbatch is given, and what is still to be given.
add_executable(sweep_slurm_tests sweep_slurm_test.cpp)
target_link_libraries(sweep_slurm_tests PRIVATE test_support test_rooms GTest::gmock GTest::gtest_main)
gtest_discover_tests(sweep_slurm_tests)
