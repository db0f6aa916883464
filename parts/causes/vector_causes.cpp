#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

#include "parts/causes/fits.h"
#include "parts/causes/tied_parameters.h"
#include "parts/causes/tried_causes.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// The three entries of one vector of the machine.
using Entries = std::vector<MachineNumber>;

std::vector<Entries> vectorsOf(const ManipulatorParameters& machine) {
  std::vector<Entries> out;
  for (const MachineNumber& number : machineNumbers(machine)) {
    if (number.entries != 3) continue;
    if (number.entry == 0) out.emplace_back();
    out.back().push_back(number);
  }
  return out;
}

void move(const Entries& entries, const Eigen::Vector3d& by, ManipulatorParameters& machine) {
  for (std::size_t k = 0; k < entries.size(); ++k)
    entries[k].set(machine, entries[k].get(machine) + by(static_cast<Eigen::Index>(k)));
}

/// The shortest solution. Ways that change nothing, such as an axis's own length, have the rounding of differences.
Vector3d leastSolution(const Matrix3d& matrix, const Vector3d& right, int& rank) {
  constexpr double nothing = 1e-10;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> ways(matrix);
  Vector3d out = Vector3d::Zero();
  rank = 0;
  for (int k = 0; k < 3; ++k)
    if (const double value = ways.eigenvalues()(k); value > nothing * ways.eigenvalues()(2)) {
      out += ways.eigenvectors().col(k) * (ways.eigenvectors().col(k).dot(right) / value);
      ++rank;
    }
  return out;
}

/// Fits a change of all entries of one vector to the residual by Gauss–Newton with differences.
class VectorFit {
 public:
  VectorFit(const Scenario& scenario, const Entries& entries, const TorqueResidual& data)
      : scenario_(scenario), entries_(entries), data_(data) {
    const double size = entries.front().size(scenario.manipulator->parameters());
    step_ = 1e-5 * (size > 0 ? size : 1);
    left_ = remaining(change_);
  }

  const Vector3d& change() const { return change_; }
  int rank() const { return rank_; }  ///< number of directions with an effect
  double unexplained() const { return left_.norm() / data_.norm(); }

  void improve(int steps) {
    for (int k = 0; k < steps && step(); ++k) {
    }
  }

 private:
  /// Stacked; infinite where the changed machine has no torques.
  Eigen::VectorXd remaining(const Vector3d& change) const {
    const auto rows = static_cast<Eigen::Index>(data_.motions.size());
    const auto left = [&] {
      ManipulatorParameters machine = scenario_.manipulator->parameters();
      move(entries_, change, machine);
      const Subject noc = nocSubject(Manipulator(machine), scenario_.load);
      Eigen::VectorXd out(motor_count * rows);
      for (Eigen::Index k = 0; k < rows; ++k) {
        out.segment<motor_count>(motor_count * k) = data_.found(k) - noc.torques(data_.motions[k]);
      }
      return out;
    };
    return unlessRefused(left).value_or(Eigen::VectorXd::Constant(motor_count * rows, HUGE_VAL));
  }

  bool step() {
    Eigen::Matrix<double, Eigen::Dynamic, 3> slopes(left_.size(), 3);
    for (int k = 0; k < 3; ++k) {
      const Vector3d little = step_ * Vector3d::Unit(k);
      slopes.col(k) = (remaining(change_ - little) - remaining(change_ + little)) / (2 * step_);
    }
    if (!slopes.allFinite() || !left_.allFinite()) return false;
    Vector3d by = leastSolution(slopes.transpose() * slopes, slopes.transpose() * left_, rank_);
    for (int halvings = 0; halvings < 8; ++halvings, by /= 2) {
      const Eigen::VectorXd there = remaining(change_ + by);
      if (!(there.norm() < left_.norm())) continue;
      change_ += by;
      left_ = there;
      return by.norm() > 1e-9 * step_;
    }
    return false;
  }

  const Scenario& scenario_;
  const Entries& entries_;
  const TorqueResidual& data_;
  double step_ = 0;
  int rank_ = 3;
  Vector3d change_ = Vector3d::Zero();
  Eigen::VectorXd left_;
};

/// "base axis of leg 3"
std::string ownerOf(const MachineNumber& first) {
  std::string what = first.words.substr(0, first.words.rfind(' '));
  const std::string body = name(first.body);
  if (first.leg < 0) return body.empty() ? what : body + " " + what;
  if (!body.empty()) what += " of the " + body + " link";
  return fmt::format("{} of leg {}", what, first.leg + 1);
}

std::string vectorText(const Entries& entries, const ManipulatorParameters& machine) {
  const auto entry = [&](std::size_t k) {
    const double value = entries[k].get(machine);
    return std::abs(value) > 1e-12 * entries[k].size(machine) ? value : 0;
  };
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", entry(0), entry(1), entry(2));
}

/// The straight way to the fitted change, which is at x = 1.
void addVector(const ManipulatorParameters& machine, const Entries& entries, const VectorFit& fit, TriedCauses& out) {
  const Vector3d change = fit.change();
  const char* but = fit.rank() < 3 ? " (but for a part without effect)" : "";
  const MachineNumber& first = entries.front();
  NamedCause named{CauseKind::parameter, "", bodyInCauses(first)};
  named.leg = first.leg + 1;
  named.parameter = first.path.substr(0, first.path.rfind('.'));
  out.addFitted([entries, change](ManipulatorParameters& other, double x) { move(entries, x * change, other); },
                [entries, change, machine, but](double x, double deviation) {
                  ManipulatorParameters other = machine;
                  move(entries, x * change, other);
                  const std::string& unit = entries.front().unit;
                  return fmt::format("{} {} +- {:.1g}{}{} instead of {}", ownerOf(entries.front()),
                                     vectorText(entries, other), deviation * change.norm(),
                                     unit.empty() ? "" : " " + unit, but, vectorText(entries, machine));
                },
                [named](double, double) { return named; });
}

}  // namespace

std::vector<Hypothesis> fitVectors(const Scenario& scenario, const TorqueResidual& data) {
  constexpr std::size_t few_instants = 20;
  constexpr double worth_fitting = 0.5, may_remain = 1e-3;  // three numbers explain a part of anything
  const TorqueResidual few = data.picked(few_instants);
  const ManipulatorParameters& machine = scenario.manipulator->parameters();
  std::vector<Hypothesis> out;
  for (const Entries& entries : vectorsOf(machine)) {
    VectorFit fit(scenario, entries, few);
    fit.improve(2);
    if (!(fit.unexplained() < worth_fitting)) continue;
    fit.improve(12);
    if (!(fit.unexplained() < may_remain)) continue;
    TriedCauses found{scenario};
    addVector(machine, entries, fit, found);
    for (Hypothesis& each : fitCauses(found.causes, data)) {
      each.free_numbers = fit.rank();
      if (each.unexplained < may_remain) out.push_back(std::move(each));
    }
  }
  return out;
}

}  // namespace ursula
