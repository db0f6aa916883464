#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "studies/sweep/sweep_file.h"

namespace ursula {

/// Points [first, end).
struct PointRange {
  std::int64_t first = 0, end = 0;
};

/// One number that varies, with what the scenario gives it.
struct VariedNumber {
  std::string key;  ///< without `*`
  Variation by;
  double nominal = 0;
};

/// The points of a sweep: what each number is at point i, from the sweep and i alone.
///
/// grid: the last number varies fastest. random: std::mt19937_64, seeded for each point by seed and index, both of
/// which the standard lays down to the last bit; uniform deviates of 53 bits, normal ones by the inverse of the
/// distribution. sobol: Joe and Kuo's points (SIAM J. Sci. Comput. 30, 2008, p. 2635) as Boost has them, shifted
/// digitally by the seed.
class SweepPoints {
 public:
  /// Throws ScenarioError where a grid has more than most_points, or sobol more numbers than it has dimensions.
  SweepPoints(const SweepFile& sweep, std::vector<VariedNumber> numbers);

  std::int64_t count() const { return count_; }
  const std::vector<VariedNumber>& numbers() const { return numbers_; }
  /// In the numbers' order.
  std::vector<double> at(std::int64_t i) const;

 private:
  std::vector<double> uniforms(std::int64_t i) const;

  SweepDesign design_;
  std::uint64_t seed_;
  std::vector<VariedNumber> numbers_;
  std::int64_t count_ = 1;
  std::vector<std::uint64_t> shifts_;  ///< of sobol
};

}  // namespace ursula
