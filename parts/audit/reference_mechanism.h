#pragma once

// The audit's reference: the mechanism in 50 digits from vector geometry alone, with derivatives by differences. It
// uses no formula of the paper beyond the definitions of frames and angles (its Fig. 3).

#include <array>
#include <vector>

#include "base/real50.h"
#include "base/scalar.h"
#include "model/manipulator.h"
#include "model/trajectory.h"

namespace ursula::audit {

using S = Real50;
using V = Vector3<S>;
using M = Matrix3<S>;

/// crossMatrix() returns the cross-product matrix of v; vect() is its inverse.
M crossMatrix(const V& v);
V vect(const M& matrix);

/// The position-level quantities of one leg in one vector, which can be differenced at once.
class LegPose {
 public:
  using Vector = Eigen::Matrix<S, 56, 1>;

  const S& phi() const { return v[0]; }
  const S& psi() const { return v[1]; }
  const S& theta() const { return v[2]; }
  const S& q() const { return v[3]; }                     ///< ‖AB‖
  const S& a_ii() const { return v[4]; }                  ///< the negative distance of B from the actuated axis
  V AB() const { return v.segment<3>(5); }                ///< in B
  V AB_i() const { return v.segment<3>(8); }              ///< in F
  V c() const { return v.segment<3>(11); }                ///< mass centre of the proximal link
  V d() const { return v.segment<3>(14); }                ///< mass centre of the distal link
  V e_i() const { return v.segment<3>(17); }              ///< unit vector along AR, in F
  V s_i() const { return v.segment<3>(20); }              ///< unit vector along RB, in F
  M F() const { return matrix(23); }                      ///< axes of Fᵢ in B
  M G() const { return matrix(32); }                      ///< frame of the proximal link
  M H() const { return matrix(41); }                      ///< frame of the distal link
  Vector6<S> rowOfB() const { return v.segment<6>(50); }  ///< [Qb × x; x]
  V x() const { return v.segment<3>(23); }

  Vector v = Vector::Zero();

 private:
  M matrix(int start) const { return Eigen::Map<const M>(v.data() + start); }
};

/// One leg at one instant: its parameters, its pose, and the pose's first and second derivatives by differences.
struct ReferenceLeg {
  V a, b;
  S l, s, rho, sigma, m_proximal, m_distal;
  M I_proximal, I_distal;  ///< [I]_G, [I]_H
  M Q_hat;                 ///< axes of the fixed frame of (2)
  V u;
  LegPose at, dot, ddot;

  /// (1) for the reference angle, and ωᵢ, ω̇ᵢ of (12), (44) as matrices.
  M Q_i() const;
  M Omega_i() const { return crossMatrix(V(S(0), -dot.phi(), S(0))); }
  M Omega_i_dot() const { return crossMatrix(V(S(0), -ddot.phi(), S(0))); }
  /// h of (11b) as the velocity of B in the axes of F, and its derivative.
  V h() const { return at.F().transpose() * dot.AB(); }
  V h_dot() const { return dot.F().transpose() * dot.AB() + at.F().transpose() * ddot.AB(); }
};

/// The platform at one instant, with derivatives by differences of p and Q.
struct ReferencePlatform {
  V p, p_dot, p_ddot, c, c_dot, c_ddot;
  M Q, Q_dot, Q_ddot;
  V omega, omega_dot;
  V rho;
  Vector6<S> twist() const { return (Vector6<S>() << omega, p_dot).finished(); }
  Vector6<S> twistRate() const { return (Vector6<S>() << omega_dot, p_ddot).finished(); }
};

/// One body: its mass, inertia and motion, by differences.
struct ReferenceBody {
  S mass;
  M I, I_dot;  ///< about the mass centre, in B
  V omega, omega_dot, c_dot, c_ddot;
  /// d/dt [I ω; m ċ], by the product rule.
  Vector6<S> momentumRate() const;
};

/// The whole machine at one instant.
struct ReferenceState {
  S t;
  Motion<S> motion;  ///< the trajectory's own
  V gravity;
  ReferencePlatform platform;
  std::array<ReferenceLeg, leg_count> legs;
  std::array<ReferenceBody, body_count> bodies;
  /// By virtual work with differences of positions: T of (32a), and the generalised forces conjugate to φ̇.
  Eigen::Matrix<S, 6 * body_count, leg_count> T;
  Matrix6<S> T_P;      ///< of (24)
  Vector6<S> torques;  ///< of the actuators, without external load
  Vector6<S> gravity_forces, friction_forces;
  Vector6<S> phi_dot() const;
  Vector6<S> phi_ddot() const;
};

/// The machine along a trajectory. Throws std::domain_error if a leg cannot reach.
class ReferenceMechanism {
 public:
  ReferenceMechanism(const Manipulator& manipulator, const Trajectory& trajectory);
  ReferenceState at(const S& t) const;

  /// One leg for a pose of the platform.
  LegPose legPose(int i, const V& p, const M& Q) const;

 private:
  ReferenceLeg legAt(int i, const S& t, const ReferencePlatform& platform) const;
  ReferencePlatform platformAt(const S& t) const;
  void addVirtualWork(ReferenceState& reference) const;

  const Manipulator& manipulator_;
  const Trajectory& trajectory_;
};

/// The value and the first two derivatives at 0 of a vector function, by central differences at ±h, ±h/2, ±h/4, ±h/8,
/// extrapolated to eighth order. The error is about h⁸/1e9, plus rounding of 1e-50/h and 1e-48/h².
template <class Vector>
struct Derivatives {
  Vector value, first, second;
};

template <class F>
auto differentiated(const F& f, const S& step) -> Derivatives<decltype(f(step))> {
  using Vector = decltype(f(step));
  constexpr std::size_t levels = 4;
  const Vector center = f(S(0));
  std::array<Vector, levels> first, second;
  S h = step;
  for (std::size_t k = 0; k < levels; ++k, h /= 2) {
    const Vector after = f(h), before = f(S(-h));
    first[k] = (after - before) / (2 * h);
    second[k] = (after - 2 * center + before) / (h * h);
  }
  S power(4);
  for (std::size_t m = 1; m < levels; ++m, power *= 4)
    for (std::size_t k = 0; k + m < levels; ++k) {
      first[k] = first[k + 1] + (first[k + 1] - first[k]) / (power - 1);
      second[k] = second[k + 1] + (second[k + 1] - second[k]) / (power - 1);
    }
  return {center, first[0], second[0]};
}

}  // namespace ursula::audit
