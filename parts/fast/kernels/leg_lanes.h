#pragma once

// One pose with one leg per lane. Internal; sources compiled for one instruction set include it, like batch_block.h.
//
// The six legs are of one kind and their motors drive the same coordinate. To the kernels of plane_dynamics.h they
// are one leg of packs, or two or three if a register holds fewer than six numbers. Every lane has the same platform
// motion.

#include "parts/fast/kernels/batch_functions.h"
#include "parts/fast/kernels/batch_guard.h"
#include "parts/fast/kernels/machine_fields.h"
#include "parts/fast/kernels/plane_dynamics.h"

namespace ursula::kernel {

/// A motion from its numbers in the order of memory, without the instant.
template <class Isa, class Next>
Motion<Pack<Isa>> motionOf(Next next) {
  Motion<Pack<Isa>> out;
  const auto read = [&next](auto& matrix) {
    for (Eigen::Index k = 0; k < matrix.size(); ++k) matrix.data()[k] = next();
  };
  read(out.p);
  read(out.Q);
  read(out.omega);
  read(out.p_dot);
  read(out.omega_dot);
  read(out.p_ddot);
  return out;
}

template <class Isa>
class LegLanes {
 public:
  using P = Pack<Isa>;

  /// Takes `numbers` and `shape` of six legs of one kind, each with one motor on the same coordinate.
  static void* make(const double* numbers, const MachineShape& shape) {
    auto* out = new LegLanes;
    MachineShape packed = shape;
    packed.legs = groups;
    for (int g = 0; g < groups; ++g)
      for (int& motor : packed.motors[g]) motor = motor < 0 ? -1 : g;
    copyShape(packed, out->machine_);
    MachineModel<P> platform;  // has no legs
    std::ptrdiff_t of_platform = 0, of_all = 0;
    forEachNumber(platform, [&](P&) { ++of_platform; });
    forEachNumber(out->machine_, [&](P&) { ++of_all; });
    const std::ptrdiff_t of_leg = (of_all - of_platform) / groups;
    std::ptrdiff_t k = 0;
    forEachNumber(out->machine_, [&](P& number) {
      alignas(64) double values[lanes];
      const std::ptrdiff_t group = (k - of_platform) / of_leg, on_leg = (k - of_platform) % of_leg;
      for (int lane = 0; lane < lanes; ++lane) {
        const std::ptrdiff_t leg = group * lanes + lane;
        values[lane] = k < of_platform ? numbers[k] : numbers[of_platform + (leg < 6 ? leg : 0) * of_leg + on_leg];
      }
      number = P(P::Batch::load_aligned(values));
      ++k;
    });
    return out;
  }
  static void destroy(void* legs) { delete static_cast<LegLanes*>(legs); }

  static bool inverse(const void* legs, const double* motion, LegSums& out) {
    return static_cast<const LegLanes*>(legs)->inverseLoads(motion, out);
  }
  static bool direct(const void* legs, const double* motion, const double* efforts, LegSums& out) {
    return static_cast<const LegLanes*>(legs)->directLoads(motion, efforts, out);
  }

 private:
  static constexpr int lanes = P::lanes, groups = (6 + lanes - 1) / lanes;

  static Motion<P> sameInAllLanes(const double* number) {
    return motionOf<Isa>([&number] { return P(*++number); });  // skips the instant
  }
  /// Sets the lanes from the n-th on to 0.
  static P upTo(int n, const P& value) {
    alignas(64) double keep[lanes];
    for (int lane = 0; lane < lanes; ++lane) keep[lane] = lane < n ? 1.0 : 0.0;
    return select(P(P::Batch::load_aligned(keep)) > P(0.0), value, P(0.0));
  }
  /// Adds the upper half of the lanes to the lower until one is left.
  static double sumOf(const P& value) {
    alignas(64) double sum[lanes];
    value.v.store_aligned(sum);
    for (int half = lanes / 2; half > 0; half /= 2)
      for (int lane = 0; lane < half; ++lane) sum[lane] += sum[lane + half];
    return sum[0];
  }

  __attribute__((flatten)) bool inverseLoads(const double* numbers, LegSums& out) const {
    const Motion<P> motion = sameInAllLanes(numbers);
    const RigidMotion<P> carried(motion);
    BatchGuard<Isa> guard;
    MovingLegs<P> legs;
    moveLegs<P>(
        machine_, motion, carried, [&guard](int) -> BatchGuard<Isa>& { return guard; }, legs);
    Vector6<P> wrench, Q, A;
    const Vector6<P> platform = platformLoad<P>(machine_, motion, carried);
    for (int r = 0; r < 6; ++r) wrench(r) = upTo(1, platform(r));
    System6<P> system;
    for (int g = 0; g < groups; ++g) {
      Vector6<P> share = Vector6<P>::Zero();
      addLeg<P>(machine_, g, legs[g], share, Q, A, system);
      for (int r = 0; r < 6; ++r) wrench(r) += upTo(6 - g * lanes, share(r));
      Q(g).v.store_unaligned(out.Q + g * lanes);
      A(g).v.store_unaligned(out.A + g * lanes);
      for (int r = 0; r < 6; ++r) system.a[r][g].v.store_unaligned(out.rows[r] + g * lanes);
    }
    for (int r = 0; r < 6; ++r) out.wrench[r] = sumOf(wrench(r));
    return !guard.anyFault();
  }

  __attribute__((flatten)) bool directLoads(const double* numbers, const double* efforts, LegSums& out) const {
    Motion<P> motion = sameInAllLanes(numbers);
    motion.omega_dot.setZero();
    motion.p_ddot.setZero();
    const RigidMotion<P> carried(motion);
    BatchGuard<Isa> guard;
    MovingLegs<P> legs;
    moveLegs<P>(
        machine_, motion, carried, [&guard](int) -> BatchGuard<Isa>& { return guard; }, legs);
    Vector6<P> wrench = Vector6<P>::Zero(), on_motors;
    Matrix6<P> M_P = Matrix6<P>::Zero();
    addPlatform<P>(machine_, motion, carried, wrench, M_P);
    for (int r = 0; r < 6; ++r) wrench(r) = upTo(1, wrench(r));
    for (int c = 0; c < 6; ++c)
      for (int r = c; r < 6; ++r) M_P(r, c) = upTo(1, M_P(r, c));
    for (int g = 0; g < groups; ++g) {
      alignas(64) double values[lanes];
      for (int lane = 0; lane < lanes; ++lane) values[lane] = g * lanes + lane < 6 ? efforts[g * lanes + lane] : 0.0;
      on_motors(g) = P(P::Batch::load_aligned(values));
      Vector6<P> share = Vector6<P>::Zero();
      Matrix6<P> mass = Matrix6<P>::Zero();
      addLegMass<P>(machine_, g, legs[g], on_motors, share, mass);
      for (int r = 0; r < 6; ++r) wrench(r) += upTo(6 - g * lanes, share(r));
      for (int c = 0; c < 6; ++c)
        for (int r = c; r < 6; ++r) M_P(r, c) += upTo(6 - g * lanes, mass(r, c));
    }
    for (int c = 0; c < 6; ++c) {
      out.wrench[c] = sumOf(wrench(c));
      for (int r = c; r < 6; ++r) out.rows[r][c] = sumOf(M_P(r, c));
    }
    return !guard.anyFault();
  }

  MachineModel<P> machine_;
};

}  // namespace ursula::kernel
