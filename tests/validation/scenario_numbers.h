#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"

// Motions and loads as lists of named numbers, to find which of them differ among many scenarios.

namespace ursula {

struct NamedNumber {
  std::string name;
  double value = 0;
};

/// Duration and the motion at three instants.
inline std::vector<NamedNumber> motionNumbers(const Trajectory& trajectory) {
  std::vector<NamedNumber> out{{trajectory.kind() + ".duration", trajectory.duration()}};
  for (const double share : {0.0, 0.37, 1.0}) {
    const Motion<double> motion = trajectory.at(share * trajectory.duration());
    const std::string at = trajectory.kind() + " at " + std::to_string(share);
    for (int k = 0; k < 3; ++k) {
      out.push_back({at + ": p" + std::to_string(k), motion.p(k)});
      for (int j = 0; j < 3; ++j) out.push_back({at + ": Q" + std::to_string(3 * k + j), motion.Q(k, j)});
    }
  }
  return out;
}

/// Point, and the wrench at three instants.
inline std::vector<NamedNumber> loadNumbers(const Load& load, double duration) {
  const std::string kind = load.history ? "table" : "constant";
  std::vector<NamedNumber> out;
  for (int k = 0; k < 3; ++k) out.push_back({kind + " load's point" + std::to_string(k), load.point(k)});
  for (const double share : {0.0, 0.37, 1.0}) {
    const Wrench<double> wrench = load.at(share * duration);
    for (int k = 0; k < 3; ++k) {
      const std::string at = std::to_string(k) + " at " + std::to_string(share);
      out.push_back({kind + " force" + at, wrench.force(k)});
      out.push_back({kind + " moment" + at, wrench.moment(k)});
    }
  }
  return out;
}

}  // namespace ursula
