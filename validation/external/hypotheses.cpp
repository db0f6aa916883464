#include "validation/external/hypotheses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "nocsolver/errors.h"
#include "validation/external/hypothesis_terms.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using Rows = std::vector<Vector6d>;

double dot(const Rows& a, const Rows& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
  return sum;
}

/// 1 + c, with digits to spare where c is small.
std::string factorText(double c) {
  if (std::abs(c) < 5e-4) return fmt::format("1 {} {:.4g}", c < 0 ? '-' : '+', std::abs(c));
  return fmt::format("{:.6g}", 1 + c);
}

double norm(const Rows& rows) { return std::sqrt(dot(rows, rows)); }

Rows minus(const Rows& a, const Rows& b, double factor) {
  Rows out(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) out[k] = a[k] - factor * b[k];
  return out;
}

/// Legs i of `torques` and j of `exact`: ‖τᵢ ∓ τⱼ‖².
double mismatch(const TorqueResidual& data, int i, int j, double sign) {
  double sum = 0;
  for (std::size_t k = 0; k < data.exact.size(); ++k) {
    const double found = data.exact[k](i) + data.residual[k](i);
    sum += (found - sign * data.exact[k](j)) * (found - sign * data.exact[k](j));
  }
  return sum;
}

std::string legNames(const std::vector<int>& legs) {
  std::string out;
  for (std::size_t k = 0; k < legs.size(); ++k)
    out += fmt::format("{}{}", k == 0 ? "" : k + 1 == legs.size() ? " and " : ", ", legs[k] + 1);
  return out;
}

std::string plural(const std::vector<int>& legs) { return legs.size() == 1 ? "leg " : "legs "; }

/// "legs 2 and 5 swapped", "legs 1, 2 and 3 permuted".
std::string permutationText(const std::vector<int>& from) {
  std::vector<int> moved;
  std::string detail;
  for (int i = 0; i < leg_count; ++i)
    if (from[static_cast<std::size_t>(i)] != i) {
      moved.push_back(i);
      detail += fmt::format("{}column {} holds leg {}", detail.empty() ? "" : ", ", i + 1,
                            from[static_cast<std::size_t>(i)] + 1);
    }
  if (moved.empty()) return "";
  if (moved.size() == 2) return "legs " + legNames(moved) + " swapped";
  return fmt::format("legs {} permuted ({})", legNames(moved), detail);
}

/// Every order of the legs, with the sign of each that fits best.
std::optional<Hypothesis> signsAndOrder(const TorqueResidual& data) {
  double cost[leg_count][leg_count], sign[leg_count][leg_count];
  for (int i = 0; i < leg_count; ++i)
    for (int j = 0; j < leg_count; ++j) {
      const double plus = mismatch(data, i, j, 1), minus_cost = mismatch(data, i, j, -1);
      sign[i][j] = plus <= minus_cost ? 1 : -1;
      cost[i][j] = std::min(plus, minus_cost);
    }
  std::vector<int> from(leg_count), best;
  std::iota(from.begin(), from.end(), 0);
  double least = 0;
  do {
    double sum = 0;
    for (int i = 0; i < leg_count; ++i) sum += cost[i][from[static_cast<std::size_t>(i)]];
    if (best.empty() || sum < least) best = from, least = sum;
  } while (std::next_permutation(from.begin(), from.end()));
  std::vector<int> flipped;
  for (int i = 0; i < leg_count; ++i)
    if (sign[i][best[static_cast<std::size_t>(i)]] < 0) flipped.push_back(i);
  std::string text = permutationText(best);
  if (text.empty() && flipped.empty()) return std::nullopt;
  if (!flipped.empty()) text += text.empty() ? "" : ", and ";
  if (flipped.size() == leg_count)
    text += "the sign of every leg flipped (torques about +u, not conjugate to phi)";
  else if (!flipped.empty())
    text += "the sign of " + plural(flipped) + legNames(flipped) + " flipped";
  return Hypothesis{text, std::sqrt(least) / data.norm(), 0};
}

/// residual = c · term: the torques hold (1 + c) times the term.
std::optional<Hypothesis> scaledTerm(const TorqueResidual& data, const TorqueTerm& term) {
  const double size = norm(term.torques);
  if (!(size > 1e-9 * norm(data.exact))) return std::nullopt;  // no effect on this motion
  const double c = term.fixed ? *term.fixed : dot(data.residual, term.torques) / (size * size);
  const double factor = 1 + c, unexplained = norm(minus(data.residual, term.torques, c)) / data.norm();
  if (term.fixed) return Hypothesis{term.name, unexplained, 0};
  std::string text = fmt::format("{} scaled by {}", term.name, factorText(c));
  if (std::abs(factor) < 1e-3) text = term.name + " left out";
  if (std::abs(factor + 1) < 1e-3) text = term.name + " with the wrong sign";
  return Hypothesis{text, unexplained, 1};
}

std::optional<Hypothesis> scaled(const TorqueResidual& data) {
  const double c = dot(data.residual, data.exact) / std::max(dot(data.exact, data.exact), 1e-300);
  const std::string unit = unitOf(1 + c);
  return Hypothesis{fmt::format("every torque scaled by {}{}", factorText(c), unit.empty() ? "" : " (" + unit + ")"),
                    norm(minus(data.residual, data.exact, c)) / data.norm(), 1};
}

/// What a fit of one number for each leg found, with the legs in which it matters.
Hypothesis perLeg(const TorqueResidual& data, const Vector6d& fitted, const Rows& predicted,
                  const std::function<std::string(double)>& show, const std::string& what) {
  std::string text;
  std::vector<int> legs;
  for (int i = 0; i < leg_count; ++i)
    if (std::abs(fitted(i)) > 0.01 * fitted.cwiseAbs().maxCoeff()) legs.push_back(i);
  for (int i : legs) text += fmt::format("{}{} on leg {}", text.empty() ? "" : ", ", show(fitted(i)), i + 1);
  return {what + text, norm(minus(data.residual, predicted, 1)) / data.norm(), leg_count};
}

