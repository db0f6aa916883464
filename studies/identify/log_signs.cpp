#include "studies/identify/log_signs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ursula::identification {
namespace {

constexpr double surely_alike = 0.9, hardly_alike = 0.5;

/// Correlation of model and measurement without their means, and the factor between them.
struct Likeness {
  double correlation = 0, factor = 0;
};

Likeness likeness(const Eigen::VectorXd& model, const Eigen::VectorXd& measured) {
  const Eigen::VectorXd s = model.array() - model.mean(), d = measured.array() - measured.mean();
  const double size = s.norm() * d.norm();
  return size > 0 ? Likeness{s.dot(d) / size, s.dot(d) / s.squaredNorm()} : Likeness{};
}

Eigen::VectorXd combined(const Eigen::VectorXd& first, const Eigen::VectorXd& second, Eigen::Index coarse) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(first.size() + (second.size() - 1) * coarse);
  for (Eigen::Index j = 0; j < second.size(); ++j) out.segment(j * coarse, first.size()) += second(j) * first;
  return out;
}

void add(std::vector<LogFinding>& findings, std::vector<MeasuredCause>& causes, const char* kind, int motor,
         double value, const std::string& what) {
  findings.push_back({kind, motor, value, "", what});
  MeasuredCause cause;
  cause.kind = kind;
  cause.what = what;
  cause.motor = motor + 1;
  cause.found = value;
  cause.explained = 1;
  causes.push_back(cause);
}

}  // namespace

void findSigns(MeasuredLog& log, const Motors& motors, std::vector<LogFinding>& findings) {
  for (int k = 0; k < motor_count; ++k) {
    const std::string unit = motors[static_cast<std::size_t>(k)].effortUnit();
    const auto rows = saturatedRows(log.efforts.col(k));
    for (const Eigen::Index row : rows) log.missing[static_cast<std::size_t>(row)] = true;
    if (!rows.empty())
      findings.push_back(
          {"saturation", k, static_cast<double>(rows.size()) / static_cast<double>(log.rows()), "",
           fmt::format("the effort of motor {} rests at {:.6g} {} in {} rows from {:.6g} s on: clipped, and left out",
                       k + 1, log.efforts(rows.front(), k), unit, rows.size(),
                       log.time(static_cast<double>(rows.front())))});
  }
  const auto quantised = [&](const Eigen::VectorXd& signal, int channel, const std::string& what,
                             const std::string& unit) {
    const double step = quantum(signal);
    if (step > 0 && step / std::sqrt(12.0) > 0.5 * whiteNoise(signal))
      findings.push_back({"quantisation", channel, step, unit,
                          fmt::format("{} comes in steps of {:.3g} {}, which is most of its noise", what, step, unit)});
  };
  for (int k = 0; k < motor_count; ++k) {
    const Motor& motor = motors[static_cast<std::size_t>(k)];
    quantised(log.efforts.col(k), k, fmt::format("the effort of motor {}", k + 1), motor.effortUnit());
    if (!log.has_poses)
      quantised(log.motion.col(k), k, fmt::format("the coordinate of motor {}", k + 1), motor.slides() ? "m" : "rad");
  }
}

void findMistakes(const ModelledLog& modelled, const Motors& motors, std::vector<LogFinding>& findings,
                  std::vector<MeasuredCause>& causes) {
  const Eigen::MatrixXd measured = modelled.filtered().efforts(), &model = modelled.efforts();
  Eigen::Matrix<double, 6, 6> alike;
  Vector6d factors;
  for (int k = 0; k < motor_count; ++k)
    for (int j = 0; j < motor_count; ++j) {
      const Likeness found = likeness(model.col(k), measured.col(j));
      alike(k, j) = found.correlation;
      if (k == j) factors(k) = found.factor;
    }
  bool exchanged = false;
  for (int k = 0; k < motor_count; ++k)
    for (int j = k + 1; j < motor_count; ++j)
      if (alike(k, j) > surely_alike && alike(j, k) > surely_alike && alike(k, k) < hardly_alike &&
          alike(j, j) < hardly_alike) {
        exchanged = true;
        add(findings, causes, "order", k, j + 1,
            fmt::format("the efforts of motors {} and {} look exchanged", k + 1, j + 1));
      }
  for (int k = 0; k < motor_count; ++k)
    if (!exchanged && alike(k, k) < -surely_alike)
      add(findings, causes, "sign", k, -1, fmt::format("the effort of motor {} has the other sign", k + 1));
  const double power = factors.cwiseAbs().cwiseMax(1e-300).array().log10().mean();
  if (alike.diagonal().minCoeff() > surely_alike && std::abs(power) > 1.5)
    add(findings, causes, "units", -1, std::pow(10.0, power),
        fmt::format("all efforts are {:.4g} times the model's: expected {}", std::pow(10.0, power),
                    motors[0].slides() ? "N" : "N m"));
}

ExpectedNoise expectedNoise(const ModelledLog& modelled, const MeasuredLog& log, const Periods& periods) {
  ExpectedNoise out;
  if (log.has_poses) return out;
  const FilteredLog& filtered = modelled.filtered();
  const double averaged = std::sqrt(static_cast<double>(periods.count));
  const auto gain = [&](const Eigen::VectorXd& first) {
    return combined(first, filtered.second().value, filtered.plan().coarse).norm();
  };
  const double effort_gain = Kernel(filtered.plan().effort_cut, log.step).value.norm();
  const std::array<double, 3> gains = {gain(filtered.first().value), gain(filtered.first().rate),
                                       gain(filtered.first().acceleration)};
  const std::array<Matrix6d, 3> slopes = modelled.sensitivity();
  for (int k = 0; k < motor_count; ++k) {
    const double effort = periods.count > 1 ? periods.effort_noise(k) / averaged : whiteNoise(log.efforts.col(k));
    double square = 0;
    for (int j = 0; j < motor_count; ++j) {
      const double motion = periods.count > 1 ? periods.motion_noise(j) / averaged : whiteNoise(log.motion.col(j));
      for (std::size_t what = 0; what < 3; ++what) square += std::pow(slopes[what](k, j) * motion * gains[what], 2);
    }
    out.of_motion(k) = std::sqrt(square);
    out.whole(k) = std::hypot(effort * effort_gain, out.of_motion(k));
  }
  return out;
}

}  // namespace ursula::identification
