#pragma once

#include <optional>

#include "nocsolver/noc/noc.h"
#include "nocsolver/poses/direct_kinematics.h"

namespace ursula::poses {

/// The pose at which the driven coordinates are `driven` that continues `from`, by Newton with T of (24). None where
/// steps do not shrink as they must near a solution, or where a leg cannot follow.
std::optional<PlatformPose> track(const Noc<double>& solver, const Vector6d& driven, const PlatformPose& from);

}  // namespace ursula::poses
