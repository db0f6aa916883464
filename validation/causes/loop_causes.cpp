#include <fmt/format.h>

#include <Eigen/LU>
#include <string>
#include <utility>

#include "base/dense.h"
#include "validation/causes/tried_causes.h"
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

/// Three per leg, in leg order.
using Coordinates = Eigen::VectorXd;

Vector6d ofMotors(const Scenario& scenario, const Coordinates& efforts) {
  Vector6d out;
  const Motors& motors = scenario.manipulator->motors();
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = motors[static_cast<std::size_t>(m)];
    out(m) = efforts(3 * motor.leg + motor.joint);
  }
  return out;
}

Coordinates openEfforts(const MachineTerms& machine) {
  Coordinates out(3 * static_cast<Eigen::Index>(machine.legs.size()));
  for (std::size_t i = 0; i < machine.legs.size(); ++i)
    out.segment<3>(3 * static_cast<Eigen::Index>(i)) = machine.legs[i].efforts;
  return out;
}

Vector6d exactEfforts(const MachineTerms& machine) { return machine.T_P.transpose() * machine.forceAtP(); }

/// The platform hangs on leg 1 alone.
Vector6d openThroughLeg1(const Scenario& scenario, const MachineTerms& machine) {
  Coordinates all = openEfforts(machine);
  all.head<3>() += machine.legs[0].J.transpose() * machine.platform_wrench.tail<3>();
  return ofMotors(scenario, all);
}

/// Forces of all coordinates, including the platform's six, minus the best fit of the closures' multipliers. `r` leads
/// from P to the point of the platform's speeds.
Vector6d leastSquares(const Scenario& scenario, const MachineTerms& machine, const Vector3d& r) {
  const auto legs = static_cast<Eigen::Index>(machine.legs.size());
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(3 * legs, 3 * legs + 6);
  Coordinates f(3 * legs + 6);
  f.head(3 * legs) = openEfforts(machine);
  f.tail<6>() = machine.platform_wrench;
  f.segment<3>(3 * legs) -= r.cross(Vector3d(machine.platform_wrench.tail<3>()));
  for (Eigen::Index i = 0; i < legs; ++i) {
    const OpenLeg& leg = machine.legs[static_cast<std::size_t>(i)];
    G.block<3, 3>(3 * i, 3 * i) = leg.J;
    G.block<3, 6>(3 * i, 3 * legs) = -leg.P;
    for (int k = 0; k < 3; ++k)  // the platform's point is r nearer to B
      G.block<3, 1>(3 * i, 3 * legs + k) += Vector3d::Unit(k).cross(r);
  }
  const Eigen::VectorXd multipliers = leastSquaresSolution(G.transpose(), f);
  return ofMotors(scenario, f - G.transpose() * multipliers);
}

/// Each leg carries the same part of the platform's force.
Vector6d equallyShared(const Scenario& scenario, const MachineTerms& machine) {
  Coordinates all = openEfforts(machine);
  const Vector3d part = machine.platform_wrench.tail<3>() / static_cast<double>(machine.legs.size());
  for (std::size_t i = 0; i < machine.legs.size(); ++i)
    all.segment<3>(3 * static_cast<Eigen::Index>(i)) += machine.legs[i].J.transpose() * part;
  return ofMotors(scenario, all);
}

/// The least efforts of all joints, driven or not, for a generalised force at P.
Coordinates leastEfforts(const MachineTerms& machine, const Vector6d& at_P) {
  const auto legs = static_cast<Eigen::Index>(machine.legs.size());
  Eigen::MatrixXd N(3 * legs, 6);
  for (Eigen::Index i = 0; i < legs; ++i) {
    const OpenLeg& leg = machine.legs[static_cast<std::size_t>(i)];
    N.middleRows<3>(3 * i) = leg.J.lu().solve(leg.P);
  }
  return N * Matrix6d(N.transpose() * N).lu().solve(at_P);
}

/// Twist rates of links as J ṫ_P, without J̇ t_P.
Vector6d withoutBias(const MachineTerms& machine) {
  Vector6d out = Vector6d::Zero();
  for (const auto* links : {&machine.proximal, &machine.distal})
    for (const BodyTerms& body : *links) {
      const Vector6d rate = body.T * machine.T_P.lu().solve(machine.rate_at_P);
      out += body.T.transpose() * (body.inertiaWrench(rate) - body.inertiaWrench(body.twist_rate));
    }
  return out;
}

