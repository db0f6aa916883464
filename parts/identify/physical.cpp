#include "parts/identify/estimate.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace ursula::identification {
namespace {

/// The barrier's weight is in halves of a squared deviation, so it moves the result by far less than the noise. A
/// number is identified if its uncertainty is below `identified_share` of its assumed size.
constexpr double barrier_weight = 1e-2, identified_share = 0.1;

bool isPositive(const MachineNumber& number) {
  return number.isLinear() && number.group() != NumberGroup::center && number.group() != NumberGroup::inertia;
}

const Matrix3d& inertiaOf(const ManipulatorParameters& machine, const MachineNumber& number) {
  return number.leg < 0 ? machine.platform.inertia : linkOf(machine, number).inertia;
}

/// Returns a matrix that is positive definite exactly if the moments of inertia are positive and keep the triangle
/// inequality.
Matrix3d spreadOf(const Matrix3d& inertia) { return 0.5 * inertia.trace() * Matrix3d::Identity() - inertia; }

/// Returns whether the tensor is that of a thin rod. Such a tensor is not estimated, because it lies on the barrier.
bool isThin(const Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(spreadOf(inertia), Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0) < 1e-9 * solver.eigenvalues()(2);
}

class MachineFit {
 public:
  MachineFit(const SquareRoot& model, const Comparison& comparison, const ManipulatorParameters& machine,
             const NumberTolerances& tolerances, bool by_tolerances)
      : model_(model), comparison_(comparison), nominal_(withRotors(machine)), machine_(nominal_) {
    const auto numbers = machineNumbers(nominal_);
    std::size_t linear = 0;
    for (std::size_t j = 0; j < numbers.size(); ++j) {
      const MachineNumber& number = numbers[j];
      if (!number.isLinear()) continue;
      const double plausible = comparison.directions[linear++].plausible;
      NumberEstimate estimate{number, assumed(number, plausible), {number.path, name(number.group()), number.unit}};
      estimate.measured.nominal = stated(number.get(nominal_));
      if (const auto at = tolerances.find(number.path); at != tolerances.end()) {
        estimate.measured.tolerance = at->second;
        if (by_tolerances) estimate.before = at->second;
      }
      if (number.group() == NumberGroup::inertia && isThin(inertiaOf(nominal_, number))) estimate.before = 0;
      if (estimate.before > 0) {
        free_.push_back(estimates_.size());
        columns_.push_back(j);
      }
      estimates_.push_back(estimate);
    }
    start();
  }

  std::vector<NumberEstimate> fit() {
    double cost = costOf(machine_, rest_);
    for (int pass = 0; pass < 60; ++pass) {
      const Eigen::VectorXd step = newtonStep();
      double share = 1;
      ManipulatorParameters next;
      Eigen::VectorXd rest;
      double found = std::numeric_limits<double>::infinity();
      for (; share > 1e-6 && !(found < cost); share /= 2) {
        std::tie(next, rest) = moved(step * share);
        found = costOf(next, rest);
      }
      if (!(found < cost)) break;
      const bool settled = cost - found < 1e-9 * (1 + std::abs(cost));
      machine_ = next;
      rest_ = rest;
      cost = found;
      if (settled) break;
    }
    setResults();
    return std::move(estimates_);
  }

 private:
  /// Returns the prior uncertainty, which is about the number's own size.
  double assumed(const MachineNumber& number, double plausible) const {
    if (number.group() == NumberGroup::center)
      return plausible / (number.leg < 0 ? nominal_.platform.mass : linkOf(nominal_, number).mass);
    return number.group() == NumberGroup::inertia ? std::max(number.size(nominal_), 0.05 * plausible)
                                                  : std::max(plausible, number.get(nominal_));
  }

  /// Friction and rotors that the scenario lacks start slightly above zero, inside the barrier.
  void start() {
    rest_ = Eigen::VectorXd::Zero(motor_count + 1);
    for (const std::size_t j : free_)
      if (isPositive(estimates_[j].number) && !(estimates_[j].measured.nominal > 1e-200))
        estimates_[j].number.set(machine_, 1e-3 * estimates_[j].before);
    pi_nominal_ = momentsOf(nominal_).first;
  }

  /// Returns the linear parameters of the efforts, and their derivatives by the free numbers. Derivatives need a valid
  /// machine.
  std::pair<Eigen::VectorXd, Eigen::MatrixXd> momentsOf(const ManipulatorParameters& machine) const {
    const EffortDerivatives derivatives((Manipulator(machine)));
    const Eigen::MatrixXd all = derivatives.regressorByParameters();
    Eigen::MatrixXd slopes(all.rows(), columns_.size());
    for (std::size_t j = 0; j < columns_.size(); ++j) slopes.col(j) = all.col(columns_[j]);
    return {derivatives.regressorValues(), slopes};
  }

  Eigen::VectorXd leftOf(const Eigen::VectorXd& moments, const Eigen::VectorXd& rest) const {
    const Eigen::Index linear = comparison_.linear;
    return model_.z - model_.R.leftCols(linear) * (moments - pi_nominal_) -
           model_.R.middleCols(linear, motor_count + 1) * rest;
  }

