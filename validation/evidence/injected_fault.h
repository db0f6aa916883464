#pragma once

#include <functional>

#include "engines/further_engines.h"
#include "model/joint_reactions.h"
#include "model/scenario.h"
#include "validation/replay/replay.h"
#include "validation/samples/fast_samples.h"
#include "validation/samples/pointwise.h"

namespace ursula {

/// For controls that must fail: falsifies an experiment, and neither the subject nor the scenario. What is empty stays
/// right. All see the scenario in its natural units.
struct InjectedFault {
  /// The scenario as something takes it to be.
  using Seen = std::function<Scenario(const Scenario&)>;
  using Settings = std::function<void(ReplaySettings&)>;

  FastFault fast;                                ///< in the kernels that users call
  OfFurtherEngines<Seen> further;                ///< what each further formulation is built of
  Seen feedback;                                 ///< what the loop of the stabilised replay is built of
  std::function<void(PointwiseSample&)> sample;  ///< what was measured at one instant
  std::function<void(Reactions&)> reactions;     ///< those recovered from the solver's formulation
  Settings replay;                               ///< the judged replays
  bool lower_order = false;                      ///< another integrator, of order 5, as the one of integration.order
  Settings ladder;                               ///< the replays that they are compared with, of both integrators
};

}  // namespace ursula
