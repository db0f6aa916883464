#include "validation/roads.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/maximal_loop.h"
#include "model/mujoco_loop.h"
#include "model/simbody_loop.h"
#include "nocsolver/reactions.h"
#include "nocsolver/solver.h"
#include "validation/worst.h"

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
  for (const RoadSample& sample : samples) torque = std::max(torque, road(sample).cwiseAbs().maxCoeff());
  Check check = judgedIfUseful(
      check_name, shown.value, limitToJudge(shown, useful_share * torque), useful_share * torque, "N m",
      fmt::format("eps kappa(B) kappa(legs) x || |T|' |w| || x {:g} x the spread measured in turned and rescaled "
                  "frames",
                  rounding_safety),
      fmt::format("torques against {}, at {} instants; shown for t = {:.6g} s, leg {}", what, samples.size(),
                  shown.t * units.time, shown.where + 1),
      fmt::format("it exceeds {:g} of the largest torque", useful_share));
  check.largest = {shown.largest, shown.largest_t * units.time, placeName(shown.largest_where, false)};
  return check;
}

double largest(const LegReactions& a, double length) { return distance(a, LegReactions{}, length); }

void addReactionColumns(const std::vector<Reactions>& reactions, TimeSeries& series) {
  struct Column {
    const char* pattern;
    Vector3d LegReactions::*member;
  };
  const std::array<Column, 5> columns{{{"reaction_fA_{}_{}_N", &LegReactions::f_A},
                                       {"reaction_nA_{}_{}_Nm", &LegReactions::n_A},
                                       {"reaction_fR_{}_{}_N", &LegReactions::f_R},
                                       {"reaction_nR_{}_{}_Nm", &LegReactions::n_R},
                                       {"reaction_fB_{}_{}_N", &LegReactions::f_B}}};
  const std::array<char, 3> axes{'x', 'y', 'z'};
  for (const Column& column : columns)
    for (std::size_t leg = 0; leg < leg_count; ++leg)
      for (int k = 0; k < 3; ++k) {
        std::vector<double> values;
        values.reserve(reactions.size());
        for (const Reactions& row : reactions) values.push_back((row[leg].*column.member)(k));
        series.add(fmt::format(fmt::runtime(column.pattern), axes[static_cast<std::size_t>(k)], leg + 1),
                   std::move(values));
      }
}

}  // namespace

std::vector<RoadSample> runRoads(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                 const RoundingProfile& profile) {
  SecondLook look_twin(profile), look_maximal(profile), look_mujoco(profile);
  SimbodyLoop twin(*scenario.manipulator, SimbodyLoop::Topology::tree_through_leg_1, scenario.load);
  MaximalLoop maximal(*scenario.manipulator, scenario.load);
  const auto mujoco = makeMujocoLoop(*scenario.manipulator, scenario.load);
  std::vector<RoadSample> out;
  out.reserve(samples.size());
  for (const PointwiseSample& sample : samples) {
    RoadSample road;
    road.t = sample.motion.t;
    road.subject = sample.torques;
    road.simbody = sample.torques_simbody;
    twin.place(sample.motion);
    road.twin = twin.inverseDynamics();
    road.maximal = maximal.inverseDynamics(sample.motion);
    if (mujoco) road.mujoco = mujoco->inverseDynamics(sample.motion);
    const auto limit = [&](SecondLook& look, Rounded quantity, const Vector6d& torques) {
      const double error = (road.subject - torques).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
      return look.limit(error, sample.conditioning, quantity, sample.motion);
    };
    road.limit_twin = limit(look_twin, Rounded::twin, road.twin);
    road.limit_maximal = limit(look_maximal, Rounded::maximal, road.maximal);
    road.limit_mujoco = mujoco ? limit(look_mujoco, Rounded::mujoco, *road.mujoco) : 0;
    road.limit = sample.torque.limit + road.limit_twin + road.limit_maximal + road.limit_mujoco;
    out.push_back(road);
  }
  return out;
}

double distance(const LegReactions& a, const LegReactions& b, double length) {
  double difference = 0;
  for (Vector3d LegReactions::*force : {&LegReactions::f_A, &LegReactions::f_R, &LegReactions::f_B})
    difference = larger(difference, (a.*force - b.*force).norm());
  for (Vector3d LegReactions::*moment : {&LegReactions::n_A, &LegReactions::n_R})
    difference = larger(difference, (a.*moment - b.*moment).norm() / length);
  return difference;
}

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

Check judgeReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                     const RoundingProfile& profile, TimeSeries* series, const Units& units,
                     const std::function<void(Reactions&)>& spoil) {
  SecondLook look(profile);
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  double size = 0;
  Worst worst;
  std::vector<Reactions> rows;
  for (const PointwiseSample& sample : samples) {
    const Vector6d torques = solver.inverseDynamics(sample.motion, work, loadAtP(scenario.load.get(), sample.motion));
    rows.push_back(recoverReactions(solver, sample.motion, torques, work));
    if (spoil) spoil(rows.back());
    loop.place(sample.motion);
    loop.accelerate(torques);
    const Reactions simbody = loop.reactions();
    const Conditioning& at = sample.conditioning;
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      size = std::max(size, largest(rows.back()[leg], at.length));
      const double error = distance(rows.back()[leg], simbody[leg], at.length);
      worst.add(error, look.limit(error, at, Rounded::reactions, sample.motion), sample.motion.t,
                static_cast<int>(leg));
    }
  }
  if (series != nullptr) addReactionColumns(rows, *series);
  if (!worst.any) return notMade("reactions.pointwise", "N", "no instant was compared");
  Check check = judgedIfUseful(
      "reactions.pointwise", worst.value, limitToJudge(worst, useful_share * size), useful_share * size, "N",
      fmt::format("eps (kappa(B)^2 kappa(legs) x || |T|' |w| || / length + largest mass x the acceleration's) x "
                  "{:g} x the spread measured in turned and rescaled frames",
                  rounding_safety),
      fmt::format("forces, and moments over the machine's length, at 18 joints against Simbody's mobilizer and "
                  "constraint reactions, at {} instants; shown for t = {:.6g} s, leg {}; the largest is {:.6g} N",
                  samples.size(), worst.t * units.time, worst.where + 1, size * units.force()),
      fmt::format("it exceeds {:g} of the largest", useful_share));
  check.largest = {worst.largest, worst.largest_t * units.time, placeName(worst.largest_where, false)};
  return check;
}

}  // namespace ursula