  double costOf(const ManipulatorParameters& machine, const Eigen::VectorXd& rest) const {
    double cost = 0;
    for (const std::size_t j : free_) {
      const NumberEstimate& each = estimates_[j];
      const double value = each.number.get(machine);
      cost += 0.5 * std::pow((value - each.measured.nominal) / each.before, 2);
      if (isPositive(each.number)) {
        if (!(value > 0)) return std::numeric_limits<double>::infinity();
        cost -= barrier_weight * std::log(value / each.before);
      }
      if (each.number.group() != NumberGroup::inertia || each.number.entry != 0) continue;
      const Eigen::LLT<Matrix3d> spread(spreadOf(inertiaOf(machine, each.number)));
      if (spread.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
      cost -= 2 * barrier_weight * Matrix3d(spread.matrixL()).diagonal().array().log().sum();
    }
    try {
      return cost + 0.5 * leftOf(momentsOf(machine).first, rest).squaredNorm();
    } catch (const std::exception&) {  // no machine can have these numbers
      return std::numeric_limits<double>::infinity();
    }
  }

  /// Adds the barrier of one body's moments of inertia.
  void addSpread(const MachineNumber& first, Eigen::MatrixXd& hessian, Eigen::VectorXd& gradient) const {
    const Matrix3d inverse = spreadOf(inertiaOf(machine_, first)).inverse();
    std::vector<std::pair<Eigen::Index, Matrix3d>> slopes;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const MachineNumber& number = estimates_[free_[k]].number;
      if (number.quantity != first.quantity || number.leg != first.leg || number.body != first.body) continue;
      Matrix3d unit = Matrix3d::Zero();
      const auto& [i, j] = tensor_entries[number.entry];
      unit(i, j) = unit(j, i) = 1;
      slopes.emplace_back(k, inverse * spreadOf(unit));
    }
    for (const auto& [k, a] : slopes) {
      gradient(k) -= barrier_weight * a.trace();
      for (const auto& [l, b] : slopes) hessian(k, l) += barrier_weight * (a * b).trace();
    }
  }

  Eigen::MatrixXd jacobian(const Eigen::MatrixXd& slopes) const {
    const Eigen::Index linear = comparison_.linear;
    Eigen::MatrixXd out(model_.R.rows(), slopes.cols() + motor_count + 1);
    out << model_.R.leftCols(linear) * slopes, model_.R.middleCols(linear, motor_count + 1);
    return out;
  }

  Eigen::MatrixXd information(const Eigen::MatrixXd& slopes) const {
    const Eigen::MatrixXd J = jacobian(slopes);
    Eigen::MatrixXd out = J.transpose() * J;
    for (std::size_t k = 0; k < free_.size(); ++k) out(k, k) += 1 / std::pow(estimates_[free_[k]].before, 2);
    return out;
  }

  Eigen::VectorXd newtonStep() const {
    const auto [moments, slopes] = momentsOf(machine_);
    Eigen::MatrixXd hessian = information(slopes);
    Eigen::VectorXd gradient = -jacobian(slopes).transpose() * leftOf(moments, rest_);
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const NumberEstimate& each = estimates_[free_[k]];
      const auto at = k;
      const double value = each.number.get(machine_);
      gradient(at) += (value - each.measured.nominal) / std::pow(each.before, 2);
      if (isPositive(each.number)) {
        gradient(at) -= barrier_weight / value;
        hessian(at, at) += barrier_weight / (value * value);
      }
      if (each.number.group() == NumberGroup::inertia && each.number.entry == 0)
        addSpread(each.number, hessian, gradient);
    }
    return -scaledSolve(hessian, gradient);
  }

  /// Scales the system, because unknowns differ by many orders of magnitude.
  static Eigen::MatrixXd scaledSolve(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
    const Eigen::VectorXd scale = matrix.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::LDLT<Eigen::MatrixXd> factors(scale.asDiagonal() * matrix * scale.asDiagonal());
    return scale.asDiagonal() * factors.solve(scale.asDiagonal() * right);
  }

  std::pair<ManipulatorParameters, Eigen::VectorXd> moved(const Eigen::VectorXd& step) const {
    ManipulatorParameters next = machine_;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const MachineNumber& number = estimates_[free_[k]].number;
      number.set(next, number.get(machine_) + step(k));
    }
    return {next, rest_ + step.tail(motor_count + 1)};
  }

  void setResults() {
    const Eigen::MatrixXd slopes = momentsOf(machine_).second, whole = information(slopes);
    const Eigen::MatrixXd covariance = scaledSolve(whole, Eigen::MatrixXd::Identity(whole.rows(), whole.cols()));
    const Eigen::VectorXd shared = covariance * (jacobian(slopes).transpose() * model_.shared);
    for (NumberEstimate& each : estimates_) {
      each.measured.value = each.number.get(machine_);
      each.measured.uncertainty = each.before;
      each.measured.identified = false;
    }
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const NumberEstimate& each = estimates_[free_[k]];
      MeasuredNumber& measured = estimates_[free_[k]].measured;
      measured.uncertainty = std::sqrt(std::max(0.0, covariance(k, k)) + shared(k) * shared(k));
      measured.identified =
          measured.uncertainty < identified_share * assumed(each.number, comparison_.directions[free_[k]].plausible);
    }
  }

  const SquareRoot& model_;
  const Comparison& comparison_;
  ManipulatorParameters nominal_, machine_;
  std::vector<NumberEstimate> estimates_;
  std::vector<std::size_t> free_;
  std::vector<Eigen::Index> columns_;
  Eigen::VectorXd rest_, pi_nominal_;
};

}  // namespace

std::vector<NumberEstimate> estimateNumbers(const SquareRoot& model, const Comparison& comparison,
                                            const ManipulatorParameters& machine, const NumberTolerances& tolerances,
                                            bool by_tolerances) {
  return MachineFit(model, comparison, machine, tolerances, by_tolerances).fit();
}

}  // namespace ursula::identification
