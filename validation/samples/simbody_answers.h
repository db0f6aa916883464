#pragma once

#include <optional>
#include <vector>

#include "engines/simbody/simbody_loop.h"
#include "model/joint_reactions.h"
#include "model/scenario.h"
#include "validation/subject/subject.h"

namespace ursula {

/// What Simbody's loop says at one instant of the commanded motion, and what it makes of the right solver's answers:
/// whoever answers the same to the last bit need not ask again.
struct SimbodyAnswer {
  JointMotion joints;
  Vector6d torques;  ///< its own inverse dynamics, N·m

  struct OfRight {
    Vector6d torques;      ///< the right solver's, N·m
    Motion<double> moved;  ///< the platform under them
    Reactions reactions;   ///< at the joints under them
    JointMotion joints;    ///< the right solver's
    BodyMotions<double> bodies;
  };
  std::optional<OfRight> right;  ///< none where the solver has no answer

  /// The platform under somebody's torques in the commanded state. `loop` is of the same scenario.
  Motion<double> platformUnder(const Vector6d& subjects, SimbodyLoop& loop, const Motion<double>& motion) const;
  /// The same for what the joints then bear.
  Reactions reactionsUnder(const Vector6d& subjects, SimbodyLoop& loop, const Motion<double>& motion) const;
  /// The bodies in somebody's joint state.
  BodyMotions<double> bodiesIn(const JointMotion& subjects, SimbodyLoop& loop, const Motion<double>& motion) const;
};

SimbodyAnswer simbodyAnswer(SimbodyLoop& loop, const Subject& right, const Motion<double>& motion);

std::vector<SimbodyAnswer> simbodyAnswers(const Scenario& scenario, const std::vector<double>& instants);

}  // namespace ursula
