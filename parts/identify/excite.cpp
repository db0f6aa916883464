#include "parts/identify/excite.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <optional>

#include "base/csv.h"
#include "parts/identify/estimate.h"
#include "parts/random/dice.h"
#include "validation/subject/scaled_jacobian.h"

namespace ursula {
namespace {

using namespace identification;
using Coefficients = Eigen::MatrixXd;  ///< six rows as in motionAbout; columns are sines, then cosines of the harmonics

constexpr double never = std::numeric_limits<double>::infinity(), relative_rank = 1e-6;

/// Extreme values along a motion: the least margin, and the largest of the others.
struct Extremes {
  double speed = 0, effort = 0, kappa = 0, reach = 0, turn = 0, margin = 1;
};

class ExciteSearch {
 public:
  ExciteSearch(const Scenario& scenario, const ExciteOptions& options)
      : scenario_(scenario),
        options_(options),
        solver_(*scenario.manipulator),
        derivatives_(Manipulator(withRotors(scenario.manipulator->parameters()))),
        middle_(scenario.trajectory->at(0.5 * scenario.trajectory->duration())),
        period_(options.period > 0 ? options.period : std::max(4.0, scenario.trajectory->duration())),
        instants_(8 * options.harmonics) {
    setLimits();
    setPlausibleSizes();
  }

  Excitation run() {
    Dice dice(options_.seed);
    Coefficients best = start(dice);
    double cost = costOf(best), step = 0.3;
    for (int i = 0; i < options_.tries; ++i) {
      Coefficients next = best * (1 + 0.3 * step * dice.uniform(-1, 1)) + step * sizes_.asDiagonal() * drawn(dice);
      const double found = costOf(next);
      step = std::clamp(step * (found < cost ? 1.5 : 0.93), 0.01, 1.0);  // Rechenberg's one-fifth rule
      if (found < cost) {
        best = next;
        cost = found;
      }
      if (options_.progress)
        options_.progress((i + 1.0) / options_.tries,
                          fmt::format("condition {:.4g}", conditionOf(along(best, instants_))));
    }
    return result(best);
  }

 private:
  void setLimits() {
    const Trajectory& own = *scenario_.trajectory;
    std::vector<Motion<double>> motions;
    for (int i = 0; i <= 100; ++i) motions.push_back(own.at(own.duration() * i / 100));
    const Extremes found = extremesOf(motions);
    limits_.speed = options_.speed > 0 ? options_.speed : 1.5 * found.speed;
    limits_.effort = options_.effort > 0 ? options_.effort : 1.5 * found.effort;
    limits_.kappa = options_.condition > 0 ? options_.condition : 3 * found.kappa;
    limits_.reach = options_.reach > 0 ? options_.reach : 0.1 * solver_.length();
    limits_.turn = options_.turn;
    limits_.margin = std::min(options_.margin, 0.5 * found.margin);
    if (!(limits_.speed > 0)) limits_.speed = solver_.length();  // the scenario's machine stands still
    sizes_ << Vector3d::Constant(0.2 * limits_.reach), Vector3d::Constant(0.1 * limits_.turn);
    own_ = motions;
  }

  /// Sets plausible sizes of the columns from the scenario's own efforts.
  void setPlausibleSizes() {
    Comparison sizes;
    sizes.directions.resize(derivatives_.regressorNames().size());
    sizes.model = Eigen::MatrixXd::Constant(1, 1, std::max(limits_.effort, 1e-12));
    Eigen::MatrixXd rows = regressorOf(own_);
    for (Eigen::MatrixXd& table : sizes.columns) table = rows;
    setPlausible(scenario_.manipulator->parameters(), sizes, sizes.directions);
    plausible_.resize(rows.cols());
    for (Eigen::Index j = 0; j < rows.cols(); ++j) plausible_(j) = sizes.directions[j].plausible;
  }

  /// Throws PoseError if a leg cannot follow.
  Extremes extremesOf(const std::vector<Motion<double>>& motions) {
    Extremes out;
    for (const Motion<double>& motion : motions) {
      solver_.inverseKinematics(motion, work_);
      solver_.jacobians(motion, work_);
      const Motors& motors = scenario_.manipulator->motors();
      out.speed = larger(out.speed, solver_.rates(work_).driven(motors).cwiseAbs().maxCoeff());
      out.kappa = larger(out.kappa, conditionNumber(scaledB(solver_.B(work_), solver_.length())));
      for (int i = 0; i < scenario_.manipulator->legCount(); ++i)
        out.margin = std::min(out.margin, static_cast<double>(solver_.margins(work_, i).sine));
      out.effort = larger(out.effort, solver_.inverseDynamics(motion, work_).cwiseAbs().maxCoeff());
      out.reach = larger(out.reach, (motion.p - middle_.p).norm());
      out.turn = larger(out.turn, Eigen::AngleAxisd(middle_.Q.transpose() * motion.Q).angle());
    }
    return out;
  }

  /// Returns motions at `count` steps of the period and `more` beyond.
  std::vector<Motion<double>> along(const Coefficients& of, int count, int more = 0) const {
    Eigen::MatrixXd sines = Eigen::MatrixXd::Zero(6, options_.harmonics + 1), cosines = sines;
    sines.rightCols(options_.harmonics) = of.leftCols(options_.harmonics);
    cosines.rightCols(options_.harmonics) = of.rightCols(options_.harmonics);
    const FourierSeries series(1 / period_, cosines, sines);
    std::vector<Motion<double>> out;
    for (int i = 0; i < count + more; ++i) {
      const double t = period_ * i / count;
      out.push_back(motionAbout(middle_, series.at(t, options_.harmonics), t));
    }
    return out;
  }

