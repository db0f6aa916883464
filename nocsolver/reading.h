#pragma once

#include <bitset>

namespace ursula {

/// Ways in which a formula of the solver can be wrong: as printed in our source of the paper, or with a term left out.
/// They exist so that it can be shown what each does and which check catches it.
enum class Slip {
  eq2,                   ///< (2a,b) frame built as if uᵢ lay in the base plane
  eq4c,                  ///< (4c) qᵢ² for q̇ᵢ²
  eq5,                   ///< (5), (27) +aᵢ for −aᵢ
  eq14a,                 ///< (14a) φ folded into [0, π]
  eq14b,                 ///< (14b) −k_y for +k_y
  eq15a,                 ///< (15a) without − l sin ψ
  eq15b,                 ///< (15b) θ for θ̇
  eq16,                  ///< (16) −ωᵢ
  eq17,                  ///< (17a,b) −ω̇ᵢ
  eq19a,                 ///< (19a) ηφ, and without the terms in l
  eq19b,                 ///< (19b) without the factor ψ̇
  eq23,                  ///< (23) aᵢᵢ = s sin(ψ+θ)
  eq26_a_dot,            ///< (26) ȧᵢᵢ = η
  eq26_b_dot,            ///< (26) first row of Ḃ without Ω's Q
  eq43b_omega_dot,       ///< (43b) Ω̇ᵢ² for Ωᵢ²
  eq43b_sigma,           ///< (43b) σᵢ + [sᵢ] for σᵢ[sᵢ]
  eq43b_doubled,         ///< (43b) last terms twice
  eq47,                  ///< text by (47): Qbᵢ − ρ for Q(bᵢ − ρ)
  drop_centrifugal,      ///< Ωᵢ² terms of (43a,b) left out
  drop_coriolis,         ///< 2Ωᵢ terms of (43a,b) left out
  drop_gyroscopic_legs,  ///< ωᵢ × Iᵢωᵢ of (38) left out for the links
  drop_gyroscopic_platform,
  drop_platform_centripetal,  ///< Ω² of (43c) left out
  drop_gravity_legs,
  drop_gravity_platform,
  drop_friction,
  drop_link_coupling,  ///< l[ė], l[ë] of (41b), (43b) left out; of the general road what the distal link puts on R
  // of the general road alone
  half_coriolis,       ///< ω × ė once where a link slides
  drop_bias,           ///< q̈ = K a_B, as if B had no acceleration for q̈ = 0
  drop_map_rate,       ///< K̇ left out of Ṫ
  drop_own_share,      ///< what falls on the motors without passing the platform left out
  drop_passive_share,  ///< what joints without a motor cannot bear not brought onto the platform
  untwisted_tensors,   ///< tensors of links as if in B
  count
};

/// The formulas that hold; costs nothing.
struct Corrected {
  static constexpr bool has(Slip) { return false; }
  /// What the general road makes of a leg beside, once its joints are known, and once its map is.
  template <class Model, class State>
  static constexpr void placed(const Model&, State&) {}
  template <class Model, class State>
  static constexpr void mapped(const Model&, State&) {}
};

/// The formulas that hold but for the slips set.
class WithSlips {
 public:
  WithSlips() = default;
  explicit WithSlips(Slip slip) { set(slip); }
  WithSlips& set(Slip slip) {
    slips_.set(static_cast<std::size_t>(slip));
    return *this;
  }
  bool has(Slip slip) const { return slips_.test(static_cast<std::size_t>(slip)); }

 private:
  std::bitset<static_cast<std::size_t>(Slip::count)> slips_;
};

}  // namespace ursula
