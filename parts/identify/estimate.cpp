#include "parts/identify/estimate.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace ursula::identification {
namespace {

/// Deviations of the noise's variance beyond which a residual is more than noise.
constexpr double surely = 3;
constexpr double visible = 10, train_share = 0.7, rounding = 1e-9;
constexpr Eigen::Index most_tested = 300;  ///< instants of the part that is not fitted

/// Returns [columns, measured − model] of motor k.
Eigen::MatrixXd tableOf(const Comparison& comparison, int k) {
  const Eigen::MatrixXd& columns = comparison.columns[k];
  Eigen::MatrixXd out(columns.rows(), columns.cols() + 1);
  out << columns, comparison.measured.col(k) - comparison.model.col(k);
  return out;
}

/// Returns factors that make each column's norm 1.
Eigen::VectorXd columnScales(const Eigen::MatrixXd& x) {
  Eigen::VectorXd scale = x.colwise().norm().transpose();
  for (double& each : scale) each = each > 0 ? 1 / each : 0;
  return scale;
}

/// Returns the least-squares fit of the last column by the first `count`, and sets the rank.
Eigen::VectorXd leastSquares(const Eigen::MatrixXd& rows, Eigen::Index count, Eigen::Index& rank) {
  const Eigen::VectorXd scale = columnScales(rows.leftCols(count));
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows.leftCols(count) * scale.asDiagonal());
  qr.setThreshold(1e-7);
  rank = qr.rank();
  return scale.asDiagonal() * qr.solve(rows.rightCols<1>());
}

/// Merges the motors' tables, six rows for each instant.
Eigen::MatrixXd interleaved(const MotorTables& tables) {
  Eigen::MatrixXd out(6 * tables[0].rows(), tables[0].cols());
  for (int k = 0; k < motor_count; ++k)
    for (Eigen::Index i = 0; i < tables[0].rows(); ++i) out.row(6 * i + k) = tables[k].row(i);
  return out;
}

}  // namespace

SquareRoot squareRootOf(const Eigen::MatrixXd& rows) {
  const Eigen::Index width = rows.cols(), count = width - 1;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(width, width);
  const Eigen::Index there = std::min(width, rows.rows());
  whole.topRows(there) = qr.matrixQR().topRows(there).triangularView<Eigen::Upper>();
  SquareRoot out;
  out.R = whole.topLeftCorner(count, count);
  out.z = whole.col(count).head(count);
  out.rest = whole(count, count) * whole(count, count);
  out.rows = rows.rows();
  out.shared = Eigen::VectorXd::Zero(count);
  return out;
}

Whitened whiten(const Comparison& comparison, EffortNoise noise) {
  const Eigen::Index fitted = comparison.further(), instants = comparison.model.rows();
  MotorTables tables;
  for (int k = 0; k < motor_count; ++k) tables[k] = tableOf(comparison, k);
  const Eigen::MatrixXd rows = interleaved(tables);
  Whitened out;
  out.expected = noise.variances().colwise().mean().transpose().cwiseSqrt();
  for (int pass = 0; pass < 3; ++pass) {
    out.rows = noise.whitened(rows);
    const Eigen::VectorXd x = leastSquares(out.rows, fitted, out.rank),
                          left = rows.rightCols<1>() - rows.leftCols(fitted) * x;
    out.residual =
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>>(left.data(), instants, 6);
    const double freedom = 6.0 * static_cast<double>(instants),
                 correction = freedom / std::max(freedom - static_cast<double>(out.rank), 1.0);
    const double chance = 1 + surely * std::sqrt(2 / static_cast<double>(instants));
    out.variances = noise.variances();
    out.weighed = noise.weighed(left);
    Vector6d more = Vector6d::Zero();
    for (int k = 0; k < motor_count; ++k) {
      const double seen = correction * out.residual.col(k).cwiseAbs2().mean(), known = out.variances.col(k).mean();
      if (seen > chance * known) more(k) = seen - known;
    }
    if (more.isZero(0) || pass == 2) break;
    noise.add(more);
  }
  out.noise = std::move(noise);
  return out;
}

void setShared(const NoiseDraw& draw, const Comparison& comparison, const Comparison& noisy, const Whitened& whitened,
               SquareRoot& model) {
  MotorTables tables;
  for (int k = 0; k < motor_count; ++k) {
    tables[k] = Eigen::MatrixXd::Zero(comparison.model.rows(), comparison.columns[k].cols());
    std::size_t there = 0;
    for (std::size_t i = 0; i < comparison.kept.size(); ++i) {
      while (there < noisy.kept.size() && noisy.kept[there] < comparison.kept[i]) ++there;
      if (there < noisy.kept.size() && noisy.kept[there] == comparison.kept[i])
        tables[k].row(i) = noisy.columns[k].row(there) - comparison.columns[k].row(i);
    }
  }
  const Eigen::VectorXd product =
      whitened.noise.whitened(interleaved(tables)).transpose() * whitened.noise.whitened(draw.efforts);
  const Eigen::VectorXd scale = columnScales(model.R);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors((model.R * scale.asDiagonal()).transpose());
  factors.setThreshold(1e-9);
  model.shared = factors.solve(scale.cwiseProduct(product));
}

