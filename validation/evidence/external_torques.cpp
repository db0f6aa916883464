#include "validation/evidence/external_torques.h"

#include <fmt/format.h>

#include <algorithm>

namespace ursula {

double ExternalTorques::largestPrecision() const {
  double largest = 0;
  for (const Vector6d& row : precision) largest = std::max(largest, row.maxCoeff());
  return largest;
}

std::string ExternalTorques::precisionInWords(const Units& units) const {
  const double largest = largestPrecision();
  return largest == 0 ? "; the file's digits are as fine as doubles and add nothing"
                      : fmt::format(
                            "; and half a unit of the last digit printed (torques of up to {} significant digits, "
                            "instants), up to {:.3g} {}",
                            file.digits, largest * units.effort(), units.efforts.unit);
}

}  // namespace ursula
