#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/subject.h"

namespace ursula {

/// What changes no physics, or changes torques in a known way.
enum class Symmetry {
  rotation,       ///< the whole world turned, gravity included: the torques stay
  axes,           ///< other axes on the platform, another origin: the torques stay
  units,          ///< other units of length, mass and time: the torques stay
  labels,         ///< legs relabelled: they carry their torques along
  mass,           ///< masses, inertias and friction doubled: so are the torques
  time_reversal,  ///< the mean of forwards and backwards is the torques without friction
};

/// The two sides of a symmetry at the samples, N·m.
struct InvarianceSamples {
  Symmetry symmetry;
  std::vector<Vector6d> expected, found;
  std::string refused;  ///< why the subject has no answer at the next sample; empty where it has all
};

/// Each symmetry at the motions of `samples`; none of a subject that cannot be made for another machine.
std::vector<InvarianceSamples> runInvariances(const Scenario& scenario, const Subject& subject,
                                              const std::vector<PointwiseSample>& samples);

}  // namespace ursula
