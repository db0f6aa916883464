# One program and one test, so that the slow audit is made once.
add_executable(audit_tests audit_formula_errors_test.cpp audit_test.cpp)
target_link_libraries(audit_tests PRIVATE test_scalars test_components nlohmann_json::nlohmann_json GTest::gtest_main)
target_compile_definitions(audit_tests PRIVATE
  URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios" URSULA_DOCS="${PROJECT_SOURCE_DIR}/docs")
add_test(NAME audit COMMAND audit_tests)

add_executable(results_tests results_test.cpp)
target_link_libraries(results_tests PRIVATE test_components nlohmann_json::nlohmann_json GTest::gtest_main)
target_compile_definitions(results_tests PRIVATE
  URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios" URSULA_RESULTS="${PROJECT_SOURCE_DIR}/results")
add_test(NAME results COMMAND results_tests)
