#include "validation/limits/linearisation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "nocsolver/noc/noc.h"

namespace ursula {

using Vector12 = Eigen::Matrix<double, 12, 1>;

namespace {

/// Returns a step between two scales: Coulomb friction varies over its smoothing speed, everything else over the
/// machine's own speed.
double stepFor(const Manipulator& machine) {
  double speed = 1;
  for (const Leg& leg : machine.parameters().legs)
    for (const Coordinate coordinate : rowOf(leg.kind).coordinates)
      if (leg.coulomb.on(coordinate) != 0) speed = std::min(speed, leg.coulomb.speedOf(coordinate));
  return std::cbrt(speed * speed);
}

}  // namespace

Linearisation::Linearisation(const Scenario& scenario)
    : trajectory_(*scenario.trajectory),
      load_(scenario.load),
      right_(nocSubject(*scenario.manipulator, scenario.load)),
      length_(MachineParameters<double>(*scenario.manipulator).length),
      // For central differences the cube root of eps balances truncation and rounding.
      step_(stepFor(*scenario.manipulator) * std::cbrt(Eigen::NumTraits<double>::epsilon()) * length_) {}

Linearisation::Matrix12 Linearisation::at(double t) const {
  const Motion<double> motion = trajectory_.at(t);
  const Vector6d load = loadAtP(load_.get(), motion);
  if (!last_ || !sameState(last_->motion, motion) || last_->load != load) last_ = {motion, load, differenced(motion)};
  return last_->J;
}

Linearisation::Matrix12 Linearisation::differenced(const Motion<double>& motion) const {
  const Vector6d torques = right_.torques(motion);
  Matrix12 J = Matrix12::Zero();
  J.block<3, 3>(0, 6).setIdentity();
  J.block<3, 3>(3, 9).setIdentity();
  J.block<3, 3>(3, 3) << 0, -motion.omega.z(), motion.omega.y(), motion.omega.z(), 0, -motion.omega.x(),
      -motion.omega.y(), motion.omega.x(), 0;
  for (int j = 0; j < 12; ++j) {
    Vector12 deviation = Vector12::Zero();
    deviation(j) = step_;
    const Vector6d above = acceleration(motion, deviation, torques);
    const Vector6d below = acceleration(motion, -deviation, torques);
    J.block<6, 1>(6, j) = (above - below) / (2 * step_);
  }
  return J;
}

Vector6d Linearisation::acceleration(Motion<double> motion, const Vector12& deviation, const Vector6d& torques) const {
  motion.p += deviation.segment<3>(0);
  const Vector3d turn = deviation.segment<3>(3) / length_;
  if (turn.norm() > 0) motion.Q = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * motion.Q;
  motion.p_dot += deviation.segment<3>(6);
  motion.omega += deviation.segment<3>(9) / length_;
  const Vector6d found = right_.accelerations(motion, torques);
  Vector6d out;
  out << found.tail<3>(), length_ * found.head<3>();
  return out;
}

}  // namespace ursula
