#pragma once

#include <string>

#include "model/scenario.h"

namespace ursula {

/// A ScenarioError that knows its line and column, both from 1, and can show them.
class PlacedError : public ScenarioError {
 public:
  PlacedError(const std::string& what, std::size_t line, std::size_t column)
      : ScenarioError(what), line_(line), column_(column) {}

  /// Adds the excerpt of `text`, the whole file.
  PlacedError in(const std::string& text) const;
  /// Returns the line with a caret below, for people; empty if the line is unknown.
  const std::string& excerpt() const { return excerpt_; }

 private:
  std::size_t line_, column_;
  std::string excerpt_;
};

/// Returns the error's text, with its place below if that is known.
std::string atLength(const ScenarioError& error);

}  // namespace ursula
