#pragma once

#include <optional>
#include <vector>

#include "model/loops/further_roads.h"
#include "model/scenario.h"
#include "validation/samples/pointwise.h"

namespace ursula {

/// The torques of the further roads at one instant, N·m; none where a road is not in this build.
using RoadTorques = OfFurtherRoads<std::optional<Vector6d>>;

/// The torques of all roads at one instant, for one subject.
struct RoadSample {
  double t = 0;
  Vector6d subject, simbody;  ///< N·m
  RoadTorques further;
  OfFurtherRoads<double> limits{};  ///< of rounding between the subject and each further road, N·m
  double limit = 0;                 ///< of rounding between any two, N·m
  Conditioning conditioning;
};

/// At the instants.
std::vector<RoadTorques> roadTorques(const Scenario& scenario, const std::vector<double>& instants);

/// `roads` are those at the instants of `samples`.
std::vector<RoadSample> runRoads(const std::vector<RoadTorques>& roads, const std::vector<PointwiseSample>& samples,
                                 const RoundingProfile& profile);
/// The further roads at the instants of `samples`.
std::vector<RoadSample> runRoads(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                 const RoundingProfile& profile);

}  // namespace ursula
