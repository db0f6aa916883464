#pragma once

#include <functional>
#include <memory>

#include "model/joint_variables.h"
#include "model/scenario.h"
#include "validation/limits/formulation_faults.h"
#include "validation/replay/replay.h"
#include "validation/samples/pointwise.h"

namespace ursula {

/// A fault in a part's experiment; the part derives its own.
struct WitnessFault {
  virtual ~WitnessFault() = default;
};

/// Falsifies an experiment for negative controls, but neither the subject nor the scenario. Empty members change
/// nothing. All of them see the scenario in its natural units.
struct InjectedFault {
  using ScenarioChange = std::function<Scenario(const Scenario&)>;
  using Settings = std::function<void(ReplaySettings&)>;

  std::shared_ptr<const WitnessFault> witness;   ///< in what a part asks
  FormulationFaults formulations;                ///< in the engines and the NOC, also where rounding is measured
  ScenarioChange feedback;                       ///< the machine in the loop of the stabilised replay
  std::function<void(PointwiseSample&)> sample;  ///< changes the measurement at one instant
  std::function<void(Reactions&)> reactions;     ///< changes the reactions from the solver's formulation
  Settings replay;                               ///< the judged replays
  bool lower_order = false;                      ///< another integrator, of order 5, for integration.order
  Settings ladder;                               ///< the replays of the ladder, with both integrators
};

}  // namespace ursula
