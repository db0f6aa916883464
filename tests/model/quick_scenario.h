#pragma once

#include <string>

#include "tests/model/scenario_text.h"

namespace ursula {

/// A short motion at few instants: some tenths of a second to validate.
inline std::string quickScenario(const std::string& name = "small", const std::string& mass = "500.0") {
  std::string text = replaced(good_scenario, "name = \"small\"", "name = \"" + name + "\"");
  text = replaced(replaced(text, "duration = 3.0", "duration = 0.3"), "mass = 500.0", "mass = " + mass);
  return text + "\n[simulation]\nsamples = 3\n";
}

}  // namespace ursula
