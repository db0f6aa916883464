// Other friction laws than viscous and c tanh(rate / speed), in torques and direct dynamics alike.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parts/prove/defects.h"

namespace ursula {
namespace {

/// The driving force against the friction of one joint, N·m.
using Law = double (*)(double viscous, double coulomb, double speed, double rate);

double rightLaw(double viscous, double coulomb, double speed, double rate) {
  return viscous * rate + coulomb * std::tanh(rate / speed);
}

/// The error of the forces at these rates.
using Excess = std::function<JointVariables<double>(const Manipulator&, const JointVariables<double>& rates)>;

Excess excessOf(Law law) {
  return [law](const Manipulator& machine, const JointVariables<double>& rates) {
    JointVariables<double> out;
    for (int i = 0; i < machine.legCount(); ++i) {
      const Leg& leg = machine.leg(i);
      for (const Coordinate q : rowOf(leg.kind).coordinates) {
        const double viscous = leg.friction.on(q), coulomb = leg.coulomb.on(q);
        const double rate = rates.of(q)(i), speed = leg.coulomb.speedOf(q);
        out.of(q)(i) = law(viscous, coulomb, speed, rate) - rightLaw(viscous, coulomb, speed, rate);
      }
    }
    return out;
  };
}

Subject withFriction(const Manipulator& machine, const std::shared_ptr<const Load>& load, const Excess& excess) {
  const Subject right = nocSubject(machine, load);
  Subject wrong = right;
  const auto solver = std::make_shared<const Solver<double>>(machine);
  const auto more = [solver, machine, excess](const Motion<double>& m) {
    Workspace<double> work;
    solver->inverseKinematics(m, work);
    return onActuators(*solver, m, excess(machine, solver->rates(work)));
  };
  wrong.torques = [right, more](const Motion<double>& m) { return Vector6d(right.torques(m) + more(m)); };
  wrong.accelerations = [right, more](const Motion<double>& m, const Vector6d& torques) {
    return right.accelerations(m, torques - more(m));
  };
  wrong.rebuilt = [excess](const Manipulator& other) { return withFriction(other, nullptr, excess); };
  return wrong;
}

Defect wrongForces(const char* name, const Excess& excess) {
  return {name, "friction", [excess](const Scenario& s) { return withFriction(*s.manipulator, s.load, excess); }};
}

Defect wrongLaw(const char* name, Law law) { return wrongForces(name, excessOf(law)); }

double kneeForce(const Leg& leg, double rate) {
  return rightLaw(leg.friction.theta, leg.coulomb.theta, leg.coulomb.smoothing_speed, rate);
}

/// Returns the error of a knee that rubs against the base instead of the proximal link, with ψ + θ. If `acts_so`, the
/// force also acts on ψ.
Excess absoluteKnee(bool acts_so) {
  return [acts_so](const Manipulator& machine, const JointVariables<double>& rates) {
    JointVariables<double> out;
    for (int i = 0; i < machine.legCount(); ++i) {
      const double force = kneeForce(machine.leg(i), rates.psi(i) + rates.theta(i));
      out.theta(i) = force - kneeForce(machine.leg(i), rates.theta(i));
      if (acts_so) out.psi(i) = force;
    }
    return out;
  };
}

Defect wrongNumbers(const std::string& name, const std::function<void(Leg&)>& change) {
  return wrongMachine(name, "friction",
                      [change](ManipulatorParameters& m) { std::for_each(m.legs.begin(), m.legs.end(), change); });
}

std::vector<Defect> wrongShapes() {
  constexpr double half_pi = 1.57079632679489661923;
  return {
      wrongLaw(
          "sign with a dead zone for tanh",
          [](double b, double c, double v, double w) { return b * w + (std::abs(w) > v ? std::copysign(c, w) : 0); }),
      wrongLaw("x / sqrt(1 + x^2) for tanh x",
               [](double b, double c, double v, double w) { return b * w + c * (w / v) / std::hypot(1, w / v); }),
      wrongLaw("atan for tanh",
               [](double b, double c, double v, double w) { return b * w + c * std::atan(half_pi * w / v) / half_pi; }),
      wrongLaw("tanh x by x - x^3/3 where x < 0.1",
               [](double b, double c, double v, double w) {
                 const double x = w / v;
                 return b * w + c * (std::abs(x) < 0.1 ? x - x * x * x / 3 : std::tanh(x));
               }),
      wrongLaw("tanh x taken for 1 where x > 5",
               [](double b, double c, double v, double w) {
                 const double x = w / v;
                 return b * w + c * (std::abs(x) > 5 ? std::copysign(1, x) : std::tanh(x));
               }),
      wrongLaw(
          "Coulomb friction 1e-8 larger backwards",
          [](double b, double c, double v, double w) { return b * w + (w < 0 ? 1 + 1e-8 : 1) * c * std::tanh(w / v); }),
      wrongLaw("viscous friction that falls by 1e-7 of itself a rad/s",
               [](double b, double c, double v, double w) {
                 return b * w * (1 - 1e-7 * std::abs(w)) + c * std::tanh(w / v);
               }),
      wrongLaw("viscous friction up to half the smoothing speed only", [](double b, double c, double v, double w) {
        return (std::abs(w) > v / 2 ? 0 : b * w) + c * std::tanh(w / v);
      })};
}

/// Defects for each coordinate that a leg of the machine has.
std::vector<Defect> wrongOnCoordinates(const Manipulator& machine) {
  std::vector<Defect> out;
  for (const Coordinate q : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d}) {
    const bool none = std::none_of(machine.parameters().legs.begin(), machine.parameters().legs.end(),
                                   [q](const Leg& leg) { return leg.friction.on(q) != 0 || leg.coulomb.on(q) != 0; });
    if (none) continue;
    append(
        out,
        {wrongNumbers(fmt::format("no viscous friction on {}", nameOf(q)), [q](Leg& leg) { leg.friction.on(q) = 0; }),
         wrongNumbers(fmt::format("no Coulomb friction on {}", nameOf(q)), [q](Leg& leg) { leg.coulomb.on(q) = 0; }),
         wrongNumbers(fmt::format("friction on {} off by 1e-6 of itself", nameOf(q)), [q](Leg& leg) {
           leg.friction.on(q) *= 1 + 1e-6;
           leg.coulomb.on(q) *= 1 + 1e-6;
         })});
  }
  append(out, {wrongNumbers("viscous coefficients of the last two coordinates swapped",
                            [](Leg& leg) {
                              const auto& q = rowOf(leg.kind).coordinates;
                              std::swap(leg.friction.on(q[1]), leg.friction.on(q[2]));
                            }),
               wrongNumbers("Coulomb friction with the first coordinate's coefficient on all",
                            [](Leg& leg) {
                              const auto& q = rowOf(leg.kind).coordinates;
                              leg.coulomb.on(q[1]) = leg.coulomb.on(q[2]) = leg.coulomb.on(q[0]);
                            }),
               wrongNumbers("smoothing speeds off by 1e-6",
                            [](Leg& leg) {
                              leg.coulomb.smoothing_speed *= 1 + 1e-6;
                              leg.coulomb.sliding_speed *= 1 + 1e-6;
                            }),
               wrongNumbers("smoothing speed by default, 0.01 rad/s or m/s", [](Leg& leg) {
                 leg.coulomb.smoothing_speed = CoulombFriction{}.smoothing_speed;
                 leg.coulomb.sliding_speed = CoulombFriction{}.sliding_speed;
               })});
  return out;
}

}  // namespace

