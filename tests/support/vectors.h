#pragma once

#include <cctype>
#include <string>
#include <vector>

#include "base/real50.h"
#include "model/joint_variables.h"
#include "model/motion.h"
#include "model/scenario.h"

namespace ursula {

/// One instant of tests/vectors/NAME.csv with all 25 digits.
struct VectorRow {
  Motion<Real50> motion;
  JointVariables<Real50> q, q_dot, q_ddot;
  Vector6<Real50> torques;
};

/// The seven machines of tests/vectors: "paper-helix", "random-1" … "random-6".
const std::vector<std::string>& vectorNames();

/// Machines with legs of other kinds, mixtures, and several motors per leg: "kind-ups-1" …
const std::vector<std::string>& kindNames();

/// All of both.
std::vector<std::string> allNames();

/// The five instants of one of them, seven for other kinds. Throws std::runtime_error if the file contradicts its
/// README.
std::vector<VectorRow> vectorRows(const std::string& name);

/// Their scenario.
Scenario vectorScenario(const std::string& name);

/// Returns scenarios/NAME.toml if it exists, else the machine of tests/vectors.
Scenario scenarioOf(const std::string& name);

/// The names of all shipped scenarios, in order.
std::vector<std::string> shippedScenarios();

/// The same motion in another scalar.
template <class To, class From>
Motion<To> castTo(const Motion<From>& motion) {
  const auto cast = [](const auto& x) { return x.template cast<To>().eval(); };
  return {static_cast<To>(motion.t), cast(motion.p),         cast(motion.Q),     cast(motion.omega),
          cast(motion.p_dot),        cast(motion.omega_dot), cast(motion.p_ddot)};
}

inline Motion<double> rounded(const Motion<Real50>& motion) { return castTo<double>(motion); }
inline Motion<Real50> exactly(const Motion<double>& motion) { return castTo<Real50>(motion); }

/// "paper-helix" as a part of a test's name.
inline std::string asTestName(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return text;
}

/// Names the instances of a test by their parameter, a text.
inline const auto byName = [](const auto& info) { return asTestName(info.param); };

}  // namespace ursula
