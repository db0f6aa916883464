#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ursula {

/// The number at the start of a text.
struct LeadingNumber {
  double value = 0;
  std::size_t length = 0;  ///< 0 if the text begins with no number or with one outside a double's range
};

/// Reads digits as in the C locale, because a host program may set one with decimal commas. A leading plus is accepted,
/// white space is not.
LeadingNumber leadingNumber(std::string_view text);

/// Reads a percentage, with or without a space: "1%" is 0.01. Returns nullopt for other text.
std::optional<double> percentage(std::string_view text);

/// Returns the candidate at the least optimal string alignment distance from `word`, the first of equals. Returns an
/// empty string if that distance exceeds a third of the longer word's length (at least 1).
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

/// Returns `, did you mean 'mass'?`, or empty if no candidate is near.
std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates);

/// Returns a file name as one shell word: quoted if needed, and never an option.
std::string shellWord(const std::string& file);

/// Makes foreign text safe for a message and a terminal. Control characters and invalid UTF-8 become `\x1b` and the
/// like; lines stay.
std::string withoutControls(std::string_view text);

/// Returns the same for one cell or name: newlines are escaped, too. Text beyond `most` bytes is cut and marked by "…".
std::string shown(std::string_view text, std::size_t most = 80);

/// Returns a whole path of any length; a newline in it is escaped.
std::string shownPath(std::string_view path);

}  // namespace ursula
