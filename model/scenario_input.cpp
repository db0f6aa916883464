#include "model/scenario_input.h"

#include <iostream>
#include <iterator>

namespace ursula {

Scenario readScenarioOrInput(const std::filesystem::path& file) {
  if (file != "-") return readScenario(file);
  return parseScenario({std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()}, "<stdin>");
}

}  // namespace ursula
