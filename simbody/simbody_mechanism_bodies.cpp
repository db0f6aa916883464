// Motions of a mechanism's bodies, with those that a cut gimbal leaves out of Simbody, and its idle spins.

#include <Eigen/Geometry>

#include "base/free_spins.h"
#include "simbody/simbody_mechanism_internal.h"

namespace ursula {
namespace {

/// Returns the twist at a point by that at another of the same body, or the twist rate without its centripetal part.
Vector6d movedTo(const Vector3d& arm, const Vector6d& at) {
  Vector6d out = at;
  out.tail<3>() += at.head<3>().cross(arm);
  return out;
}

}  // namespace

void SimbodyMechanism::Impl::holdSpins() {
  const LeastSquares factors(allRows());
  Eigen::MatrixXd Z = factors.kernel();
  for (std::size_t b = 0; b < bodies.size() && Z.cols() > 0; ++b) {
    const MechanismBody& body = mechanism.bodies()[b];
    if (body.fixed || isMassless(body)) continue;
    const Eigen::Isometry3d at = displacement(b);
    Eigen::MatrixXd J = frameJacobian(b, at * body.center_of_mass) * column_scale.asDiagonal();
    J.bottomRows<3>() /= mechanism.length();
    for (const Vector3d& line : takeSpins(J, Z)) spins.push_back({b, at.linear().transpose() * line});
  }
  const Eigen::Index rows = row_scale.size();
  row_scale.conservativeResize(rows + static_cast<Eigen::Index>(spins.size()));
  row_scale.tail(row_scale.size() - rows).setOnes();
}

SimbodyMechanism::BodyState SimbodyMechanism::Impl::stateOf(
    std::size_t body, const SimTK::Vector_<SimTK::SpatialVec>& accelerations) const {
  BodyState out;
  const SimTK::MobilizedBody& at = bodies[body].mobilizer;
  if (at.isGround()) return out;
  out.displacement = displacement(body);
  const Vector3d arm = out.displacement.linear() * (mechanism.bodies()[body].center_of_mass - bodies[body].origin);
  const Vector3d w = omega(body);
  out.twist = movedTo(arm, toEigen(at.getBodyVelocity(state)));
  out.twist_rate = movedTo(arm, toEigen(accelerations[at.getMobilizedBodyIndex()]));
  out.twist_rate.tail<3>() += w.cross(w.cross(arm));
  return out;
}

/// The body turns about the first hinge's axis e₁ on its neighbour before, whose neighbour after turns about e₂ on it:
/// ω_after − ω_before = q̇₁e₁ + q̇₂e₂, of which a product with e₂ leaves q̇₁.
SimbodyMechanism::BodyState SimbodyMechanism::Impl::stateOf(const SpanningTree::Gimbal& gimbal,
                                                            const std::vector<BodyState>& states) const {
  const BodyState &before = states[gimbal.before], &after = states[gimbal.after];
  const Vector3d &first = mechanism.joints()[gimbal.first].axis[0], &second = mechanism.joints()[gimbal.second].axis[0];
  const Matrix3d R = before.displacement.linear().transpose() * after.displacement.linear();
  const Eigen::AngleAxisd turn(angleAbout(first, second, R * second), first);
  BodyState out;
  out.displacement =
      before.displacement * Eigen::Translation3d(gimbal.centre) * turn * Eigen::Translation3d(-gimbal.centre);
  const Vector3d e1 = before.displacement.linear() * first, e2 = after.displacement.linear() * second;
  const Vector3d n = e1.cross(e2);
  const auto along_first = [&](const Vector3d& v) { return v.cross(e2).dot(n) / n.squaredNorm(); };
  const auto along_second = [&](const Vector3d& v) { return e1.cross(v).dot(n) / n.squaredNorm(); };
  const Vector3d w0 = before.twist.head<3>(), across = after.twist.head<3>() - w0;
  const Vector3d w = w0 + along_first(across) * e1;
  const Vector3d turning = along_first(across) * w0.cross(e1) + along_second(across) * w.cross(e2);
  const double rate2 = along_first(after.twist_rate.head<3>() - before.twist_rate.head<3>() - turning);
  const Vector3d w_dot = before.twist_rate.head<3>() + rate2 * e1 + along_first(across) * w0.cross(e1);

  const auto& bodies_of_file = mechanism.bodies();
  const Vector3d centre = before.displacement * gimbal.centre;
  const Vector3d arm = before.displacement.linear() * (gimbal.centre - bodies_of_file[gimbal.before].center_of_mass);
  const Vector3d to_own = out.displacement * bodies_of_file[gimbal.body].center_of_mass - centre;
  out.twist << w, movedTo(arm, before.twist).tail<3>();
  out.twist_rate << w_dot, movedTo(arm, before.twist_rate).tail<3>() + w0.cross(w0.cross(arm));
  out.twist = movedTo(to_own, out.twist);
  out.twist_rate = movedTo(to_own, out.twist_rate);
  out.twist_rate.tail<3>() += w.cross(w.cross(to_own));
  return out;
}

std::vector<SimbodyMechanism::BodyState> SimbodyMechanism::bodies() const {
  const Impl& m = *impl_;
  m.realize(SimTK::Stage::Velocity);
  SimTK::Vector_<SimTK::SpatialVec> accelerations;
  m.matter.calcBodyAccelerationFromUDot(m.state, m.u_dot, accelerations);
  std::vector<BodyState> out(m.bodies.size());
  for (std::size_t b = 0; b < out.size(); ++b)
    if (!m.bodies[b].mobilizer.isEmptyHandle()) out[b] = m.stateOf(b, accelerations);
  for (const SpanningTree::Gimbal& gimbal : m.tree.gimbals) out[gimbal.body] = m.stateOf(gimbal, out);
  return out;
}

}  // namespace ursula
