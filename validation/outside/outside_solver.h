#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/validate.h"
#include "validation/verdict/result.h"

namespace ursula {

/// A solver that is no part of this program: code in another language, or another process. It knows one machine, and
/// answers with torques alone.
struct OutsideSolver {
  std::string name;
  /// For any number of motions, in B, SI: six efforts each, in the order of the motors, N·m or N, conjugate to the
  /// rates of what they drive. Never called by two threads at once, but not always by the same.
  std::function<std::vector<Vector6d>(const std::vector<Motion<double>>&)> torques;
};

/// The whole validation of a scenario with that solver on trial. What needs a second machine, kinematics or direct
/// dynamics is not applicable. Asks for many motions at once where it knows them beforehand, and for none twice in a
/// row. What the solver throws ends the validation, and is thrown again as it was. Throws as validate() does, and
/// std::invalid_argument for a wrong number of answers.
ValidationResult validateOutside(const Scenario& scenario, const OutsideSolver& solver,
                                 const ValidationOptions& options = {});

}  // namespace ursula
