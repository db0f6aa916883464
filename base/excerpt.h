#pragma once

#include <cstddef>
#include <string>

namespace ursula {

/// A line of somebody's text with a caret below the sign at `column`; of a long one, what is around it. Both count from
/// 1, columns in characters. Empty where the text has no such line.
///
///      9 | mass = -350.0
///        |        ^
std::string excerptOf(const std::string& text, std::size_t line, std::size_t column);

}  // namespace ursula
