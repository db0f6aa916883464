#pragma once

// The overrides of WrongNoc; included by the sources that instantiate it.

#include <type_traits>
#include <utility>

#include "nocsolver/noc/noc_impl.h"
#include "parts/wrong_formulas/wrong_legs_impl.h"
#include "parts/wrong_formulas/wrong_noc.h"

namespace ursula {
namespace wrong {

/// What the constructor reads, as the errors change it.
template <class S>
MachineParameters<S> readAs(MachineParameters<S> machine, const WithFormulaErrors& errors) {
  if constexpr (std::is_same_v<S, double>)
    if (errors.change_read) errors.change_read(machine);
  if (!errors.has(FormulaError::eq2)) return machine;
  for (LegModel<S>& leg : machine.legs) {  // (2b) as printed: orthonormal only without tilt
    const Vector3<S> u = leg.u;
    leg.x_hat = Vector3<S>(u.y(), -u.x(), S(0));
    leg.u = Vector3<S>(u.x(), u.y(), S(0));
    leg.z_hat = Vector3<S>::UnitZ();
  }
  return machine;
}

}  // namespace wrong

template <class S>
WrongNoc<S>::WrongNoc(const MachineParameters<S>& machine, WithFormulaErrors errors)
    : Base(wrong::readAs(machine, errors)), errors_(std::move(errors)) {}

// --- section 2 ------------------------------------------------------------------------------------------------------

template <class S>
void WrongNoc<S>::displacement(int i, const S& t, LegState<S>& out) const {
  if (has(FormulaError::eq5)) out.AB += S(2) * leg(i).a;
  Base::displacement(i, t, out);
  if (leg(i).kind == LegKind::URS && (has(FormulaError::eq14a) || has(FormulaError::eq14b))) {
    wrong::placeUrs(leg(i), errors_, out);
    Base::setFrames(leg(i), out);
    legs::Urs::ends(leg(i), out);
  }
  if constexpr (std::is_same_v<S, double>)
    if (errors_.change_leg) errors_.change_leg(leg(i), out);
}

template <class S>
void WrongNoc<S>::rows(int i, LegState<S>& out) const {
  Base::rows(i, out);
  if (has(FormulaError::eq23)) {
    if (leg(i).kind == LegKind::URS)
      out.row[0].A = leg(i).s * out.sin_sum;
    else
      for (JacobianRow<S>& row : out.row) row.A /= S(2);
  }
  if constexpr (std::is_same_v<S, double>)
    if (errors_.change_rows) errors_.change_rows(leg(i), out);
}

template <class S>
void WrongNoc<S>::rowRates(int i, LegState<S>& out) const {
  Base::rowRates(i, out);
  if (has(FormulaError::eq26_a_dot) && leg(i).kind == LegKind::URS) out.row[0].A_dot = legs::Urs::eta(leg(i), out);
}

template <class S>
Vector3<S> WrongNoc<S>::jointRates(int i, const LegState<S>& at, const Vector3<S>& v_B) const {
  Vector3<S> rate = Base::jointRates(i, at, v_B);
  if (leg(i).kind == LegKind::URS) wrong::rateUrs(leg(i), at, v_B, errors_, rate);
  return rate;
}

template <class S>
Vector3<S> WrongNoc<S>::jointAccelerations(int i, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& v_B,
                                           const Vector3<S>& a_B) const {
  Vector3<S> out = Base::jointAccelerations(i, at, rate, v_B, a_B);
  if (leg(i).kind == LegKind::URS) {
    wrong::accelerateUrs(leg(i), at, rate, v_B, a_B, errors_, out);
  } else if (has(FormulaError::drop_bias)) {
    for (int j = 0; j < 3; ++j) out(j) = at.row[j].n.dot(a_B) / at.row[j].A;
  }
  return out;
}

template <class S>
JointVariables<S> WrongNoc<S>::angles(const NocWorkspace<S>& work) const {
  using std::atan2;
  JointVariables<S> q = Base::angles(work);
  if (!has(FormulaError::eq14b)) return q;
  for (int i = 0; i < this->machine().legs_in_all; ++i) {
    if (leg(i).kind != LegKind::URS) continue;
    const LegState<S>& at = work.legs[i];
    q.psi(i) = atan2(S(leg(i).s * at.sine[2]), S(leg(i).l - leg(i).s * at.cosine[2])) +
               atan2(S(at.AB.cross(leg(i).u).norm()), S(-at.AB.dot(leg(i).u)));
  }
  return q;
}

template <class S>
Matrix6<S> WrongNoc<S>::platformShapingRate(const Motion<S>& motion, const NocWorkspace<S>& work) const {
  if (has(FormulaError::drop_row_rates)) return Matrix6<S>::Zero();
  Matrix6<S> T_dot = Base::platformShapingRate(motion, work);
  if (!has(FormulaError::eq26_b_dot)) return T_dot;
  Matrix6<S> more = Matrix6<S>::Zero();  // of Ḃ, by b in the place of Q b
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = this->machine().motors[m];
    const LegState<S>& at = work.legs[motor.leg];
    const Vector3<S> n = at.row[motor.joint].n.normalized();
    more.row(m).template head<3>() = motion.omega.cross(Vector3<S>(leg(motor.leg).b - at.Qb)).cross(n).transpose();
  }
  Matrix6<S> change = work.B_transposed.transpose().solve(Matrix6<S>(more * this->platformShaping(work)));
  change.template topRows<3>() /= this->machine().length;
  return T_dot - change;
}

