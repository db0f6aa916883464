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

Check judgeKernel(const Kernel& kernel, const FastSamples& fast, const std::vector<PointwiseSample>& samples,
                  const Units& units) {
  const char* unit = kernel.unit == in_effort_units ? units.efforts.unit : kernel.unit;
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
  const auto setOf = [&](int where) { return nameOf(fast.answers[static_cast<std::size_t>(where)].set); };
  return judgedShown({kernel.check, unit, size}, worst, units,
                     {"twice the rounding of the NOC: both sides round",
                      fmt::format("{} by the fast kernels against the NOC, at {} instants, with {}", kernel.what,
                                  fast.samples.size(), sets),
                      setOf, causeOfRounding(samples, worst.widest_t, kernel.rounded)});
}

}  // namespace

std::vector<Check> judgeFast(const FastSamples& fast, const std::vector<PointwiseSample>& samples, const Units& units) {
  std::vector<Check> out;
  for (const Kernel& kernel : kernels) out.push_back(judgeKernel(kernel, fast, samples, units));
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
                      [](const Evidence& e) { return judgeFast(fastOf(e), e.samples, e.units()); }};
  fast.ask = askKernels;
  rows.push_back(fast);
}

void addFastProvenance(std::vector<std::pair<std::string, std::string>>& rows) {
  rows.emplace_back("instruction set", nameOf(bestInstructionSet()));
}

}  // namespace ursula
