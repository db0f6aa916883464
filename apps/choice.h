#pragma once

#include <CLI/CLI.hpp>

#include <map>
#include <string>

namespace ursula {

/// Restricts the option to these names; help and error messages list them.
template <class Choice>
CLI::Option* takeOneOf(CLI::Option* option, const std::map<std::string, Choice>& choices) {
  std::string names;
  for (const auto& choice : choices) names += (names.empty() ? "" : "|") + choice.first;
  const auto number = [choices, names](std::string& text) {
    const auto found = choices.find(text);
    if (found == choices.end()) return "'" + text + "' is not one of " + names;
    text = std::to_string(static_cast<int>(found->second));
    return std::string();
  };
  return option->transform(CLI::Validator(number, "", ""))->type_name(names);
}

}  // namespace ursula