// --- section 3 ------------------------------------------------------------------------------------------------------

template <class S>
LinkMotions<S> WrongNoc<S>::onLines(int i, const LegState<S>& at, const Vector3<S>& rate,
                                    const Vector3<S>& acceleration, bool with_rates) const {
  LinkMotions<S> out = Base::onLines(i, at, rate, acceleration, with_rates);
  legs::withLeg(leg(i).kind,
                [&](auto kind) { wrong::linksOf(kind, leg(i), at, rate, acceleration, errors_, with_rates, out); });
  return out;
}

template <class S>
void WrongNoc<S>::addOffLine(int i, const LegState<S>& at, LinkMotions<S>& links) const {
  Base::addOffLine(i, at, links);
  if (!has(FormulaError::drop_centrifugal)) return;
  const LinkMotions<S> now = onLines(i, at, at.rate, Vector3<S>(Vector3<S>::Zero()), false);
  links.proximal.c_ddot -= links.proximal.omega.cross(now.proximal.omega.cross(Vector3<S>(at.R_1 * leg(i).off_1)));
  links.distal.c_ddot -= links.distal.omega.cross(now.distal.omega.cross(Vector3<S>(at.R_2 * leg(i).off_2)));
}

template <class S>
void WrongNoc<S>::bodyMotions(const Motion<S>& motion, const NocWorkspace<S>& work, BodyMotions<S>& bodies) const {
  Base::bodyMotions(motion, work, bodies);
  if (has(FormulaError::drop_platform_centripetal))
    bodies.back().twist_rate.template tail<3>() -=
        motion.omega.cross(motion.omega.cross(Vector3<S>(this->platformArm(motion))));
}

template <class S>
typename WrongNoc<S>::Rates WrongNoc<S>::columnRates(int i, const LegState<S>& at, const Matrix6<S>& T_P) const {
  Rates out = Base::columnRates(i, at, T_P);
  for (int j = 0; j < 3; ++j) {
    const bool own = leg(i).motor[j] >= 0;
    if (has(own ? FormulaError::drop_own_column : FormulaError::drop_passive_rates)) out.row(j).setZero();
  }
  return out;
}

template <class S>
Vector3<S> WrongNoc<S>::columnArm(const Motion<S>& motion) const {
  return has(FormulaError::eq47) ? this->machine().rho : Base::columnArm(motion);
}

template <class S>
Vector3<S> WrongNoc<S>::sphericalPoint(const Motion<S>& motion, int i, const LegState<S>& at) const {
  return has(FormulaError::wrong_D) ? Vector3<S>(leg(i).a + at.O_2) : Base::sphericalPoint(motion, i, at);
}

template <class S>
Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> WrongNoc<S>::D(const Motion<S>& motion,
                                                                const NocWorkspace<S>& work) const {
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> D = Base::D(motion, work);
  if (has(FormulaError::lost_constraint)) D.row(2) = D.row(1);
  return D;
}

