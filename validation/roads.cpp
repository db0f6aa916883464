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

double distance(const RoadSample& sample, Road a, Road b) {
  return (a(sample) - b(sample)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

Worst compareRoads(const std::vector<RoadSample>& samples, Road a, Road b) {
  Worst worst;
  for (const RoadSample& sample : samples) worst.add(distance(sample, a, b), sample.limit, sample.t);
  return worst;
}

Check judgeRoad(const std::vector<RoadSample>& samples, const char* check_name, const char* what, Road road) {
  if (samples.empty()) return notMade(check_name, "N m", "no instant was compared");
  const Worst shown = compareRoads(samples, subjectOf, road);
  return judged(
      check_name, shown.value, shown.limit, "N m", "25 eps kappa(B) kappa(legs) x || |T|' |w| ||",
      fmt::format("torques against {}, at {} instants; shown for t = {:.6g} s", what, samples.size(), shown.t));
}

double largest(const LegReactions& a) {
  return std::max({a.f_A.norm(), a.n_A.norm(), a.f_R.norm(), a.n_R.norm(), a.f_B.norm()});
}

double largestDifference(const LegReactions& a, const LegReactions& b) {
  double difference = 0;
  for (Vector3d LegReactions::*part :
       {&LegReactions::f_A, &LegReactions::n_A, &LegReactions::f_R, &LegReactions::n_R, &LegReactions::f_B})
    difference = larger(difference, (a.*part - b.*part).norm());
  return difference;
}

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

std::vector<RoadSample> runRoads(const Scenario& scenario, const std::vector<PointwiseSample>& samples) {
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
    road.limit = sample.torque.limit;
    out.push_back(road);
  }
  return out;
}

std::vector<Check> judgeRoads(const std::vector<RoadSample>& samples) {
  std::vector<Check> checks{
      judgeRoad(samples, "torque.twin", "Simbody's loop grown through leg 1, five balls", twinOf),
      judgeRoad(samples, "torque.maximal", "13 bodies in maximal coordinates with Lagrange multipliers", maximalOf)};
  if (samples.empty() ? mujocoAvailable() : samples.front().mujoco.has_value())
    checks.push_back(judgeRoad(samples, "torque.mujoco", "MuJoCo's trees, closed by Lagrange multipliers", mujocoOf));
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
    return !compareRoads(samples, a.road, b.road).beyond;
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

Check judgeReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples, TimeSeries* series) {
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  double size = 0;
  Worst worst;
  std::vector<Reactions> rows;
  for (const PointwiseSample& sample : samples) {
    const Vector6d torques = solver.inverseDynamics(sample.motion, work, loadAtP(scenario.load.get(), sample.motion));
    rows.push_back(recoverReactions(solver, sample.motion, torques, work));
    loop.place(sample.motion);
    loop.accelerate(torques);
    const Reactions simbody = loop.reactions();
    // Forces come back from torques over the legs' levers, once more with the condition of B; accelerations that are
    // off ask for forces.
    const Conditioning& at = sample.conditioning;
    const double limit = at.torqueRounding() / at.length * at.kappa_B + at.largest_mass * at.accelerationRounding();
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      size = std::max(size, largest(rows.back()[leg]));
      worst.add(largestDifference(rows.back()[leg], simbody[leg]), limit, sample.motion.t, static_cast<int>(leg));
    }
  }
  if (series != nullptr) addReactionColumns(rows, *series);
  if (!worst.any) return notMade("reactions.pointwise", "N, N m", "no instant was compared");
  return judged(
      "reactions.pointwise", worst.value, worst.limit, "N, N m",
      "the torque's limit over the machine's length, x kappa(B), and the acceleration's, x the largest mass",
      fmt::format("forces and moments at 18 joints against Simbody's mobilizer and constraint reactions, at {} "
                  "instants; shown for t = {:.6g} s, leg {}; the largest is {:.6g}",
                  samples.size(), worst.t, worst.where + 1, size));
}

}  // namespace ursula
