#include "validation/prove.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

#include "model/errors.h"
#include "nocsolver/errors.h"
#include "validation/defects.h"
#include "validation/pointwise.h"
#include "validation/random_scenario.h"
#include "validation/validate.h"

namespace ursula {
namespace {

/// Instants for one of many validations: enough for three a step of the replay.
constexpr int samples_in_a_row = 101;
constexpr int samples_of_sensitivity = 31;

bool equal(const JointVariables<double>& a, const JointVariables<double>& b) {
  return a.phi == b.phi && a.psi == b.psi && a.theta == b.theta;
}

bool equal(const KinematicAnswer& a, const KinematicAnswer& b) {
  for (std::size_t i = 0; i < body_count; ++i)
    if (a.bodies[i].c != b.bodies[i].c || a.bodies[i].twist != b.bodies[i].twist ||
        a.bodies[i].twist_rate != b.bodies[i].twist_rate)
      return false;
  return equal(a.joints.q, b.joints.q) && equal(a.joints.q_dot, b.joints.q_dot) &&
         equal(a.joints.q_ddot, b.joints.q_ddot) && a.T == b.T && a.T_rate == b.T_rate;
}

/// False where every answer is the right one's to the last bit: the scenario has nothing for the defect to spoil.
bool shows(const Scenario& scenario, const Subject& subject) {
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  // Instants that are no samples of anything.
  for (int k = 0; k < samples_of_sensitivity; ++k) {
    const Motion<double> motion = scenario.trajectory->at(scenario.trajectory->duration() * (k + 0.37) / 31);
    try {
      if (subject.torques(motion) != right.torques(motion)) return true;
      if (!equal(subject.kinematics(motion), right.kinematics(motion))) return true;
    } catch (const PoseError&) {
      return true;
    }
  }
  return false;
}

DefectOutcome judgeDefect(const Scenario& scenario, const Defect& defect) {
  DefectOutcome outcome{defect.name, defect.group, {}, true};
  const Subject subject = defect.subject(scenario);
  outcome.shows = shows(scenario, subject);
  ValidationOptions options;
  options.ladder = false;
  options.reactions = false;
  for (const Check& check : validate(scenario, subject, options).checks)
    if (check.verdict == Verdict::fail) outcome.caught_by.push_back(check.name);
  return outcome;
}

/// The torques of the right machine by Simbody, and whether other torques would be caught.
class TorqueReference {
 public:
  explicit TorqueReference(const Scenario& scenario)
      : samples_(runPointwise(scenario, nocSubject(*scenario.manipulator, scenario.load),
                              equallySpaced(scenario.trajectory->duration(), samples_of_sensitivity))) {
    for (const PointwiseSample& sample : samples_)
      largest_ = std::max(largest_, sample.torques_simbody.cwiseAbs().maxCoeff());
  }

  /// The change of torque relative to the largest, negative where it is not caught.
  double caught(const Subject& subject) const {
    double change = 0;
    bool beyond = false;
    try {
      for (const PointwiseSample& sample : samples_) {
        const double error =
            (subject.torques(sample.motion) - sample.torques_simbody).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
        change = std::max(change, error);
        beyond |= !(error <= sample.torque.limit);
      }
    } catch (const PoseError&) {
      return 1;  // no answer is caught as well
    }
    return beyond ? change / largest_ : -1;
  }

 private:
  std::vector<PointwiseSample> samples_;
  double largest_ = 0;
};

/// Sixteen decades from 0.1 down, then the last of them halved until what is left is a hundredth of the error.
Sensitivity findSensitivity(const Scenario& scenario, const TorqueReference& reference, const Parameter& parameter) {
  Sensitivity out{parameter.name, parameter.group, std::numeric_limits<double>::infinity(), 0};
  const auto tryError = [&](double exponent) {
    const double relative = std::pow(10, exponent);
    double change = 1;
    try {
      change = reference.caught(disturbedSubject(scenario, parameter, relative));
    } catch (const InvalidParameter&) {
      // No machine can be so: refused before any check.
    }
    if (change < 0) return false;
    out.smallest_caught = relative;
    out.torque_change = change;
    return true;
  };
  double exponent = -1;
  if (!tryError(exponent)) return out;
  while (exponent > -16 && tryError(exponent - 1)) exponent -= 1;
  for (double step = 0.5; step > 0.002; step /= 2)
    if (tryError(exponent - step)) exponent -= step;
  return out;
}

Scenario sampled(Scenario scenario) {
  scenario.simulation.samples = samples_in_a_row;
  return scenario;
}

}  // namespace

std::string roadOf(const std::string& check) {
  if (check == "torque.maximal") return "maximal coordinates";
  if (check == "torque.mujoco") return "MuJoCo";
  if (check == "kinematics.jacobian_difference" || check.rfind("invariance.", 0) == 0) return check;
  return "Simbody";  // torque.twin, too: another topology, by the same builder in the same engine
}

void inParallel(int jobs, int count, const std::function<void(int)>& task) {
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  const auto work = [&] {
    for (int k = next++; k < count; k = next++) try {
        task(k);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(guard);
        if (!failure) failure = std::current_exception();
      }
  };
  std::vector<std::thread> threads;
  for (int k = 1; k < std::min(jobs, count); ++k) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

std::vector<DefectOutcome> proveDefects(const Scenario& scenario, int jobs, const std::function<void(int)>& done) {
  const std::vector<Defect> defects = allDefects();
  const Scenario quick = sampled(scenario);
  std::vector<DefectOutcome> outcomes(defects.size());
  inParallel(jobs, static_cast<int>(defects.size()), [&](int k) {
    outcomes[static_cast<std::size_t>(k)] = judgeDefect(quick, defects[static_cast<std::size_t>(k)]);
    done(static_cast<int>(defects.size()));
  });
  return outcomes;
}

std::vector<Sensitivity> proveSensitivities(const Scenario& scenario) {
  const TorqueReference reference(scenario);
  std::vector<Sensitivity> out;
  for (const Parameter& parameter : allParameters()) out.push_back(findSensitivity(scenario, reference, parameter));
  return out;
}

RandomOutcomes proveRandom(std::uint64_t seed, int count, int jobs, const std::function<void(int)>& done) {
  std::vector<Verdict> verdicts(static_cast<std::size_t>(count), Verdict::fail);
  std::vector<std::string> why(static_cast<std::size_t>(count));
  std::vector<std::vector<Check>> checks(static_cast<std::size_t>(count));
  inParallel(jobs, count, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    const Scenario scenario = sampled(randomScenario(seed + i));
    ValidationOptions options;
    options.budget = false;
    const ValidationResult result = validate(scenario, options);
    verdicts[i] = result.verdict;
    checks[i] = result.checks;
    for (const Check& check : result.checks)
      if (check.verdict != Verdict::pass && why[i].empty())
        why[i] = fmt::format("seed {}: {} {:.3g} of {:.3g} {}: {}", seed + i, check.name, check.value, check.limit,
                             check.unit, check.why);
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
      share = std::max(share, check.value / check.limit);
    }
  }
  return out;
}

}  // namespace ursula
