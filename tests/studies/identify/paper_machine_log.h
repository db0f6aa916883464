#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "model/machine_numbers.h"
#include "parts/identify/identify.h"
#include "tests/studies/identify/synthetic_log.h"

namespace ursula {

/// The paper's machine with friction and with tolerances of 1 %.
class Identify : public testing::Test {
 protected:
  void SetUp() override {
    scenario = readScenario(std::string(URSULA_SCENARIOS) + "/paper-helix.toml");
    truth = scenario.manipulator->parameters();
    how.motion_noise = 1e-9;  // the motion passes near a singular pose, where noise of the coordinates is large
    for (Leg& leg : truth.legs) {
      leg.friction.phi = 20;
      leg.coulomb.phi = 5;
    }
    scenario.manipulator = std::make_shared<Manipulator>(truth);
    for (const MachineNumber& number : machineNumbers(truth))
      if (number.group() == NumberGroup::mass || number.group() == NumberGroup::center ||
          number.quantity == Quantity::friction || number.quantity == Quantity::coulomb)
        options.tolerances[number.path] = std::max(0.01 * number.size(truth), 1e-6);
  }

  /// Joint 3 yields to its efforts, not to their noise.
  IdentifyResult runWithCompliance() {
    SyntheticRows rows = syntheticRows(scenario, truth, how);
    how.effort_noise = 0;
    rows.motion.col(2) += 1e-7 * syntheticRows(scenario, truth, how).efforts.col(2);
    return identify(scenario, logOf(rows, scenario), options);
  }

  IdentifyResult run() { return identify(scenario, logOf(syntheticRows(scenario, truth, how), scenario), options); }

  Scenario scenario;
  ManipulatorParameters truth;
  SyntheticLog how;
  IdentifyOptions options;
};

}  // namespace ursula
