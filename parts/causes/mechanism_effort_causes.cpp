#include <algorithm>
#include <cmath>

#include "parts/causes/fits.h"
#include "parts/causes/mechanism_tried.h"

namespace ursula::mechanisms {
namespace {

/// The efforts of one motor, of all instants.
VectorXd ofMotor(const EffortResidual& data, const VectorXd& all, std::size_t k) {
  const Eigen::Map<const MatrixXd> rows(all.data(), data.motors, all.size() / data.motors);
  return rows.row(static_cast<Eigen::Index>(k)).transpose();
}

void setMotor(const EffortResidual& data, std::size_t k, const VectorXd& values, VectorXd& all) {
  Eigen::Map<MatrixXd> rows(all.data(), data.motors, all.size() / data.motors);
  rows.row(static_cast<Eigen::Index>(k)) = values.transpose();
}

void nameThem(const EffortResidual& data, const std::vector<int>& motors, NamedCause& cause) {
  if (static_cast<Eigen::Index>(motors.size()) == data.motors)
    cause.body = "all";
  else if (motors.size() == 1)
    cause.motor = motors.front() + 1;
  else
    for (const int motor : motors) cause.legs.push_back(motor + 1);
}

void addOrder(const EffortResidual& data, std::vector<Tried>& out) {
  const auto rowsOf = [&](const VectorXd& all) -> MatrixXd {
    return Eigen::Map<const MatrixXd>(all.data(), data.motors, all.size() / data.motors);
  };
  const MotorPairs pairs(rowsOf(data.found), rowsOf(data.noc));
  double least = 0;
  const std::vector<std::size_t> order = pairs.best(least);
  VectorXd efforts = data.noc;
  std::vector<int> flipped;
  bool is_order = false;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double sign = pairs.signAt(i, order[i]);
    setMotor(data, i, sign * ofMotor(data, data.noc, order[i]), efforts);
    is_order = is_order || order[i] != i;
    if (sign < 0) flipped.push_back(static_cast<int>(i));
  }
  if (!is_order && flipped.empty()) return;
  NamedCause named{is_order ? CauseKind::order : CauseKind::sign};
  if (is_order)
    for (const std::size_t motor : order) named.legs.push_back(static_cast<int>(motor) + 1);
  else
    nameThem(data, flipped, named);
  if (is_order && !flipped.empty()) {
    named.signs.assign(order.size(), 1);
    for (const int motor : flipped) named.signs[static_cast<std::size_t>(motor)] = -1;
  }
  addFixed(out, named, VectorXd(efforts - data.noc));
}

bool nameUnits(const EffortResidual& data, double factor, NamedCause& named) {
  MotorNames all;
  const std::size_t slides = [&] {
    std::size_t count = 0;
    for (std::size_t k = 0; k < data.mechanism->motorCount(); ++k) count += data.mechanism->motor(k).slides() ? 1 : 0;
    return count;
  }();
  all.slides.fill(slides == data.mechanism->motorCount());
  if (unitOf(factor, all).empty()) return false;
  named.kind = CauseKind::units;
  return true;
}

Tried factorOf(const EffortResidual& data, NamedCause named, const VectorXd& part) {
  named.expected = 1;
  Tried out{named, [part](const EffortResidual&, const VectorXd& x) { return VectorXd(x(0) * part); },
            VectorXd::Ones(1)};
  out.finish = [&data](const VectorXd& x, const VectorXd& uncertainty, NamedCause& cause) {
    cause.found = 1 + x(0);
    cause.uncertainty = uncertainty(0);
    if (std::abs(*cause.found) < 1e-9) return false;  // no efforts at all
    static_cast<void>(nameUnits(data, *cause.found, cause));
    return true;
  };
  return out;
}

/// One number for each motor that is off.
void addEachMotor(const EffortResidual& data, const std::vector<int>& off, std::vector<Tried>& out) {
  for (const bool is_offset : {true, false}) {
    if (!is_offset && static_cast<Eigen::Index>(off.size()) == data.motors && data.motors == 1) continue;
    MatrixXd columns = MatrixXd::Zero(data.noc.size(), static_cast<Eigen::Index>(off.size()));
    for (std::size_t i = 0; i < off.size(); ++i) {
      const std::size_t k = off[i];
      VectorXd column = VectorXd::Zero(data.noc.size());
      const VectorXd own = ofMotor(data, data.noc, k);
      setMotor(data, k, is_offset ? VectorXd(VectorXd::Ones(own.size())) : own, column);
      columns.col(static_cast<Eigen::Index>(i)) = column;
    }
    Tried tried{{is_offset ? CauseKind::offset : CauseKind::scale},
                [columns](const EffortResidual&, const VectorXd& x) { return VectorXd(columns * x); },
                VectorXd::Ones(columns.cols())};
    nameThem(data, off, tried.named);
    const double expected = is_offset ? 0 : 1;
    const bool slides = data.mechanism->motor(off.front()).slides();
    const bool is_one_unit = std::all_of(off.begin(), off.end(), [&](int k) {
      return data.mechanism->motor(static_cast<std::size_t>(k)).slides() == slides;
    });
    const std::string unit = !is_offset ? "" : slides ? "N" : "N m";
    tried.finish = [&data, expected, unit, is_offset, is_one_unit](const VectorXd& x, const VectorXd& uncertainty,
                                                                   NamedCause& named) {
      const double spread = std::max(uncertainty.maxCoeff(), 1e-12 * x.cwiseAbs().maxCoeff());
      if (!is_one_unit || x.maxCoeff() - x.minCoeff() > spread) return true;  // they have no one value
      named.expected = expected;
      named.found = expected + x.mean();
      named.uncertainty = uncertainty.maxCoeff();
      named.unit = unit;
      if (!is_offset && x.size() > 1) static_cast<void>(nameUnits(data, *named.found, named));
      return true;
    };
    out.push_back(tried);
  }
}

}  // namespace

