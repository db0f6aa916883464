#pragma once

#include <Eigen/Geometry>
#include <cstddef>

#include "model/joint_variables.h"
#include "model/manipulator.h"

// The joints as mechanics textbooks state them, from the poses of the 13 bodies and raw parameters alone, without any
// formula of the solver.

namespace ursula {

/// Joints of one leg in B.
template <class S>
struct LegJoints {
  Vector3<S> A, R, B;  ///< universal joint, knee, spherical joint
  Vector3<S> u, x;     ///< actuated axis; axis of the knee and of the universal joint's second rotation
  Vector3<S> e, s;     ///< along the links
};

template <class S>
LegJoints<S> legJoints(const Leg& leg, const BodyMotion<S>& proximal, const BodyMotion<S>& distal) {
  LegJoints<S> out;
  out.A = leg.base_point.cast<S>();
  out.u = leg.base_axis.cast<S>() / leg.base_axis.cast<S>().norm();
  out.x = proximal.R.col(0);
  out.e = proximal.R.col(2);
  out.s = distal.R.col(2);
  out.R = out.A + S(leg.proximal.length) * out.e;
  out.B = out.R + S(leg.distal.length) * out.s;
  return out;
}

constexpr int constraints_per_leg = 12;
constexpr int constraint_count = constraints_per_leg * leg_count;

/// D of D t = 0, (33): the 78 twist components of 13 free bodies less 72 constraints leave 6 degrees of freedom.
template <class S>
using ConstraintMatrix = Eigen::Matrix<S, constraint_count, 6 * body_count>;

/// A constraint's rows in the columns of one body.
template <class S>
class ConstraintRows {
 public:
  ConstraintRows(ConstraintMatrix<S>& D, const BodyMotions<S>& bodies) : D_(D), bodies_(bodies) {}

  /// sign · velocity of the body's point at `point`, three rows: ċ − (point − c) × ω.
  void velocity(int row, int body, const Vector3<S>& point, int sign) {
    const Vector3<S> r = point - bodies_[static_cast<std::size_t>(body)].c;
    Matrix3<S> arm;
    arm << S(0), r.z(), -r.y(), -r.z(), S(0), r.x(), r.y(), -r.x(), S(0);
    D_.template block<3, 3>(row, 6 * body) = S(sign) * arm;
    D_.template block<3, 3>(row, 6 * body + 3) = S(sign) * Matrix3<S>::Identity();
  }

  /// sign · angular velocity of the body along `axis`, one row.
  void spin(int row, int body, const Vector3<S>& axis, int sign) {
    D_.template block<1, 3>(row, 6 * body) = S(sign) * axis.transpose();
  }

 private:
  ConstraintMatrix<S>& D_;
  const BodyMotions<S>& bodies_;
};

/// Per leg: A rests (3), no spin of the proximal link about u × x (1), the links meet in R (3) and turn against each
/// other about x only (2), the distal link meets the platform in B (3).
template <class S>
ConstraintMatrix<S> constraintMatrix(const Manipulator& manipulator, const BodyMotions<S>& bodies) {
  ConstraintMatrix<S> D = ConstraintMatrix<S>::Zero();
  ConstraintRows<S> rows(D, bodies);
  for (int i = 0; i < leg_count; ++i) {
    const int proximal = i, distal = leg_count + i, platform = 2 * leg_count, row = constraints_per_leg * i;
    const LegJoints<S> joints = legJoints<S>(manipulator.leg(i), bodies[static_cast<std::size_t>(proximal)],
                                             bodies[static_cast<std::size_t>(distal)]);
    const Vector3<S> across = joints.x.cross(joints.e);
    rows.velocity(row, proximal, joints.A, 1);
    rows.spin(row + 3, proximal, joints.u.cross(joints.x), 1);
    rows.velocity(row + 4, proximal, joints.R, 1);
    rows.velocity(row + 4, distal, joints.R, -1);
    for (int k = 0; k < 2; ++k) {
      const Vector3<S>& axis = k == 0 ? joints.e : across;
      rows.spin(row + 7 + k, proximal, axis, 1);
      rows.spin(row + 7 + k, distal, axis, -1);
    }
    rows.velocity(row + 9, distal, joints.B, 1);
    rows.velocity(row + 9, platform, joints.B, -1);
  }
  return D;
}

}  // namespace ursula
