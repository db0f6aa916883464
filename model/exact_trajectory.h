#pragma once

#include "base/real50.h"
#include "model/trajectory.h"

namespace ursula {

/// Sizes that are added up on the way to a pose and that the pose does not show: a helix's angles, and their heights.
struct HiddenTerms {
  double angle = 6.2831853071795864769;  ///< rad; where nothing is known, a turn
  double length = 0;                     ///< m
};

/// A trajectory that knows its motion in 50 digits as well. Internal: who writes one of their own needs no Boost.
class ExactTrajectory : public Trajectory {
 public:
  Motion<double> at(double t) const override = 0;
  virtual Motion<Real50> at(const Real50& t) const = 0;
  virtual HiddenTerms hiddenTerms() const { return {}; }
  const ExactTrajectory* exact() const override { return this; }
};

}  // namespace ursula
