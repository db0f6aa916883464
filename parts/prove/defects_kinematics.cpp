// This file has two groups of defects. The first are in the kinematics that the solver returns beside its torques. The
// others act in a narrow range: about a millisecond of a motion of three seconds, and never at a sample.

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "parts/fast/solver.h"
#include "parts/prove/defects.h"

namespace ursula {
namespace {

Defect wrongKinematics(const std::string& name, const std::function<void(KinematicAnswer&)>& change) {
  Defect out{name, "kinematics", [change](const Scenario& s) {
               const Subject right = nocSubject(*s.manipulator, s.load);
               Subject wrong = right;
               wrong.kinematics = [right, change](const Motion<double>& m) {
                 KinematicAnswer answer = right.kinematics(m);
                 change(answer);
                 return answer;
               };
               return wrong;
             }};
  out.formulations_wanted = 1;
  return out;
}

/// Makes Ṫ wrong only for joint rates perpendicular to those of the motion, so that no product with them reveals it.
void faultAcrossMotion(const Motors& motors, KinematicAnswer& answer) {
  const Vector6d rate = answer.joints.q_dot.driven(motors);
  const double size = rate.squaredNorm();
  Matrix6d across = Matrix6d::Identity();
  if (size > 0) across -= rate * rate.transpose() / size;
  answer.T_rate *= Matrix6d::Identity() + 1e-6 * across;
}

/// Returns the index of a leg after the first whose proximal link turns; 0 if there is none.
std::size_t turningLink(const Manipulator& machine) {
  for (std::size_t i = 1; i < machine.parameters().legs.size(); ++i)
    if (!rowOf(machine.parameters().legs[i].kind).hasCarriage()) return i;
  return 0;
}

using ChangeCoordinate = void (*)(double& q, double& rate, double& acceleration, const Leg& leg);

/// Measures one coordinate of all legs differently, which no effort reveals.
Defect countedOtherwise(Coordinate q, const char* how, ChangeCoordinate change) {
  Defect out{fmt::format("{} counted {}", nameOf(q), how), "kinematics", [q, change](const Scenario& s) {
               const Subject right = nocSubject(*s.manipulator, s.load);
               Subject wrong = right;
               wrong.kinematics = [right, machine = *s.manipulator, q, change](const Motion<double>& m) {
                 KinematicAnswer answer = right.kinematics(m);
                 JointMotion& joints = answer.joints;
                 for (int i = 0; i < machine.legCount(); ++i) {
                   const auto& has = rowOf(machine.leg(i).kind).coordinates;
                   if (std::find(has.begin(), has.end(), q) != has.end())
                     change(joints.q.of(q)(i), joints.q_dot.of(q)(i), joints.q_ddot.of(q)(i), machine.leg(i));
                 }
                 return answer;
               };
               return wrong;
             }};
  out.formulations_wanted = 1;
  return out;
}

/// Returns defects in which coordinates have the opposite sign, or count from another axis or from the other end.
std::vector<Defect> otherCoordinates(const Manipulator& machine) {
  constexpr double half_pi = 1.57079632679489661923;
  std::vector<Defect> out;
  for (const Coordinate q : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d}) {
    const auto has = [&](LegKind kind) {
      const auto& of = rowOf(kind).coordinates;
      return std::find(of.begin(), of.end(), q) != of.end();
    };
    const std::vector<LegKind> kinds = kindsOf(machine);
    if (std::none_of(kinds.begin(), kinds.end(), has)) continue;
    out.push_back(countedOtherwise(q, "with the other sign", [](double& x, double& v, double& a, const Leg&) {
      x = -x;
      v = -v;
      a = -a;
    }));
    out.push_back(slides(q)
                      ? countedOtherwise(q, "from the other end of the rod",
                                         [](double& x, double&, double&, const Leg& leg) { x -= leg.distal.length; })
                      : countedOtherwise(q, "from the axis across",
                                         [](double& x, double&, double&, const Leg&) { x -= half_pi; }));
  }
  return out;
}

}  // namespace

