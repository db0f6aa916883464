#include "parts/causes/blind_spots.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "parts/causes/fits.h"
#include "parts/causes/tried_causes.h"
#include "validation/blind_spots.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

/// The name of a cause without its numbers; for `leg` 0 without the leg's.
std::string keyOf(const NamedCause& cause, int leg) {
  std::string parameter = cause.parameter;
  const std::string of_leg = fmt::format("manipulator.leg.{}", cause.leg);
  if (leg == 0 && cause.leg > 0 && (parameter + ".").rfind(of_leg + ".", 0) == 0)
    parameter.replace(0, of_leg.size(), "manipulator.leg_defaults");
  return fmt::format("{}/{}/{}/{}/{}/{}/{}/{}", static_cast<int>(cause.kind), cause.term, cause.body, cause.joint, leg,
                     cause.motor, fmt::join(cause.legs, ","), parameter);
}

/// Returns the motion at some instants; at one if it is a held pose.
std::vector<Motion<double>> commanded(const Trajectory& path) {
  std::vector<Motion<double>> out;
  for (std::size_t k = 0; k < blind_instants; ++k)
    out.push_back(path.at(path.duration() * static_cast<double>(k) / (blind_instants - 1)));
  const auto is_first = [&](const Motion<double>& other) {
    const Motion<double>& at = out.front();
    return at.p == other.p && at.Q == other.Q && at.p_dot == other.p_dot && at.omega == other.omega &&
           at.p_ddot == other.p_ddot && at.omega_dot == other.omega_dot;
  };
  if (std::all_of(out.begin(), out.end(), is_first)) out.resize(1);
  return out;
}

/// Whether the machine has what a mistake is about: no smoothing matters without Coulomb friction.
bool isOf(const Manipulator& machine, const NamedCause& cause) {
  const std::vector<Leg>& legs = machine.parameters().legs;
  return cause.parameter.find(".coulomb.s") == std::string::npos ||
         std::any_of(legs.begin(), legs.end(), [](const Leg& leg) { return leg.coulomb.any(); });
}

void tryCause(const Cause& cause, const Manipulator& machine, const std::vector<Motion<double>>& motions,
              BlindSpots& out) {
  const double start = cause.starts[(cause.starts.size() - 1) / 2], x = cause.fitted && start == 0 ? wrong_by : start;
  const std::optional<NamedCause> named = cause.named ? cause.named(x, 0) : std::nullopt;
  if (!named || !isOf(machine, *named)) return;
  if (named->expected && named->expected == named->found) return;  // a zero without a size
  NamedCause without_spread = *named;
  without_spread.uncertainty.reset();
  const bool is_possible = unlessRefused([&] {
                             const EffortsOf efforts = cause.solver(*cause.scenario, x);
                             out.tryOut(cause.words(x, 0), without_spread,
                                        [&](std::size_t k) -> Eigen::VectorXd { return efforts(motions[k]); });
                             return true;
                           }).has_value();
  if (!is_possible) out.shows(*named);
}

void tryTerms(const Scenario& scenario, const std::vector<Motion<double>>& motions, BlindSpots& out) {
  std::vector<Vector6d> right;
  for (std::size_t k = 0; k < out.instants(); ++k) right.emplace_back(out.right(k));
  for (const TorqueTerm& term : torqueTerms(scenario, motions, right))
    if (!term.term.empty())
      out.tryOut(term.name + " left out", {CauseKind::missing_term, term.term, term.body},
                 [&](std::size_t k) -> Eigen::VectorXd { return right[k] - term.torques[k]; });
  if (!scenario.load)
    out.add("a load left out: the scenario has none", {CauseKind::missing_term, "load", "platform"}, 0);
  if (!hasRotors(*scenario.manipulator))
    out.add("the rotors' inertia left out: the scenario has none", {CauseKind::missing_term, "rotor_inertia", "all"},
            0);
}

std::vector<BlindSpot> blindSpotsOf(const Scenario& scenario) {
  const std::vector<Motion<double>> motions = commanded(*scenario.trajectory);
  const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
  ConditioningProbe probe(*scenario.manipulator, scenario.load);
  std::vector<Eigen::VectorXd> right, rounding;
  for (const Motion<double>& motion : motions) {
    right.emplace_back(noc.torques(motion));
    rounding.emplace_back(Vector6d::Constant(probe.at(motion).torqueRounding()));
  }
  BlindSpots out(std::move(right), std::move(rounding), scenario.tolerance, scenario.trajectory->duration());
  tryTerms(scenario, motions, out);
  TriedCauses tried{scenario};
  tried.one_by_one = true;
  for (const auto add_group :
       {addTermCauses, addMachineCauses, addMotionCauses, addJointCauses, addJacobianCauses, addLoopCauses})
    add_group(tried);
  const std::vector<Leg>& legs = scenario.manipulator->parameters().legs;
  if (std::any_of(legs.begin(), legs.end(),
                  [](const Leg& leg) { return rowOf(leg.kind).isTelescopic() || rowOf(leg.kind).hasCarriage(); }))
    addSlidingCauses(tried);
  for (const Cause& cause : tried.causes) tryCause(cause, *scenario.manipulator, motions, out);
  out.addOfEfforts(motorNames(*scenario.manipulator));
  return out.list(scenario.manipulator->legCount());
}

}  // namespace

