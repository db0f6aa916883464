#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <stdexcept>

#include "parts/engines/bullet/bullet_machine_internal.h"

namespace ursula::bullet_engine {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }
btVector3 toBullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
btQuaternion toBullet(const Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return {q.x(), q.y(), q.z(), q.w()};
}
Vector3d vectorOf(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

void prepare(btMultiBody& body) {
  body.setLinearDamping(0);
  body.setAngularDamping(0);
  body.setMaxCoordinateVelocity(unlimited);
  body.finalizeMultiDof();
}

}  // namespace

BulletMachine::Principal BulletMachine::principalOf(const Matrix3d& inertia) {
  if (inertia.isDiagonal(0)) return {Matrix3d::Identity(), inertia.diagonal()};
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(inertia);
  Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0).eval();
  return {axes, solver.eigenvalues()};
}

BulletMachine::BulletMachine(const Manipulator& from)
    : EngineMachine(from, from.platform().center_of_mass), states_(at(from.legCount())) {
  for (int i = 0; i < from.legCount(); ++i) addLeg(from.leg(i));
  of_platform_ = principalOf(from.platform().inertia);
  platform_ = std::make_unique<btMultiBody>(0, from.platform().mass, toBullet(of_platform_.moments), false, false);
  prepare(*platform_);
}

/// Each joint of the chain is a link; the links' frames are at mass centres.
void BulletMachine::addLeg(const Leg& leg) {
  chains_.push_back(chainOf(leg));
  const LegChain& chain = chains_.back();
  legs_.push_back(std::make_unique<btMultiBody>(3, 0, btVector3(0, 0, 0), true, false));
  btMultiBody& body = *legs_.back();
  axes_.push_back({Matrix3d::Identity(), Matrix3d::Identity()});
  Matrix3d before = Matrix3d::Identity();
  Vector3d center_before = Vector3d::Zero();
  for (int j = 0; j < 3; ++j) {
    const Eigen::Isometry3d place = chain.place(j);
    Principal own{Matrix3d::Identity(), Vector3d::Zero()};
    Vector3d center = Vector3d::Zero();
    double mass = 0;
    if (const std::size_t link = at(chain.linkOf(j)); chain.movesLink(j)) {
      own = principalOf(chain.links[link].inertia);
      axes_.back()[link] = own.axes;
      center = chain.centers[link];
      mass = chain.links[link].mass;
    }
    const Matrix3d turn = own.axes.transpose() * place.linear().transpose() * before;
    const btVector3 pivot = toBullet(Vector3d(before.transpose() * (place.translation() - center_before)));
    const btVector3 arm = toBullet(Vector3d(own.axes.transpose() * center));
    const btVector3 axis = toBullet(Vector3d(own.axes.transpose() * chain.joint(j).axis));
    if (chain.slides(j))
      body.setupPrismatic(j, mass, toBullet(own.moments), j - 1, toBullet(turn), axis, pivot, arm, true);
    else
      body.setupRevolute(j, mass, toBullet(own.moments), j - 1, toBullet(turn), axis, pivot, arm, true);
    before = own.axes;
    center_before = center;
  }
  prepare(body);
}

void BulletMachine::place(btMultiBody& body) {
  btAlignedObjectArray<btVector3> origins;
  body.forwardKinematics(scratch_q_, origins);
}

void BulletMachine::set(const Motion<double>& motion, bool with_bias) {
  for (int i = 0; i < manipulator.legCount(); ++i) {
    LegMotion& state = states_[at(i)] = legState(chains_[at(i)], manipulator.leg(i), i, motion, with_bias);
    for (int j = 0; j < 3; ++j) {
      body(i).setJointPos(j, state.q(j));
      body(i).setJointVel(j, state.rates(j));
    }
    place(body(i));
  }
  const Matrix3d R = motion.Q * of_platform_.axes;
  const Vector3d r = motion.Q * manipulator.platform().center_of_mass;
  platform_->setBasePos(toBullet(Vector3d(motion.p + r)));
  platform_->setWorldToBaseRot(toBullet(Matrix3d(R.transpose())));
  platform_->setBaseOmega(toBullet(motion.omega));
  platform_->setBaseVel(toBullet(Vector3d(motion.p_dot + motion.omega.cross(r))));
  place(*platform_);
}

