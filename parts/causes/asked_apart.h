#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"

namespace ursula {

/// A solver's answers to separate questions, at poses of its motion.
struct AskedApart {
  std::vector<Motion<double>> motions;
  std::vector<Vector6d> found, expected;  ///< of the solver, of the NOC: N·m or N
  std::vector<double> rounding;           ///< possible difference of right efforts, N·m or N
  std::vector<TermError> terms;           ///< relative errors of the parts of its efforts
  /// The jumps of each motor's answers between nearly equal questions, N·m or N; larger than rounding if digits are
  /// lost.
  Vector6d grain = Vector6d::Zero();
  /// Its answers when instants of the motion are asked again one by one: N·m or N.
  std::vector<double> again_t = {};
  std::vector<Vector6d> again = {};
  std::string no_cause = {};  ///< WrongSolver::no_cause
};

/// Asks separate questions at poses of `motions` and compares each part of the efforts with the NOC's. The parts are
/// the efforts at rest, the effect of each acceleration, the terms even in v, in ω and in both, and the odd ones. The
/// first questions are repeated in another order. Errors are relative to the part, or to all efforts if the part
/// vanishes. The velocities are large enough to matter beside gravity. Returns nothing if the solver leaves a question
/// unanswered, and no motions if its answers ignore the question.
AskedApart askedApart(const Subject& subject, const Scenario& scenario, const std::vector<Motion<double>>& motions);

}  // namespace ursula