std::vector<Defect> kinematicDefects(const Manipulator& machine) {
  using K = KinematicAnswer;
  const auto at = [](std::size_t leg) { return static_cast<int>(leg); };
  const std::size_t second = legOf(machine, 2), third = legOf(machine, 3), fifth = legOf(machine, 5), first = 0;
  const std::size_t turning = machine.isOfThePaper() ? fifth : turningLink(machine),
                    fourth = otherLeg(machine, 4, third);
  const std::size_t spinning = machine.isOfThePaper() ? second : turning;
  const Coordinate q_3 = coordinatesOf(machine, third)[1], q_5 = coordinatesOf(machine, fifth)[2],
                   q_1 = machine.motors().front().coordinate;
  const std::string knees = machine.isOfThePaper() ? "knee" : nameOf(q_5);
  std::vector<Defect> out = {
      wrongKinematics(fmt::format("{} of leg 3 off by 1e-10", nameOf(q_3)),
                      [=](K& k) { k.joints.q.of(q_3)(at(third)) += 1e-10; }),
      wrongKinematics(fmt::format("{}'s rate off by 1e-9 of itself, leg {}", knees, fifth + 1),
                      [=](K& k) { k.joints.q_dot.of(q_5)(at(fifth)) *= 1 + 1e-9; }),
      wrongKinematics("motor's acceleration off by 1e-9 of itself, leg 1",
                      [=](K& k) { k.joints.q_ddot.of(q_1)(at(first)) *= 1 + 1e-9; }),
      wrongKinematics("mass centre of a distal link off by 1e-10 m",
                      [=](K& k) { k.bodies[leg_count + fourth].c.z() += 1e-10; }),
      wrongKinematics(
          "orientation of a proximal link off by 1e-10",
          [=](K& k) { k.bodies[turning].R = Eigen::AngleAxisd(1e-10, Vector3d::UnitX()) * k.bodies[turning].R; }),
      wrongKinematics("spin of a proximal link off by 1e-9 of itself",
                      [=](K& k) { k.bodies[spinning].twist.head<3>() *= 1 + 1e-9; }),
      wrongKinematics("velocity of a distal link off by 1e-9 of itself",
                      [](K& k) { k.bodies[leg_count].twist.tail<3>() *= 1 + 1e-9; }),
      wrongKinematics("acceleration of the platform's mass centre off by 1e-9 of itself",
                      [](K& k) { k.bodies[2 * leg_count].twist_rate.tail<3>() *= 1 + 1e-9; }),
      wrongKinematics(fmt::format("links of legs 3 and {} exchanged", fourth + 1),
                      [=](K& k) { std::swap(k.bodies[third], k.bodies[fourth]); }),
      wrongKinematics("T off by 1e-9 of itself", [](K& k) { k.T *= 1 + 1e-9; }),
      wrongKinematics("T_dot off by 1e-8 of itself", [](K& k) { k.T_rate *= 1 + 1e-8; }),
      wrongKinematics("T_dot off by 1e-6 of itself, but for the rates of the motion",
                      [motors = machine.motors()](K& k) { faultAcrossMotion(motors, k); }),
      control(wrongKinematics("kinematics: no fault", [](K&) {}))};
  if (!machine.isOfThePaper()) append(out, otherCoordinates(machine));
  return out;
}

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

/// Returns the range of `quantity` during the pulse.
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
  out.formulations_wanted = 1;
  return out;
}

using ChangeLeg = std::function<void(Vector6d& torques)>;

/// Changes the torques only during a pulse.
Defect pulse(const char* name, double share, const ChangeLeg& change) {
  Defect out = wrongTorques(name, "branch", [share, change](const Scenario& s) -> ChangeTorques {
    return [pulse = Pulse(*s.trajectory, share), change](const Vector6d& torques, const Motion<double>& m) {
      Vector6d wrong = torques;
      if (pulse.has(m.t)) change(wrong);
      return wrong;
    };
  });
  out.formulations_wanted = 1;
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
