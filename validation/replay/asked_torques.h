#pragma once

#include <vector>

#include "simbody/simbody_loop.h"

namespace ursula {

/// Records the questions to a history of torques, in order, and its answers. A run that depends on nothing else and
/// gets bitwise equal answers ends equally, so it need not be repeated.
class AskedTorques {
 public:
  /// Wraps `torques` so that every question and answer is recorded here. Keeps a reference to both.
  SimbodyLoop::TorqueHistory recorded(const SimbodyLoop::TorqueHistory& torques);
  /// Appends the record of `more`.
  void add(const AskedTorques& more);
  /// Whether `torques` gives all these answers. False if nothing was asked or if it throws.
  bool sameFrom(const SimbodyLoop::TorqueHistory& torques) const;

 private:
  struct Answer {
    double t = 0;
    Vector6d torques;
    bool given = false;  ///< false if it threw
  };
  std::vector<Answer> answers_;
};

}  // namespace ursula
