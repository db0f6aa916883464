#include "parts/fast/fast_checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/checks/judges.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

/// One kind of answer of the kernels.
struct Kernel {
  const char *check, *unit, *what;
  std::vector<Vector6d> FastAnswers::*answers;
  std::vector<Vector6d> FastSamples::*expected;
  Rounded rounded;
};

constexpr const char* in_effort_units = "";

const Kernel kernels[] = {
    {"fast.inverse", in_effort_units, "efforts of one pose at a time", &FastAnswers::torques, &FastSamples::torques,
     Rounded::solver},
    {"fast.direct", "m/s^2", "platform accelerations of one pose at a time", &FastAnswers::accelerations,
     &FastSamples::accelerations, Rounded::solver_direct},
    {"fast.inverse_batch", in_effort_units, "efforts of batches", &FastAnswers::torques_in_batch, &FastSamples::torques,
     Rounded::solver},
    {"fast.direct_batch", "m/s^2", "platform accelerations of batches", &FastAnswers::accelerations_in_batch,
     &FastSamples::accelerations, Rounded::solver_direct},
};

/// The size of a difference or an answer: the largest effort, or a twist rate with rotations times the length.
double sizeOf(const Kernel& kernel, const Vector6d& v, double length) {
  if (kernel.unit == in_effort_units) return v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  return twistSize(v, length);
}

/// Says which of `count` answers are wrong, by their place; "" if none or all are.
std::string partText(const std::vector<std::size_t>& wrong, std::size_t count) {
  if (wrong.empty() || wrong.size() == count) return "";
  const bool to_the_end = wrong.back() + 1 == count && wrong.back() - wrong.front() + 1 == wrong.size();
  return fmt::format("; {} of {} answers are wrong, {} number {}{}", wrong.size(), count,
                     to_the_end ? "from" : "the first is", wrong.front() + 1, to_the_end ? " on" : "");
}

Check judgeKernel(const Kernel& kernel, const FastSamples& fast, const std::vector<PointwiseSample>& samples,
                  const Units& units, double along) {
  const char* unit = kernel.unit == in_effort_units ? units.efforts.unit : kernel.unit;
  if (!fast.refused.empty()) return notMade(kernel.check, unit, "no answer: " + fast.refused);
  if (fast.answers.empty() || fast.samples.empty()) return notMade(kernel.check, unit, "no instant was compared");
  WorstShare worst;
  double size = 0;
  std::string sets, wrong_part;
  for (std::size_t s = 0; s < fast.answers.size(); ++s) {
    const FastAnswers& answers = fast.answers[s];
    sets += (s == 0 ? "" : ", ") + std::string(nameOf(answers.set));
    const std::vector<Vector6d>& found = answers.*kernel.answers;
    if (found.size() < fast.samples.size()) return notMade(kernel.check, unit, "answers are missing");
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const std::size_t instant = k % fast.samples.size();
      const PointwiseSample& sample = samples[fast.samples[instant]];
      const Conditioning& at = sample.conditioning;
      const Vector6d& expected = (fast.*kernel.expected)[instant];
      size = std::max(size, sizeOf(kernel, expected, at.length));
      const double error = sizeOf(kernel, found[k] - expected, at.length), limit = 2 * at.rounding(kernel.rounded);
      worst.add(error, limit, sample.motion.t, static_cast<int>(s));
      if (!(error <= limit)) wrong.push_back(k);
    }
    if (wrong_part.empty()) wrong_part = partText(wrong, found.size());
  }
  const auto setOf = [&](int where) { return nameOf(fast.answers[where].set); };
  return judgedShown({kernel.check, unit, std::max(size, along), 0, size, along}, worst, units,
                     {"twice the rounding of the NOC: both sides round",
                      fmt::format("{} by the fast kernels against the NOC, at {} instants, with {}", kernel.what,
                                  fast.samples.size(), sets),
                      setOf, causeOfRounding(samples, worst.widest_t, kernel.rounded), wrong_part});
}

}  // namespace

std::vector<Check> judgeFast(const FastSamples& fast, const std::vector<PointwiseSample>& samples, const Units& units,
                             const MotionSizes& sizes) {
  std::vector<Check> out;
  for (const Kernel& kernel : kernels)
    out.push_back(judgeKernel(kernel, fast, samples, units, sizes.of(kernel.rounded)));
  return out;
}

namespace {

const FastSamples& fastOf(const Evidence& e) {
  return *static_cast<const FastSamples*>(e.witnessed.at("fast kernels").get());
}

std::shared_ptr<const void> askKernels(const Evidence& e) {
  const auto* fault = dynamic_cast<const FastFault*>(e.fault.witness.get());
  return std::make_shared<FastSamples>(
      runFast(*e.scenario, e.natural.units, e.samples, fault == nullptr ? FastFault() : *fault));
}

/// False if time ran out before the kernels were called.
bool kernelsAsked(const Evidence& e) {
  if (e.samples.empty() || e.witnessed.count("fast kernels") == 0) return false;
  const FastSamples& fast = fastOf(e);
  return !fast.samples.empty() || !fast.refused.empty() || e.has.out_of_time.empty();
}

}  // namespace

void addFastFamilies(std::vector<CheckFamily>& rows) {
  CheckFamily fast = {"fast kernels",
                      {"fast.inverse", "fast.direct", "fast.inverse_batch", "fast.direct_batch"},
                      kernelsAsked,
                      [](const Evidence& e) { return judgeFast(fastOf(e), e.samples, e.units(), sizesOf(e)); }};
  fast.ask = askKernels;
  rows.push_back(fast);
}

void addFastProvenance(std::vector<std::pair<std::string, std::string>>& rows) {
  rows.emplace_back("instruction set", nameOf(bestInstructionSet()));
}

}  // namespace ursula
