#include "validation/verdict/failure_size.h"

#include <algorithm>
#include <cmath>

#include "validation/verdict/result.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// One limit for the given efforts, one for the other model's.
constexpr double both_limits = 2;

double limitOf(const JudgedEfforts& efforts, std::size_t i) { return std::max(efforts.limits[i], efforts.allowed); }

bool isSeen(const JudgedEfforts& efforts, const ModelTerm& term) {
  for (std::size_t i = 0; i < term.efforts.size(); ++i)
    if (std::abs(term.efforts[i]) > efforts.limits[i]) return true;
  return false;
}

bool explains(const JudgedEfforts& efforts, const std::vector<ModelTerm>& terms,
              const std::vector<std::size_t>& left_out) {
  for (std::size_t i = 0; i < efforts.residual.size(); ++i) {
    double remains = efforts.residual[i];
    for (const std::size_t k : left_out) {
      if (i >= terms[k].efforts.size()) return false;
      remains += terms[k].efforts[i];
    }
    if (!(std::abs(remains) <= both_limits * limitOf(efforts, i))) return false;
  }
  return true;
}

/// The sets of terms that the scenario can leave out and without which the efforts are right, the smallest first.
std::vector<std::vector<std::size_t>> otherModels(const JudgedEfforts& efforts, const std::vector<ModelTerm>& terms) {
  std::vector<std::size_t> known;
  for (std::size_t k = 0; k < terms.size(); ++k)
    if (!terms[k].left_out.empty() && isSeen(efforts, terms[k])) known.push_back(k);
  std::vector<std::vector<std::size_t>> out;
  for (unsigned which = 1; which < 1U << known.size(); ++which) {
    std::vector<std::size_t> set;
    for (std::size_t i = 0; i < known.size(); ++i)
      if ((which >> i & 1U) != 0) set.push_back(known[i]);
    const bool doubled = set.size() > 1 && std::any_of(set.begin(), set.end(), [&](auto k) { return terms[k].is_all; });
    if (!doubled && explains(efforts, terms, set)) out.push_back(std::move(set));
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  return out;
}

/// The error between the samples, if only those there are wrong.
void addBetween(const ValidationResult& result, JudgedEfforts& efforts) {
  const Check* between = findCheck(result.checks, "torque.between");
  if (between == nullptr || between->verdict != Verdict::fail || !(result.deviation->largest_effort > 0)) return;
  const double unit = result.deviation->largest_effort / efforts.largest;
  efforts.residual.push_back(between->largest.value / unit);
  efforts.limits.push_back(*std::max_element(efforts.limits.begin(), efforts.limits.end()));
  efforts.condition.push_back(*std::max_element(efforts.condition.begin(), efforts.condition.end()));
}

/// Grades by sizes alone.
FailureSize graded(const JudgedEfforts& efforts, const std::vector<ModelTerm>& terms) {
  FailureSize out;
  out.limits = 0;
  double largest = 0, widened = 0;
  for (std::size_t i = 0; i < efforts.residual.size(); ++i) {
    const double error = std::abs(efforts.residual[i]), share = WorstShare::share(error, efforts.limits[i]);
    largest = larger(largest, error);
    widened = std::max(widened, share / efforts.condition[i]);
    if (!(share > out.limits)) continue;
    out.limits = share;
    out.rounding = efforts.condition[i];
  }
  for (const ModelTerm& term : terms) {
    if (!isSeen(efforts, term)) continue;
    double effect = 0;
    for (const double each : term.efforts) effect = std::max(effect, std::abs(each));
    if (effect / efforts.largest >= out.least_share) continue;
    out.least_share = effect / efforts.largest;
    out.least_term = term.name;
  }
  if (widened <= 1)
    out.grade = FailureGrade::rounding;
  else if (largest < out.least_share * efforts.largest)
    out.grade = out.least_term.empty() ? FailureGrade::wrong : FailureGrade::modelling;
  return out;
}

}  // namespace

const char* name(FailureGrade grade) {
  static constexpr const char* names[] = {"rounding", "modelling", "wrong"};
  return names[static_cast<std::size_t>(grade)];
}

std::optional<FailureSize> sizeOf(JudgedEfforts efforts, const std::vector<ModelTerm>& terms,
                                  const ValidationResult& result, const AreRight& are_right) {
  if (efforts.residual.empty()) return std::nullopt;
  addBetween(result, efforts);
  FailureSize out = graded(efforts, terms);
  if (out.limits <= 1) return std::nullopt;
  if (result.cause && result.cause->kind == CauseKind::digits) out.grade = FailureGrade::rounding;
  if (out.grade == FailureGrade::rounding) return out;
  for (const std::vector<std::size_t>& set : otherModels(efforts, terms)) {
    std::vector<ScenarioChange> changes;
    for (const std::size_t k : set) changes.insert(changes.end(), terms[k].left_out.begin(), terms[k].left_out.end());
    if (!are_right(changes)) continue;
    out.grade = FailureGrade::modelling;
    out.remedy = changes;
    break;
  }
  return out;
}

}  // namespace ursula
