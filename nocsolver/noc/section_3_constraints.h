#pragma once

// Section 3 of the paper: what the complement eliminates, the velocity constraints of (33) and the joint reactions.

#include <Eigen/Geometry>

#include "nocsolver/noc/section_3_dynamics.h"

namespace ursula {
namespace legs {

/// Builds D, joint by joint.
template <class S>
class ConstraintRows {
 public:
  using MatrixX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using Directions = Eigen::Matrix<S, 3, Eigen::Dynamic>;

  /// A body of the chain: its first column in D (−1 for the base), and its mass centre.
  struct Body {
    int column;
    Vector3<S> c;
  };

  explicit ConstraintRows(int count) : D_(MatrixX::Zero(count, 6 * body_count)) {}

  /// Joints first … last − 1 of a leg connect the bodies at O. Both bodies share all rotations and translations except
  /// those about and along the joints' axes.
  void join(const Body& from, const Body& to, const Vector3<S>& O, const LegModel<S>& leg, const LegState<S>& at,
            int first, int last) {
    Directions turning(3, 0), sliding(3, 0);
    for (int j = first; j < last; ++j) {
      Directions& axes = slides(rowOf(leg.kind).coordinates[j]) ? sliding : turning;
      axes.conservativeResize(3, axes.cols() + 1);
      axes.col(axes.cols() - 1) = at.axis[j];
    }
    const Directions stiff = across(turning);
    for (const auto& column : stiff.colwise()) {
      const Vector3<S> n = column;
      set(to, n, Vector3<S>::Zero(), S(1));
      set(from, n, Vector3<S>::Zero(), S(-1));
      ++row_;
    }
    moveAlike(from, to, O, across(sliding));
  }
  /// The bodies' points at `O` have equal velocities along `directions`.
  void moveAlike(const Body& from, const Body& to, const Vector3<S>& O, const Directions& directions) {
    for (const auto& column : directions.colwise()) {
      const Vector3<S> n = column;
      set(to, Vector3<S>((O - to.c).cross(n)), n, S(1));
      set(from, Vector3<S>((O - from.c).cross(n)), n, S(-1));
      ++row_;
    }
  }
  const MatrixX& D() const { return D_; }

 private:
  /// Unit vectors perpendicular to up to two axes.
  static Directions across(const Directions& axes) {
    if (axes.cols() == 0) return Matrix3<S>::Identity();
    const Vector3<S> a = axes.col(0);
    if (axes.cols() == 2) return a.cross(Vector3<S>(axes.col(1))).normalized();
    int least = 0;
    a.cwiseAbs().minCoeff(&least);
    Directions out(3, 2);
    out.col(0) = a.cross(Vector3<S>(Vector3<S>::Unit(least))).normalized();
    out.col(1) = a.cross(Vector3<S>(out.col(0)));
    return out;
  }

  void set(const Body& body, const Vector3<S>& on_omega, const Vector3<S>& on_c_dot, const S& sign) {
    if (body.column >= 0)
      D_.template block<1, 6>(row_, body.column) << sign * on_omega.transpose(), sign * on_c_dot.transpose();
  }

  MatrixX D_;
  Eigen::Index row_ = 0;
};

}  // namespace legs

template <class S>
Vector3<S> Noc<S>::sphericalPoint(const Motion<S>& motion, int /*leg*/, const LegState<S>& at) const {
  return motion.p + at.Qb;
}

template <class S>
Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> Noc<S>::D(const Motion<S>& motion, const NocWorkspace<S>& work) const {
  using Rows = legs::ConstraintRows<S>;
  const typename Rows::Body base{-1, Vector3<S>::Zero()}, platform{6 * legs::platform, work.bodies.back().c};
  Rows rows(12 * machine_.legs_in_all);
  for (int i = 0; i < machine_.legs_in_all; ++i) {
    const LegModel<S>& leg = machine_.legs[i];
    const LegState<S>& at = work.legs[i];
    const typename Rows::Body first{6 * i, work.bodies[i].c};
    const typename Rows::Body second{6 * (leg_count + i), work.bodies[leg_count + i].c};
    const int before = rowOf(leg.kind).joints_of_proximal;
    const Vector3<S> R_ = leg.a + at.O_2, B = sphericalPoint(motion, i, at);
    rows.join(base, first, leg.a + at.O_1, leg, at, 0, before);
    rows.join(first, second, R_, leg, at, before, 3);
    rows.moveAlike(second, platform, B, Matrix3<S>::Identity());
  }
  return rows.D();  // (paper, eq. 33)
}

template <class S>
BodyVector<S> Noc<S>::constraintWrench(const Motion<S>& motion, const Vector6<S>& efforts, const NocWorkspace<S>& work,
                                       const Vector6<S>& load) const {
  const Vector6<S> on_links = efforts - rotorEfforts(work);
  const BodyVector<S> w_W = actuatorWrench(work, on_links) + gravityWrench() + dissipativeWrench(work);
  return -inertiaWrench(work) - w_W - loadWrench(motion, load);  // (paper, eq. 31)
}

template <class S>
Reactions Noc<S>::reactions(const Motion<S>& motion, const Vector6<S>& efforts, const NocWorkspace<S>& work) const {
  const Vector6<S> on_links = efforts - rotorEfforts(work);
  const BodyVector<S> moving = -inertiaWrench(work) - gravityWrench(), w_d = dissipativeWrench(work);
  Reactions out;
  for (int i = 0; i < machine_.legs_in_all; ++i) {
    const LegModel<S>& leg = machine_.legs[i];
    const LegState<S>& at = work.legs[i];
    const auto block = [](const BodyVector<S>& w, int body) { return Vector6<S>(legs::block(w, body)); };
    const Vector6<S> w_1 = block(moving, i), w_2 = block(moving, leg_count + i);
    const UnitTwists unit = unitTwists(i, at, false);
    const Vector3<S> Q =
        unit.first.transpose() * (w_1 - block(w_d, i)) + unit.second.transpose() * (w_2 - block(w_d, leg_count + i));
    Vector3<S> f_B = Vector3<S>::Zero();  // force of the undriven loads on the platform, by the rows of (22)
    for (int j = 0; j < 3; ++j) {
      const int motor = leg.motor[j];
      const JacobianRow<S>& row = at.row[j];
      f_B += (((motor >= 0 ? on_links(motor) : S(0)) - Q(j)) / row.A) * row.n;
    }
    const Vector3<S> A = leg.a + at.O_1, R_ = leg.a + at.O_2, B = motion.p + at.Qb;
    const Vector3<S>&c_1 = work.bodies[i].c, &c_2 = work.bodies[leg_count + i].c;
    const Vector3<S> f_R = w_2.template tail<3>() + f_B;
    const Vector3<S> n_R = w_2.template head<3>() - (R_ - c_2).cross(f_R) + (B - c_2).cross(f_B);
    const Vector3<S> f_A = w_1.template tail<3>() + f_R;
    const Vector3<S> n_A = w_1.template head<3>() + n_R - (A - c_1).cross(f_A) + (R_ - c_1).cross(f_R);
    LegReactions& to = out[i];
    to.f_B = f_B.template cast<double>();
    to.f_R = f_R.template cast<double>();
    to.n_R = n_R.template cast<double>();
    to.f_A = f_A.template cast<double>();
    to.n_A = n_A.template cast<double>();  // (paper, eq. 28)
  }
  return out;
}

}  // namespace ursula
