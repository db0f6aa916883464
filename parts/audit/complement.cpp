// (32), (33), (36), (37), (45), (47), (48): the equations of motion by the natural orthogonal complement, compared with
// torques and T by virtual work.

#include <Eigen/Geometry>
#include <memory>

#include "nocsolver/noc/noc.h"
#include "parts/audit/formula.h"

namespace ursula::audit {
namespace {

using Twist = Eigen::Matrix<S, 6 * body_count, 1>;

/// The solver's matrices and torques at a reference state.
class Shaping {
 public:
  explicit Shaping(const Manipulator& manipulator) : solver_(manipulator) {}

  TwistShaping<S> T(At at) const {
    NocWorkspace<S> work = withJacobians(at);
    solver_.twistShaping(at.motion, work);
    return work.T;
  }
  TwistShaping<S> TRate(At at) const {
    NocWorkspace<S> work = withJacobians(at);
    solver_.twistShapingRate(at.motion, work);
    return work.T_rate;
  }
  Vector6<S> torques(At at) const {
    NocWorkspace<S> work;
    return solver_.inverseDynamics(at.motion, work);
  }
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> D(At at) const {
    NocWorkspace<S> work;
    solver_.inverseDynamics(at.motion, work);
    return solver_.D(at.motion, work);
  }
  /// The remainder of (31) under the torques of virtual work.
  BodyVector<S> constraintWrench(At at) const {
    NocWorkspace<S> work;
    solver_.inverseDynamics(at.motion, work);
    return solver_.constraintWrench(at.motion, at.torques, work);
  }

 private:
  NocWorkspace<S> withJacobians(At at) const {
    NocWorkspace<S> work;
    solver_.inverseKinematics(at.motion, work);
    solver_.jacobians(at.motion, work);
    return work;
  }

  Noc<S> solver_;
};

/// Tᵀ (M x + W M y) over all bodies, for twist-like x and y.
Vector6<S> projected(At at, const TwistShaping<S>& T, const Twist& x, const Twist& y) {
  Vector6<S> sum = Vector6<S>::Zero();
  for (int k = 0; k < body_count; ++k) {
    const ReferenceBody& body = at.bodies[static_cast<std::size_t>(k)];
    const V x_omega = x.segment<3>(6 * k), x_v = x.segment<3>(6 * k + 3), y_omega = y.segment<3>(6 * k);
    sum += T.middleRows<6>(6 * k).transpose() *
           stack(body.I * x_omega + body.omega.cross(V(body.I * y_omega)), body.mass * x_v);
  }
  return sum;
}

/// τ^a of (36).
Vector6<S> torquesBy36(At at, const Shaping& shaping) {
  const TwistShaping<S> T = shaping.T(at), T_dot = shaping.TRate(at);
  const Twist twist = T * at.phi_dot(), rate = T * at.phi_ddot() + T_dot * at.phi_dot();
  return projected(at, T, rate, twist) - at.gravity_forces - at.friction_forces;
}

/// Tᵀw^g of (45).
Vector6<S> weights(At at, const TwistShaping<S>& T) {
  Vector6<S> sum = Vector6<S>::Zero();
  for (int k = 0; k < body_count; ++k)
    sum += T.middleRows<3>(6 * k + 3).transpose() * V(at.bodies[static_cast<std::size_t>(k)].mass * at.gravity);
  return sum;
}

Values twistRates(At at) {
  Values all;
  for (const ReferenceBody& body : at.bodies) append(all, stack(body.omega_dot, body.c_ddot));
  return all;
}

Side zeros(std::size_t count) {
  return [count](At) { return Values(count, S(0)); };
}

/// A row of B_C, for an arm from the platform's mass centre to B, times the twist there.
S acrossBy(At at, Of leg, const V& arm) {
  const V x = leg.at.x();
  return arm.cross(x).dot(at.platform.omega) + x.dot(at.platform.c_dot);
}

std::vector<Formula> centerJacobian() {
  const Side by_47 = legs([](At at, Of leg) { return acrossBy(at, leg, at.platform.Q * V(leg.b - at.platform.rho)); });
  const Side truth = legs([](Of leg) { return S(leg.at.a_ii() * leg.dot.phi()); });
  return {{"(47)", "m/s", {"B_C: rows (Q(b − ρ) × x)ᵀ, xᵀ", by_47}, {}, truth},
          {"text by (47)",
           "m/s",
           {"replace Qb by Qb − ρ",
            legs([](At at, Of leg) { return acrossBy(at, leg, at.platform.Q * leg.b - at.platform.rho); })},
           {"replace Qb by Q(b − ρ), as (47) itself", by_47},
           truth,
           "",
           {FormulaError::eq47}}};
}

}  // namespace

std::vector<Formula> complementFormulas(const Manipulator& manipulator) {
  const auto shaping = std::make_shared<const Shaping>(manipulator);
  const Side torques = [](At at) { return values(at.torques); };
  std::vector<Formula> all = {
      {"(32a), (48)",
       "",
       {"t = T φ̇, columns of T by unit rates", [shaping](At at) { return values(shaping->T(at)); }},
       {},
       [](At at) { return values(at.T); },
       "Every entry of the 78 × 6 matrix against ∂(positions)/∂φ."},
      {"(32b)",
       "rad/s², m/s²",
       {"ṫ = T φ̈ + Ṫ φ̇",
        [shaping](At at) { return values(Twist(shaping->T(at) * at.phi_ddot() + shaping->TRate(at) * at.phi_dot())); }},
       {},
       twistRates},
      {"(33)",
       "",
       {"D T = O",
        [shaping](At at) { return values(Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>(shaping->D(at) * at.T)); }},
       {},
       zeros(72 * leg_count),
       "D of all 13 bodies, its 72 independent rows, with T by differences."},
      {"text by (33)",
       "N m",
       {"Tᵀw^N = 0", [shaping](At at) { return values(Vector6<S>(at.T.transpose() * shaping->constraintWrench(at))); }},
       {},
       zeros(leg_count),
       "w^N left by (31) of every body, T by differences."},
      {"(36)",
       "N m",
       {"τ^a = I φ̈ + C φ̇ − τ^g − τ^d, I = TᵀMT, C = Tᵀ(MṪ + WMT)",
        [shaping](At at) { return values(torquesBy36(at, *shaping)); }},
       {},
       torques},
      {"(37)",
       "N m",
       {"τ^a = −Tᵀ(wⁿ + w^g + w^d)", [shaping](At at) { return values(shaping->torques(at)); }},
       {},
       torques,
       "With all that it needs, (1)–(48): the algorithm of Fig. 6 against virtual work."},
      {"(45)",
       "N m",
       {"τ^g = Tᵀw^g, w^g = [0; m g] of each body", [shaping](At at) { return values(weights(at, shaping->T(at))); }},
       {},
       [](At at) { return values(at.gravity_forces); }}};
  for (Formula& f : centerJacobian()) all.push_back(std::move(f));
  return all;
}

}  // namespace ursula::audit
