#include "validation/evidence/external_evidence.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "model/instants.h"
#include "validation/evidence/reference.h"
#include "validation/replay/windows.h"
#include "validation/subject/subject.h"
#include "validation/subject/torque_spline.h"

namespace ursula {

double ExternalTorques::largestPrecision() const {
  double largest = 0;
  for (const PointwiseSample& sample : samples) largest = std::max(largest, sample.torques_given.maxCoeff());
  return largest;
}

std::string ExternalTorques::precisionInWords(const Units& units) const {
  const double largest = largestPrecision();
  if (!file.derived_from.empty())
    return fmt::format("; and {}, up to {:.3g} {}", file.derived_from, largest * units.effort(), units.efforts.unit);
  return largest == 0 ? "; the file's digits are as fine as doubles and add nothing"
                      : fmt::format(
                            "; and half a unit of the last digit printed (torques of up to {} significant digits, "
                            "instants), up to {:.3g} {}",
                            file.digits, largest * units.effort(), units.efforts.unit);
}

namespace {

/// The change of the torques if the instant is off by its last digit.
Vector6d changeWithin(const std::function<Vector6d(double)>& noc, double t, double precision, double duration) {
  if (precision == 0) return Vector6d::Zero();
  const Vector6d here = noc(t);
  const Vector6d before = (noc(std::max(0.0, t - precision)) - here).cwiseAbs();
  const Vector6d after = (noc(std::min(duration, t + precision)) - here).cwiseAbs();
  return before.cwiseMax(after);
}

}  // namespace

ExternalTorques runExternal(const Scenario& scenario, const TorqueFile& file, const Deadline& deadline) {
  const double duration = scenario.trajectory->duration();
  ExternalTorques out;
  out.file = within(file, duration);
  const Subject noc_subject = nocSubject(*scenario.manipulator, scenario.load);
  const auto noc = [&](double t) { return noc_subject.torques(scenario.trajectory->at(t)); };
  Subject subject;
  subject.name = file.file.filename().string();
  subject.torques = [&](const Motion<double>& motion) {  // called only at the file's own instants
    const auto row = std::lower_bound(out.file.t.begin(), out.file.t.end(), motion.t) - out.file.t.begin();
    return out.file.torques.at(row);
  };
  const RoundingProfile profile(scenario, profileInstants(static_cast<int>(out.file.rows())), deadline);
  out.sizes = profile.sizes();
  out.samples =
      runPointwise(scenario, subject, out.file.t, profile, simbodyAnswers(scenario, out.file.t, deadline), deadline);
  for (std::size_t k = 0; k < out.file.rows(); ++k) {
    deadline.require();
    const double t = out.file.t[k];
    PointwiseSample& sample = out.samples[k];
    out.noc.push_back(noc(t));
    sample.torques_given = out.file.torque_precision[k] + changeWithin(noc, t, out.file.time_precision[k], duration);
    compareTorques(sample);
    sample.acceleration.given = sample.conditioning.response * sample.torques_given.norm();
    sample.acceleration.limit += sample.acceleration.given;
  }
  return out;
}

namespace {

/// Errors of the spline through the file's torques, and their effect on the platform.
class SplineLimit {
 public:
  /// `grid` holds equally spaced instants of the motion.
  SplineLimit(const Scenario& scenario, const ExternalTorques& torques, std::vector<double> grid,
              const Deadline& deadline)
      : t_(torques.file.t), grid_(std::move(grid)) {
    const RoundingProfile profile(scenario, profileInstants(static_cast<int>(grid_.size())), deadline);
    conditions_ = conditionsAt(scenario, grid_, profile, deadline);
    noc_ = [noc = nocSubject(*scenario.manipulator, scenario.load), motion = scenario.trajectory, deadline](double t) {
      deadline.require();
      return noc.torques(motion->at(t));
    };
    for (const PointwiseSample& sample : torques.samples) norms_.push_back(sample.torques_given.norm());
    if (t_.size() >= TorqueSpline::least_samples) setErrors();
  }

  /// The same for equally spaced rows with the coarsest of these digits, perhaps without the errors between them.
  SplineLimit withRows(std::size_t rows, bool digits_alone) const {
    SplineLimit out = *this;
    out.t_ = equallySpaced(grid_.back(), static_cast<int>(rows));
    out.norms_.assign(rows, norms_.empty() ? 0 : *std::max_element(norms_.begin(), norms_.end()));
    out.setErrors();
    if (digits_alone) out.interpolation_.assign(out.interpolation_.size(), 0);
    return out;
  }

