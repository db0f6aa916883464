// (32), (33), (36), (37), (45), (47), (48): the equations of motion by the natural orthogonal complement, compared with
// torques and T by virtual work.

#include <Eigen/Geometry>
#include <memory>

#include "nocsolver/noc/noc.h"
#include "studies/audit/formula.h"

namespace ursula::audit {
namespace {

/// The solver's T and Ṫ at a reference state.
class Shaping {
 public:
  explicit Shaping(const Manipulator& manipulator) : solver_(manipulator) {}

  TwistShaping<S> T(const ReferenceState& at) const {
    NocWorkspace<S> work;
    solver_.inverseKinematics(at.motion, work);
    solver_.jacobians(at.motion, work);
    solver_.twistShaping(at.motion, work);
    return work.T;
  }
  TwistShaping<S> TRate(const ReferenceState& at) const {
    NocWorkspace<S> work;
    solver_.inverseKinematics(at.motion, work);
    solver_.jacobians(at.motion, work);
    solver_.twistShapingRate(at.motion, work);
    return work.T_rate;
  }
  Vector6<S> torques(const ReferenceState& at) const {
    NocWorkspace<S> work;
    return solver_.inverseDynamics(at.motion, work);
  }
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> D(const ReferenceState& at) const {
    NocWorkspace<S> work;
    solver_.inverseDynamics(at.motion, work);
    return solver_.D(at.motion, work);
  }
  /// The remainder of (31) under the torques of virtual work.
  BodyVector<S> constraintWrench(const ReferenceState& at) const {
    NocWorkspace<S> work;
    solver_.inverseDynamics(at.motion, work);
    return solver_.constraintWrench(at.motion, at.torques, work);
  }

