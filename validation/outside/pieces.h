#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/deadline.h"

namespace ursula {

/// Asks a slow solver in pieces of about a quarter of a second, so that a deadline holds and progress is told between
/// them. Without either it asks for all at once.
class Pieces {
 public:
  using Told = std::function<void(long asked)>;
  explicit Pieces(Deadline deadline, Told told = nullptr) : deadline_(std::move(deadline)), told_(std::move(told)) {}

  /// Returns `ask` of the questions, which returns a vector with as many answers. The pieces grow until a call takes
  /// long, because the rate is unknown at first. Throws OutOfTime between two.
  template <class Question, class Ask>
  auto answers(const std::vector<Question>& questions, const Ask& ask) {
    using Clock = std::chrono::steady_clock;
    if (!deadline_.isSet() && !told_) return ask(questions);
    decltype(ask(questions)) out;
    for (auto from = questions.begin(), to = from; from != questions.end(); from = to) {
      deadline_.require();
      to += std::min(piece_, questions.end() - from);
      const Clock::time_point begun = Clock::now();
      auto some = ask(std::vector<Question>(from, to));
      const double share = std::chrono::duration<double>(Clock::now() - begun).count() / longest_call;
      out.insert(out.end(), some.begin(), some.end());
      asked_ += to - from;
      if (told_) told_(asked_);
      if (to - from == piece_ || share > 1)
        piece_ = std::max(1L, std::lround(static_cast<double>(to - from) / std::max(share, 1 / most_more)));
    }
    return out;
  }

 private:
  /// The longest call, s, and how many more questions than before one may have.
  static constexpr double longest_call = 0.25, most_more = 8;

  Deadline deadline_;
  Told told_;
  long piece_ = 1, asked_ = 0;  ///< questions in a call, and in all
};

/// A solver is asked at most so many questions, unless somebody wants it thorough; then some 20,000 are usual.
constexpr int most_questions = 2000, usual_questions = 20000;

/// What is told of the questions so far: never all, since what follows takes time too.
inline double shareOfQuestions(long asked, bool thorough) {
  return std::min(static_cast<double>(asked) / (thorough ? usual_questions : most_questions), 0.99);
}

}  // namespace ursula
