#include "validation/mistakes/tried_causes.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "validation/limits/conditioning.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using Rows = std::vector<Vector6d>;
using Motions = std::vector<Motion<double>>;
using MotionChange = std::function<void(Motion<double>&)>;
using MachineChange = std::function<void(ManipulatorParameters&, const Matrix3d& Q)>;

/// Uses another machine at each instant.
Cause notTurned(const Scenario& scenario, const CauseName& name, const MachineChange& change) {
  return fixedCause(name, [&scenario, change](const Motions& motions) {
    Rows out;
    for (const Motion<double>& motion : motions) {
      ManipulatorParameters machine = scenario.manipulator->parameters();
      change(machine, motion.Q);
      out.push_back(nocSubject(withoutStroke(Manipulator(machine)), scenario.load).torques(motion));
    }
    return out;
  });
}

/// "kg" if all motors slide, else "kg m^2".
const char* rotorUnit(const Manipulator& machine) {
  const Motors& motors = machine.motors();
  return std::all_of(motors.begin(), motors.end(), [](const Motor& motor) { return motor.slides(); }) ? "kg" : "kg m^2";
}

double leastRotor(const Manipulator& machine) {
  double least = std::numeric_limits<double>::infinity();
  for (const Motor& motor : machine.motors())
    least = std::min(least, machine.leg(motor.leg).rotor_inertia.on(motor.coordinate));
  return least;
}

/// τ + J q̈: an additional inertia on every motor.
Cause motorInertia(const Scenario& scenario) {
  const std::string unit = rotorUnit(*scenario.manipulator);
  return {true,
          [&scenario](double x, const Motions& motions) {
            const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
            const Motors& motors = scenario.manipulator->motors();
            Rows out;
            for (const Motion<double>& motion : motions)
              out.push_back(noc.torques(motion) + x * noc.kinematics(motion).joints.q_ddot.driven(motors));
            return out;
          },
          [unit](double x, double deviation) {
            return fmt::format("an inertia of {} {} on every motor beyond the scenario's", withDeviation(x, deviation),
                               unit);
          },
          {},
          [unit](double x, double deviation) -> std::optional<NamedCause> {
            if (x < 0) return std::nullopt;  // a negative inertia is impossible
            NamedCause out{CauseKind::missing_term, "rotor_inertia", "all"};
            out.expected = 0;
            out.found = x;
            out.uncertainty = deviation;
            out.unit = unit;
            return out;
          },
          {},
          [least = leastRotor(*scenario.manipulator)](double x) { return x > -least; }};
}

/// Replaces twist and twist rate of P by those of the mass centre C.
void ofMassCentre(Motion<double>& motion, const Vector3d& rho, double sign) {
  const Vector3d r = sign * (motion.Q * rho);
  motion.p_dot += motion.omega.cross(r);
  motion.p_ddot += motion.omega_dot.cross(r) + motion.omega.cross(motion.omega.cross(r));
}

/// Returns a function that adds a cause for a motion that is read otherwise.
auto readingsInto(const Scenario& scenario, std::vector<Cause>& out) {
  return
      [&](const CauseName& name, const MotionChange& change) { out.push_back(readOtherwise(scenario, name, change)); };
}

