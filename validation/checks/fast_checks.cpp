#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "validation/samples/place_name.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// One kind of answer of the kernels.
struct Kernel {
  const char *check, *unit, *what;
  std::vector<Vector6d> FastAnswers::*answers;
  std::vector<Vector6d> FastSamples::*expected;
  Rounded rounded;
};

constexpr const char* of_efforts = "";

const Kernel kernels[] = {
    {"fast.inverse", of_efforts, "efforts of one pose at a time", &FastAnswers::torques, &FastSamples::torques,
     Rounded::solver},
    {"fast.direct", "m/s^2", "platform accelerations of one pose at a time", &FastAnswers::accelerations,
     &FastSamples::accelerations, Rounded::solver_direct},
    {"fast.inverse_batch", of_efforts, "efforts of batches", &FastAnswers::torques_in_batch, &FastSamples::torques,
     Rounded::solver},
    {"fast.direct_batch", "m/s^2", "platform accelerations of batches", &FastAnswers::accelerations_in_batch,
     &FastSamples::accelerations, Rounded::solver_direct},
};

/// The size of a difference or an answer: the largest effort, or a twist rate with rotations times the length.
double sizeOf(const Kernel& kernel, const Vector6d& v, double length) {
  if (kernel.unit == of_efforts) return v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  return v.tail<3>().norm() + length * v.head<3>().norm();
}

Check judgeKernel(const Kernel& kernel, const FastSamples& fast, const std::vector<PointwiseSample>& samples,
                  const Units& units) {
  const char* unit = kernel.unit == of_efforts ? units.efforts.unit : kernel.unit;
  if (!fast.refused.empty()) return notMade(kernel.check, unit, "no answer: " + fast.refused);
  if (fast.answers.empty() || fast.samples.empty()) return notMade(kernel.check, unit, "no instant was compared");
  WorstShare worst;
  double size = 0;
  std::string sets;
  for (std::size_t s = 0; s < fast.answers.size(); ++s) {
    const FastAnswers& answers = fast.answers[s];
    sets += (s == 0 ? "" : ", ") + std::string(nameOf(answers.set));
    const std::vector<Vector6d>& found = answers.*kernel.answers;
    if (found.size() < fast.samples.size()) return notMade(kernel.check, unit, "answers are missing");
    for (std::size_t k = 0; k < found.size(); ++k) {
      const std::size_t instant = k % fast.samples.size();
      const PointwiseSample& sample = samples[fast.samples[instant]];
      const Conditioning& at = sample.conditioning;
      const Vector6d& expected = (fast.*kernel.expected)[instant];
      size = std::max(size, sizeOf(kernel, expected, at.length));
      worst.add(sizeOf(kernel, found[k] - expected, at.length), 2 * at.rounding(kernel.rounded), sample.motion.t,
                static_cast<int>(s));
    }
  }
  const auto setOf = [&](int where) {
    return where < 0 ? "" : std::string(nameOf(fast.answers[static_cast<std::size_t>(where)].set));
  };
  const CheckedQuantity quantity{kernel.check, unit, size};
  const JudgedValue shown = worst.shown(quantity.useful());
  Check check = judgedIfUseful(
      quantity, worst, "twice the rounding of the NOC: both sides round",
      fmt::format("{} by the fast kernels against the NOC, at {} instants, with {}; shown for t = {:.6g} s, {}",
                  kernel.what, fast.samples.size(), sets, shown.t * units.time, setOf(shown.where)),
      causeOfRounding(samples, worst.widest_t, kernel.rounded));
  check.largest = {worst.largest, worst.largest_t * units.time, setOf(worst.largest_where)};
  return check;
}

}  // namespace

std::vector<Check> judgeFast(const FastSamples& fast, const std::vector<PointwiseSample>& samples, const Units& units) {
  std::vector<Check> out;
  for (const Kernel& kernel : kernels) out.push_back(judgeKernel(kernel, fast, samples, units));
  return out;
}

}  // namespace ursula
