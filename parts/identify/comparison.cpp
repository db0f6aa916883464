#include "parts/identify/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/csv.h"
#include "base/scalar.h"
#include "base/text.h"
#include "validation/subject/subject.h"

namespace ursula::identification {

namespace {

/// Returns variances of the efforts by noise of the motion. `passed` is the covariance of value, rate and acceleration
/// for noise of deviation 1, `motion` the variance of each channel.
Vector6d motionVariance(const Eigen::MatrixXd& slope, const Eigen::Matrix3d& passed, const Eigen::VectorXd& motion) {
  Vector6d out = Vector6d::Zero();
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      out += passed(a, b) *
             slope.middleCols(a * motion.size(), motion.size())
                 .cwiseProduct(slope.middleCols(b * motion.size(), motion.size())) *
             motion;
  return out;
}

}  // namespace

const char* name(DirectionKind kind) {
  static constexpr const char* names[] = {
      "parameter",    "parameter",      "parameter",     "delay",    "effort_offset",
      "effort_scale", "encoder_offset", "elastic_joint", "backlash", "load_dependent_friction"};
  return names[static_cast<int>(kind)];
}

ManipulatorParameters withRotors(ManipulatorParameters machine) {
  for (Leg& leg : machine.legs)
    for (const Coordinate coordinate : rowOf(leg.kind).coordinates)
      if (double& inertia = leg.rotor_inertia.on(coordinate); leg.drives(coordinate) && inertia == 0)
        inertia = std::numeric_limits<double>::min();
  return machine;
}

ModelledLog::ModelledLog(const Scenario& scenario, const MeasuredLog& log, const FilteredLog& filtered)
    : scenario_(scenario), filtered_(filtered), has_poses_(log.has_poses), chain_(*scenario.manipulator) {
  placeMotions(log);
  efforts_.resize(filtered.size(), motor_count);
  driven_rates_.resize(filtered.size(), motor_count);
  for (Eigen::Index i = 0; i < filtered.size(); ++i) {
    Motion<double>& motion = motions_[i];
    motion.t = filtered.time(i);
    loads_.push_back(log.load.cols() > 0 ? filtered.load(i) : loadAtP(scenario.load.get(), motion));
    efforts_.row(i) = chain_.efforts(motion, loads_[i]).transpose();
    driven_rates_.row(i) =
        has_poses_ ? chain_.driven(motion).second.transpose() : filtered.state(i).rate.transpose().eval();
  }
}

void ModelledLog::placeMotions(const MeasuredLog& log) {
  std::optional<Motion<double>> at;
  for (Eigen::Index i = 0; i < filtered_.size(); ++i) {
    const MeasuredState state = filtered_.state(i);
    if (has_poses_) {
      motions_.push_back(motionOfPoses(state));
      try {
        static_cast<void>(chain_.driven(motions_.back()));
      } catch (const PoseError&) {
        refuse(log, i);
      }
      continue;
    }
    at = at ? chain_.follow(state, *at) : firstMotion(scenario_, chain_, state);
    if (!at) refuse(log, i);
    motions_.push_back(*at);
  }
}

/// Suggests a cure that lets the machine follow: degrees, millimetres, two exchanged legs.
void ModelledLog::refuse(const MeasuredLog& log, Eigen::Index at) const {
  const MeasuredState state = filtered_.state(at);
  std::string likely;
  const auto tryState = [&](MeasuredState changed, const std::string& words) {
    changed.rate.setZero();
    changed.acceleration.setZero();
    if (likely.empty() && !has_poses_ && firstMotion(scenario_, chain_, changed)) likely = words;
  };
  const Motors& motors = scenario_.manipulator->motors();
  MeasuredState scaled = state;
  for (int k = 0; k < motor_count && !has_poses_; ++k) scaled.value(k) *= motors[k].slides() ? 1e-3 : degree;
  tryState(scaled, "; they can be reached as degrees and millimetres: --map phi_1_deg=COLUMN says so");
  for (int k = 0; k < motor_count && at == 0 && !has_poses_; ++k)
    for (int j = k + 1; j < motor_count; ++j) {
      MeasuredState swapped = state;
      std::swap(swapped.value(k), swapped.value(j));
      tryState(swapped, fmt::format("; with motors {} and {} exchanged they can be reached", k + 1, j + 1));
    }
  std::string values;
  for (Eigen::Index k = 0; k < state.value.size(); ++k)
    values += fmt::format("{}{:.6g}", k == 0 ? "" : ", ", state.value(k));
  throw CsvError(fmt::format(
      "{}: error: t = {:.6g} s: the scenario's machine cannot take the {} [{}], expected those of this machine, in rad "
      "and m, in the motors' order{}",
      shownPath(log.file.string()), filtered_.time(at), has_poses_ ? "pose" : "coordinates", values, likely));
}

double ModelledLog::coarseDelay(double most) const {
  constexpr double as_good = 10;  // twice a logarithm of likelihood
  const Eigen::MatrixXd measured = filtered_.efforts(0);
  const Eigen::Index reach = std::min<Eigen::Index>(static_cast<Eigen::Index>(most / filtered_.step()),
                                                    filtered_.size() / 4),
                     margin = reach + filtered_.second().half;
  std::vector<Eigen::Index> rows;
  for (const Eigen::Index i : filtered_.settled())
    if (i >= margin && i + margin < filtered_.size()) rows.push_back(i);
  const auto passed = [&](const Eigen::MatrixXd& series, Eigen::Index lag) {
    std::vector<Eigen::Index> later = rows;
    for (Eigen::Index& each : later) each += lag;
    const Eigen::MatrixXd out = Kernel::apply(filtered_.second().value, series, later);
    return (out.rowwise() - out.colwise().mean()).eval();
  };
  const Eigen::MatrixXd S = passed(efforts_, 0);
  const auto leftAt = [&](Eigen::Index lag) {
    const Eigen::MatrixXd D = passed(measured, lag);
    double left = 1e-12;
    for (int k = 0; k < motor_count; ++k)
      if (const double sizes = S.col(k).squaredNorm() * D.col(k).squaredNorm(); sizes > 0)
        left += 1 - std::pow(std::max(0.0, S.col(k).dot(D.col(k))), 2) / sizes;
    return left;
  };
  if (rows.size() < 3) return 0;
  const double at_once = leftAt(0);
  double best = at_once, found = 0;
  for (Eigen::Index lag = -reach; lag <= reach; ++lag)
    if (const double left = leftAt(lag); left < best) {
      best = left;
      found = static_cast<double>(lag) * filtered_.step();
    }
  return static_cast<double>(motor_count * rows.size()) * std::log(at_once / best) > as_good ? found : 0;
}

Comparison ModelledLog::directions() const {
  Comparison out;
  out.segments = filtered_.settledSegments();
  out.model = filtered_.lowPass(efforts_);
  out.model_rate = filtered_.lowPassBy(filtered_.second().rate, efforts_);
  out.t.resize(out.model.rows());
  for (Eigen::Index i = 0; i < out.t.size(); ++i) out.t(i) = filtered_.time(filtered_.settled()[i]);
  out.slopes = slopes();
  const Eigen::MatrixXd taken = filtered_.lowPass(filtered_.taken());
  for (Eigen::Index i = 0; i < out.t.size(); ++i) out.model.row(i) += taken.row(i) * out.slopes[i].transpose();
  out.kept = steadyRows(out.slopes);
  addLinear(out);
  addOfLog(out);
  addNumerical(out);
  addSeries(out);
  addNumbers(out);
  keepSteady(out);
  return out;
}

/// Adds the change of E = S − D at a higher cut-off. The signal falls off beyond the cut-off, so the next octave shows
/// about what is lost. It also shows noise, which is known and subtracted.
void ModelledLog::addNumerical(Comparison& out) const {
  constexpr double chance = 1.5;  // noise may be more by chance
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(filtered_.size(), motor_count);
  for (Eigen::Index i = 0; i < change.rows(); ++i) {
    if (const auto motion = motionNear(i, filtered_.sharperState(i)))
      change.row(i) = chain_.efforts(*motion, loads_[i]).transpose() - efforts_.row(i);
  }
  change = filtered_.lowPass(change - filtered_.sharperEfforts());
  const auto kept = static_cast<double>(out.kept.size());
  const Eigen::Matrix3d passed = filtered_.sharperLines().covariance(0);
  const SampleNoise& samples = filtered_.plan().noise;
  const Eigen::VectorXd motion = samples.motion.cwiseAbs2();
  Vector6d noise = passed(0, 0) * samples.efforts.cwiseAbs2();
  for (const Eigen::Index row : out.kept) noise += motionVariance(out.slopes[row], passed, motion) / kept;
  const Vector6d seen = change(out.kept, Eigen::all).eval().colwise().squaredNorm().transpose() / kept;
  out.numerical = (seen - chance * noise).cwiseMax(0).cwiseSqrt();
  for (int k = 0; k < motor_count; ++k) {
    Eigen::MatrixXd column = Eigen::MatrixXd::Zero(change.rows(), motor_count);
    column.col(k) = change.col(k) * (out.numerical(k) / std::max(std::sqrt(seen(k)), 1e-300));
    add(out, {DirectionKind::numerical, "", fmt::format("error of the low passes on motor {}", k + 1), "", k}, column);
  }
}

/// Returns the rows at which the slopes stay about the same within the low pass, or hardly matter. Near a singular pose
/// they change, and the covariance of the noise is unknown.
std::vector<Eigen::Index> ModelledLog::steadyRows(const std::vector<Eigen::MatrixXd>& slopes) const {
  constexpr double most_change = 0.3;
  const Eigen::Matrix3d passed = filtered_.motionLines().covariance(0);
  const Vector6d samples = filtered_.plan().noise.efforts.cwiseAbs2() * filtered_.effortLines().covariance(0)(0, 0);
  const Eigen::VectorXd motion = filtered_.plan().noise.motion.cwiseAbs2();
  std::vector<Eigen::Index> all, steady;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    all.push_back(i);
    const Vector6d here = motionVariance(slopes[i], passed, motion);
    bool changes = false;
    for (const std::size_t j : {i == 0 ? i : i - 1, std::min(i + 1, slopes.size() - 1)})
      changes = changes || (motionVariance(slopes[i] - slopes[j], passed, motion).array() >
                            most_change * most_change * here.array().max(samples.array()))
                               .any();
    if (!changes) steady.push_back(all.back());
  }
  return 2 * steady.size() < slopes.size() ? all : steady;
}

