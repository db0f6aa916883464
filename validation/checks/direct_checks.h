#pragma once

#include <vector>

#include "model/scenario.h"
#include "validation/limits/amplification.h"
#include "validation/replay/replay.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/presentation.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `direct.pointwise`: the subject's direct dynamics (36) against Simbody's, under the commanded torques and with each
/// motor's changed in turn, so that every column of the mass matrix shows. Only for subjects that have it.
Check judgeDirect(const Scenario& scenario, const Subject& subject, const std::vector<PointwiseSample>& samples,
                  const RoundingProfile& profile, const Units& units = {});

/// `direct.growth`: how a deviation grows by the variational equations of the subject's direct dynamics, against what
/// it does in Simbody's loop, really put off the path by as much either way. `torques` are the right ones,
/// `acceleration_rounding` what rounding may make of the platform's acceleration at t, `tolerance` that of the coarser
/// replays. `second_look`: what fails is replayed once more, with steps to where a joint with Coulomb friction turns
/// about.
Check judgeGrowth(const Scenario& scenario, const Subject& subject, const SimbodyLoop::TorqueHistory& torques,
                  const Amplification& amplification, const std::function<double(double)>& acceleration_rounding,
                  double tolerance, const Units& units = {}, bool second_look = true);

}  // namespace ursula
