// A solver as a process that asks Bullet 3, on the model that `ursula export --format urdf` wrote:
//
//   ursula export scenario.toml --format urdf --out machine.urdf
//   ursula validate scenario.toml --solver 'bullet_solver machine.urdf [RECIPE]'
//
// RECIPE is exact, or one that is often taken instead and is wrong: tree, least_squares, no_bias. A scenario's load is
// not in the file, nor the smoothing of its dry friction. Debian has no header of Bullet's inverse dynamics, so forces
// are M (q̈ − q̈₀), with q̈₀ the accelerations without motors. It needs BT_USE_DOUBLE_PRECISION and the libraries in
// double precision: BulletDynamics-float64, BulletCollision-float64, LinearMath-float64.

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <Eigen/Eigenvalues>

#include "examples/engines/urdf_chain_internal.h"

namespace {

using closed_chain::UrdfFile, closed_chain::UrdfJoint, closed_chain::UrdfLink;
using Eigen::Matrix3d, Eigen::Vector3d, Eigen::VectorXd;

btVector3 toBullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

class Bullet : public closed_chain::Engine {
 public:
  Bullet(const UrdfFile& file, const Vector3d& gravity)
      : file_(file),
        gravity_(toBullet(gravity)),
        body_(static_cast<int>(file.joints.size()), 0, btVector3(0, 0, 0), true, false),
        moves_(file.links.size()),
        holder_(file.links.size(), -1) {
    for (const UrdfLink& link : file.links) principal_.emplace_back(link.inertia);
    for (std::size_t j = 0; j < file.joints.size(); ++j) add(static_cast<int>(j), file.joints[j]);
    body_.setLinearDamping(0);
    body_.setAngularDamping(0);
    body_.setMaxCoordinateVelocity(1e30);  // clipped at 100 otherwise
    body_.finalizeMultiDof();
  }

  void set(const VectorXd& q, const VectorXd& rates, const VectorXd& accelerations) override {
    accelerations_ = accelerations;
    for (std::size_t j = 0; j < file_.joints.size(); ++j) {
      const UrdfJoint& joint = file_.joints[j];
      const bool free = joint.coordinate >= 0;
      const double at = free ? q(joint.coordinate) : 0, rate = free ? rates(joint.coordinate) : 0;
      if (free) body_.setJointPos(static_cast<int>(j), at), body_.setJointVel(static_cast<int>(j), rate);
      move(joint, at, rate, free ? accelerations(joint.coordinate) : 0);
    }
  }

  /// Bullet gives Jacobians, and no accelerations: those are of the recursion in `move`.
  closed_chain::Place place(int link, const Vector3d& point) override {
    const Moves& m = moves_[at(link)];
    const Vector3d arm = m.frame.linear() * point;
    closed_chain::Place out{m.frame * point, m.frame.linear(), Eigen::MatrixXd::Zero(6, file_.coordinates), {}};
    out.acceleration << m.a + m.alpha.cross(arm) + m.w.cross(m.w.cross(arm)), m.alpha;
    std::vector<btScalar> row(at(6 + body_.getNumDofs()));
    for (int k = 0; k < 6 && holder_[at(link)] >= 0; ++k) {
      const btVector3 along = toBullet(Vector3d::Unit(k % 3)), none(0, 0, 0);
      body_.fillConstraintJacobianMultiDof(holder_[at(link)], toBullet(out.position), k < 3 ? none : along,
                                           k < 3 ? along : none, row.data(), scratch_r_, scratch_v_, scratch_m_);
      out.jacobian.row(k) = Eigen::Map<const Eigen::RowVectorXd>(row.data() + 6, file_.coordinates);
    }
    return out;
  }

