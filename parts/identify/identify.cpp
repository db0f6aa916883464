#include "parts/identify/identify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/provenance.h"
#include "model/torque_names.h"
#include "parts/identify/results.h"

namespace ursula {
namespace {

using namespace identification;

constexpr double most_delay = 0.25, delay_share = 0.1, settled_delay = 0.002;
constexpr Eigen::Index fewest_instants = 24;
/// The motion's likely noise is taken out of the columns this many times, because one pass leaves some of it. Otherwise
/// columns and residual share it, and chance looks like a cause.
constexpr int noise_passes = 2;
/// The fitted model's residual may be this many times what noise explains.
constexpr double most_left = 2;

/// Compares one log with one scenario, step by step.
class Identification {
 public:
  Identification(const Scenario& scenario, MeasuredLog& log, const IdentifyOptions& options)
      : scenario_(scenario),
        log_(log),
        options_(options),
        tolerances_(options.tolerances.empty() ? statedTolerances(scenario) : options.tolerances) {
    out_.scenario = scenario;
    out_.version = buildProvenance().version;
  }

  IdentifyResult run() {
    tell(0.05, "reading signs of the log");
    describe();
    if (isStill(log_))
      return unjudged({"still", -1, 0, "", "no coordinate moves by more than its noise: expected a motion"},
                      "The machine stands still in the log, so the model is not judged.");
    const Periods periods = averagePeriods(log_);
    out_.periods = periods.count;
    const FilterPlan plan = planFilters(log_, periods.count > 1, periods.noise);
    out_.bandwidth = plan.bandwidth;
    out_.state_cut = plan.state_cut;
    out_.effort_cut = plan.effort_cut;
    if (plan.too_slow) noteTooSlow(plan);
    const double most = std::min(most_delay, delay_share * out_.duration);
    tell(0.1, "following the motion");
    const double coarse = coarseDelay(plan, most);
    if (out_.instants < fewest_instants)
      return unjudged({"too_short", -1, out_.duration, "s",
                       fmt::format("the low passes leave {} independent instants of {:.4g} s at {:.4g} Hz, and at "
                                   "least {} are needed: expected a longer or faster log",
                                   out_.instants, out_.duration, 1 / log_.step, fewest_instants)},
                      "The log is too short to judge the model.");
    FilteredLog filtered(log_, plan, std::abs(coarse) + 1 / plan.state_cut);
    std::optional<ModelledLog> modelled;
    Comparison comparison;
    for (int pass = 0; pass <= noise_passes; ++pass) {
      tell(0.2 + 0.2 * pass, "making the regressor");
      if (pass > 0) filtered.takeOut(likelyNoiseOfMotion(filtered, comparison, whitened_.weighed));
      modelled.emplace(scenario_, log_, filtered);
      comparison = modelled->directions();
      setPlausible(scenario_.manipulator->parameters(), comparison, comparison.directions);
      settleDelay(*modelled, coarse, comparison);
    }
    shareNoise(filtered, comparison);
    noteSingular(comparison, filtered);
    tell(0.8, "judging and estimating");
    conclude(*modelled, comparison);
    return std::move(out_);
  }

 private:
  void tell(double share, const std::string& what) const {
    if (options_.progress) options_.progress(share, what);
  }

  void describe() {
    out_.file = log_.file.string();
    out_.read_as = log_.read_as;
    out_.ignored = log_.ignored;
    out_.step = log_.file_step;
    out_.rows = log_.file_rows;
    out_.duration = log_.step * static_cast<double>(log_.rows());
    out_.findings = log_.findings;
    findSaturation(log_, scenario_.manipulator->motors(), out_);
    findUnitOfTime(scenario_.trajectory->duration(), out_);
  }

  void noteTooSlow(const FilterPlan& plan) {
    out_.findings.push_back(
        {"too_slow", -1, 1 / log_.step, "Hz",
         fmt::format(
             "{:.4g} rows a second show motion up to {:.3g} Hz, and it goes up to {:.3g} Hz: expected a faster log",
             1 / log_.step, plan.state_cut, plan.bandwidth),
         LogFinding::Decides::undecided});
  }

