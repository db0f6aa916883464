#include "nocsolver/effort_derivatives.h"

#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

#include "nocsolver/kernels/leg_slopes.h"
#include "nocsolver/kernels/leg_guard.h"
#include "nocsolver/kernels/plane_dynamics.h"
#include "nocsolver/kernels/platform_at_p.h"

namespace ursula {
namespace {

using kernel::LegFault;
using kernel::LegNumbers;
using kernel::LegSlopes;
using Block = EffortsByState::Block;
using ByState = Eigen::Matrix<double, 6, 18>;

kernel::SlopeFunctions functionsOf(InstructionSet set) {
#ifdef URSULA_X86
  switch (set) {
    case InstructionSet::sse2:
      return kernel::slopesBySse2();
    case InstructionSet::avx2:
      return kernel::slopesByAvx2();
    case InstructionSet::avx512:
      return kernel::slopesByAvx512();
    case InstructionSet::portable:
      break;
  }
#endif
  return kernel::slopesOneByOne();
}

template <class Matrix>
void copy(const Matrix& from, double* to) {
  for (Eigen::Index k = 0; k < from.size(); ++k) to[k] = from.data()[k];
}

LegNumbers numbersOf(const kernel::MachineModel<double>& machine, std::size_t i) {
  const ChainModel<double>& leg = machine.legs[i];
  LegNumbers out{leg.kind, machine.rubs[i], machine.coulomb[i], leg.motor, {}, leg.l, leg.s, leg.knee, leg.rho,
                 leg.sigma, leg.mass_1, leg.mass_2, {}, {}, {}, {}, {}, {}};
  copy(leg.x_hat, out.axes);
  copy(leg.u, out.axes + 3);
  copy(leg.z_hat, out.axes + 6);
  copy(leg.I_1, out.I_1);
  copy(leg.I_2, out.I_2);
  copy(machine.lift[i], out.lift);
  for (std::size_t j = 0; j < 3; ++j) {
    out.viscous[j] = leg.viscous[j];
    out.smooth[j] = leg.coulomb[j];
    out.speed[j] = leg.speed[j];
  }
  return out;
}

void refuse(const LegFault& fault, int leg, double t) {
  switch (fault.kind) {
    case LegFault::out_of_reach:
      return kernel::requireReach<double>(false, leg, t, fault.measure, fault.bound);
    case LegFault::end_of_stroke:
      return kernel::requireStroke<double>(false, leg, t, fault.measure, fault.bound);
    case LegFault::point_on_axis:
      return kernel::requireOffAxis<double>(fault.measure, fault.bound, leg, t);
    case LegFault::stretched_leg:
      return kernel::requireRegular<double>(fault.measure, fault.what, leg, t);
    case LegFault::none:
      break;
  }
}

Matrix3d cross(const Vector3d& a) {
  Matrix3d out;
  out << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return out;
}

}  // namespace

struct EffortDerivatives::Impl {
  Impl(const Manipulator& manipulator, InstructionSet set)
      : functions(functionsOf(set)), machine(kernel::machineModel<double>(manipulator)) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(machine.legs_in_all); ++i) legs[i] = numbersOf(machine, i);
    platform.mass = machine.mass;
    copy(machine.rho, platform.rho);
    copy(machine.I_M, platform.I_M);
    copy(machine.gravity, platform.gravity);
  }
  kernel::SlopeFunctions functions;
  kernel::MachineModel<double> machine;
  std::array<LegNumbers, leg_count> legs;
  kernel::PlatformNumbers platform;
};

EffortDerivatives::EffortDerivatives(const Manipulator& manipulator, InstructionSet set) {
  if (!isSupported(set)) throw std::invalid_argument(std::string("this processor has no ") + nameOf(set));
  impl_ = std::make_unique<const Impl>(manipulator, set);
}
EffortDerivatives::~EffortDerivatives() = default;
EffortDerivatives::EffortDerivatives(EffortDerivatives&&) noexcept = default;
EffortDerivatives& EffortDerivatives::operator=(EffortDerivatives&&) noexcept = default;

