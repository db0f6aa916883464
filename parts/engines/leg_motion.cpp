#include "parts/engines/leg_motion.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace ursula {
Vector3d legCoordinates(const Leg& leg, int index, const Matrix3d& frame, const Motion<double>& motion) {
  const Vector3d AB = motion.p + motion.Q * leg.platform_point - leg.base_point;
  if (const auto q = coordinatesAt(leg, frame, AB)) return *q;
  throw std::domain_error(fmt::format("leg {} cannot reach over {} m at t = {} s", index + 1, AB.norm(), motion.t));
}

Vector3d frictionOn(const Leg& leg, const Vector3d& rates) {
  Vector3d out;
  for (Eigen::Index j = 0; j < 3; ++j) {
    const Coordinate coordinate = rowOf(leg.kind).coordinates[j];
    out(j) = -leg.friction.on(coordinate) * rates(j) -
             leg.coulomb.on(coordinate) * std::tanh(rates(j) / leg.coulomb.speedOf(coordinate));
  }
  return out;
}

Vector6d loadInBase(const Load* load, double t, const Matrix3d& Q) {
  Vector6d out = Vector6d::Zero();
  if (load == nullptr) return out;
  const Wrench<double> wrench = load->at(t);
  const Matrix3d to_base = load->frame == Load::Frame::platform ? Q : Matrix3d(Matrix3d::Identity());
  const Vector3d force = to_base * wrench.force;
  out << to_base * wrench.moment + (Q * load->point).cross(force), force;
  return out;
}

}  // namespace ursula
