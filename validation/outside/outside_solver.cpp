#include "validation/outside/outside_solver.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <unordered_map>

#include "base/deadline.h"
#include "validation/outside/pieces.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Thrown after the solver has thrown. It is no std::exception, because an experiment turns those into results.
struct SolverStopped {};

bool same(const Motion<double>& a, const Motion<double>& b) { return a.t == b.t && sameState(a, b); }

/// The samples of a motion that a solver of few questions is asked; half of them are for the instants between.
constexpr int most_samples = 1001;

/// Asks the solver, remembers its last answers, and stores its exception. Under a time limit it asks in pieces.
class Asking {
 public:
  Asking(const OutsideSolver& solver, const ValidationOptions& options)
      : solver_(solver), pieces_(Deadline(options.time_limit), toldOf(options)) {}

  Vector6d one(const Motion<double>& motion) {
    const std::lock_guard<std::mutex> one_at_a_time(mutex_);
    if (const Vector6d* known = find(motion)) return *known;
    if (known_.size() > most_foreseen) known_.clear();
    return ask({motion}).front();
  }

  void foresee(const std::vector<Motion<double>>& motions) {
    const std::lock_guard<std::mutex> one_at_a_time(mutex_);
    std::vector<Motion<double>> unknown;
    for (const Motion<double>& motion : motions)
      if (find(motion) == nullptr && (unknown.empty() || !same(unknown.back(), motion))) unknown.push_back(motion);
    if (unknown.empty()) return;
    if (known_.size() > most_kept) known_.clear();
    ask(unknown);
  }

  std::vector<Answered> answers() {
    const std::lock_guard<std::mutex> one_at_a_time(mutex_);
    return all_;
  }

  /// Rethrows the solver's exception, if any.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  struct Answer {
    Motion<double> motion;
    Vector6d torques;
  };
  /// Number of answers kept when others are foreseen: more than any integrator step asks again. The second limit
  /// exceeds the number foreseen at once.
  static constexpr std::size_t most_kept = 1024, most_foreseen = 1 << 18;

  const Vector6d* find(const Motion<double>& motion) const {
    const auto found = known_.find(motion.t);
    return found != known_.end() && same(found->second.motion, motion) ? &found->second.torques : nullptr;
  }

  std::vector<Vector6d> ask(const std::vector<Motion<double>>& motions) {
    if (thrown_) throw SolverStopped{};
    std::vector<Vector6d> answers;
    try {
      answers = pieces_.answers(motions, [this](const auto& some) { return answersTo(some); });
    } catch (const OutOfTime&) {
      throw;  // the validation's end, not the solver's
    } catch (...) {
      thrown_ = std::current_exception();
      throw SolverStopped{};
    }
    for (std::size_t k = 0; k < motions.size(); ++k) {
      known_[motions[k].t] = {motions[k], answers[k]};
      all_.push_back({motions[k].t, answers[k]});
    }
    return answers;
  }

  std::vector<Vector6d> answersTo(const std::vector<Motion<double>>& motions) const {
    std::vector<Vector6d> answers = solver_.torques(motions);
    if (answers.size() != motions.size())
      throw std::invalid_argument(solver_.name + ": " + std::to_string(answers.size()) + " answers to " +
                                  std::to_string(motions.size()) + " motions");
    return answers;
  }

  static Pieces::Told toldOf(const ValidationOptions& options) {
    if (!options.progress) return nullptr;
    return [tell = options.progress, thorough = options.thorough](long asked) {
      tell(shareOfQuestions(asked, thorough), "asking the solver");
    };
  }

  OutsideSolver solver_;
  Pieces pieces_;
  std::mutex mutex_;
  std::unordered_map<double, Answer> known_;  ///< by instant, since a solver is asked along one motion
  std::vector<Answered> all_;
  std::exception_ptr thrown_;
};

}  // namespace

ValidationResult validateOutside(const Scenario& scenario, const OutsideSolver& solver,
                                 const ValidationOptions& options) {
  const auto asking = std::make_shared<Asking>(solver, options);
  Scenario asked = scenario;
  ValidationOptions silent = options;
  silent.progress = nullptr;                                                 // the answers take nearly all of the time
  if (!options.asked_to_end) silent.threads = std::max(2, options.threads);  // one works while the solver does
  Subject subject;
  subject.name = solver.name;
  subject.called_by = solver.called_by;
  subject.torques = [asking](const Motion<double>& motion) { return asking->one(motion); };
  subject.foresee = [asking](const std::vector<Motion<double>>& motions) { asking->foresee(motions); };
  subject.answers = [asking] { return asking->answers(); };
  if (!options.thorough) {
    subject.most_questions = most_questions;
    asked.simulation.samples = std::min(asked.simulation.samples, most_samples);
  }
  try {
    ValidationResult result = validate(asked, subject, silent);
    asking->rethrow();  // an engine may have hidden it
    return result;
  } catch (...) {
    asking->rethrow();  // it came first
    throw;
  }
}

}  // namespace ursula
