#pragma once

#include <optional>
#include <vector>

#include "model/scenario.h"
#include "validation/samples/pointwise.h"

namespace ursula {

/// The torques of all roads at one instant, for one subject.
struct RoadSample {
  double t = 0;
  Vector6d subject, simbody, twin, maximal;                    ///< N·m
  double limit_twin = 0, limit_maximal = 0, limit_mujoco = 0;  ///< of rounding between subject and road, N·m
  std::optional<Vector6d> mujoco;                              ///< N·m; none in a build without MuJoCo
  double limit = 0;                                            ///< of rounding between any two, N·m
  Conditioning conditioning;
};

/// Those of one instant that do not depend on the subject, N·m.
struct RoadTorques {
  Vector6d twin, maximal;
  std::optional<Vector6d> mujoco;
};

/// At the motions of `samples`.
std::vector<RoadTorques> roadTorques(const Scenario& scenario, const std::vector<PointwiseSample>& samples);

/// `roads` are those at the instants of `samples`.
std::vector<RoadSample> runRoads(const std::vector<RoadTorques>& roads, const std::vector<PointwiseSample>& samples,
                                 const RoundingProfile& profile);
/// Simbody's twin (tree through leg 1, five balls), the maximal coordinates and MuJoCo at the instants of `samples`.
std::vector<RoadSample> runRoads(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                 const RoundingProfile& profile);

}  // namespace ursula
