#include "validation/outside/outside_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <unordered_map>

#include "base/deadline.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Thrown after the solver has thrown. It is no std::exception, because an experiment turns those into results.
struct SolverStopped {};

bool same(const Motion<double>& a, const Motion<double>& b) { return a.t == b.t && sameState(a, b); }

/// The longest call under a time limit, s, and how many more motions than before one may have.
constexpr double longest_call = 0.25, most_more = 8;

/// Asks the solver, remembers its last answers, and stores its exception. Under a time limit it asks in pieces.
class Asking {
 public:
  Asking(const OutsideSolver& solver, double time_limit) : solver_(solver), deadline_(time_limit) {}

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
      answers = deadline_.isSet() ? inPieces(motions) : answersTo(motions);
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

  /// The pieces grow until a call takes long, because the rate is unknown at first.
  std::vector<Vector6d> inPieces(const std::vector<Motion<double>>& motions) {
    using Clock = std::chrono::steady_clock;
    std::vector<Vector6d> out;
    for (auto from = motions.begin(), to = from; from != motions.end(); from = to) {
      deadline_.require();
      to += std::min(piece_, motions.end() - from);
      const Clock::time_point begun = Clock::now();
      const std::vector<Vector6d> some = answersTo({from, to});
      const double share = std::chrono::duration<double>(Clock::now() - begun).count() / longest_call;
      out.insert(out.end(), some.begin(), some.end());
      if (to - from == piece_ || share > 1)
        piece_ = std::max(1L, std::lround(static_cast<double>(to - from) / std::max(share, 1 / most_more)));
    }
    return out;
  }

  OutsideSolver solver_;
  Deadline deadline_;
  long piece_ = 1;  ///< motions in a call
  std::mutex mutex_;
  std::unordered_map<double, Answer> known_;  ///< by instant, since a solver is asked along one motion
  std::vector<Answered> all_;
  std::exception_ptr thrown_;
};

}  // namespace

ValidationResult validateOutside(const Scenario& scenario, const OutsideSolver& solver,
                                 const ValidationOptions& options) {
  const auto asking = std::make_shared<Asking>(solver, options.time_limit);
  Subject subject;
  subject.name = solver.name;
  subject.called_by = solver.called_by;
  subject.torques = [asking](const Motion<double>& motion) { return asking->one(motion); };
  subject.foresee = [asking](const std::vector<Motion<double>>& motions) { asking->foresee(motions); };
  subject.answers = [asking] { return asking->answers(); };
  try {
    ValidationResult result = validate(scenario, subject, options);
    asking->rethrow();  // an engine may have hidden it
    return result;
  } catch (...) {
    asking->rethrow();  // it came first
    throw;
  }
}

}  // namespace ursula
