#include "validation/outside/needed_efforts.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <limits>

#include "base/dense.h"

namespace ursula {
namespace {

/// The search for one state's efforts.
struct Search {
  Eigen::VectorXd efforts, residual, step, first_answer;
  Eigen::MatrixXd mobility;  ///< accelerations per effort
  double best = std::numeric_limits<double>::infinity();
  Eigen::VectorXd found;  ///< the efforts after the best answer, and its step
  bool ended = false;

  /// Takes an answer, and steps.
  void take(const WantedState& state, const Eigen::VectorXd& accelerations) {
    const Eigen::VectorXd now = state.wanted - accelerations;
    if (step.size() > 0 && step.squaredNorm() > 0)
      mobility += (residual - now - mobility * step) * step.transpose() / step.squaredNorm();
    residual = now;
    step = mobility.partialPivLu().solve(residual);
    const double off = residual.cwiseProduct(state.scale).norm();
    if (off < best || found.size() == 0) {
      best = off;
      found = step.allFinite() ? Eigen::VectorXd(efforts + step) : efforts;
    }
    ended = !(off > state.rounding) || !step.allFinite();
    efforts += step;
  }
};

}  // namespace

void Unmoved::addFirst(const Eigen::VectorXd& answer) {
  if (entries_.empty())
    for (const double each : answer) entries_.push_back({each});
  for (std::size_t i = 0; i < entries_.size(); ++i)
    entries_[i].is_same = entries_[i].is_same && answer(static_cast<Eigen::Index>(i)) == entries_[i].first;
}

void Unmoved::add(const Eigen::VectorXd& first, const Eigen::VectorXd& answer, const Eigen::VectorXd& right,
                  const Eigen::VectorXd& least) {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    entries_[i].moves = entries_[i].moves || answer(k) != first(k);
    entries_[i].should_move = entries_[i].should_move || std::abs(right(k)) > least(k);
  }
}

std::string Unmoved::words() const {
  std::string values, names;
  bool is_same = true;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& each = entries_[i];
    if (each.moves || !each.should_move) continue;
    is_same = is_same && each.is_same;
    names += (names.empty() ? "" : ", ") + names_[i];
    values += fmt::format("{}{:.6g} for {}", values.empty() ? "" : ", ", each.first, names_[i]);
  }
  if (names.empty()) return "";
  return is_same ? "the same answer whatever is asked: " + values
                 : "the same accelerations whatever the efforts are: " + names;
}

std::vector<Eigen::VectorXd> neededEfforts(const std::vector<WantedState>& states, const AccelerationsIn& simulator,
                                           long questions, Unmoved& unmoved) {
  std::vector<Search> searches(states.size());
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < states.size(); ++k) {
    searches[k].efforts = states[k].efforts;
    searches[k].mobility = inverseOf(states[k].inertia);
    open.push_back(k);
  }
  const Eigen::Index n = states.empty() ? 0 : states.front().efforts.size();
  for (Eigen::Index round = 0; round <= 2 * n + 1 && !open.empty(); ++round) {
    if (round > 0 && static_cast<long>(open.size()) > questions) break;
    questions -= static_cast<long>(open.size());
    std::vector<Eigen::VectorXd> efforts;
    for (const std::size_t k : open) efforts.push_back(searches[k].efforts);
    const std::vector<Eigen::VectorXd> answers = simulator(open, efforts);
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < open.size(); ++i) {
      Search& search = searches[open[i]];
      const WantedState& state = states[open[i]];
      if (round == 0) {
        search.first_answer = answers[i];
        unmoved.addFirst(answers[i]);
      } else {
        unmoved.add(search.first_answer, answers[i], inverseOf(state.inertia) * (efforts[i] - state.efforts),
                    state.rounding * state.scale.cwiseInverse());
      }
      search.take(state, answers[i]);
      if (!search.ended) left.push_back(open[i]);
    }
    open = left;
  }
  std::vector<Eigen::VectorXd> out;
  for (Search& search : searches) out.push_back(search.found);
  return out;
}

}  // namespace ursula
