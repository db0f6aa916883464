#pragma once

#include <optional>
#include <vector>

#include "engines/further_engines.h"
#include "model/scenario.h"
#include "validation/samples/pointwise.h"

namespace ursula {

/// The torques of the further formulations at one instant, N·m; none where a formulation is not in this build.
using EngineTorques = OfFurtherEngines<std::optional<Vector6d>>;

/// The torques of all formulations at one instant, for one subject.
struct EngineSample {
  double t = 0;
  Vector6d subject, simbody;  ///< N·m
  EngineTorques further;
  OfFurtherEngines<double> limits{};  ///< of rounding between the subject and each further formulation, N·m
  double limit = 0;                   ///< of rounding between any two, N·m
};

/// At the instants.
std::vector<EngineTorques> engineTorques(const Scenario& scenario, const std::vector<double>& instants);

/// `formulations` are those at the instants of `samples`.
std::vector<EngineSample> runEngines(const std::vector<EngineTorques>& engines,
                                     const std::vector<PointwiseSample>& samples, const RoundingProfile& profile);
/// The further formulations at the instants of `samples`.
std::vector<EngineSample> runEngines(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                     const RoundingProfile& profile);

}  // namespace ursula
