#pragma once

#include <optional>

#include "nocsolver/noc/noc.h"
#include "parts/poses/direct_kinematics.h"

namespace ursula::poses {

/// Finds the pose with the driven coordinates `driven` that continues `from`, by Newton's method with T of (24).
/// Returns nullopt if the steps do not shrink as they do near a solution, or if a leg cannot follow.
std::optional<PlatformPose> track(const Noc<double>& solver, const Vector6d& driven, const PlatformPose& from);

}  // namespace ursula::poses
