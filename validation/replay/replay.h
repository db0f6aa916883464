#pragma once

#include <string>
#include <vector>

#include "engines/simbody/simbody_loop.h"
#include "model/scenario.h"
#include "validation/replay/asked_torques.h"

namespace ursula {

/// Where a replay stands after one accepted step, against the commanded motion.
struct ReplayStep {
  double t = 0;
  Vector3d position_error = Vector3d::Zero();  ///< of P, m, in B
  Vector3d rotation_error = Vector3d::Zero();  ///< rotation vector from commanded to simulated orientation, rad, in B
  Vector3d velocity_error = Vector3d::Zero();  ///< m/s
  Vector3d spin_error = Vector3d::Zero();      ///< of the angular velocity, rad/s
  SimbodyLoop::Closure closure;
  double energy_error = 0;  ///< E − E₀ − work, J
};

/// An open-loop simulation of the Simbody loop from the commanded state under a history of torques.
struct Replay {
  Integrator integrator = Integrator::rkf78;
  double tolerance = 0;
  bool stiff = false;             ///< as ReplaySettings has it
  std::vector<ReplayStep> steps;  ///< from the start; every accepted step (rk_merson: every instant asked for)
  long evaluations = 0;           ///< of the derivatives
  long accepted = 0;              ///< steps of the integrator
  double energy_scale = 0;        ///< ‖∂E/∂x‖ and |work|, what an error of one in the state is to the energy, J
  std::string gave_up;            ///< why, where it could not go on; else empty
  double stopped_at = 0;          ///< when it could not go on, s
  bool too_long = false;          ///< gave up after too many evaluations: what is missing proves nothing
  bool left_path = false;         ///< stopped where P was off by more than the platform's size: no use to go on
  AskedTorques asked;             ///< and of nobody else: under torques that are the same there, this is the replay

  double maxPositionError() const;  ///< m
  double maxRotationError() const;  ///< rad
};

/// Of rkf78, whose solution of eighth order is carried on.
constexpr double nominal_order = 8;

struct ReplaySettings {
  Integrator integrator = Integrator::rkf78;
  double tolerance = 1e-14;   ///< absolute and relative
  bool stiff = false;         ///< rkf78 only: RadauStep in its place, whose steps friction does not shorten
  double start = 0, end = 0;  ///< s; the state at start is the commanded one
  SimbodyLoop::Topology topology = SimbodyLoop::Topology::six_balls;
  /// [δp; L δϑ; δṗ; L δω] by which the start is put off the commanded state, L the machine's length; m and m/s.
  Eigen::Matrix<double, 12, 1> deviation = Eigen::Matrix<double, 12, 1>::Zero();
  std::vector<double> stops;     ///< rkf78 only: further instants that are stepped to
  int instants = 101;            ///< rk_merson only: equally spaced instants at which it is compared
  long max_evaluations = 20000;  ///< more than this is giving up
  bool project = false;          ///< rkf78 only: after each step the legs follow the platform, so that no gap is left
  std::function<void(const std::vector<double>&)> foresee;  ///< rkf78 only: told what each step will ask torques for, s
  /// rkf78 only, for controls that must fail: falsifies the state x = [q, u, …] after each step.
  std::function<void(double t, std::vector<double>& x)> fault;
  /// The same for the power that the energy is held against: what is added to it, W.
  std::function<double(const SimbodyLoop::Power&)> fault_power;
};

Replay replay(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const ReplaySettings& settings);

/// Position and rotation errors of `replay` at an instant: cubic in the errors and their rates between the steps.
ReplayStep interpolated(const Replay& replay, double t);

const char* name(Integrator integrator);

}  // namespace ursula
