// Wrong in a narrow place only: a millisecond or so of a motion of three seconds, and never at one of its samples.

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/prove/defects_kit.h"

namespace ursula {
namespace {

/// Of the torque, where the branch is taken.
constexpr double branch_error = 1e-8;

struct Joints {
  JointVariables<double> q, q_dot;
};

Joints jointsOf(const Solver<double>& solver, const Motion<double>& motion) {
  Workspace<double> work;
  solver.inverseKinematics(motion, work);
  return {solver.angles(work), solver.rates(work)};
}

/// What the solver branches on.
using Quantity = std::function<double(const Motion<double>&, const Joints&)>;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// What `quantity` passes through during the pulse.
Range rangeIn(const Pulse& pulse, const Trajectory& trajectory, const Solver<double>& solver,
              const Quantity& quantity) {
  Range out;
  constexpr int parts = 20;
  for (int k = 0; k <= parts; ++k) {
    const Motion<double> motion = trajectory.at(pulse.from + (pulse.to - pulse.from) * k / parts);
    const double value = quantity(motion, jointsOf(solver, motion));
    out.low = std::min(out.low, value);
    out.high = std::max(out.high, value);
  }
  return out;
}

/// All torques wrong where `quantity` is what it is for a 3000th of the motion, after `share` of it.
Defect branch(const char* name, double share, const Quantity& quantity) {
  Defect out = wrongTorques(name, "branch", [share, quantity](const Scenario& s) -> ChangeTorques {
    const auto solver = std::make_shared<const Solver<double>>(*s.manipulator);
    const Range range = rangeIn(Pulse(*s.trajectory, share), *s.trajectory, *solver, quantity);
    return [solver, range, quantity](const Vector6d& torques, const Motion<double>& m) {
      const double value = quantity(m, jointsOf(*solver, m));
      return Vector6d(value >= range.low && value <= range.high ? (1 + branch_error) * torques : torques);
    };
  });
  out.roads = 1;
  return out;
}

using ChangeLeg = std::function<void(Vector6d& torques)>;

/// At the instants of a pulse only.
Defect pulse(const char* name, double share, const ChangeLeg& change) {
  Defect out = wrongTorques(name, "branch", [share, change](const Scenario& s) -> ChangeTorques {
    return [pulse = Pulse(*s.trajectory, share), change](const Vector6d& torques, const Motion<double>& m) {
      Vector6d wrong = torques;
      if (pulse.has(m.t)) change(wrong);
      return wrong;
    };
  });
  out.roads = 1;
  return out;
}

}  // namespace

std::vector<Defect> branchDefects() {
  using M = Motion<double>;
  using J = Joints;
  return {branch("narrow branch: theta of leg 2", 0.2137, [](const M&, const J& j) { return j.q.theta(1); }),
          branch("narrow branch: phi of leg 5", 0.4661, [](const M&, const J& j) { return j.q.phi(4); }),
          branch("narrow branch: psi of leg 3", 0.6438, [](const M&, const J& j) { return j.q.psi(2); }),
          branch("narrow branch: knee's rate, leg 4", 0.3164, [](const M&, const J& j) { return j.q_dot.theta(3); }),
          branch("narrow branch: motor's rate, leg 1", 0.7537, [](const M&, const J& j) { return j.q_dot.phi(0); }),
          branch("narrow branch: height of P", 0.5362, [](const M& m, const J&) { return m.p.z(); }),
          branch("narrow branch: the platform's spin", 0.8366, [](const M& m, const J&) { return m.omega.norm(); }),
          branch("narrow branch: turn of the platform", 0.1263, [](const M& m, const J&) { return m.Q.trace(); }),
          pulse("pulse between samples, all legs", 0.5746, [](Vector6d& tau) { tau *= 1 + branch_error; }),
          pulse("pulse between samples, leg 3", 0.2764, [](Vector6d& tau) { tau(2) *= 1 + branch_error; }),
          pulse("pulse between samples, leg 6, no number", 0.6847, [](Vector6d& tau) { tau(5) = std::nan(""); }),
          pulse("pulse between samples, leg 4 dead", 0.4433, [](Vector6d& tau) { tau(3) = 0; })};
}

}  // namespace ursula