template <class S>
S WrongNoc<S>::massOf(int body) const {
  const bool distal = body >= leg_count && body < legs::platform;
  return distal && has(FormulaError::drop_mass_distal) ? S(0) : Base::massOf(body);
}

template <class S>
BodyTensors<S> WrongNoc<S>::tensors(const NocWorkspace<S>& work) const {
  BodyTensors<S> out = Base::tensors(work);
  if (has(FormulaError::untwisted_tensors))
    for (int i = 0; i < this->machine().legs_in_all; ++i) {
      out[i] = leg(i).I_1;
      out[leg_count + i] = leg(i).I_2;
    }
  if (has(FormulaError::untwisted_platform)) out.back() = this->machine().I_M;
  if (has(FormulaError::mass_for_inertia)) out.back().setZero();
  return out;
}

template <class S>
Vector6<S> WrongNoc<S>::rotors() const {
  return has(FormulaError::drop_rotor) ? Vector6<S>(Vector6<S>::Zero()) : Base::rotors();
}

template <class S>
Vector6<S> WrongNoc<S>::W(int body, const NocWorkspace<S>& work, const Vector6<S>& x) const {
  const bool lost =
      has(body == legs::platform ? FormulaError::drop_gyroscopic_platform : FormulaError::drop_gyroscopic_legs);
  return lost ? Vector6<S>(Vector6<S>::Zero()) : Base::W(body, work, x);
}

template <class S>
BodyVector<S> WrongNoc<S>::gravityWrench() const {
  BodyVector<S> w_g = Base::gravityWrench();
  if (has(FormulaError::drop_gravity_legs)) w_g.head(6 * legs::platform).setZero();
  if (has(FormulaError::drop_gravity_platform)) w_g.template tail<6>().setZero();
  return w_g;
}

template <class S>
BodyVector<S> WrongNoc<S>::dissipativeWrench(const NocWorkspace<S>& work) const {
  return has(FormulaError::drop_friction) ? BodyVector<S>(BodyVector<S>::Zero()) : Base::dissipativeWrench(work);
}

template <class S>
BodyVector<S> WrongNoc<S>::loadWrench(const Motion<S>& motion, const Vector6<S>& load) const {
  return has(FormulaError::drop_load) ? BodyVector<S>(BodyVector<S>::Zero()) : Base::loadWrench(motion, load);
}

template <class S>
Vector6<S> WrongNoc<S>::tauG(const Motion<S>& motion, const NocWorkspace<S>& work, const Vector6<S>& load) const {
  return has(FormulaError::drop_tau_g) ? Vector6<S>(Vector6<S>::Zero()) : Base::tauG(motion, work, load);
}

template <class S>
Vector6<S> WrongNoc<S>::tauD(const NocWorkspace<S>& work) const {
  return has(FormulaError::drop_tau_d) ? Vector6<S>(Vector6<S>::Zero()) : Base::tauD(work);
}

template <class S>
Matrix6<S> WrongNoc<S>::C(const NocWorkspace<S>& work) const {
  Matrix6<S> out = Base::C(work);
  if (has(FormulaError::drop_T_rate)) out -= work.T.transpose().lazyProduct(this->massTimes(work.I_B, work.T_rate));
  if (has(FormulaError::drop_W)) {
    TwistShaping<S> WMT = TwistShaping<S>::Zero();
    const TwistShaping<S> MT = this->massTimes(work.I_B, work.T);
    for (int b = 0; b < body_count; ++b)
      for (int m = 0; m < motor_count; ++m) legs::block(WMT, b).col(m) = W(b, work, legs::block(MT, b).col(m));
    out -= work.T.transpose().lazyProduct(WMT);
  }
  return out;
}

template <class S>
Vector6<S> WrongNoc<S>::inverseDynamics(const Motion<S>& motion, NocWorkspace<S>& work, const Vector6<S>& load) const {
  Vector6<S> tau = Base::inverseDynamics(motion, work, load);
  if (has(FormulaError::drop_inertia)) tau += work.T.transpose() * this->inertiaWrench(work);
  if (has(FormulaError::scaled_efforts)) tau *= S(1.001);
  if (has(FormulaError::scaled_first_effort)) tau(0) *= S(1 + 1e-7);
  return tau;
}

}  // namespace ursula
