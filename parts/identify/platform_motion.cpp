#include "parts/identify/platform_motion.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/scalar.h"
#include "parts/poses/tracking.h"

namespace ursula::identification {

std::optional<PlatformPose> MotorChain::pose(const Vector6d& driven, const PlatformPose& from) const {
  if (auto direct = poses::track(kinematics_.solver().noc(), driven, from)) return direct;
  Motion<double> start;
  start.p = from.p;
  start.Q = from.Q;
  Vector6d first;
  try {
    first = this->driven(start).first;
  } catch (const PoseError&) {
    return std::nullopt;
  }
  Vector6d way = driven - first;
  const Motors& motors = kinematics_.solver().machine().motors;
  for (int k = 0; k < motor_count; ++k)
    if (!motors[k].slides()) way(k) = std::remainder(way(k), 2 * pi);
  for (const int steps : {8, 64}) {
    std::optional<PlatformPose> at = from;
    for (int i = 1; i <= steps && at; ++i) at = poses::track(kinematics_.solver().noc(), first + way * i / steps, *at);
    if (at) return at;
  }
  return std::nullopt;
}

std::optional<Motion<double>> MotorChain::follow(const MeasuredState& state, const Motion<double>& from) const {
  PlatformPose near;
  near.p = from.p;
  near.Q = from.Q;
  const auto found = pose(state.value, near);
  if (!found) return std::nullopt;
  try {
    return kinematics_.motion(*found, state.rate, state.acceleration, work_);
  } catch (const PoseError&) {
    return std::nullopt;
  }
}

Vector6d MotorChain::efforts(const Motion<double>& motion, const Vector6d& load) const {
  return kinematics_.solver().inverseDynamics(motion, work_, load);
}

std::pair<Vector6d, Vector6d> MotorChain::driven(const Motion<double>& motion) const {
  const auto& solver = kinematics_.solver();
  solver.inverseKinematics(motion, work_);
  const Motors& motors = solver.machine().motors;
  return {solver.angles(work_).driven(motors), solver.rates(work_).driven(motors)};
}

Motion<double> motionOfPoses(const MeasuredState& state) {
  const auto quaternion = [](const Eigen::VectorXd& x) { return Eigen::Quaterniond(x(3), x(4), x(5), x(6)); };
  const Eigen::Quaterniond q = quaternion(state.value);
  const double square = q.squaredNorm(), growth = state.value.tail<4>().dot(state.rate.tail<4>()) / square;
  Motion<double> out;
  out.p = state.value.head<3>();
  out.p_dot = state.rate.head<3>();
  out.p_ddot = state.acceleration.head<3>();
  out.Q = q.normalized().toRotationMatrix();
  out.omega = 2 * (quaternion(state.rate) * q.conjugate()).vec() / square;
  out.omega_dot = 2 * (quaternion(state.acceleration) * q.conjugate()).vec() / square - 2 * growth * out.omega;
  return out;
}

Motion<double> motionAbout(const Motion<double>& pose, const MeasuredState& off, double t) {
  const auto part = [&](const Eigen::VectorXd& x, double scalar, const Vector3d& origin) {
    const Eigen::Quaterniond q = Eigen::Quaterniond(pose.Q) * Eigen::Quaterniond(scalar, x(3), x(4), x(5));
    Eigen::VectorXd out(7);
    out << origin + x.head<3>(), q.w(), q.x(), q.y(), q.z();
    return out;
  };
  const Vector3d none = Vector3d::Zero();
  Motion<double> out =
      motionOfPoses({part(off.value, 1, pose.p), part(off.rate, 0, none), part(off.acceleration, 0, none)});
  out.t = t;
  return out;
}

std::optional<Motion<double>> firstMotion(const Scenario& scenario, const MotorChain& chain,
                                          const MeasuredState& state) {
  constexpr int instants = 65, tried = 6;
  const Motors& motors = scenario.manipulator->motors();
  std::vector<std::pair<double, Motion<double>>> near;
  for (int i = 0; i < instants; ++i) {
    const Motion<double> at = scenario.trajectory->at(scenario.trajectory->duration() * i / (instants - 1));
    Vector6d off;
    try {
      off = chain.driven(at).first - Vector6d(state.value);
    } catch (const PoseError&) {
      continue;
    }
    for (int k = 0; k < motor_count; ++k)
      if (!motors[k].slides()) off(k) = std::remainder(off(k), 2 * pi);
    near.emplace_back(off.norm(), at);
  }
  std::sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < near.size(); i += std::max<std::size_t>(1, near.size() / tried))
    if (auto found = chain.follow(state, near[i].second)) return found;
  return std::nullopt;
}

}  // namespace ursula::identification
