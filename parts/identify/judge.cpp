#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iterator>
#include <map>

#include "parts/identify/results.h"

namespace ursula::identification {
namespace {

/// Risks of calling a right model wrong: by one cause among its numbers, by one outside of them, by the deviation's
/// size.
constexpr double risk_of_number = 0.015, risk_outside = 0.015, risk_of_squares = 0.005;
constexpr std::size_t most_causes = 6;
/// Deviations of a normal variable that 95 % do not exceed.
constexpr double one_sided = 1.645;
/// A sum of columns below this share of their sizes is only their error. They are one-sided differences with a step of
/// 1e-6, times a curvature that reaches 100 near singular poses. Sums that mean something are above 1e-3.
constexpr double resolved = 1e-4;
/// Suspects are indistinguishable if the squares of their scores differ by less.
constexpr double alike = 4;

/// Multiplies by the inverse covariance of noise and of `allowed` columns, each with deviation 1.
class Allowance {
 public:
  explicit Allowance(Eigen::MatrixXd allowed) : allowed_(std::move(allowed)) {
    const Eigen::Index count = allowed_.cols();
    factors_.compute(Eigen::MatrixXd::Identity(count, count) + allowed_.transpose() * allowed_);
  }

  Eigen::MatrixXd operator()(const Eigen::MatrixXd& x) const {
    if (allowed_.cols() == 0) return x;
    return x - allowed_ * factors_.solve(allowed_.transpose() * x);
  }

  /// Allows any amount of a column from now on.
  void free(const Eigen::VectorXd& column) {
    Eigen::MatrixXd more(allowed_.rows(), allowed_.cols() + 1);
    more << allowed_, column * (1e5 / std::max(column.norm(), 1e-300));
    *this = Allowance(std::move(more));
  }

