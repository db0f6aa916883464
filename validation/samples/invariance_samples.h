#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/subject.h"

namespace ursula {

/// Changes that leave the physics unchanged, or change torques in a known way.
enum class Symmetry {
  rotation,       ///< the whole world rotated with gravity: torques stay
  axes,           ///< other axes on the platform, another origin: torques stay
  units,          ///< other units of length, mass and time: torques stay
  labels,         ///< legs relabelled: torques move with them
  mass,           ///< masses, inertias and friction doubled: torques double
  time_reversal,  ///< the mean of forward and backward motion gives the torques without friction
};

/// The two sides of a symmetry at the samples, N·m.
struct InvarianceSamples {
  Symmetry symmetry;
  std::vector<Vector6d> expected, found;
  std::string refused;  ///< why the subject has no answer at the next sample; else empty
};

/// Evaluates each symmetry at the motions of `samples`; none if the subject cannot be created for another machine.
std::vector<InvarianceSamples> runInvariances(const Scenario& scenario, const Subject& subject,
                                              const std::vector<PointwiseSample>& samples);

}  // namespace ursula
