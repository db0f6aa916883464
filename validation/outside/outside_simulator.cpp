#include "validation/outside/outside_simulator.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>

#include "base/deadline.h"
#include "base/dense.h"
#include "model/instants.h"
#include "validation/checks/families.h"
#include "validation/checks/judges.h"
#include "validation/checks/tolerance.h"
#include "validation/evidence/reference.h"
#include "validation/findings/findings.h"
#include "validation/outside/needed_efforts.h"
#include "validation/outside/pieces.h"
#include "validation/subject/asked_instants.h"
#include "validation/verdict/effort_words.h"

namespace ursula {
namespace {

/// Instants at which efforts are found, some of the samples and some between them. Beside these a simulator is asked
/// some 280 times for `direct.*`, and some 400 times for a cause.
constexpr int samples_asked = 151, between_asked = 150, for_the_rest = 680;
constexpr const char* of_accelerations = "what the rounding of accelerations makes of torques";

/// Thrown after the simulator has thrown, as in outside_solver.cpp.
struct SimulatorStopped {};

/// Asks the simulator, counts, and stores its exception.
class AskedSimulator {
 public:
  AskedSimulator(const Scenario& scenario, const OutsideSimulator& simulator, const ValidationOptions& options,
                 const Deadline& deadline)
      : noc_(nocSubject(*scenario.manipulator, scenario.load)),
        simulator_(simulator),
        deadline_(deadline),
        tell_(options.progress) {}

  std::vector<Vector6d> accelerations(std::vector<Motion<double>> states, const std::vector<Vector6d>& efforts) {
    const std::lock_guard<std::mutex> one_at_a_time(mutex_);
    if (thrown_) throw SimulatorStopped{};
    deadline_.require();
    for (Motion<double>& state : states) state.p_ddot = state.omega_dot = Vector3d::Zero();
    asked_ += static_cast<long>(states.size());
    try {
      std::vector<Vector6d> out = simulator_.accelerations(states, efforts);
      if (tell_) tell_(shareOfQuestions(asked_, false), "asking the simulator");
      return out;
    } catch (const OutOfTime&) {
      throw;
    } catch (...) {
      thrown_ = std::current_exception();
      throw SimulatorStopped{};
    }
  }

  /// Returns the efforts that the motions need; `states` then has what is known of each. A difference of accelerations
  /// in a state's unit counts from `rounding` on.
  std::vector<Vector6d> efforts(const std::vector<Motion<double>>& motions, std::vector<WantedState>& states,
                                long reserve) {
    const AccelerationsIn simulator = [&](const std::vector<std::size_t>& which,
                                          const std::vector<Eigen::VectorXd>& efforts) {
      std::vector<Motion<double>> asked;
      for (const std::size_t k : which) asked.push_back(motions[k]);
      const std::vector<Vector6d> found = accelerations(asked, {efforts.begin(), efforts.end()});
      return std::vector<Eigen::VectorXd>(found.begin(), found.end());
    };
    const std::vector<Eigen::VectorXd> found =
        neededEfforts(states, simulator, most_questions - reserve - asked_, unmoved_);
    return {found.begin(), found.end()};
  }

  /// What is right in a state. Accelerations are affine in the efforts, so differences give the inertia.
  WantedState wanted(const Motion<double>& motion, double length) const {
    WantedState out;
    const Vector6d efforts = noc_.torques(motion), accelerations = noc_.accelerations(motion, efforts);
    const double size = std::max(efforts.cwiseAbs().maxCoeff(), 1.0);
    Matrix6d mobility;
    for (int k = 0; k < motor_count; ++k)
      mobility.col(k) = (noc_.accelerations(motion, efforts + size * Vector6d::Unit(k)) - accelerations) / size;
    Vector6d wanted, scale;
    wanted << motion.omega_dot, motion.p_ddot;
    scale << Vector3d::Constant(length), Vector3d::Ones();
    out.wanted = wanted, out.efforts = efforts, out.scale = scale;
    out.inertia = inverseOf(mobility);
    return out;
  }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }
  std::string unmoved() const { return unmoved_.words(); }

