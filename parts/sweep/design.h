#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "parts/sweep/sweep_file.h"

namespace ursula {

/// The points [first, end).
struct PointRange {
  std::int64_t first = 0, end = 0;
};

/// One varied number with the scenario's own value.
struct VariedNumber {
  std::string key;  ///< without `*`
  Variation by;
  double nominal = 0;
};

/// The points of a sweep: the numbers at point i depend only on the sweep and i.
///
/// grid: the last number varies fastest. random: std::mt19937_64 seeded for each point by seed and index, both exactly
/// defined by the standard; uniform deviates of 53 bits, normal ones by the inverse distribution. sobol: Joe and Kuo's
/// points (SIAM J. Sci. Comput. 30, 2008, p. 2635) as in Boost, with a digital shift by the seed.
class SweepPoints {
 public:
  /// Throws ScenarioError if a grid exceeds most_points, or if sobol has too few dimensions for the numbers.
  SweepPoints(const SweepFile& sweep, std::vector<VariedNumber> numbers);

  std::int64_t count() const { return count_; }
  const std::vector<VariedNumber>& numbers() const { return numbers_; }
  /// Returns the values in the order of the numbers.
  std::vector<double> at(std::int64_t i) const;

 private:
  std::vector<double> uniforms(std::int64_t i) const;

  SweepDesign design_;
  std::uint64_t seed_;
  std::vector<VariedNumber> numbers_;
  std::int64_t count_ = 1;
  std::vector<std::uint64_t> shifts_;  ///< for sobol
};

}  // namespace ursula
