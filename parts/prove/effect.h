#pragma once

#include <vector>

#include "model/scenario.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The rounding of the right solver's answers to a scenario, to recognise a defect. A solver whose error has no effect
/// on this machine differs by rounding only. Examples are friction of 0, or exchanged tensors of one link that turn
/// together.
class RightAnswers {
 public:
  explicit RightAnswers(const Scenario& scenario);

  /// Says which quantities are off by more than rounding, at instants between the samples; `dynamics` if no instant has
  /// an answer. Wrong kinematics with right dynamics (a reversed axis without friction and motor) are visible only in
  /// comparison with Simbody's.
  enum class Off { nothing, kinematics, dynamics };
  Off offIn(const Subject& subject) const;

 private:
  struct Numbers {
    Eigen::VectorXd right, tolerance;
  };
  struct Instant {
    Motion<double> motion;
    std::vector<Numbers> answers;
  };
  std::vector<Instant> instants_;
};

/// Returns whether the scenarios' trajectories are different objects with the same motion up to rounding.
bool movesAlike(const Scenario& a, const Scenario& b);

/// Returns whether a check that applies to both has another verdict, or a value that differs by more than `share` of
/// its limit.
bool sayOtherwise(const std::vector<Check>& a, const std::vector<Check>& b, double share);

/// The NOC's formulas in long double, to measure rounding in doubles.
Subject longNocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load);

}  // namespace ursula
