#include "parts/prove/prove.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "base/errors.h"
#include "base/start_threads.h"
#include "model/instants.h"
#include "nocsolver/errors.h"
#include "parts/prove/defects.h"
#include "parts/random/random_scenario.h"
#include "report/files/report.h"
#include "validation/samples/pointwise.h"
#include "validation/validate.h"

namespace ursula {
namespace {

/// Samples of one run among many: about three for each step of the replay.
constexpr int samples_per_run = 101;
constexpr int samples_of_sensitivity = 31;

/// Simbody's torques and their limits, which tell whether a subject's torques are caught.
class TorqueReference {
 public:
  explicit TorqueReference(const Scenario& scenario)
      : samples_(runPointwise(scenario, nocSubject(*scenario.manipulator, scenario.load),
                              equallySpaced(scenario.trajectory->duration(), samples_of_sensitivity))) {
    largest_ = largestTorque(samples_);
  }

  /// Returns the change of torque relative to the largest, NaN if an answer is missing; nullopt if nothing is caught.
  std::optional<double> changeIfCaught(const Subject& subject) const {
    double change = 0;
    bool beyond = false;
    try {
      for (const PointwiseSample& sample : samples_) {
        const double error =
            (subject.torques(sample.motion) - sample.torques_simbody).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
        change = larger(change, error);
        beyond |= !(error <= sample.torque.limit);
      }
    } catch (const PoseError&) {
      return std::nan("");  // a missing answer also counts as caught
    }
    return beyond ? std::optional(change / largest_) : std::nullopt;
  }

 private:
  std::vector<PointwiseSample> samples_;
  double largest_ = 0;
};

/// Lowers the error by decades while it is caught, then bisects the last decade to one in a hundred. A larger error is
/// taken to be caught if a smaller one is.
Sensitivity findSensitivity(const Scenario& scenario, const TorqueReference& reference, const Parameter& parameter) {
  Sensitivity out{parameter.path, name(parameter.group()), std::numeric_limits<double>::infinity(), 0};
  const auto tryError = [&](double exponent) {
    const double relative = std::pow(10, exponent);
    std::optional<double> change = std::nan("");
    try {
      change = reference.changeIfCaught(disturbedSubject(scenario, parameter, relative));
    } catch (const InvalidParameter&) {
      // An impossible machine is refused before any check.
    }
    if (!change) return false;
    out.smallest_caught = relative;
    out.torque_change = *change;
    return true;
  };
  double exponent = -1;
  if (!tryError(exponent)) return out;
  while (exponent > -16 && tryError(exponent - 1)) exponent -= 1;
  for (double step = 0.5; step > 0.002; step /= 2)
    if (tryError(exponent - step)) exponent -= step;
  return out;
}

}  // namespace

Scenario sampledForMany(Scenario scenario) {
  scenario.simulation.samples = samples_per_run;
  return scenario;
}

std::vector<Sensitivity> proveSensitivities(const Scenario& scenario) {
  const TorqueReference reference(scenario);
  std::vector<Sensitivity> out;
  for (const Parameter& parameter : allParameters(*scenario.manipulator))
    out.push_back(findSensitivity(scenario, reference, parameter));
  return out;
}

RandomOutcomes proveRandom(std::uint64_t seed, int count, int jobs, const std::function<void(int)>& done,
                           RandomKind kind) {
  std::vector<Verdict> verdicts(count, Verdict::fail);
  std::vector<std::string> why(count);
  std::vector<std::vector<Check>> checks(count);
  inParallel(jobs, count, [&](int k) {
    const Scenario scenario = sampledForMany(randomScenario(seed + k, kind));
    ValidationOptions options;
    options.budget = false;
    const ValidationResult result = validate(scenario, options);
    verdicts[k] = result.verdict;
    checks[k] = result.checks;
    if (result.verdict != Verdict::pass) why[k] = worstText(seed + k, result.checks);
    done(count);
  });
  RandomOutcomes out;
  out.runs = count;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i] == Verdict::pass) ++out.passed;
    if (verdicts[i] == Verdict::fail) out.failed.push_back(why[i]);
    if (verdicts[i] == Verdict::inconclusive) out.inconclusive.push_back(why[i]);
    for (const Check& check : checks[i]) {
      if (!(check.limit > 0)) continue;
      double& share = out.largest_share[check.name];
      share = larger(share, check.value / check.limit);
    }
  }
  return out;
}

std::string worstText(std::uint64_t seed, const std::vector<Check>& checks) {
  const Check* worst = worstCheck(checks);
  return worst == nullptr ? ""
                          : fmt::format("seed {}: {} {:.3g} of {:.3g} {}: {}", seed, worst->name, worst->value,
                                        worst->limit, worst->unit, worst->why);
}

int weakDefects(const std::vector<DefectOutcome>& outcomes) {
  return static_cast<int>(std::count_if(outcomes.begin(), outcomes.end(), [](const DefectOutcome& outcome) {
    return outcome.shows && !outcome.caught();
  }));
}

std::string caughtBy(const CheckProof& proof, std::size_t most) {
  const std::vector<std::string>& names = proof.alone.empty() ? proof.first : proof.alone;
  std::string out;
  for (std::size_t k = 0; k < std::min(most, names.size()); ++k) out += (k > 0 ? "; " : "") + names[k];
  return names.size() > most ? out + fmt::format("; and {} more", names.size() - most) : out;
}

int idleChecks(const std::vector<CheckProof>& checks) {
  return static_cast<int>(
      std::count_if(checks.begin(), checks.end(), [](const CheckProof& proof) { return !isNeeded(proof); }));
}

std::vector<std::string> catchingChecks(const std::vector<DefectOutcome>& outcomes) {
  std::vector<std::string> checks;
  for (const DefectOutcome& outcome : outcomes)
    for (const std::string& check : outcome.caught_by)
      if (std::find(checks.begin(), checks.end(), check) == checks.end()) checks.push_back(check);
  return checks;
}

std::vector<SensitivityGroup> groupsOf(const std::vector<Sensitivity>& sensitivities) {
  std::map<std::string, SensitivityGroup> groups;
  for (const Sensitivity& each : sensitivities) {
    SensitivityGroup& group = groups[each.group];
    group.name = each.group;
    ++group.count;
    if (std::isinf(each.smallest_caught)) {
      ++group.unseen;
      continue;
    }
    group.smallest = std::min(group.smallest, each.smallest_caught);
    group.largest_change = std::max(group.largest_change, each.torque_change);  // which a NaN leaves
    if (each.smallest_caught > group.worst.smallest_caught) group.worst = each;
  }
  std::vector<SensitivityGroup> out;
  for (const auto& [name, group] : groups) out.push_back(group);
  return out;
}

}  // namespace ursula
