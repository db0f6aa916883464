#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "model/instants.h"
#include "tests/support/vectors.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/subject.h"
#include "validation/validate.h"

namespace ursula {

/// Returns scenarios/NAME.toml if it exists, else the machine of tests/vectors.
inline Scenario scenarioOf(const std::string& name) {
  const std::string file = std::string(URSULA_SCENARIOS) + "/" + name + ".toml";
  return std::filesystem::exists(file) ? readScenario(file) : vectorScenario(name);
}

/// The names of all shipped scenarios, in order.
inline std::vector<std::string> shippedScenarios() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(URSULA_SCENARIOS))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

inline Subject solverOf(const Scenario& scenario) { return nocSubject(*scenario.manipulator, scenario.load); }

/// The solver's pointwise samples at equally spaced instants.
inline std::vector<PointwiseSample> rightSamples(const Scenario& scenario, int count) {
  return runPointwise(scenario, solverOf(scenario), equallySpaced(scenario.trajectory->duration(), count));
}

/// Simbody's largest torque, N·m.
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
