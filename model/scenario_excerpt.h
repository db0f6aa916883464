#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// A ScenarioError that knows its line and column, both from 1, and can show them. It may stand for several errors; the
/// place is that of the first.
class PlacedError : public ScenarioError {
 public:
  PlacedError(const std::string& what, std::size_t line, std::size_t column)
      : ScenarioError(what), line_(line), column_(column) {}

  /// Returns several errors as one, with a line for each; `errors` is not empty.
  static PlacedError together(const std::vector<PlacedError>& errors);
  /// Adds the excerpt of `text`, the whole file.
  PlacedError in(const std::string& text) const;
  /// Returns what() with the line and a caret below each error, for people; empty if no line is known.
  const std::string& atLength() const { return at_length_; }
  std::pair<std::size_t, std::size_t> position() const { return {line_, column_}; }

 private:
  std::size_t line_, column_;
  std::string at_length_;
};

/// Returns the error's text, with its place below if that is known.
std::string atLength(const ScenarioError& error);

}  // namespace ursula
