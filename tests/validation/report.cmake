# Tests of results and their report; to be included where GTest and GoogleTest are at hand.

add_library(report_samples_data STATIC
  ${CMAKE_CURRENT_LIST_DIR}/page_samples.cpp ${CMAKE_CURRENT_LIST_DIR}/report_samples.cpp)
target_link_libraries(report_samples_data PUBLIC test_rooms)
target_compile_definitions(report_samples_data PUBLIC URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios")

add_executable(report_tests
  ${CMAKE_CURRENT_LIST_DIR}/junit_test.cpp
  ${CMAKE_CURRENT_LIST_DIR}/pages_test.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report_test.cpp
  ${CMAKE_CURRENT_LIST_DIR}/run_test.cpp
  ${CMAKE_CURRENT_LIST_DIR}/result_test.cpp
  ${CMAKE_CURRENT_LIST_DIR}/terminal_text_test.cpp)
target_link_libraries(report_tests PRIVATE
  report_samples_data ursula::model ursula::eigen nlohmann_json::nlohmann_json GTest::gmock GTest::gtest_main)
gtest_discover_tests(report_tests TEST_PREFIX report.)

add_executable(report_samples ${CMAKE_CURRENT_LIST_DIR}/report_samples_main.cpp)
target_link_libraries(report_samples PRIVATE report_samples_data)

find_program(URSULA_CHROMIUM NAMES chromium chromium-browser google-chrome)
set(samples_dir ${CMAKE_CURRENT_BINARY_DIR}/report_samples_out)
add_test(NAME report.write_samples COMMAND report_samples ${samples_dir})
set_tests_properties(report.write_samples PROPERTIES FIXTURES_SETUP report_samples)
# The paper's helix as the program writes it: what is printed of it is counted in pages.
add_test(NAME report.write_helix
  COMMAND ursula validate ${PROJECT_SOURCE_DIR}/scenarios/paper-helix.toml --out ${samples_dir}/helix)
set_tests_properties(report.write_helix PROPERTIES FIXTURES_SETUP report_samples)
# A grid's poses: heat maps, and points that have no result.
add_test(NAME report.write_sweep
  COMMAND sh -c "rm -f sweep.db && $<TARGET_FILE:ursula> sweep ${PROJECT_SOURCE_DIR}/sweeps/workspace.toml --db sweep.db &&
    $<TARGET_FILE:ursula> sweep report sweep.db --out sweep"
  WORKING_DIRECTORY ${samples_dir})
set_tests_properties(report.write_sweep PROPERTIES FIXTURES_SETUP report_samples DEPENDS report.write_samples)
# Where there is no Chromium the test fails and says so: a browser that is missing is no pass.
add_test(NAME report.browser
  COMMAND ${PROJECT_SOURCE_DIR}/tests/browser/run.sh
    ${samples_dir} ${PROJECT_BINARY_DIR}/tests/browser ${URSULA_CHROMIUM})
set_tests_properties(report.browser PROPERTIES FIXTURES_REQUIRED report_samples TIMEOUT 900 SKIP_RETURN_CODE 77)
