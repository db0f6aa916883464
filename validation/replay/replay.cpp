#include "validation/replay/replay.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>

#include "model/instants.h"
#include "nocsolver/noc/noc.h"
#include "validation/replay/radau.h"

namespace ursula {
namespace {

namespace odeint = boost::numeric::odeint;
using OdeState = std::vector<double>;

struct GaveUp : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct TooLong : GaveUp {
  using GaveUp::GaveUp;
};

struct LeftPath {};

/// The rotation vector of R, exact to rounding even if it is small.
Vector3d rotationVector(const Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine == 0) return Vector3d::Zero();
  return (2 * std::atan2(sine, q.w()) / sine) * q.vec();
}

/// The instants at which Fehlberg's pair evaluates derivatives in a step of h, to the bit.
std::vector<double> stagesOf(double t, double h) {
  static const odeint::rk78_coefficients_c<double> nodes;
  std::vector<double> out;
  for (double node : nodes) out.push_back(t + node * h);
  return out;
}

Motion<double> startOf(const Scenario& scenario, const ReplaySettings& settings) {
  Motion<double> motion = scenario.trajectory->at(settings.start);
  if (settings.deviation.isZero(0)) return motion;
  const double length = MachineParameters<double>(*scenario.manipulator).length;
  const Vector3d turn = settings.deviation.segment<3>(3) / length;
  motion.p += settings.deviation.segment<3>(0);
  if (turn.norm() > 0) motion.Q = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * motion.Q;
  motion.p_dot += settings.deviation.segment<3>(6);
  motion.omega += settings.deviation.segment<3>(9) / length;
  return motion;
}

/// RadauStep in the form of Boost.Odeint's controlled steppers.
class ControlledRadau {
 public:
  explicit ControlledRadau(double tolerance) : tolerance_{tolerance, tolerance} {}

  template <class RateAt>
  odeint::controlled_step_result try_step(const RateAt& rate, OdeState& x, double& t, double& h) {
    std::optional<double> error;
    try {
      error = step_.tryStep(rate, x, t, h, tolerance_);
    } catch (const TooLong&) {
      throw;
    } catch (const GaveUp&) {
      // If a stage went far away, the step is too long.
    }
    const bool accepted = error && *error <= 1;
    if (accepted) t += h;
    h *= changeOfStep(error);
    return accepted ? odeint::success : odeint::fail;
  }

 private:
  RadauStep step_;
  RadauStep::Tolerance tolerance_;
};

/// One run: the loop, the work done on it and the records.
class Run {
 public:
  Run(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const ReplaySettings& settings)
      : trajectory_(*scenario.trajectory),
        torques_(result_.asked.recorded(torques)),
        settings_(settings),
        stops_(knotsWithin(scenario, settings.start, settings.end)),
        loop_(*scenario.manipulator, settings.topology, scenario.load) {
    for (double stop : settings.stops)
      if (stop > settings.start && stop < settings.end) stops_.push_back(stop);
    std::sort(stops_.begin(), stops_.end());
    stops_.erase(std::unique(stops_.begin(), stops_.end()), stops_.end());
    stops_.push_back(settings.end);
    result_.integrator = settings.integrator;
    result_.tolerance = settings.tolerance;
    result_.stiff = settings.stiff;
    const ManipulatorParameters& machine = scenario.manipulator->parameters();
    double mass = machine.platform.mass;
    for (const Leg& leg : machine.legs) {
      mass += leg.proximal.mass + leg.distal.mass;
      size_ = std::max(size_, leg.platform_point.norm());
    }
    weight_ = mass * std::max(machine.gravity.norm(), 1.0);  // 1 m/s² without gravity
    loop_.place(startOf(scenario, settings));
    const SimbodyLoop::Energy energy = loop_.energy();
    start_energy_ = energy.kinetic + energy.potential;
  }

  Run(const Run&) = delete;  // result_ records the torques
  Run& operator=(const Run&) = delete;

  Replay result() {
    if (settings_.integrator == Integrator::rkf78 && !result_.steps.empty())
      result_.accepted = static_cast<long>(result_.steps.size()) - 1;
    return std::move(result_);
  }

  /// x = [q, u, work / weight]: the work in metres, so one absolute tolerance suits every coordinate.
  void integrateRkf78() {
    if (settings_.stiff) return integrate(ControlledRadau(settings_.tolerance));
    integrate(
        odeint::make_controlled(settings_.tolerance, settings_.tolerance, odeint::runge_kutta_fehlberg78<OdeState>()));
  }

  /// Simbody integrates no work, so the energy is not judged here.
  void integrateRungeKuttaMerson() {
    std::vector<double> instants;
    for (int k = 1; k < settings_.instants; ++k)
      instants.push_back(settings_.start + (settings_.end - settings_.start) * k / (settings_.instants - 1));
    const SimbodyLoop::TorqueHistory timed = [this](double t) {
      settings_.deadline.require();
      return torques_(t);
    };
    const SimbodyLoop::Counters counters = loop_.integrateRungeKuttaMerson(
        settings_.tolerance, timed, instants, [this](double t) { record(t); }, settings_.longest_step);
    result_.evaluations = counters.derivative_evaluations;
    result_.accepted = counters.steps;
    if (counters.gave_up) result_.gave_up = "Simbody's integrator could not keep its accuracy";
  }

