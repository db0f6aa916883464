#include "studies/identify/estimate.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace ursula::identification {
namespace {

constexpr int most_order = 6;
constexpr double most_memory = 0.5;  ///< largest sum of an autoregression's coefficients
constexpr double visible = 0.1, train_share = 0.7, rounding = 1e-9;

/// Returns [columns
/// measured − model] of motor k.
Eigen::MatrixXd tableOf(const Comparison& comparison, int k) {
  const Eigen::MatrixXd& columns = comparison.columns[static_cast<std::size_t>(k)];
  Eigen::MatrixXd out(columns.rows(), columns.cols() + 1);
  out << columns, comparison.measured.col(k) - comparison.model.col(k);
  return out;
}

/// Returns the solution and the residual of a least-squares fit of the last column by the first `count`, and sets the
/// rank.
std::pair<Eigen::VectorXd, Eigen::VectorXd> leastSquares(const Eigen::MatrixXd& rows, Eigen::Index count,
                                                         Eigen::Index& rank) {
  Eigen::VectorXd scale = rows.leftCols(count).colwise().norm().transpose();
  for (double& each : scale) each = each > 0 ? 1 / each : 0;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows.leftCols(count) * scale.asDiagonal());
  qr.setThreshold(1e-7);
  rank = qr.rank();
  const Eigen::VectorXd y = rows.rightCols<1>(), x = qr.solve(y);
  return {scale.asDiagonal() * x, y - rows.leftCols(count) * (scale.asDiagonal() * x)};
}

/// Fits x(i) by x(i − 1), …, x(i − order) with least squares within segments. Returns the coefficients and sets the
/// remaining variance.
Eigen::VectorXd autoregression(const Eigen::VectorXd& x, const std::vector<Segment>& segments, int order,
                               double& left) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(order, order);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(order);
  double squares = 0;
  Eigen::Index count = 0;
  for (const Segment& segment : segments)
    for (Eigen::Index i = segment.first + most_order; i < segment.end; ++i, ++count) {
      const Eigen::VectorXd before = x.segment(i - order, order).reverse();
      normal += before * before.transpose();
      right += before * x(i);
      squares += x(i) * x(i);
    }
  const Eigen::VectorXd found = order == 0 ? Eigen::VectorXd() : Eigen::VectorXd(normal.ldlt().solve(right));
  left = count == 0 ? 0 : (squares - (order == 0 ? 0 : found.dot(right))) / static_cast<double>(count);
  return found;
}

/// Returns the order by Akaike's criterion, the same for all motors. An order with drifting noise is refused, because
/// it fits more than noise. A wrong delay or model leaves a smooth residual, which a fit of its differences would no
/// longer see. A short residual shows no order, because the fitted numbers took too much of it.
int orderOf(const Eigen::MatrixXd& residual, const std::vector<Segment>& segments) {
  const auto rows = static_cast<double>(residual.rows());
  const int most = std::min(most_order, static_cast<int>(rows / 200));
  double best = std::numeric_limits<double>::infinity();
  int found = 0;
  for (int order = 0; order <= most; ++order) {
    double criterion = 2 * motor_count * order;
    bool drifts = false;
    for (int k = 0; k < motor_count; ++k) {
      double left = 0;
      drifts = drifts || autoregression(residual.col(k), segments, order, left).sum() > most_memory;
      criterion += rows * std::log(std::max(left, 1e-300));
    }
    if (criterion < best && !drifts) {
      best = criterion;
      found = order;
    }
  }
  return found;
}

Eigen::MatrixXd filteredBy(const Eigen::VectorXd& coefficients, const std::vector<Segment>& segments,
                           const Eigen::MatrixXd& x) {
  const Eigen::Index order = coefficients.size();
  std::vector<Eigen::Index> rows;
  for (const Segment& segment : segments)
    for (Eigen::Index i = segment.first + order; i < segment.end; ++i) rows.push_back(i);
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), x.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out.row(static_cast<Eigen::Index>(i)) = x.row(rows[i]);
    for (Eigen::Index j = 0; j < order; ++j)
      out.row(static_cast<Eigen::Index>(i)) -= coefficients(j) * x.row(rows[i] - 1 - j);
  }
  return out;
}

