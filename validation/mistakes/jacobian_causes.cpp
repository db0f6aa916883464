#include <fmt/format.h>

#include <Eigen/LU>
#include <string>
#include <utility>

#include "validation/mistakes/tried_causes.h"
#include "validation/subject/body_terms.h"

namespace ursula {
namespace {

/// The change of the efforts if J' replaces J = T_P⁻¹ and `wrong_at_P` replaces `at_P`.
Vector6d throughJacobian(const MachineTerms& machine, const Matrix6d& wrong, const Vector6d& wrong_at_P,
                         const Vector6d& at_P) {
  return wrong.transpose().lu().solve(wrong_at_P) - machine.T_P.transpose() * at_P;
}

Matrix6d jacobian(const MachineTerms& machine) { return machine.T_P.inverse(); }

/// An arm of a leg's force, m.
using Arm = std::function<Vector3d(std::size_t leg)>;

/// Rows [arm × n; n].
Matrix6d jacobianOf(const Scenario& scenario, const MachineTerms& machine, const Arm& arm) {
  Matrix6d out = jacobian(machine);
  const Motors& motors = scenario.manipulator->motors();
  for (int m = 0; m < motor_count; ++m) {
    const Vector3d r = arm(static_cast<std::size_t>(motors[static_cast<std::size_t>(m)].leg));
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
void addTransposed(EffortCauses& out) {
  const NamedCause named{CauseKind::jacobian, "", "all"};
  const auto add = [&](const std::string& text, const auto& efforts) {
    out.addAlsoWithoutMotors(text, named, [efforts](const MachineTerms& machine) {
      return Vector6d(efforts(machine) - machine.T_P.transpose() * machine.forceAtP());
    });
  };
  for (const Matrix6d& before : {Matrix6d(Matrix6d::Identity()), swapped()}) {
    for (const Matrix6d& after : {Matrix6d(Matrix6d::Identity()), swapped()}) {
      const std::string order = before == after ? "" : ", forces and moments exchanged";
      add("the Jacobian's inverse not transposed" + order, [before, after](const MachineTerms& machine) {
        return Vector6d(after * machine.T_P * before * machine.forceAtP());
      });
      add("the transposed Jacobian where its inverse belongs" + order, [before, after](const MachineTerms& machine) {
        return Vector6d(after * jacobian(machine).transpose() * before * machine.forceAtP());
      });
    }
    const std::string order = before.isIdentity() ? "" : ", forces and moments exchanged";
    add("the Jacobian where its inverse belongs" + order,
        [before](const MachineTerms& machine) { return Vector6d(jacobian(machine) * before * machine.forceAtP()); });
  }
  add("forces and moments exchanged before the Jacobian",
      [](const MachineTerms& machine) { return Vector6d(machine.T_P.transpose() * swapped() * machine.forceAtP()); });
}

/// The generalised force at P if the legs' forces on the platform act at other points, `arm` from P.
Vector6d forceAtP(const MachineTerms& machine, const Arm& arm) {
  Vector6d out = machine.platform_wrench;
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    const Vector3d f = machine.legs[i].J.transpose().lu().solve(machine.legs[i].efforts);
    out += momentWrench(arm(i).cross(f)) + forceWrench(f);
  }
  return out;
}

void addJacobians(const Scenario& scenario, EffortCauses& out) {
  const NamedCause named{CauseKind::jacobian, "", "all"};
  const auto all = [](const MachineTerms& machine, const Arm& /*arm*/) { return machine.forceAtP(); };
  const auto platform = [](const MachineTerms& machine, const Arm& /*arm*/) { return machine.platform_wrench; };
  enum class Turn { none, back, opposite };
  for (const auto& [way, turn] : {std::pair("not turned into the base's frame", Turn::none),
                                  {"turned the wrong way", Turn::back},
                                  {"with the wrong sign", Turn::opposite}}) {
    const auto add = [&, way = way, turn = turn](const char* of, const auto& wrong_at_P, const auto& at_P) {
      out.add(fmt::format("the platform's points {} in the Jacobian{}", way, of), named,
              [&scenario, turn, wrong_at_P, at_P](const MachineTerms& machine) {
                const Arm arm = [&](std::size_t i) -> Vector3d {
                  const Vector3d b = scenario.manipulator->parameters().legs[i].platform_point;
                  if (turn == Turn::none) return b;
                  return turn == Turn::back ? Vector3d(machine.platform.R.transpose() * b)
                                            : Vector3d(-machine.legs[i].arm);
                };
                return throughJacobian(machine, jacobianOf(scenario, machine, arm), wrong_at_P(machine, arm),
                                       at_P(machine, arm));
              });
    };
    add("", all, all);
    add(", and where the legs' forces act", forceAtP, all);
    add(" of the platform's forces", platform, platform);
  }
  out.add("the legs' forces on the platform without their moments about P", {CauseKind::jacobian, "", "legs"},
          [](const MachineTerms& machine) {
            const Vector6d wrong = forceAtP(machine, [](std::size_t) { return Vector3d::Zero().eval(); });
            return Vector6d(machine.T_P.transpose() * (wrong - machine.forceAtP()));
          });
}

/// Some moments are about another point than P.
void addPoints(const Scenario& scenario, EffortCauses& out) {
  using FromPoint = Vector3d (*)(const MachineTerms&);  // leads to P, in B
  const std::pair<const char*, FromPoint> points[] = {
      {"the platform's mass centre", [](const MachineTerms& machine) { return Vector3d(-machine.rho); }},
      {"the base's origin", [](const MachineTerms& machine) { return Vector3d(machine.platform.c - machine.rho); }}};
  const NamedCause named{CauseKind::reference_point, "", "platform"};
  for (const auto& [words, to_P] : points) {
    for (const bool forces : {true, false})
      out.add(fmt::format("the {} about {}, the {} about P", forces ? "legs' forces" : "Jacobian", words,
                          forces ? "platform's" : "forces"),
              named, [&scenario, to_P = to_P, forces](const MachineTerms& machine) {
                const Arm arm = [&](std::size_t i) { return Vector3d(machine.legs[i].arm + to_P(machine)); };
                return throughJacobian(machine, jacobianOf(scenario, machine, arm),
                                       forces ? forceAtP(machine, arm) : machine.forceAtP(), machine.forceAtP());
              });
    out.add(fmt::format("the platform's forces about {} taken for such about P", words), named,
            [to_P = to_P](const MachineTerms& machine) {
              const Vector3d force = machine.platform_wrench.tail<3>();
              return Vector6d(machine.T_P.transpose() * momentWrench(to_P(machine).cross(force)));
            });
  }
}

/// Efforts of a leg's coordinates where its tip moves otherwise at the same place.
Vector3d openEffortsAt(const Scenario& scenario, std::size_t leg, Motion<double> motion, const Vector3d& velocity,
                       const Vector3d& acceleration) {
  motion.omega.setZero();
  motion.omega_dot.setZero();
  motion.p_dot = velocity;
  motion.p_ddot = acceleration;
  return machineTerms(*scenario.manipulator, scenario.load, motion).legs[leg].efforts;
}

/// The platform's points b not turned in the velocities of the legs' tips, in their accelerations, in the Jacobian.
struct NotTurned {
  bool accelerations = false, jacobian = false;
};

Vector6d withPointsNotTurned(const Scenario& scenario, const NotTurned& where, const Motion<double>& motion) {
  MachineTerms machine = machineTerms(*scenario.manipulator, scenario.load, motion);
  const Vector3d &w = motion.omega, &alpha = motion.omega_dot;
  const auto fixed = [&scenario](std::size_t i) -> Vector3d {
    return scenario.manipulator->parameters().legs[i].platform_point;
  };
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    const Vector3d b = where.accelerations ? fixed(i) : Vector3d(motion.Q * fixed(i));
    machine.legs[i].efforts = openEffortsAt(scenario, i, motion, motion.p_dot + w.cross(fixed(i)),
                                            motion.p_ddot + alpha.cross(b) + w.cross(w.cross(b)));
  }
  if (where.jacobian) return jacobianOf(scenario, machine, fixed).transpose().lu().solve(forceAtP(machine, fixed));
  return machine.T_P.transpose() * machine.forceAtP();
}

void addPointsNotTurned(const Scenario& scenario, EffortCauses& out) {
  for (const bool accelerations : {false, true})
    for (const bool jacobian : {true, false}) {
      const NamedCause named =
          jacobian ? NamedCause{CauseKind::jacobian, "", "all"} : NamedCause{CauseKind::frame, "orientation", "all"};
      const NotTurned where{accelerations, jacobian};
      out.causes.push_back(fixedCause(
          {std::string("the platform's points not turned into the base's frame in the velocities of the legs' tips") +
               (accelerations ? ", in their accelerations" : "") + (jacobian ? ", and in the Jacobian" : ""),
           named},
          [&scenario, where](const std::vector<Motion<double>>& motions) {
            std::vector<Vector6d> efforts;
            for (const Motion<double>& motion : motions)
              efforts.push_back(withPointsNotTurned(scenario, where, motion));
            return efforts;
          }));
    }
}

}  // namespace

std::vector<Cause> jacobianCauses(const Scenario& scenario) {
  EffortCauses out(scenario);
  addTransposed(out);
  addJacobians(scenario, out);
  addPoints(scenario, out);
  addPointsNotTurned(scenario, out);
  return std::move(out.causes);
}

}  // namespace ursula
