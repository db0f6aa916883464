#include "parts/simulate/simulate_mechanism.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "base/csv.h"
#include "simbody/simbody_mechanism.h"
#include "validation/mechanism/output_pose.h"
#include "validation/subject/torque_spline.h"

namespace ursula {
namespace {

namespace odeint = boost::numeric::odeint;
using OdeState = std::vector<double>;

/// y = [q, u] of Simbody's own coordinates.
class SimbodyOfLoops {
 public:
  explicit SimbodyOfLoops(const MechanismAlong& along)
      : mechanism_(along.solver().mechanism()), simbody_(mechanism_, SimbodyMechanism::Tree::other) {}

  OdeState start(const MotorMotion& motion) {
    simbody_.place(motion);
    return simbody_.state();
  }
  void derivative(double t, const OdeState& y, const Eigen::VectorXd& efforts, OdeState& rate) {
    simbody_.derivative(t, y.data(), efforts, rate.data());
  }
  /// Ends an accepted step on the loops.
  void finish(double t, OdeState& y) {
    simbody_.setState(t, y.data());
    closure_ = std::max(closure_, simbody_.closure().position);
    simbody_.project();
    y = simbody_.state();
  }
  MechanismInstant at(double t, const OdeState& y, const Eigen::VectorXd& efforts) {
    simbody_.setState(t, y.data());
    MechanismInstant out;
    out.motion = {t, simbody_.motorCoordinates(), simbody_.motorRates(), simbody_.accelerations(efforts)};
    out.efforts = efforts;
    out.output = outputPose(mechanism_, simbody_.bodies()[mechanism_.output()].displacement);
    out.closure = std::max(closure_, simbody_.closure().position);
    closure_ = 0;
    return out;
  }

 private:
  const Mechanism& mechanism_;
  SimbodyMechanism simbody_;
  double closure_ = 0;
};

/// y = [q, q̇] of the motors.
class NocOfLoops {
 public:
  explicit NocOfLoops(const MechanismAlong& along) : solver_(along.solver()), along_(along) {}

  OdeState start(const MotorMotion& motion) {
    near_ = along_.motion().near(motion.t);
    OdeState y(motion.q.begin(), motion.q.end());
    y.insert(y.end(), motion.qdot.begin(), motion.qdot.end());
    return y;
  }
  void derivative(double t, const OdeState& y, const Eigen::VectorXd& efforts, OdeState& rate) {
    const MotorMotion now = move(t, y, efforts);
    std::copy(now.qdot.begin(), now.qdot.end(), rate.begin());
    std::copy(now.qddot.begin(), now.qddot.end(), rate.begin() + now.qdot.size());
  }
  /// The next step starts from the assembly of this one.
  void finish(double t, OdeState& y) { solver_.moveTo(motionOf(t, y).q, near_); }
  MechanismInstant at(double t, const OdeState& y, const Eigen::VectorXd& efforts) {
    MechanismInstant out;
    out.motion = move(t, y, efforts);
    out.efforts = efforts;
    const Mechanism& mechanism = solver_.mechanism();
    out.output = outputPose(mechanism, work_.bodies[mechanism.output()].displacement);
    out.closure = work_.closing * mechanism.length();
    return out;
  }

 private:
  MotorMotion motionOf(double t, const OdeState& y) const {
    const auto n = static_cast<Eigen::Index>(solver_.mechanism().motorCount());
    const Eigen::Map<const Eigen::VectorXd> all(y.data(), 2 * n);
    return {t, all.head(n), all.tail(n), Eigen::VectorXd::Zero(n)};
  }
  MotorMotion move(double t, const OdeState& y, const Eigen::VectorXd& efforts) {
    MotorMotion now = motionOf(t, y);
    now.qddot = solver_.directDynamics(now, efforts, near_, work_);
    return now;
  }

  const LoopSolver& solver_;
  const MechanismAlong& along_;
  loops::LoopPose near_;
  LoopWork work_;
};

/// Ends the run if steps shrink to nothing.
class Patience {
 public:
  explicit Patience(const std::vector<double>& instants)
      : since_(instants.front()), least_(1e-3 * (instants.back() - instants.front())) {}

  void require(double t) {
    constexpr long patience = 20'000;
    if (++evaluations_ % patience != 0) return;
    if (t - since_ <= least_) throw std::runtime_error(fmt::format("the steps shrink to nothing at t = {:.9g} s", t));
    since_ = t;
  }

 private:
  double since_, least_;
  long evaluations_ = 0;
};

template <class System>
class LoopRun {
 public:
  LoopRun(System system, const MotorEffortHistory& efforts, const std::vector<double>& instants, double tolerance,
          const Deadline& deadline)
      : system_(std::move(system)),
        efforts_(efforts),
        instants_(instants),
        stepper_(odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<OdeState>())),
        patience_(instants),
        deadline_(deadline) {}

