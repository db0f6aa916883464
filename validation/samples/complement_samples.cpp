#include "validation/samples/complement_samples.h"

#include <algorithm>

#include "base/dense.h"
#include "nocsolver/errors.h"

namespace ursula {
namespace {

constexpr std::size_t instants = 7;

/// Multiplies rotations by the length in T's rows and divides them in D's columns; rows of D are normalised.
void scale(double length, Complement& of) {
  for (Eigen::Index body = 0; body < of.T.rows() / 6; ++body) {
    of.T.middleRows(6 * body, 3) *= length;
    of.D.middleCols(6 * body, 3) /= length;
  }
  for (Eigen::Index k = 0; k < of.D.rows(); ++k)
    if (const double size = of.D.row(k).norm(); size > 0) of.D.row(k) /= size;
  for (Eigen::Index k = 0; k < of.T.cols(); ++k)
    if (const double size = of.T.col(k).norm(); size > 0) of.T.col(k) /= size;
}

ComplementSample sampled(const Subject& subject, const PointwiseSample& at, int bodies) {
  Complement complement = subject.complement(at.motion);
  scale(at.conditioning.length, complement);
  ComplementSample out;
  out.t = at.motion.t;
  out.size_D = complement.D.norm();
  out.size_T = complement.T.norm();
  out.product = (complement.D * complement.T).norm();
  out.limit = at.conditioning.complementRounding() * out.size_D * out.size_T;
  // Zero rows and columns of missing legs do not change a rank.
  out.rank_D = rankOf(complement.D);
  out.rank_T = rankOf(complement.T);
  out.wanted_D = 6 * bodies - motor_count;
  out.wanted_T = motor_count;
  return out;
}

}  // namespace

std::vector<ComplementSample> runComplement(const Manipulator& machine, const Subject& subject,
                                            const std::vector<PointwiseSample>& samples) {
  std::vector<ComplementSample> out;
  if (!subject.complement) return out;
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / instants);
  for (std::size_t k = 0; k < samples.size(); k += stride)
    out.push_back(sampled(subject, samples[k], 2 * machine.legCount() + 1));
  return out;
}

}  // namespace ursula
