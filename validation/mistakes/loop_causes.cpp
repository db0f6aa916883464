#include <fmt/format.h>

#include <Eigen/LU>
#include <string>
#include <utility>

#include "base/dense.h"
#include "validation/mistakes/tried_causes.h"
#include "validation/subject/body_terms.h"

namespace ursula {
namespace {

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
  addClosures(scenario, out);
  return std::move(out.causes);
}

}  // namespace ursula
