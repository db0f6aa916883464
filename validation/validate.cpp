#include "validation/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/uuid/detail/sha1.hpp>
#include <cmath>

#include "validation/judge_replay.h"
#include "validation/pointwise.h"
#include "validation/provenance.h"
#include "validation/timeseries.h"

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

/// Limits along the motion, between the pointwise samples.
class SampledLimit {
 public:
  explicit SampledLimit(const std::vector<PointwiseSample>& samples) : samples_(samples) {}

  /// The larger of the two samples beside t.
  double operator()(double t) const {
    const auto after = std::lower_bound(samples_.begin(), samples_.end(), t,
                                        [](const PointwiseSample& sample, double at) { return sample.motion.t < at; });
    const auto last = static_cast<std::ptrdiff_t>(samples_.size()) - 1;
    const auto i = static_cast<std::size_t>(std::min(after - samples_.begin(), last));
    return std::max(samples_[i].conditioning.accelerationRounding(),
                    samples_[i == 0 ? 0 : i - 1].conditioning.accelerationRounding());
  }

 private:
  const std::vector<PointwiseSample>& samples_;
};

/// Steps a second that a replay takes, for planning only: the judgement counts the steps taken.
double plannedStepRate(double duration) { return 128 / std::min(duration, 3.0); }

double positionScale(const std::vector<PointwiseSample>& samples) {
  double scale = 0;
  for (const PointwiseSample& sample : samples) scale = std::max(scale, sample.conditioning.position_scale);
  return scale;
}

std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const Subject& subject,
                                            const std::vector<PointwiseSample>& samples) {
  const double duration = scenario.trajectory->duration();
  const int intervals = std::max(300, static_cast<int>(std::ceil(40 * duration)));
  const Amplification amplification(scenario, intervals);
  const double rate = plannedStepRate(duration) * errorPerStep(scenario.simulation.tolerance, positionScale(samples));
  const SampledLimit acceleration(samples);
  const auto torques = [&](double t) { return subject.torques(scenario.trajectory->at(t)); };

  std::vector<WindowedReplay> windows;
  for (std::size_t first = 0; first + 1 < amplification.instants().size();) {
    WindowedReplay window;
    window.window =
        amplification.window(first, acceleration, rate, useful_replay_limit * amplification.length());
    ReplaySettings settings;
    settings.integrator = scenario.simulation.integrator;
    settings.tolerance = scenario.simulation.tolerance;
    settings.start = window.window.start();
    settings.end = window.window.end();
    window.replay = replay(scenario, torques, settings);
    first = window.window.last;
    windows.push_back(std::move(window));
  }
  return windows;
}

void applyAcceptance(const std::vector<AcceptanceLimit>& acceptance, std::vector<Check>& checks) {
  for (const AcceptanceLimit& wanted : acceptance) {
    const auto found = std::find_if(checks.begin(), checks.end(),
                                    [&wanted](const Check& check) { return check.name == wanted.check; });
    if (found == checks.end()) {
      checks.push_back(notMade(wanted.check, "", "[acceptance] names a check that was not made"));
      continue;
    }
    *found = judged(found->name, found->value, wanted.limit, found->unit,
                    fmt::format("[acceptance] of the scenario; derived: {:.3g}, {}", found->limit, found->basis),
                    found->why);
  }
}

void addProvenance(const Scenario& scenario, const Subject& subject, ValidationResult& result) {
  const BuildProvenance& build = buildProvenance();
  result.provenance = {{"scenario file", scenario.file.filename().string()},
                       {"scenario sha1", sha1(scenario.text)},
                       {"subject", subject.name},
                       {"ursula", build.version},
                       {"commit", build.commit},
                       {"compiler", build.compiler},
                       {"flags", build.flags},
                       {"build type", build.build_type},
                       {"Eigen", build.eigen},
                       {"Boost", build.boost},
                       {"Simbody", build.simbody},
                       {"trajectory", scenario.trajectory->kind()},
                       {"duration", fmt::format("{} s", scenario.trajectory->duration())},
                       {"samples", fmt::format("{}", scenario.simulation.samples)},
                       {"integrator", name(scenario.simulation.integrator)},
                       {"tolerance", fmt::format("{:g}", scenario.simulation.tolerance)}};
}

void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result) {
  double torque = 0, torque_error = 0, acceleration = 0, acceleration_error = 0, kappa_B = 0, sine = 1;
  for (const PointwiseSample& sample : samples) {
    torque = std::max(torque, sample.torques_simbody.cwiseAbs().maxCoeff());
    torque_error = std::max(torque_error, sample.torque.error);
    const double length = sample.conditioning.length;
    acceleration = std::max(acceleration, sample.motion.p_ddot.norm() + length * sample.motion.omega_dot.norm());
    acceleration_error = std::max(acceleration_error, sample.acceleration.error);
    kappa_B = std::max(kappa_B, sample.conditioning.kappa_B);
    sine = std::min(sine, sample.conditioning.smallest_sine);
  }
  long evaluations = 0;
  std::size_t steps = 0;
  double growth = 0;
  for (const WindowedReplay& window : windows) {
    evaluations += window.replay.evaluations;
    steps += window.replay.steps.size() - (window.replay.steps.empty() ? 0 : 1);
    for (double value : window.window.growth) growth = std::max(growth, value);
  }
  result.findings = {
      {"largest torque", fmt::format("{:.6g} N m", torque)},
      {"torque error, relative to the largest", fmt::format("{:.3g}", torque > 0 ? torque_error / torque : 0)},
      {"largest platform acceleration", fmt::format("{:.6g} m/s^2", acceleration)},
      {"acceleration error, relative to the largest",
       acceleration > 0 ? fmt::format("{:.3g}", acceleration_error / acceleration) : "none commanded"},
      {"largest condition number of B", fmt::format("{:.4g}", kappa_B)},
      {"smallest |sin theta|", fmt::format("{:.4g}", sine)},
      {"replay windows", fmt::format("{}", windows.size())},
      {"replay steps", fmt::format("{}", steps)},
      {"replay derivative evaluations", fmt::format("{}", evaluations)},
      {"growth of a velocity deviation in a window", fmt::format("{:.4g} m/(m/s)", growth)},
  };
}

}  // namespace

std::vector<double> equallySpaced(double duration, int count) {
  std::vector<double> instants;
  instants.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) instants.push_back(duration * k / (count - 1));
  return instants;
}

ValidationResult validate(const Scenario& scenario, const Subject& subject) {
  ValidationResult result;
  result.scenario = scenario.name;
  const auto samples =
      runPointwise(scenario, subject, equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples));
  result.checks = judgePointwise(samples, static_cast<bool>(subject.kinematics));
  std::vector<WindowedReplay> windows;
  const bool answers =
      std::none_of(samples.begin(), samples.end(), [](const PointwiseSample& sample) { return !sample.refused.empty(); });
  if (answers) windows = replayInWindows(scenario, subject, samples);
  for (Check& check : judgeReplay(windows, positionScale(samples), samples.front().conditioning.length))
    result.checks.push_back(std::move(check));
  applyAcceptance(scenario.acceptance, result.checks);
  result.verdict = overall(result.checks);
  result.timeseries = validationSeries(samples, windows);
  addFindings(samples, windows, result);
  addProvenance(scenario, subject, result);
  return result;
}

ValidationResult validate(const Scenario& scenario) {
  return validate(scenario, nocSubject(*scenario.manipulator, scenario.load));
}

}  // namespace ursula
