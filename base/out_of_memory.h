#pragma once

namespace ursula {

/// What is said where std::bad_alloc came through. It says nothing of what was asked, and is never a finding.
inline constexpr const char* out_of_memory = "out of memory: fewer jobs or samples need less";

}  // namespace ursula
