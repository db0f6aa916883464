#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "model/manipulator.h"
#include "model/motion.h"

namespace ursula {

/// What a batch is computed with. Which of them the processor has is found when the program runs.
enum class InstructionSet { portable, sse2, avx2, avx512 };

bool isSupported(InstructionSet set);
/// The widest that is supported.
InstructionSet bestInstructionSet();
/// "AVX-512".
const char* nameOf(InstructionSet set);

/// Why a pose of a batch has no answer; of several, the first on the way from leg 1 on.
enum class PoseFault : std::uint8_t {
  none,
  out_of_reach,
  end_of_stroke,
  point_on_axis,
  stretched_leg,
  singular_jacobian
};

/// FastDynamics over many poses: the same formulas, as many poses at a time as a register has lanes. A pose without an
/// answer is flagged, its numbers are NaN, and no other is touched by it.
///
/// Numbers do not depend on where in a batch a pose is, or on how long the batch is. They differ in the last bits
/// between instruction sets (fused products, tanh) and from FastDynamics.
///
/// Immutable: threads share it. Nothing is allocated after the construction. Throws nothing.
class BatchDynamics {
 public:
  /// `set` is to be supported, or std::invalid_argument is thrown.
  explicit BatchDynamics(const Manipulator& manipulator, InstructionSet set = bestInstructionSet());
  ~BatchDynamics();
  BatchDynamics(BatchDynamics&&) noexcept;
  BatchDynamics& operator=(BatchDynamics&&) noexcept;

  InstructionSet instructionSet() const;

  /// Efforts as FastDynamics::inverseDynamics; all pointers to `count` entries. `loads` may be null: no load.
  void inverseDynamics(const Motion<double>* motions, std::size_t count, Vector6d* efforts, PoseFault* faults,
                       const Vector6d* loads = nullptr) const;

  /// Twist rates [ω̇; p̈] as FastDynamics::directDynamics.
  void directDynamics(const Motion<double>* motions, const Vector6d* efforts, std::size_t count, Vector6d* twist_rates,
                      PoseFault* faults, const Vector6d* loads = nullptr) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ursula