  void noteSingular(const Comparison& comparison, const FilteredLog& filtered) {
    const std::size_t all = filtered.settled().size(), left = all - comparison.kept.size();
    if (left > 0)
      out_.findings.push_back({"near_singular", -1, static_cast<double>(left), "instants",
                               fmt::format("noise of the motion changes the efforts too unsteadily at {} of {} "
                                           "instants, as near a singular pose: they are left out",
                                           left, all)});
  }

  double coarseDelay(const FilterPlan& plan, double most) {
    const FilteredLog filtered(log_, plan, 0);
    out_.instants = static_cast<Eigen::Index>(filtered.settled().size());
    if (out_.instants < fewest_instants) return 0;
    const ModelledLog modelled(scenario_, log_, filtered);
    findMistakes(modelled, scenario_.manipulator->motors(), out_);
    return modelled.coarseDelay(most);
  }

  IdentifyResult unjudged(const LogFinding& why, const char* sentence) {
    out_.findings.push_back(why);
    out_.verdict = Verdict::inconclusive;
    out_.sentence = sentence;
    return std::move(out_);
  }

  /// Shifts the efforts until no delay remains.
  void settleDelay(const ModelledLog& modelled, double coarse, Comparison& comparison) {
    out_.delay = coarse;
    const ManipulatorParameters& machine = scenario_.manipulator->parameters();
    const EffortNoise noise(modelled.filtered(), comparison);
    for (int pass = 0; pass < 6; ++pass) {
      comparison.measured = modelled.filtered().settledEfforts(out_.delay)(comparison.kept, Eigen::all);
      whitened_ = whiten(comparison, noise);
      root_ = squareRootOf(whitened_.rows);
      base_ = fitBase(root_, comparison.directions, comparison.further());
      const auto [left, deviation] =
          delayLeft(root_, comparison, suspectsOf(root_, comparison, machine, tolerances_), base_.freedom);
      out_.delay_uncertainty = deviation;
      const double reach = 0.5 / modelled.filtered().plan().state_cut, step = std::clamp(left, -reach, reach);
      if (std::abs(step) < settled_delay * std::min(deviation + 1e-9, log_.step) || pass == 5) return;
      out_.delay = std::clamp(out_.delay + step, coarse - 2 * reach, coarse + 2 * reach);
    }
  }

  /// Estimates by a draw of noise how much of it columns and residual share. Most of it was taken out of the motion,
  /// but not the part that the fit takes for numbers. That part makes the numbers too small where noise dominates a
  /// column.
  void shareNoise(FilteredLog& filtered, const Comparison& comparison) {
    const NoiseDraw draw = drawNoise(filtered, comparison);
    const Eigen::MatrixXd taken = filtered.taken();
    filtered.takeOut(taken - draw.motion);
    setShared(draw, comparison, ModelledLog(scenario_, log_, filtered).directions(), whitened_, root_);
    filtered.takeOut(taken);
    base_ = fitBase(root_, comparison.directions, comparison.further());
  }

  void conclude(const ModelledLog& modelled, const Comparison& comparison) {
    const ManipulatorParameters& machine = scenario_.manipulator->parameters();
    out_.instants = comparison.model.rows();
    const Judgement judged = judge(root_, comparison, suspectsOf(root_, comparison, machine, tolerances_),
                                   out_.delay_uncertainty, base_.freedom);
    out_.squares = judged.squares;
    out_.squares_limit = judged.squares_limit;
    out_.threshold = judged.threshold;
    if (out_.causes.empty()) out_.causes = judged.causes;  // else the log is misread, and fitted numbers mean nothing
    setMotors(modelled, comparison);
    const CrossValidation validation = crossValidate(whitened_, comparison);
    out_.validation_given = validation.given;
    out_.validation_fitted = validation.fitted;
    out_.validation_from_s = validation.from_s;
    addCombinations(base_, comparison, out_);
    const auto estimates = estimateNumbers(root_, comparison, machine, tolerances_, options_.prior);
    addNumbers(estimates, base_.quantile, out_);
    for (MeasuredNumber& each : out_.numbers)
      if (const auto at = judged.least_found.find(each.name); at != judged.least_found.end())
        each.least_found = at->second;
    out_.identified_scenario = identifiedScenario(scenario_, estimates);
    addSeries(comparison, base_, modelled.filtered(), out_);
    out_.verdict = verdictOf(judged);
    out_.sentence = identifySentence(out_);
  }

