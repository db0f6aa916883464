#pragma once

#include <string>

#include "model/manipulator.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Returns the noun for these motors' efforts: "force" if all slide, "effort" if some do, otherwise "torque".
std::string effortNoun(const Motors& motors);

/// Rewrites a text about torques with `noun` for the efforts. Names of checks, options, columns and files stay as they
/// are.
std::string inEffortWords(const std::string& noun, const std::string& text);

/// Rewrites every text of the result in its efforts' noun.
void addEffortWords(ValidationResult& result);

}  // namespace ursula
