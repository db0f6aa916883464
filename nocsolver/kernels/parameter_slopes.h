#pragma once

// The efforts' derivatives by the machine's numbers. Internal; included as leg_slopes.h is. As by the state, at a given
// μ: dτ = dQ + G⁻¹ d(w − G μ) (state_slopes.h, (b)); a leg's numbers have no effect but by that leg.

#include "nocsolver/kernels/equilibrium.h"
#include "nocsolver/kernels/fixed_frame.h"
#include "nocsolver/kernels/platform_slopes.h"

namespace ursula::kernel {

/// Which of a leg's numbers are varied; eight at most at a time.
enum class LegPart { points, axis, proximal, distal, friction };

/// Gives numbers their tangents, one lane after the other.
template <class S>
class Seeds {
 public:
  void next(S& number) { number = tangent<S>(number.v, lane()); }
  void next(Vector3<S>& numbers) {
    for (int k = 0; k < 3; ++k) next(numbers(k));
  }
  /// xx, yy, zz, xy, xz, yz.
  void next(Matrix3<S>& I) {
    for (int k = 0; k < 3; ++k) next(I(k, k));
    for (const auto& at : {std::array<int, 2>{0, 1}, std::array<int, 2>{0, 2}, std::array<int, 2>{1, 2}}) {
      next(I(at[0], at[1]));
      I(at[1], at[0]) = I(at[0], at[1]);
    }
  }
  /// All 0 but for the next.
  const double* lane() {
    for (double& entry : lanes_) entry = 0;
    lanes_[next_++] = 1;
    return lanes_;
  }

 private:
  double lanes_[32];
  int next_ = 0;
};

template <class S>
void seedAxis(const LegNumbers& numbers, Seeds<S>& seeds, ChainModel<S>& leg) {
  Vector3<S> axis = three<S>(numbers.axis);
  seeds.next(axis);
  setFixedFrame<S>(axis, leg.x_hat, leg.u, leg.z_hat);
}

template <class S>
void seedFriction(Seeds<S>& seeds, ChainModel<S>& leg) {
  for (S& one : leg.viscous) seeds.next(one);
  for (S& one : leg.coulomb) seeds.next(one);
  for (const bool sliding : {false, true}) {
    const double* lane = seeds.lane();
    for (std::size_t j = 0; j < 3; ++j)
      if (slides(rowOf(leg.kind).coordinates[j]) == sliding) leg.speed[j] = tangent<S>(leg.speed[j].v, lane);
  }
}

template <class S>
PlaneModel<S> seededLeg(const LegNumbers& numbers, LegPart part, const double* g) {
  Seeds<S> seeds;
  ChainModel<S> leg = chainOf<S>(numbers);
  Vector3<S> gravity = three<S>(g);
  if (part == LegPart::points) seeds.next(leg.a), seeds.next(leg.b), seeds.next(leg.l), seeds.next(leg.s);
  if (part == LegPart::axis) seedAxis(numbers, seeds, leg), seeds.next(gravity);
  if (part == LegPart::proximal) seeds.next(leg.mass_1), seeds.next(leg.rho), seeds.next(leg.I_1);
  if (part == LegPart::distal) seeds.next(leg.mass_2), seeds.next(leg.sigma), seeds.next(leg.I_2);
  if (part == LegPart::friction) seedFriction(seeds, leg);
  PlaneModel<S> out = planeModel<S>(leg, gravity);
  out.rubs = numbers.rubs || part == LegPart::friction;
  out.rubs_dry = numbers.rubs_dry || part == LegPart::friction;
  out.principal = false;
  return out;
}

/// Derivatives of w − G μ and of Q by eight numbers.
template <class Isa>
struct EightSlopes {
  Tangents<Isa, 8> residual[6], Q[3];
};

template <class Isa, class Kind>
__attribute__((flatten, noinline)) void legByParameters(Kind kind, const MachineNumbers& machine, int i, LegPart part,
                                                        const double* motion_numbers, const double* mu,
                                                        EightSlopes<Isa>& out) {
  using S = Dual<Isa, 8>;
  const LegNumbers& numbers = machine.legs[static_cast<std::size_t>(i)];
  const PlaneModel<S> model = seededLeg<S>(numbers, part, machine.gravity);
  Motion<S> motion;
  setMotion(motion_numbers, motion);
  const Carried<S> carried(motion);
  const Vector3<S> Qb = motion.Q * model.b, AB = motion.p - model.a + Qb;
  RefusalGuard<S> guard(i);
  PlaneLeg<S> plane;
  const Vector3<S> Q = legLoads<S>(kind, model, AB, carried.velocity(Qb), carried.acceleration(Qb), guard, plane);
  const Vector3<S> f = forceAtB<S>(model.motor, shareOf<S>(model, plane, Q), mu);
  const Vector3<S> moment = Qb.cross(f);
  for (int k = 0; k < 3; ++k) {
    out.residual[k] = moment(k).d;
    out.residual[3 + k] = f(k).d;
    out.Q[k] = Q(k).d;
  }
}

/// The platform's own wrench by mass, ρ, I and gravity.
template <class Isa>
__attribute__((flatten, noinline)) Vector6<Dual<Isa, platform_parameter_count>> platformByParameters(
    const MachineNumbers& numbers, const double* motion_numbers) {
  using S = Dual<Isa, platform_parameter_count>;
  MachineModel<S> machine;
  setPlatform(numbers, machine);
  Seeds<S> seeds;
  seeds.next(machine.mass);
  seeds.next(machine.rho);
  seeds.next(machine.I_M);
  seeds.next(machine.gravity);
  Motion<S> motion;
  setMotion(motion_numbers, motion);
  return platformLoad<S>(machine, motion, Carried<S>(motion));
}

template <class Isa>
class AllParameterSlopes {
 public:
  AllParameterSlopes(const MachineNumbers& at, const StateNumbers& state, const Equilibrium<Isa>& equilibrium,
                     ParameterSlopes& out)
      : at_(at), state_(state), equilibrium_(equilibrium), out_(out) {
    for (int m = 0; m < motor_count; ++m) mu_[m] = equilibrium.mu(m);
  }