  /// The error of the platform's acceleration: the largest within one grid step of t, m/s².
  double operator()(double t) const {
    const double h = grid_[1] - grid_[0];
    const auto k = std::min(static_cast<std::size_t>(std::lround(t / h)), grid_.size() - 1);
    double response = 0, rounding = 0;
    for (std::size_t j = k == 0 ? 0 : k - 1; j <= std::min(k + 1, grid_.size() - 1); ++j) {
      response = std::max(response, conditions_[j].conditioning.response);
      rounding = std::max(rounding, conditions_[j].conditioning.accelerationRounding());
    }
    return rounding + response * splineError(t - h, t + h);
  }

  const std::vector<Conditions>& conditions() const { return conditions_; }  ///< at the grid
  double length() const { return conditions_.front().conditioning.length; }
  double largestInterpolation() const { return *std::max_element(interpolation_.begin(), interpolation_.end()); }
  /// The widest interval between rows, if it is much wider than most and leaves the largest error; else nullopt.
  std::optional<std::pair<double, double>> limitingGap() const {
    const auto worst = std::max_element(interpolation_.begin(), interpolation_.end()) - interpolation_.begin();
    if (!(worst + 1 < static_cast<std::ptrdiff_t>(t_.size())) || !(largestInterpolation() > largestOfDigits()))
      return std::nullopt;
    std::vector<double> gaps;
    for (std::size_t k = 1; k < t_.size(); ++k) gaps.push_back(t_[k] - t_[k - 1]);
    const double gap = gaps[static_cast<std::size_t>(worst)];
    std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2), gaps.end());
    if (gap < *std::max_element(gaps.begin(), gaps.end()) || gap < 2 * gaps[gaps.size() / 2]) return std::nullopt;
    return std::pair(t_[static_cast<std::size_t>(worst)], t_[static_cast<std::size_t>(worst) + 1]);
  }
  double largestOfDigits() const { return *std::max_element(digits_.begin(), digits_.end()); }
  std::size_t rows() const { return t_.size(); }

 private:
  void setErrors() {
    interpolation_ = interpolationErrors(t_, noc_);
    digits_ = carriedErrors(t_, norms_);
  }

  double splineError(double from, double to) const {
    const auto last = static_cast<std::ptrdiff_t>(interpolation_.size()) - 1;
    const auto first = std::upper_bound(t_.begin(), t_.end(), from) - t_.begin() - 1;
    double largest = 0;
    for (auto j = std::clamp<std::ptrdiff_t>(first, 0, last); j <= last; ++j) {
      if (t_[j] > to && j > 0) break;
      largest = std::max(largest, interpolation_[j] + digits_[j]);
    }
    return largest;
  }

  std::vector<double> t_, grid_, norms_;  ///< the last are of the digits of each row, N·m
  std::function<Vector6d(double)> noc_;
  std::vector<Conditions> conditions_;
  std::vector<double> interpolation_, digits_;  ///< N·m, one per interval of t_
};

/// Returns why no spline covers the whole motion; empty if one does.
std::string missing(const ExternalTorques& torques, double duration, const Units& units) {
  const TorqueFile& file = torques.file;
  if (file.rows() < TorqueSpline::least_samples)
    return fmt::format("too few samples, {}; a quintic spline needs {}", file.rows(), TorqueSpline::least_samples);
  if (covers(file, duration)) return "";
  return fmt::format("the samples cover {:.6g} to {:.6g} s of a motion from 0 to {:.6g} s", file.t.front() * units.time,
                     file.t.back() * units.time, duration * units.time);
}

/// Returns the worst window if even the shortest windows' bounds exceed the useful limit; else null.
const GrowthWindow* hopeless(const ReplayPlan& plan, const std::vector<GrowthWindow>& windows, double useful) {
  const GrowthWindow* worst = nullptr;
  double largest = useful;
  for (const GrowthWindow& window : windows) {
    const double bound = plannedBound(plan, window);
    if (!(bound <= largest)) worst = &window, largest = bound;
  }
  return worst;
}

/// The plan of a replay under torques of so many rows; without the torques.
ReplayPlan planOf(const Scenario& scenario, const std::shared_ptr<const SplineLimit>& limit, const Deadline& deadline) {
  const double duration = scenario.trajectory->duration();
  ReplayPlan plan;
  plan.acceleration = [limit](double t) { return (*limit)(t); };
  plan.deadline = deadline;
  plan.position_scale = positionScale(limit->conditions());
  plan.step_rate = std::max(plannedStepRate(duration), 2 * static_cast<double>(limit->rows()) / duration);
  plan.tolerance = reachableTolerance(scenario, plan.step_rate);
  plan.max_evaluations = enoughEvaluations(scenario, plan.step_rate);
  return plan;
}