 private:
  Eigen::MatrixXd allowed_;
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

/// Returns one column for each stated tolerance, scaled to deviation 1, and one for what columns and residual share.
Eigen::MatrixXd withinTolerances(const std::vector<Suspect>& suspects, const SquareRoot& model) {
  std::vector<Eigen::VectorXd> allowed = {model.shared};
  for (const Suspect& each : suspects) {
    const bool together = each.direction.path.compare(0, 24, "manipulator.leg_defaults") == 0;
    if (each.tolerance > 0 && !together) allowed.emplace_back(each.column * each.tolerance);
  }
  Eigen::MatrixXd out(model.R.rows(), allowed.size());
  for (std::size_t j = 0; j < allowed.size(); ++j) out.col(j) = allowed[j];
  return out;
}

/// Returns orthonormal columns that span those of `x`.
Eigen::MatrixXd basisOf(const Eigen::MatrixXd& x) {
  Eigen::VectorXd scale = x.colwise().norm().transpose();
  for (double& each : scale) each = each > 0 ? 1 / each : 0;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x * scale.asDiagonal());
  qr.setThreshold(1e-7);
  return qr.householderQ() * Eigen::MatrixXd::Identity(x.rows(), qr.rank());
}

/// Returns true for compliance, backlash and friction, which no joint has below zero.
bool cannotBeNegative(DirectionKind kind) {
  return kind == DirectionKind::elastic || kind == DirectionKind::backlash || kind == DirectionKind::load_friction;
}

/// Returns whether no change of masses, inertias and friction has the same effect.
bool isOutside(DirectionKind kind) {
  return cannotBeNegative(kind) || kind == DirectionKind::encoder || kind == DirectionKind::number ||
         kind == DirectionKind::scale;
}

struct Score {
  double score = 0, change = 0, deviation = 0;
};

std::vector<Score> scoresOf(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& judged, const Eigen::VectorXd& z) {
  std::vector<Score> out;
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    const double weight = judged.col(j).dot(columns.col(j)), size = columns.col(j).squaredNorm();
    if (!(weight > 1e-9 * size)) {
      out.emplace_back();
      continue;
    }
    const double change = judged.col(j).dot(z) / weight, deviation = 1 / std::sqrt(weight);
    out.push_back({change / deviation, change, deviation});
  }
  return out;
}

std::size_t largestOf(const std::vector<Score>& scores) {
  const auto best = std::max_element(scores.begin(), scores.end(), [](const Score& a, const Score& b) {
    return std::abs(a.score) < std::abs(b.score);
  });
  return best - scores.begin();
}

/// Returns the suspect of the largest score, or the offset of a coordinate that cannot be told from it. An encoder is
/// off more often than a joint's place.
std::size_t likeliestOf(const std::vector<Score>& scores, const std::vector<Suspect>& suspects) {
  const std::size_t best = largestOf(scores);
  const double least = scores[best].score * scores[best].score - alike;
  for (std::size_t j = 0; j < scores.size() && suspects[best].direction.kind == DirectionKind::number; ++j)
    if (suspects[j].direction.kind == DirectionKind::encoder && scores[j].score * scores[j].score > least) return j;
  return best;
}

/// Returns the standard uncertainty of a suspect's change by everything but its own tolerance.
double ownDeviation(const Score& score, double tolerance) {
  return std::sqrt(std::max(0.0, score.deviation * score.deviation - tolerance * tolerance));
}

Eigen::MatrixXd columnsOf(const std::vector<Suspect>& suspects, Eigen::Index rows) {
  Eigen::MatrixXd out(rows, suspects.size());
  for (std::size_t j = 0; j < suspects.size(); ++j) out.col(j) = suspects[j].column;
  return out;
}

/// Returns the score that the largest of `count` exceeds at this risk.
double thresholdOf(double risk, double count, Eigen::Index freedom) {
  const boost::math::students_t distribution(static_cast<double>(std::max<Eigen::Index>(freedom, 3)));
  return boost::math::quantile(boost::math::complement(distribution, risk / (2 * std::max(count, 1.0))));
}

/// Returns the limit of this many squares of noise.
double likelyMost(Eigen::Index squares) {
  return boost::math::quantile(
      boost::math::complement(boost::math::chi_squared(static_cast<double>(squares)), risk_of_squares));
}

/// Returns whether a mass, an inertia or a friction explains all but a hundredth of the squared deviation. The rest is
/// then no other cause but the error of the linearisation, which a log with little noise shows.
bool oneExplainsAll(const std::vector<Suspect>& suspects, const Eigen::MatrixXd& columns, const Allowance& allowance,
                    const Eigen::VectorXd& z) {
  const std::vector<Score> scores = scoresOf(columns, allowance(columns), z);
  const std::size_t best = likeliestOf(scores, suspects);
  return !isOutside(suspects[best].direction.kind) &&
         scores[best].score * scores[best].score > 0.99 * z.dot(allowance(z).col(0));
}

/// Finds one cause after another by the first allowance, and frees each of them in all allowances.
void findCauses(const std::vector<Suspect>& suspects, const std::vector<Allowance*>& allowances,
                const Eigen::VectorXd& z, double threshold, bool outside, std::vector<MeasuredCause>& out) {
  if (suspects.empty()) return;
  const Eigen::MatrixXd columns = columnsOf(suspects, z.size());
  const Allowance& allowance = *allowances.front();
  const double all = z.dot(allowance(z).col(0));
  for (std::size_t pass = 0; pass < most_causes; ++pass) {
    std::vector<Score> scores = scoresOf(columns, allowance(columns), z);
    for (std::size_t j = 0; j < scores.size(); ++j)
      if (cannotBeNegative(suspects[j].direction.kind) && scores[j].change < 0) scores[j] = {};
    const std::size_t best = likeliestOf(scores, suspects);
    const Score& score = scores[best];
    if (!(std::abs(score.score) > threshold)) return;
    const Suspect& found = suspects[best];
    const Direction& direction = found.direction;
    MeasuredCause cause{name(direction.kind), direction.path, direction.words, direction.unit, direction.motor + 1};
    cause.expected = stated(direction.nominal);
    cause.found = direction.nominal + score.change;
    cause.uncertainty = ownDeviation(score, found.tolerance);
    cause.tolerances = found.tolerance > 0 ? score.change / found.tolerance : 0;
    cause.score = score.score;
    cause.explained = std::min(1.0, score.score * score.score / std::max(all, 1e-300));
    cause.outside = outside;
    for (std::size_t j = 0; j < scores.size(); ++j)
      if (j != best && scores[j].score * scores[j].score > score.score * score.score - alike)
        cause.as_well.push_back(suspects[j].direction.name());
    out.push_back(cause);
    for (Allowance* each : allowances) each->free(found.column);
  }
}

double toleranceOf(const NumberTolerances& tolerances, const std::string& path) {
  const auto at = tolerances.find(path);
  return at == tolerances.end() ? 0.0 : at->second;
}

/// Returns the effects of the machine's numbers, a column each, from those of the directions.
Eigen::MatrixXd byNumbers(const Comparison& comparison, const Eigen::MatrixXd& table,
                          const EffortDerivatives& derivatives) {
  Eigen::MatrixXd out = table.leftCols(comparison.linear) * derivatives.regressorByParameters();
  const std::vector<std::string>& names = derivatives.parameterNames();
  for (std::size_t j = 0; j < comparison.directions.size(); ++j)
    if (const Direction& direction = comparison.directions[j]; direction.kind == DirectionKind::number)
      out.col(std::find(names.begin(), names.end(), direction.path) - names.begin()) = table.col(j);
  return out;
}

}  // namespace

