#pragma once

// Efforts with their derivatives by the state. Internal; included as leg_slopes.h is.
//
// With w the wrench at P that the platform and the legs' forces f need, at a given μ (leg_slopes.h, (a)),
//   τ = Q + μ,  G μ = w:  dτ = dQ + G⁻¹ d(w − G μ),  w − G μ = platform − load + Σ [Qb × f; f]     (b)
// The leg's kernels carry tangents by AB and v_B, in B; by a_B loads are linear, with the leg's mass matrix M and map
// K:
//   ∂Q/∂a_B = M K                                                                                  (c)
// From there to the state, with e = δ × Qb:
//   dAB = e + dp,  dv_B = ω × e + dω × Qb + dṗ,
//   da_B = W e + d(ω × (ω × Qb)) + dω̇ × Qb + dp̈,  W = [ω̇]× + [ω]×²                                (d)

#include "nocsolver/kernels/equilibrium.h"
#include "nocsolver/kernels/platform_slopes.h"

namespace ursula::kernel {

/// Derivatives by an angular three and a linear three, four lanes each.
template <class Isa>
using Pair = Tangents<Isa, 8>;

/// By [δ, p], [ω, ṗ], [ω̇, p̈].
template <class Isa>
using StateRow = std::array<Pair<Isa>, 3>;

/// (d): rows of what AB, v_B and a_B change by. `same` is that of AB by the pose, of v_B by the twist, of a_B by its
/// rate.
template <class Isa>
struct TipByState {
  std::array<Pair<Isa>, 3> same, v_by_pose, a_by_pose, a_by_twist;
};

template <class Isa>
TipByState<Isa> tipByState(const Carried<Value<Isa>>& carried, const Vector3<Value<Isa>>& Qb) {
  const double b[3] = {Qb.x().v, Qb.y().v, Qb.z().v};
  const auto& omega = carried.motion.omega;
  const double w[3] = {omega.x().v, omega.y().v, omega.z().v};
  const double along = w[0] * b[0] + w[1] * b[1] + w[2] * b[2];
  TipByState<Isa> out;
  for (int r = 0; r < 3; ++r) {
    double same[8] = {}, v[8] = {}, a[8] = {}, twist[8] = {};
    turnOf<Isa>(b, r, same);
    same[4 + r] = 1;
    const auto W = [&](int c) { return carried.W(r, c).v; };
    for (int c = 0; c < 3; ++c) {
      const double on = r == c ? along : 0;
      v[c] = on - b[r] * w[c];
      twist[c] = on + w[r] * b[c] - 2 * b[r] * w[c];
      a[c] = W((c + 2) % 3) * b[(c + 1) % 3] - W((c + 1) % 3) * b[(c + 2) % 3];
    }
    const auto at = static_cast<std::size_t>(r);
    out.same[at] = Pair<Isa>::load(same);
    out.v_by_pose[at] = Pair<Isa>::load(v);
    out.a_by_pose[at] = Pair<Isa>::load(a);
    out.a_by_twist[at] = Pair<Isa>::load(twist);
  }
  return out;
}

/// A number's derivatives by AB and v_B, lanes 0 to 5, and by a_B, brought to the state.
template <class Isa>
StateRow<Isa> rowByState(const TipByState<Isa>& tip, const Tangents<Isa, 6>& by_tip,
                         const Vector3<Value<Isa>>& by_acceleration) {
  double by[Tangents<Isa, 6>::lanes];
  by_tip.store(by);
  StateRow<Isa> out;
  for (std::size_t c = 0; c < 3; ++c) {
    const double k = by[c], v = by[3 + c], a = by_acceleration(static_cast<Eigen::Index>(c)).v;
    const StateRow<Isa> add = {k * tip.same[c] + (v * tip.v_by_pose[c] + a * tip.a_by_pose[c]),
                               v * tip.same[c] + a * tip.a_by_twist[c], a * tip.same[c]};
    for (std::size_t part = 0; part < 3; ++part) out[part] = c == 0 ? add[part] : out[part] + add[part];
  }
  return out;
}

/// A leg as byState keeps it until μ is known.
template <class Isa>
struct LegByState {
  Vector3<Value<Isa>> Qb;
  LegShare<Dual<Isa, 6>> share;
  Matrix3<Value<Isa>> Q_by_a, force_by_a;  ///< of share.Q, share.force, by a_B
};

template <class Isa>
PlaneLeg<Value<Isa>> valuesOf(const PlaneLeg<Dual<Isa, 6>>& from) {
  PlaneLeg<Value<Isa>> to;
  const auto copy = [](const Dual<Isa, 6>& number, Value<Isa>& value) { value.v = number.v; };
  copy(from.cosine, to.cosine), copy(from.sine, to.sine);
  copy(from.C_1, to.C_1), copy(from.S_1, to.S_1), copy(from.C_2, to.C_2), copy(from.S_2, to.S_2), copy(from.d, to.d);
  for (std::size_t j = 0; j < 3; ++j)
    for (Eigen::Index k = 0; k < 3; ++k) copy(from.k[j](k), to.k[j](k));
  return to;
}

/// (c)
template <class Isa, class Kind>
void setByAcceleration(Kind kind, const PlaneModel<Value<Isa>>& model, const PlaneLeg<Dual<Isa, 6>>& moving,
                       LegByState<Isa>& out) {
  const PlaneLeg<Value<Isa>> plane = valuesOf<Isa>(moving);
  const PlaneAxes<Value<Isa>> axes = planeAxes<Value<Isa>>(model, plane);
  Matrix3<Value<Isa>> K;
  for (std::size_t j = 0; j < 3; ++j) K.row(static_cast<Eigen::Index>(j)) = axes.toBase(plane.k[j]).transpose();
  out.Q_by_a = massMatrix(kind, model, plane) * K;
  out.force_by_a.setZero();
  for (std::size_t j = 0; j < 3; ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    if (model.motor[j] < 0) out.force_by_a += K.row(at).transpose() * out.Q_by_a.row(at);
  }
}

/// A function of its own: in one with the others it takes minutes to compile.
template <class Isa, class Kind>
__attribute__((flatten, noinline)) Refusal legByState(Kind kind, const MachineNumbers& machine, int i,
                                                      const Carried<Value<Isa>>& carried, LegByState<Isa>& out) {
  using V = Value<Isa>;
  using S = Dual<Isa, 6>;
  const LegNumbers& numbers = machine.legs[static_cast<std::size_t>(i)];
  const PlaneModel<V> values = modelOf<V>(numbers, three<V>(machine.gravity));
  out.Qb = carried.motion.Q * values.b;
  const Vector3<V> AB = carried.motion.p - values.a + out.Qb, v = carried.velocity(out.Qb);
  const Vector3<V> a = carried.acceleration(out.Qb);
  Vector3<S> AB_S, v_S, a_S;
  for (int k = 0; k < 3; ++k) {
    double by_AB[8] = {}, by_v[8] = {};
    by_AB[k] = by_v[3 + k] = 1;
    AB_S(k) = tangent<S>(AB(k).v, by_AB);
    v_S(k) = tangent<S>(v(k).v, by_v);
    a_S(k) = S(a(k).v);
  }
  RefusalGuard<S> guard(i);
  PlaneLeg<S> plane;
  const PlaneModel<S> model = modelOf<S>(numbers, three<S>(machine.gravity));
  const Vector3<S> Q = legLoads<S>(kind, model, AB_S, v_S, a_S, guard, plane);
  out.share = shareOf<S>(model, plane, Q);
  setByAcceleration<Isa>(kind, values, plane, out);
  return guard.refusal();
}

}  // namespace ursula::kernel
