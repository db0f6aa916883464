#include <fmt/format.h>

#include <tuple>

#include "parts/causes/tried_causes.h"

namespace ursula {
namespace {

/// The change of efforts that one leg's mistake makes.
using LegChange = std::function<Vector6d(const OpenLeg&)>;

/// Σ over the telescopic legs.
Vector6d ofRods(const MachineTerms& machine, const LegChange& change) {
  Vector6d out = Vector6d::Zero();
  for (const OpenLeg& leg : machine.legs)
    if (leg.numbers.kind == LegKind::UPS) out += change(leg);
  return out;
}

/// The effort of each motor that slides, of its leg; 0 for the others.
Vector6d ofSliding(const MachineTerms& machine, const std::function<double(const OpenLeg&, int motor)>& effort) {
  Vector6d out = Vector6d::Zero();
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = machine.motors[m];
    if (motor.slides()) out(m) = effort(machine.legs[motor.leg], m);
  }
  return out;
}

/// The change of the efforts if `body` is at c, fixed to the moving `carrier` instead of where it belongs.
Vector6d carried(const BodyTerms& body, const BodyTerms& carrier, const Vector3d& c) {
  BodyTerms moved = carrier;
  moved.mass = body.mass;
  moved.inertia = body.inertia;
  const Vector3d r = c - carrier.c, omega = carrier.omega(), omega_dot = carrier.twist_rate.head<3>();
  moved.twist.tail<3>() += omega.cross(r);
  moved.twist_rate.tail<3>() += omega_dot.cross(r) + omega.cross(omega.cross(r));
  for (int k = 0; k < motor_count; ++k) moved.T.col(k).tail<3>() += Vector3d(carrier.T.col(k).head<3>()).cross(r);
  return moved.efforts() - body.efforts();
}

/// The distance from the base's joint to the rod's outer end, m.
double lengthOf(const OpenLeg& leg) {
  const Link& rod = leg.numbers.distal;
  return leg.distal.line.dot(leg.distal.from) + rod.length - rod.center_of_mass;
}
Vector3d baseJoint(const OpenLeg& leg) { return leg.proximal.c - leg.proximal.from; }

/// Cylinders slide along with their rods, or rods stay with their cylinders.
void addMeasuredAlongTheOther(TriedCauses& out) {
  out.addEfforts({"mass centres of the cylinders measured back from the platform's joints",
                  {CauseKind::reference_point, "", "proximal"}},
                 [](const MachineTerms& machine) {
                   return ofRods(machine, [](const OpenLeg& leg) {
                     const double along = lengthOf(leg) - leg.numbers.proximal.center_of_mass;
                     return carried(leg.proximal, leg.distal, baseJoint(leg) + along * leg.distal.line);
                   });
                 });
  out.addEfforts(
      {"mass centres of the rods measured from the base's joints", {CauseKind::reference_point, "", "distal"}},
      [](const MachineTerms& machine) {
        return ofRods(machine, [](const OpenLeg& leg) {
          const double along = leg.numbers.distal.center_of_mass;
          return carried(leg.distal, leg.proximal, baseJoint(leg) + along * leg.distal.line);
        });
      });
}

/// The distance of a rod's mass centre from the base's joint if it does not change; the rod slides, or rests.
void addRodsAt(bool slides, TriedCauses& out) {
  Cause cause;
  cause.solver = [slides](const Scenario& of, double h) {
    const Subject noc = nocSubject(*of.manipulator, of.load);
    return [whole = of.manipulator, load = of.load, slides, h, noc](const Motion<double>& motion) {
      const MachineTerms machine = machineTerms(*whole, load, motion);
      return Vector6d(noc.torques(motion) + ofRods(machine, [&](const OpenLeg& leg) {
                        return carried(leg.distal, slides ? leg.distal : leg.proximal,
                                       baseJoint(leg) + h * leg.distal.line);
                      }));
    };
  };
  cause.words = [slides](double h, double deviation) {
    return fmt::format("mass centres of the rods fixed at {} m from the base's joints{}", withDeviation(h, deviation),
                       slides ? ", though the rods slide" : "");
  };
  cause.named = [](double, double) { return NamedCause{CauseKind::reference_point, "", "distal"}; };
  const double usual =
      machineTerms(out.machine, out.scenario.load, out.scenario.trajectory->at(0)).legs[0].distal.from.norm();
  cause.starts.clear();
  for (int tenths = 1; tenths <= 20; ++tenths) cause.starts.push_back(0.1 * tenths * usual);
  out.push(cause);
}

/// The solver forgets that a rod gains speed along its line.
void addAlongRods(TriedCauses& out) {
  for (const auto& [way, kind, share] :
       {std::tuple("left out", CauseKind::missing_term, 1.0), {"with the wrong sign", CauseKind::sign, 2.0}})
    out.addEfforts(
        {fmt::format("the acceleration of the rods along their lines {}, which is their mass on every motor", way),
         {kind, "inertia", "distal"}},
        [share = share](const MachineTerms& machine) {
          return ofRods(machine, [share](const OpenLeg& leg) {
            const BodyTerms& rod = leg.distal;
            const double h = rod.line.dot(rod.from), turning = rod.omega().cross(rod.line).squaredNorm();
            const double along = rod.line.dot(Vector3d(rod.twist_rate.tail<3>())) + h * turning;
            return Vector6d(-share * (rod.T.transpose() * forceWrench(rod.mass * along * rod.line)));
          });
        });
}

/// d̈ = e·a + v²/d of a point across the line: the solver forgets the second part, in rods and rotors.
void addBiasAlongRods(TriedCauses& out) {
  out.addEfforts({"the part of the rods' acceleration along their lines that comes from turning left out",
                  {CauseKind::closure, "bias", "distal"}},
                 [](const MachineTerms& machine) {
                   return ofSliding(machine, [](const OpenLeg& leg, int) {
                     if (leg.numbers.kind != LegKind::UPS) return 0.0;
                     const BodyTerms& rod = leg.distal;
                     return -(rod.mass + leg.numbers.rotor_inertia.d) * lengthOf(leg) *
                            rod.omega().cross(rod.line).squaredNorm();
                   });
                 });
}

/// The solver mistakes the Coriolis acceleration in the joints' accelerations, and perhaps in the rods' too.
void addCoriolis(TriedCauses& out) {
  const std::tuple<double, CauseKind, const char*> mistakes[] = {{1, CauseKind::missing_term, "left out of"},
                                                                 {0.5, CauseKind::missing_term, "halved in"},
                                                                 {-1, CauseKind::scale, "doubled in"},
                                                                 {2, CauseKind::sign, "with the wrong sign in"}};
  for (const auto& [share, kind, words] : mistakes)
    for (const bool rods : {true, false})
      out.addEfforts({fmt::format("the Coriolis acceleration {} the joints' accelerations{}", words,
                                  rods ? " and the rods'" : " alone"),
                      {kind, "coriolis", "legs", "", "", 1, 1 - share}},
                     [share = share, rods](const MachineTerms& machine) {
                       Vector6d change = machine.ofAccelerations([](const OpenLeg& leg) { return leg.coriolis; });
                       if (rods)
                         for (const OpenLeg& leg : machine.legs)
                           change -= leg.distal.T.transpose() * forceWrench(leg.distal.mass * leg.coriolis);
                       return Vector6d(share * change);
                     });
}

/// Only the forces along the legs reach the platform.
void addForcesAcross(TriedCauses& out) {
  out.addEfforts({"the forces of the legs across their lines left out", {CauseKind::missing_term, "inertia", "legs"}},
                 [](const MachineTerms& machine) {
                   return Vector6d(machine.T_P.transpose() * ofRods(machine, [](const OpenLeg& leg) {
                                     return Vector6d(-leg.atP({leg.efforts(0), leg.efforts(1), 0}));
                                   }));
                 });
}

/// The solver gives the forces along the rods of carriages, and not those along the rails.
void addUndivided(TriedCauses& out) {
  out.addEfforts({"the carriages' forces along the rods, not along the rails", {CauseKind::jacobian, "", "all"}},
                 [](const MachineTerms& machine) {
                   const Vector6d right = machine.T_P.transpose() * machine.forceAtP();
                   return ofSliding(machine, [&right](const OpenLeg& leg, int motor) {
                     if (!rowOf(leg.numbers.kind).hasCarriage()) return 0.0;
                     return right(motor) / leg.distal.line.dot(leg.numbers.base_axis.normalized()) - right(motor);
                   });
                 });
}

}  // namespace

void addSlidingCauses(TriedCauses& out) {
  addUndivided(out);
  addForcesAcross(out);
  addCoriolis(out);
  addAlongRods(out);
  addBiasAlongRods(out);
  addMeasuredAlongTheOther(out);
  for (const bool slides : {true, false}) addRodsAt(slides, out);
}

}  // namespace ursula
