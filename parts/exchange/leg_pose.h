#pragma once

#include <stdexcept>

#include "model/legs/leg_chain.h"

namespace ursula::exchange {

/// A pose that a leg cannot take. Gives the leg, counted from 1, the number and its bound.
class UnreachablePose : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// A leg at a pose, in B.
struct LegPose {
  LegChain chain;
  Vector3d q;  ///< rad or m
  PlacedChain at;
};

/// Places leg `index`, 0-based, so that it ends at `tip`, m, in B. Throws UnreachablePose if the tip is out of reach or
/// the leg is singular.
LegPose legPose(const Leg& leg, int index, const Vector3d& tip);

}  // namespace ursula::exchange
