#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/load.h"
#include "model/motion.h"
#include "nocsolver/fast/batch_dynamics.h"

namespace ursula {

/// Efforts of the motors at t, N·m or N.
using EffortsAt = std::function<Vector6d(double t)>;

/// What collocate() found.
struct CollocatedMotion {
  std::vector<Motion<double>> motions;  ///< platform, with its accelerations, at the instants reached
  long evaluations = 0;                 ///< of the direct dynamics
  int intervals = 0;                    ///< that were accepted
  std::string gave_up;                  ///< why, where it did not reach the last instant; else empty
};

/// The platform's motion under efforts that are smooth in time, from the state `start` at the first of `instants`
/// (increasing, two or more), by direct dynamics (36) over whole batches: collocation at 15 Gauss points an interval
/// (of order 30; Hairer, Lubich, Wanner, Geometric Numerical Integration, 2006, sect. II.1.3), its equations solved by
/// substituting the accelerations of all points at a time. The state is pose and twist, so that no direct kinematics is
/// solved.
///
/// `tolerance`, m and rad: of what the accelerations' last two Legendre coefficients in an interval make of the pose.
/// For motions that are neither stiff nor kinked: where either makes intervals too short it gives up. `load` may be
/// null. The accelerations in `start` are not read.
CollocatedMotion collocate(const BatchDynamics& dynamics, const Load* load, const Motion<double>& start,
                           const EffortsAt& efforts, const std::vector<double>& instants, double tolerance);

}  // namespace ursula