  VectorXd forces() override {
    const int n = file_.coordinates;
    const VectorXd before = Eigen::Map<const VectorXd>(body_.getVelocityVector() + 6, n);
    body_.clearForcesAndTorques();
    for (int j = 0; j < body_.getNumLinks(); ++j) body_.addLinkForce(j, gravity_ * body_.getLinkMass(j));
    body_.computeAccelerationsArticulatedBodyAlgorithmMultiDof(1, scratch_r_, scratch_v_, scratch_m_, false, false,
                                                               false);  // adds one second of q̈₀ to the rates
    const VectorXd free = Eigen::Map<const VectorXd>(body_.getVelocityVector() + 6, n) - before;
    Eigen::MatrixXd inverse(n, n);
    for (int k = 0; k < n; ++k) {
      VectorXd unit = VectorXd::Unit(6 + n, 6 + k), response(6 + n);
      body_.calcAccelerationDeltasMultiDof(unit.data(), response.data(), scratch_r_, scratch_v_);
      inverse.col(k) = response.tail(n);
    }
    for (const UrdfJoint& joint : file_.joints)
      if (joint.coordinate >= 0) body_.setJointVel(holder_[at(joint.child)], before(joint.coordinate));
    return inverse.partialPivLu().solve(accelerations_ - free);
  }

 private:
  /// A link's frame, and the rates of its axes and origin, in the world.
  struct Moves {
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    Vector3d w = Vector3d::Zero(), alpha = w, a = w;
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  void move(const UrdfJoint& joint, double q, double rate, double acceleration) {
    const bool slides = joint.type == "prismatic";
    Moves m = moves_[at(joint.parent)];
    const Eigen::Isometry3d frame = m.frame * joint.origin;
    const Vector3d axis = frame.linear() * joint.axis, step = slides ? Vector3d(q * axis) : Vector3d::Zero();
    const Vector3d arm = frame.translation() + step - m.frame.translation();
    m.a += m.alpha.cross(arm) + m.w.cross(m.w.cross(arm));
    if (slides) m.a += acceleration * axis + 2 * rate * m.w.cross(axis);
    if (!slides) m.alpha += acceleration * axis + rate * m.w.cross(axis);
    if (!slides) m.w += rate * axis;
    m.frame = Eigen::Translation3d(step) * frame;
    if (!slides) m.frame.rotate(Eigen::AngleAxisd(q, joint.axis));
    moves_[at(joint.child)] = m;
  }

  /// Bullet's frames are at mass centres, along principal axes; the base's is the file's.
  void add(int index, const UrdfJoint& joint) {
    const int parent = holder_[at(joint.parent)];
    const Matrix3d before = parent < 0 ? Matrix3d::Identity() : axesOf(joint.parent), axes = axesOf(joint.child);
    const UrdfLink& link = file_.links[at(joint.child)];
    const Vector3d center = parent < 0 ? Vector3d::Zero() : file_.links[at(joint.parent)].center;
    const Eigen::Quaterniond turn(Matrix3d(axes.transpose() * joint.origin.linear().transpose() * before));
    const btQuaternion turned(turn.x(), turn.y(), turn.z(), turn.w());
    const btVector3 pivot = toBullet(before.transpose() * (joint.origin.translation() - center));
    const btVector3 arm = toBullet(axes.transpose() * link.center), axis = toBullet(axes.transpose() * joint.axis);
    const btVector3 moments = toBullet(principal_[at(joint.child)].eigenvalues());
    if (joint.type == "fixed")
      body_.setupFixed(index, link.mass, moments, parent, turned, pivot, arm);
    else if (joint.type == "prismatic")
      body_.setupPrismatic(index, link.mass, moments, parent, turned, axis, pivot, arm, true);
    else
      body_.setupRevolute(index, link.mass, moments, parent, turned, axis, pivot, arm, true);
    holder_[at(joint.child)] = index;
  }

  Matrix3d axesOf(int link) const {
    const Matrix3d& axes = principal_[at(link)].eigenvectors();
    return axes.determinant() < 0 ? Matrix3d(-axes) : axes;
  }

  UrdfFile const& file_;
  btVector3 gravity_;
  btMultiBody body_;
  std::vector<Moves> moves_;  ///< of each link
  std::vector<int> holder_;   ///< Bullet's index of each link; -1 for the base
  std::vector<Eigen::SelfAdjointEigenSolver<Matrix3d>> principal_;
  VectorXd accelerations_;
  btAlignedObjectArray<btScalar> scratch_r_;
  btAlignedObjectArray<btVector3> scratch_v_;
  btAlignedObjectArray<btMatrix3x3> scratch_m_;
};

}  // namespace

int main(int argc, char** argv) { return closed_chain::answerByUrdf<Bullet>(argc, argv); }
