#pragma once

#include <vector>

#include "engines/simbody/simbody_loop.h"

namespace ursula {

/// What was asked of a history of torques, in order, and what it answered. Who asks nothing else of it and meets the
/// same answers to the last bit asks the same again and comes to the same end: then nothing need be done twice.
class AskedTorques {
 public:
  /// `torques`, with each question and its answer written down here. Keeps a reference to both.
  SimbodyLoop::TorqueHistory of(const SimbodyLoop::TorqueHistory& torques);
  /// What `more` was asked after this.
  void add(const AskedTorques& more);
  /// True where `torques` answers all of it the same. False, too, where nothing was asked, and where it throws.
  bool sameFrom(const SimbodyLoop::TorqueHistory& torques) const;

 private:
  struct Answer {
    double t = 0;
    Vector6d torques;
    bool given = false;  ///< false where it threw
  };
  std::vector<Answer> answers_;
};

}  // namespace ursula
