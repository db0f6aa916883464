#include "studies/identify/excite.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <optional>

#include "base/csv.h"
#include "studies/identify/estimate.h"
#include "studies/random/dice.h"

namespace ursula {
namespace {

using namespace identification;
using Coefficients = Eigen::MatrixXd;  ///< six rows; columns are sines, then cosines of the harmonics

constexpr double never = std::numeric_limits<double>::infinity(), relative_rank = 1e-6;

/// P and a Rodrigues vector about a middle pose, as finite Fourier series. Nothing makes them begin or end at rest.
class FourierPoses {
 public:
  FourierPoses(const Motion<double>& middle, double period, int harmonics)
      : p_(middle.p), q_(middle.Q), omega_(2 * std::acos(-1.0) / period), harmonics_(harmonics) {}

  Motion<double> at(const Coefficients& of, double t) const {
    Vector6d x = Vector6d::Zero(), v = x, a = x;
    for (int k = 1; k <= harmonics_; ++k) {
      const double w = k * omega_, s = std::sin(w * t), c = std::cos(w * t);
      const Vector6d sine = of.col(k - 1), cosine = of.col(harmonics_ + k - 1);
      x += sine * s + cosine * c;
      v += w * (sine * c - cosine * s);
      a -= w * w * (sine * s + cosine * c);
    }
    const auto part = [&](const Vector6d& of_vector, double scalar, const Vector3d& origin) {
      Eigen::VectorXd out(7);
      const Vector3d turn = of_vector.tail<3>();
      const Eigen::Quaterniond q = q_ * Eigen::Quaterniond(scalar, turn.x(), turn.y(), turn.z());
      out << origin + of_vector.head<3>(), q.w(), q.x(), q.y(), q.z();
      return out;
    };
    Motion<double> out = motionOfPoses({part(x, 1, p_), part(v, 0, Vector3d::Zero()), part(a, 0, Vector3d::Zero())});
    out.t = t;
    return out;
  }

 private:
  Vector3d p_;
  Eigen::Quaterniond q_;
  double omega_;
  int harmonics_;
};

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
        poses_(middle_, period_, options.harmonics),
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
        options_.progress((i + 1.0) / options_.tries, fmt::format("condition {:.4g}", conditionOf(along(best))));
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
    for (const Motion<double>& motion : motions) own_.push_back(motion);
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
    for (Eigen::Index j = 0; j < rows.cols(); ++j)
      plausible_(j) = sizes.directions[static_cast<std::size_t>(j)].plausible;
  }

  /// Throws PoseError if a leg cannot follow.
  Extremes extremesOf(const std::vector<Motion<double>>& motions) {
    Extremes out;
    for (const Motion<double>& motion : motions) {
      solver_.inverseKinematics(motion, work_);
      solver_.jacobians(motion, work_);
      const Motors& motors = scenario_.manipulator->motors();
      out.speed = std::max(out.speed, solver_.rates(work_).driven(motors).cwiseAbs().maxCoeff());
      Matrix6d B = solver_.B(work_);
      B.leftCols<3>() /= solver_.length();
      const Vector6d singular = B.jacobiSvd().singularValues();
      out.kappa = std::max(out.kappa, singular(0) / singular(5));
      for (int i = 0; i < scenario_.manipulator->legCount(); ++i)
        out.margin = std::min(out.margin, static_cast<double>(solver_.margins(work_, i).sine));
      out.effort = std::max(out.effort, solver_.inverseDynamics(motion, work_).cwiseAbs().maxCoeff());
      out.reach = std::max(out.reach, (motion.p - middle_.p).norm());
      out.turn = std::max(out.turn, Eigen::AngleAxisd(middle_.Q.transpose() * motion.Q).angle());
    }
    return out;
  }

  std::vector<Motion<double>> along(const Coefficients& of, int count = 0) const {
    std::vector<Motion<double>> out;
    count = count > 0 ? count : instants_;
    for (int i = 0; i < count; ++i) out.push_back(poses_.at(of, period_ * i / count));
    return out;
  }

  Eigen::MatrixXd regressorOf(const std::vector<Motion<double>>& motions) const {
    Eigen::MatrixXd out(6 * static_cast<Eigen::Index>(motions.size()),
                        static_cast<Eigen::Index>(derivatives_.regressorNames().size()));
    for (std::size_t i = 0; i < motions.size(); ++i)
      out.middleRows<6>(6 * static_cast<Eigen::Index>(i)) = derivatives_.regressor(motions[i]);
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
        Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(regressorOf(along(of)) * plausible_.asDiagonal());
        qr.setThreshold(relative_rank);
        base_ = qr.colsPermutation().indices().head(qr.rank());
        return of;
      }
    }
    throw UnmadeExcitation(
        fmt::format("no motion about the pose at {:.6g} s keeps to the limits: speed {:.3g}, effort {:.4g}, condition "
                    "of B {:.4g}, margin {:.3g}",
                    middle_.t, limits_.speed, limits_.effort, limits_.kappa, limits_.margin));
  }

  Eigen::MatrixXd shownBy(const std::vector<Motion<double>>& motions) const {
    const Eigen::MatrixXd all = regressorOf(motions) * plausible_.asDiagonal();
    Eigen::MatrixXd out(all.rows(), base_.size());
    for (Eigen::Index j = 0; j < base_.size(); ++j) out.col(j) = all.col(base_(j));
    return out / std::sqrt(static_cast<double>(motions.size()));
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

  /// Returns minus the mean logarithm of the regressor's diagonal; infinite beyond a limit.
  double costOf(const Coefficients& of) {
    if (!keepsLimits(of, 2 * instants_)) return never;
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(shownBy(along(of)));
    return -qr.matrixQR().diagonal().cwiseAbs().cwiseMax(1e-300).array().log().mean();
  }

  Excitation result(const Coefficients& of) {
    Excitation out;
    const int rows = options_.samples > 0 ? options_.samples : 20 * options_.harmonics;
    std::vector<std::vector<double>> columns(8);
    for (int i = 0; i <= rows; ++i) {
      const Motion<double> motion = poses_.at(of, period_ * i / rows);
      const Eigen::Quaterniond q(motion.Q);
      Eigen::Matrix<double, 8, 1> row;
      row << period_ * i / rows, motion.p, q.w(), q.x(), q.y(), q.z();
      const double side = columns[4].empty() || columns[4].back() * row(4) + columns[5].back() * row(5) +
                                                        columns[6].back() * row(6) + columns[7].back() * row(7) >=
                                                    0
                              ? 1
                              : -1;
      row.tail<4>() *= side;
      for (std::size_t k = 0; k < 8; ++k) columns[k].push_back(row(static_cast<Eigen::Index>(k)));
    }
    out.csv = csvText({"t_s", "p_x_m", "p_y_m", "p_z_m", "q_w", "q_x", "q_y", "q_z"}, columns);
    const Extremes found = extremesOf(along(of, 4 * instants_));
    out.speed = found.speed;
    out.effort = found.effort;
    out.kappa = found.kappa;
    out.shown = base_.size();
    out.condition = conditionOf(along(of));
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
  FourierPoses poses_;
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
