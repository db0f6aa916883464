#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "parts/causes/tried_causes.h"

namespace ursula {
namespace {

/// Speeds where rates belong: friction that never changes its sign.
Vector6d withSpeeds(const MachineTerms& machine, bool viscous, bool coulomb) {
  Vector6d twist = machine.platform.twist;
  twist.tail<3>() -= machine.platform.omega().cross(machine.rho);
  Vector6d at_P = Vector6d::Zero();
  for (const OpenLeg& leg : machine.legs) {
    const Vector3d rates = leg.J.lu().solve(Vector3d(leg.P * twist));
    const CoulombFriction& dry = leg.numbers.coulomb;
    Vector3d more = Vector3d::Zero();
    for (int j = 0; j < 3; ++j) {
      const Coordinate coordinate = rowOf(leg.numbers.kind).coordinates[j];
      const double back = std::min(rates(j), 0.0);
      if (viscous) more(j) -= 2 * leg.numbers.friction.on(coordinate) * back;
      if (coulomb) more(j) -= 2 * dry.on(coordinate) * std::tanh(back / dry.speedOf(coordinate));
    }
    at_P += leg.atP(more);
  }
  return machine.T_P.transpose() * at_P;
}

void addSpeeds(TriedCauses& out) {
  for (const auto& [what, viscous, coulomb] :
       {std::tuple("viscous friction", true, false), {"Coulomb friction", false, true}, {"friction", true, true}})
    out.addEfforts(
        {std::string(what) + " of the rates' sizes, without their signs", {CauseKind::sign, "friction", "all"}},
        [viscous = viscous, coulomb = coulomb](const MachineTerms& machine) {
          return withSpeeds(machine, viscous, coulomb);
        });
}

/// What the rotors' accelerations lack.
void addRotorAccelerations(TriedCauses& out) {
  if (!hasRotors(out.machine)) return;
  for (const auto& [whose, of_platform] : {std::pair("of the legs", false), {"of legs and platform", true}})
    for (const auto& [way, times] : {std::pair("without", 1.0), {"with the wrong sign of", 2.0}})
      out.addEfforts({std::string("the rotors' accelerations ") + way + " the rate of the Jacobian " + whose,
                      {CauseKind::closure, "bias", "all"}},
                     [of_platform = of_platform, times = times](const MachineTerms& machine) {
                       Vector6d change;
                       for (int m = 0; m < motor_count; ++m) {
                         const Motor& motor = machine.motors[m];
                         const OpenLeg& leg = machine.legs[motor.leg];
                         const Vector3d off = of_platform ? Vector3d(leg.bias - leg.platform_bias) : leg.bias;
                         const double rotor = leg.numbers.rotor_inertia.on(motor.coordinate);
                         change(m) = times * rotor * leg.J.lu().solve(off)(motor.joint);
                       }
                       return change;
                     });
}

/// The change of the efforts if a leg's forces come by a wrong inverse of its own Jacobian, 3 × 3.
Vector6d throughLegJacobians(const MachineTerms& machine, Matrix3d (*inverse)(const Matrix3d& J)) {
  Vector6d at_P = machine.platform_wrench;
  std::vector<Eigen::Matrix<double, 6, 3>> of_legs;
  for (const OpenLeg& leg : machine.legs) {
    of_legs.emplace_back(leg.P.transpose() * inverse(leg.J));
    at_P += of_legs.back() * leg.efforts;
  }
  Matrix6d forces;
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = machine.motors[m];
    forces.col(m) = of_legs[motor.leg].col(motor.joint);
  }
  return forces.lu().solve(at_P) - machine.T_P.transpose() * machine.forceAtP();
}

void addLegJacobians(TriedCauses& out) {
  const std::pair<const char*, Matrix3d (*)(const Matrix3d&)> wrong[] = {
      {"the Jacobian", [](const Matrix3d& J) -> Matrix3d { return J; }},
      {"the transposed Jacobian", [](const Matrix3d& J) -> Matrix3d { return J.transpose(); }},
      {"the inverse Jacobian", [](const Matrix3d& J) -> Matrix3d { return J.inverse(); }}};
  for (const auto& [what, of] : wrong)
    out.addEfforts(
        {std::string(what) + " of each leg where its inverse transposed belongs", {CauseKind::jacobian, "", "legs"}},
        [of = of](const MachineTerms& machine) { return throughLegJacobians(machine, of); });
}

/// (A Aᵀ + x 1)⁻¹ A for the inverse of Aᵀ = T_P⁻ᵀ.
void addDamped(TriedCauses& out) {
  Cause cause;
  cause.solver = [](const Scenario& of, double x) {
    const Subject noc = nocSubject(*of.manipulator, of.load);
    return [machine = of.manipulator, load = of.load, noc, x](const Motion<double>& motion) {
      const Matrix6d A = machineTerms(*machine, load, motion).T_P.inverse();
      const Matrix6d damping = A * A.transpose() + x * Matrix6d::Identity();
      const Vector6d right = noc.torques(motion);
      return Vector6d(right - x * damping.ldlt().solve(right));
    };
  };
  cause.words = [](double x, double deviation) {
    return "the inverse of the transposed Jacobian damped by " + withDeviation(x, deviation) + " times the unit matrix";
  };
  cause.is_possible = [](double x) { return x > 0; };
  cause.named = [](double x, double) -> std::optional<NamedCause> {
    if (!(x > 0)) return std::nullopt;
    return NamedCause{CauseKind::jacobian, "", "all"};
  };
  out.push(cause);
}

/// How a solver takes a distal link's rates relative to the proximal link.
struct Relative {
  bool omega, rate;   ///< which of ω and ω̇
  bool joints_alone;  ///< ω̇ of the joints' accelerations alone, as if their axes did not turn
  bool centre;        ///< in the mass centre's acceleration too
};

Vector6d withRelativeRates(const MachineTerms& machine, const Relative& way) {
  Vector6d change = Vector6d::Zero();
  for (const OpenLeg& leg : machine.legs) {
    const LegKindRow& kind = rowOf(leg.numbers.kind);
    if (kind.isTelescopic() || kind.hasCarriage()) continue;  // those do not turn against each other, or not both turn
    const BodyTerms &first = leg.proximal, &link = leg.distal;
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

void addRelativeRates(TriedCauses& out) {
  for (const auto& [words, omega, rate] : {std::tuple("angular velocity and acceleration", true, true),
                                           {"angular velocity", true, false},
                                           {"angular acceleration", false, true}})
    for (const bool joints_alone : {false, true})
      for (const bool centre : {false, true}) {
        if (joints_alone && !rate) continue;
        const Relative way{omega, rate, joints_alone, centre};
        out.addEfforts({std::string(words) + " of the distal links relative to the proximal ones" +
                            (joints_alone ? ", without the turning of the joints' axes" : "") +
                            (centre ? "" : ", in the moments alone"),
                        {CauseKind::frame, omega ? "angular_velocity" : "angular_acceleration", "distal"}},
                       [way](const MachineTerms& machine) { return withRelativeRates(machine, way); });
      }
}

}  // namespace

void addJointCauses(TriedCauses& out) {
  addSpeeds(out);
  addRotorAccelerations(out);
  addLegJacobians(out);
  addRelativeRates(out);
  addDamped(out);
}

}  // namespace ursula