  MechanismSimulation from(const MotorMotion& start) {
    MechanismSimulation out;
    y_ = system_.start(start);
    t_ = instants_.front();
    step_ = (instants_.back() - t_) / 128;
    try {
      for (const double instant : instants_) {
        goTo(instant);
        out.instants.push_back(system_.at(instant, y_, efforts_(instant)));
      }
    } catch (const std::bad_alloc&) {
      throw;  // a lack of memory says nothing about the motion
    } catch (const std::exception& error) {
      out.gave_up = error.what();  // the completed part is still reported
    }
    return out;
  }

 private:
  void goTo(double instant) {
    const auto derivative = [this](const OdeState& y, OdeState& rate, double t) {
      deadline_.require();
      system_.derivative(t, y, efforts_(t), rate);
      for (const double value : rate)
        if (!std::isfinite(value)) throw std::runtime_error(fmt::format("derivatives not finite at t = {} s", t));
      patience_.require(t);
    };
    while (instant - t_ > std::numeric_limits<double>::epsilon() * std::abs(instant)) {
      double step = std::min(step_, instant - t_);
      const bool cut = step < step_;
      const auto outcome = stepper_.try_step(derivative, y_, t_, step);
      step_ = cut && outcome == odeint::success ? std::max(step_, step) : step;
      if (outcome == odeint::success) system_.finish(t_, y_);
    }
  }

  System system_;
  const MotorEffortHistory& efforts_;
  const std::vector<double>& instants_;
  decltype(odeint::make_controlled(0.0, 0.0, odeint::runge_kutta_fehlberg78<OdeState>())) stepper_;
  Patience patience_;
  Deadline deadline_;
  OdeState y_;
  double t_ = 0, step_ = 0;
};

}  // namespace

MechanismSimulation simulateMechanism(const MechanismAlong& along, SimulationEngine engine,
                                      const MotorEffortHistory& efforts, const std::vector<double>& instants,
                                      double tolerance, const Deadline& deadline) {
  const MotorMotion start = along.motion().trajectory().at(instants.front());
  if (engine == SimulationEngine::noc)
    return LoopRun<NocOfLoops>(NocOfLoops(along), efforts, instants, tolerance, deadline).from(start);
  return LoopRun<SimbodyOfLoops>(SimbodyOfLoops(along), efforts, instants, tolerance, deadline).from(start);
}

MotorEffortHistory effortSpline(const GivenEfforts& given) {
  if (given.t.size() < TorqueSpline::least_samples)
    throw CsvError(fmt::format("{}: error: {} instant{}, expected at least {} to interpolate between", given.name,
                               given.t.size(), given.t.size() == 1 ? "" : "s", TorqueSpline::least_samples));
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(given.t.size()), given.efforts.front().size());
  std::vector<double> since = given.t;
  for (std::size_t i = 0; i < since.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = given.efforts[i];
    since[i] -= given.t.front();
  }
  const std::shared_ptr<const MotorTrajectory> curve = makeMotorSamples(since, rows);
  return [curve, from = given.t.front()](double t) { return Eigen::VectorXd(curve->at(t - from).q); };
}

TimeSeries simulatedSeries(const Mechanism& mechanism, const MechanismSimulation& run) {
  TimeSeries out;
  const auto column = [&](const std::string& name, const auto& value) {
    std::vector<double> values;
    for (const MechanismInstant& each : run.instants) values.push_back(value(each));
    out.add(name, std::move(values));
  };
  column("t_s", [](const MechanismInstant& each) { return each.motion.t; });
  const auto motors = [&](const char* quantity, const auto& of) {
    for (std::size_t k = 0; k < mechanism.motorCount(); ++k)
      column(motorColumn(mechanism, k, quantity),
             [&, k](const MechanismInstant& each) { return of(each)(static_cast<Eigen::Index>(k)); });
  };
  motors("q", [](const MechanismInstant& each) { return each.motion.q; });
  motors("qdot", [](const MechanismInstant& each) { return each.motion.qdot; });
  motors("qddot", [](const MechanismInstant& each) { return each.motion.qddot; });
  motors("tau", [](const MechanismInstant& each) { return each.efforts; });
  for (std::size_t k = 0; k < output_columns.size(); ++k)
    column(output_columns[k], [k](const MechanismInstant& each) { return numbersOf(each.output)[k]; });
  column("closure_m", [](const MechanismInstant& each) { return each.closure; });
  return out;
}

}  // namespace ursula
