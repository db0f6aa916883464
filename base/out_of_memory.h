#pragma once

namespace ursula {

/// The message for std::bad_alloc. It says nothing about the input and is never a finding.
inline constexpr const char* out_of_memory = "out of memory";
/// The same when scenarios are validated.
inline constexpr const char* out_of_memory_for_scenario =
    "out of memory: fewer samples in the scenario's [simulation], or fewer --jobs, need less";

}  // namespace ursula