void ModelledLog::keepSteady(Comparison& out) const {
  const auto all = static_cast<Eigen::Index>(out.slopes.size());
  if (static_cast<Eigen::Index>(out.kept.size()) == all) return;
  for (Eigen::MatrixXd* table : {&out.model, &out.model_rate}) *table = (*table)(out.kept, Eigen::all).eval();
  for (Eigen::MatrixXd& table : out.columns) table = table(out.kept, Eigen::all).eval();
  out.t = out.t(out.kept).eval();
  std::vector<Eigen::MatrixXd> slopes;
  std::vector<Segment> segments;
  std::vector<bool> starts(all, false);
  for (const Segment& segment : out.segments) starts[segment.first] = true;
  for (std::size_t i = 0; i < out.kept.size(); ++i) {
    const std::size_t row = out.kept[i];
    slopes.push_back(out.slopes[row]);
    if (i == 0 || out.kept[i - 1] + 1 != out.kept[i] || starts[row])
      segments.push_back({static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)});
    segments.back().end = i + 1;
  }
  out.slopes = std::move(slopes);
  out.segments = std::move(segments);
}

void ModelledLog::add(Comparison& out, const Direction& direction, const Eigen::MatrixXd& columns) const {
  out.directions.push_back(direction);
  for (int k = 0; k < motor_count; ++k) {
    Eigen::MatrixXd& table = out.columns[k];
    table.conservativeResize(columns.rows(), table.cols() + 1);
    table.rightCols<1>() = columns.col(k);
  }
}

