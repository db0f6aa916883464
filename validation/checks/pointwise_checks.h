#pragma once

#include <vector>

#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The checks of these samples: `kinematics.*`, `torque.pointwise`, `acceleration.pointwise`. `units` convert the
/// samples to SI for the words.
std::vector<Check> judgePointwise(const std::vector<PointwiseSample>& samples, bool has_kinematics,
                                  const Units& units = {});

/// For samples of runJointsAndTorques: `kinematics.joint_*` and `torque.pointwise`, by their derived limits.
std::vector<Check> judgeJointsAndTorques(const std::vector<PointwiseSample>& samples, const Units& units = {});

}  // namespace ursula
