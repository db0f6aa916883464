#pragma once

#include <optional>
#include <vector>

#include "engines/simbody/simbody_loop.h"
#include "model/scenario.h"
#include "validation/subject/subject.h"

namespace ursula {

/// What Simbody's loop says at one instant of the commanded motion, and what it makes of the right solver's answers:
/// whoever answers the same to the last bit need not ask again. Kept for every instant, and so no more than is dear.
struct SimbodyAnswer {
  Vector6d torques;  ///< its own inverse dynamics, N·m

  struct OfRight {
    Vector6d torques, twist_rate;  ///< the right solver's, N·m; the platform's under them, [ω̇; p̈]
  };
  std::optional<OfRight> right;  ///< none where the solver has no answer

  /// [ω̇; p̈] of the platform under somebody's torques in the commanded state. `loop` is of the same scenario.
  Vector6d twistRateUnder(const Vector6d& subjects, SimbodyLoop& loop, const Motion<double>& motion) const;
};

SimbodyAnswer simbodyAnswer(SimbodyLoop& loop, const Subject& right, const Motion<double>& motion);

std::vector<SimbodyAnswer> simbodyAnswers(const Scenario& scenario, const std::vector<double>& instants);

}  // namespace ursula