Eigen::MatrixXd BulletMachine::massInverse(btMultiBody& body, int first, int size, Eigen::VectorXd& free) {
  constexpr double dt = 1;  // s; Bullet adds accelerations times this to the speeds
  const int all = 6 + body.getNumDofs();
  const std::vector<btScalar> before(body.getVelocityVector(), body.getVelocityVector() + all);
  body.clearForcesAndTorques();
  const Vector3d& g = manipulator.gravity();
  if (!body.hasFixedBase()) body.addBaseForce(toBullet(Vector3d(body.getBaseMass() * g)));
  for (int k = 0; k < body.getNumLinks(); ++k) body.addLinkForce(k, toBullet(Vector3d(body.getLinkMass(k) * g)));
  body.computeAccelerationsArticulatedBodyAlgorithmMultiDof(dt, scratch_r_, scratch_v_, scratch_m_, false, false,
                                                            false);
  free = Eigen::VectorXd(size);
  for (int k = 0; k < size; ++k) free(k) = (body.getVelocityVector()[first + k] - before[at(first + k)]) / dt;
  Eigen::MatrixXd out(size, size);
  for (int k = 0; k < size; ++k) {
    std::vector<btScalar> unit(at(all), 0), response(at(all), 0);
    unit[at(first + k)] = 1;
    body.calcAccelerationDeltasMultiDof(unit.data(), response.data(), scratch_r_, scratch_v_);
    for (int row = 0; row < size; ++row) out(row, k) = response[at(first + row)];
  }
  body.clearForcesAndTorques();
  for (int k = 0; k < body.getNumLinks(); ++k) body.setJointVel(k, before[at(6 + k)]);
  body.setBaseOmega(btVector3(before[0], before[1], before[2]));
  body.setBaseVel(btVector3(before[3], before[4], before[5]));
  return out;
}

Vector3d BulletMachine::forces(int leg, const Vector3d& u_dot) {
  Eigen::VectorXd free;
  const Matrix3d inverse = massInverse(body(leg), 6, 3, free);
  return inverse.partialPivLu().solve(u_dot - Vector3d(free));
}

Vector6d BulletMachine::platformForces(const Vector6d& u_dot) {
  Eigen::VectorXd free;
  const Matrix6d inverse = massInverse(*platform_, 0, 6, free);
  return inverse.partialPivLu().solve(u_dot - Vector6d(free));
}

btVector3 BulletMachine::tip(int leg) const {
  const LegChain& chain = chains_[at(leg)];
  return toBullet(Vector3d(axes_[at(leg)][1].transpose() * (chain.tip - chain.centers[1])));
}

btVector3 BulletMachine::platformPoint(int leg) const {
  const Vector3d& b = manipulator.leg(leg).platform_point;
  return toBullet(Vector3d(of_platform_.axes.transpose() * (b - manipulator.platform().center_of_mass)));
}

void BulletMachine::readMaps(PlacedTree& out) {
  for (int i = 0; i < manipulator.legCount(); ++i) {
    const btVector3 end = body(i).localPosToWorld(2, tip(i)), point = platform_->localPosToWorld(-1, platformPoint(i));
    out.gaps[at(i)] = vectorOf(end - point);
    for (int k = 0; k < 3; ++k) {
      btScalar row[9] = {}, of_platform[6] = {};
      const btVector3 along = toBullet(Vector3d(Vector3d::Unit(k))), none(0, 0, 0);
      body(i).fillConstraintJacobianMultiDof(2, end, none, along, row, scratch_r_, scratch_v_, scratch_m_);
      platform_->fillConstraintJacobianMultiDof(-1, point, none, along, of_platform, scratch_r_, scratch_v_,
                                                scratch_m_);
      out.legs[at(i)].J.row(k) = Eigen::Map<const Eigen::RowVector3d>(row + 6);
      out.legs[at(i)].P.row(k) = Eigen::Map<const Eigen::Matrix<double, 1, 6>>(of_platform);
    }
  }
}

ChainBody BulletMachine::platformBody() const {
  ChainBody out;
  const btQuaternion q = platform_->getWorldToBaseRot();
  const Eigen::Quaterniond turned(q.w(), q.x(), q.y(), q.z());
  out.frame.linear() = turned.normalized().toRotationMatrix().transpose() * of_platform_.axes.transpose();
  out.frame.translation() = vectorOf(platform_->getBasePos());
  out.omega = vectorOf(platform_->getBaseOmega());
  out.velocity = vectorOf(platform_->getBaseVel());
  return out;
}

void BulletMachine::addWrench(const Vector6d& moment_and_force) {
  platform_->addBaseTorque(toBullet(Vector3d(moment_and_force.head<3>())));
  platform_->addBaseForce(toBullet(Vector3d(moment_and_force.tail<3>())));
}

/// Bullet gives velocities in the bodies' frames.
double BulletMachine::energyOf(btMultiBody& body) {
  const int links = body.getNumLinks();
  std::vector<btVector3> omega(at(links + 1)), velocity(at(links + 1));
  body.compTreeLinkVelocities(omega.data(), velocity.data());
  double out = 0;
  for (int k = -1; k < links; ++k) {
    const double mass = k < 0 ? (body.hasFixedBase() ? 0 : body.getBaseMass()) : body.getLinkMass(k);
    const btVector3 inertia = k < 0 ? body.getBaseInertia() : body.getLinkInertia(k);
    const btVector3 &w = omega[at(k + 1)], &v = velocity[at(k + 1)];
    const Vector3d c = vectorOf(body.localPosToWorld(k, btVector3(0, 0, 0)));
    out += mass * (v.dot(v) / 2 - manipulator.gravity().dot(c)) + w.dot(inertia * w) / 2;
  }
  return out;
}

double BulletMachine::energy() {
  double out = energyOf(*platform_);
  for (const auto& leg : legs_) out += energyOf(*leg);
  return out;
}

}  // namespace ursula::bullet_engine
