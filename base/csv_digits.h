#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/csv.h"

namespace ursula {

/// Returns the power of ten of the last digit of a printed, finite number; exponents beyond ±400 are clipped.
int lastPlace(std::string_view cell);

/// Returns half a unit of the last digit that most numbers of a column have; 0 if there is no such column.
inline double halfDigit(const CsvTable& table, const std::string& name) {
  const auto found = std::find(table.names.begin(), table.names.end(), name);
  if (found == table.names.end() || table.rows() == 0) return 0;
  std::vector<int> places = table.last_places[found - table.names.begin()];
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
  std::nth_element(places.begin(), middle, places.end());
  return 0.5 * std::pow(10.0, *middle);
}

}  // namespace ursula
