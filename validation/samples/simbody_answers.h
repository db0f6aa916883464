#pragma once

#include <optional>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "simbody/simbody_loop.h"
#include "validation/limits/formulation_faults.h"
#include "validation/subject/subject.h"

namespace ursula {

/// Results of Simbody's loop at one instant of the commanded motion, also under the right solver's torques. Subjects
/// with bitwise equal answers reuse them. They are stored for every instant, so only expensive results are included.
struct SimbodyAnswer {
  Vector6d torques;  ///< its own inverse dynamics, N·m

  struct OfRight {
    Vector6d torques, twist_rate;  ///< the right solver's, N·m; the platform's under these, [ω̇; p̈]
  };
  std::optional<OfRight> right;  ///< nullopt if the solver has no answer

  /// [ω̇; p̈] of the platform under the torques `subjects` in the commanded state. `loop` is of the same scenario.
  Vector6d twistRateUnder(const Vector6d& subjects, SimbodyLoop& loop, const Motion<double>& motion) const;
};

SimbodyAnswer simbodyAnswer(SimbodyLoop& loop, const Subject& right, const Motion<double>& motion);

std::vector<SimbodyAnswer> simbodyAnswers(const Scenario& scenario, const std::vector<double>& instants,
                                          const Deadline& deadline = {}, const EngineFault& fault = {});

}  // namespace ursula
