#pragma once

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

/// The five instants of one of them, seven for other kinds. Throws std::runtime_error if the file contradicts its
/// README.
std::vector<VectorRow> vectorRows(const std::string& name);

/// Their scenario.
Scenario vectorScenario(const std::string& name);

/// The same motion rounded to doubles.
Motion<double> rounded(const Motion<Real50>& motion);

}  // namespace ursula
