#pragma once

#include <vector>

#include "validation/samples/pointwise.h"

namespace ursula {

/// Properties of a subject's D and T at one instant. Rotations are multiplied by the machine's length, so units do not
/// matter.
struct ComplementSample {
  double t = 0;
  double size_D = 0, size_T = 0;  ///< Frobenius norms
  double product = 0;             ///< ‖D T‖
  double limit = 0;               ///< rounding limit of `product`
  int rank_D = 0, rank_T = 0;
  int wanted_D = 0, wanted_T = 0;  ///< 6p − 6 for p bodies, and 6
};

/// Evaluates at a few of the samples.
std::vector<ComplementSample> runComplement(const Manipulator& machine, const Subject& subject,
                                            const std::vector<PointwiseSample>& samples);

}  // namespace ursula
