#pragma once

// Bodies of slope_functions.h for one instruction set. Internal; included by the sources that are compiled for it.

#include "nocsolver/kernels/parameter_slopes.h"
#include "nocsolver/kernels/state_slopes.h"

namespace ursula::kernel {

template <class Isa>
class StateSlopes {
 public:
  StateSlopes(const MachineNumbers& machine, const StateNumbers& state)
      : machine_(machine),
        state_(state),
        motion_(motionOf(state.motion)),
        carried_(motion_),
        equilibrium_(machine.length) {}

  /// μ, and what the slopes need.
  Refusal solve() {
    for (int i = 0; i < machine_.legs_in_all; ++i) {
      const Refusal refusal = withKind(machine_.legs[static_cast<std::size_t>(i)].kind, [&](auto kind) {
        return legByState<Isa>(kind, machine_, i, carried_, legs_[i]);
      });
      if (refusal.kind != PoseFault::none) return refusal;
    }
    Vector6<Value<Isa>> wrench = platform();
    for (int i = 0; i < machine_.legs_in_all; ++i) addLeg(i, legs_[i], wrench);
    equilibrium_.setWrench(wrench);
    const double pivots = equilibrium_.solve();
    if (!(pivots > least_pivots)) return {PoseFault::singular_jacobian, -1, pivots, 0, nullptr};
    for (int m = 0; m < motor_count; ++m) mu_[m] = equilibrium_.mu(m);
    return {};
  }

  void put(double* efforts, double* derivatives) {
    for (int i = 0; i < machine_.legs_in_all; ++i) addSlopes(i, legs_[i], tipByState<Isa>(carried_, legs_[i].Qb));
    for (int m = 0; m < motor_count; ++m) {
      efforts[m] = Q_[m] + mu_[m];
      putRow(m, derivatives);
    }
  }

  const Equilibrium<Isa>& equilibrium() const { return equilibrium_; }

 private:
  static Motion<Value<Isa>> motionOf(const double* numbers) {
    Motion<Value<Isa>> out;
    setMotion(numbers, out);
    return out;
  }

  /// The platform's wrench less the load; its tangents are the first of all.
  Vector6<Value<Isa>> platform() {
    const Vector6<Dual<Isa, 16>> own = platformByState<Isa>(machine_, state_.motion);
    Vector6<Value<Isa>> out;
    for (int row = 0; row < 6; ++row) {
      out(row) = own(row).v - state_.load[row];
      double by[16], parts[3][8] = {};
      own(row).d.store(by);
      for (int k = 0; k < 3; ++k) {
        parts[0][k] = by[k] - state_.load_by_turn[row + 6 * k];
        parts[1][k] = by[4 + k];
        parts[2][k] = by[8 + k];
        parts[2][4 + k] = by[12 + k];
      }
      for (std::size_t part = 0; part < 3; ++part) residual_[row][part] = Pair<Isa>::load(parts[part]);
    }
    return out;
  }

  void addLeg(int i, const LegByState<Isa>& leg, Vector6<Value<Isa>>& wrench) {
    using V = Value<Isa>;
    const auto values = [](const Vector3<Dual<Isa, 6>>& from) { return Vector3<V>(from(0).v, from(1).v, from(2).v); };
    const auto& motor = machine_.legs[static_cast<std::size_t>(i)].motor;
    for (std::size_t j = 0; j < 3; ++j) {
      if (motor[j] < 0) continue;
      equilibrium_.setRow(motor[j], leg.Qb, values(leg.share.row[j]));
      Q_[motor[j]] = leg.share.Q(static_cast<Eigen::Index>(j)).v;
    }
    addForceAt<V>(leg.Qb, values(leg.share.force), wrench);
  }

  /// A leg's part of d(w − G μ) and dQ in (b).
  void addSlopes(int i, const LegByState<Isa>& leg, const TipByState<Isa>& tip) {
    const auto& motor = machine_.legs[static_cast<std::size_t>(i)].motor;
    const Vector3<Dual<Isa, 6>> f = forceAtB<Dual<Isa, 6>>(motor, leg.share, mu_);
    StateRow<Isa> force[3];
    for (int r = 0; r < 3; ++r) force[r] = rowByState<Isa>(tip, f(r).d, leg.force_by_a.row(r).transpose());
    for (std::size_t j = 0; j < 3; ++j) {
      const auto at = static_cast<Eigen::Index>(j);
      if (motor[j] >= 0) dQ_[motor[j]] = rowByState<Isa>(tip, leg.share.Q(at).d, leg.Q_by_a.row(at).transpose());
    }
    const double b[3] = {leg.Qb.x().v, leg.Qb.y().v, leg.Qb.z().v};
    for (std::size_t part = 0; part < 3; ++part)
      for (int r = 0; r < 3; ++r) {
        const int y = (r + 1) % 3, z = (r + 2) % 3;
        residual_[3 + r][part] = residual_[3 + r][part] + force[r][part];
        residual_[r][part] = residual_[r][part] + (b[y] * force[z][part] - b[z] * force[y][part]);
      }
    addTurn(b, f);
  }

  /// (δ × Qb) × f = Qb (f · δ) − δ (Qb · f)
  void addTurn(const double* b, const Vector3<Dual<Isa, 6>>& f) {
    const double along = b[0] * f.x().v + b[1] * f.y().v + b[2] * f.z().v;
    for (int r = 0; r < 3; ++r) {
      double by[8] = {b[r] * f.x().v, b[r] * f.y().v, b[r] * f.z().v};
      by[r] -= along;
      residual_[r][0] = residual_[r][0] + Pair<Isa>::load(by);
    }
  }

  /// (b) for one motor.
  void putRow(int m, double* derivatives) {
    for (std::size_t part = 0; part < 3; ++part) {
      Pair<Isa> sum = dQ_[m][part];
      for (int row = 0; row < 6; ++row) sum = sum + equilibrium_.inverse(m, row) * residual_[row][part];
      double by[8];
      sum.store(by);
      double* to = derivatives + 36 * part + m;
      for (int k = 0; k < 3; ++k) {
        to[6 * k] = by[k];
        to[18 + 6 * k] = by[4 + k];
      }
    }
  }

  const MachineNumbers& machine_;
  const StateNumbers& state_;
  Motion<Value<Isa>> motion_;
  Carried<Value<Isa>> carried_;
  Equilibrium<Isa> equilibrium_;
  LegByState<Isa> legs_[leg_count];
  double mu_[motor_count], Q_[motor_count];
  StateRow<Isa> residual_[6], dQ_[motor_count];
};

template <class Isa>
__attribute__((flatten)) Refusal byState(const MachineNumbers& machine, const StateNumbers& state, double* efforts,
                                         double* derivatives) {
  StateSlopes<Isa> slopes(machine, state);
  const Refusal refusal = slopes.solve();
  if (refusal.kind == PoseFault::none) slopes.put(efforts, derivatives);
  return refusal;
}

template <class Isa>
__attribute__((flatten)) Refusal byParameters(const MachineNumbers& machine, const MachineNumbers& at,
                                              const StateNumbers& state, ParameterSlopes& out) {
  StateSlopes<Isa> slopes(machine, state);
  const Refusal refusal = slopes.solve();
  if (refusal.kind == PoseFault::none) AllParameterSlopes<Isa>(at, state, slopes.equilibrium(), out).run();
  return refusal;
}

template <class Isa>
constexpr SlopeFunctions slopeFunctions() {
  return {&byState<Isa>, &byParameters<Isa>};
}

}  // namespace ursula::kernel
