#include <fmt/format.h>

#include <cmath>

#include "parts/identify/comparison.h"

namespace ursula::identification {
namespace {

/// Step of a number for its derivative, as a share of its size.
constexpr double relative_step = 1e-6;
/// Share of a motor's effort at which a backlash has changed sides.
constexpr double side_share = 0.02;

}  // namespace

/// Computes efforts at the settled instants for a machine with other numbers, with the measured motion of the motors.
Eigen::MatrixXd ModelledLog::effortsOf(const Manipulator& machine) const {
  const MotorChain chain(machine);
  Eigen::MatrixXd out(filtered_.settled().size(), motor_count);
  for (Eigen::Index row = 0; row < out.rows(); ++row) {
    const Eigen::Index i = filtered_.settled()[row];
    out.row(row) = efforts_.row(i);
    if (const auto motion = has_poses_ ? motions_[i] : chain.follow(filtered_.state(i), motions_[i]))
      out.row(row) = chain.efforts(*motion, loads_[i]).transpose();
  }
  return out;
}

void ModelledLog::addNumbers(Comparison& out) const {
  const ManipulatorParameters& nominal = scenario_.manipulator->parameters();
  const Eigen::MatrixXd unchanged = effortsOf(*scenario_.manipulator);
  for (const MachineNumber& number : machineNumbers(nominal)) {
    if (number.isLinear()) continue;
    const double size = std::max(number.size(nominal), 1e-3), value = number.get(nominal), step = relative_step * size;
    if (number.group() == NumberGroup::friction && nominal.legs[number.leg].coulomb.any() == false) continue;
    ManipulatorParameters changed = nominal;
    number.set(changed, value + step);
    add(out, {DirectionKind::number, number.path, number.words, number.unit, -1, value, 0.01 * size},
        (effortsOf(Manipulator(changed)) - unchanged) / step);
  }
}

/// Computes the derivatives of efforts by the measured motion at the settled instants.
std::vector<Eigen::MatrixXd> ModelledLog::slopes() const {
  std::vector<Eigen::MatrixXd> out;
  for (const Eigen::Index i : filtered_.settled()) {
    const MeasuredState& state = filtered_.state(i);
    const Eigen::Index channels = state.value.size();
    out.push_back(Eigen::MatrixXd::Zero(motor_count, 3 * channels));
    for (Eigen::Index k = 0; k < 3 * channels; ++k) {
      MeasuredState moved = state;
      const Eigen::Index which = k / channels;
      (which == 0 ? moved.value : which == 1 ? moved.rate : moved.acceleration)(k % channels) += relative_step;
      if (const auto motion = motionNear(i, moved))
        out.back().col(k) = (chain_.efforts(*motion, loads_[i]) - efforts_.row(i).transpose()) / relative_step;
    }
  }
  return out;
}

/// Adds the effects of a motor's own effort and of a wrong coordinate.
void ModelledLog::addSeries(Comparison& out) const {
  const Motors& motors = scenario_.manipulator->motors();
  const auto rows = out.model.rows();
  const auto withRates = [&](const Eigen::VectorXd& series) {
    Eigen::MatrixXd error(rows, 3);
    error << filtered_.lowPass(series), filtered_.lowPassBy(filtered_.second().rate, series),
        filtered_.lowPassBy(filtered_.second().acceleration, series);
    return error;
  };
  const auto changedBy = [&](int motor, const Eigen::MatrixXd& error) {
    Eigen::MatrixXd change(rows, motor_count);
    for (Eigen::Index row = 0; row < rows; ++row) {
      const Eigen::MatrixXd& slope = out.slopes[row];
      change.row(row) = (slope.col(motor) * error(row, 0) + slope.col(motor_count + motor) * error(row, 1) +
                         slope.col(2 * motor_count + motor) * error(row, 2))
                            .transpose();
    }
    return change;
  };
  for (int k = 0; k < motor_count; ++k) {
    const Motor& motor = motors[k];
    const std::string of = fmt::format(" of motor {}", k + 1), effort = motor.effortUnit(),
                      length = motor.slides() ? "m" : "rad";
    const Eigen::VectorXd S = efforts_.col(k);
    Eigen::MatrixXd column = Eigen::MatrixXd::Zero(rows, motor_count);
    column.col(k) = filtered_.lowPass(S);
    add(out, {DirectionKind::scale, "", "scale of the effort" + of, "", k, 1, 0.1}, column);
    const double speed = scenario_.manipulator->leg(motor.leg).coulomb.speedOf(motor.coordinate);
    const Eigen::VectorXd rubbing = S.cwiseAbs().array() * (driven_rates_.col(k) / speed).array().tanh();
    column.col(k) = filtered_.lowPass(rubbing);
    add(out, {DirectionKind::load_friction, "", "friction by load" + of, "", k, 0, 0.1}, column);
    if (has_poses_) continue;
    Eigen::MatrixXd constant = Eigen::MatrixXd::Zero(rows, 3);
    constant.col(0).setOnes();
    add(out, {DirectionKind::encoder, "", "offset of the coordinate" + of, length, k, 0, 0.01}, changedBy(k, constant));
    add(out, {DirectionKind::elastic, "", "compliance of the joint" + of, length + "/" + effort, k, 0, 1e-4},
        changedBy(k, withRates(-S)));
    const double rms = std::sqrt(S.squaredNorm() / static_cast<double>(S.size()));
    const Eigen::VectorXd side = -0.5 * (S / (side_share * rms + 1e-300)).array().tanh();
    if (S.minCoeff() * S.maxCoeff() < 0)
      add(out, {DirectionKind::backlash, "", "backlash of the joint" + of, length, k, 0, 1e-3},
          changedBy(k, withRates(side)));
  }
}

}  // namespace ursula::identification
