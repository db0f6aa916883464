#pragma once

#include <string>

#include "parts/sweep/sweep_plan.h"
#include "tests/base/temporary_folder.h"

namespace ursula {

constexpr const char* helix_file = URSULA_SCENARIOS "/paper-helix.toml";

/// A sweep of the paper's helix; `rest` follows the keys `what` and `scenario`.
inline std::string sweepText(const std::string& what, const std::string& rest) {
  return "scenario = \"" + std::string(helix_file) + "\"\nwhat = \"" + what + "\"\n" + rest;
}

inline SweepPlan planOf(const std::string& what, const std::string& rest) {
  return SweepPlan(parseSweepFile(sweepText(what, rest), "sweep.toml"));
}

inline std::string vary(const std::string& key, const std::string& how) {
  return "[[vary]]\nkey = \"" + key + "\"\n" + how + "\n";
}

}  // namespace ursula
