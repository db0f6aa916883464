#pragma once

#include <bitset>
#include <functional>

#include "nocsolver/noc/noc.h"

namespace ursula {

/// Possible errors in a formula of noc/ or of a kind of leg: a misprint of our source of the paper, or a missing term.
/// They show the effect of each error and which check catches it.
enum class FormulaError {
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
  eq23,                  ///< (23) aᵢᵢ = s sin(ψ+θ); for other kinds half of A
  eq26_a_dot,            ///< (26) ȧᵢᵢ = η
  eq26_b_dot,            ///< (26) first row of Ḃ without Ω's Q
  eq43b_omega_dot,       ///< (43b) Ω̇ᵢ² for Ωᵢ²
  eq43b_sigma,           ///< (43b) σᵢ + [sᵢ] for σᵢ[sᵢ]
  eq43b_doubled,         ///< (43b) last terms twice
  eq47,                  ///< text by (47): Qbᵢ − ρ for Q(bᵢ − ρ)
  drop_centrifugal,      ///< Ωᵢ² terms of (43a,b) left out
  drop_coriolis,         ///< 2Ωᵢ terms of (43a,b) left out
  drop_gyroscopic_legs,  ///< W M t of (28), ωᵢ × Iᵢωᵢ of (38), left out for the links
  drop_gyroscopic_platform,
  drop_platform_centripetal,  ///< Ω² of (43c) left out
  drop_gravity_legs,          ///< w^g of (45) without the links
  drop_gravity_platform,
  drop_friction,        ///< w^d of (35) left out
  drop_link_coupling,   ///< l[ė], l[ë] of (41b), (43b) left out, the proximal link's part in the distal one's motion
  half_coriolis,        ///< ω × ė once instead of twice for a sliding link
  drop_bias,            ///< Ȧ q̇ and ṅ · v_B left out of the joints' accelerations
  drop_row_rates,       ///< Ȧ and Ḃ of (26) left out of (25)
  drop_own_column,      ///< (48) without the driven joint's own unit rate
  drop_passive_rates,   ///< (48) without the rates of the passive joints
  untwisted_tensors,    ///< (46a,b) left out: tensors of links as if in B
  untwisted_platform,   ///< (46c) left out: the platform's tensor as if in B
  mass_for_inertia,     ///< (29) M of the platform without its inertia
  drop_mass_distal,     ///< (29) M of the distal links without m₆₊ᵢ
  drop_T_rate,          ///< (34) C without M Ṫ
  drop_W,               ///< (34) C without W M T
  drop_tau_g,           ///< (36) without τ^g
  drop_tau_d,           ///< (36) without τ^d
  drop_inertia,         ///< (37) without wⁿ
  drop_load,            ///< (35) without the load on the platform
  drop_rotor,           ///< inertia of the motors' rotors left out
  scaled_first_effort,  ///< (37) of motor 1 times 1 + 1e-7
  scaled_efforts,       ///< (37) times 1.001
  wrong_D,              ///< (33) D with the spherical joints at the distal links' first ends
  lost_constraint,      ///< (33) D with one row twice, another left out
  count
};

/// The correct formulas except for the set errors. It can also change the numbers that the solver reads, or a leg's
/// displacement. For negative controls.
class WithFormulaErrors {
 public:
  using ReadChange = std::function<void(MachineParameters<double>&)>;
  using LegChange = std::function<void(const LegModel<double>&, LegState<double>&)>;

  WithFormulaErrors() = default;
  explicit WithFormulaErrors(FormulaError formula_error) { set(formula_error); }
  WithFormulaErrors& set(FormulaError formula_error) {
    formula_errors_.set(static_cast<std::size_t>(formula_error));
    return *this;
  }
  bool has(FormulaError formula_error) const { return formula_errors_.test(static_cast<std::size_t>(formula_error)); }

  ReadChange change_read;  ///< changes what the constructor has read
  LegChange change_leg;    ///< runs after the displacement
  LegChange change_rows;   ///< runs after the rows of (23)

 private:
  std::bitset<static_cast<std::size_t>(FormulaError::count)> formula_errors_;
};

}  // namespace ursula