  void giveUp(const std::string& why, bool too_long) {
    result_.gave_up = why;
    result_.too_long = too_long;
  }
  void leavePath() { result_.left_path = true; }

 private:
  template <class Stepper>
  void integrate(Stepper stepper) {
    OdeState x = loop_.state();
    x.push_back(0.0);
    // The first step has the scale of the whole motion. Otherwise each of many short windows would begin with tiny
    // steps.
    double step = trajectory_.duration() / 128;
    double t = settings_.start;
    observe(x, t);
    for (double stop : stops_) {
      double longest = 0;
      while (t < stop) longest = std::max(longest, takeStep(stepper, x, t, stop, longest > 0 ? next_step_ : step));
      step = longest;
    }
  }

  /// Takes one accepted step from t, at most to `stop`; advances t and returns the step's length.
  template <class Stepper>
  double takeStep(Stepper& stepper, OdeState& x, double& t, double stop, double try_first) {
    const auto rate = [this](const OdeState& at, OdeState& out, double when) { derivative(at, out, when); };
    const double start = t;
    double h = try_first;
    for (int rejected = 0;; ++rejected) {
      const bool last = t + h * (1 + 1e-12) >= stop;
      if (last) h = stop - t;
      if (settings_.foresee) settings_.foresee(settings_.stiff ? RadauStep::instants(t, h) : stagesOf(t, h));
      if (stepper.try_step(rate, x, t, h) == odeint::success) {
        if (last) t = stop;  // exactly stop, not its neighbour
        break;
      }
      if (rejected > 500 || t + h == t) throw TooLong("the integrator's step has vanished");
    }
    next_step_ = h;
    if (settings_.fault) settings_.fault(t, x);
    if (settings_.project) project(x, t);
    observe(x, t);
    return t - start;
  }

  void project(OdeState& x, double t) {
    loop_.setState(t, x.data());
    loop_.place(loop_.platform());
    const double work = x.back();
    x = loop_.state();
    x.push_back(work);
  }

  void derivative(const OdeState& x, OdeState& rate, double t) {
    if (++result_.evaluations > settings_.max_evaluations)
      throw TooLong(fmt::format("more than {} derivative evaluations", settings_.max_evaluations));
    settings_.deadline.require();
    result_.stopped_at = t;
    if (!settings_.stiff || !(t == torques_at_)) torques_now_ = torques_(t);  // a Jacobian evaluates at one instant
    torques_at_ = t;
    loop_.derivative(t, x.data(), torques_now_, rate.data());
    const SimbodyLoop::Power power = loop_.power();
    const double faulty = settings_.fault_power ? settings_.fault_power(power) : 0;
    rate.back() = (power.actuators + power.friction + power.load + faulty) / weight_;
    for (double value : rate)
      if (!std::isfinite(value)) throw GaveUp("the derivatives are not finite");
  }

  void observe(const OdeState& x, double t) {
    loop_.setState(t, x.data());
    record(t);
    const double work = x.back() * weight_;
    const SimbodyLoop::Energy energy = loop_.energy();
    result_.steps.back().energy_error = energy.kinetic + energy.potential - start_energy_ - work;
    const double state = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size() - 1)).norm();
    if (result_.steps.back().position_error.norm() > size_) throw LeftPath{};
    result_.energy_scale = std::max(result_.energy_scale, weight_ * (1 + state) + 2 * energy.kinetic + std::abs(work));
  }

  void record(double t) {
    const Motion<double> commanded = trajectory_.at(t);
    const Motion<double> simulated = loop_.platform();
    ReplayStep step;
    step.t = t;
    step.position_error = simulated.p - commanded.p;
    step.rotation_error = rotationVector(simulated.Q * commanded.Q.transpose());
    step.velocity_error = simulated.p_dot - commanded.p_dot;
    step.spin_error = simulated.omega - commanded.omega;
    step.closure = loop_.closure();
    result_.steps.push_back(step);
  }

  const Trajectory& trajectory_;
  Replay result_;
  SimbodyLoop::TorqueHistory torques_;  ///< recorded in result_
  ReplaySettings settings_;
  std::vector<double> stops_;  ///< the integrator keeps its order between them
  SimbodyLoop loop_;
  Vector6d torques_now_;  ///< at torques_at_
  double torques_at_ = std::numeric_limits<double>::quiet_NaN();
  double start_energy_ = 0;
  double next_step_ = 0;  ///< proposed by the step control
  double weight_ = 0;     ///< N
  double size_ = 0;       ///< m
};

}  // namespace

Replay replay(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const ReplaySettings& settings) {
  Run run(scenario, torques, settings);
  try {
    if (settings.integrator == Integrator::rkf78)
      run.integrateRkf78();
    else
      run.integrateRungeKuttaMerson();
  } catch (const LeftPath&) {
    run.leavePath();
  } catch (const TooLong& error) {
    run.giveUp(error.what(), true);
  } catch (const std::exception& error) {
    if (isShortage(error)) throw;
    run.giveUp(error.what(), false);  // the completed part is still reported
  }
  return run.result();
}

const char* name(Integrator integrator) { return integrator == Integrator::rkf78 ? "rkf78" : "rk_merson"; }

}  // namespace ursula