/// Returns how many equally spaced rows would do, within a tenth; 0 if the digits are too few for any. It plans the
/// replay of the NOC's torques at so many rows.
std::size_t enoughRows(const Scenario& scenario, const SplineLimit& limit, const Amplification& amplification,
                       double useful, const Deadline& deadline) {
  constexpr std::size_t most = 20000;
  const auto wouldDo = [&](std::size_t rows, bool digits_alone = false) {
    const auto there = std::make_shared<const SplineLimit>(limit.withRows(rows, digits_alone));
    const ReplayPlan plan = planOf(scenario, there, deadline);
    // Half of it, since the replay's limit has its own steps' errors, too.
    return hopeless(plan, planWindows(amplification, plan), useful / 2) == nullptr;
  };
  std::size_t enough = 2 * TorqueSpline::least_samples, too_few = TorqueSpline::least_samples - 1;
  if (!wouldDo(enough, true)) return 0;
  while (!wouldDo(enough)) {
    too_few = enough;
    enough *= 2;
    if (enough > most) return 0;
  }
  while (10 * too_few < 9 * enough && enough - too_few > 1) {
    const std::size_t middle = (too_few + enough) / 2;
    (wouldDo(middle) ? enough : too_few) = middle;
  }
  return enough;
}

/// "; 61 equally spaced rows of such digits would do", or what else would.
std::string remedyOf(std::size_t enough) {
  if (enough > 0) return fmt::format("; {} equally spaced rows with as many digits would do", enough);
  return "; more rows would not do: give more digits, or a tolerance of the torques";
}

std::string splineBasis(const SplineLimit& limit, std::size_t rows, const Units& units) {
  return fmt::format(
      "between the {} samples: interpolation up to {:.3g} {} (the NOC's torques on a quintic spline through the same "
      "instants), printed digits up to {:.3g} {}, both x || T_P inv(I) ||",
      rows, limit.largestInterpolation() * units.effort(), units.efforts.unit, limit.largestOfDigits() * units.effort(),
      units.efforts.unit);
}

}  // namespace

ExternalReplay replayExternal(const Scenario& scenario, const ExternalTorques& torques, const Units& units,
                              const Deadline& deadline) {
  const double duration = scenario.trajectory->duration();
  ExternalReplay out;
  out.amplification = std::make_shared<const Amplification>(linearised(scenario, deadline));
  out.not_replayed = missing(torques, duration, units);
  const Amplification& amplification = *out.amplification;
  const auto limit = std::make_shared<const SplineLimit>(scenario, torques, amplification.instants(), deadline);
  const double useful = useful_replay_limit * limit->length();
  if (!out.not_replayed.empty()) {
    out.between = std::numeric_limits<double>::infinity();
    out.enough_rows = enoughRows(scenario, *limit, amplification, useful, deadline);
    out.not_replayed += remedyOf(out.enough_rows);
    return out;
  }
  const auto spline = std::make_shared<const TorqueSpline>(torques.file.t, torques.file.torques);
  ReplayPlan plan = planOf(scenario, limit, deadline);
  plan.torques = [spline](double t) { return (*spline)(t); };
  const std::vector<GrowthWindow> windows = planWindows(amplification, plan);
  const std::string basis = splineBasis(*limit, torques.file.rows(), units);
  if (const GrowthWindow* window = hopeless(plan, windows, useful)) {
    const double bound = plannedBound(plan, *window);
    const auto gap = limit->limitingGap();
    const std::string lack = gap ? fmt::format("no sample between t = {:.6g} and {:.6g} s, the widest gap,",
                                               gap->first * units.time, gap->second * units.time)
                                 : "too few samples or digits";
    out.enough_rows = enoughRows(scenario, *limit, amplification, useful, deadline);
    out.not_replayed = fmt::format(
        "{} for a replay{}. From t = {:.6g} s what the file leaves open may move P by {:.3g} m within {:.3g} s, and a "
        "verdict needs {:.3g} m",
        lack, remedyOf(out.enough_rows), window->start() * units.time, bound * units.length,
        (window->end() - window->start()) * units.time, useful * units.length);
    out.bound = bound;
    out.between = limit->largestInterpolation();
    out.spline = basis;
    return out;
  }
  out.plan = plan;
  out.windows = replayInWindows(scenario, plan, windows);
  measureOpening(limit->conditions(), out.windows);
  out.scales = {plan.position_scale, limit->length(), loopForces(limit->conditions())};
  out.spline = basis;
  return out;
}

}  // namespace ursula