void setPlausible(const ManipulatorParameters& machine, const Comparison& comparison,
                  std::vector<Direction>& directions) {
  double reach = 0;
  for (const Leg& leg : machine.legs) reach = std::max(reach, leg.platform_point.norm());
  const double effort = std::sqrt(comparison.model.squaredNorm() / static_cast<double>(comparison.model.size()));
  const ManipulatorParameters rotors = withRotors(machine);
  std::size_t j = 0;
  for (const MachineNumber& number : machineNumbers(rotors)) {
    if (!number.isLinear()) continue;
    const NumberGroup group = number.group();
    const bool moment = group != NumberGroup::rotor && group != NumberGroup::friction;
    Direction& direction = directions[j];
    double mass = machine.platform.mass, length = reach + machine.platform.center_of_mass.norm();
    if (number.leg >= 0) {
      const Link& link = linkOf(machine, number);
      mass = link.mass;
      length = std::max(link.length, std::abs(link.center_of_mass));
    }
    const double power = group == NumberGroup::mass ? 0 : group == NumberGroup::center ? 1 : 2;
    direction.plausible = mass * std::pow(length, power);
    if (!moment) {
      double largest = 0;
      for (const Eigen::MatrixXd& table : comparison.columns)
        largest = std::max(largest, table.col(j).cwiseAbs().maxCoeff());
      direction.plausible = largest > 0 ? effort / largest : 1;
    }
    direction.unit =
        number.quantity == Quantity::center || number.quantity == Quantity::center_across ? "kg m" : number.unit;
    ++j;
  }
  for (; j < directions.size(); ++j)
    if (directions[j].kind == DirectionKind::offset)
      directions[j].plausible = effort;
    else if (directions[j].kind == DirectionKind::delay)
      directions[j].plausible = 0.01;
}

BaseFit fitBase(const SquareRoot& model, const std::vector<Direction>& directions, Eigen::Index count) {
  Eigen::VectorXd plausible(count);
  for (Eigen::Index j = 0; j < count; ++j) plausible(j) = directions[j].plausible;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(model.R.leftCols(count) * plausible.asDiagonal());
  const Eigen::MatrixXd triangle = qr.matrixR().topRows(std::min(model.R.rows(), count)).triangularView<Eigen::Upper>();
  const double largest = std::abs(triangle(0, 0));
  Eigen::Index rank = 0;
  while (rank < triangle.rows() && std::abs(triangle(rank, rank)) > std::max(visible, rounding * largest)) ++rank;
  const auto inner = triangle.topLeftCorner(rank, rank).triangularView<Eigen::Upper>();
  const Eigen::VectorXd projected = (qr.householderQ().transpose() * model.z).eval();
  const Eigen::VectorXd x = inner.solve(projected.head(rank)),
                        shared = inner.solve((qr.householderQ().transpose() * model.shared).head(rank));
  const Eigen::MatrixXd root = inner.solve(Eigen::MatrixXd::Identity(rank, rank));
  const Eigen::MatrixXd ties = inner.solve(triangle.topRightCorner(rank, count - rank));
  const auto of = [&](Eigen::Index i) { return static_cast<Eigen::Index>(qr.colsPermutation().indices()(i)); };
  BaseFit out;
  out.squares = model.rest + projected.tail(projected.size() - rank).squaredNorm();
  out.freedom = std::max<Eigen::Index>(model.rows - rank, 1);
  out.quantile = boost::math::quantile(boost::math::students_t(static_cast<double>(out.freedom)), 0.975);
  out.step = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < rank; ++i) {
    out.step(of(i)) = x(i) * plausible(of(i));
    BaseParameter base;
    base.terms.emplace_back(of(i), 1);
    base.nominal = directions[of(i)].nominal;
    for (Eigen::Index k = 0; k < count - rank; ++k) {
      if (std::abs(ties(i, k)) < 1e-6) continue;
      const Eigen::Index j = of(rank + k);
      const double factor = ties(i, k) * plausible(of(i)) / plausible(j);
      base.terms.emplace_back(j, factor);
      base.nominal += factor * directions[j].nominal;
    }
    base.value = base.nominal + x(i) * plausible(of(i));
    const double deviation = std::hypot(root.row(i).norm(), shared(i));
    base.deviation = deviation * plausible(of(i));
    if (deviation * visible <= 1 || shared(i) == 0) out.parameters.push_back(base);
  }
  for (Eigen::Index j = 0; j < count; ++j)
    if (model.R.col(j).norm() * plausible(j) < visible) out.unseen.push_back(j);
  return out;
}

CrossValidation crossValidate(const Whitened& whitened, const Comparison& comparison) {
  const Eigen::Index fitted = comparison.further(), instants = whitened.rows.rows() / 6,
                     train = static_cast<Eigen::Index>(train_share * static_cast<double>(instants)),
                     left = 6 * std::min<Eigen::Index>(instants - train, most_tested);
  Eigen::MatrixXd rows(6 * train + fitted, fitted + 1);
  rows << whitened.rows.topLeftCorner(6 * train, fitted), whitened.rows.rightCols<1>().head(6 * train),
      Eigen::MatrixXd::Zero(fitted, fitted + 1);
  for (Eigen::Index j = 0; j < fitted; ++j)  // numbers that the first part does not show stay within their size
    rows(6 * train + j, j) = 1 / comparison.directions[j].plausible;
  const SquareRoot root = squareRootOf(rows);
  const auto triangle = root.R.triangularView<Eigen::Upper>();
  const Eigen::MatrixXd tested = whitened.rows.block(6 * train, 0, left, fitted);
  const Eigen::VectorXd y = whitened.rows.rightCols<1>().segment(6 * train, left), x = triangle.solve(root.z);
  const Eigen::MatrixXd uncertain = triangle.solve<Eigen::OnTheRight>(tested);
  const Eigen::LLT<Eigen::MatrixXd> expected(Eigen::MatrixXd::Identity(left, left) + uncertain * uncertain.transpose());
  const auto size = static_cast<double>(left);
  CrossValidation out;
  out.given = std::sqrt(y.squaredNorm() / size);
  out.fitted = std::sqrt(expected.matrixL().solve(y - tested * x).squaredNorm() / size);
  out.from_s = comparison.t(train);
  return out;
}

}  // namespace ursula::identification
