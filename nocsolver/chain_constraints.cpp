#include "nocsolver/chain_constraints.h"

#include <Eigen/Geometry>
#include <vector>

namespace ursula {
namespace {

/// Unit vectors across all of up to two axes.
Eigen::Matrix3Xd across(const std::vector<Vector3d>& axes) {
  if (axes.empty()) return Matrix3d::Identity();
  if (axes.size() == 2) return axes[0].cross(axes[1]).normalized();
  Eigen::Matrix3Xd out(3, 2);
  out << axes[0].unitOrthogonal(), axes[0].cross(axes[0].unitOrthogonal());
  return out;
}

/// A body of the chain: its first column in D, −1 for the base, and its mass centre.
struct Body {
  int column;
  Vector3d c;
};

/// Rows of D, joint by joint.
class Rows {
 public:
  explicit Rows(int count) : D_(Eigen::MatrixXd::Zero(count, 6 * body_count)) {}

  /// The bodies' angular velocities agree along `directions`.
  void turnAlike(const Body& from, const Body& to, const Eigen::Matrix3Xd& directions) {
    for (const auto& n : directions.colwise()) {
      set(to, n, Vector3d::Zero(), 1);
      set(from, n, Vector3d::Zero(), -1);
      ++row_;
    }
  }
  /// The bodies' points that are at `O` have equal velocities along `directions`.
  void moveAlike(const Body& from, const Body& to, const Vector3d& O, const Eigen::Matrix3Xd& directions) {
    for (const auto& n : directions.colwise()) {
      set(to, (O - to.c).cross(Vector3d(n)), n, 1);
      set(from, (O - from.c).cross(Vector3d(n)), n, -1);
      ++row_;
    }
  }
  /// Joints first … last − 1 of a leg lie between the bodies, at O.
  void join(const Body& from, const Body& to, const Vector3d& O, LegKind kind, const ChainState<double>& leg, int first,
            int last) {
    std::vector<Vector3d> turning, sliding;
    for (int j = first; j < last; ++j) {
      const auto at = static_cast<std::size_t>(j);
      (slides(rowOf(kind).coordinates[at]) ? sliding : turning).push_back(leg.axis[at]);
    }
    turnAlike(from, to, across(turning));
    moveAlike(from, to, O, across(sliding));
  }
  const Eigen::MatrixXd& D() const { return D_; }

 private:
  void set(const Body& body, const Vector3d& on_omega, const Vector3d& on_c_dot, double sign) {
    if (body.column >= 0) D_.block<1, 6>(row_, body.column) << sign * on_omega.transpose(), sign * on_c_dot.transpose();
  }

  Eigen::MatrixXd D_;
  Eigen::Index row_ = 0;
};

}  // namespace

Eigen::MatrixXd velocityConstraints(const ChainSolver<double>& solver, const Motion<double>& motion,
                                    const ChainWorkspace<double>& work) {
  BodyMotions<double> bodies;
  solver.bodyMotions(motion, work, bodies);
  const Body base{-1, Vector3d::Zero()}, platform{12 * leg_count, bodies.back().c};
  Rows rows(12 * solver.legCount());
  for (int i = 0; i < solver.legCount(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const ChainModel<double>& model = solver.leg(i);
    const ChainState<double>& leg = work.legs[at];
    const Body first{6 * i, bodies[at].c}, second{6 * (leg_count + i), bodies[leg_count + at].c};
    const int before = rowOf(model.kind).joints_of_proximal;
    rows.join(base, first, model.a + leg.O_1, model.kind, leg, 0, before);
    rows.join(first, second, model.a + leg.O_2, model.kind, leg, before, 3);
    rows.moveAlike(second, platform, motion.p + leg.Qb, Matrix3d::Identity());
  }
  return rows.D();
}

}  // namespace ursula