void addFrames(const Scenario& scenario, std::vector<Cause>& out) {
  const auto add = readingsInto(scenario, out);
  add({"Q taken for its transpose", NamedCause{CauseKind::frame, "orientation", "all"}},
      [](Motion<double>& motion) { motion.Q.transposeInPlace(); });
  add({"the quaternion read as x, y, z, w where it is w, x, y, z", NamedCause{CauseKind::frame, "orientation", "all"}},
      [](Motion<double>& motion) {
        const Eigen::Quaterniond q(motion.Q);
        motion.Q = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
      });
  add({"omega and its rate taken in the platform's frame for such in the base's",
       NamedCause{CauseKind::frame, "angular_velocity", "all"}},
      [](Motion<double>& motion) {
        motion.omega = (motion.Q.transpose() * motion.omega).eval();
        motion.omega_dot = (motion.Q.transpose() * motion.omega_dot).eval();
      });
  add({"omega and its rate in the base's frame taken for such in the platform's",
       NamedCause{CauseKind::frame, "angular_velocity", "all"}},
      [](Motion<double>& motion) {
        motion.omega = (motion.Q * motion.omega).eval();
        motion.omega_dot = (motion.Q * motion.omega_dot).eval();
      });
  const std::pair<const char*, bool> ways[] = {{" taken in the platform's frame for such in the base's", true},
                                               {" in the base's frame taken for such in the platform's", false}};
  for (const auto& [words, back] : ways) {
    const auto turn = [back = back](const Matrix3d& Q, const Vector3d& of) -> Vector3d {
      if (back) return Q.transpose() * of;
      return Q * of;
    };
    add({std::string("omega alone") + words, NamedCause{CauseKind::frame, "angular_velocity", "all"}},
        [turn](Motion<double>& motion) { motion.omega = turn(motion.Q, motion.omega); });
    add({std::string("the rate of omega alone") + words, NamedCause{CauseKind::frame, "angular_acceleration", "all"}},
        [turn](Motion<double>& motion) { motion.omega_dot = turn(motion.Q, motion.omega_dot); });
  }
  const auto turn_back = [](Motion<double>& motion) {
    for (Vector3d* each : {&motion.p_dot, &motion.p_ddot}) *each = (motion.Q.transpose() * *each).eval();
  };
  add({"velocity and acceleration of P taken in the platform's frame for such in the base's",
       NamedCause{CauseKind::frame, "", "all"}},
      turn_back);
  add({"all rates taken in the platform's frame for such in the base's", NamedCause{CauseKind::frame, "", "all"}},
      [turn_back](Motion<double>& motion) {
        turn_back(motion);
        for (Vector3d* each : {&motion.omega, &motion.omega_dot}) *each = (motion.Q.transpose() * *each).eval();
      });
  add({"omega and its rate with the wrong sign", NamedCause{CauseKind::sign, "angular_velocity", "all"}},
      [](Motion<double>& motion) {
        motion.omega *= -1;
        motion.omega_dot *= -1;
      });
  const Vector3d rho = scenario.manipulator->platform().center_of_mass;
  add({"velocity and acceleration of the platform's mass centre taken for those of P",
       NamedCause{CauseKind::reference_point, "", "platform"}},
      [rho](Motion<double>& motion) { ofMassCentre(motion, rho, 1); });
  add({"velocity and acceleration of P taken for those of the platform's mass centre",
       NamedCause{CauseKind::reference_point, "", "platform"}},
      [rho](Motion<double>& motion) { ofMassCentre(motion, rho, -1); });
  for (const auto& [words, sign] : {std::pair("the platform's mass centre taken for that of P", 1.0),
                                    {"P taken for that of the platform's mass centre", -1.0}})
    add({std::string("the acceleration alone of ") + words, NamedCause{CauseKind::reference_point, "", "platform"}},
        [rho, sign = sign](Motion<double>& motion) {
          const Vector3d velocity = motion.p_dot;
          ofMassCentre(motion, rho, sign);
          motion.p_dot = velocity;
        });
  add({"the position of the platform's mass centre taken for that of P",
       NamedCause{CauseKind::reference_point, "", "platform"}},
      [rho](Motion<double>& motion) { motion.p += motion.Q * rho; });
  add({"the position of P taken for that of the platform's mass centre",
       NamedCause{CauseKind::reference_point, "", "platform"}},
      [rho](Motion<double>& motion) { motion.p -= motion.Q * rho; });
  add({"the path of P taken for that of the platform's mass centre",
       NamedCause{CauseKind::reference_point, "", "platform"}},
      [rho](Motion<double>& motion) {
        ofMassCentre(motion, rho, -1);
        motion.p -= motion.Q * rho;
      });
}

void addLeftOut(const Scenario& scenario, std::vector<Cause>& out) {
  const auto add = readingsInto(scenario, out);
  add({"the angular acceleration left out", NamedCause{CauseKind::missing_term, "angular_acceleration", "all"}},
      [](Motion<double>& motion) { motion.omega_dot.setZero(); });
  add({"the acceleration of P left out", NamedCause{CauseKind::missing_term, "inertia", "all"}},
      [](Motion<double>& motion) { motion.p_ddot.setZero(); });
  add({"the angular velocity left out", NamedCause{CauseKind::missing_term, "angular_velocity", "all"}},
      [](Motion<double>& motion) { motion.omega.setZero(); });
  add({"the velocity of P left out", NamedCause{CauseKind::missing_term, "coriolis", "all"}},
      [](Motion<double>& motion) { motion.p_dot.setZero(); });
  add({"the angular acceleration with the wrong sign", NamedCause{CauseKind::sign, "angular_acceleration", "all"}},
      [](Motion<double>& motion) { motion.omega_dot *= -1; });
  add({"the acceleration of P with the wrong sign", NamedCause{CauseKind::sign, "inertia", "all"}},
      [](Motion<double>& motion) { motion.p_ddot *= -1; });
  add({"the motion run backwards in time, velocities as well"}, [&scenario](Motion<double>& motion) {
    motion = scenario.trajectory->at(scenario.trajectory->duration() - motion.t);
  });
}

