# Logs made in Simbody, and what is found in them.
add_executable(identify_tests
  identify/closed_form_test.cpp
  identify/identify_test.cpp
  identify/measured_log_test.cpp
  identify/random_logs.cpp
  identify/signals_test.cpp
  identify/synthetic_log.cpp
  identify/tolerances_test.cpp
  identify/uneven_rows_test.cpp
)
# The evidence that docs/identify.md quotes, with what is not reached yet.
add_executable(identify_logs EXCLUDE_FROM_ALL
  identify/outside_test.cpp
  identify/random_logs.cpp
  identify/random_logs_test.cpp
  identify/synthetic_log.cpp
)
foreach(program identify_tests identify_logs)
  target_link_libraries(${program} PRIVATE
    test_support test_components ursula::simbody nlohmann_json::nlohmann_json fmt::fmt GTest::gmock GTest::gtest_main)
  target_compile_definitions(${program} PRIVATE URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios")
endforeach()
ursula_test_suites(identify_tests LONG ClosedFormLogs Identify UnevenLogs)
