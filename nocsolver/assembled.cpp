#include "nocsolver/assembled.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "model/real50.h"
#include "nocsolver/kernels/dynamics.h"

namespace ursula {
namespace {

constexpr int size = 6 * body_count;

template <class S>
Matrix3<S> crossMatrix(const Vector3<S>& v) {
  Matrix3<S> out;
  out << S(0), -v.z(), v.y(), v.z(), S(0), -v.x(), -v.y(), v.x(), S(0);
  return out;
}

int proximal(int leg) { return leg; }
int distal(int leg) { return leg_count + leg; }
constexpr int platform = 2 * leg_count;

/// Rows of D that give the velocity of a point: ċ + ω × arm, times `sign`.
template <class S, class Matrix>
void addPointVelocity(Matrix& D, int row, int body, const Vector3<S>& arm, int sign) {
  D.template block<3, 3>(row, 6 * body) += S(-sign) * crossMatrix<S>(arm);
  D.template block<3, 3>(row, 6 * body + 3) += S(sign) * Matrix3<S>::Identity();
}

}  // namespace

template <class S>
AssembledDynamics<S>::AssembledDynamics(const Manipulator& manipulator, const Motion<S>& motion, const Vector6<S>& load)
    : solver_(manipulator),
      M_(MatrixX::Zero(size, size)),
      W_(MatrixX::Zero(size, size)),
      D_(MatrixX::Zero(size, size)),
      t_(size),
      t_rate_(size),
      w_g_(VectorX::Zero(size)),
      w_d_(VectorX::Zero(size)),
      w_e_(VectorX::Zero(size)) {
  BodyMotions<S> bodies;
  solver_.inverseKinematics(motion, work_);
  solver_.jacobians(motion, work_);
  solver_.bodyMotions(motion, work_, bodies);
  solver_.twistShaping(motion, work_, T_);
  solver_.twistShapingRate(motion, work_, T_rate_);
  setBodies(bodies);
  setFriction();
  setConstraints(motion, bodies);
  // From P to the mass centre.
  const Vector3<S> arm = motion.Q * solver_.model().rho;
  const Vector3<S> force = load.template tail<3>();
  w_e_.template segment<6>(6 * platform) << load.template head<3>() - arm.cross(force), force;
}

/// M, W, t, ṫ and w^g. (29), (30), (45), (46)
template <class S>
void AssembledDynamics<S>::setBodies(const BodyMotions<S>& bodies) {
  const PaperModel<S>& model = solver_.model();
  for (int b = 0; b < body_count; ++b) {
    const LegModel<S>& leg = model.legs[static_cast<std::size_t>(b % leg_count)];
    const bool is_platform = b == platform;
    const S mass = is_platform ? model.mass : (b < leg_count ? leg.mass_proximal : leg.mass_distal);
    const Matrix3<S>& inertia = is_platform ? model.I_M : (b < leg_count ? leg.I_proximal : leg.I_distal);
    const BodyMotion<S>& body = bodies[static_cast<std::size_t>(b)];
    const int k = 6 * b;
    M_.template block<3, 3>(k, k) = body.R * inertia * body.R.transpose();  // (paper, eq. 46)
    M_.template block<3, 3>(k + 3, k + 3) = mass * Matrix3<S>::Identity();  // (paper, eq. 29)
    W_.template block<3, 3>(k, k) = crossMatrix<S>(body.twist.template head<3>());
    t_.template segment<6>(k) = body.twist;  // (paper, eq. 30)
    t_rate_.template segment<6>(k) = body.twist_rate;
    w_g_.template segment<3>(k + 3) = mass * model.gravity;  // (paper, eq. 45)
  }
}

/// A joint's friction acts on the outboard body and back on the inboard one. φ turns about −u, ψ and θ about x.
template <class S>
void AssembledDynamics<S>::setFriction() {
  for (int i = 0; i < leg_count; ++i) {
    const LegModel<S>& leg = solver_.model().legs[static_cast<std::size_t>(i)];
    const LegState<S>& state = work_.legs[static_cast<std::size_t>(i)];
    const JointTriple<S> against = kernel::legFriction(leg, state.rate, Corrected{});
    w_d_.template segment<3>(6 * proximal(i)) =
        against.phi * leg.y_hat - against.psi * state.x + against.theta * state.x;
    w_d_.template segment<3>(6 * distal(i)) = -against.theta * state.x;
  }
}

/// 13 rows a leg: A rests (3), no turn about u × x (1); R is one point of both links (3), which turn alike but for x
/// (3, of rank 2); B is one point of link and platform (3). 6 × 12 = 72 are independent. (33)
template <class S>
void AssembledDynamics<S>::setConstraints(const Motion<S>& motion, const BodyMotions<S>& bodies) {
  const Vector3<S> C = bodies.back().c;
  for (int i = 0; i < leg_count; ++i) {
    const LegModel<S>& leg = solver_.model().legs[static_cast<std::size_t>(i)];
    const LegState<S>& state = work_.legs[static_cast<std::size_t>(i)];
    const BodyMotion<S>& first = bodies[static_cast<std::size_t>(proximal(i))];
    const BodyMotion<S>& second = bodies[static_cast<std::size_t>(distal(i))];
    const Vector3<S> R = leg.a + leg.l * first.R.col(2), B = motion.p + state.Qb;
    const int row = 13 * i;
    addPointVelocity<S>(D_, row, proximal(i), leg.a - first.c, 1);
    D_.template block<1, 3>(row + 3, 6 * proximal(i)) = leg.y_hat.cross(state.x).transpose();
    addPointVelocity<S>(D_, row + 4, proximal(i), R - first.c, 1);
    addPointVelocity<S>(D_, row + 4, distal(i), R - second.c, -1);
    D_.template block<3, 3>(row + 7, 6 * proximal(i)) = crossMatrix<S>(state.x);
    D_.template block<3, 3>(row + 7, 6 * distal(i)) = -crossMatrix<S>(state.x);
    addPointVelocity<S>(D_, row + 10, distal(i), B - second.c, 1);
    addPointVelocity<S>(D_, row + 10, platform, B - C, -1);  // (paper, eq. 33)
  }
}

template <class S>
typename AssembledDynamics<S>::VectorX AssembledDynamics<S>::actuatorWrench(const Vector6<S>& torques) const {
  VectorX w = VectorX::Zero(size);
  for (int i = 0; i < leg_count; ++i)  // (paper, eq. 35)
    w.template segment<3>(6 * proximal(i)) = -torques(i) * solver_.model().legs[static_cast<std::size_t>(i)].y_hat;
  return w;
}

template <class S>
typename AssembledDynamics<S>::VectorX AssembledDynamics<S>::inertiaWrench() const {
  return -M_ * t_rate_ - W_ * (M_ * t_);  // (paper, eqs. 28, 38)
}

template <class S>
typename AssembledDynamics<S>::VectorX AssembledDynamics<S>::constraintWrench(const Vector6<S>& torques) const {
  return -inertiaWrench() - actuatorWrench(torques) - w_g_ - w_d_ - w_e_;  // (paper, eq. 31)
}

template <class S>
Matrix6<S> AssembledDynamics<S>::I() const {
  return T_.transpose() * M_ * T_;  // (paper, eq. 34)
}

template <class S>
Matrix6<S> AssembledDynamics<S>::C() const {
  return T_.transpose() * (M_ * T_rate_ + W_ * (M_ * T_));  // (paper, eq. 34)
}

template <class S>
Vector6<S> AssembledDynamics<S>::tauG() const {
  return T_.transpose() * w_g_;
}

template <class S>
Vector6<S> AssembledDynamics<S>::tauD() const {
  return T_.transpose() * w_d_;
}

template <class S>
Vector6<S> AssembledDynamics<S>::tauLoad() const {
  return T_.transpose() * w_e_;
}

template <class S>
Vector6<S> AssembledDynamics<S>::jointAccelerations(const Vector6<S>& torques) const {
  const Vector6<S> rates = solver_.rates(work_).phi;
  return I().llt().solve(Vector6<S>(torques + tauG() + tauD() + tauLoad() - C() * rates));  // (paper, eq. 36)
}

template class AssembledDynamics<double>;
template class AssembledDynamics<Real50>;

}  // namespace ursula
