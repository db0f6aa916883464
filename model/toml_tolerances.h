#pragma once

#include <toml++/toml.h>

#include <string>

#include "model/number_tolerances.h"

namespace ursula {

/// Replaces `{ value = X, tolerance = Y }` by X, a number or an array of numbers. Returns each Y by the dotted path of
/// its number. Tables of an array count from 1, entries of an array of numbers from 0. For an array, Y is one number
/// for all entries or an array of the same length. Throws ScenarioError with the place for any other table with a
/// `value`.
NumberTolerances takeTolerances(toml::table& document, const std::string& file);

}  // namespace ursula
