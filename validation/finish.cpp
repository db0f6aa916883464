#include "validation/finish.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/uuid/detail/sha1.hpp>

#include "model/mujoco_loop.h"
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

/// κ(B): infinite where the pose is singular.
std::string nearestToSingular(const std::vector<PointwiseSample>& samples) {
  const PointwiseSample& at = *std::max_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.kappa_B < b.conditioning.kappa_B;
  });
  return fmt::format("{:.4g}, at t = {:.6g} s", at.conditioning.kappa_B, at.motion.t);
}

/// |sin θ|: 0 where a leg is stretched or folded.
std::string nearestToEdge(const std::vector<PointwiseSample>& samples) {
  const PointwiseSample& at = *std::min_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.smallest_sine < b.conditioning.smallest_sine;
  });
  return fmt::format("{:.4g}, leg {} at t = {:.6g} s", at.conditioning.smallest_sine,
                     at.conditioning.smallest_sine_leg + 1, at.motion.t);
}

}  // namespace

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

void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result) {
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
  const std::vector<std::pair<std::string, std::string>> findings = {
      {"largest torque", fmt::format("{:.6g} N m", torque)},
      {"torque error, relative to the largest", fmt::format("{:.3g}", torque > 0 ? torque_error / torque : 0)},
      {"largest platform acceleration", fmt::format("{:.6g} m/s^2", acceleration)},
      {"acceleration error, relative to the largest",
       acceleration > 0 ? fmt::format("{:.3g}", acceleration_error / acceleration) : "none commanded"},
      {"largest condition number of B", nearestToSingular(samples)},
      {"smallest |sin theta|", nearestToEdge(samples)},
      {"replay tolerance", windows.empty() ? "–" : fmt::format("{:.3g}", windows.front().replay.tolerance)},
      {"replay windows", fmt::format("{}", windows.size())},
      {"replay steps", fmt::format("{}", steps)},
      {"replay derivative evaluations", fmt::format("{}", evaluations)},
      {"growth of a velocity deviation in a window", fmt::format("{:.4g} m/(m/s)", growth)},
  };
  result.findings.insert(result.findings.end(), findings.begin(), findings.end());
}

}  // namespace ursula
