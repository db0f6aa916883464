#include <fmt/format.h>

#include <Eigen/Geometry>
#include <memory>
#include <tuple>
#include <utility>

#include "base/scalar.h"
#include "parts/causes/tried_causes.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;
using Change = std::function<void(Motion<double>&)>;
using Of = std::vector<Vector3d Motion<double>::*>;

constexpr auto velocity_of_P = &Motion<double>::p_dot, acceleration_of_P = &Motion<double>::p_ddot;
constexpr auto angular_velocity = &Motion<double>::omega, angular_acceleration = &Motion<double>::omega_dot;

Change multiplied(double factor, const Of& of) {
  return [of, factor](Motion<double>& motion) {
    for (const auto each : of) motion.*each *= factor;
  };
}

/// Into the platform's frame or out of it.
Change turned(bool into, const Of& of) {
  return [into, of](Motion<double>& motion) {
    for (const auto each : of) {
      const Vector3d before = motion.*each;
      if (into)
        motion.*each = motion.Q.transpose() * before;
      else
        motion.*each = motion.Q * before;
    }
  };
}

/// Reads twist and twist rate of P for those of the mass centre, or the other way round (−1).
void addMassCentre(TriedCauses& out) {
  struct Row {
    const char* words;
    double position, velocity, acceleration;
  };
  for (const Row& row : {Row{"velocity and acceleration of the platform's mass centre taken for those of P", 0, 1, 1},
                         {"velocity and acceleration of P taken for those of the platform's mass centre", 0, -1, -1},
                         {"the acceleration alone of the platform's mass centre taken for that of P", 0, 0, 1},
                         {"the acceleration alone of P taken for that of the platform's mass centre", 0, 0, -1},
                         {"the position of the platform's mass centre taken for that of P", 1, 0, 0},
                         {"the position of P taken for that of the platform's mass centre", -1, 0, 0},
                         {"the path of P taken for that of the platform's mass centre", -1, -1, -1}})
    out.addReading({row.words, {CauseKind::reference_point, "", "platform"}},
                   [row, rho = out.machine.platform().center_of_mass](Motion<double>& motion) {
                     const Vector3d r = motion.Q * rho, w = motion.omega;
                     motion.p += row.position * r;
                     motion.p_dot += row.velocity * w.cross(r);
                     motion.p_ddot += row.acceleration * (motion.omega_dot.cross(r) + w.cross(w.cross(r)));
                   });
}

void addFrames(TriedCauses& out) {
  const auto add = [&](const std::string& text, CauseKind kind, const char* term, const Change& change) {
    out.addReading({text, {kind, term, "all"}}, change);
  };
  const std::pair<const char*, bool> ways[] = {{" taken in the platform's frame for such in the base's", true},
                                               {" in the base's frame taken for such in the platform's", false}};
  add("Q taken for its transpose", CauseKind::frame, "orientation",
      [](Motion<double>& motion) { motion.Q.transposeInPlace(); });
  add("the quaternion read as x, y, z, w where it is w, x, y, z", CauseKind::frame, "orientation",
      [](Motion<double>& motion) {
        const Eigen::Quaterniond q(motion.Q);
        motion.Q = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
      });
  for (const auto& [words, into] : ways)
    add(std::string("omega and its rate") + words, CauseKind::frame, "angular_velocity",
        turned(into, {angular_velocity, angular_acceleration}));
  for (const auto& [words, into] : ways) {
    add(std::string("omega alone") + words, CauseKind::frame, "angular_velocity", turned(into, {angular_velocity}));
    add(std::string("the rate of omega alone") + words, CauseKind::frame, "angular_acceleration",
        turned(into, {angular_acceleration}));
  }
  add(std::string("velocity and acceleration of P") + ways[0].first, CauseKind::frame, "",
      turned(true, {velocity_of_P, acceleration_of_P}));
  add(std::string("all rates") + ways[0].first, CauseKind::frame, "",
      turned(true, {velocity_of_P, acceleration_of_P, angular_velocity, angular_acceleration}));
  add("omega and its rate with the wrong sign", CauseKind::sign, "angular_velocity",
      multiplied(-1, {angular_velocity, angular_acceleration}));
  addMassCentre(out);
  for (const auto& [words, kind, factor] :
       {std::tuple(" left out", CauseKind::missing_term, 0), {" with the wrong sign", CauseKind::sign, -1}}) {
    add(std::string("the angular acceleration") + words, kind, "angular_acceleration",
        multiplied(factor, {angular_acceleration}));
    add(std::string("the acceleration of P") + words, kind, "inertia", multiplied(factor, {acceleration_of_P}));
    if (factor != 0) continue;
    add("the angular velocity left out", kind, "angular_velocity", multiplied(0, {angular_velocity}));
    add("the velocity of P left out", kind, "coriolis", multiplied(0, {velocity_of_P}));
  }
  out.addReading(
      CauseName("the motion run backwards in time, velocities as well"),
      [&path = *out.scenario.trajectory](Motion<double>& motion) { motion = path.at(path.duration() - motion.t); });
}

