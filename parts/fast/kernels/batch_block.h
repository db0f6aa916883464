#pragma once

// Computes a batch block by block for one instruction set. Internal; sources compiled for that set include it. They
// share only plain numbers with other sources. No function of plain doubles may stand here, because the linker might
// use this set's copy in all sources.

#include <array>
#include <cstdint>

#include "parts/fast/kernels/leg_lanes.h"

namespace ursula::kernel {

/// Moves the row with the largest |a[row][k]| to row k, in every lane.
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

/// Transposes rows to columns in log₂ n rounds; each interleaves the first half with the second, lane by lane.
template <class Isa>
void transpose(Pack<Isa>* rows) {
  constexpr int n = Pack<Isa>::lanes;
  using Vector = typename Pack<Isa>::Batch::register_type;
  for (int round = 1; round < n; round *= 2) {
    Vector laced[n];
    for (int k = 0; k < n / 2; ++k) {
      const Vector a = rows[k].v, b = rows[k + n / 2].v;
      if constexpr (n == 8) {
        laced[2 * k] = __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
        laced[2 * k + 1] = __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
      } else if constexpr (n == 4) {
        laced[2 * k] = __builtin_shufflevector(a, b, 0, 4, 1, 5);
        laced[2 * k + 1] = __builtin_shufflevector(a, b, 2, 6, 3, 7);
      } else {
        static_assert(n == 2);
        laced[2 * k] = __builtin_shufflevector(a, b, 0, 2);
        laced[2 * k + 1] = __builtin_shufflevector(a, b, 1, 3);
      }
    }
    for (int k = 0; k < n; ++k) rows[k].v = laced[k];
  }
}

/// Loads `columns` numbers of each pose, a multiple of the lanes; poses are `stride` doubles apart.
template <class Isa, int columns>
std::array<Pack<Isa>, columns> columnsAt(const double* from, std::size_t stride) {
  constexpr int n = Pack<Isa>::lanes;
  static_assert(columns % n == 0);
  std::array<Pack<Isa>, columns> out;
  for (int first = 0; first < columns; first += n) {
    for (int lane = 0; lane < n; ++lane)
      out[first + lane].v = Pack<Isa>::Batch::load_unaligned(from + stride * static_cast<std::size_t>(lane) + first);
    transpose<Isa>(&out[first]);
  }
  return out;
}

/// Lengths of Motion<double> and of a six-vector in doubles.
constexpr std::size_t motion_stride = 25, vector_stride = 6;

template <class Isa>
Motion<Pack<Isa>> motionsAt(const double* from) {
  const auto columns = columnsAt<Isa, 24>(from + 1, motion_stride);  // skips the instant, which is not needed
  const Pack<Isa>* next = columns.data();
  return motionOf<Isa>([&next] { return *next++; });
}

template <class Isa>
Vector6<Pack<Isa>> vectorsAt(const double* from) {
  constexpr int n = Pack<Isa>::lanes;
  Vector6<Pack<Isa>> out = Vector6<Pack<Isa>>::Zero();
  if (from == nullptr) return out;
  alignas(64) double columns[6][n];
  for (int lane = 0; lane < n; ++lane)
    for (int k = 0; k < 6; ++k) columns[k][lane] = *from++;
  for (int k = 0; k < 6; ++k) out(k).v = Pack<Isa>::Batch::load_aligned(columns[k]);
  return out;
}

template <class Isa>
void put(const Vector6<Pack<Isa>>& values, const Pack<Isa>& faults, double* out, std::uint8_t* flags) {
  constexpr int n = Pack<Isa>::lanes;
  const Pack<Isa> none(0.0), nan = none / none;
  alignas(64) double columns[6][n], numbers[n];
  for (int k = 0; k < 6; ++k) select(faults > none, nan, values(k)).v.store_aligned(columns[k]);
  faults.v.store_aligned(numbers);
  for (int lane = 0; lane < n; ++lane) {
    for (int k = 0; k < 6; ++k) *out++ = columns[k][lane];
    flags[lane] = static_cast<std::uint8_t>(numbers[lane]);
  }
}

template <class Isa>
__attribute__((flatten)) void inverseBlock(const MachineModel<Pack<Isa>>& machine, const double* motions,
                                           const double* loads, double* out, std::uint8_t* flags) {
  using P = Pack<Isa>;
  BatchGuard<Isa> guard;
  P pivots;
  const auto guardOf = [&guard](int) -> BatchGuard<Isa>& { return guard; };
  const Vector6<P> efforts =
      inverseDynamics<P>(machine, motionsAt<Isa>(motions), vectorsAt<Isa>(loads), guardOf, pivots);
  guard.regularB(pivots);
  put<Isa>(efforts, guard.faults(), out, flags);
}

template <class Isa>
__attribute__((flatten)) void directBlock(const MachineModel<Pack<Isa>>& machine, const double* motions,
                                          const double* efforts, const double* loads, double* out,
                                          std::uint8_t* flags) {
  using P = Pack<Isa>;
  BatchGuard<Isa> guard;
  const auto guardOf = [&guard](int) -> BatchGuard<Isa>& { return guard; };
  Motion<P> motion = motionsAt<Isa>(motions);
  motion.omega_dot.setZero();
  motion.p_ddot.setZero();
  const Vector6<P> rates = directDynamics<P>(machine, motion, vectorsAt<Isa>(efforts), vectorsAt<Isa>(loads), guardOf);
  put<Isa>(rates, guard.faults(), out, flags);
}

/// The same machine in every lane.
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
    each(spans, [machine](const BatchSpans& block) {
      inverseBlock<Isa>(of(machine), block.motions, block.loads, block.out, block.faults);
    });
  }
  static void direct(const void* machine, const BatchSpans& spans) {
    each(spans, [machine](const BatchSpans& block) {
      directBlock<Isa>(of(machine), block.motions, block.efforts, block.loads, block.out, block.faults);
    });
  }

 private:
  static constexpr auto lanes = static_cast<std::size_t>(Pack<Isa>::lanes);

  static const MachineModel<Pack<Isa>>& of(const void* machine) {
    return static_cast<const BatchMachine*>(machine)->model;
  }
  /// Calls `block` for each block; the first pose of an incomplete last block fills it up.
  template <class F>
  static void each(BatchSpans spans, const F& block) {
    for (; spans.count >= lanes; spans = spansFrom(spans, lanes)) block(spans);
    if (spans.count == 0) return;
    double motions[motion_stride * lanes], efforts[vector_stride * lanes], loads[vector_stride * lanes];
    double out[vector_stride * lanes];
    std::uint8_t faults[lanes];
    fill(spans.motions, motion_stride, spans.count, motions);
    if (spans.efforts != nullptr) fill(spans.efforts, vector_stride, spans.count, efforts);
    if (spans.loads != nullptr) fill(spans.loads, vector_stride, spans.count, loads);
    block(BatchSpans{lanes, motions, efforts, spans.loads != nullptr ? loads : nullptr, out, faults});
    for (std::size_t k = 0; k < vector_stride * spans.count; ++k) spans.out[k] = out[k];
    for (std::size_t k = 0; k < spans.count; ++k) spans.faults[k] = faults[k];
  }
  static BatchSpans spansFrom(const BatchSpans& spans, std::size_t n) {
    const auto vectors = [n](const double* at) { return at != nullptr ? at + vector_stride * n : nullptr; };
    return {spans.count - n,      spans.motions + motion_stride * n, vectors(spans.efforts),
            vectors(spans.loads), spans.out + vector_stride * n,     spans.faults + n};
  }
  static void fill(const double* from, std::size_t stride, std::size_t count, double* to) {
    for (std::size_t lane = 0; lane < lanes; ++lane)
      for (std::size_t k = 0; k < stride; ++k) *to++ = from[stride * (lane < count ? lane : 0) + k];
  }
};

template <class Isa>
constexpr BatchFunctions batchFunctions() {
  using M = BatchMachine<Isa>;
  using L = LegLanes<Isa>;
  return {&M::make, &M::destroy, &M::inverse, &M::direct, &L::make, &L::destroy, &L::inverse, &L::direct};
}

}  // namespace ursula::kernel
