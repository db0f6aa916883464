#pragma once

#include <array>

#include "model/manipulator.h"

namespace ursula {

/// One leg's parameters in the scalar S, with the fixed frame of (2a).
template <class S>
struct LegModel {
  Vector3<S> a, b;                    ///< aᵢ in B, bᵢ in M
  Vector3<S> x_hat, y_hat, z_hat;     ///< columns of Q̂ᵢ (2b), in B; ŷᵢ = uᵢ
  S l, s;                             ///< lengths of the links
  S knee;                             ///< sign of sin θ
  S rho, sigma;                       ///< ρᵢ, σᵢ of (39a,b)
  S mass_proximal, mass_distal;       ///< mᵢ, m₆₊ᵢ
  Matrix3<S> I_proximal, I_distal;    ///< [Iᵢ]_G, [I₆₊ᵢ]_H
  std::array<S, 3> viscous, coulomb;  ///< friction on φ, ψ, θ
  S coulomb_speed;                    ///< smoothing speed of the Coulomb friction
};

/// The machine as the solver sees it: raw parameters in the scalar S and the constants made of them.
template <class S>
struct PaperModel {
  /// `printed_frames`: (2a,b) as printed, for the audit.
  explicit PaperModel(const Manipulator& manipulator, bool printed_frames = false);

  std::array<LegModel<S>, leg_count> legs;
  Vector3<S> gravity;  ///< g, in B
  S mass;              ///< m of the platform
  Vector3<S> rho;      ///< ρ, in M
  Matrix3<S> I_M;      ///< [I_M]_M
  S length;            ///< a length of the machine's size: the largest ‖bᵢ‖ or link
};

extern template struct PaperModel<double>;
extern template struct PaperModel<float>;

}  // namespace ursula
