#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

#include "parts/engines/further_engines.h"
#include "validation/checks/judges.h"
#include "validation/limits/conditioning.h"
#include "validation/limits/rounding_profile.h"
#include "validation/samples/pointwise.h"

namespace ursula {
namespace {

/// Torques and limit of a pair of formulations at one instant.
struct Pair {
  const Vector6d *a, *b;
  double limit;
};
using PairOf = std::function<Pair(const EngineSample&)>;

const Vector6d* given(const std::optional<Vector6d>& torques) { return torques ? &*torques : nullptr; }

WorstShare compareEngines(const std::vector<EngineSample>& samples, const PairOf& pairOf) {
  WorstShare worst;
  for (const EngineSample& sample : samples) {
    const Pair pair = pairOf(sample);
    Eigen::Index leg = 0;
    const double distance = (*pair.a - *pair.b).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(&leg);
    worst.add(distance, pair.limit, sample.t, static_cast<int>(leg));
  }
  return worst;
}

/// Judges the k-th further formulation.
Check judgeEngine(const std::vector<EngineSample>& samples, std::size_t k, const Units& units,
                  const std::vector<PointwiseSample>& conditions) {
  const EngineKind& kind = further_engines[k];
  if (samples.empty()) return notMade(kind.check, units.efforts.unit, "no instant was compared");
  const WorstShare worst = compareEngines(samples, [k](const EngineSample& sample) {
    return Pair{&sample.subject, given(sample.further[k]), sample.limits[k]};
  });
  double torque = 0;
  for (const EngineSample& sample : samples) torque = std::max(torque, sample.further[k]->cwiseAbs().maxCoeff());
  return judgedShown(
      {kind.check, units.efforts.unit, torque}, worst, units,
      {fmt::format(
           "eps kappa(B) kappa(legs) x || |T|' |w| || x {:g} x the spread measured over frames and changed inputs",
           rounding_safety),
       fmt::format("torques against {}, at {} instants", kind.made_of, samples.size()), motorsOf(units),
       causeOfRounding(conditions, worst.widest_t)});
}

/// A formulation and its name for oddOneOut.
struct Named {
  const char* name;
  std::function<const Vector6d*(const EngineSample&)> torques;
};

std::vector<Named> enginesOf(const EngineSample& first) {
  std::vector<Named> engines{{"the torques under test", [](const EngineSample& sample) { return &sample.subject; }},
                             {"Simbody, free platform", [](const EngineSample& sample) { return &sample.simbody; }}};
  for (std::size_t k = 0; k < further_engine_count; ++k)
    if (first.further[k])
      engines.push_back(
          {further_engines[k].name, [k](const EngineSample& sample) { return given(sample.further[k]); }});
  return engines;
}

}  // namespace

std::vector<Check> judgeEngines(const std::vector<EngineSample>& samples, const Units& units,
                                const std::vector<PointwiseSample>& conditions) {
  std::vector<Check> checks;
  for (std::size_t k = 0; k < further_engine_count; ++k)
    if (samples.empty() ? further_engines[k].available() : samples.front().further[k].has_value())
      checks.push_back(judgeEngine(samples, k, units, conditions));
  return checks;
}

std::string oddOneOut(const std::vector<EngineSample>& samples) {
  if (samples.empty()) return "unknown: no instant was compared";
  const std::vector<Named> engines = enginesOf(samples.front());
  const auto agree = [&samples](const Named& a, const Named& b) {
    const auto pair = [&](const EngineSample& sample) {
      return Pair{a.torques(sample), b.torques(sample), sample.limit};
    };
    return !compareEngines(samples, pair).beyond();
  };
  for (const Named& odd : engines) {
    bool others_agree = true, alone = true;
    for (const Named& a : engines)
      for (const Named& b : engines) {
        if (&a == &b) continue;
        const bool pair_agrees = agree(a, b);
        if (&a != &odd && &b != &odd) others_agree &= pair_agrees;
        if (&a == &odd) alone &= !pair_agrees;
      }
    if (others_agree && alone) return odd.name;
  }
  const bool all =
      std::all_of(engines.begin(), engines.end(), [&](const Named& engine) { return agree(engines[0], engine); });
  return all ? fmt::format("none: {} formulations agree", engines.size())
             : "not one alone: the formulations disagree in more than one way";
}

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

Check judgeAgainstNoc(const ExternalTorques& torques, const Units& units) {
  WorstShare worst;
  CheckedQuantity quantity{"torque.against_noc", units.efforts.unit};
  for (std::size_t k = 0; k < torques.against_noc.size(); ++k) {
    const Deviation& each = torques.against_noc[k];
    worst.add(each.error, each.limit, torques.file.t[k], each.where);
    quantity.given = std::max(quantity.given, each.given);
  }
  quantity.size = largestTorque(torques.samples);
  if (!worst.any) return notMade(quantity.name, quantity.unit, "no instant was compared");
  return judgedShown(quantity, worst, units,
                     {"as for torque.pointwise",
                      fmt::format("torques against this program's NOC, at {} instants", torques.file.rows()),
                      motorsOf(units), causeOfRounding(torques.samples, worst.widest_t)});
}

}  // namespace ursula
