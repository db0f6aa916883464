#pragma once

#include "base/real50.h"
#include "model/trajectory.h"

namespace ursula {

/// Sizes of intermediate sums that a pose does not show, such as a helix's angles and their heights.
struct HiddenTerms {
  double angle = 6.2831853071795864769;  ///< rad; one turn by default
  double length = 0;                     ///< m
};

/// A trajectory that gives its motion in 50 digits as well. Internal, so that users' trajectories need no Boost.
class ExactTrajectory : public Trajectory {
 public:
  Motion<double> at(double t) const override = 0;
  virtual Motion<Real50> at(const Real50& t) const = 0;
  virtual HiddenTerms hiddenTerms() const { return {}; }
  const ExactTrajectory* exact() const override { return this; }
};

}  // namespace ursula
