#include <fmt/format.h>

#include <cmath>

#include "studies/identify/comparison.h"

namespace ursula::identification {
namespace {

/// Step of a number for its derivative, as a share of its size.
constexpr double relative_step = 1e-6;
/// Share of a motor's effort at which a backlash has changed sides.
constexpr double side_share = 0.02;

bool isNonlinear(const MachineNumber& number) {
  return number.group == "length" || number.group == "point" || number.group == "axis" || number.group == "gravity" ||
         number.quantity == Quantity::smoothing_speed || number.quantity == Quantity::sliding_speed;
}

}  // namespace

/// Computes efforts at the settled instants for a machine with other numbers, with the measured motion of the motors.
Eigen::MatrixXd ModelledLog::effortsOf(const Manipulator& machine) const {
  const MotorChain chain(machine);
  Eigen::MatrixXd out(static_cast<Eigen::Index>(filtered_.settled().size()), motor_count);
  for (Eigen::Index row = 0; row < out.rows(); ++row) {
    const Eigen::Index i = filtered_.settled()[static_cast<std::size_t>(row)];
    const auto at = static_cast<std::size_t>(i);
    std::optional<Motion<double>> motion = motions_[at];
    if (!has_poses_) motion = chain.follow(filtered_.state(i), motions_[at]);
    out.row(row) = efforts_.row(i);
    if (motion) out.row(row) = chain.efforts(*motion, loads_[at]).transpose();
  }
  return out;
}

void ModelledLog::addNumbers(Comparison& out) const {
  const ManipulatorParameters& nominal = scenario_.manipulator->parameters();
  const Eigen::MatrixXd unchanged = effortsOf(*scenario_.manipulator);
  for (const MachineNumber& number : machineNumbers(nominal)) {
    if (!isNonlinear(number)) continue;
    const double size = std::max(number.size(nominal), 1e-3), value = number.get(nominal), step = relative_step * size;
    if (number.group == "friction" && nominal.legs[static_cast<std::size_t>(number.leg)].coulomb.any() == false)
      continue;
    ManipulatorParameters changed = nominal;
    number.set(changed, value + step);
    Direction direction;
    direction.kind = DirectionKind::number;
    direction.path = number.path;
    direction.words = number.words;
    direction.unit = number.unit;
    direction.nominal = value;
    direction.plausible = 0.01 * size;
    add(out, direction, (effortsOf(Manipulator(changed)) - unchanged) / step);
  }
}

/// Computes the change of efforts by errors of a driven coordinate, its rate and acceleration (the columns of `error`)
/// at the settled instants.
Eigen::MatrixXd ModelledLog::changedBy(int motor, const Eigen::MatrixXd& error) const {
  const double step = relative_step / std::max(error.col(0).cwiseAbs().maxCoeff(), 1e-12);
  Eigen::MatrixXd out(error.rows(), motor_count);
  for (Eigen::Index row = 0; row < error.rows(); ++row) {
    const Eigen::Index i = filtered_.settled()[static_cast<std::size_t>(row)];
    const auto at = static_cast<std::size_t>(i);
    MeasuredState state = filtered_.state(i);
    state.value(motor) += step * error(row, 0);
    state.rate(motor) += step * error(row, 1);
    state.acceleration(motor) += step * error(row, 2);
    const auto motion = chain_.follow(state, motions_[at]);
    out.row(row) = motion
                       ? Eigen::RowVectorXd((chain_.efforts(*motion, loads_[at]).transpose() - efforts_.row(i)) / step)
                       : Eigen::RowVectorXd(Eigen::RowVectorXd::Zero(motor_count));
  }
  return out;
}

/// Adds the effects of a motor's own effort and of a wrong coordinate.
void ModelledLog::addSeries(Comparison& out) const {
  const Motors& motors = scenario_.manipulator->motors();
  const auto rows = out.model.rows();
  const auto withRates = [&](const Eigen::VectorXd& series) {
    Eigen::MatrixXd error(rows, 3);
    error << filtered_.settle(series), filtered_.settleBy(filtered_.second().rate, series),
        filtered_.settleBy(filtered_.second().acceleration, series);
    return error;
  };
  for (int k = 0; k < motor_count; ++k) {
    const Motor& motor = motors[static_cast<std::size_t>(k)];
    const std::string of = fmt::format(" of motor {}", k + 1), effort = motor.effortUnit(),
                      length = motor.slides() ? "m" : "rad";
    const Eigen::VectorXd S = efforts_.col(k);
    Eigen::MatrixXd column = Eigen::MatrixXd::Zero(rows, motor_count);
    column.col(k) = out.model.col(k);
    add(out, {DirectionKind::scale, "", "scale of the effort" + of, "", k, 1, 0.1}, column);
    const double speed = scenario_.manipulator->leg(motor.leg).coulomb.speedOf(motor.coordinate);
    const Eigen::VectorXd rubbing = S.cwiseAbs().array() * (driven_rates_.col(k) / speed).array().tanh();
    column.col(k) = filtered_.settle(rubbing);
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

std::array<Matrix6d, 3> ModelledLog::sensitivity() const {
  std::array<Matrix6d, 3> out{Matrix6d::Zero(), Matrix6d::Zero(), Matrix6d::Zero()};
  if (has_poses_) return out;
  const auto settled = static_cast<Eigen::Index>(filtered_.settled().size());
  const Eigen::Index every = std::max<Eigen::Index>(1, settled / 20);
  int count = 0;
  for (Eigen::Index row = 0; row < settled; row += every, ++count) {
    const Eigen::Index i = filtered_.settled()[static_cast<std::size_t>(row)];
    const auto at = static_cast<std::size_t>(i);
    for (int what = 0; what < 3; ++what)
      for (int k = 0; k < motor_count; ++k) {
        MeasuredState state = filtered_.state(i);
        (what == 0 ? state.value : what == 1 ? state.rate : state.acceleration)(k) += relative_step;
        const auto motion = chain_.follow(state, motions_[at]);
        if (!motion) continue;
        const Vector6d slope = (chain_.efforts(*motion, loads_[at]) - efforts_.row(i).transpose()) / relative_step;
        out[static_cast<std::size_t>(what)].col(k) += slope.cwiseAbs2();
      }
  }
  for (Matrix6d& each : out) each = (each / std::max(count, 1)).cwiseSqrt();
  return out;
}

}  // namespace ursula::identification
