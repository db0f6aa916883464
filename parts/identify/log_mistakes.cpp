#include "parts/identify/results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ursula::identification {
namespace {

/// A mistake explains efforts if it leaves less than this share of their squared deviation.
constexpr double explains = 0.05;
/// Efforts are those of another unit if their factor is this far from 1, as a logarithm to base 10.
constexpr double least_power = 1.5;

/// Adds a finding that is a cause.
void add(IdentifyResult& out, const char* kind, int motor, double value, const std::string& what) {
  out.findings.push_back({kind, motor, value, "", what, LogFinding::Decides::fail});
  out.causes.push_back({kind, "", what, "", motor + 1, 0, value});
  out.causes.back().explained = 1;
  out.causes.back().misread = true;
}

/// Looks for another order of the motors that explains the efforts. `left` has the squared deviation of the model's
/// efforts (rows) from each measured column.
bool findOrder(const Matrix6d& left, IdentifyResult& out) {
  PerMotor<Eigen::Index> column{};
  std::vector<int> moved;
  double before = 0, after = 0;
  for (int k = 0; k < motor_count; ++k) {
    const double least = left.row(k).minCoeff(&column[k]);
    if (std::find(column.begin(), column.begin() + k, column[k]) != column.begin() + k) return false;
    if (column[k] == k) continue;
    moved.push_back(k + 1);
    before += left(k, k);
    after += least;
  }
  if (moved.empty() || !(after < explains * before)) return false;
  std::vector<Eigen::Index> found;
  for (const int motor : moved) found.push_back(column[motor - 1] + 1);
  add(out, "order", moved.front() - 1, static_cast<double>(found.front()),
      moved.size() == 2 ? fmt::format("the efforts of motors {} and {} look exchanged", moved[0], moved[1])
                        : fmt::format("the efforts of motors {} look like those in the columns of motors {}",
                                      fmt::join(moved, ", "), fmt::join(found, ", ")));
  return true;
}

}  // namespace

void findSaturation(MeasuredLog& log, const Motors& motors, IdentifyResult& out) {
  for (int k = 0; k < motor_count; ++k) {
    const std::string unit = motors[k].effortUnit();
    const auto rows = saturatedRows(log.efforts.col(k));
    for (const Eigen::Index row : rows) log.missing[row] = true;
    if (!rows.empty())
      out.findings.push_back(
          {"saturation", k, static_cast<double>(rows.size()) / static_cast<double>(log.rows()), "",
           fmt::format("the effort of motor {} rests at {:.6g} {} in {} rows from {:.6g} s on: clipped, and left out",
                       k + 1, log.efforts(rows.front(), k), unit, rows.size(),
                       log.time(static_cast<double>(rows.front())))});
  }
  const auto quantised = [&](const Eigen::VectorXd& signal, int channel, const std::string& what,
                             const std::string& unit) {
    const double step = quantum(signal);
    if (step > 0 && step / std::sqrt(12.0) > 0.5 * whiteNoise(signal))
      out.findings.push_back(
          {"quantisation", channel, step, unit,
           fmt::format("{} comes in steps of {:.3g} {}, which is most of its noise", what, step, unit)});
  };
  for (int k = 0; k < motor_count; ++k) {
    const Motor& motor = motors[k];
    quantised(log.efforts.col(k), k, fmt::format("the effort of motor {}", k + 1), motor.effortUnit());
    if (!log.has_poses)
      quantised(log.motion.col(k), k, fmt::format("the coordinate of motor {}", k + 1), motor.slides() ? "m" : "rad");
  }
}

void findMistakes(const ModelledLog& modelled, const Motors& motors, IdentifyResult& out) {
  const Eigen::MatrixXd measured = modelled.filtered().efforts(0), &model = modelled.efforts();
  Matrix6d left;
  for (int k = 0; k < motor_count; ++k)
    for (int j = 0; j < motor_count; ++j) left(k, j) = (model.col(k) - measured.col(j)).squaredNorm();
  const bool exchanged = findOrder(left, out);
  for (int k = 0; k < motor_count; ++k)
    if (!exchanged && (-model.col(k) - measured.col(k)).squaredNorm() < explains * left(k, k))
      add(out, "sign", k, -1, fmt::format("the effort of motor {} has the other sign", k + 1));
  const double factor = model.cwiseProduct(measured).sum() / model.squaredNorm();
  if (factor > 0 && std::abs(std::log10(factor)) > least_power &&
      (model * factor - measured).squaredNorm() < explains * measured.squaredNorm())
    add(out, "units", -1, factor,
        fmt::format("all efforts are {:.4g} times the model's: expected {}", factor, motors[0].slides() ? "N" : "N·m"));
}

void findUnitOfTime(double of_motion, IdentifyResult& out) {
  constexpr double near = 0.02;
  const std::array<std::pair<double, const char*>, 2> units = {{{1e3, "milliseconds"}, {1e6, "microseconds"}}};
  for (const auto& [factor, unit] : units)
    if (std::abs(out.duration / (factor * of_motion) - 1) < near)
      add(out, "units", -1, factor,
          fmt::format("the log lasts {:.4g} s and the scenario's motion {:.4g} s: its instants look like {}",
                      out.duration, of_motion, unit));
}

bool isStill(const MeasuredLog& log) {
  constexpr double of_noise = 12;  // the largest of 10 million normal deviates is within 6 deviations on either side
  for (Eigen::Index k = 0; k < log.motion.cols(); ++k) {
    const auto channel = log.motion.col(k);
    if (channel.maxCoeff() - channel.minCoeff() > of_noise * whiteNoise(channel)) return false;
  }
  return true;
}

}  // namespace ursula::identification
