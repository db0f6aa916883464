#include "validation/checks/road_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "model/loops/further_roads.h"
#include "validation/limits/conditioning.h"
#include "validation/limits/rounding_profile.h"
#include "validation/samples/place_name.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// Torques and limit of a pair of roads at one instant.
struct Pair {
  const Vector6d *a, *b;
  double limit;
};
using PairOf = std::function<Pair(const RoadSample&)>;

const Vector6d* given(const std::optional<Vector6d>& torques) { return torques ? &*torques : nullptr; }

Worst compareRoads(const std::vector<RoadSample>& samples, const PairOf& pairOf) {
  Worst worst;
  for (const RoadSample& sample : samples) {
    const Pair pair = pairOf(sample);
    Eigen::Index leg = 0;
    const double distance = (*pair.a - *pair.b).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(&leg);
    worst.add(distance, pair.limit, sample.t, static_cast<int>(leg));
  }
  return worst;
}

/// The k-th further road.
Check judgeRoad(const std::vector<RoadSample>& samples, std::size_t k, const Units& units) {
  const RoadKind& kind = furtherRoads()[k];
  if (samples.empty()) return notMade(kind.check, units.efforts.unit, "no instant was compared");
  const Worst shown = compareRoads(samples, [k](const RoadSample& sample) {
    return Pair{&sample.subject, given(sample.further[k]), sample.limits[k]};
  });
  double torque = 0;
  std::string cause;
  for (const RoadSample& sample : samples) {
    torque = std::max(torque, sample.further[k]->cwiseAbs().maxCoeff());
    if (sample.t == shown.widest_t) cause = causeOfRounding(sample.conditioning);
  }
  const CheckedQuantity quantity{kind.check, units.efforts.unit, torque};
  const Shown at = shown.shown(quantity.useful());
  Check check = judgedIfUseful(
      quantity, shown,
      fmt::format("eps kappa(B) kappa(legs) x || |T|' |w| || x {:g} x the spread measured in turned and rescaled "
                  "frames",
                  rounding_safety),
      fmt::format("torques against {}, at {} instants; shown for t = {:.6g} s, {}", kind.made_of, samples.size(),
                  at.t * units.time, motorName(units, at.where)),
      cause);
  check.largest = {shown.largest, shown.largest_t * units.time, motorName(units, shown.largest_where)};
  return check;
}

/// A road by name, as those of oddOneOut.
struct Named {
  const char* name;
  std::function<const Vector6d*(const RoadSample&)> torques;
};

std::vector<Named> roadsOf(const RoadSample& first) {
  std::vector<Named> roads{{"the torques on trial", [](const RoadSample& sample) { return &sample.subject; }},
                           {"Simbody, free platform", [](const RoadSample& sample) { return &sample.simbody; }}};
  for (std::size_t k = 0; k < further_road_count; ++k)
    if (first.further[k])
      roads.push_back({furtherRoads()[k].name, [k](const RoadSample& sample) { return given(sample.further[k]); }});
  return roads;
}

}  // namespace

std::vector<Check> judgeRoads(const std::vector<RoadSample>& samples, const Units& units) {
  std::vector<Check> checks;
  for (std::size_t k = 0; k < further_road_count; ++k)
    if (samples.empty() ? furtherRoads()[k].available() : samples.front().further[k].has_value())
      checks.push_back(judgeRoad(samples, k, units));
  return checks;
}

std::string oddOneOut(const std::vector<RoadSample>& samples) {
  if (samples.empty()) return "unknown: no instant was compared";
  const std::vector<Named> roads = roadsOf(samples.front());
  const auto agree = [&samples](const Named& a, const Named& b) {
    const auto pair = [&](const RoadSample& sample) {
      return Pair{a.torques(sample), b.torques(sample), sample.limit};
    };
    return !compareRoads(samples, pair).beyond();
  };
  for (const Named& odd : roads) {
    bool others_agree = true, alone = true;
    for (const Named& a : roads)
      for (const Named& b : roads) {
        if (&a == &b) continue;
        const bool pair_agrees = agree(a, b);
        if (&a != &odd && &b != &odd) others_agree &= pair_agrees;
        if (&a == &odd) alone &= !pair_agrees;
      }
    if (others_agree && alone) return odd.name;
  }
  const bool all = std::all_of(roads.begin(), roads.end(), [&](const Named& road) { return agree(roads[0], road); });
  return all ? fmt::format("none: {} roads agree", roads.size())
             : "not one alone: the roads disagree in more than one way";
}

}  // namespace ursula
