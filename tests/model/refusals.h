#pragma once

#include <gmock/gmock.h>

#include <exception>
#include <string>
#include <tuple>

#include "base/errors.h"
#include "model/scenario.h"
#include "tests/model/scenario_text.h"

namespace ursula {

/// Returns the message of the E that `call` throws. If it throws none, the test fails and the text equals nothing.
template <class E, class Call>
std::string refusal(Call&& call) {
  try {
    std::forward<Call>(call)();
  } catch (const E& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another type of exception: " << error.what();
    return "(another type)";
  }
  ADD_FAILURE() << "nothing thrown";
  return "(nothing thrown)";
}

/// Returns the refusal of a scenario, without the file and place if the place is that of the '@' in the text.
inline std::string refusalAtMark(const std::string& text, const std::string& file = "a.toml") {
  const MarkedText changed = marked(text);
  const std::string message = refusal<ScenarioError>([&] { parseScenario(changed.text, file); });
  const std::string start = file + ":" + changed.place + ": error: ";
  return message.compare(0, start.size(), start) == 0 ? message.substr(start.size()) : message;
}

/// Returns place, value and bound of the InvalidParameter that `call` throws.
template <class Call>
std::tuple<std::string, std::string, std::string> refusedParameter(Call&& call) {
  try {
    std::forward<Call>(call)();
  } catch (const InvalidParameter& error) {
    return {error.place(), error.value(), error.bound()};
  }
  ADD_FAILURE() << "nothing thrown";
  return {};
}

}  // namespace ursula