void addNotTurned(const Scenario& scenario, std::vector<Cause>& out) {
  const auto add = [&](const CauseName& name, const MachineChange& change) {
    out.push_back(notTurned(scenario, name, change));
  };
  const NamedCause orientation{CauseKind::frame, "orientation", "platform"};
  for (const auto& [way, times] : {std::pair(" not turned into the base's frame", 1), {" turned the wrong way", 2}}) {
    const auto back = [times = times](Vector3d& point, const Matrix3d& Q) {
      for (int k = 0; k < times; ++k) point = (Q.transpose() * point).eval();
    };
    add({std::string("the platform's mass centre") + way, orientation},
        [back](ManipulatorParameters& machine, const Matrix3d& Q) { back(machine.platform.center_of_mass, Q); });
    add({std::string("the platform's points") + way, orientation},
        [back](ManipulatorParameters& machine, const Matrix3d& Q) {
          for (Leg& leg : machine.legs) back(leg.platform_point, Q);
        });
  }
  add({"the platform's products of inertia with the other sign (as CAD writes them)",
       NamedCause{CauseKind::sign, "inertia", "platform"}},
      [](ManipulatorParameters& machine, const Matrix3d& /*Q*/) {
        Matrix3d& inertia = machine.platform.inertia;
        inertia = (2 * Matrix3d(inertia.diagonal().asDiagonal()) - inertia).eval();
      });
  add({"gravity taken in the platform's frame", NamedCause{CauseKind::frame, "gravity", "all"}},
      [](ManipulatorParameters& machine, const Matrix3d& Q) { machine.gravity = (Q * machine.gravity).eval(); });
  add({"gravity turned into the platform's frame instead of the base's",
       NamedCause{CauseKind::frame, "gravity", "all"}},
      [](ManipulatorParameters& machine, const Matrix3d& Q) {
        machine.gravity = (Q.transpose() * machine.gravity).eval();
      });
}

void addLoads(const Scenario& scenario, std::vector<Cause>& out) {
  if (!scenario.load) return;
  const auto add = [&](const CauseName& name, const std::function<void(Load&, const Matrix3d& Q)>& change) {
    out.push_back(fixedCause(name, [&scenario, change](const Motions& motions) {
      Rows torques;
      for (const Motion<double>& motion : motions) {
        const auto other = std::make_shared<Load>(*scenario.load);
        change(*other, motion.Q);
        torques.push_back(nocSubject(*scenario.manipulator, other).torques(motion));
      }
      return torques;
    }));
  };
  add({"the load taken in the other one's frame, of base and platform",
       NamedCause{CauseKind::frame, "load", "platform"}},
      [](Load& load, const Matrix3d& /*Q*/) {
        load.frame = load.frame == Load::Frame::base ? Load::Frame::platform : Load::Frame::base;
      });
  for (const auto& [which, part] :
       {std::pair("force", &Load::force), {"moment", &Load::moment}, {"point", &Load::point}})
    add({fmt::format("the load's {} with the wrong sign", which), NamedCause{CauseKind::sign, "load", "platform"}},
        [part = part](Load& load, const Matrix3d& /*Q*/) { load.*part *= -1; });
  const Vector3d rho = scenario.manipulator->platform().center_of_mass;
  for (const auto& [where, point] : {std::pair("P", Vector3d::Zero().eval()), {"the platform's mass centre", rho}})
    add({std::string("the load taken to act at ") + where, NamedCause{CauseKind::reference_point, "load", "platform"}},
        [point = point](Load& load, const Matrix3d& /*Q*/) { load.point = point; });
  for (const auto& [way, times] : {std::pair("not turned into the base's frame", 1), {"turned the wrong way", 2}})
    add({std::string("the point where the load acts ") + way, NamedCause{CauseKind::frame, "load", "platform"}},
        [times = times](Load& load, const Matrix3d& Q) {
          for (int k = 0; k < times; ++k) load.point = (Q.transpose() * load.point).eval();
        });
}

}  // namespace

Manipulator withoutStroke(const Manipulator& machine) {
  ManipulatorParameters out = machine.parameters();
  for (Leg& leg : out.legs) {
    if (leg.kind != LegKind::UPS) continue;
    const double whole = leg.proximal.length + leg.distal.length, shorter = 0.999 * leg.distal.length;
    leg.proximal.length = 10 * whole;
    leg.distal.length -= shorter;
    leg.distal.center_of_mass -= shorter;  // at the same place
  }
  return Manipulator(out);
}

Cause readOtherwise(const Scenario& scenario, const CauseName& name,
                    const std::function<void(Motion<double>&)>& change) {
  Cause out = fixedCause(name, [&scenario, change](const Motions& motions) {
    const Subject noc = nocSubject(withoutStroke(*scenario.manipulator), scenario.load);
    Rows torques;
    for (Motion<double> motion : motions) {
      change(motion);
      torques.push_back(noc.torques(motion));
    }
    return torques;
  });
  out.rounding = [&scenario, change](Motion<double> motion) {
    change(motion);
    return ConditioningProbe(withoutStroke(*scenario.manipulator), scenario.load).at(motion).torqueRounding();
  };
  return out;
}

std::vector<Cause> motionCauses(const Scenario& scenario) {
  std::vector<Cause> out;
  addFrames(scenario, out);
  addLeftOut(scenario, out);
  addNotTurned(scenario, out);
  addLoads(scenario, out);
  if (!hasRotors(*scenario.manipulator)) out.push_back(motorInertia(scenario));
  return out;
}

}  // namespace ursula
