#pragma once

#include <vector>

#include "model/scenario.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"

namespace ursula {

/// What rounding makes of the right solver's answers to a scenario, so that a defect is known from it: a solver that
/// is wrong where this machine gives it nothing to be wrong about (friction of 0, two tensors of one link exchanged
/// that turn together) differs by rounding alone.
class RightAnswers {
 public:
  explicit RightAnswers(const Scenario& scenario);

  /// What is off by more than rounding, at instants that are no samples of anything; dynamics where no instant has an
  /// answer. Kinematics that are wrong and
  /// leave the dynamics right (an axis reversed whose joint neither rubs nor drives) can be seen beside Simbody's
  /// alone.
  enum class Off { nothing, kinematics, dynamics };
  Off offIn(const Subject& subject) const;

 private:
  struct Numbers {
    Eigen::VectorXd right, room;
  };
  struct Instant {
    Motion<double> motion;
    std::vector<Numbers> answers;
  };
  std::vector<Instant> instants_;
};

/// True where another trajectory has the same motion but for rounding; false for one and the same.
bool movesAlike(const Scenario& a, const Scenario& b);

/// True where a check that applies to both says something else: another verdict, or another value by more than
/// `share` of its limit.
bool sayOtherwise(const std::vector<Check>& a, const std::vector<Check>& b, double share);

}  // namespace ursula
