#pragma once

#include <string>
#include <vector>

namespace ursula::report {

/// Appends `value` with six digits, more than a screen shows; null if it is not finite.
void addNumber(double value, std::string& out);

/// Returns "[…]" with the text that `add(item, out)` appends for each item.
template <class Items, class Add>
std::string jsonList(const Items& items, const Add& add) {
  std::string out = "[";
  for (const auto& item : items) {
    if (out.size() > 1) out += ',';
    add(item, out);
  }
  return out += ']';
}

std::string jsonNumbers(const std::vector<double>& values);

/// Returns a quoted string without "<", so neither "</script" nor "<!--" can end or break the surrounding block.
std::string jsonText(const std::string& words);

}  // namespace ursula::report
