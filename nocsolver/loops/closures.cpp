#include "nocsolver/loops/closures.h"

namespace ursula::loops {
namespace {

/// The rotation vector of a small turn, exact to second order and a full one beyond.
Vector3d rotationVector(const Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  const Vector3d skew = 0.5 * Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return skew.norm() < 1e-3 ? skew : Vector3d(turn.angle() * turn.axis());
}

}  // namespace

// A joint between A (parent) and B (child), with points x and directions n fixed in A, in world axes:
//   r = x_B − x_A,  ω_r = ω_B − ω_A
// A row of positions along n is
//   g = n·r,  ġ = n·v_r,  v_r = v_B − v_A − ω_A × r                                             (a)
//   g̈ = n·(a_B − a_A − α_A × r − ω_A × (ω_A × r) − 2 ω_A × v_r)                                 (b)
// and a row of turns about n, which may move by ṅ,
//   ġ = n·ω_r,  g̈ = n·(α_B − α_A) + ṅ·ω_r                                                       (c)
// Balls, hinges, universals and welds have all of r, in world axes; a slide has r across its axis.

int Closures::rowsOf(JointKind kind) { return kind == JointKind::free ? 0 : 6 - freedomsOf(kind); }

Closures::Closures(const Mechanism& mechanism, const LoopTree& tree) : length_(mechanism.length()) {
  for (const std::size_t j : tree.cut) {
    const MechanismJoint& joint = mechanism.joints()[j];
    Cut cut;
    cut.joint = j;
    cut.kind = joint.kind;
    cut.parent = tree.element_of_body[joint.parent];
    cut.child = tree.element_of_body[joint.child];
    cut.on_parent = joint.centre;
    cut.on_child = joint.centre_of_child;
    cut.turn = joint.turn;
    cut.axis = joint.axis;
    if (joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic) {
      cut.across[0] = joint.axis[0].unitOrthogonal();
      cut.across[1] = joint.axis[0].cross(cut.across[0]);
    }
    cut.universal_cosine = joint.axis[0].dot(joint.axis[1]);
    cut.first = rows_;
    rows_ += rowsOf(joint.kind);
    cuts_.push_back(cut);
    joint_of_row_.resize(rows_, j);
  }
}

/// Calls row(index, turns, n, ṅ, g) for each row; positions of world axes have ω_A × terms only if `in_parent`.
template <class Row>
void Closures::eachRow(const Frames& frames, const Cut& cut, const Row& row) const {
  const FrameState &A = frames.at(cut.parent), &B = frames.at(cut.child);
  const Vector3d r = (B.R * cut.on_child + B.d) - (A.R * cut.on_parent + A.d);
  int next = cut.first;
  const Vector3d none = Vector3d::Zero();
  if (cut.kind == JointKind::prismatic) {
    for (const Vector3d& n_0 : cut.across) {
      const Vector3d n = A.R * n_0;
      row(next++, false, n, none, n.dot(r));
    }
  } else {
    for (int k = 0; k < 3; ++k) row(next++, false, Vector3d::Unit(k), none, r(k));
  }
  if (cut.kind == JointKind::fixed || cut.kind == JointKind::prismatic) {
    const Vector3d turn = rotationVector(B.R * cut.turn.transpose() * A.R.transpose());
    for (int k = 0; k < 3; ++k) row(next++, true, Vector3d::Unit(k), none, turn(k));
  } else if (cut.kind == JointKind::revolute) {
    const Vector3d a = A.R * cut.axis[0], b = B.R * (cut.turn.transpose() * cut.axis[0]);
    for (const Vector3d& n_0 : cut.across) {
      const Vector3d n = A.R * n_0;
      row(next++, true, n, A.omega.cross(n), n.dot(a.cross(b)));
    }
  } else if (cut.kind == JointKind::universal) {
    const Vector3d a = A.R * cut.axis[0], b = B.R * (cut.turn.transpose() * cut.axis[1]);
    row(next++, true, a.cross(b), A.omega.cross(a).cross(b) + a.cross(B.omega.cross(b)),
        cut.universal_cosine - a.dot(b));
  }
}

void Closures::errors(const Frames& frames, VectorXd& g) const {
  for (const Cut& cut : cuts_)
    eachRow(frames, cut, [&](int row, bool turns, const Vector3d&, const Vector3d&, double error) {
      g(row) = turns ? error : error / length_;
    });
}

void Closures::jacobian(const Frames& frames, MatrixXd& G) const {
  G.setZero();
  const Eigen::Index n = G.cols();
  MatrixXd angular(3, n), linear(3, n), of_parent(3, n);
  for (const Cut& cut : cuts_) {
    const FrameState &A = frames.at(cut.parent), &B = frames.at(cut.child);
    const Vector3d x_A = A.R * cut.on_parent + A.d, x_B = B.R * cut.on_child + B.d;
    angular.setZero();
    linear.setZero();
    frames.addColumns(cut.child, x_B, 1, angular, linear);
    // v_A + ω_A × r is the velocity of A's point at x_B.
    const bool in_parent = cut.kind == JointKind::prismatic;
    frames.addColumns(cut.parent, in_parent ? x_B : x_A, -1, angular, linear);
    eachRow(frames, cut, [&](int row, bool turns, const Vector3d& direction, const Vector3d&, double) {
      if (turns)
        G.row(row) = direction.transpose() * angular;  // (c)
      else
        G.row(row) = direction.transpose() * linear / length_;  // (a)
    });
  }
}

void Closures::bias(const Frames& frames, VectorXd& bias) const {
  for (const Cut& cut : cuts_) {
    const PointMotion A = frames.pointOf(cut.parent, cut.on_parent), B = frames.pointOf(cut.child, cut.on_child);
    const Vector3d r = B.x - A.x, v_r = B.v - A.v - A.omega.cross(r), w_r = B.omega - A.omega;
    Vector3d a_r = B.a - A.a;
    if (cut.kind == JointKind::prismatic)
      a_r -= A.alpha.cross(r) + A.omega.cross(A.omega.cross(r)) + 2 * A.omega.cross(v_r);
    eachRow(frames, cut, [&](int row, bool turns, const Vector3d& n, const Vector3d& n_rate, double) {
      bias(row) = turns ? n.dot(B.alpha - A.alpha) + n_rate.dot(w_r) : n.dot(a_r) / length_;  // (b), (c)
    });
  }
}

}  // namespace ursula::loops
