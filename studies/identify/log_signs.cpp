#include "studies/identify/results.h"

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
    const std::string unit = motors[k].effortUnit();
    const auto rows = saturatedRows(log.efforts.col(k));
    for (const Eigen::Index row : rows) log.missing[row] = true;
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
    const Motor& motor = motors[k];
    quantised(log.efforts.col(k), k, fmt::format("the effort of motor {}", k + 1), motor.effortUnit());
    if (!log.has_poses)
      quantised(log.motion.col(k), k, fmt::format("the coordinate of motor {}", k + 1), motor.slides() ? "m" : "rad");
  }
}

void findMistakes(const ModelledLog& modelled, const Motors& motors, std::vector<LogFinding>& findings,
                  std::vector<MeasuredCause>& causes) {
  const Eigen::MatrixXd measured = modelled.filtered().efforts(0), &model = modelled.efforts();
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

}  // namespace ursula::identification
