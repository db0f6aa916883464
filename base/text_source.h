#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace ursula {

/// Of text that cannot be taken as input: what is wrong, what was expected, and where; both from 1.
class TextRefusal : public std::runtime_error {
 public:
  explicit TextRefusal(const std::string& what, std::size_t in_line = 1, std::size_t in_column = 1)
      : std::runtime_error(what), line(in_line), column(in_column) {}

  std::size_t line, column;
};

/// How much text a source may give, and what it is, for people.
struct TextBounds {
  std::size_t most_bytes = 0;
  const char* kind = "";  ///< "a scenario in TOML"
};

/// All of a file, a pipe or a device, of which no more is read than is allowed. Throws TextRefusal where it is a folder
/// or cannot be read, at its first zero byte, and where there is more.
std::string readText(const std::filesystem::path& file, const TextBounds& bounds);

/// The same of standard input.
std::string readStandardInput(const TextBounds& bounds);

/// Throws TextRefusal for a path with a zero byte, which the system would cut off there, and for an empty one.
void requirePath(const std::string& path);

}  // namespace ursula