std::optional<Hypothesis> offsets(const TorqueResidual& data) {
  Vector6d mean = Vector6d::Zero();
  for (const Vector6d& row : data.residual) mean += row / static_cast<double>(data.residual.size());
  return perLeg(
      data, mean, Rows(data.residual.size(), mean), [](double value) { return fmt::format("{:+.6g} N m", value); },
      "a constant offset: ");
}

std::optional<Hypothesis> gains(const TorqueResidual& data) {
  Vector6d over = Vector6d::Zero(), under = Vector6d::Zero();
  for (std::size_t k = 0; k < data.exact.size(); ++k) {
    over += data.residual[k].cwiseProduct(data.exact[k]);
    under += data.exact[k].cwiseProduct(data.exact[k]);
  }
  const Vector6d c = (under.array() > 0).select(over.cwiseQuotient(under), 0);
  Rows predicted;
  for (const Vector6d& row : data.exact) predicted.push_back(c.cwiseProduct(row));
  return perLeg(
      data, c, predicted, [](double value) { return "a factor of " + factorText(value); }, "");
}

/// Torques of another time, τ(t + dt), where that is within the motion.
class Shift {
 public:
  Shift(const Scenario& scenario, const TorqueResidual& data)
      : trajectory_(*scenario.trajectory), noc_(nocSubject(*scenario.manipulator, scenario.load)), data_(data) {}

  struct Fit {
    double unexplained = 1, slope = 0;
    bool covers = false;  ///< most of the samples
  };

  /// Slope: Gauss–Newton step of dt, s.
  Fit at(double dt) const {
    const double duration = trajectory_.duration(), step = 1e-6 * duration;
    double left = 0, all = 0, along = 0, rate = 0;
    std::size_t used = 0;
    for (std::size_t k = 0; k < data_.exact.size(); ++k) {
      const double t = data_.motions[k].t + dt;
      if (!(t - step >= 0 && t + step <= duration)) continue;
      const Vector6d found = data_.exact[k] + data_.residual[k], shifted = torques(t);
      const Vector6d slope = (torques(t + step) - torques(t - step)) / (2 * step);
      left += (found - shifted).squaredNorm();
      all += data_.residual[k].squaredNorm();
      along += slope.dot(found - shifted);
      rate += slope.squaredNorm();
      ++used;
    }
    Fit fit;
    fit.covers = 4 * used >= 3 * data_.exact.size() && used >= 2 && all > 0 && rate > 0;
    if (fit.covers) fit = {std::sqrt(left / all), along / rate, true};
    return fit;
  }

 private:
  Vector6d torques(double t) const { return noc_.torques(trajectory_.at(t)); }

  const Trajectory& trajectory_;
  Subject noc_;
  const TorqueResidual& data_;
};

std::optional<Hypothesis> timeShift(const Scenario& scenario, const TorqueResidual& data) {
  const double duration = scenario.trajectory->duration();
  const Shift shift(scenario, data);
  double best = 0, least = 1e300;
  for (int k = -20; k <= 20; ++k) {  // so that the steps below begin near the right one
    const double dt = k * 0.01 * duration;
    const Shift::Fit fit = shift.at(dt);
    if (fit.covers && fit.unexplained < least) best = dt, least = fit.unexplained;
  }
  for (int k = 0; k < 8; ++k) {
    const Shift::Fit fit = shift.at(best);
    if (!fit.covers) return std::nullopt;
    best += fit.slope;
  }
  const Shift::Fit fit = shift.at(best);
  if (!fit.covers) return std::nullopt;
  return Hypothesis{fmt::format("a time shift: the torques of {:.6g} ms {}", 1000 * std::abs(best),
                                best < 0 ? "before (late)" : "after (early)"),
                    fit.unexplained, 1};
}

}  // namespace

double TorqueResidual::norm() const { return ursula::norm(residual); }

std::string unitOf(double factor) {
  static const std::pair<double, const char*> known[] = {{1e-3, "kN m for N m"},
                                                         {1e3, "N mm for N m"},
                                                         {0.017453292519943295, "degrees for radians"},
                                                         {57.29577951308232, "degrees for radians"},
                                                         {1 / 9.80665, "kgf m for N m"},
                                                         {9.80665, "N m taken for kgf m"},
                                                         {0.7375621492772653, "lbf ft for N m"},
                                                         {8.850745791327184, "lbf in for N m"},
                                                         {1e2, "N cm for N m"}};
  for (const auto& [value, text] : known)
    if (std::abs(factor / value - 1) < 1e-4) return text;
  return "";
}

std::vector<Hypothesis> fitHypotheses(const Scenario& scenario, const TorqueResidual& data) {
  std::vector<Hypothesis> out;
  const auto add = [&out](std::optional<Hypothesis> fitted) {
    if (fitted && std::isfinite(fitted->unexplained)) out.push_back(*fitted);
  };
  add(signsAndOrder(data));
  const std::vector<TorqueTerm> terms = torqueTerms(scenario, data.motions, data.exact);
  for (const TorqueTerm& term : terms)
    if (!term.fixed) add(scaledTerm(data, term));
  add(scaled(data));
  if (data.exact.size() >= 2) add(timeShift(scenario, data));
  if (data.exact.size() >= 3) {
    add(offsets(data));
    add(gains(data));
  }
  for (const TorqueTerm& term : terms)
    if (term.fixed) add(scaledTerm(data, term));
  return out;
}

}  // namespace ursula
