// Defects in a narrow range: about a millisecond of a motion of three seconds, and never at a sample.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "studies/prove/defect_helpers.h"

namespace ursula {
namespace {

/// Relative error of the torque where the branch is taken.
constexpr double branch_error = 1e-8;

struct Joints {
  JointVariables<double> q, q_dot;
};

Joints jointsOf(const Solver<double>& solver, const Motion<double>& motion) {
  Workspace<double> work;
  solver.inverseKinematics(motion, work);
  return {solver.angles(work), solver.rates(work)};
}

/// The quantity that the solver branches on.
using Quantity = std::function<double(const Motion<double>&, const Joints&)>;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// The range of `quantity` during the pulse.
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

/// Makes all torques wrong where `quantity` has its values of a 3000th of the motion, after `share` of it.
Defect branch(const std::string& name, double share, const Quantity& quantity) {
  Defect out = wrongTorques(name, "branch", [share, quantity](const Scenario& s) -> ChangeTorques {
    const auto solver = std::make_shared<const Solver<double>>(*s.manipulator);
    const Range range = rangeIn(Pulse(*s.trajectory, share), *s.trajectory, *solver, quantity);
    return [solver, range, quantity](const Vector6d& torques, const Motion<double>& m) {
      const double value = quantity(m, jointsOf(*solver, m));
      return Vector6d(value >= range.low && value <= range.high ? (1 + branch_error) * torques : torques);
    };
  });
  out.engines = 1;
  return out;
}

using ChangeLeg = std::function<void(Vector6d& torques)>;

/// A defect that acts only during a pulse.
Defect pulse(const char* name, double share, const ChangeLeg& change) {
  Defect out = wrongTorques(name, "branch", [share, change](const Scenario& s) -> ChangeTorques {
    return [pulse = Pulse(*s.trajectory, share), change](const Vector6d& torques, const Motion<double>& m) {
      Vector6d wrong = torques;
      if (pulse.has(m.t)) change(wrong);
      return wrong;
    };
  });
  out.engines = 1;
  return out;
}

}  // namespace

std::vector<Defect> branchDefects(const Manipulator& machine) {
  const bool paper = machine.isOfThePaper();
  const std::size_t first = legOf(machine, 1), second = legOf(machine, 2), third = legOf(machine, 3),
                    fourth = legOf(machine, 4), fifth = legOf(machine, 5);
  const Coordinate q_2 = coordinatesOf(machine, second)[2], q_5 = coordinatesOf(machine, fifth)[0],
                   q_3 = coordinatesOf(machine, third)[1], q_4 = coordinatesOf(machine, fourth)[2],
                   q_1 = machine.motors().front().coordinate;
  const auto value = [](Coordinate q, std::size_t leg) {
    return [=](const Motion<double>&, const Joints& j) { return j.q.of(q)(static_cast<int>(leg)); };
  };
  const auto rate = [](Coordinate q, std::size_t leg) {
    return [=](const Motion<double>&, const Joints& j) { return j.q_dot.of(q)(static_cast<int>(leg)); };
  };
  const auto named = [](Coordinate q, std::size_t leg) {
    return fmt::format("narrow branch: {} of leg {}", nameOf(q), leg + 1);
  };
  const std::string knees = paper ? "knee" : nameOf(q_4), motors = paper ? "motor" : nameOf(q_1);
  using M = Motion<double>;
  using J = Joints;
  return {branch(named(q_2, second), 0.2137, value(q_2, second)),
          branch(named(q_5, fifth), 0.4661, value(q_5, fifth)),
          branch(named(q_3, third), 0.6438, value(q_3, third)),
          branch(fmt::format("narrow branch: {}'s rate, leg {}", knees, fourth + 1), 0.3164, rate(q_4, fourth)),
          branch(fmt::format("narrow branch: {}'s rate, leg 1", motors), 0.7537, rate(q_1, first)),
          branch("narrow branch: height of P", 0.5362, [](const M& m, const J&) { return m.p.z(); }),
          branch("narrow branch: the platform's spin", 0.8366, [](const M& m, const J&) { return m.omega.norm(); }),
          branch("narrow branch: turn of the platform", 0.1263, [](const M& m, const J&) { return m.Q.trace(); }),
          pulse("pulse between samples, all legs", 0.5746, [](Vector6d& tau) { tau *= 1 + branch_error; }),
          pulse("pulse between samples, leg 3", 0.2764, [](Vector6d& tau) { tau(2) *= 1 + branch_error; }),
          pulse("pulse between samples, leg 6, no number", 0.6847, [](Vector6d& tau) { tau(5) = std::nan(""); }),
          pulse("pulse between samples, leg 4 dead", 0.4433, [](Vector6d& tau) { tau(3) = 0; })};
}

}  // namespace ursula
