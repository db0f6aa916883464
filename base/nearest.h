#pragma once

#include <string>
#include <vector>

namespace ursula {

/// The candidate that `word` was most likely meant to be: the one at the least Damerau–Levenshtein distance, where that
/// is at most a third of the longer word's length (at least 1); empty where none is near. The first of equals wins.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

/// `, did you mean 'mass'?`, or nothing where no candidate is near.
std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace ursula
