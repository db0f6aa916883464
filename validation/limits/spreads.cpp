#include "validation/limits/spreads.h"

#include <Eigen/LU>
#include <cmath>

#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// The largest difference of ψ, θ and d. φ depends on the frame, so the axis x of the leg's plane is compared.
double angleDistance(const Manipulator& machine, const JointVariables<double>& a, const JointVariables<double>& b,
                     const BodyMotions<double>& of_a, const BodyMotions<double>& of_b, double length) {
  double largest = 0;
  for (int i = 0; i < machine.legCount(); ++i) {
    const bool carriage = rowOf(machine.leg(i).kind).hasCarriage();
    // The plane of a leg with a carriage is its rod's; its ψ starts at an axis that does not turn with the frame.
    const std::size_t in_plane = carriage ? leg_count + i : i;
    const double plane = (of_a[in_plane].R.col(0) - of_b[in_plane].R.col(0)).norm();
    const auto turn = [](double x, double y) { return std::abs(std::remainder(x - y, 2 * pi)); };
    largest = larger(largest, plane);
    if (!carriage) largest = larger(largest, turn(a.psi(i), b.psi(i)));
    largest = larger(largest, turn(a.theta(i), b.theta(i)));
    largest = larger(largest, std::abs(a.d(i) - b.d(i)) / length);
  }
  return largest;
}

/// The largest difference of a force, or of a moment over `length`, N.
double reactionDistance(const Reactions& a, const Reactions& b, double length) {
  double largest = 0;
  for (std::size_t i = 0; i < leg_count; ++i) largest = larger(largest, distance(a[i], b[i], length));
  return largest;
}

double torqueDistance(const Vector6d& a, const Vector6d& b) {
  return (a - b).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

void raise(RoundingLevels& levels, Rounded quantity, double value) {
  double& level = levels[static_cast<std::size_t>(quantity)];
  level = larger(level, value);
}

/// Compares joints and bodies, which the solver and the engines both have.
template <class View>
void spreadOfMotions(const Manipulator& machine, const View& a, const View& b, double length, RoundingLevels& out) {
  for (std::size_t i = 0; i < body_count; ++i) {
    // A carriage's frame depends on the vertical, not on the machine.
    const bool is_carriage =
        i < static_cast<std::size_t>(machine.legCount()) && rowOf(machine.leg(static_cast<int>(i)).kind).hasCarriage();
    const double turn = is_carriage ? 0 : length;
    const BodyMotion<double>&x = a.bodies[i], &y = b.bodies[i];
    raise(out, Rounded::positions, (x.c - y.c).norm() + turn * (x.R - y.R).norm());
    raise(out, Rounded::twists, twistSize(x.twist - y.twist, length));
    raise(out, Rounded::twist_rates, twistSize(x.twist_rate - y.twist_rate, length));
  }
  raise(out, Rounded::angles, angleDistance(machine, a.joints.q, b.joints.q, a.bodies, b.bodies, length));
  raise(out, Rounded::rates, jointDistance(a.joints.q_dot, b.joints.q_dot, length));
  raise(out, Rounded::accelerations, jointDistance(a.joints.q_ddot, b.joints.q_ddot, length));
  raise(out, Rounded::reactions, reactionDistance(a.reactions, b.reactions, length));
  raise(out, Rounded::direct, twistSize(a.direct - b.direct, length));
}

}  // namespace

RoundingLevels spreadOfSolver(const Manipulator& machine, const std::vector<SolverView>& views,
                              const DrivenMotion& driven, const Matrix6d& to_efforts, double length) {
  const Eigen::PartialPivLU<Matrix6d> to_efforts_lu(to_efforts);
  RoundingLevels out = uniformLevels(0);
  const auto size = [length](const Matrix6d& T) { return T.bottomRows<3>().norm() + length * T.topRows<3>().norm(); };
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const SolverView &a = views[i], &b = views[j];
      spreadOfMotions(machine, a, b, length, out);
      const Matrix6d T = a.T - b.T, T_rate = a.T_rate - b.T_rate;
      raise(out, Rounded::shaping, size(T));
      raise(out, Rounded::shaping_rate, size(T_rate));
      raise(out, Rounded::jacobian, twistSize(T * driven.q_dot, length));
      raise(out, Rounded::jacobian_rate, twistSize(T * driven.q_ddot + T_rate * driven.q_dot, length));
      const double torque = torqueDistance(a.torques, b.torques);
      raise(out, Rounded::effort, (a.torques - b.torques).norm());
      raise(out, Rounded::acceleration, twistSize(to_efforts_lu.solve(a.torques - b.torques), length));
      raise(out, Rounded::solver, torque);
      raise(out, Rounded::solver_direct, twistSize(a.direct - b.direct, length));
      raise(out, Rounded::torque, torque);
      for (std::size_t k = 0; k < furtherEngines().size(); ++k) raise(out, ofFurtherEngine(k), torque);
    }
  return out;
}

RoundingLevels spreadOfEngines(const Manipulator& machine, const std::vector<EngineView>& views,
                               const SolverView& solver, const Matrix6d& to_efforts, double length) {
  RoundingLevels out = uniformLevels(0);
  const Motors motors = machine.motors();
  for (std::size_t i = 0; i < views.size(); ++i) {
    raise(out, Rounded::gaps, views[i].gap_acceleration);
    for (std::size_t j = 0; j < i; ++j) {
      const EngineView &a = views[i], &b = views[j];
      spreadOfMotions(machine, a, b, length, out);
      const Vector6d q_dot = a.joints.q_dot.driven(motors) - b.joints.q_dot.driven(motors);
      const Vector6d q_ddot = a.joints.q_ddot.driven(motors) - b.joints.q_ddot.driven(motors);
      raise(out, Rounded::jacobian, twistSize(solver.T * q_dot, length));
      raise(out, Rounded::jacobian_rate, twistSize(solver.T * q_ddot + solver.T_rate * q_dot, length));
      raise(out, Rounded::torque, torqueDistance(a.torques, b.torques));
      for (std::size_t k = 0; k < furtherEngines().size(); ++k)
        if (a.further[k] && b.further[k]) raise(out, ofFurtherEngine(k), torqueDistance(*a.further[k], *b.further[k]));
      raise(out, Rounded::acceleration, twistSize(a.acceleration - b.acceleration, length));
      raise(out, Rounded::effort, (to_efforts * (a.acceleration - b.acceleration)).norm());
    }
  }
  return out;
}

}  // namespace ursula
