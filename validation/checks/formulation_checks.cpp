#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

#include "validation/limits/further_engines.h"
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
  const EngineKind& kind = furtherEngines()[k];
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
  for (std::size_t k = 0; k < furtherEngines().size(); ++k)
    if (first.further[k])
      engines.push_back(
          {furtherEngines()[k].name, [k](const EngineSample& sample) { return given(sample.further[k]); }});
  return engines;
}

}  // namespace

std::vector<Check> judgeEngines(const std::vector<EngineSample>& samples, const Units& units,
                                const std::vector<PointwiseSample>& conditions) {
  std::vector<Check> checks;
  for (std::size_t k = 0; k < furtherEngines().size(); ++k)
    if (samples.empty() ? furtherEngines()[k].available() : samples.front().further[k].has_value())
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
