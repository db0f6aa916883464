#pragma once

namespace ursula {

/// What is said where std::bad_alloc came through. It says nothing of what was asked, and is never a finding.
inline constexpr const char* out_of_memory = "out of memory";
/// The same where scenarios are judged.
inline constexpr const char* out_of_memory_for_scenario =
    "out of memory: fewer samples in the scenario's [simulation], or fewer --jobs, need less";

}  // namespace ursula