/// Swaps [ω; v] to [v; ω]: a transposed Jacobian reveals its order.
Matrix6d swapped() {
  Matrix6d out = Matrix6d::Zero();
  out.topRightCorner<3, 3>() = out.bottomLeftCorner<3, 3>() = Matrix3d::Identity();
  return out;
}

void addTransposed(EffortCauses& out) {
  const NamedCause named{CauseKind::jacobian, "", "all"};
  for (const Matrix6d& order : {Matrix6d(Matrix6d::Identity()), swapped()}) {
    out.add("the Jacobian's inverse not transposed", named, [order](const MachineTerms& machine) {
      return Vector6d(order * machine.T_P * order * machine.forceAtP() - exactEfforts(machine));
    });
    out.add("the transposed Jacobian where its inverse belongs", named, [order](const MachineTerms& machine) {
      return Vector6d(order * jacobian(machine).transpose() * order * machine.forceAtP() - exactEfforts(machine));
    });
  }
  out.add("the Jacobian where its inverse belongs", named, [](const MachineTerms& machine) {
    return Vector6d(jacobian(machine) * machine.forceAtP() - exactEfforts(machine));
  });
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
  addTransposed(out);
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
  return exactEfforts(machine);
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

void addClosures(const Scenario& scenario, EffortCauses& out) {
  const auto closed = [&scenario](auto efforts) {
    return [&scenario, efforts](const MachineTerms& machine) {
      return Vector6d(efforts(scenario, machine) - exactEfforts(machine));
    };
  };
  const auto named = [](const char* term) { return NamedCause{CauseKind::closure, term, "all"}; };
  out.add("the loops left open: efforts that move the legs alone", named("open"),
          closed([](const Scenario& of, const MachineTerms& machine) { return ofMotors(of, openEfforts(machine)); }));
  out.add("the loops left open: the platform hangs on leg 1", named("open"), closed(openThroughLeg1));
  out.add("the loops closed by least squares over all coordinates", named("least_squares"),
          closed([](const Scenario& of, const MachineTerms& machine) {
            return leastSquares(of, machine, Vector3d::Zero());
          }));
  out.add("the loops closed by least squares over all coordinates, the platform's at its mass centre",
          named("least_squares"), closed([](const Scenario& of, const MachineTerms& machine) {
            return leastSquares(of, machine, machine.rho);
          }));
  out.add("the least efforts over all joints, read at the motors", named("least_squares"),
          closed([](const Scenario& of, const MachineTerms& machine) {
            return ofMotors(of, leastEfforts(machine, machine.forceAtP()));
          }));
  out.add("the least efforts over all joints that carry the platform, and those of the legs", named("least_squares"),
          closed([](const Scenario& of, const MachineTerms& machine) {
            return ofMotors(of, openEfforts(machine) + leastEfforts(machine, machine.platform_wrench));
          }));
  out.add("the loops left open: each leg carries the same part of the platform", named("open"), closed(equallyShared));
  const std::pair<const char*, std::function<Vector3d(const OpenLeg&)>> left_out[] = {
      {"of the legs", [](const OpenLeg& leg) { return leg.bias; }},
      {"of the platform", [](const OpenLeg& leg) { return Vector3d(-leg.platform_bias); }},
      {"of legs and platform", [](const OpenLeg& leg) { return Vector3d(leg.bias - leg.platform_bias); }}};
  for (const auto& [whose, off] : left_out)
    for (const auto& [way, times] : {std::pair("without", 1), {"with the wrong sign of", 2}})
      out.add(fmt::format("joint accelerations {} the rate of the Jacobian {}", way, whose), named("bias"),
              [off = off, times = times](const MachineTerms& machine) {
                return machine.ofAccelerations([&](const OpenLeg& leg) { return Vector3d(times * off(leg)); });
              });
  out.add("the links' accelerations without the Jacobian's rate", named("bias"), withoutBias);
}

}  // namespace

std::vector<Cause> loopCauses(const Scenario& scenario) {
  EffortCauses out(scenario);
  addJacobians(scenario, out);
  addPoints(scenario, out);
  addPointsNotTurned(scenario, out);
  addClosures(scenario, out);
  return std::move(out.causes);
}

}  // namespace ursula