std::vector<Suspect> suspectsOf(const SquareRoot& model, const Comparison& comparison,
                                const ManipulatorParameters& machine, const NumberTolerances& tolerances) {
  std::vector<Suspect> out;
  const ManipulatorParameters rotors = withRotors(machine);
  const Eigen::MatrixXd columns = byNumbers(comparison, model.R, EffortDerivatives(Manipulator(rotors)));
  std::map<std::string, std::vector<std::size_t>> alike_on_legs;
  const auto numbers = machineNumbers(rotors);
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    const MachineNumber& number = numbers[j];
    if (columns.col(j).isZero(0)) continue;
    const NumberGroup group = number.group();
    const bool geometry = group == NumberGroup::length || group == NumberGroup::point || group == NumberGroup::axis;
    const DirectionKind kind = geometry ? DirectionKind::number : DirectionKind::linear;
    if (number.leg >= 0)
      alike_on_legs["manipulator.leg_defaults" + number.path.substr(number.path.find('.', 16))].push_back(out.size());
    out.push_back({{kind, number.path, number.words, number.unit, -1, number.get(rotors), 1},
                   columns.col(j),
                   toleranceOf(tolerances, number.path)});
  }
  for (const auto& [path, legs] : alike_on_legs) {
    Suspect all = out[legs.front()];
    all.direction.path = path;
    for (std::size_t k = 1; k < legs.size(); ++k) {
      all.column += out[legs[k]].column;
      if (out[legs[k]].direction.nominal != all.direction.nominal) all.column.setZero();
    }
    // What moves the whole machine changes no effort: its sum is the error of the parts' differences.
    double parts = 0;
    for (const std::size_t leg : legs) parts += out[leg].column.norm();
    if (legs.size() > 1 && all.column.norm() > resolved * parts) out.push_back(all);
  }
  for (std::size_t j = comparison.linear; j < comparison.directions.size(); ++j)
    if (const Direction& each = comparison.directions[j]; each.kind >= DirectionKind::offset)
      out.push_back({each, model.R.col(j), 0});
  return out;
}

std::pair<double, double> delayLeft(const SquareRoot& model, const Comparison& comparison,
                                    const std::vector<Suspect>& suspects, Eigen::Index noise_freedom) {
  const Eigen::MatrixXd column = model.R.col(comparison.delay());
  Allowance allowance(withinTolerances(suspects, model)), of_any_delay = allowance;
  of_any_delay.free(column);
  std::vector<MeasuredCause> causes;
  findCauses(suspects, {&of_any_delay, &allowance}, model.z,
             thresholdOf(risk_of_number, static_cast<double>(suspects.size()), noise_freedom), false, causes);
  const Score score = scoresOf(column, allowance(column), model.z).front();
  return {score.change, score.deviation};
}

