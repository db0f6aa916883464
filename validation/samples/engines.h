#pragma once

#include <optional>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/limits/further_engines.h"
#include "validation/samples/pointwise.h"

namespace ursula {

/// The torques of the further formulations at one instant, N·m; nullopt for those missing in this build.
using EngineTorques = OfFurtherEngines<std::optional<Vector6d>>;

/// The torques of all formulations at one instant, for one subject.
struct EngineSample {
  double t = 0;
  Vector6d subject, simbody;  ///< N·m
  EngineTorques further;
  OfFurtherEngines<double> limits{};  ///< rounding limits between the subject and each further formulation, N·m
  double limit = 0;                   ///< the same between the subject and Simbody
};

/// Computes the torques of all further formulations at the instants.
std::vector<EngineTorques> engineTorques(const Scenario& scenario, const std::vector<double>& instants,
                                         const Deadline& deadline = {},
                                         const OfFurtherEngines<EngineFault>& faults = {});

/// Combines the subject's torques with `engines`, which are those at the instants of `samples`.
std::vector<EngineSample> runEngines(const std::vector<EngineTorques>& engines,
                                     const std::vector<PointwiseSample>& samples, const RoundingProfile& profile);
/// Computes the further formulations at the instants of `samples`.
std::vector<EngineSample> runEngines(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                     const RoundingProfile& profile);

}  // namespace ursula