/// Merges the motors' tables, six rows for each instant; `by` multiplies each instant's six rows.
Eigen::MatrixXd interleaved(const MotorTables& tables, const Matrix6d& by) {
  Eigen::MatrixXd out(6 * tables[0].rows(), tables[0].cols());
  for (int k = 0; k < motor_count; ++k) {
    Eigen::MatrixXd mixed = Eigen::MatrixXd::Zero(tables[0].rows(), tables[0].cols());
    for (int j = 0; j < motor_count; ++j)
      if (by(k, j) != 0) mixed += by(k, j) * tables[static_cast<std::size_t>(j)];
    for (Eigen::Index i = 0; i < mixed.rows(); ++i) out.row(6 * i + k) = mixed.row(i);
  }
  return out;
}

Matrix6d whiteningOf(const Eigen::MatrixXd& residual, double correction, const Vector6d& numerical) {
  Matrix6d covariance = residual.transpose() * residual * correction / static_cast<double>(residual.rows());
  const double floor = 1e-24 * std::max(covariance.diagonal().maxCoeff(), 1e-280);
  covariance.diagonal().array() += floor + numerical.array().square();
  return Matrix6d(covariance.llt().matrixL()).triangularView<Eigen::Lower>().solve(Matrix6d::Identity());
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
  return out;
}

Whitened whiten(const Comparison& comparison) {
  const Eigen::Index fitted = comparison.further(), instants = comparison.model.rows();
  MotorTables tables;
  for (int k = 0; k < motor_count; ++k) tables[static_cast<std::size_t>(k)] = tableOf(comparison, k);
  Whitened out;
  Matrix6d by = Matrix6d::Identity();
  for (int k = 0; k < motor_count; ++k)
    by(k, k) = 1 / std::max(std::sqrt(tables[static_cast<std::size_t>(k)].rightCols<1>().squaredNorm() /
                                      static_cast<double>(instants)),
                            1e-280);
  out.rows = interleaved(tables, by);
  for (int pass = 0; pass < 3; ++pass) {
    const Eigen::VectorXd x = leastSquares(out.rows, fitted, out.rank).first;
    out.residual.resize(instants, motor_count);
    for (int k = 0; k < motor_count; ++k) {
      const Eigen::MatrixXd& table = tables[static_cast<std::size_t>(k)];
      out.residual.col(k) = table.rightCols<1>() - table.leftCols(fitted) * x;
    }
    out.order = orderOf(out.residual, comparison.segments);
    MotorTables white;
    Eigen::MatrixXd left;
    for (int k = 0; k < motor_count; ++k) {
      double unused = 0;
      const Eigen::VectorXd a = autoregression(out.residual.col(k), comparison.segments, out.order, unused);
      white[static_cast<std::size_t>(k)] = filteredBy(a, comparison.segments, tables[static_cast<std::size_t>(k)]);
      const Eigen::VectorXd column = filteredBy(a, comparison.segments, out.residual.col(k));
      if (k == 0) left.resize(column.size(), motor_count);
      left.col(k) = column;
    }
    const double rows = 6.0 * static_cast<double>(left.rows());
    const double correction = rows / std::max(rows - static_cast<double>(out.rank + motor_count * out.order), 1.0);
    out.rows = interleaved(white, whiteningOf(left, correction, comparison.numerical));
  }
  return out;
}

