#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "tests/support/vectors.h"
#include "validation/pointwise.h"
#include "validation/subject.h"
#include "validation/validate.h"

namespace ursula {

/// scenarios/NAME.toml where there is one, else the machine of tests/vectors.
inline Scenario scenarioOf(const std::string& name) {
  return name.rfind("random-", 0) == 0 ? vectorScenario(name)
                                       : readScenario(std::string(URSULA_SCENARIOS) + "/" + name + ".toml");
}

inline Subject solverOf(const Scenario& scenario) { return nocSubject(*scenario.manipulator, scenario.load); }

/// The solver's pointwise samples at equally spaced instants.
inline std::vector<PointwiseSample> rightSamples(const Scenario& scenario, int count) {
  return runPointwise(scenario, solverOf(scenario), equallySpaced(scenario.trajectory->duration(), count));
}

/// The largest torque of Simbody's, N·m.
inline double largestTorque(const std::vector<PointwiseSample>& samples) {
  double largest = 0;
  for (const PointwiseSample& sample : samples)
    largest = std::max(largest, sample.torques_simbody.cwiseAbs().maxCoeff());
  return largest;
}

/// "paper-helix" as a part of a test's name.
inline std::string asTestName(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return text;
}

}  // namespace ursula
