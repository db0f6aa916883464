#include "validation/checks/road_checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/loops/mujoco/mujoco_loop.h"
#include "validation/limits/conditioning.h"
#include "validation/limits/rounding_profile.h"
#include "validation/samples/place_name.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

using Road = const Vector6d& (*)(const RoadSample&);

const Vector6d& subjectOf(const RoadSample& sample) { return sample.subject; }
const Vector6d& simbodyOf(const RoadSample& sample) { return sample.simbody; }
const Vector6d& twinOf(const RoadSample& sample) { return sample.twin; }
const Vector6d& maximalOf(const RoadSample& sample) { return sample.maximal; }
const Vector6d& mujocoOf(const RoadSample& sample) { return sample.mujoco.value(); }

using Limit = double RoadSample::*;

Worst compareRoads(const std::vector<RoadSample>& samples, Road a, Road b, Limit limit) {
  Worst worst;
  for (const RoadSample& sample : samples) {
    Eigen::Index leg = 0;
    const double distance = (a(sample) - b(sample)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(&leg);
    worst.add(distance, sample.*limit, sample.t, static_cast<int>(leg));
  }
  return worst;
}

Check judgeRoad(const std::vector<RoadSample>& samples, const char* check_name, const char* what, Road road,
                Limit limit, const Units& units) {
  if (samples.empty()) return notMade(check_name, "N m", "no instant was compared");
  const Worst shown = compareRoads(samples, subjectOf, road, limit);
  double torque = 0;
  std::string cause;
  for (const RoadSample& sample : samples) {
    torque = std::max(torque, road(sample).cwiseAbs().maxCoeff());
    if (sample.t == shown.widest_t) cause = causeOfRounding(sample.conditioning);
  }
  Check check = judgedIfUseful(
      check_name, shown.value, limitToJudge(shown, useful_share * torque), useful_share * torque, "N m",
      fmt::format("eps kappa(B) kappa(legs) x || |T|' |w| || x {:g} x the spread measured in turned and rescaled "
                  "frames",
                  rounding_safety),
      fmt::format("torques against {}, at {} instants; shown for t = {:.6g} s, leg {}", what, samples.size(),
                  shown.t * units.time, shown.where + 1),
      fmt::format("it exceeds {:g} of the largest torque: {}", useful_share, cause));
  check.largest = {shown.largest, shown.largest_t * units.time, placeName(shown.largest_where, false)};
  return check;
}

}  // namespace

std::vector<Check> judgeRoads(const std::vector<RoadSample>& samples, const Units& units) {
  std::vector<Check> checks{
      judgeRoad(samples, "torque.twin", "Simbody's loop grown through leg 1, five balls", twinOf,
                &RoadSample::limit_twin, units),
      judgeRoad(samples, "torque.maximal", "13 bodies in maximal coordinates with Lagrange multipliers", maximalOf,
                &RoadSample::limit_maximal, units)};
  if (samples.empty() ? mujocoAvailable() : samples.front().mujoco.has_value())
    checks.push_back(judgeRoad(samples, "torque.mujoco", "MuJoCo's trees, closed by Lagrange multipliers", mujocoOf,
                               &RoadSample::limit_mujoco, units));
  return checks;
}

std::string oddOneOut(const std::vector<RoadSample>& samples) {
  if (samples.empty()) return "unknown: no instant was compared";
  struct Named {
    const char* name;
    Road road;
  };
  std::vector<Named> roads{{"the torques on trial", subjectOf},
                           {"Simbody, six balls", simbodyOf},
                           {"Simbody, tree through leg 1", twinOf},
                           {"maximal coordinates", maximalOf}};
  if (samples.front().mujoco) roads.push_back({"MuJoCo", mujocoOf});
  const auto agree = [&samples](const Named& a, const Named& b) {
    return !compareRoads(samples, a.road, b.road, &RoadSample::limit).beyond();
  };
  for (const Named& odd : roads) {
    bool others_agree = true, alone = true;
    for (const Named& a : roads)
      for (const Named& b : roads) {
        if (a.road == b.road) continue;
        const bool pair_agrees = agree(a, b);
        if (a.road != odd.road && b.road != odd.road) others_agree &= pair_agrees;
        if (a.road == odd.road) alone &= !pair_agrees;
      }
    if (others_agree && alone) return odd.name;
  }
  const bool all = std::all_of(roads.begin(), roads.end(), [&](const Named& road) { return agree(roads[0], road); });
  return all ? fmt::format("none: {} roads agree", roads.size() == 5 ? "five" : "four")
             : "not one alone: the roads disagree in more than one way";
}

}  // namespace ursula
