#pragma once

// Direct dynamics with the platform's pose and twist as the state. Internal.
//
// (36) is projected on the platform's twist t_P instead of φ̇ = A⁻¹B t_P: multiplied by BᵀA⁻¹ it reads
//   M_P ṫ_P + w₀ = BᵀA⁻¹ τ + w_load                                            (a)
// with M_P = (BᵀA⁻¹) I (A⁻¹B) and w₀ the wrench at P of everything but ṫ_P. No direct kinematics is needed to integrate
// it, and M_P is positive definite wherever the legs are not singular, also where B is.

#include <Eigen/Cholesky>

#include "nocsolver/kernels/dynamics.h"
#include "nocsolver/kernels/platform_at_p.h"
#include "nocsolver/paper_solver.h"

namespace ursula::kernel {

/// Mass matrix of one leg in (φ, ψ, θ).
template <class S>
Matrix3<S> legMassMatrix(const LegModel<S>& leg, const LegState<S>& state) {
  const auto cross_inertia = [](const Matrix3<S>& I, const S& cosine, const S& sine) {
    // In the link's frame x is the first axis and −y of Fᵢ is [0, −sine, −cosine] (40).
    return std::array<S, 3>{I(0, 0), -(I(0, 1) * sine + I(0, 2) * cosine),
                            I(1, 1) * sine * sine + S(2) * I(1, 2) * sine * cosine + I(2, 2) * cosine * cosine};
  };
  const auto first = cross_inertia(leg.I_proximal, state.cos_psi, state.sin_psi);
  const auto second = cross_inertia(leg.I_distal, S(-state.cos_sum), S(-state.sin_sum));
  // Mass centre of the distal link: partial velocities of ψ + θ and of ψ through the knee, (y, z) parts.
  const S d_y = leg.sigma * state.sin_sum, d_z = -leg.sigma * state.cos_sum;
  const S k_y = -leg.l * state.sin_psi, k_z = leg.l * state.cos_psi;
  const S c_z = leg.rho * state.sin_psi, D_z = leg.l * state.sin_psi - leg.sigma * state.sin_sum;
  const S theta_theta = second[0] + leg.mass_distal * (d_y * d_y + d_z * d_z);
  const S knee_theta = leg.mass_distal * (k_y * d_y + k_z * d_z);
  Matrix3<S> M;
  M(2, 2) = theta_theta;
  M(1, 2) = theta_theta + knee_theta;
  M(1, 1) = theta_theta + S(2) * knee_theta + leg.mass_distal * leg.l * leg.l + first[0] +
            leg.mass_proximal * leg.rho * leg.rho;
  M(0, 2) = second[1];
  M(0, 1) = first[1] + second[1];
  M(0, 0) = first[2] + second[2] + leg.mass_proximal * c_z * c_z + leg.mass_distal * D_z * D_z;
  M(1, 0) = M(0, 1);
  M(2, 0) = M(0, 2);
  M(2, 1) = M(1, 2);
  return M;
}

/// Joint rates for velocities of Bᵢ along x, y, z of Fᵢ: (15a), (15b), (4b) as a matrix.
template <class S>
Matrix3<S> rateMatrix(const LegModel<S>& leg, const LegState<S>& state) {
  const S distance = leg.s * state.sin_sum - leg.l * state.sin_psi;
  const S per_ls = S(1) / (leg.l * leg.s * state.sin_theta);
  const S lever = leg.s * state.sin_sum;
  const S theta_y = state.k_y * per_ls, theta_z = state.r * per_ls;
  Matrix3<S> K = Matrix3<S>::Zero();
  K(0, 0) = S(1) / distance;
  K(1, 1) = (S(1) - lever * theta_y) / distance;
  K(1, 2) = -lever * theta_z / distance;
  K(2, 1) = theta_y;
  K(2, 2) = theta_z;
  return K;
}

template <class S>
Matrix3<S> legFrameInBase(const LegModel<S>& leg, const LegState<S>& state) {
  Matrix3<S> F;
  F << state.x, leg.y_hat, state.z;
  return F;
}

/// M_P of (a): the whole machine's mass matrix in the platform's twist at P.
template <class S>
Matrix6<S> massMatrixAtP(const PaperModel<S>& model, const Motion<S>& motion, const PaperWorkspace<S>& work) {
  Matrix6<S> M_P = Matrix6<S>::Zero();
  addAtP<S>(model.mass * Matrix3<S>::Identity(), motion.Q * model.rho, M_P);
  M_P.template topLeftCorner<3, 3>() += motion.Q * model.I_M * motion.Q.transpose();
  for (std::size_t i = 0; i < leg_count; ++i) {
    const Matrix3<S> FK =
        legFrameInBase(model.legs[i], work.legs[i]) * rateMatrix(model.legs[i], work.legs[i]).transpose();
    addAtP<S>(FK * legMassMatrix(model.legs[i], work.legs[i]) * FK.transpose(), work.legs[i].Qb, M_P);
  }
  return M_P;
}

}  // namespace ursula::kernel
