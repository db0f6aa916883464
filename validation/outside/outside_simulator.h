#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/mechanism/validate_mechanism.h"
#include "validation/validate.h"

namespace ursula {

/// A simulator outside this program. It knows one machine and returns only accelerations.
struct OutsideSimulator {
  std::string name;
  /// Computes the platform's accelerations [ω̇; p̈], rad/s² and m/s² in B, for any number of states under the motors'
  /// efforts, N·m or N in the order of the motors. Accelerations in the states are zero. Calls never overlap.
  std::function<std::vector<Vector6d>(const std::vector<Motion<double>>& states, const std::vector<Vector6d>& efforts)>
      accelerations;
  CalledBy called_by = CalledBy::program;
};

/// Validates direct dynamics. The simulator is asked on the path and beside it, and each answer is turned into the
/// efforts under which it has the commanded accelerations. These are judged as a solver's, with the limits of rounding
/// that direct dynamics has; `direct.*` compares the accelerations themselves with Simbody's. At most 2,000 questions.
/// An exception of the simulator is rethrown unchanged. Throws like validate().
ValidationResult validateSimulator(const Scenario& scenario, const OutsideSimulator& simulator,
                                   const ValidationOptions& options = {});

/// The same for a mechanism: `accelerations` of the motors' coordinates. Accelerations in the questions are zero.
struct MechanismSimulator {
  JudgedSubject about;
  std::function<std::vector<Eigen::VectorXd>(const std::vector<MechanismQuestion>& states,
                                             const std::vector<MotorEfforts>& efforts)>
      accelerations;
};
ValidationResult validateSimulator(const MechanismScenario& scenario, const MechanismSimulator& simulator,
                                   const MechanismOptions& options = {});

}  // namespace ursula