/// Quantities of the platform's frame taken in the base's as they are, or turned the wrong way.
constexpr std::pair<const char*, int> not_turned[] = {{"not turned into the base's frame", 1},
                                                      {"turned the wrong way", 2}};
Vector3d turnedBack(int times, const Matrix3d& Q, Vector3d point) {
  for (int k = 0; k < times; ++k) point = (Q.transpose() * point).eval();
  return point;
}

void addNotTurned(TriedCauses& out) {
  const NamedCause orientation{CauseKind::frame, "orientation", "platform"},
      gravity{CauseKind::frame, "gravity", "all"};
  for (const auto& [way, times] : not_turned) {
    out.addNotTurned({fmt::format("the platform's mass centre {}", way), orientation},
                     [times = times](Machine& machine, const Matrix3d& Q) {
                       Vector3d& rho = machine.platform.center_of_mass;
                       rho = turnedBack(times, Q, rho);
                     });
    out.addNotTurned({fmt::format("the platform's points {}", way), orientation},
                     [times = times](Machine& machine, const Matrix3d& Q) {
                       for (Leg& leg : machine.legs) leg.platform_point = turnedBack(times, Q, leg.platform_point);
                     });
  }
  out.addNotTurned({"the platform's products of inertia with the other sign (as CAD writes them)",
                    {CauseKind::sign, "inertia", "platform"}},
                   [](Machine& machine, const Matrix3d& /*Q*/) {
                     Matrix3d& inertia = machine.platform.inertia;
                     inertia = (2 * Matrix3d(inertia.diagonal().asDiagonal()) - inertia).eval();
                   });
  out.addNotTurned({"gravity taken in the platform's frame", gravity},
                   [](Machine& machine, const Matrix3d& Q) { machine.gravity = (Q * machine.gravity).eval(); });
  out.addNotTurned({"gravity turned into the platform's frame instead of the base's", gravity},
                   [](Machine& machine, const Matrix3d& Q) { machine.gravity = turnedBack(1, Q, machine.gravity); });
}

void addLoads(TriedCauses& out) {
  if (!out.scenario.load) return;
  const auto add = [&out](const std::string& text, CauseKind kind,
                          const std::function<void(Load&, const Matrix3d& Q)>& change) {
    out.add({text, {kind, "load", "platform"}}, [change](const Scenario& of) {
      return [machine = of.manipulator, load = of.load, change](const Motion<double>& motion) {
        const auto other = std::make_shared<Load>(*load);
        change(*other, motion.Q);
        return nocSubject(*machine, other).torques(motion);
      };
    });
  };
  add("the load taken in the other one's frame, of base and platform", CauseKind::frame,
      [](Load& load, const Matrix3d& /*Q*/) {
        load.frame = load.frame == Load::Frame::base ? Load::Frame::platform : Load::Frame::base;
      });
  for (const auto& [which, part] :
       {std::pair("force", &Load::force), {"moment", &Load::moment}, {"point", &Load::point}})
    add(fmt::format("the load's {} with the wrong sign", which), CauseKind::sign,
        [part = part](Load& load, const Matrix3d& /*Q*/) { load.*part *= -1; });
  const Vector3d rho = out.machine.platform().center_of_mass;
  for (const auto& [where, point] : {std::pair("P", Vector3d::Zero().eval()), {"the platform's mass centre", rho}})
    add(fmt::format("the load taken to act at {}", where), CauseKind::reference_point,
        [point = point](Load& load, const Matrix3d& /*Q*/) { load.point = point; });
  for (const auto& [way, times] : not_turned)
    add(fmt::format("the point where the load acts {}", way), CauseKind::frame,
        [times = times](Load& load, const Matrix3d& Q) { load.point = turnedBack(times, Q, load.point); });
}