  /// Sets each motor's deviation and its uncertainty.
  void setMotors(const ModelledLog& modelled, const Comparison& comparison) {
    const Eigen::MatrixXd input = inputUncertainty(comparison, scenario_.manipulator->parameters(), tolerances_);
    const auto rms = [](const Eigen::VectorXd& x) {
      return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
    };
    const double freedom = 6.0 * static_cast<double>(comparison.model.rows());
    const double correction = std::sqrt(freedom / std::max(freedom - static_cast<double>(whitened_.rank), 1.0));
    Eigen::MatrixXd u_val(comparison.model.rows(), motor_count);
    for (int k = 0; k < motor_count; ++k) {
      MotorAgreement& motor = out_.motors[k];
      const Eigen::VectorXd E = comparison.model.col(k) - comparison.measured.col(k);
      motor.unit = scenario_.manipulator->motors()[k].effortUnit();
      motor.effort = rms(comparison.measured.col(k));
      motor.deviation = rms(E);
      Eigen::Index at = 0;
      motor.largest = E.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(&at);
      motor.largest_at_s = comparison.t(at);
      motor.left = rms(whitened_.residual.col(k)) * correction;
      motor.expected = whitened_.expected(k);
      motor.noise = modelled.filtered().plan().noise.efforts(k) * std::sqrt(static_cast<double>(out_.periods));
      motor.u_num = comparison.numerical(k);
      const Eigen::VectorXd from_delay = comparison.model_rate.col(k) * out_.delay_uncertainty;
      motor.u_input = rms(input.col(k));
      const Eigen::VectorXd noise = whitened_.variances.col(k);
      motor.u_D = std::sqrt(noise.mean() - motor.u_num * motor.u_num + from_delay.cwiseAbs2().mean());
      u_val.col(k) = (input.col(k).cwiseAbs2() + from_delay.cwiseAbs2() + noise).cwiseSqrt();
      motor.u_val = rms(u_val.col(k));
      motor.within =
          static_cast<double>((E.array().abs() <= 1.96 * u_val.col(k).array()).count()) / static_cast<double>(E.size());
    }
    addEfforts(comparison, u_val, out_);
    noteLeft();
  }

  void noteLeft() {
    for (int k = 0; k < motor_count; ++k) {
      const MotorAgreement& motor = out_.motors[k];
      const double ratio = motor.expected > 0 ? motor.left / motor.expected : 0;
      if (ratio > most_left && motor.left > 1e-6 * motor.effort)
        out_.findings.push_back({"unmodelled", k, motor.left, motor.unit,
                                 fmt::format("no numbers of the model make the efforts of motor {} agree to better "
                                             "than {:.3g} {}, {:.3g} times what the noise of its samples explains",
                                             k + 1, motor.left, motor.unit, ratio),
                                 LogFinding::Decides::fail});
      if (motor.left > 0.5 * motor.effort && motor.effort > 0)
        out_.findings.push_back({"wrong_scenario", k, motor.left / motor.effort, "",
                                 fmt::format("whatever its numbers, the model leaves {:.0f} % of the efforts of motor "
                                             "{}: a log of another machine or motor?",
                                             100 * motor.left / motor.effort, k + 1),
                                 LogFinding::Decides::fail});
    }
  }

  Verdict verdictOf(const Judgement& judged) const {
    const auto any = [this](LogFinding::Decides decides) {
      return std::any_of(out_.findings.begin(), out_.findings.end(),
                         [decides](const LogFinding& each) { return each.decides == decides; });
    };
    if (any(LogFinding::Decides::fail) || judged.deviates || !out_.causes.empty()) return Verdict::fail;
    return any(LogFinding::Decides::undecided) || base_.freedom < 30 ? Verdict::inconclusive : Verdict::pass;
  }

  const Scenario& scenario_;
  MeasuredLog& log_;
  const IdentifyOptions& options_;
  NumberTolerances tolerances_;
  Whitened whitened_;
  SquareRoot root_;
  BaseFit base_;
  IdentifyResult out_;
};

}  // namespace

IdentifyResult identify(const Scenario& scenario, MeasuredLog log, const IdentifyOptions& options) {
  return Identification(scenario, log, options).run();
}

}  // namespace ursula