void setPlausible(const ManipulatorParameters& machine, const Comparison& comparison,
                  std::vector<Direction>& directions) {
  double reach = 0;
  for (const Leg& leg : machine.legs) reach = std::max(reach, leg.platform_point.norm());
  const double effort = std::sqrt(comparison.model.squaredNorm() / static_cast<double>(comparison.model.size()));
  const ManipulatorParameters rotors = withRotors(machine);
  std::size_t j = 0;
  for (const MachineNumber& number : machineNumbers(rotors)) {
    const bool moment = number.group == "mass" || number.group == "center" || number.group == "inertia";
    if (!moment && number.group != "rotor" && number.quantity != Quantity::friction &&
        number.quantity != Quantity::coulomb)
      continue;
    Direction& direction = directions[j];
    const Leg& leg = machine.legs[static_cast<std::size_t>(std::max(number.leg, 0))];
    const Link& link = number.body == "proximal" ? leg.proximal : leg.distal;
    const double mass = number.leg < 0 ? machine.platform.mass : link.mass;
    const double length = number.leg < 0 ? reach + machine.platform.center_of_mass.norm()
                                         : std::max(link.length, std::abs(link.center_of_mass));
    const double power = number.group == "mass" ? 0 : number.group == "center" ? 1 : 2;
    direction.plausible = mass * std::pow(length, power);
    if (!moment) {
      double largest = 0;
      for (const Eigen::MatrixXd& table : comparison.columns)
        largest = std::max(largest, table.col(static_cast<Eigen::Index>(j)).cwiseAbs().maxCoeff());
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
  for (Eigen::Index j = 0; j < count; ++j) plausible(j) = directions[static_cast<std::size_t>(j)].plausible;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(model.R.leftCols(count) * plausible.asDiagonal());
  const Eigen::MatrixXd triangle = qr.matrixR().topRows(std::min(model.R.rows(), count)).triangularView<Eigen::Upper>();
  const double largest = std::abs(triangle(0, 0));
  Eigen::Index rank = 0;
  while (rank < triangle.rows() && std::abs(triangle(rank, rank)) > std::max(visible, rounding * largest)) ++rank;
  const auto inner = triangle.topLeftCorner(rank, rank).triangularView<Eigen::Upper>();
  const Eigen::VectorXd projected = (qr.householderQ().transpose() * model.z).eval();
  const Eigen::VectorXd x = inner.solve(projected.head(rank));
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
    base.nominal = directions[static_cast<std::size_t>(of(i))].nominal;
    for (Eigen::Index k = 0; k < count - rank; ++k) {
      if (std::abs(ties(i, k)) < 1e-6) continue;
      const Eigen::Index j = of(rank + k);
      const double factor = ties(i, k) * plausible(of(i)) / plausible(j);
      base.terms.emplace_back(j, factor);
      base.nominal += factor * directions[static_cast<std::size_t>(j)].nominal;
    }
    base.value = base.nominal + x(i) * plausible(of(i));
    base.deviation = root.row(i).norm() * plausible(of(i));
    out.parameters.push_back(base);
  }
  for (Eigen::Index j = 0; j < count; ++j)
    if (model.R.col(j).norm() * plausible(j) < visible) out.unseen.push_back(j);
  return out;
}

CrossValidation crossValidate(const Whitened& whitened, const Comparison& comparison) {
  const Eigen::Index fitted = comparison.further(), instants = whitened.rows.rows() / 6,
                     train = static_cast<Eigen::Index>(train_share * static_cast<double>(instants));
  Eigen::MatrixXd rows(6 * train, fitted + 1);
  rows << whitened.rows.topLeftCorner(6 * train, fitted), whitened.rows.col(whitened.rows.cols() - 1).head(6 * train);
  const Eigen::VectorXd x = fitBase(squareRootOf(rows), comparison.directions, fitted).step;
  const Eigen::Index left = 6 * (instants - train);
  const Eigen::VectorXd y = whitened.rows.col(whitened.rows.cols() - 1).tail(left);
  CrossValidation out;
  out.given = std::sqrt(y.squaredNorm() / static_cast<double>(left));
  out.fitted =
      std::sqrt((y - whitened.rows.block(6 * train, 0, left, fitted) * x).squaredNorm() / static_cast<double>(left));
  out.from_s = comparison.t(std::min(
      comparison.t.size() - 1, static_cast<Eigen::Index>(train_share * static_cast<double>(comparison.t.size()))));
  return out;
}

}  // namespace ursula::identification
