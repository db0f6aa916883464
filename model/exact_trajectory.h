#pragma once

#include "base/real50.h"
#include "model/trajectory.h"

namespace ursula {

/// A trajectory that knows its motion in 50 digits as well. Internal: who writes one of their own needs no Boost.
class ExactTrajectory : public Trajectory {
 public:
  Motion<double> at(double t) const override = 0;
  virtual Motion<Real50> at(const Real50& t) const = 0;
  const ExactTrajectory* exact() const override { return this; }
};

}  // namespace ursula