EffortsByState EffortDerivatives::byState(const Motion<double>& motion, const Vector6d& load,
                                          const Block& load_by_turn) const {
  const auto& machine = impl_->machine;
  const int count = machine.legs_in_all;
  const kernel::Carried<double> carried(motion);
  std::array<kernel::TipMotion, leg_count> tips;
  std::array<LegSlopes, leg_count> slopes;
  std::array<Vector3d, leg_count> Qb;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const ChainModel<double>& model = machine.legs[i];
    Qb[i] = motion.Q * model.b;
    copy(kernel::alongAxes<double>(model, motion.p - model.a + Qb[i]), tips[i].AB);
    copy(kernel::alongAxes<double>(model, carried.velocity(Qb[i])), tips[i].v);
    copy(kernel::alongAxes<double>(model, carried.acceleration(Qb[i])), tips[i].a);
  }
  if (!impl_->functions.byState(impl_->legs.data(), tips.data(), count, slopes.data()))
    for (int i = 0; i < count; ++i) refuse(slopes[static_cast<std::size_t>(i)].fault, i, motion.t);
  kernel::PlatformSlopes platform;
  impl_->functions.ofPlatform(impl_->platform, motion.Q.data(), motion.omega.data(), motion.omega_dot.data(),
                              motion.p_ddot.data(), platform);
  Vector6d wrench = Eigen::Map<const Vector6d>(platform.wrench.data()) - load, Q_driven;
  Matrix6d G;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const ChainModel<double>& model = machine.legs[i];
    const LegSlopes& leg = slopes[i];
    Matrix3d R;
    R << leg.cosine * model.x_hat + leg.sine * model.z_hat, model.u, leg.cosine * model.z_hat - leg.sine * model.x_hat;
    kernel::addForceAt<double>(Qb[i], Eigen::Map<const Vector3d>(leg.force.data()), wrench);
    for (std::size_t j = 0; j < 3; ++j) {
      if (model.motor[j] < 0) continue;
      const Vector3d n = R * Eigen::Map<const Vector3d>(leg.k[j].data());
      G.col(model.motor[j]) << Qb[i].cross(n), n;
      Q_driven(model.motor[j]) = leg.Q[j];
    }
  }
  const Matrix6d H = G.inverse();
  const Vector6d mu = H * wrench;
  EffortsByState out;
  out.efforts = Q_driven + mu;
  ByState dR, dQ;
  for (int row = 0; row < 6; ++row) {
    const auto& from = platform.d_wrench[static_cast<std::size_t>(row)];
    for (int k = 0; k < 3; ++k) {
      dR(row, k) = from[k] - load_by_turn(row, k);
      dR(row, 3 + k) = 0;
      dR(row, 6 + k) = from[3 + k];
      dR(row, 9 + k) = 0;
      dR(row, 12 + k) = from[6 + k];
      dR(row, 15 + k) = from[9 + k];
    }
  }
  const Matrix3d omega = cross(motion.omega);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const ChainModel<double>& model = machine.legs[i];
    const LegSlopes& leg = slopes[i];
    Matrix3d R;
    R << leg.cosine * model.x_hat + leg.sine * model.z_hat, model.u, leg.cosine * model.z_hat - leg.sine * model.x_hat;
    kernel::PlaneLeg<double> plane;
    plane.C_1 = leg.C_1, plane.S_1 = leg.S_1, plane.C_2 = leg.C_2, plane.S_2 = leg.S_2, plane.d = leg.d;
    Matrix3d K;
    for (int j = 0; j < 3; ++j) K.row(j) = R * Eigen::Map<const Vector3d>(leg.k[static_cast<std::size_t>(j)].data());
    const Matrix3d D = kernel::massMatrix<double>(model, plane) * K;
    Eigen::Matrix<double, 6, 3> J_k, J_v, J_a;
    Vector3d f = Eigen::Map<const Vector3d>(leg.force.data());
    J_a.topRows<3>().setZero();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        J_k(r, c) = leg.d_force[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
        J_v(r, c) = leg.d_force[static_cast<std::size_t>(r)][static_cast<std::size_t>(3 + c)];
      }
    for (std::size_t j = 0; j < 3; ++j) {
      const auto at = static_cast<Eigen::Index>(j);
      if (model.motor[j] < 0) {
        J_a.topRows<3>() += K.row(at).transpose() * D.row(at);
        continue;
      }
      const double m = mu(model.motor[j]);
      f -= m * K.row(at).transpose();
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          J_k(r, c) -= m * leg.d_row[j][static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
          J_v(r, c) -= m * leg.d_row[j][static_cast<std::size_t>(r)][static_cast<std::size_t>(3 + c)];
        }
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const auto at = static_cast<Eigen::Index>(j);
      J_a.row(3 + at) = D.row(at);
      for (int c = 0; c < 3; ++c) {
        J_k(3 + at, c) = leg.d_Q[j][static_cast<std::size_t>(c)];
        J_v(3 + at, c) = leg.d_Q[j][static_cast<std::size_t>(3 + c)];
      }
    }
    const Matrix3d arm = -cross(Qb[i]);
    const Block J_e = J_k + J_v * omega + J_a * carried.W;
    ByState rows;
    rows << J_e * arm, J_k, J_v * arm + J_a * (omega * arm - cross(motion.omega.cross(Qb[i]))), J_v, J_a * arm, J_a;
    dR.bottomRows<3>() += rows.topRows<3>();
    dR.topRows<3>() -= arm * rows.topRows<3>();
    dR.topLeftCorner<3, 3>() += Qb[i] * f.transpose() - Qb[i].dot(f) * Matrix3d::Identity();
    for (std::size_t j = 0; j < 3; ++j)
      if (model.motor[j] >= 0) dQ.row(model.motor[j]) = rows.row(3 + static_cast<Eigen::Index>(j));
  }
  out.derivatives = dQ + H * dR;
  return out;
}

}  // namespace ursula
