#pragma once

#include <toml++/toml.h>

#include <string>

#include "model/number_tolerances.h"

namespace ursula {

/// Leaves the number X, or the array X of numbers, where a document says `{ value = X, tolerance = Y }`, and returns
/// each Y by the dotted path of its number: tables of an array count from 1, entries of an array of numbers from 0. Of
/// an array, Y is one for all entries or an array as long. Throws ScenarioError with the place for any other table
/// with a `value`.
NumberTolerances takeTolerances(toml::table& document, const std::string& file);

}  // namespace ursula