/// τ + J q̈: an additional inertia on every motor.
void addMotorInertia(TriedCauses& out) {
  const char* unit = allSlide(out.machine.motors()) ? "kg" : "kg m^2";
  Cause cause;
  cause.solver = [](const Scenario& of, double x) {
    const Subject noc = nocSubject(*of.manipulator, of.load);
    return [machine = of.manipulator, noc, x](const Motion<double>& motion) {
      const JointVariables<double> q_ddot = noc.kinematics(motion).joints.q_ddot;
      return Vector6d(noc.torques(motion) + x * q_ddot.driven(machine->motors()));
    };
  };
  cause.words = [unit](double x, double deviation) {
    return fmt::format("an inertia of {} {} on every motor beyond the scenario's", withDeviation(x, deviation), unit);
  };
  cause.named = [unit](double x, double deviation) -> std::optional<NamedCause> {
    if (x < 0) return std::nullopt;  // a negative inertia is impossible
    return NamedCause{CauseKind::missing_term, "rotor_inertia", "all", "", unit, 0, x, deviation};
  };
  cause.is_possible = [](double x) { return x > 0; };
  out.push(cause);
}

/// The factor of numbers read in another unit, or with a wrong factor (CauseKind::scale).
void addUnits(TriedCauses& out) {
  const auto add = [&out](const std::string& text, const char* term, double factor, const Of& of,
                          CauseKind kind = CauseKind::units) {
    out.addReading({text, {kind, term, "all", "", "", 1, factor}}, multiplied(factor, of));
  };
  constexpr double millimetres = 1000, degrees = degrees_per_radian;
  const char *velocities = "angular_velocity", *accelerations = "angular_acceleration";
  add("omega in degrees per second", velocities, degrees, {angular_velocity});
  add("omega in degrees per second, taken for radians", velocities, 1 / degrees, {angular_velocity});
  add("the rate of omega in degrees", accelerations, degrees, {angular_acceleration});
  add("the rate of omega in degrees, taken for radians", accelerations, 1 / degrees, {angular_acceleration});
  add("the velocity of P in millimetres", "velocity", millimetres, {velocity_of_P});
  add("the acceleration of P in millimetres", "acceleration", millimetres, {acceleration_of_P});
  add("omega and its rate in degrees", velocities, degrees, {angular_velocity, angular_acceleration});
  add("omega and its rate in degrees, taken for radians", velocities, 1 / degrees,
      {angular_velocity, angular_acceleration});
  for (const auto& [what, of] : {std::pair("the angular velocity", Of{angular_velocity}),
                                 {"omega and its rate", Of{angular_velocity, angular_acceleration}}})
    for (const auto& [words, factor] : {std::pair("half of", 0.5), {"twice", 2.0}})
      add(fmt::format("{} {}, by the factor of 2 of a quaternion's rate", words, what), velocities, factor, of,
          CauseKind::scale);
}

}  // namespace

void addMotionCauses(TriedCauses& out) {
  addFrames(out);
  addNotTurned(out);
  addLoads(out);
  if (!hasRotors(out.machine)) addMotorInertia(out);
  addAngleCauses(out);
  addUnits(out);
}

}  // namespace ursula