 private:
  Subject noc_;
  OutsideSimulator simulator_;
  Deadline deadline_;
  std::function<void(double, const char*)> tell_;
  std::mutex mutex_;
  long asked_ = 0;
  Unmoved unmoved_{{"alpha_x", "alpha_y", "alpha_z", "a_x", "a_y", "a_z"}};
  std::exception_ptr thrown_;
};

/// The simulator as a solver, in SI.
Subject subjectOf(const std::shared_ptr<AskedSimulator>& asked, const JudgedSubject& about, double length) {
  Subject out;
  static_cast<JudgedSubject&>(out) = about;
  out.accelerations = [asked](const Motion<double>& motion, const Vector6d& efforts) {
    return asked->accelerations({motion}, {efforts}).front();
  };
  out.torques = [asked, length](const Motion<double>& motion) {
    std::vector<WantedState> states = {asked->wanted(motion, length)};
    states.front().rounding =
        1e-12 * inverseOf(states.front().inertia).cwiseAbs().maxCoeff() * states.front().efforts.cwiseAbs().maxCoeff();
    return asked->efforts({motion}, states, 0).front();
  };
  out.answers = [] { return std::vector<Answered>(); };
  return out;
}

std::vector<double> instantsOf(const Scenario& scenario) {
  const double duration = scenario.trajectory->duration();
  std::vector<double> out = equallySpaced(duration, std::min(scenario.simulation.samples, samples_asked));
  for (const double t : goldenInstants(duration, between_asked)) out.push_back(t);
  std::sort(out.begin(), out.end());
  const auto near = [duration](double a, double b) { return b - a < 1e-9 * duration; };
  out.erase(std::unique(out.begin(), out.end(), near), out.end());
  out.back() = duration;
  return out;
}

/// The efforts that the commanded motion needs in the simulator, each as uncertain as accelerations round.
TorqueFile effortsIn(const Scenario& scenario, const Reference& reference, AskedSimulator& asked,
                     const std::string& name) {
  const Units& units = reference.natural.units;
  GivenTorques out{name, instantsOf(scenario), {}};
  std::vector<Motion<double>> motions;
  std::vector<WantedState> states;
  for (const double t : out.t) {
    motions.push_back(scenario.trajectory->at(t));
    const Conditioning at = reference.rounding().profile.at(reference.natural.transformed(motions.back()));
    states.push_back(asked.wanted(motions.back(), at.length * units.length));
    states.back().rounding = at.rounding(Rounded::direct) * units.acceleration();
  }
  out.torques = asked.efforts(motions, states, for_the_rest);
  TorqueFile file = torqueFileOf(out, scenario.manipulator->motors());
  for (std::size_t k = 0; k < file.rows(); ++k)
    for (int i = 0; i < motor_count; ++i) {
      const double of_accelerations_here =
          states[k].rounding * states[k].inertia.row(i).cwiseQuotient(states[k].scale.transpose()).norm();
      file.torque_precision[k](i) = std::max(file.torque_precision[k](i), of_accelerations_here);
    }
  file.derived_from = of_accelerations;
  return file;
}

/// `direct.*`, reported alone if a tolerance judges the efforts.
std::vector<Check> directChecks(const Scenario& scenario, const Reference& reference, const Subject& subject) {
  std::vector<PointwiseSample> samples;
  for (const Conditions& each : reference.rounding().conditions) {
    samples.emplace_back();
    samples.back().motion = each.motion;
    samples.back().conditioning = each.conditioning;
  }
  const Subject natural = transformed(subject, reference.natural);
  const RoundingProfile& profile = reference.rounding().profile;
  const Units& units = reference.natural.units;
  std::vector<Check> out = {judgeDirect(reference.direct(), natural, samples, profile, units),
                            judgeOffPath(reference.direct(), natural, samples, profile, units)};
  checksInSi(units, out);
  if (!scenario.tolerance) return out;
  for (Check& check : out)
    check = notApplicable(check.name, check.unit, "a tolerance of torques judges the torques alone: " + check.why);
  return out;
}

/// A result that holds what time was left for: nothing.
ValidationResult outOfTime(const Scenario& scenario, const JudgedSubject& about, const OutOfTime& over) {
  ValidationResult result = emptyResult(scenario, about);
  SubjectHas has;
  has.out_of_time = over.what();
  conclude(scenario, has, 0, result);
  addEffortWords(result);
  return result;
}

}  // namespace

ValidationResult validateSimulator(const Scenario& scenario, const OutsideSimulator& simulator,
                                   const ValidationOptions& options) {
  const Deadline deadline(options.time_limit, options.asked_to_end);
  const JudgedSubject about{simulator.name, Formulation::external, simulator.called_by};
  const auto asked = std::make_shared<AskedSimulator>(scenario, simulator, options, deadline);
  try {
    const Reference reference(scenario, options.threads, deadline, {}, false);
    const TorqueFile file = effortsIn(scenario, reference, *asked, simulator.name);
    const double length = reference.rounding().conditions.front().conditioning.length * reference.natural.units.length;
    const Subject subject = subjectOf(asked, about, length);
    ExternalOptions external;
    external.asked_to_end = [deadline] { return deadline.isOver(); };
    external.threads = options.threads;
    external.about = about;
    external.more = [&] { return directChecks(scenario, reference, subject); };
    external.solver = &subject;
    external.no_cause = [&] { return asked->unmoved(); };
    ValidationResult result = validateExternal(scenario, file, external);
    asked->rethrow();
    return result;
  } catch (const OutOfTime& over) {
    return outOfTime(scenario, about, over);
  } catch (...) {
    asked->rethrow();
    throw;
  }
}

}  // namespace ursula
