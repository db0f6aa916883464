#pragma once

#include <gmock/gmock.h>

#include <exception>
#include <string>
#include <tuple>

#include "base/errors.h"

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
