#pragma once

#include <string>
#include <vector>

namespace ursula {

/// Returns the candidate at the least optimal string alignment distance from `word`, the first of equals. Returns an
/// empty string if that distance exceeds a third of the longer word's length (at least 1).
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

/// `, did you mean 'mass'?`, or empty if no candidate is near.
std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace ursula
