#include <fmt/format.h>

#include <Eigen/LU>
#include <string>
#include <utility>

#include "parts/causes/tried_causes.h"

namespace ursula {
namespace {

const NamedCause wrong_jacobian{CauseKind::jacobian, "", "all"};

Matrix6d jacobian(const MachineTerms& machine) { return machine.T_P.inverse(); }

/// The arm of a leg's force, m.
using Arm = std::function<Vector3d(const OpenLeg&)>;

/// Rows [arm × n; n].
Matrix6d jacobianOf(const MachineTerms& machine, const Arm& arm) {
  Matrix6d out = jacobian(machine);
  for (int m = 0; m < motor_count; ++m) {
    const int leg = machine.motors[m].leg;
    const Vector3d r = arm(machine.legs[leg]);
    out.row(m).head<3>() = r.cross(Vector3d(out.row(m).tail<3>())).transpose();
  }
  return out;
}

/// Swaps [ω; v] to [v; ω]: a transposed Jacobian reveals its order.
Matrix6d swapped() {
  Matrix6d out = Matrix6d::Zero();
  out.topRightCorner<3, 3>() = out.bottomLeftCorner<3, 3>() = Matrix3d::Identity();
  return out;
}

/// Mistakes of shape and order; in `before` and `after` a matrix meets [v; ω] where [ω; v] belongs.
void addTransposed(TriedCauses& out) {
  const auto add = [&](const std::string& text, const auto& efforts) {
    out.addAlsoWithoutMotors(text, wrong_jacobian, [efforts](const MachineTerms& machine) {
      return Vector6d(efforts(machine) - machine.T_P.transpose() * machine.forceAtP());
    });
  };
  const std::string exchanged = ", forces and moments exchanged";
  for (const Matrix6d& before : {Matrix6d(Matrix6d::Identity()), swapped()}) {
    for (const Matrix6d& after : {Matrix6d(Matrix6d::Identity()), swapped()}) {
      const std::string order = before == after ? "" : exchanged;
      add("the Jacobian's inverse not transposed" + order, [before, after](const MachineTerms& machine) {
        return Vector6d(after * machine.T_P * before * machine.forceAtP());
      });
      add("the transposed Jacobian where its inverse belongs" + order, [before, after](const MachineTerms& machine) {
        return Vector6d(after * jacobian(machine).transpose() * before * machine.forceAtP());
      });
    }
    add("the Jacobian where its inverse belongs" + (before.isIdentity() ? "" : exchanged),
        [before](const MachineTerms& machine) { return Vector6d(jacobian(machine) * before * machine.forceAtP()); });
  }
  add("forces and moments exchanged before the Jacobian",
      [](const MachineTerms& machine) { return Vector6d(machine.T_P.transpose() * swapped() * machine.forceAtP()); });
}

/// The generalised force at P if the legs' forces on the platform act at other points, `arm` from P.
Vector6d forceAtP(const MachineTerms& machine, const Arm& arm) {
  Vector6d out = machine.platform_wrench;
  for (const OpenLeg& leg : machine.legs) {
    const Vector3d f = leg.J.transpose().lu().solve(leg.efforts);
    out += momentWrench(arm(leg).cross(f)) + forceWrench(f);
  }
  return out;
}

/// The change of the efforts of the legs' and the platform's forces, at P, with other arms in the Jacobian. Perhaps the
/// legs' forces act there too.
Vector6d throughJacobian(const MachineTerms& machine, const Arm& arm, bool forces) {
  return jacobianOf(machine, arm).transpose().lu().solve(forces ? forceAtP(machine, arm) : machine.forceAtP()) -
         machine.T_P.transpose() * machine.forceAtP();
}

void addJacobians(TriedCauses& out) {
  enum class Turn { none, back, opposite };
  for (const auto& [way, turn] : {std::pair("not turned into the base's frame", Turn::none),
                                  {"turned the wrong way", Turn::back},
                                  {"with the wrong sign", Turn::opposite}}) {
    const auto arms = [turn = turn](const MachineTerms& machine) -> Arm {
      return [turn, R = machine.platform.R](const OpenLeg& leg) -> Vector3d {
        const Vector3d& b = leg.numbers.platform_point;
        return turn == Turn::none ? b : turn == Turn::back ? Vector3d(R.transpose() * b) : Vector3d(-leg.arm);
      };
    };
    const std::string text = fmt::format("the platform's points {} in the Jacobian", way);
    for (const auto& [where, forces] : {std::pair("", false), {", and where the legs' forces act", true}})
      out.addEfforts({text + where, wrong_jacobian}, [arms, forces = forces](const MachineTerms& machine) {
        return throughJacobian(machine, arms(machine), forces);
      });
    out.addEfforts({text + " of the platform's forces", wrong_jacobian}, [arms](const MachineTerms& machine) {
      return Vector6d(jacobianOf(machine, arms(machine)).transpose().lu().solve(machine.platform_wrench) -
                      machine.T_P.transpose() * machine.platform_wrench);
    });
  }
  out.addEfforts({"the legs' forces on the platform without their moments about P", {CauseKind::jacobian, "", "legs"}},
                 [](const MachineTerms& machine) {
                   const Vector6d wrong = forceAtP(machine, [](const OpenLeg&) { return Vector3d::Zero().eval(); });
                   return Vector6d(machine.T_P.transpose() * (wrong - machine.forceAtP()));
                 });
}

/// Some moments are about another point than P.
void addPoints(TriedCauses& out) {
  using FromPoint = Vector3d (*)(const MachineTerms&);  // leads to P, in B
  const std::pair<const char*, FromPoint> points[] = {
      {"the platform's mass centre", [](const MachineTerms& machine) { return Vector3d(-machine.rho); }},
      {"the base's origin", [](const MachineTerms& machine) { return Vector3d(machine.platform.c - machine.rho); }}};
  const NamedCause named{CauseKind::reference_point, "", "platform"};
  for (const auto& [words, to_P] : points) {
    for (const bool forces : {true, false})
      out.addEfforts({fmt::format("the {} about {}, the {} about P", forces ? "legs' forces" : "Jacobian", words,
                                  forces ? "platform's" : "forces"),
                      named},
                     [to_P = to_P, forces](const MachineTerms& machine) {
                       const Vector3d to = to_P(machine);
                       return throughJacobian(
                           machine, [to](const OpenLeg& leg) { return Vector3d(leg.arm + to); }, forces);
                     });
    out.addEfforts({fmt::format("the platform's forces about {} taken for such about P", words), named},
                   [to_P = to_P](const MachineTerms& machine) {
                     const Vector3d force = machine.platform_wrench.tail<3>();
                     return Vector6d(machine.T_P.transpose() * momentWrench(to_P(machine).cross(force)));
                   });
  }
}

/// The efforts with the platform's points b not turned in the velocities of the legs' tips, perhaps in their
/// accelerations and in the Jacobian.
Vector6d withPointsNotTurned(const Manipulator& whole, const std::shared_ptr<const Load>& load, bool accelerations,
                             bool jacobian, const Motion<double>& at) {
  MachineTerms machine = machineTerms(whole, load, at);
  const Arm fixed = [](const OpenLeg& leg) { return leg.numbers.platform_point; };
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    OpenLeg& leg = machine.legs[i];
    const Vector3d b = accelerations ? fixed(leg) : Vector3d(at.Q * fixed(leg));
    Motion<double> tip = at;  // the leg's tip moves otherwise at the same place
    tip.omega.setZero();
    tip.omega_dot.setZero();
    tip.p_dot = at.p_dot + at.omega.cross(fixed(leg));
    tip.p_ddot = at.p_ddot + at.omega_dot.cross(b) + at.omega.cross(at.omega.cross(b));
    leg.efforts = machineTerms(whole, load, tip).legs[i].efforts;
  }
  if (jacobian) return jacobianOf(machine, fixed).transpose().lu().solve(forceAtP(machine, fixed));
  return machine.T_P.transpose() * machine.forceAtP();
}

void addPointsNotTurned(TriedCauses& out) {
  for (const bool accelerations : {false, true})
    for (const bool jacobian : {true, false})
      out.add(
          {std::string("the platform's points not turned into the base's frame in the velocities of the legs' tips") +
               (accelerations ? ", in their accelerations" : "") + (jacobian ? ", and in the Jacobian" : ""),
           jacobian ? wrong_jacobian : NamedCause{CauseKind::frame, "orientation", "all"}},
          [accelerations, jacobian](const Scenario& of) {
            return [whole = of.manipulator, load = of.load, accelerations, jacobian](const Motion<double>& motion) {
              return withPointsNotTurned(*whole, load, accelerations, jacobian, motion);
            };
          });
}

}  // namespace

void addJacobianCauses(TriedCauses& out) {
  addTransposed(out);
  addJacobians(out);
  addPoints(out);
  addPointsNotTurned(out);
}

}  // namespace ursula
