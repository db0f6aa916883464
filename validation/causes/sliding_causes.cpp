#include <fmt/format.h>

#include <Eigen/LU>
#include <tuple>
#include <utility>

#include "validation/causes/tried_causes.h"
#include "validation/subject/body_terms.h"

namespace ursula {
namespace {

/// `body` at c, fixed to the moving `carrier` instead of where it belongs.
BodyTerms carried(const BodyTerms& body, const BodyTerms& carrier, const Vector3d& c) {
  BodyTerms out = carrier;
  out.mass = body.mass;
  out.inertia = body.inertia;
  out.c = c;
  const Vector3d r = c - carrier.c, omega = carrier.omega(), omega_dot = carrier.twist_rate.head<3>();
  out.twist.tail<3>() += omega.cross(r);
  out.twist_rate.tail<3>() += omega_dot.cross(r) + omega.cross(omega.cross(r));
  for (int k = 0; k < motor_count; ++k) out.T.col(k).tail<3>() += Vector3d(carrier.T.col(k).head<3>()).cross(r);
  return out;
}

Vector6d effortsOfBody(const MachineTerms& machine, const BodyTerms& body) {
  return body.T.transpose() * (body.inertiaWrench(body.twist_rate) - body.gravityWrench(machine.gravity));
}

/// The change of the efforts if cylinders slide along with their rods, or rods stay with their cylinders.
Vector6d measuredAlongTheOther(const Scenario& scenario, const MachineTerms& machine, bool cylinders) {
  Vector6d change = Vector6d::Zero();
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    const Leg& leg = scenario.manipulator->leg(static_cast<int>(i));
    if (leg.kind != LegKind::UPS) continue;
    const BodyTerms &cylinder = machine.proximal[i], &rod = machine.distal[i];
    const Vector3d A = cylinder.c - cylinder.from, e = rod.line;
    const double d = e.dot(rod.from) + leg.distal.length - leg.distal.center_of_mass;
    change += cylinders ? effortsOfBody(machine, carried(cylinder, rod, A + (d - leg.proximal.center_of_mass) * e)) -
                              effortsOfBody(machine, cylinder)
                        : effortsOfBody(machine, carried(rod, cylinder, A + leg.distal.center_of_mass * e)) -
                              effortsOfBody(machine, rod);
  }
  return change;
}

/// The solver mistakes the Coriolis acceleration in the joints' accelerations, and perhaps in the rods' too.
void addCoriolis(EffortCauses& out) {
  const std::tuple<double, CauseKind, const char*> mistakes[] = {{1, CauseKind::missing_term, "left out of"},
                                                                 {0.5, CauseKind::missing_term, "halved in"},
                                                                 {-1, CauseKind::scale, "doubled in"},
                                                                 {2, CauseKind::sign, "with the wrong sign in"}};
  for (const auto& [share, kind, words] : mistakes)
    for (const bool rods : {true, false})
      out.add(fmt::format("the Coriolis acceleration {} the joints' accelerations{}", words,
                          rods ? " and the rods'" : " alone"),
              {kind, "coriolis", "legs", "", "", 1, 1 - share}, [share = share, rods](const MachineTerms& machine) {
                Vector6d change = machine.ofAccelerations([](const OpenLeg& leg) { return leg.coriolis; });
                for (std::size_t i = 0; rods && i < machine.legs.size(); ++i) {
                  const BodyTerms& rod = machine.distal[i];
                  change -= rod.T.transpose() * forceWrench(rod.mass * machine.legs[i].coriolis);
                }
                return Vector6d(share * change);
              });
}

/// Only the forces along the legs reach the platform.
void addForcesAcross(const Scenario& scenario, EffortCauses& out) {
  out.add("the forces of the legs across their lines left out", {CauseKind::missing_term, "inertia", "legs"},
          [&scenario](const MachineTerms& machine) {
            Vector6d at_P = Vector6d::Zero();
            for (std::size_t i = 0; i < machine.legs.size(); ++i) {
              if (scenario.manipulator->leg(static_cast<int>(i)).kind != LegKind::UPS) continue;
              const OpenLeg& leg = machine.legs[i];
              Vector3d across = leg.efforts;
              across(2) = 0;
              at_P -= leg.P.transpose() * leg.J.transpose().lu().solve(across);
            }
            return Vector6d(machine.T_P.transpose() * at_P);
          });
}

/// The solver gives the forces along the rods of carriages, and not those along the rails.
void addUndivided(const Scenario& scenario, EffortCauses& out) {
  out.add("the carriages' forces along the rods, not along the rails", {CauseKind::jacobian, "", "all"},
          [&scenario](const MachineTerms& machine) {
            Vector6d change = Vector6d::Zero();
            const Vector6d right = machine.T_P.transpose() * machine.forceAtP();
            for (int m = 0; m < motor_count; ++m) {
              const Motor& motor = scenario.manipulator->motors()[static_cast<std::size_t>(m)];
              const Leg& leg = scenario.manipulator->leg(motor.leg);
              if (!rowOf(leg.kind).hasCarriage() || !motor.slides()) continue;
              const double along =
                  machine.distal[static_cast<std::size_t>(motor.leg)].line.dot(leg.base_axis.normalized());
              change(m) = right(m) / along - right(m);
            }
            return change;
          });
}

}  // namespace

std::vector<Cause> slidingCauses(const Scenario& scenario) {
  EffortCauses out(scenario);
  addUndivided(scenario, out);
  addForcesAcross(scenario, out);
  addCoriolis(out);
  for (const bool cylinders : {true, false})
    out.add(cylinders ? "mass centres of the cylinders measured back from the platform's joints"
                      : "mass centres of the rods measured from the base's joints",
            {CauseKind::reference_point, "", cylinders ? "proximal" : "distal"},
            [&scenario, cylinders](const MachineTerms& machine) {
              return measuredAlongTheOther(scenario, machine, cylinders);
            });
  return std::move(out.causes);
}

}  // namespace ursula