 private:
  Noc<S> solver_;
};

/// Tᵀ (M x + W M y) over all bodies, for twist-like x and y.
Vector6<S> projected(const ReferenceState& at, const TwistShaping<S>& T, const Eigen::Matrix<S, 6 * body_count, 1>& x,
                     const Eigen::Matrix<S, 6 * body_count, 1>& y) {
  Vector6<S> sum = Vector6<S>::Zero();
  for (int k = 0; k < body_count; ++k) {
    const ReferenceBody& body = at.bodies[static_cast<std::size_t>(k)];
    const V x_omega = x.segment<3>(6 * k), x_v = x.segment<3>(6 * k + 3), y_omega = y.segment<3>(6 * k);
    sum += T.middleRows<6>(6 * k).transpose() *
           stack(body.I * x_omega + body.omega.cross(V(body.I * y_omega)), body.mass * x_v);
  }
  return sum;
}

Formula shapedTwist(const std::shared_ptr<const Shaping>& shaping) {
  Formula f;
  f.equation = "(32a), (48)";
  f.printed = "t = T φ̇, columns of T by unit rates";
  f.as_printed = [shaping](const ReferenceState& at) { return values(shaping->T(at)); };
  f.truth = [](const ReferenceState& at) { return values(at.T); };
  f.note = "Every entry of the 78 × 6 matrix against ∂(positions)/∂φ.";
  return f;
}

Formula shapedTwistRate(const std::shared_ptr<const Shaping>& shaping) {
  Formula f;
  f.equation = "(32b)";
  f.printed = "ṫ = T φ̈ + Ṫ φ̇";
  f.unit = "rad/s², m/s²";
  f.as_printed = [shaping](const ReferenceState& at) {
    const Eigen::Matrix<S, 6 * body_count, 1> rate = shaping->T(at) * at.phi_ddot() + shaping->TRate(at) * at.phi_dot();
    return values(rate);
  };
  f.truth = [](const ReferenceState& at) {
    Values all;
    for (const ReferenceBody& body : at.bodies) append(all, stack(body.omega_dot, body.c_ddot));
    return all;
  };
  return f;
}

Side zeros(std::size_t count) {
  return [count](const ReferenceState&) { return Values(count, S(0)); };
}

Formula complement(const std::shared_ptr<const Shaping>& shaping) {
  Formula f;
  f.equation = "(33)";
  f.printed = "D T = O";
  f.as_printed = [shaping](const ReferenceState& at) {
    return values(Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>(shaping->D(at) * at.T));
  };
  f.truth = zeros(72 * leg_count);
  f.note = "D of all 13 bodies, its 72 independent rows, with T by differences.";
  return f;
}

Formula constraintWrenches(const std::shared_ptr<const Shaping>& shaping) {
  Formula f;
  f.equation = "text by (33)";
  f.printed = "Tᵀw^N = 0";
  f.unit = "N m";
  f.as_printed = [shaping](const ReferenceState& at) {
    const BodyVector<S> w = shaping->constraintWrench(at);
    return values(Vector6<S>(at.T.transpose() * w));
  };
  f.truth = zeros(leg_count);
  f.note = "w^N left by (31) of every body, T by differences.";
  return f;
}

Formula directDynamics(const std::shared_ptr<const Shaping>& shaping) {
  Formula f;
  f.equation = "(36)";
  f.printed = "τ^a = I φ̈ + C φ̇ − τ^g − τ^d, I = TᵀMT, C = Tᵀ(MṪ + WMT)";
  f.unit = "N m";
  f.as_printed = [shaping](const ReferenceState& at) {
    const TwistShaping<S> T = shaping->T(at), T_dot = shaping->TRate(at);
    const Eigen::Matrix<S, 6 * body_count, 1> twist = T * at.phi_dot();
    const Eigen::Matrix<S, 6 * body_count, 1> rate = T * at.phi_ddot() + T_dot * at.phi_dot();
    return values(Vector6<S>(projected(at, T, rate, twist) - at.gravity_forces - at.friction_forces));
  };
  f.truth = [](const ReferenceState& at) { return values(at.torques); };
  return f;
}

Formula inverseDynamics(const std::shared_ptr<const Shaping>& shaping) {
  Formula f;
  f.equation = "(37)";
  f.printed = "τ^a = −Tᵀ(wⁿ + w^g + w^d)";
  f.unit = "N m";
  f.as_printed = [shaping](const ReferenceState& at) { return values(shaping->torques(at)); };
  f.truth = [](const ReferenceState& at) { return values(at.torques); };
  f.note = "With all that it needs, (1)–(48): the algorithm of Fig. 6 against virtual work.";
  return f;
}

Formula gravity(const std::shared_ptr<const Shaping>& shaping) {
  Formula f;
  f.equation = "(45)";
  f.printed = "τ^g = Tᵀw^g, w^g = [0; m g] of each body";
  f.unit = "N m";
  f.as_printed = [shaping](const ReferenceState& at) {
    const TwistShaping<S> T = shaping->T(at);
    Vector6<S> sum = Vector6<S>::Zero();
    for (int k = 0; k < body_count; ++k)
      sum += T.middleRows<3>(6 * k + 3).transpose() * V(at.bodies[static_cast<std::size_t>(k)].mass * at.gravity);
    return values(sum);
  };
  f.truth = [](const ReferenceState& at) { return values(at.gravity_forces); };
  return f;
}

Formula centerJacobian() {
  Formula f;
  f.equation = "(47)";
  f.printed = "B_C: rows (Q(b − ρ) × x)ᵀ, xᵀ";
  f.unit = "m/s";
  f.as_printed = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    const V arm = at.platform.Q * V(leg.b - at.platform.rho), x = leg.at.x();
    return values(S(arm.cross(x).dot(at.platform.omega) + x.dot(at.platform.c_dot)));
  });
  f.truth =
      overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(S(leg.at.a_ii() * leg.dot.phi())); });
  return f;
}

Formula centerJacobianText() {
  Formula f = centerJacobian();
  f.equation = "text by (47)";
  f.printed = "replace Qb by Qb − ρ";
  f.holds = "replace Qb by Q(b − ρ), as (47) itself";
  f.that_holds = f.as_printed;
  f.as_printed = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    const V arm = at.platform.Q * leg.b - at.platform.rho, x = leg.at.x();
    return values(S(arm.cross(x).dot(at.platform.omega) + x.dot(at.platform.c_dot)));
  });
  f.formula_errors = {FormulaError::eq47};
  return f;
}

}  // namespace

std::vector<Formula> complementFormulas(const Manipulator& manipulator) {
  const auto shaping = std::make_shared<const Shaping>(manipulator);
  return {shapedTwist(shaping),    shapedTwistRate(shaping), complement(shaping), constraintWrenches(shaping),
          directDynamics(shaping), inverseDynamics(shaping), gravity(shaping),    centerJacobian(),
          centerJacobianText()};
}

}  // namespace ursula::audit
