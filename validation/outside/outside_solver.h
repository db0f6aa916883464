#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/outside/pieces.h"
#include "validation/validate.h"
#include "validation/verdict/result.h"

namespace ursula {

/// A solver outside this program, in another language or process. It knows one machine and returns only torques.
struct OutsideSolver {
  std::string name;
  /// Computes six efforts for each of any number of motions, which are in B, SI. Efforts are in the order of the
  /// motors, N·m or N, conjugate to the rates of their coordinates. Calls never overlap but may come from different
  /// threads.
  std::function<std::vector<Vector6d>(const std::vector<Motion<double>>&)> torques;
  CalledBy called_by = CalledBy::program;
};

/// Validates a scenario with this solver under test. Checks that need a second machine, kinematics or direct dynamics
/// are not applicable. It asks for many motions at once if they are known, and never twice in a row for one. It asks
/// at most 2,000 times, unless `options.thorough`; replays then run on the answers, interpolated. An
/// exception of the solver ends the validation and is rethrown unchanged. Throws like validate(), and
/// std::invalid_argument for a wrong number of answers.
ValidationResult validateOutside(const Scenario& scenario, const OutsideSolver& solver,
                                 const ValidationOptions& options = {});

}  // namespace ursula
