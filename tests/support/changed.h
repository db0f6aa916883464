#pragma once

#include <functional>
#include <memory>

#include "model/scenario.h"

namespace ursula {

using MachineChange = std::function<void(ManipulatorParameters&)>;

/// The scenario with another machine.
inline Scenario changed(Scenario scenario, const MachineChange& change) {
  ManipulatorParameters machine = scenario.manipulator->given();
  change(machine);
  scenario.manipulator = std::make_shared<const Manipulator>(machine);
  return scenario;
}

inline MachineChange ofEachLeg(const std::function<void(Leg&)>& change) {
  return [change](ManipulatorParameters& machine) {
    for (Leg& leg : machine.legs) change(leg);
  };
}

}  // namespace ursula
