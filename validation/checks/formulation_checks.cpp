#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "model/check_catalogue.h"
#include "validation/checks/judges.h"
#include "validation/limits/conditioning.h"
#include "validation/limits/further_engines.h"
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
    worst.addEach(*pair.a - *pair.b, Vector6d::Constant(pair.limit), sample.t);
  }
  return worst;
}

/// Judges the k-th further formulation.
Check judgeEngine(const std::vector<EngineSample>& samples, std::size_t k, const Units& units,
                  const std::vector<PointwiseSample>& conditions, double along) {
  const EngineKind& kind = furtherEngines()[k];
  if (samples.empty()) return notMade(kind.check, units.efforts.unit, "no instant was compared");
  const WorstShare worst = compareEngines(samples, [k](const EngineSample& sample) {
    return Pair{&sample.subject, given(sample.further[k]), sample.limits[k]};
  });
  double torque = 0;
  for (const EngineSample& sample : samples) torque = std::max(torque, sample.further[k]->cwiseAbs().maxCoeff());
  return judgedShown(
      {kind.check, units.efforts.unit, std::max(torque, along), 0, torque, along}, worst, units,
      {fmt::format("eps kappa(B) kappa(legs) x || |T|' |w| || x {:g} x the spread measured over changed inputs",
                   rounding_safety),
       fmt::format("torques against {}, at {} instants", kind.made_of, samples.size()), motorsOf(units),
       causeOfRounding(conditions, worst.widest_t)});
}

/// The torques of one formulation, and their limit against the subject's.
struct Named {
  std::string engine, name;  ///< as in Voice
  std::function<const Vector6d*(const EngineSample&)> torques;
  std::function<double(const EngineSample&)> limit;
};

/// Finds the voices that take part in each contradiction. `agree` compares two formulations by their places.
OddOne oddOneOf(const std::vector<Named>& all, const std::function<bool(std::size_t, std::size_t)>& agree) {
  std::set<std::pair<std::size_t, std::size_t>> contradictions;
  for (std::size_t j = 0; j < all.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (!agree(i, j)) contradictions.insert({{i, j}, {j, i}});
  OddOne out{static_cast<int>(all.size()), contradictions.empty()};
  for (const Named& each : all) {
    const auto isOf = [&](std::size_t k) { return all[k].engine == each.engine; };
    const auto takesPart = [&isOf](const auto& pair) { return isOf(pair.first) || isOf(pair.second); };
    const bool is_known = !out.odd.empty() && out.odd.back().engine == each.engine;
    if (out.agree || is_known || !std::all_of(contradictions.begin(), contradictions.end(), takesPart)) continue;
    Voice voice{each.engine, {}};
    for (const auto& [one, other] : contradictions)
      if (isOf(one) && !isOf(other) && (voice.formulations.empty() || voice.formulations.back() != all[one].name))
        voice.formulations.push_back(all[one].name);
    out.odd.push_back(voice);
  }
  return out;
}

std::string engineOf(const char* check) { return checkRow(check)->engine; }

std::vector<Named> enginesOf(const EngineSample& first) {
  using Sample = EngineSample;
  std::vector<Named> engines{{"", "", [](const Sample& s) { return &s.subject; }, [](const Sample&) { return 0.0; }},
                             {engineOf("torque.pointwise"), "Simbody, free platform",
                              [](const Sample& s) { return &s.simbody; }, [](const Sample& s) { return s.limit; }}};
  for (std::size_t k = 0; k < furtherEngines().size(); ++k)
    if (first.further[k])
      engines.push_back({engineOf(furtherEngines()[k].check), furtherEngines()[k].name,
                         [k](const Sample& s) { return given(s.further[k]); },
                         [k](const Sample& s) { return s.limits[k]; }});
  return engines;
}

}  // namespace

std::vector<Check> judgeEngines(const std::vector<EngineSample>& samples, const Units& units,
                                const std::vector<PointwiseSample>& conditions, const MotionSizes& sizes) {
  std::vector<Check> checks;
  for (std::size_t k = 0; k < furtherEngines().size(); ++k)
    if (samples.empty() ? furtherEngines()[k].available() : samples.front().further[k].has_value())
      checks.push_back(judgeEngine(samples, k, units, conditions, sizes.of(Rounded::torque)));
  return checks;
}

OddOne oddOneOut(const std::vector<EngineSample>& samples) {
  if (samples.empty()) return {};
  const std::vector<Named> engines = enginesOf(samples.front());
  return oddOneOf(engines, [&](std::size_t i, std::size_t j) {
    const Named &a = engines[i], &b = engines[j];
    const auto pairOf = [&](const EngineSample& sample) {
      return Pair{a.torques(sample), b.torques(sample), a.limit(sample) + b.limit(sample)};
    };
    return !compareEngines(samples, pairOf).beyond();
  });
}

OddOne oddOneOut(const ExternalTorques& torques) {
  if (torques.samples.empty()) return {};
  const std::vector<Named> all = {{"", "", {}, {}},
                                  {engineOf("torque.pointwise"), "Simbody, free platform", {}, {}},
                                  {engineOf("torque.against_noc"), "the NOC", {}, {}}};
  return oddOneOf(all, [&torques](std::size_t i, std::size_t j) {
    WorstShare worst;
    for (std::size_t k = 0; k < torques.samples.size(); ++k) {
      const PointwiseSample& sample = torques.samples[k];
      const Vector6d* const of[] = {&sample.torques, &sample.torques_simbody, &torques.noc[k]};
      const Vector6d rounding = Vector6d::Constant(sample.conditioning.torqueRounding());
      worst.addEach(*of[i] - *of[j], i == 0 ? sample.torqueLimits() : rounding, sample.motion.t);
    }
    return !worst.beyond();
  });
}

Check judgeAgainstNoc(const ExternalTorques& torques, const Units& units) {
  WorstShare worst;
  CheckedQuantity quantity{"torque.against_noc", units.efforts.unit};
  for (std::size_t k = 0; k < torques.noc.size(); ++k) {
    const PointwiseSample& sample = torques.samples[k];
    worst.addEach(sample.torques - torques.noc[k], sample.torqueLimits(), sample.motion.t);
    quantity.given = std::max(quantity.given, sample.torques_given.maxCoeff());
  }
  quantity.seen = largestTorque(torques.samples);
  quantity.along = torques.sizes.of(Rounded::torque);
  quantity.size = std::max(quantity.seen, quantity.along);
  if (!worst.any) return notMade(quantity.name, quantity.unit, "no instant was compared");
  return judgedShown(quantity, worst, units,
                     {"as for torque.pointwise",
                      fmt::format("torques against this program's NOC, at {} instants", torques.file.rows()),
                      motorsOf(units), causeOfRounding(torques.samples, worst.widest_t)});
}

}  // namespace ursula
