#pragma once

// A batch, block by block, for one instruction set. Internal; included by sources that are compiled for that set. What
// they share with others are plain numbers: no function of doubles may be made here, or the linker might take it for
// all.

#include <cstdint>

#include "nocsolver/kernels/batch_functions.h"
#include "nocsolver/kernels/machine_fields.h"
#include "nocsolver/kernels/pack.h"
#include "nocsolver/kernels/plane_dynamics.h"

namespace ursula::kernel {

/// In every lane in which |a[row][k]| is the largest, that row comes to row k.
template <class Isa>
void pivot(System6<Pack<Isa>>& system, int k) {
#pragma GCC unroll 6
  for (int row = k + 1; row < 6; ++row) {
    const auto larger = abs(system.a[row][k]) > abs(system.a[k][k]);
#pragma GCC unroll 7
    for (int column = k; column < 7; ++column) {
      const Pack<Isa> x = system.a[k][column], y = system.a[row][column];
      system.a[k][column] = select(larger, y, x);
      system.a[row][column] = select(larger, x, y);
    }
  }
}

/// The first fault of each lane, as its number.
template <class Isa>
class BatchGuard {
 public:
  using P = Pack<Isa>;
  using Mask = typename P::Mask;

  void reach(const P& inside, const P&, const P&) { require(inside >= P(0.0), 1); }
  void stroke(const P& d, const P& least, const P& most) { require((d > least) & (d < most), 2); }
  void offAxis(const P& r, const P& size) { require(r > root_eps * size, 3); }
  void regular(const P& sine, const char*) { require(abs(sine) > P(root_eps), 4); }
  void regularB(const P& pivots) { require(pivots > P(16 * root_eps * root_eps), 5); }
  const P& faults() const { return faults_; }

