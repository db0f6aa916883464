#include "apps/suite/no_model.h"

#include <fmt/format.h>

#include "base/text.h"
#include "model/mechanism_scenario.h"
#include "model/scenario_files.h"

namespace ursula {

std::string scenarioNotModel(const std::filesystem::path& file) {
  std::string text = scenarioTextOrInput(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n", text.rfind("\xEF\xBB\xBF", 0) == 0 ? 3 : 0);
  if (first == std::string::npos || text[first] != '<') return text;
  const ModelAdvice advice = partModelAdvice();
  const std::string how = file == "-" || advice == nullptr ? "ursula import or ursula init --model" : advice(file);
  throw ScenarioError(fmt::format("{}: error: this is a model, and a scenario is expected, which {} makes of it",
                                  shownPath(namedInput(file).string()), how));
}

}  // namespace ursula
