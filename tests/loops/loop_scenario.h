#pragma once

#include <filesystem>
#include <string>

#include "base/csv.h"
#include "model/mechanism_scenario.h"

namespace ursula {

/// A scenario of tests/vectors/loops, whose references come from positions alone, in 50 digits.
inline MechanismScenario loopScenario(const std::string& name) {
  return readMechanism(std::filesystem::path(URSULA_LOOPS) / (name + ".toml"), partModelReader());
}

/// The same machine with a change of its parameters.
template <class Change>
MechanismScenario changedScenario(MechanismScenario scenario, const Change& change) {
  change(scenario.read.machine);
  scenario.mechanism = std::make_shared<Mechanism>(scenario.read.machine);
  return scenario;
}

inline CsvTable loopVectors(const std::string& name) {
  return readCsv(std::filesystem::path(URSULA_LOOPS) / (name + ".csv"));
}

}  // namespace ursula
