#pragma once

#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/limits/conditioning.h"

namespace ursula {

/// Equally spaced instants in a scenario of any number of samples, which show how rounding varies along the motion.
constexpr int instants_along = 61;

/// `instants_along` equally spaced instants of the motion, and those at which the platform moves and accelerates most,
/// in order, s. Motions that stop at regular instants, or move in a short part of their time, show their sizes there.
std::vector<double> tellingInstants(const Scenario& scenario);

/// The size of each quantity along the whole motion: the one source of scales for limits and thresholds. The judged
/// samples are none, because they may all be at rest.
class MotionSizes {
 public:
  MotionSizes() = default;
  /// Throws PoseError like the solver.
  explicit MotionSizes(const Scenario& scenario, const Deadline& deadline = {});

  /// The largest Conditioning::size; 0 if the motion has nothing of it, as a held pose has no rates.
  double of(Rounded quantity) const { return sizes_[static_cast<std::size_t>(quantity)]; }
  /// One rounding of each size, the least limits. Where the size is 0, the machine would move by one rounding of its
  /// largest coordinate within the motion's duration.
  const RoundingLevels& floors() const { return floors_; }

 private:
  RoundingLevels sizes_ = uniformLevels(0), floors_ = uniformLevels(0);
};

}  // namespace ursula
