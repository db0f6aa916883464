#pragma once

#include <optional>

#include "nocsolver/chain_solver.h"
#include "nocsolver/direct_kinematics.h"

namespace ursula::chain {

/// The pose at which the driven coordinates are `driven` that continues `from`, by Newton with T of (24). None where
/// steps do not shrink as they must near a solution, or where a leg cannot follow.
std::optional<PlatformPose> track(const ChainSolver<double>& solver, const Vector6d& driven, const PlatformPose& from);

}  // namespace ursula::chain