 private:
  static constexpr double root_eps = 0x1p-26;
  void require(const Mask& holds, double fault) { faults_ = select(holds | (faults_ > P(0.0)), faults_, P(fault)); }
  P faults_ = P(0.0);
};

/// Where one number of each pose is, `stride` doubles apart.
template <class Isa>
Pack<Isa> gathered(const double* first, std::size_t stride, int lanes) {
  alignas(64) double values[Pack<Isa>::lanes];
  for (int lane = 0; lane < Pack<Isa>::lanes; ++lane)
    values[lane] = first[stride * static_cast<std::size_t>(lane < lanes ? lane : lanes - 1)];
  return Pack<Isa>(Pack<Isa>::Batch::load_aligned(values));
}

template <class Isa>
void scatter(const Pack<Isa>& value, double* first, std::size_t stride, int lanes) {
  alignas(64) double values[Pack<Isa>::lanes];
  value.v.store_aligned(values);
  for (int lane = 0; lane < lanes; ++lane) first[stride * static_cast<std::size_t>(lane)] = values[lane];
}

/// The numbers of Motion<double> from t on, and of a six-vector.
constexpr std::size_t motion_stride = 25, vector_stride = 6;

template <class Isa>
Motion<Pack<Isa>> motionsAt(const double* from, int lanes) {
  Motion<Pack<Isa>> out;
  const double* next = from + 1;  // the instant is of no interest
  const auto read = [&](auto& matrix) {
    for (Eigen::Index k = 0; k < matrix.size(); ++k) matrix.data()[k] = gathered<Isa>(next++, motion_stride, lanes);
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
Vector6<Pack<Isa>> vectorsAt(const double* from, int lanes) {
  Vector6<Pack<Isa>> out;
  for (int k = 0; k < 6; ++k) out(k) = from != nullptr ? gathered<Isa>(from + k, vector_stride, lanes) : Pack<Isa>(0.0);
  return out;
}

template <class Isa>
void put(const Vector6<Pack<Isa>>& values, const Pack<Isa>& faults, double* out, std::uint8_t* flags, int lanes) {
  const Pack<Isa> none(0.0), nan = none / none;
  for (int k = 0; k < 6; ++k) scatter<Isa>(select(faults > none, nan, values(k)), out + k, vector_stride, lanes);
  double numbers[Pack<Isa>::lanes];
  scatter<Isa>(faults, numbers, 1, lanes);
  for (int lane = 0; lane < lanes; ++lane) flags[lane] = static_cast<std::uint8_t>(numbers[lane]);
}

template <class Isa>
__attribute__((flatten)) void inverseBlock(const MachineModel<Pack<Isa>>& machine, const double* motions,
                                           const double* loads, int lanes, double* out, std::uint8_t* flags) {
  using P = Pack<Isa>;
  BatchGuard<Isa> guard;
  P pivots;
  const auto guardOf = [&guard](int) -> BatchGuard<Isa>& { return guard; };
  const Vector6<P> efforts =
      inverseDynamics<P>(machine, motionsAt<Isa>(motions, lanes), vectorsAt<Isa>(loads, lanes), guardOf, pivots);
  guard.regularB(pivots);
  put<Isa>(efforts, guard.faults(), out, flags, lanes);
}

template <class Isa>
__attribute__((flatten)) void directBlock(const MachineModel<Pack<Isa>>& machine, const double* motions,
                                          const double* efforts, const double* loads, int lanes, double* out,
                                          std::uint8_t* flags) {
  using P = Pack<Isa>;
  BatchGuard<Isa> guard;
  const auto guardOf = [&guard](int) -> BatchGuard<Isa>& { return guard; };
  Motion<P> motion = motionsAt<Isa>(motions, lanes);
  motion.omega_dot.setZero();
  motion.p_ddot.setZero();
  const Vector6<P> rates =
      directDynamics<P>(machine, motion, vectorsAt<Isa>(efforts, lanes), vectorsAt<Isa>(loads, lanes), guardOf);
  put<Isa>(rates, guard.faults(), out, flags, lanes);
}

/// The machine in every lane.
template <class Isa>
struct BatchMachine {
  MachineModel<Pack<Isa>> model;

  static void* make(const double* numbers, const MachineShape& shape) {
    auto* out = new BatchMachine;
    copyShape(shape, out->model);
    forEachNumber(out->model, [&numbers](Pack<Isa>& number) { number = Pack<Isa>(*numbers++); });
    return out;
  }
  static void destroy(void* machine) { delete static_cast<BatchMachine*>(machine); }

  static void inverse(const void* machine, const BatchSpans& spans) {
    each(spans, [&](std::size_t at, int lanes) {
      inverseBlock<Isa>(of(machine), spans.motions + motion_stride * at, from(spans.loads, at), lanes,
                        spans.out + vector_stride * at, spans.faults + at);
    });
  }
  static void direct(const void* machine, const BatchSpans& spans) {
    each(spans, [&](std::size_t at, int lanes) {
      directBlock<Isa>(of(machine), spans.motions + motion_stride * at, spans.efforts + vector_stride * at,
                       from(spans.loads, at), lanes, spans.out + vector_stride * at, spans.faults + at);
    });
  }

 private:
  static const MachineModel<Pack<Isa>>& of(const void* machine) {
    return static_cast<const BatchMachine*>(machine)->model;
  }
  static const double* from(const double* vectors, std::size_t at) {
    return vectors != nullptr ? vectors + vector_stride * at : nullptr;
  }
  template <class F>
  static void each(const BatchSpans& spans, const F& block) {
    constexpr auto lanes = static_cast<std::size_t>(Pack<Isa>::lanes);
    for (std::size_t at = 0; at < spans.count; at += lanes)
      block(at, static_cast<int>(spans.count - at < lanes ? spans.count - at : lanes));
  }
};

template <class Isa>
constexpr BatchFunctions batchFunctions() {
  using M = BatchMachine<Isa>;
  return {&M::make, &M::destroy, &M::inverse, &M::direct};
}

}  // namespace ursula::kernel
