#include <fmt/format.h>
#include <algorithm>
#include <limits>

#include "base/provenance.h"
#include "base/sha1.h"
#include "simbody/lapack_in_use.h"
#include "validation/findings/findings.h"
#include "validation/replay/replay.h"
#include "validation/verdict/effort_words.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

void addStopped(const std::vector<WindowedReplay>& windows, const Units& units, ValidationResult& result) {
  for (const WindowedReplay& window : windows) {
    const Replay& replay = window.replay;
    if (replay.gave_up.empty() && !replay.left_path) continue;
    const double t = replay.left_path && !replay.steps.empty() ? replay.steps.back().t : replay.stopped_at;
    const std::string why = replay.left_path ? "P was off by more than the platform's size" : replay.gave_up;
    result.findings.push_back({"replay stopped", fmt::format("stopped at t = {:.6g} s: {}", t * units.time, why)});
  }
}

void addReplayed(const std::vector<WindowedReplay>& windows, const Units& units, ValidationResult& result) {
  long evaluations = 0;
  std::size_t steps = 0;
  double growth = 0;
  for (const WindowedReplay& window : windows) {
    evaluations += window.replay.evaluations;
    steps += window.replay.steps.size() - (window.replay.steps.empty() ? 0 : 1);
    for (double value : window.window.growth) growth = larger(growth, value);
  }
  const auto add = [&result](const char* what, double value, const char* unit = "") {
    result.findings.push_back({what, "", value, none, unit});
  };
  add("replay tolerance", windows.front().replay.tolerance);
  add("replay windows", static_cast<double>(windows.size()));
  add("replay steps", static_cast<double>(steps));
  add("replay derivative evaluations", static_cast<double>(evaluations));
  add("growth of a velocity deviation in a window", growth * units.time, "m/(m/s)");
}

}  // namespace

const PointwiseSample& nearestToSingular(const std::vector<PointwiseSample>& samples) {
  return *std::max_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.kappa_B < b.conditioning.kappa_B;
  });
}

const PointwiseSample& nearestToEdge(const std::vector<PointwiseSample>& samples) {
  return *std::min_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.smallest_sine < b.conditioning.smallest_sine;
  });
}

void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result, const Units& units) {
  result.replay_windows = windows.size();
  if (samples.empty()) return;  // time ran out before the samples
  double acceleration = 0, acceleration_error = 0;
  for (const PointwiseSample& sample : samples) {
    const double length = sample.conditioning.length;
    acceleration = std::max(acceleration, sample.motion.p_ddot.norm() + length * sample.motion.omega_dot.norm());
    acceleration_error = larger(acceleration_error, sample.acceleration.error);
  }
  addStopped(windows, units, result);
  result.findings.push_back({"largest platform acceleration", "", acceleration * units.acceleration(), none, "m/s^2"});
  const double relative = acceleration > 0 ? acceleration_error / acceleration : none;
  result.findings.push_back({"acceleration error, relative to the largest", "none commanded", relative});
  const PointwiseSample &singular = nearestToSingular(samples), &edge = nearestToEdge(samples);
  result.findings.push_back(
      {"largest condition number of B", "", singular.conditioning.kappa_B, none, "", singular.motion.t * units.time});
  if (edge.conditioning.smallest_sine < 1)  // else no leg has a knee
    result.findings.push_back({"smallest |sin theta|", "", edge.conditioning.smallest_sine, none, "",
                               edge.motion.t * units.time, edge.conditioning.smallest_sine_leg + 1});
  if (!windows.empty()) addReplayed(windows, units, result);
}

namespace {

const char* inWords(Formulation formulation) {
  if (formulation == Formulation::noc) return "noc: T formed, efforts by (37), accelerations by (36)";
  return formulation == Formulation::fast ? "fast: the kernels that users call"
                                          : "external: a solver or file of the user";
}

/// The user's tolerance and how the subject was called.
void addAsked(const std::optional<EffortTolerance>& users, ValidationResult& result) {
  const auto add = [&result](const char* key, const std::string& text) { result.provenance.emplace_back(key, text); };
  const EffortTolerance tolerance = users.value_or(EffortTolerance{});
  if (tolerance.relative > 0) add("relative tolerance of efforts", fmt::format("{}", tolerance.relative));
  if (tolerance.absolute > 0) add("absolute tolerance of efforts", fmt::format("{}", tolerance.absolute));
  if (tolerance.any) add("any tolerance", "yes");
  if (!result.subject.map.empty()) add("columns named", result.subject.map);
  if (result.subject.called_by == CalledBy::solver) add("solver process", result.subject.name);
  if (result.subject.called_by == CalledBy::simulator) add("simulator process", result.subject.name);
  if (result.subject.called_by == CalledBy::trajectory) add("motion file", result.subject.name);
}

/// Adds what a scenario of either kind asks for, and by which build it was judged.
template <class AnyScenario>
void addProvenance(const AnyScenario& scenario, const JudgedSubject& subject, ValidationResult& result) {
  const BuildProvenance& build = buildProvenance();
  result.scenario = scenario.name;
  result.subject = subject;
  result.provenance = {{"scenario file", scenario.file.filename().string()},
                       {"scenario sha1", sha1(scenario.text)},
                       {"subject", subject.name},
                       {"formulation", inWords(subject.formulation)},
                       {"ursula", build.version},
                       {"commit", build.commit},
                       {"compiler", build.compiler},
                       {"flags", build.flags},
                       {"build type", build.build_type},
                       {"Eigen", build.eigen},
                       {"Boost", build.boost},
                       {"Simbody", build.simbody},
                       {"LAPACK", lapackInUse()}};
  for (auto& row : partProvenance()) result.provenance.push_back(std::move(row));
  const std::vector<std::pair<std::string, std::string>> asked = {
      {"trajectory", scenario.trajectory->kind()},
      {"duration", fmt::format("{} s", scenario.trajectory->duration())},
      {"samples", fmt::format("{}", scenario.simulation.samples)},
      {"integrator", name(scenario.simulation.integrator)},
      {"tolerance", fmt::format("{:g}", scenario.simulation.tolerance)}};
  result.provenance.insert(result.provenance.end(), asked.begin(), asked.end());
  addAsked(scenario.tolerance, result);
}

}  // namespace

ValidationResult emptyResult(const Scenario& scenario, const JudgedSubject& subject) {
  ValidationResult result;
  result.asked = std::make_shared<const Scenario>(scenario);
  result.effort = effortNoun(scenario.manipulator->motors());
  result.timeseries = validationSeries(*scenario.manipulator, {}, {});
  addProvenance(scenario, subject, result);
  return result;
}

ValidationResult emptyResult(const MechanismScenario& scenario, const JudgedSubject& subject) {
  ValidationResult result;
  const Mechanism& mechanism = *scenario.mechanism;
  std::size_t slide = 0;
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k) slide += mechanism.motor(k).slides() ? 1 : 0;
  result.effort = slide == 0 ? "torque" : slide == mechanism.motorCount() ? "force" : "effort";
  result.kind = "mechanism";
  addProvenance(scenario, subject, result);
  result.provenance.emplace_back("model file", scenario.model.filename().string());
  return result;
}

}  // namespace ursula
