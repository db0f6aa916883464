#include "parts/simulate/simulate.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "base/csv.h"
#include "model/instants.h"
#include "model/legs/leg_type.h"
#include "nocsolver/errors.h"
#include "nocsolver/noc/noc.h"
#include "parts/fast/solver.h"
#include "parts/simulate/at_instants.h"
#include "simbody/simbody_loop.h"
#include "validation/subject/leg_points.h"
#include "validation/subject/subject.h"
#include "validation/subject/torque_spline.h"

namespace ursula {
namespace {

/// Detects the end of the legs' reach from their joint variables.
struct ReachEnds {
  explicit ReachEnds(const Manipulator& machine) : legs(machine.parameters().legs) {}

  double of(const JointVariables<double>& q, int i) const {
    const Leg& leg = legs[i];
    return typeOf(leg.kind).margin(leg, q, i);
  }

  std::runtime_error outOfReach(const JointVariables<double>& q, int i, double t) const {
    return std::runtime_error(fmt::format("the motion leaves what leg {} reaches: it is {} at t = {:.9g} s", i + 1,
                                          typeOf(legs[i].kind).endOfReach(q, i), t));
  }

  /// Names the leg whose margin is small, since that shrinks the steps.
  void requireOff(const JointVariables<double>& q, double t) const {
    constexpr double at_edge = 1e-3;
    for (std::size_t k = 0; k < legs.size(); ++k)
      if (const int i = static_cast<int>(k); std::abs(of(q, i)) < at_edge) throw outOfReach(q, i, t);
  }

  std::vector<Leg> legs;
};

/// A leg whose knee bends the other way has passed its stretched or folded pose, the end of its reach. The same holds
/// for a rod outside its cylinder.
void checkKnees(const ReachEnds& ends, const JointVariables<double>& before, const JointVariables<double>& now,
                double t) {
  for (std::size_t k = 0; k < ends.legs.size(); ++k)
    if (const int i = static_cast<int>(k); ends.of(before, i) * ends.of(now, i) <= 0) throw ends.outOfReach(now, i, t);
}

/// x = [p, q (w, x, y, z), ṗ, ω].
class NocSystem {
 public:
  NocSystem(const Scenario& scenario)
      : load_(scenario.load), solver_(*scenario.manipulator), ends_(*scenario.manipulator) {}

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
    last_ = motion;
    motion.omega_dot = found.head<3>();
    motion.p_ddot = found.tail<3>();
    return motion;
  }

  /// The solver already refuses poses that a leg cannot reach.
  void finish(double, const OdeState&) const {}
  void requireSteps(double t) {
    solver_.displacements(last_, work_);
    ends_.requireOff(solver_.angles(work_), t);
  }

  void derivative(double t, const OdeState& x, const Vector6d& torques, OdeState& rate) {
    const Motion<double> now = motion(t, x, torques);
    const Eigen::Quaterniond q(x[3], x[4], x[5], x[6]);
    const Eigen::Quaterniond spin(0, now.omega.x(), now.omega.y(), now.omega.z());
    const Eigen::Quaterniond q_dot = spin * q;  // twice q̇, from ω in B
    Eigen::Map<Eigen::Matrix<double, 13, 1>>(rate.data()) << now.p_dot, q_dot.w() / 2, q_dot.vec() / 2, now.p_ddot,
        now.omega_dot;
  }

 private:
  std::shared_ptr<const Load> load_;
  Solver<double> solver_;
  Workspace<double> work_;
  ReachEnds ends_;
  Motion<double> last_;  ///< the last motion that the solver accepted
};

class SimbodySystem {
 public:
  SimbodySystem(const Scenario& scenario)
      : loop_(*scenario.manipulator, SimbodyLoop::Topology::ball_per_leg, scenario.load),
        ends_(*scenario.manipulator) {}

  OdeState start(const Motion<double>& motion) {
    start_ = loop_.place(motion).q;
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

  void finish(double t, const OdeState& x) {
    loop_.setState(t, x.data());
    checkKnees(ends_, start_, loop_.joints().q, t);
  }
  void requireSteps(double t) const { ends_.requireOff(loop_.joints().q, t); }

 private:
  SimbodyLoop loop_;
  ReachEnds ends_;
  JointVariables<double> start_;  ///< of the commanded state
};

template <class System>
Simulation integrate(System system, const Scenario& scenario, const EffortHistory& torques,
                     const std::vector<double>& instants, double tolerance, const Deadline& deadline) {
  Simulation out;
  const auto record = [&](double t, const OdeState& x) {
    const Vector6d now = torques(t);
    const Motion<double> motion = system.motion(t, x, now);
    requireFinite(motion);
    out.torques.push_back(now);
    out.motions.push_back(motion);
  };
  const RunEnd end =
      stopAtInstants(system, scenario.trajectory->at(instants.front()), torques, instants, tolerance, deadline, record);
  out.evaluations = end.evaluations;
  out.gave_up = end.gave_up;
  return out;
}

}  // namespace

Simulation simulate(const Scenario& scenario, SimulationEngine engine, const EffortHistory& torques,
                    const std::vector<double>& instants, double tolerance, const Deadline& deadline) {
  return engine == SimulationEngine::noc
             ? integrate(NocSystem(scenario), scenario, torques, instants, tolerance, deadline)
             : integrate(SimbodySystem(scenario), scenario, torques, instants, tolerance, deadline);
}

Simulation simulate(const Scenario& scenario, SimulationEngine engine, const TorqueFile& torques,
                    const Deadline& deadline) {
  if (torques.rows() < TorqueSpline::least_samples)
    throw CsvError(fmt::format("{}: error: {} instant{}, expected at least {} to interpolate between",
                               torques.file.string(), torques.rows(), torques.rows() == 1 ? "" : "s",
                               TorqueSpline::least_samples));
  const TorqueSpline spline(torques.t, torques.torques);
  return simulate(scenario, engine, spline, torques.t, scenario.simulation.tolerance, deadline);
}

namespace {

/// The points of one instant, in the order of the columns: p, then A, R, B of each leg.
std::vector<Vector3d> points(const Manipulator& machine, const Noc<double>& solver, const Motion<double>& motion) {
  NocWorkspace<double> work;
  solver.displacements(motion, work);
  std::vector<Vector3d> all = {motion.p};
  for (const LegPoints& leg : legPoints(machine, work)) all.insert(all.end(), {leg.A, leg.R, leg.B});
  return all;
}

std::vector<std::string> pointNames(int legs) {
  std::vector<std::string> names = {"p"};
  for (int i = 1; i <= legs; ++i)
    for (const char* point : {"A", "R", "B"}) names.push_back(fmt::format("{}_{}", point, i));
  return names;
}

}  // namespace

TimeSeries poseSeries(const Scenario& scenario, int count) {
  const Manipulator& machine = *scenario.manipulator;
  const Noc<double> solver(machine);
  const std::vector<double> instants = equallySpaced(scenario.trajectory->duration(), count);
  std::vector<std::vector<Vector3d>> rows;
  rows.reserve(instants.size());
  for (double t : instants) rows.push_back(points(machine, solver, scenario.trajectory->at(t)));
  TimeSeries series;
  series.add("t_s", instants);
  const std::vector<std::string> names = pointNames(machine.legCount());
  for (std::size_t k = 0; k < names.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> column;
      column.reserve(rows.size());
      for (const std::vector<Vector3d>& row : rows) column.push_back(row[k](axis));
      series.add(fmt::format("{}_{}_m", names[k], "xyz"[axis]), std::move(column));
    }
  return series;
}

}  // namespace ursula
