#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/subject/torque_file.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Efforts at any instant, N·m or N.
using EffortHistory = std::function<Vector6d(double t)>;

enum class SimulationEngine { noc, simbody };

/// The motion of the machine under a torque history.
struct Simulation {
  std::vector<Motion<double>> motions;  ///< of the platform, with accelerations, at the reached instants
  std::vector<Vector6d> torques;        ///< at the same instants
  long evaluations = 0;                 ///< evaluations of the derivatives
  std::string gave_up;                  ///< why it did not reach the last instant; else empty
};

/// Integrates from the commanded state at the first of `instants` (increasing, two or more) with rkf78 at `tolerance`,
/// stopping at each instant.
///
/// The NOC engine integrates (36) with the platform's pose and twist as the state. So it needs no direct kinematics,
/// and the assembly is unique. The Simbody engine integrates the closed loop's own coordinates. It stops when the
/// deadline is over.
Simulation simulate(const Scenario& scenario, SimulationEngine engine, const EffortHistory& torques,
                    const std::vector<double>& instants, double tolerance, const Deadline& deadline = {});

/// The same under torques at their own instants within the motion, from the first to the last, at the scenario's
/// tolerance. A quintic spline interpolates them; throws CsvError if there are too few.
Simulation simulate(const Scenario& scenario, SimulationEngine engine, const TorqueFile& torques,
                    const Deadline& deadline = {});

/// Returns the points for a drawing of the machine at `count` equally spaced instants: `t_s`, `p_{x,y,z}_m` and, for
/// each leg, `A_{1..6}_{x,y,z}_m` at the base, `R_…` at the knee and `B_…` at the platform, in B. Throws PoseError.
TimeSeries poseSeries(const Scenario& scenario, int count);

}  // namespace ursula