BlindSpots::BlindSpots(std::vector<Eigen::VectorXd> right, std::vector<Eigen::VectorXd> rounding,
                       const std::optional<EffortTolerance>& tolerance, double duration)
    : right_(std::move(right)), limit_(std::move(rounding)), duration_(duration) {
  for (const Eigen::VectorXd& row : right_) largest_ = std::max(largest_, row.cwiseAbs().maxCoeff());
  if (!tolerance) return;
  for (Eigen::VectorXd& row : limit_) row = row.cwiseMax(tolerance->relative * largest_ + tolerance->absolute).eval();
}

bool BlindSpots::hides(std::size_t k, const Eigen::VectorXd& change) const {
  return (change.array().abs() <= limit_[k].array()).all();  // false for NaN
}

void BlindSpots::add(const std::string& mistake, const NamedCause& cause, double change) {
  const std::string key = keyOf(cause, cause.leg);
  const double share = largest_ > 0 ? change / largest_ : 0;
  const auto same = std::find_if(found_.begin(), found_.end(), [&](const auto& one) { return one.first == key; });
  if (same == found_.end()) {
    found_.emplace_back(key, BlindSpot{mistake, {}, cause, share});
    return;
  }
  BlindSpot& one = same->second;
  if (mistake != one.mistake && std::find(one.alike.begin(), one.alike.end(), mistake) == one.alike.end())
    one.alike.push_back(mistake);
  one.largest = std::max(one.largest, share);
}

void BlindSpots::shows(const NamedCause& cause) {
  if (cause.kind == CauseKind::sign || cause.kind == CauseKind::scale || cause.kind == CauseKind::units ||
      cause.kind == CauseKind::closure || cause.kind == CauseKind::jacobian)
    shown_.insert(keyOf(cause, cause.leg));
}

void BlindSpots::addOfEfforts(const std::function<std::string(int)>& motor) {
  const auto motors = static_cast<int>(right_.front().size());
  const auto only = [&](std::size_t k, int m, double factor) {
    Eigen::VectorXd out = right_[k];
    out(m) *= factor;
    return out;
  };
  for (const auto& [words, kind, factor] :
       {std::tuple("the wrong sign", CauseKind::sign, -1.0), {"a wrong factor", CauseKind::scale, 1 + wrong_by}}) {
    tryOut(fmt::format("every effort with {}", words), {kind, "", "all"},
           [&, factor = factor](std::size_t k) -> Eigen::VectorXd { return factor * right_[k]; });
    for (int m = 0; m < motors; ++m) {
      NamedCause named{kind};
      named.motor = m + 1;
      tryOut(fmt::format("the effort of {} with {}", motor(m), words), named,
             [&, factor = factor](std::size_t k) { return only(k, m, factor); });
    }
  }
  for (int m = 0; m < motors; ++m)
    for (int other = m + 1; other < motors; ++other) {
      NamedCause named{CauseKind::order};
      named.legs.resize(motors);
      std::iota(named.legs.begin(), named.legs.end(), 1);
      std::swap(named.legs[m], named.legs[other]);
      tryOut(fmt::format("the efforts of {} and {} exchanged", motor(m), motor(other)), named, [&](std::size_t k) {
        Eigen::VectorXd out = right_[k];
        std::swap(out(m), out(other));
        return out;
      });
    }
  const double late = right_.size() > 1 ? duration_ / static_cast<double>(right_.size() - 1) : duration_;
  NamedCause delay{CauseKind::delay};
  delay.unit = "s";
  delay.expected = 0;
  delay.found = late;
  tryOut(fmt::format("every effort late by {:.3g} s", late), delay,
         [&](std::size_t k) -> Eigen::VectorXd { return right_[k == 0 ? 0 : k - 1]; });
}

std::vector<BlindSpot> BlindSpots::list(int legs) const {
  std::map<std::string, int> of_legs;
  std::set<std::string> of_all;
  for (const auto& [key, one] : found_)
    if (one.cause.leg > 0)
      ++of_legs[keyOf(one.cause, 0)];
    else
      of_all.insert(key);
  std::vector<BlindSpot> out;
  for (const auto& [key, one] : found_) {
    const std::string of_any = keyOf(one.cause, 0);
    if (shown_.count(key) > 0) continue;
    if (one.cause.leg > 0 && of_legs[of_any] == legs && of_all.count(of_any) > 0) continue;
    out.push_back(one);
  }
  return out;
}

namespace mechanisms {
std::vector<BlindSpot> blindSpotsOf(const MechanismScenario& scenario);
}

const BlindSpotFinder* addBlindSpots();
const BlindSpotFinder* addBlindSpots() {
  static const BlindSpotFinder finder = {blindSpotsOf, mechanisms::blindSpotsOf};
  return &finder;
}

}  // namespace ursula
