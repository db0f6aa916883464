#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/reactions.h"
#include "model/scenario.h"
#include "validation/pointwise.h"
#include "validation/result.h"
#include "validation/subject.h"

namespace ursula {

/// The torques of all roads at one instant, for one subject.
struct RoadSample {
  double t = 0;
  Vector6d subject, simbody, twin, maximal;                    ///< N·m
  double limit_twin = 0, limit_maximal = 0, limit_mujoco = 0;  ///< of rounding between subject and road, N·m
  std::optional<Vector6d> mujoco;                              ///< N·m; none in a build without MuJoCo
  double limit = 0;                                            ///< of rounding between any two, N·m
};

/// Simbody's twin (tree through leg 1, five balls), the maximal coordinates and MuJoCo at the instants of `samples`.
std::vector<RoadSample> runRoads(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                 const RoundingProfile& profile);

/// `torque.twin`, `torque.maximal`, and `torque.mujoco` where MuJoCo is built in: the subject against each further
/// road.
std::vector<Check> judgeRoads(const std::vector<RoadSample>& samples, const Units& units = {});

/// Which road stands alone when the others agree, in words; "none" where all agree.
std::string oddOneOut(const std::vector<RoadSample>& samples);

/// `reactions.pointwise`: the joint reactions recovered from the solver's road against Simbody's mobilizer and
/// constraint reactions; only for the formulas that hold. `spoil`, for controls that must fail, changes those
/// recovered.
Check judgeReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                     const RoundingProfile& profile, TimeSeries* series, const Units& units = {},
                     const std::function<void(Reactions&)>& spoil = nullptr);

/// The largest difference of a force, or of a moment over `length`, N.
double distance(const LegReactions& a, const LegReactions& b, double length);

}  // namespace ursula
