#include "model/scenario_files.h"

#include "base/toml_bounds.h"
#include "model/toml_reader.h"

namespace ursula {

Scenario readScenarioOrInput(const std::filesystem::path& file) {
  static constexpr const char* input = "<stdin>";
  if (file != "-") return readScenario(file);
  try {
    return parseScenario(readStandardInput({most_toml_bytes, "a scenario in TOML"}), input);
  } catch (const TextRefusal& refusal) {
    throw errorAt(input, refusal);
  }
}

}  // namespace ursula
