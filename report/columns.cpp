#include "report/columns.h"

#include <algorithm>
#include <sstream>

namespace ursula::report {

std::size_t columnsOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string padded(const std::string& text, std::size_t width, Align align) {
  const std::size_t taken = columnsOf(text);
  const std::string space(width > taken ? width - taken : 0, ' ');
  return align == Align::left ? text + space : space + text;
}

std::vector<std::string> alignedRows(const std::vector<std::vector<std::string>>& rows,
                                     const std::vector<Align>& columns) {
  std::vector<std::size_t> widths(columns.size(), 0);
  for (const std::vector<std::string>& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], columnsOf(row[k]));
  std::vector<std::string> lines;
  for (const std::vector<std::string>& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) line += (k == 0 ? "" : "  ") + padded(row[k], widths[k], columns[k]);
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(line);
  }
  return lines;
}

std::string wrapped(const std::string& head, std::size_t margin, const std::string& text) {
  constexpr std::size_t width = 100;
  std::istringstream words(text);
  std::string out = padded(head, margin);
  std::size_t column = columnsOf(out);
  bool first = true;  // first word of the text or of a line
  for (std::string word; words >> word; first = false) {
    if (!first && column + 1 + columnsOf(word) > width) {
      out += "\n" + std::string(margin, ' ');
      column = margin;
      first = true;
    }
    out += (first ? "" : " ") + word;
    column += columnsOf(word) + (first ? 0 : 1);
  }
  return out + "\n";
}

std::string painted(const std::string& text, Paint paint, bool coloured) {
  if (!coloured) return text;
  const char* const codes[] = {"32", "1;31", "33", "2", "1"};
  return std::string("\033[") + codes[static_cast<int>(paint)] + "m" + text + "\033[0m";
}

}  // namespace ursula::report
