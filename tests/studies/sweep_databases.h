#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "parts/sweep/sweep_database.h"

namespace ursula::test {

/// A database of a sweep that was not run, in the test's folder.
struct MadeSweep {
  SweepIdentity identity;
  std::vector<SweepPoint> points;

  /// Adds a point with the next id; `values` in the order of the identity's keys.
  SweepPoint& add(const std::vector<double>& values, const std::string& verdict = "pass",
                  const std::string& error = "");
  /// Adds a result that is no check.
  static void result(SweepPoint& point, const std::string& name, double value);
  static void check(SweepPoint& point, const std::string& name, double value, double limit, const std::string& verdict);

  /// Writes the database and opens it for reading.
  std::unique_ptr<Sqlite> written(const std::string& name) const;
};

MadeSweep madeSweep(const std::string& what, const std::string& design, const std::vector<std::string>& keys,
                    std::int64_t points);

/// Uniform in [0, 1), the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  double roll();

 private:
  std::uint64_t state_;
};

}  // namespace ursula::test
