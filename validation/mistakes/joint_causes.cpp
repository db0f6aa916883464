#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>

#include "validation/mistakes/cause.h"
#include "validation/mistakes/tried_causes.h"
#include "validation/subject/body_terms.h"

namespace ursula {
namespace {

const Leg& legOf(const Scenario& scenario, std::size_t leg) { return scenario.manipulator->leg(static_cast<int>(leg)); }

/// The coordinates' rates of one leg.
Vector3d ratesOf(const MachineTerms& machine, const OpenLeg& leg) {
  Vector6d twist = machine.platform.twist;
  twist.tail<3>() -= machine.platform.omega().cross(machine.rho);
  return leg.J.lu().solve(Vector3d(leg.P * twist));
}

/// Speeds where rates belong: friction that never changes its sign.
Vector6d withSpeeds(const Scenario& scenario, const MachineTerms& machine, bool viscous, bool coulomb) {
  Vector6d at_P = Vector6d::Zero();
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    const Leg& leg = legOf(scenario, i);
    const Vector3d rates = ratesOf(machine, machine.legs[i]);
    Vector3d more = Vector3d::Zero();
    for (int j = 0; j < 3; ++j) {
      const Coordinate coordinate = rowOf(leg.kind).coordinates[static_cast<std::size_t>(j)];
      const double back = std::min(rates(j), 0.0);
      if (viscous) more(j) -= 2 * leg.friction.on(coordinate) * back;
      if (coulomb) more(j) -= 2 * leg.coulomb.on(coordinate) * std::tanh(back / leg.coulomb.speedOf(coordinate));
    }
    at_P += machine.legs[i].P.transpose() * machine.legs[i].J.transpose().lu().solve(more);
  }
  return machine.T_P.transpose() * at_P;
}

void addSpeeds(const Scenario& scenario, EffortCauses& out) {
  for (const auto& [what, viscous, coulomb] :
       {std::tuple("viscous friction", true, false), {"Coulomb friction", false, true}, {"friction", true, true}})
    out.add(std::string(what) + " of the rates' sizes, without their signs", {CauseKind::sign, "friction", "all"},
            [&scenario, viscous = viscous, coulomb = coulomb](const MachineTerms& machine) {
              return withSpeeds(scenario, machine, viscous, coulomb);
            });
}

/// What the rotors' accelerations lack.
void addRotorAccelerations(const Scenario& scenario, EffortCauses& out) {
  const std::pair<const char*, std::function<Vector3d(const OpenLeg&)>> left_out[] = {
      {"of the legs", [](const OpenLeg& leg) { return leg.bias; }},
      {"of legs and platform", [](const OpenLeg& leg) { return Vector3d(leg.bias - leg.platform_bias); }}};
  for (const auto& [whose, off] : left_out)
    for (const auto& [way, times] : {std::pair("without", 1.0), {"with the wrong sign of", 2.0}})
      out.add(std::string("the rotors' accelerations ") + way + " the rate of the Jacobian " + whose,
              {CauseKind::closure, "bias", "all"}, [&scenario, off = off, times = times](const MachineTerms& machine) {
                Vector6d change;
                const Motors& motors = scenario.manipulator->motors();
                for (int m = 0; m < motor_count; ++m) {
                  const Motor& motor = motors[static_cast<std::size_t>(m)];
                  const OpenLeg& leg = machine.legs[static_cast<std::size_t>(motor.leg)];
                  const double rotor = scenario.manipulator->leg(motor.leg).rotor_inertia.on(motor.coordinate);
                  change(m) = times * rotor * leg.J.lu().solve(off(leg))(motor.joint);
                }
                return change;
              });
}

/// A leg's forces by a wrong inverse of its own Jacobian, 3 × 3.
void addLegJacobians(const Scenario& scenario, EffortCauses& out) {
  const std::pair<const char*, Matrix3d (*)(const Matrix3d&)> wrong[] = {
      {"the Jacobian", [](const Matrix3d& J) -> Matrix3d { return J; }},
      {"the transposed Jacobian", [](const Matrix3d& J) -> Matrix3d { return J.transpose(); }},
      {"the inverse Jacobian", [](const Matrix3d& J) -> Matrix3d { return J.inverse(); }}};
  for (const auto& [what, of] : wrong)
    out.add(std::string(what) + " of each leg where its inverse transposed belongs", {CauseKind::jacobian, "", "legs"},
            [&scenario, of = of](const MachineTerms& machine) {
              Matrix6d forces;
              Vector6d at_P = machine.platform_wrench;
              std::vector<Eigen::Matrix<double, 6, 3>> of_legs;
              for (const OpenLeg& leg : machine.legs) {
                of_legs.emplace_back(leg.P.transpose() * of(leg.J));
                at_P += of_legs.back() * leg.efforts;
              }
              const Motors& motors = scenario.manipulator->motors();
              for (int m = 0; m < motor_count; ++m) {
                const Motor& motor = motors[static_cast<std::size_t>(m)];
                forces.col(m) = of_legs[static_cast<std::size_t>(motor.leg)].col(motor.joint);
              }
              return Vector6d(forces.lu().solve(at_P) - machine.T_P.transpose() * machine.forceAtP());
            });
}

/// (A Aᵀ + x 1)⁻¹ A for the inverse of Aᵀ = T_P⁻ᵀ.
Cause damped(const Scenario& scenario) {
  Cause out;
  out.torques = [&scenario](double x, const std::vector<Motion<double>>& motions) {
    const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
    std::vector<Vector6d> efforts;
    for (const Motion<double>& motion : motions) {
      const MachineTerms machine = machineTerms(*scenario.manipulator, scenario.load, motion);
      const Matrix6d A = machine.T_P.inverse();
      const Matrix6d damping = A * A.transpose() + x * Matrix6d::Identity();
      const Vector6d right = noc.torques(motion);
      efforts.push_back(right - x * damping.ldlt().solve(right));
    }
    return efforts;
  };
  out.words = [](double x, double deviation) {
    return "the inverse of the transposed Jacobian damped by " + withDeviation(x, deviation) + " times the unit matrix";
  };
  out.named = [](double x, double) -> std::optional<NamedCause> {
    if (!(x > 0)) return std::nullopt;
    return NamedCause{CauseKind::jacobian, "", "all"};
  };
  out.is_possible = [](double x) { return x > 0; };
  return out;
}

/// How a solver takes a distal link's rates relative to the proximal link.
struct Relative {
  bool omega, rate;   ///< which of ω and ω̇
  bool joints_alone;  ///< ω̇ of the joints' accelerations alone, as if their axes did not turn
  bool centre;        ///< in the mass centre's acceleration too
};

Vector6d withRelativeRates(const Scenario& scenario, const MachineTerms& machine, const Relative& way) {
  Vector6d change = Vector6d::Zero();
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    const LegKindRow& kind = rowOf(scenario.manipulator->leg(static_cast<int>(i)).kind);
    if (kind.isTelescopic() || kind.hasCarriage()) continue;  // those do not turn against each other, or not both turn
    const BodyTerms &first = machine.proximal[i], &link = machine.distal[i];
    BodyTerms other = link;
    if (way.omega) other.twist.head<3>() -= first.omega();
    if (way.rate) other.twist_rate.head<3>() -= first.twist_rate.head<3>();
    if (way.joints_alone) other.twist_rate.head<3>() -= (link.bias - first.bias).head<3>();
    const auto around = [](const BodyTerms& body) -> Vector3d {
      const Vector3d omega = body.omega(), rate = body.twist_rate.head<3>();
      return rate.cross(body.from) + omega.cross(omega.cross(body.from));
    };
    if (way.centre) other.twist_rate.tail<3>() += around(other) - around(link);
    change += link.T.transpose() * (other.inertiaWrench(other.twist_rate) - link.inertiaWrench(link.twist_rate));
  }
  return change;
}

void addRelativeRates(const Scenario& scenario, EffortCauses& out) {
  for (const auto& [words, omega, rate] : {std::tuple("angular velocity and acceleration", true, true),
                                           {"angular velocity", true, false},
                                           {"angular acceleration", false, true}})
    for (const bool joints_alone : {false, true})
      for (const bool centre : {false, true}) {
        if (joints_alone && !rate) continue;
        const Relative way{omega, rate, joints_alone, centre};
        out.add(std::string(words) + " of the distal links relative to the proximal ones" +
                    (joints_alone ? ", without the turning of the joints' axes" : "") +
                    (centre ? "" : ", in the moments alone"),
                {CauseKind::frame, omega ? "angular_velocity" : "angular_acceleration", "distal"},
                [&scenario, way](const MachineTerms& machine) { return withRelativeRates(scenario, machine, way); });
      }
}

}  // namespace

std::vector<Cause> jointCauses(const Scenario& scenario) {
  EffortCauses out(scenario);
  addSpeeds(scenario, out);
  addRotorAccelerations(scenario, out);
  addLegJacobians(scenario, out);
  addRelativeRates(scenario, out);
  out.causes.push_back(damped(scenario));
  return std::move(out.causes);
}

}  // namespace ursula
