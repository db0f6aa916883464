#include "validation/finish.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/uuid/detail/sha1.hpp>
#include <iterator>

#include "model/check_names.h"
#include "model/mujoco_loop.h"
#include "validation/commanded_motion.h"
#include "validation/picture.h"
#include "validation/provenance.h"
#include "validation/worst.h"

namespace ursula {
namespace {

std::string sha1(const std::string& text) {
  boost::uuids::detail::sha1 hash;
  hash.process_bytes(text.data(), text.size());
  boost::uuids::detail::sha1::digest_type digest;
  hash.get_digest(digest);
  std::string out;
  for (unsigned word : digest) out += fmt::format("{:08x}", word);
  return out;
}

/// "p_x_m" → "m", "tau_1_Nm" → "Nm", "q_w" → "".
std::string unitOf(const std::string& column) {
  for (const char* unit : {"rad_s2", "rad_s", "rad", "m_s2", "m_s", "Nm", "N", "J", "m", "s"}) {
    const std::string ending = std::string("_") + unit;
    if (column.size() > ending.size() && column.compare(column.size() - ending.size(), ending.size(), ending) == 0)
      return unit;
  }
  const std::size_t open = column.rfind('(');
  return open == std::string::npos || column.back() != ')' ? "" : column.substr(open + 1, column.size() - open - 2);
}

void restoreColumns(const Presentation& from, TimeSeries& series) {
  for (std::size_t k = 0; k < series.names.size(); ++k) {
    const std::string& column = series.names[k];
    const double unit = from.units.of(unitOf(column));
    double offset = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const char* prefix : {"p_", "sim_p_"})
        if (column == fmt::format("{}{}_m", prefix, "xyz"[axis])) offset = from.origin(axis);
    for (double& value : series.columns[k]) value = value * unit + offset;
  }
}

/// A wider limit decides only where there is a finished value to hold against it.
void judgeByUser(double limit, Check& check) {
  const bool finished = check.reason == Reason::none || check.reason == Reason::limit_useless;
  if (!finished) {
    check.why += fmt::format("; [acceptance] allows {:.3g} {}, but there is no finished value to hold against it",
                             limit, check.unit);
    return;
  }
  const bool wider = !(limit <= check.limit) || check.reason == Reason::limit_useless;
  const Largest largest = check.largest;
  const std::string where = largest.where.empty() ? "" : ", " + largest.where;
  check = judged(check.name, largest.value, limit, check.unit,
                 fmt::format("[acceptance] of the scenario; derived: {:.3g}, {}", check.limit, check.basis),
                 fmt::format("{}; the largest value, at t = {:.6g} s{}", check.why, largest.t, where));
  check.largest = largest;
  check.limit_by = wider ? LimitBy::user : LimitBy::derived;
}

/// κ(B): infinite where the pose is singular.
std::string nearestToSingular(const std::vector<PointwiseSample>& samples, const Units& units) {
  const PointwiseSample& at = *std::max_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.kappa_B < b.conditioning.kappa_B;
  });
  return fmt::format("{:.4g}, at t = {:.6g} s", at.conditioning.kappa_B, at.motion.t * units.time);
}

/// |sin θ|: 0 where a leg is stretched or folded.
std::string nearestToEdge(const std::vector<PointwiseSample>& samples, const Units& units) {
  const PointwiseSample& at = *std::min_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.smallest_sine < b.conditioning.smallest_sine;
  });
  return fmt::format("{:.4g}, leg {} at t = {:.6g} s", at.conditioning.smallest_sine,
                     at.conditioning.smallest_sine_leg + 1, at.motion.t * units.time);
}

/// Evenly picked, the last among them.
std::vector<double> atMost(std::size_t most, const std::vector<double>& t) {
  if (t.size() <= most) return t;
  std::vector<double> out;
  for (std::size_t i = 0; i < most; ++i) out.push_back(t[i * (t.size() - 1) / (most - 1)]);
  return out;
}

/// Why a check that was not made does not apply.
std::string whyNot(const CheckName& check, const Scenario& scenario, const SubjectHas& has) {
  const auto unless = [&](bool there, const char* why) {
    return std::string(there ? "the subject has no answer" : why);
  };
  if (!has.any_instant && check.needs != CheckNeeds::load_history && check.needs != CheckNeeds::scenario_file)
    return "a file gives torques alone, at its own instants";
  switch (check.needs) {
    case CheckNeeds::load_history:
      return scenario.load ? "the load is constant" : "there is no load";
    case CheckNeeds::scenario_file:
      return "the scenario was not read from a file";
    case CheckNeeds::kinematics:
      return unless(has.kinematics, "the subject gives no kinematics");
    case CheckNeeds::direct_dynamics:
      return unless(has.direct_dynamics, "the subject solves no direct dynamics");
    case CheckNeeds::other_machines:
      return unless(has.other_machines, "the subject cannot be made for another machine");
    case CheckNeeds::own_reactions:
      return unless(!has.left_out_reactions, "left out by the caller's options");
    case CheckNeeds::mujoco:
      return unless(mujocoAvailable(), "this build has no MuJoCo");
    case CheckNeeds::torque_file:
      return "the torques do not come from a file";
    case CheckNeeds::nothing:
    case CheckNeeds::any_instant:
      break;
  }
  return unless(!has.left_out_ladder, "left out by the caller's options");
}

}  // namespace

void restore(const Presentation& from, ValidationResult& result) {
  for (Check& check : result.checks) {
    const double unit = from.units.of(check.unit);
    check.value *= unit;
    check.limit *= unit;
    check.largest.value *= unit;
  }
  restoreColumns(from, result.timeseries);
  for (auto& [title, curve] : result.curves) restoreColumns(from, curve);
  for (Event& event : result.events) event.t *= from.units.time;
}

