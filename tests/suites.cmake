# ursula_test_suites(PROGRAM [PREFIX report.] [LABELS preloaded] [LONG SUITE…]): one test of ctest for each suite of a
# program of GoogleTest. A suite computes the common data of its tests once, and starts one process instead of one for each
# test. Suites of LONG take ten seconds or more, and start first.
function(ursula_test_suites program)
  cmake_parse_arguments(PARSE_ARGV 1 suites "" "PREFIX;LABELS" "LONG")
  set(listing ${CMAKE_CURRENT_BINARY_DIR}/${program}_suites.cmake)
  file(GENERATE OUTPUT ${listing} CONTENT "set(suites_of \"$<TARGET_FILE:${program}>\")
set(suites_prefix \"${suites_PREFIX}\")
set(suites_labels \"${suites_LABELS}\")
set(suites_long \"${suites_LONG}\")
include(\"${PROJECT_SOURCE_DIR}/tests/list_suites.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${listing})
endfunction()