  Eigen::MatrixXd regressorOf(const std::vector<Motion<double>>& motions) const {
    Eigen::MatrixXd out(6 * motions.size(), derivatives_.regressorNames().size());
    for (std::size_t i = 0; i < motions.size(); ++i) out.middleRows<6>(6 * i) = derivatives_.regressor(motions[i]);
    return out;
  }

  bool keepsLimits(const Coefficients& of, int count) {
    try {
      const Extremes found = extremesOf(along(of, count));
      return found.speed <= limits_.speed && found.effort <= limits_.effort && found.kappa <= limits_.kappa &&
             found.reach <= limits_.reach && found.turn <= limits_.turn && found.margin >= limits_.margin;
    } catch (const PoseError&) {
      return false;
    } catch (const std::domain_error&) {
      return false;
    }
  }

  Coefficients drawn(Dice& dice) const {
    Coefficients out(6, 2 * options_.harmonics);
    for (Eigen::Index j = 0; j < out.cols(); ++j)
      for (int i = 0; i < 6; ++i) out(i, j) = dice.uniform(-1, 1) / (1.0 + static_cast<double>(j % options_.harmonics));
    return out;
  }

  /// Draws a random motion and shrinks it until it keeps to the limits. The numbers that it shows are the ones that
  /// count from then on.
  Coefficients start(Dice& dice) {
    for (int draw = 0; draw < 8; ++draw) {
      Coefficients of = sizes_.asDiagonal() * drawn(dice);
      for (int halving = 0; halving < 12; ++halving, of *= 0.5) {
        if (!keepsLimits(of, 2 * instants_)) continue;
        Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(regressorOf(along(of, instants_)) * plausible_.asDiagonal());
        qr.setThreshold(relative_rank);
        base_ = qr.colsPermutation().indices().head(qr.rank());
        return of;
      }
    }
    throw UnmadeExcitation(fmt::format(
        "no motion of {:.3g} s about the pose at t = {:.6g} s keeps to the limits: speed {:.3g} rad/s or m/s, effort "
        "{:.4g} N·m or N, condition of B {:.4g}, margin {:.3g}, reach {:.3g} m, turn {:.3g} rad; expected a longer "
        "period or wider limits",
        period_, middle_.t, limits_.speed, limits_.effort, limits_.kappa, limits_.margin, limits_.reach, limits_.turn));
  }

  Eigen::MatrixXd shownBy(const std::vector<Motion<double>>& motions) const {
    return regressorOf(motions)(Eigen::all, base_) * plausible_(base_).asDiagonal() /
           std::sqrt(static_cast<double>(motions.size()));
  }

  double conditionOf(const std::vector<Motion<double>>& motions) const {
    const Eigen::VectorXd singular =
        Eigen::JacobiSVD<Eigen::MatrixXd>(Eigen::HouseholderQR<Eigen::MatrixXd>(shownBy(motions))
                                              .matrixQR()
                                              .topRows(base_.size())
                                              .triangularView<Eigen::Upper>()
                                              .toDenseMatrix())
            .singularValues();
    return singular(singular.size() - 1) > 0 ? singular(0) / singular(singular.size() - 1) : never;
  }

  /// Returns minus the mean logarithm of the diagonal of the regressor's R factor. The smaller it is, the larger is the
  /// regressor's determinant. Returns infinity beyond a limit.
  double costOf(const Coefficients& of) {
    if (!keepsLimits(of, 2 * instants_)) return never;
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(shownBy(along(of, instants_)));
    return -qr.matrixQR().diagonal().cwiseAbs().cwiseMax(1e-300).array().log().mean();
  }

  Excitation result(const Coefficients& of) {
    Excitation out;
    const int rows = options_.samples > 0 ? options_.samples : 20 * options_.harmonics;
    std::vector<std::vector<double>> columns(8);
    Eigen::Quaterniond last(middle_.Q);
    for (const Motion<double>& motion : along(of, rows, 1)) {
      Eigen::Quaterniond q(motion.Q);
      if (q.dot(last) < 0) q.coeffs() *= -1;
      last = q;
      const double row[] = {motion.t, motion.p.x(), motion.p.y(), motion.p.z(), q.w(), q.x(), q.y(), q.z()};
      for (std::size_t k = 0; k < 8; ++k) columns[k].push_back(row[k]);
    }
    out.csv = csvText({"t_s", "p_x_m", "p_y_m", "p_z_m", "q_w", "q_x", "q_y", "q_z"}, columns);
    const Extremes found = extremesOf(along(of, 4 * instants_));
    out.speed = found.speed;
    out.effort = found.effort;
    out.kappa = found.kappa;
    out.shown = base_.size();
    out.condition = conditionOf(along(of, instants_));
    out.scenario_condition = conditionOf(own_);
    return out;
  }

  const Scenario& scenario_;
  const ExciteOptions& options_;
  Solver<double> solver_;
  Workspace<double> work_;
  EffortDerivatives derivatives_;
  Motion<double> middle_;
  double period_;
  int instants_;
  Extremes limits_;
  Vector6d sizes_;
  Eigen::VectorXd plausible_;
  Eigen::VectorXi base_;
  std::vector<Motion<double>> own_;
};

}  // namespace

Excitation excite(const Scenario& scenario, const ExciteOptions& options) {
  return ExciteSearch(scenario, options).run();
}

}  // namespace ursula
