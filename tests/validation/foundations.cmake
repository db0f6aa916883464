# The foundations of every verdict: limits, changes of frame, users' limits, and comparisons between the samples.
add_executable(foundation_tests
  acceptance_test.cpp
  check_list_test.cpp
  dense_torques_test.cpp
  frame_change_test.cpp
  relocation_test.cpp
  second_look_test.cpp
  shared_answers_test.cpp
  subject_test.cpp
  tolerance_test.cpp
)
add_executable(profile_tests
  far_away_test.cpp
  formulation_noise_test.cpp
  rounding_profile_test.cpp
)
foreach(program foundation_tests profile_tests)
  target_link_libraries(${program} PRIVATE
    test_scalars test_support test_components fmt::fmt nlohmann_json::nlohmann_json GTest::gmock GTest::gtest_main)
  target_compile_definitions(${program} PRIVATE URSULA_SCENARIOS="${PROJECT_SOURCE_DIR}/scenarios")
  ursula_test_suites(${program} LONG Between CheckList Errors/UnevenEngine Kilometres/FarAway NoisyFormulations Scenarios/Profile
    Scenarios/Shared Tolerance)
endforeach()