void ModelledLog::addLinear(Comparison& out) const {
  const EffortDerivatives derivatives((Manipulator(withRotors(scenario_.manipulator->parameters()))));
  out.linear = static_cast<Eigen::Index>(derivatives.regressorNames().size());
  const Eigen::VectorXd values = derivatives.regressorValues();
  for (Eigen::Index j = 0; j < out.linear; ++j) {
    const std::string& path = derivatives.regressorNames()[j];
    out.directions.push_back({DirectionKind::linear, path, path, "", -1, values(j)});
  }
  Eigen::MatrixXd series(filtered_.size(), motor_count * out.linear);
  for (Eigen::Index i = 0; i < series.rows(); ++i) {
    const EffortDerivatives::Columns Y = derivatives.regressor(motions_[i]);
    for (int k = 0; k < motor_count; ++k) series.row(i).segment(k * out.linear, out.linear) = Y.row(k);
  }
  const Eigen::MatrixXd settled = filtered_.lowPass(series);
  for (int k = 0; k < motor_count; ++k) out.columns[k] = settled.middleCols(k * out.linear, out.linear);
}

void ModelledLog::addOfLog(Comparison& out) const {
  const Motors& motors = scenario_.manipulator->motors();
  for (int k = 0; k < motor_count; ++k) {
    const Motor& motor = motors[k];
    Eigen::MatrixXd column = Eigen::MatrixXd::Zero(out.model.rows(), motor_count);
    column.col(k).setOnes();
    add(out, {DirectionKind::offset, "", fmt::format("offset of the effort of motor {}", k + 1), motor.effortUnit(), k},
        column);
  }
  add(out, {DirectionKind::delay, "", "delay of the efforts", "s"}, -out.model_rate);
}

}  // namespace ursula::identification