Judgement judge(const SquareRoot& model, const Comparison& comparison, const std::vector<Suspect>& suspects,
                double delay_deviation, Eigen::Index noise_freedom) {
  std::vector<Suspect> outside;
  std::copy_if(suspects.begin(), suspects.end(), std::back_inserter(outside),
               [](const Suspect& each) { return isOutside(each.direction.kind); });
  const Eigen::MatrixXd within = withinTolerances(suspects, model);
  Eigen::MatrixXd columns(model.R.rows(), within.cols() + 1 + motor_count);
  columns << model.R.col(comparison.delay()) * delay_deviation, model.R.middleCols(comparison.further(), motor_count),
      within;
  Judgement out;

  // No masses, inertias, friction or offsets can explain these, whatever their values.
  const Eigen::MatrixXd basis = basisOf(model.R.leftCols(comparison.further()));
  Eigen::MatrixXd all_linear = basis * 1e5, with_tolerances(model.R.rows(), all_linear.cols() + columns.cols());
  with_tolerances << all_linear, columns;
  Allowance beyond_numbers(with_tolerances), allowance(columns);
  const Eigen::MatrixXd every = columnsOf(suspects, model.R.rows()), everything = basisOf(every);
  if (!oneExplainsAll(suspects, every, allowance, model.z))
    findCauses(outside, {&beyond_numbers, &allowance}, model.z,
               thresholdOf(risk_outside, static_cast<double>(outside.size()), noise_freedom), true, out.causes);
  out.freedom = everything.cols();
  out.threshold = thresholdOf(risk_of_number, static_cast<double>(out.freedom), noise_freedom);
  const std::vector<Score> scores = scoresOf(every, allowance(every), model.z);
  for (std::size_t j = 0; j < suspects.size(); ++j)
    if (const double tolerance = suspects[j].tolerance; tolerance > 0 && scores[j].deviation > 0)
      out.least_found[suspects[j].direction.path] =
          out.threshold * scores[j].deviation + one_sided * ownDeviation(scores[j], tolerance);
  out.squares = model.z.dot(everything * (everything.transpose() * allowance(model.z).col(0)));
  out.squares_limit = likelyMost(out.freedom) *
                      (1 + 4 * std::sqrt(2.0 / static_cast<double>(std::max<Eigen::Index>(noise_freedom, 8))));
  findCauses(suspects, {&allowance}, model.z, out.threshold, false, out.causes);
  // Columns that noise dominates follow the deviation. Their squares tell a model error only if all of it is too large.
  const bool by_noise = (everything.transpose() * model.shared).squaredNorm() > static_cast<double>(out.freedom) &&
                        model.z.dot(allowance(model.z).col(0)) + model.rest < likelyMost(model.rows);
  out.deviates = !out.causes.empty() || (out.squares > out.squares_limit && !by_noise);
  return out;
}

Eigen::MatrixXd inputUncertainty(const Comparison& comparison, const ManipulatorParameters& machine,
                                 const NumberTolerances& tolerances) {
  const EffortDerivatives derivatives((Manipulator(withRotors(machine))));
  Eigen::VectorXd allowed(derivatives.parameterNames().size());
  for (Eigen::Index j = 0; j < allowed.size(); ++j)
    allowed(j) = toleranceOf(tolerances, derivatives.parameterNames()[j]);
  Eigen::MatrixXd out(comparison.model.rows(), motor_count);
  for (int k = 0; k < motor_count; ++k)
    out.col(k) = (byNumbers(comparison, comparison.columns[k], derivatives) * allowed.asDiagonal()).rowwise().norm();
  return out;
}

}  // namespace ursula::identification