void addEffortCauses(const EffortResidual& data, std::vector<Tried>& out) {
  addOrder(data, out);
  addFixed(out, {CauseKind::missing_term, "", "all"}, VectorXd(-data.noc), "every effort is zero");
  out.push_back(factorOf(data, {CauseKind::scale, "", "all"}, data.noc));
  std::vector<int> off;
  for (Eigen::Index k = 0; k < data.motors; ++k) {
    const std::size_t motor = k;
    const VectorXd left = ofMotor(data, data.residual(), motor), limit = ofMotor(data, data.limit, motor);
    if ((left.array().abs() > limit.array()).any()) off.push_back(static_cast<int>(k));
  }
  if (!off.empty()) addEachMotor(data, off, out);
}

namespace {

/// Efforts of another time, τ(t + dt), at the instants whose shifted time is within the motion.
class Shifted {
 public:
  /// Takes one instant in `stride`. `usable` is false if too few are left, or the loops cannot follow at one of them.
  Shifted(const EffortResidual& data, double dt, std::size_t stride) {
    try {
      shift(data, dt, stride);
    } catch (const LoopError&) {
      unexplained = HUGE_VAL;
    }
  }

  double step() const { return slope.dot(left) / slope.squaredNorm(); }

  VectorXd left, slope, limit;
  double unexplained = HUGE_VAL;
  bool usable = false;

 private:
  void shift(const EffortResidual& data, double dt, std::size_t stride) {
    const double duration = data.motion->trajectory().duration(), step = 1e-5 * duration;
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < data.t.size(); i += stride)
      if (data.t[i] + dt - step >= 0 && data.t[i] + dt + step <= duration) used.push_back(i);
    if (4 * used.size() * stride < 3 * data.t.size() || used.size() < 3) return;
    const auto rows = static_cast<Eigen::Index>(used.size()) * data.motors;
    left.resize(rows), slope.resize(rows), limit.resize(rows);
    const VectorXd residual = data.residual();
    LoopWork work;
    const auto at = [&](double t) { return data.motion->inverseDynamics(t, work); };
    double before = 0;
    for (std::size_t r = 0; r < used.size(); ++r) {
      const Eigen::Index to = static_cast<Eigen::Index>(r) * data.motors;
      const Eigen::Index from = static_cast<Eigen::Index>(used[r]) * data.motors;
      const double t = data.t[used[r]] + dt;
      left.segment(to, data.motors) = data.found.segment(from, data.motors) - at(t);
      slope.segment(to, data.motors) = (at(t + step) - at(t - step)) / (2 * step);
      limit.segment(to, data.motors) = data.limit.segment(from, data.motors);
      before += residual.segment(from, data.motors).squaredNorm();
    }
    unexplained = before > 0 ? left.norm() / std::sqrt(before) : HUGE_VAL;
    usable = std::isfinite(unexplained) && slope.squaredNorm() > 0;
  }
};

/// The shift that explains most among a hundredth of the duration each.
double coarseDelay(const EffortResidual& data, std::size_t stride) {
  double best = 0, least = HUGE_VAL;
  for (int k = -20; k <= 20; ++k) {
    const double dt = 0.01 * k * data.motion->trajectory().duration();
    const Shifted shifted(data, dt, stride);
    if (shifted.unexplained < least) best = dt, least = shifted.unexplained;
  }
  return best;
}

}  // namespace

void addDelay(const EffortResidual& data, std::vector<Fitted>& out) {
  constexpr std::size_t most = 60;
  constexpr int coarse_steps = 6, steps = 8;
  const std::size_t stride = std::max<std::size_t>(1, data.t.size() / most);
  double dt = coarseDelay(data, stride);
  for (int k = 0; k < steps; ++k) {
    const Shifted shifted(data, dt, k < coarse_steps ? stride : 1);
    if (!shifted.usable) return;
    dt += shifted.step();
  }
  const Shifted shifted(data, dt, 1);
  if (!shifted.usable) return;
  Fitted fitted;
  fitted.named = {CauseKind::delay, "", "all", "", "s", 0, -dt};
  const double variance =
      std::max(shifted.left.squaredNorm(), shifted.limit.squaredNorm() / 3) / static_cast<double>(shifted.left.size());
  fitted.named.uncertainty = 2 * std::sqrt(variance / shifted.slope.squaredNorm());
  fitted.numbers = 1;
  fitted.unexplained = shifted.unexplained;
  fitted.of_found = shifted.left.norm() / std::max(data.found.norm(), 1e-300);
  fitted.is_smooth = data.isSmooth(shifted.left);
  fitted.beyond = (shifted.left.cwiseAbs().array() / shifted.limit.array()).maxCoeff();
  out.push_back(fitted);
}

}  // namespace ursula::mechanisms
