#include "base/nearest.h"

#include <algorithm>

namespace ursula {
namespace {

constexpr std::size_t longest = 100;

/// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours, each costing 1.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(word.size(), candidate.size());
    const std::size_t allowed = std::max<std::size_t>(1, longer / 3);
    // Words that differ so much are not misspelled, and long words would take too long.
    if (longer > longest || longer - std::min(word.size(), candidate.size()) > allowed) continue;
    const std::size_t far = distance(word, candidate);
    if (far > allowed || (!best.empty() && far >= least)) continue;
    best = candidate;
    least = far;
  }
  if (!best.empty()) return best;
  // "rpy" lacks the unit of "rpy_deg".
  const auto lacks_end = [&word](const std::string& candidate) { return candidate.rfind(word + "_", 0) == 0; };
  const auto longer = std::find_if(candidates.begin(), candidates.end(), lacks_end);
  return word.empty() || longer == candidates.end() ? "" : *longer;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string best = nearest(word, candidates);
  return best.empty() ? "" : ", did you mean '" + best + "'?";
}

}  // namespace ursula
