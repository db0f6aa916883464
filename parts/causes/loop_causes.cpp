#include <fmt/format.h>

#include <Eigen/LU>
#include <utility>

#include "base/dense.h"
#include "parts/causes/tried_causes.h"

namespace ursula {
namespace {

/// Efforts of all joints, three per leg, in leg order.
using Coordinates = Eigen::VectorXd;

/// Those of a leg's own bodies and what `more` adds to them.
Coordinates openEfforts(const MachineTerms& machine, const std::function<Vector3d(const OpenLeg&)>& more = {}) {
  Coordinates out(3 * static_cast<Eigen::Index>(machine.legs.size()));
  Eigen::Index row = 0;
  for (const OpenLeg& leg : machine.legs) {
    out.segment<3>(row) = leg.efforts;
    if (more) out.segment<3>(row) += more(leg);
    row += 3;
  }
  return out;
}

/// The platform hangs on leg 1 alone.
Coordinates openThroughLeg1(const MachineTerms& machine) {
  return openEfforts(machine, [&](const OpenLeg& leg) -> Vector3d {
    if (&leg != &machine.legs.front()) return Vector3d::Zero();
    return leg.J.transpose() * machine.platform_wrench.tail<3>();
  });
}

/// Each leg carries the same part of the platform's force.
Coordinates equallyShared(const MachineTerms& machine) {
  const Vector3d part = machine.platform_wrench.tail<3>() / static_cast<double>(machine.legs.size());
  return openEfforts(machine, [&](const OpenLeg& leg) { return Vector3d(leg.J.transpose() * part); });
}

/// Forces of all coordinates, including the platform's six, minus the best fit of the closures' multipliers. `r` leads
/// from P to the point of the platform's speeds.
Coordinates leastSquares(const MachineTerms& machine, const Vector3d& r) {
  const auto legs = static_cast<Eigen::Index>(machine.legs.size());
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(3 * legs, 3 * legs + 6);
  Coordinates f(3 * legs + 6);
  f << openEfforts(machine), machine.platform_wrench;
  f.segment<3>(3 * legs) -= r.cross(Vector3d(machine.platform_wrench.tail<3>()));
  for (Eigen::Index i = 0; i < legs; ++i) {
    const OpenLeg& leg = machine.legs[i];
    G.block<3, 3>(3 * i, 3 * i) = leg.J;
    G.block<3, 6>(3 * i, 3 * legs) = -leg.P;
    for (int k = 0; k < 3; ++k)  // the platform's point is r nearer to B
      G.block<3, 1>(3 * i, 3 * legs + k) += Vector3d::Unit(k).cross(r);
  }
  const Eigen::VectorXd multipliers = leastSquaresSolution(G.transpose(), f);
  return f - G.transpose() * multipliers;
}

/// The least efforts of all joints, driven or not, for a generalised force at P.
Coordinates leastEfforts(const MachineTerms& machine, const Vector6d& at_P) {
  Eigen::MatrixXd N(3 * machine.legs.size(), 6);
  Eigen::Index row = 0;
  for (const OpenLeg& leg : machine.legs) {
    N.middleRows<3>(row) = leg.J.lu().solve(leg.P);
    row += 3;
  }
  return N * Matrix6d(N.transpose() * N).lu().solve(at_P);
}

/// Twist rates of links as J ṫ_P, without J̇ t_P.
Vector6d withoutBias(const MachineTerms& machine) {
  Vector6d out = Vector6d::Zero();
  for (const auto link : {&OpenLeg::proximal, &OpenLeg::distal})
    for (const OpenLeg& leg : machine.legs) {
      const BodyTerms& body = leg.*link;
      const Vector6d rate = body.T * machine.T_P.lu().solve(machine.rate_at_P);
      out += body.T.transpose() * (body.inertiaWrench(rate) - body.inertiaWrench(body.twist_rate));
    }
  return out;
}

/// Adds the efforts of all joints, read at the motors.
void addClosure(const char* text, const char* term, Coordinates (*efforts)(const MachineTerms&), TriedCauses& out) {
  out.addEfforts({text, {CauseKind::closure, term, "all"}}, [efforts](const MachineTerms& machine) {
    const Coordinates all = efforts(machine);
    Vector6d found;
    for (int m = 0; m < motor_count; ++m) {
      const Motor& motor = machine.motors[m];
      found(m) = all(3 * motor.leg + motor.joint);
    }
    return Vector6d(found - machine.T_P.transpose() * machine.forceAtP());
  });
}

}  // namespace

void addLoopCauses(TriedCauses& out) {
  using Terms = MachineTerms;
  addClosure(
      "the loops left open: efforts that move the legs alone", "open",
      [](const Terms& machine) { return openEfforts(machine); }, out);
  addClosure("the loops left open: the platform hangs on leg 1", "open", openThroughLeg1, out);
  addClosure(
      "the loops closed by least squares over all coordinates", "least_squares",
      [](const Terms& machine) { return leastSquares(machine, Vector3d::Zero()); }, out);
  addClosure(
      "the loops closed by least squares over all coordinates, the platform's at its mass centre", "least_squares",
      [](const Terms& machine) { return leastSquares(machine, machine.rho); }, out);
  addClosure(
      "the least efforts over all joints, read at the motors", "least_squares",
      [](const Terms& machine) { return leastEfforts(machine, machine.forceAtP()); }, out);
  addClosure(
      "the least efforts over all joints that carry the platform, and those of the legs", "least_squares",
      [](const Terms& machine) -> Coordinates {
        return openEfforts(machine) + leastEfforts(machine, machine.platform_wrench);
      },
      out);
  addClosure("the loops left open: each leg carries the same part of the platform", "open", equallyShared, out);
  const NamedCause without_bias{CauseKind::closure, "bias", "all"};
  for (const auto& [whose, legs, platform] :
       {std::tuple("of the legs", 1, 0), {"of the platform", 0, 1}, {"of legs and platform", 1, 1}})
    for (const auto& [way, times] : {std::pair("without", 1), {"with the wrong sign of", 2}})
      out.addEfforts({fmt::format("joint accelerations {} the rate of the Jacobian {}", way, whose), without_bias},
                     [legs = legs, platform = platform, times = times](const Terms& machine) {
                       return machine.ofAccelerations([&](const OpenLeg& leg) {
                         return Vector3d(times * (legs * leg.bias - platform * leg.platform_bias));
                       });
                     });
  out.addEfforts({"the links' accelerations without the Jacobian's rate", without_bias}, withoutBias);
}

}  // namespace ursula
