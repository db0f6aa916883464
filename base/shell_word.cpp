#include "base/shell_word.h"

#include <cctype>

namespace ursula {

std::string shellWord(const std::string& file) {
  const std::string name = !file.empty() && file[0] == '-' ? "./" + file : file;
  bool is_plain = !name.empty();
  std::string out = "'";
  for (const char c : name) {
    is_plain = is_plain &&
               (std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string("/._-+,").find(c) != std::string::npos);
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return is_plain ? name : out + "'";
}

}  // namespace ursula