std::vector<Defect> frictionDefects(const Manipulator& machine) {
  std::vector<Defect> out = wrongShapes();
  if (!machine.isOfThePaper()) {
    append(out, wrongOnCoordinates(machine));
    return out;
  }
  append(out, {wrongForces("knee's friction by the absolute rate", absoluteKnee(false)),
               wrongForces("knee's friction by and on the absolute angle", absoluteKnee(true)),
               wrongNumbers("Coulomb friction with the motor's coefficient in all joints",
                            [](Leg& leg) { leg.coulomb.psi = leg.coulomb.theta = leg.coulomb.phi; }),
               wrongNumbers("viscous coefficients of psi and theta swapped",
                            [](Leg& leg) { std::swap(leg.friction.psi, leg.friction.theta); }),
               wrongNumbers("no Coulomb friction in the knees", [](Leg& leg) { leg.coulomb.theta = 0; }),
               wrongNumbers("smoothing speeds off by 1e-6", [](Leg& leg) { leg.coulomb.smoothing_speed *= 1 + 1e-6; }),
               wrongNumbers("smoothing speed by default, 0.01 rad/s",
                            [](Leg& leg) { leg.coulomb.smoothing_speed = CoulombFriction{}.smoothing_speed; })});
  return out;
}

}  // namespace ursula
