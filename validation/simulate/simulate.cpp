#include "validation/simulate/simulate.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <stdexcept>

#include "nocsolver/solver.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

namespace odeint = boost::numeric::odeint;
using OdeState = std::vector<double>;

/// x = [p, q (w, x, y, z), ṗ, ω].
class NocSystem {
 public:
  NocSystem(const Scenario& scenario) : load_(scenario.load), solver_(*scenario.manipulator) {}

  OdeState start(const Motion<double>& motion) const {
    const Eigen::Quaterniond q(motion.Q);
    OdeState x(13);
    Eigen::Map<Eigen::Matrix<double, 13, 1>>(x.data()) << motion.p, q.w(), q.vec(), motion.p_dot, motion.omega;
    return x;
  }

  Motion<double> motion(double t, const OdeState& x, const Vector6d& torques) {
    const Eigen::Map<const Eigen::Matrix<double, 13, 1>> state(x.data());
    Motion<double> motion;
    motion.t = t;
    motion.p = state.segment<3>(0);
    motion.Q = Eigen::Quaterniond(state(3), state(4), state(5), state(6)).normalized().toRotationMatrix();
    motion.p_dot = state.segment<3>(7);
    motion.omega = state.segment<3>(10);
    const Vector6d found = solver_.directDynamics(motion, torques, work_, loadAtP(load_.get(), motion));
    motion.omega_dot = found.head<3>();
    motion.p_ddot = found.tail<3>();
    return motion;
  }

  void derivative(double t, const OdeState& x, const Vector6d& torques, OdeState& rate) {
    const Motion<double> now = motion(t, x, torques);
    const Eigen::Quaterniond q(x[3], x[4], x[5], x[6]);
    const Eigen::Quaterniond spin(0, now.omega.x(), now.omega.y(), now.omega.z());
    const Eigen::Quaterniond q_dot = spin * q;  // twice q̇, ω in B
    Eigen::Map<Eigen::Matrix<double, 13, 1>>(rate.data()) << now.p_dot, q_dot.w() / 2, q_dot.vec() / 2, now.p_ddot,
        now.omega_dot;
  }

 private:
  std::shared_ptr<const Load> load_;
  Solver<double> solver_;
  Workspace<double> work_;
};

class SimbodySystem {
 public:
  SimbodySystem(const Scenario& scenario)
      : loop_(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load) {}

  OdeState start(const Motion<double>& motion) {
    loop_.place(motion);
    return loop_.state();
  }

  Motion<double> motion(double t, const OdeState& x, const Vector6d& torques) {
    loop_.setState(t, x.data());
    loop_.accelerate(torques);
    return loop_.platform();
  }

  void derivative(double t, const OdeState& x, const Vector6d& torques, OdeState& rate) {
    loop_.derivative(t, x.data(), torques, rate.data());
  }

 private:
  SimbodyLoop loop_;
};

template <class System>
Simulation integrate(System system, const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques,
                     const std::vector<double>& instants, double tolerance) {
  Simulation out;
  OdeState x = system.start(scenario.trajectory->at(instants.front()));
  const auto stepper = odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<OdeState>());
  const auto derivative = [&](const OdeState& at, OdeState& rate, double t) {
    ++out.evaluations;
    system.derivative(t, at, torques(t), rate);
    for (double value : rate)
      if (!std::isfinite(value)) throw std::runtime_error(fmt::format("derivatives not finite at t = {} s", t));
  };
  const auto observe = [&](const OdeState& at, double t) {
    out.torques.push_back(torques(t));
    out.motions.push_back(system.motion(t, at, out.torques.back()));
  };
  try {
    odeint::integrate_times(stepper, derivative, x, instants.begin(), instants.end(),
                            (instants.back() - instants.front()) / 128, observe);
  } catch (const std::exception& error) {
    out.gave_up = error.what();  // what was reached is still reported
  }
  return out;
}

}  // namespace

Simulation simulate(const Scenario& scenario, Engine engine, const SimbodyLoop::TorqueHistory& torques,
                    const std::vector<double>& instants, double tolerance) {
  return engine == Engine::noc ? integrate(NocSystem(scenario), scenario, torques, instants, tolerance)
                               : integrate(SimbodySystem(scenario), scenario, torques, instants, tolerance);
}

}  // namespace ursula
