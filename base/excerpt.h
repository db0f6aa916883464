#pragma once

#include <cstddef>
#include <string>

namespace ursula {

/// Returns a line of the text with a caret below the character at `column`. A long line is cut around it. Both count
/// from 1, columns in characters. Empty if the text has no such line.
///
///      9 | mass = -350.0
///        |        ^
std::string excerptOf(const std::string& text, std::size_t line, std::size_t column);

}  // namespace ursula
