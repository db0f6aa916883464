#include "tests/studies/identify/synthetic_log.h"

#include <cmath>
#include <random>

#include "base/csv.h"
#include "model/columns.h"
#include "model/torque_names.h"
#include "parts/identify/platform_motion.h"
#include "simbody/simbody_loop.h"
#include "validation/subject/subject.h"

namespace ursula {

Motion<double> syntheticMotion(const Scenario& scenario, const SyntheticLog& how, double t) {
  const Motion<double> middle = scenario.trajectory->at(0.5 * scenario.trajectory->duration());
  double length = 0;
  for (const Leg& leg : scenario.manipulator->parameters().legs) length = std::max(length, leg.platform_point.norm());
  std::mt19937 dice(how.seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vector6d x = Vector6d::Zero(), v = x, a = x;
  for (int harmonic = 1; harmonic <= 3; ++harmonic)
    for (int i = 0; i < 6; ++i) {
      const double w = 2 * std::acos(-1.0) * harmonic / how.period,
                   size = how.size * (i < 3 ? 0.03 * length : 0.02) / harmonic;
      const double s = size * uniform(dice), c = size * uniform(dice);
      x(i) += s * std::sin(w * t) + c * std::cos(w * t);
      v(i) += w * (s * std::cos(w * t) - c * std::sin(w * t));
      a(i) -= w * w * (s * std::sin(w * t) + c * std::cos(w * t));
    }
  return identification::motionAbout(middle, {x, v, a}, t);
}

SyntheticRows syntheticRows(const Scenario& scenario, const ManipulatorParameters& machine, const SyntheticLog& how) {
  const Manipulator manipulator(machine);
  SimbodyLoop loop(manipulator);
  const auto rows = static_cast<Eigen::Index>(how.rate * how.duration);
  SyntheticRows out;
  out.motion.resize(rows, motor_count);
  out.efforts.resize(rows, motor_count);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double t = (static_cast<double>(i) + (how.off ? how.off(static_cast<int>(i)) : 0)) / how.rate;
    out.t.push_back(t);
    if (how.delay != 0) loop.place(syntheticMotion(scenario, how, t - how.delay));
    if (how.delay != 0) out.efforts.row(i) = loop.inverseDynamics().transpose();
    out.motion.row(i) = loop.place(syntheticMotion(scenario, how, t)).q.driven(manipulator.motors()).transpose();
    if (how.delay == 0) out.efforts.row(i) = loop.inverseDynamics().transpose();
  }
  out.effort_noise =
      how.effort_noise * (out.efforts.colwise().norm().transpose() / std::sqrt(static_cast<double>(rows)));
  std::mt19937 dice(how.seed + 1000);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < rows; ++i)
    for (int k = 0; k < motor_count; ++k) {
      out.motion(i, k) += how.motion_noise * normal(dice);
      out.efforts(i, k) += out.effort_noise(k) * normal(dice);
    }
  return out;
}

SyntheticRows closedFormRows(const Scenario& scenario, int count, double effort_noise, unsigned seed) {
  const identification::MotorChain chain(*scenario.manipulator);
  std::mt19937 dice(seed);
  std::normal_distribution<double> normal;
  SyntheticRows out;
  out.motion.resize(count, motor_count);
  out.efforts.resize(count, motor_count);
  out.effort_noise = Eigen::VectorXd::Constant(motor_count, effort_noise);
  for (int i = 0; i < count; ++i) {
    out.t.push_back(scenario.trajectory->duration() * i / (count - 1));
    const Motion<double> motion = scenario.trajectory->at(out.t.back());
    out.motion.row(i) = chain.driven(motion).first.transpose();
    out.efforts.row(i) = chain.efforts(motion, loadAtP(scenario.load.get(), motion)).transpose();
    for (int k = 0; k < motor_count; ++k) out.efforts(i, k) += effort_noise * normal(dice);
  }
  return out;
}

MeasuredLog logOf(const SyntheticRows& rows, const Scenario& scenario) {
  return measuredLogOf(rows.t, rows.motion, rows.efforts, *scenario.manipulator);
}

std::string csvOf(const SyntheticRows& rows, const Scenario& scenario) {
  const Motors& motors = scenario.manipulator->motors();
  std::vector<std::string> names = {"t_s"};
  std::vector<std::vector<double>> columns = {rows.t};
  const auto add = [&](const std::string& name, const Eigen::VectorXd& values) {
    names.push_back(name);
    columns.emplace_back(values.data(), values.data() + values.size());
  };
  for (int k = 0; k < motor_count; ++k) add(drivenName(motors[static_cast<std::size_t>(k)]), rows.motion.col(k));
  for (int k = 0; k < motor_count; ++k) add(effortColumn(motors, k), rows.efforts.col(k));
  return csvText(names, columns);
}

}  // namespace ursula
