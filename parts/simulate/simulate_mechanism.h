#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "base/deadline.h"
#include "parts/simulate/simulate.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {

/// Efforts of a mechanism's motors at any instant.
using MotorEffortHistory = std::function<Eigen::VectorXd(double t)>;

/// The motion of a mechanism under a history of efforts, at one reached instant.
struct MechanismInstant {
  MotorMotion motion;
  Eigen::VectorXd efforts;
  Eigen::Isometry3d output = Eigen::Isometry3d::Identity();  ///< the output body's frame
  double closure = 0;  ///< m; the largest gap of a step since the last instant, before the loops were closed again
};

struct MechanismSimulation {
  std::vector<MechanismInstant> instants;
  std::string gave_up;  ///< why it did not reach the last instant; else empty
};

/// Integrates from the commanded state at the first of `instants` (increasing, two or more) with rkf78 at `tolerance`,
/// stopping at each. Simbody integrates its own coordinates and rates, and each step ends on the loops. The NOC
/// integrates (36) over the motors' coordinates; its loops are always closed.
MechanismSimulation simulateMechanism(const MechanismAlong& along, SimulationEngine engine,
                                      const MotorEffortHistory& efforts, const std::vector<double>& instants,
                                      double tolerance, const Deadline& deadline = {});

/// The quintic spline through efforts at their own instants. Throws CsvError if there are fewer than six.
MotorEffortHistory effortSpline(const GivenEfforts& efforts);

/// The columns of a simulation: t_s, q_k, qdot_k, qddot_k, tau_k, the output body's pose, closure_m.
TimeSeries simulatedSeries(const Mechanism& mechanism, const MechanismSimulation& run);

}  // namespace ursula