  void run() {
    const auto own = platformByParameters<Isa>(at_, state_.motion);
    double by[6][32];
    for (int row = 0; row < 6; ++row) own(row).d.store(by[row]);
    for (int k = 0; k < platform_parameter_count; ++k)
      for (int m = 0; m < motor_count; ++m) {
        double sum = 0;
        for (int row = 0; row < 6; ++row) sum += equilibrium_.inverse(m, row) * by[row][k];
        out_.platform[k][m] = sum;
      }
    for (int i = 0; i < at_.legs_in_all; ++i) {
      int first = 0;
      for (const LegPart part :
           {LegPart::points, LegPart::axis, LegPart::proximal, LegPart::distal, LegPart::friction}) {
        const int count = part == LegPart::axis ? 6 : 8;
        add(i, part, first, count);
        first += count;
      }
    }
  }

 private:
  void add(int i, LegPart part, int first, int count) {
    const LegNumbers& leg = at_.legs[static_cast<std::size_t>(i)];
    EightSlopes<Isa> slopes;
    withKind(leg.kind, [&](auto kind) { legByParameters<Isa>(kind, at_, i, part, state_.motion, mu_, slopes); });
    for (int m = 0; m < motor_count; ++m) {
      Tangents<Isa, 8> sum = Tangents<Isa, 8>::all(0);
      for (int row = 0; row < 6; ++row) sum = sum + equilibrium_.inverse(m, row) * slopes.residual[row];
      for (std::size_t j = 0; j < 3; ++j)
        if (leg.motor[j] == m) sum = sum + slopes.Q[j];
      double by[8];
      sum.store(by);
      for (int k = 0; k < count; ++k) out_.legs[i][first + k][m] = by[k];
    }
  }

  const MachineNumbers& at_;
  const StateNumbers& state_;
  const Equilibrium<Isa>& equilibrium_;
  ParameterSlopes& out_;
  double mu_[motor_count];
};

}  // namespace ursula::kernel
