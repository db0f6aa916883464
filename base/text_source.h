#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace ursula {

/// Thrown for a text that is refused as input; the message says what is wrong and what was expected. Line and column
/// are 1-based; both are 0 if the text as a whole is refused.
class TextRefusal : public std::runtime_error {
 public:
  explicit TextRefusal(const std::string& what, std::size_t in_line = 0, std::size_t in_column = 0)
      : std::runtime_error(what), line(in_line), column(in_column) {}

  std::size_t line, column;
};

/// The largest size of a text, and its kind for messages.
struct TextBounds {
  std::size_t most_bytes = 0;
  const char* kind = "";  ///< "a scenario in TOML"
};

/// Reads a file, a pipe or a device up to the allowed size. Throws TextRefusal if it is a folder, unreadable, too long,
/// or a pipe that nobody writes to within half a second, and at its first zero byte.
std::string readText(const std::filesystem::path& file, const TextBounds& bounds);

/// Reads the same from standard input.
std::string readStandardInput(const TextBounds& bounds);

/// Throws TextRefusal for an empty path and for one with a zero byte, where the system would cut it off.
void requirePath(const std::string& path);

/// Returns a line of the text with a caret below the character at `column`. A long line is cut around it. Both count
/// from 1, columns in characters. Empty if the text has no such line.
///
///      9 | mass = -350.0
///        |        ^
std::string excerptOf(const std::string& text, std::size_t line, std::size_t column);

}  // namespace ursula
