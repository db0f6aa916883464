#pragma once

#include <string>
#include <vector>

namespace ursula::report {

/// Appends `value` with six digits, which are more than a screen shows; null where it is not finite.
void addNumber(double value, std::string& out);

/// "[…]" of what `add(item, out)` appends for each item.
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

/// A quoted string without any "<", so that neither "</script" nor "<!--" can end or derail the block that holds it.
std::string jsonText(const std::string& words);

}  // namespace ursula::report
