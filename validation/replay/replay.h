#pragma once

#include <string>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "simbody/simbody_loop.h"
#include "validation/replay/asked_torques.h"

namespace ursula {

/// The state of a replay after one accepted step, relative to the commanded motion.
struct ReplayStep {
  double t = 0;
  Vector3d position_error = Vector3d::Zero();  ///< of P, m, in B
  Vector3d rotation_error = Vector3d::Zero();  ///< rotation vector from commanded to simulated orientation, rad, in B
  Vector3d velocity_error = Vector3d::Zero();  ///< m/s
  Vector3d spin_error = Vector3d::Zero();      ///< error of the angular velocity, rad/s
  SimbodyLoop::Closure closure;
  double energy_error = 0;  ///< E − E₀ − work, J
};

/// An open-loop simulation of the Simbody loop from the commanded state under a history of torques.
struct Replay {
  Integrator integrator = Integrator::rkf78;
  double tolerance = 0;
  bool stiff = false;             ///< as in ReplaySettings
  std::vector<ReplayStep> steps;  ///< from the start; every accepted step (rk_merson: every requested instant)
  long evaluations = 0;           ///< evaluations of the derivatives
  long accepted = 0;              ///< steps of the integrator
  double energy_scale = 0;        ///< ‖∂E/∂x‖ and |work|: the energy of a unit error in the state, J
  std::string gave_up;            ///< why it could not go on; else empty
  double stopped_at = 0;          ///< when it stopped, s
  bool too_long = false;          ///< gave up after too many evaluations; the missing part proves nothing
  bool left_path = false;         ///< stopped because P was off by more than the platform's size
  AskedTorques asked;             ///< the only torques used: equal answers give this replay
};

/// Order of rkf78, which continues with its eighth-order solution.
constexpr double nominal_order = 8;

struct ReplaySettings {
  Integrator integrator = Integrator::rkf78;
  double tolerance = 1e-14;   ///< absolute and relative
  bool stiff = false;         ///< rkf78 only: uses RadauStep, whose steps friction does not shorten
  double start = 0, end = 0;  ///< s; the start state is the commanded one
  SimbodyLoop::Topology topology = SimbodyLoop::Topology::ball_per_leg;
  /// Offset [δp; L δϑ; δṗ; L δω] of the start from the commanded state, m and m/s; L is the machine's length.
  Eigen::Matrix<double, 12, 1> deviation = Eigen::Matrix<double, 12, 1>::Zero();
  std::vector<double> stops;     ///< rkf78 only: further instants to step to
  int instants = 101;            ///< rk_merson only: number of equally spaced instants to compare at
  double longest_step = 0;       ///< rk_merson only, s; 0: as long as the tolerance allows
  long max_evaluations = 20000;  ///< gives up after this number
  Deadline deadline;             ///< OutOfTime is thrown once it is over
  bool project = false;          ///< rkf78 only: after each step the legs follow the platform, which closes the gaps
  std::function<void(const std::vector<double>&)>
      foresee;  ///< rkf78 only: receives the instants of each step's torques, s
  /// rkf78 only, for negative controls: falsifies the state x = [q, u, …] after each step.
  std::function<void(double t, std::vector<double>& x)> fault;
  /// The same for the power in the energy balance: an added value, W.
  std::function<double(const SimbodyLoop::Power&)> fault_power;
};

Replay replay(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const ReplaySettings& settings);

/// Position and rotation errors of `replay` at an instant, by cubics in the errors and their rates between the steps.
ReplayStep interpolated(const Replay& replay, double t);

const char* name(Integrator integrator);

}  // namespace ursula
