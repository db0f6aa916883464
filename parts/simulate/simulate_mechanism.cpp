#include "parts/simulate/simulate_mechanism.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/csv.h"
#include "parts/simulate/at_instants.h"
#include "simbody/simbody_mechanism.h"
#include "validation/mechanism/output_pose.h"
#include "validation/subject/torque_spline.h"

namespace ursula {
namespace {

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
  void requireSteps(double) const {}
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
  void requireSteps(double) const {}
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

template <class System>
MechanismSimulation integrate(System system, const MechanismAlong& along, const MotorEffortHistory& efforts,
                              const std::vector<double>& instants, double tolerance, const Deadline& deadline) {
  MechanismSimulation out;
  const auto record = [&](double t, const OdeState& y) { out.instants.push_back(system.at(t, y, efforts(t))); };
  const MotorMotion start = along.motion().trajectory().at(instants.front());
  out.gave_up = stopAtInstants(system, start, efforts, instants, tolerance, deadline, record).gave_up;
  return out;
}

}  // namespace

MechanismSimulation simulateMechanism(const MechanismAlong& along, SimulationEngine engine,
                                      const MotorEffortHistory& efforts, const std::vector<double>& instants,
                                      double tolerance, const Deadline& deadline) {
  return engine == SimulationEngine::noc
             ? integrate(NocOfLoops(along), along, efforts, instants, tolerance, deadline)
             : integrate(SimbodyOfLoops(along), along, efforts, instants, tolerance, deadline);
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
