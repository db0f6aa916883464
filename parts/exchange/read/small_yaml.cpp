#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/text.h"
#include "base/text_source.h"
#include "parts/exchange/read/urdf_parts.h"

namespace ursula::exchange {
namespace {

/// Splits at brackets, commas, list dashes and white space; drops quotes.
void appendWords(const std::string& text, std::vector<std::string>& out) {
  std::string word;
  char quote = 0;
  const auto end = [&] {
    if (!word.empty() && word != "-") out.push_back(word);
    word.clear();
  };
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '#') {
      break;
    } else if (c == '[' || c == ']' || c == ',' || c == ' ' || c == '\t' || c == '\r') {
      end();
    } else {
      word += c;
    }
  }
  end();
}

}  // namespace

SmallYaml readSmallYaml(const std::filesystem::path& file) {
  requireInFolder(file, file.parent_path());
  const std::string name = file.filename().string();
  SmallYaml out;
  std::istringstream lines(readText(file, {1 << 20, "robot.yaml"}));
  std::string line, key;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t from = line.find_first_not_of(" \t\r");
    if (from == std::string::npos || line[from] == '#' || line.compare(0, 3, "---") == 0) continue;
    if (line.find_first_of("{&*|>!") != std::string::npos)
      throw ImportError(
          fmt::format("{}:{}: '{}' is neither a list nor a word, expected `key: [a, b]`", name, number, shown(line)));
    const std::size_t colon = line.find(':');
    if (from == 0 && line[0] != '-' && line[0] != '[' && colon != std::string::npos) {
      key = line.substr(0, colon);
      if (!out.try_emplace(key).second)
        throw ImportError(fmt::format("{}:{}: a second '{}', expected one", name, number, shown(key)));
      appendWords(line.substr(colon + 1), out[key]);
    } else if (key.empty()) {
      throw ImportError(fmt::format("{}:{}: '{}' is of no key, expected `key: [a, b]`", name, number, shown(line)));
    } else {
      appendWords(line, out[key]);
    }
  }
  return out;
}

}  // namespace ursula::exchange
