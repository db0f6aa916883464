// Defects in the kinematics that the solver returns beside its torques.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "nocsolver/solver.h"
#include "studies/prove/defect_helpers.h"

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
  out.engines = 1;
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

/// The index of a leg whose proximal link turns; 0 if there is none.
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
  out.engines = 1;
  return out;
}

/// Coordinates with the opposite sign, about another axis, or from the other end.
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

}  // namespace ursula
