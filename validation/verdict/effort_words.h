#pragma once

#include <string>

#include "model/manipulator.h"
#include "validation/verdict/result.h"

namespace ursula {

/// What an effort of these motors is called: "force" where all of them slide, "effort" where some do, "torque" else.
std::string effortNoun(const Motors& motors);
/// Of the machine that was judged; "torque" where that is not known.
std::string effortNoun(const ValidationResult& result);

/// A text that was written for torques, about efforts that are called `noun`. Names of checks, options, columns and
/// files stay as they are.
std::string inEffortWords(const std::string& noun, const std::string& text);

/// Every text of the result, in the words of its efforts.
void sayEfforts(ValidationResult& result);

}  // namespace ursula
