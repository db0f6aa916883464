// A scenario's text. An accepted scenario has a motion.

#include <cmath>
#include <cstdlib>

#include "model/scenario.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const ursula::Scenario scenario = ursula::parseScenario(ursula::fuzz::textOf(data, size), "/nowhere/fuzz.toml");
    const double duration = scenario.trajectory->duration();
    if (!(duration > 0) || !std::isfinite(duration)) std::abort();
    scenario.trajectory->at(duration / 2);
    ++ursula::fuzz::accepted;
  } catch (const ursula::ScenarioError&) {
  }
  return 0;
}
