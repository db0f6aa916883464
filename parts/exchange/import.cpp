#include "parts/exchange/import.h"

#include <fmt/format.h>

#include "model/mechanism_scenario.h"
#include "parts/exchange/mechanism_reader.h"
#include "parts/exchange/model_text.h"
#include "parts/exchange/recognise/machine.h"

namespace ursula::exchange {
namespace {

/// Requires that the written scenario can be read. Numbers that no scenario may have are the file's fault.
void requireReadable(const std::string& scenario) {
  try {
    static_cast<void>(parseScenario(scenario, "scenario"));
  } catch (const ScenarioError& error) {
    throw ImportError(fmt::format("its scenario would be refused: {}", error.what()));
  }
}

}  // namespace

ModelGraph readModel(const std::filesystem::path& file) {
  return inFile(file, [&] { return readGraph(file); });
}

Imported importModel(const std::filesystem::path& file, const ImportChoices& choices) {
  return inFile(file, [&] {
    const ImportedMachine machine = recognise(readGraph(file), choices);
    Imported out{scenarioText(machine, file.filename().string()), machine.assumptions};
    requireReadable(out.scenario);
    return out;
  });
}

std::string adviceOnModel(const std::filesystem::path& file) {
  const std::string model = shellWord(file.string());
  try {
    static_cast<void>(importModel(file, {}));
    return fmt::format("ursula import {} --out my.toml", model);
  } catch (const ImportError&) {
    static_cast<void>(readMechanismModel(file, {}));
    return fmt::format("ursula init my.toml --model {}", model);
  }
}

}  // namespace ursula::exchange

namespace ursula {

/// The row of this part.
ModelAdvice addModelAdvice() { return exchange::adviceOnModel; }

}  // namespace ursula