void prependMotionChecks(const Scenario& scenario, ValidationResult& result) {
  std::vector<Check> checks = judgeCommandedMotion(scenario);
  result.checks.insert(result.checks.begin(), std::make_move_iterator(checks.begin()),
                       std::make_move_iterator(checks.end()));
}

void listEveryCheck(const Scenario& scenario, const SubjectHas& has, ValidationResult& result) {
  std::vector<Check> listed;
  for (const CheckName& wanted : checkNames()) {
    const auto found = std::find_if(result.checks.begin(), result.checks.end(),
                                    [&wanted](const Check& check) { return check.name == wanted.name; });
    listed.push_back(found != result.checks.end()
                         ? std::move(*found)
                         : notApplicable(wanted.name, wanted.unit, whyNot(wanted, scenario, has)));
  }
  result.checks = std::move(listed);
}

void judgeByUser(const std::vector<AcceptanceLimit>& acceptance, ValidationResult& result) {
  for (const AcceptanceLimit& wanted : acceptance) {
    const auto found = std::find_if(result.checks.begin(), result.checks.end(),
                                    [&wanted](const Check& check) { return check.name == wanted.check; });
    if (found == result.checks.end())
      result.checks.push_back(notMade(wanted.check, "", "[acceptance] names a check that is none"));
    else if (found->verdict != Verdict::not_applicable)
      judgeByUser(wanted.limit, *found);
  }
  for (const Check& check : result.checks)
    if (check.limit_by == LimitBy::user) result.limits = LimitBy::user;
  result.verdict = overall(result.checks);
}

void addProvenance(const Scenario& scenario, const std::string& subject, ValidationResult& result) {
  const BuildProvenance& build = buildProvenance();
  result.provenance = {{"scenario file", scenario.file.filename().string()},
                       {"scenario sha1", sha1(scenario.text)},
                       {"subject", subject},
                       {"ursula", build.version},
                       {"commit", build.commit},
                       {"compiler", build.compiler},
                       {"flags", build.flags},
                       {"build type", build.build_type},
                       {"Eigen", build.eigen},
                       {"Boost", build.boost},
                       {"Simbody", build.simbody},
                       {"MuJoCo", mujocoVersion()},
                       {"trajectory", scenario.trajectory->kind()},
                       {"duration", fmt::format("{} s", scenario.trajectory->duration())},
                       {"samples", fmt::format("{}", scenario.simulation.samples)},
                       {"integrator", name(scenario.simulation.integrator)},
                       {"tolerance", fmt::format("{:g}", scenario.simulation.tolerance)}};
}

void addPicture(const Scenario& scenario, ValidationResult& result) {
  constexpr std::size_t smooth_to_the_eye = 601;
  const std::vector<double>* t = result.timeseries.find("t_s");
  if (t != nullptr && !t->empty()) result.picture = makePicture(scenario, atMost(smooth_to_the_eye, *t));
}

void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result, const Units& units) {
  double torque = 0, torque_error = 0, acceleration = 0, acceleration_error = 0;
  for (const PointwiseSample& sample : samples) {
    torque = std::max(torque, sample.torques_simbody.cwiseAbs().maxCoeff());
    torque_error = larger(torque_error, sample.torque.error);
    const double length = sample.conditioning.length;
    acceleration = std::max(acceleration, sample.motion.p_ddot.norm() + length * sample.motion.omega_dot.norm());
    acceleration_error = larger(acceleration_error, sample.acceleration.error);
  }
  long evaluations = 0;
  std::size_t steps = 0;
  double growth = 0;
  for (const WindowedReplay& window : windows) {
    evaluations += window.replay.evaluations;
    steps += window.replay.steps.size() - (window.replay.steps.empty() ? 0 : 1);
    for (double value : window.window.growth) growth = std::max(growth, value);
  }
  for (const WindowedReplay& window : windows) {
    const Replay& replay = window.replay;
    if (replay.gave_up.empty() && !replay.left_path) continue;
    const double t = replay.left_path && !replay.steps.empty() ? replay.steps.back().t : replay.stopped_at;
    const std::string why = replay.left_path ? "P was off by more than the platform's size" : replay.gave_up;
    result.findings.emplace_back("replay stopped", fmt::format("stopped at t = {:.6g} s: {}", t * units.time, why));
  }
  const std::vector<std::pair<std::string, std::string>> findings = {
      {"largest torque", fmt::format("{:.6g} N m", torque * units.torque())},
      {"torque error, relative to the largest", fmt::format("{:.3g}", torque > 0 ? torque_error / torque : 0)},
      {"largest platform acceleration", fmt::format("{:.6g} m/s^2", acceleration * units.acceleration())},
      {"acceleration error, relative to the largest",
       acceleration > 0 ? fmt::format("{:.3g}", acceleration_error / acceleration) : "none commanded"},
      {"largest condition number of B", nearestToSingular(samples, units)},
      {"smallest |sin theta|", nearestToEdge(samples, units)},
      {"replay tolerance", windows.empty() ? "–" : fmt::format("{:.3g}", windows.front().replay.tolerance)},
      {"replay windows", fmt::format("{}", windows.size())},
      {"replay steps", fmt::format("{}", steps)},
      {"replay derivative evaluations", fmt::format("{}", evaluations)},
      {"growth of a velocity deviation in a window", fmt::format("{:.4g} m/(m/s)", growth * units.time)},
  };
  result.findings.insert(result.findings.end(), findings.begin(), findings.end());
}

}  // namespace ursula
