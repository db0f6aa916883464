#include "parts/causes/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "parts/causes/answers_alone.h"
#include "parts/causes/explanation.h"
#include "parts/causes/hypotheses.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// A likely explanation of one part leaves less than this share of the residual.
constexpr double may_remain = 0.01;
/// The instants at which any of some motors' torques exceeds its limit.
struct Deviating {
  std::size_t count = 0, first = 0, last = 0, worst = 0;
  double largest = 0;

  std::size_t span() const { return last + 1 - first; }
};

Deviating deviationOf(const ExternalTorques& torques, int from_motor = 0, int to_motor = motor_count) {
  Deviating out;
  for (std::size_t k = 0; k < torques.file.rows(); ++k) {
    bool is_off = false;
    for (int motor = from_motor; motor < to_motor; ++motor) {
      const double error = std::abs(offAt(torques, k, motor));
      if (error <= limitAt(torques, k, motor)) continue;
      is_off = true;
      if (exceeds(error, out.largest)) out.largest = error, out.worst = k;
    }
    if (!is_off) continue;
    if (out.count++ == 0) out.first = k;
    out.last = k;
  }
  return out;
}

std::string intervalText(const ExternalTorques& torques, const Deviating& off) {
  const std::vector<double>& t = torques.file.t;
  const std::string span = off.first == off.last
                               ? fmt::format("at t = {:.6g} s", t[off.first])
                               : fmt::format("from t = {:.6g} to {:.6g} s", t[off.first], t[off.last]);
  return fmt::format("{}, {} of {} instants", span, off.count, t.size());
}

std::string amountText(const Deviating& leg, const char* unit, double largest_torque) {
  const std::string share =
      largest_torque > 0 ? fmt::format(" ({:.3g} % of the largest torque)", 100 * leg.largest / largest_torque) : "";
  return fmt::format("by up to {:.4g} {}{}", leg.largest, unit, share);
}

/// Summary and details; empty if every leg is within its limits.
Diagnosis deviationTexts(const MotorNames& motors, const ExternalTorques& torques) {
  const double largest_torque = torques.sizes.of(Rounded::torque);
  std::string legs, details, right;
  const Deviating all = deviationOf(torques);
  double most = 0;
  int worst = 0;
  for (int i = 0; i < motor_count; ++i) {
    const Deviating leg = deviationOf(torques, i, i + 1);
    std::string& names = leg.count == 0 ? right : legs;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", i + 1);
    if (leg.count == 0) continue;
    details += fmt::format("{}{} {} at t = {:.6g} s, beyond its limit {}", details.empty() ? "" : "; ", motors(i),
                           amountText(leg, motors.unit(i), largest_torque), torques.file.t[leg.worst],
                           intervalText(torques, leg));
    if (exceeds(leg.largest, most)) most = leg.largest, worst = i;
  }
  if (legs.empty()) return {};
  const std::string kind = motors.kind();
  const std::string who = right.empty() ? "all " + kind + "s" : kind + (legs.size() == 1 ? " " : "s ") + legs;
  return {
      fmt::format("{} {}, {}", who, amountText(all, motors.unit(worst), largest_torque), intervalText(torques, all)),
      details + (right.empty() ? "; no " + kind + " is right" : "; within their limits: " + right), ""};
}

/// At most `most` instants, evenly picked, which suffice; then the answers to separate questions.
TorqueResidual residualOf(const Scenario& scenario, const ExternalTorques& torques, const AskedApart& asked) {
  constexpr std::size_t most = 1000;
  TorqueResidual out;
  out.motors = motorNames(*scenario.manipulator);
  const std::size_t rows = torques.file.rows(), count = std::min(rows, most);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = count == 1 ? 0 : i * (rows - 1) / (count - 1);
    out.add(scenario.trajectory->at(torques.file.t[k]), torques.noc[k], torques.file.torques[k],
            torques.samples[k].torqueLimits());
  }
  out.commanded = count;
  out.instants = torques.file.t;
  for (std::size_t k = 0; k < asked.motions.size(); ++k)
    out.add(asked.motions[k], asked.expected[k], asked.found[k], Vector6d::Constant(asked.rounding[k]));
  return out;
}

/// Describes at most one deviating instant in twenty, as from a falsified row; else empty.
std::string loneInstants(const ExternalTorques& torques) {
  const std::size_t rows = torques.file.rows();
  const Deviating window = deviationOf(torques);
  if (window.count == 0 || 20 * window.count > rows) return "";
  return fmt::format("{} of {} instants {} off, the first at t = {:.6g} s, and the others are right", window.count,
                     rows, window.count == 1 ? "is" : "are", torques.file.t[window.first]);
}

/// Whether a solver that was asked term by term is right outside the interval, whatever it is asked. `from` and `to`
/// are the right samples next to it, at which a motion at rest may hide a missing term.
bool answersRightOutside(const TorqueResidual& data, double from, double to) {
  for (std::size_t k = data.commanded; k < data.motions.size(); ++k) {
    if (data.motions[k].t >= from && data.motions[k].t <= to) continue;
    if (((data.residual[k].cwiseAbs() - may_be_beyond * data.limit[k]).array() > 0).any()) return false;
  }
  return true;
}

/// Describes torques that are wrong in one interval and right in at least a tenth of the motion; else empty. Adds the
/// cause if those instants reveal it.
Explanation intervalAlone(const Scenario& scenario, const ExternalTorques& torques, const TorqueResidual& data) {
  constexpr std::size_t enough = 3, enough_to_explain = 16;
  const Deviating window = deviationOf(torques);
  if (window.span() < enough || 20 * window.count < 19 * window.span() || 10 * window.span() > 9 * torques.file.rows())
    return {};
  const double from = torques.file.t[window.first], to = torques.file.t[window.last];
  const double before = torques.file.t[window.first == 0 ? 0 : window.first - 1];
  const double after = torques.file.t[std::min(window.last + 1, torques.file.rows() - 1)];
  if (!answersRightOutside(data, before, after)) return {};
  Explanation out{fmt::format("right but from t = {:.6g} to {:.6g} s", from, to), {}, {}, CauseClaim::interval};
  out.named = NamedCause{CauseKind::window};
  nameMotors(wrongMotors(torques), *out.named);
  out.named->from_s = from;
  out.named->to_s = to;
  out.named->explained = 1;
  TorqueResidual there;
  there.motors = data.motors;
  for (std::size_t k = 0; k < data.motions.size(); ++k) {
    if (data.motions[k].t < from || data.motions[k].t > to) continue;
    there.add(data, k);
    if (k < data.commanded) there.commanded = there.motions.size();
  }
  if (there.motions.size() < enough_to_explain) return out;
  const std::vector<Hypothesis> fitted = fitHypotheses(scenario, there);
  if (fitted.empty()) return out;
  const Hypothesis best = bestOf(fitted).front();
  if (explains(best)) out.text += fmt::format("; there {}, which explains {}", best.text, percent(best.explained()));
  return out;
}

/// Shares of the deviation: a cause that explains less is not mentioned, as the best or after it.
constexpr double worth_naming = 0.5, worth_ranking = 0.1;

/// Those with fewer numbers than motors, since one number for each motor explains a part of anything.
std::vector<Hypothesis> ofFewNumbers(std::vector<Hypothesis> fitted) {
  fitted.erase(std::remove_if(fitted.begin(), fitted.end(),
                              [](const Hypothesis& one) { return one.free_numbers >= motor_count; }),
               fitted.end());
  return fitted;
}

/// The three that explain most, `first` before the others, with their shares.
Explanation ranked(const std::vector<Hypothesis>& fitted, const Hypothesis& first, std::string text, CauseClaim claim) {
  constexpr std::size_t most_ranked = 3;
  std::vector<Hypothesis> all = ofFewNumbers(fitted), best = {first};
  std::stable_sort(all.begin(), all.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.unexplained < b.unexplained; });
  for (const Hypothesis& one : all) {
    const auto isSame = [&one](const Hypothesis& other) { return one.text == other.text || isSameMistake(one, other); };
    if (best.size() < most_ranked && one.explained() > worth_ranking && std::none_of(best.begin(), best.end(), isSame))
      best.push_back(one);
  }
  Explanation out{std::move(text), {}, {}, claim};
  for (const Hypothesis& one : best) {
    const bool is_said = out.text.find(one.text) != std::string::npos;  // as the first or as good as it
    if (!is_said) out.text += fmt::format(". Next: {}, {:.3g} %", one.text, 100 * one.explained());
    if (!one.named) continue;
    out.others.push_back(*one.named);
    out.others.back().explained = 1 - one.unexplained * one.unexplained;
  }
  return out;
}

/// Describes the best with few numbers. Empty if it explains too little, as of noise.
std::string bestText(const Hypothesis& first) {
  if (first.explained() < worth_naming || first.of_found > worth_naming) return "";
  if (first.unexplained >= may_remain)
    return fmt::format("{}, which explains only {}", first.text, percent(first.explained()));
  return fmt::format("{}, which explains {}. It leaves {:.3g} % of what was answered", first.text,
                     percent(first.explained()), 100 * first.of_found);
}

/// What is known without a cause.
Explanation noCause(std::string text) { return {std::move(text), {}, {}, CauseClaim::none}; }

Explanation explanationOf(const Scenario& scenario, const ExternalTorques& torques, const AskedApart& asked) {
  const TorqueResidual data = residualOf(scenario, torques, asked);
  const std::vector<Hypothesis> fitted = fitHypotheses(scenario, data);
  if (fitted.empty()) return noCause("no simple explanation");
  const std::vector<Hypothesis> best = bestOf(fitted);
  const Hypothesis& first = best.front();
  const std::string how_much = fmt::format("{}, which explains {}", first.text, percent(first.explained()));
  if (explains(first)) return named(best, data, how_much + othersText(best));
  if (const Explanation several = severalMistakes(scenario, data, first.beyond); !several.text.empty()) return several;
  if (std::max(first.unexplained, first.of_found) < may_remain)
    return ranked(
        fitted, first,
        fmt::format("a likely part: {}. What remains is up to {:.3g} times the limit of rounding and digits{}",
                    how_much, first.beyond, othersText(best)),
        CauseClaim::part);
  if (const Explanation interval = intervalAlone(scenario, torques, data); !interval.text.empty()) return interval;
  if (const std::string alone = loneInstants(torques); !alone.empty())
    return noCause("no simple explanation: " + alone);
  if (const std::vector<Hypothesis> few = ofFewNumbers(fitted); !few.empty()) {
    const Hypothesis most = bestOf(few).front();
    if (const std::string some = bestText(most); !some.empty())
      return ranked(few, most, "no simple explanation. The best: " + some, CauseClaim::none);
  }
  return noCause(isNoise(data.alongMotion()) ? "no pattern from one instant to the next, as of noise or too few digits"
                                             : "no simple explanation");
}

}  // namespace

Diagnosis diagnose(const Scenario& scenario, const ExternalTorques& torques, const AskedApart& asked) {
  const MotorNames motors = motorNames(*scenario.manipulator);
  Diagnosis out = deviationTexts(motors, torques);
  const AnswersAlone alone = readAlone(motors, torques, asked);
  if (out.summary.empty() && alone.has_few_digits) {
    ExternalTorques printed = torques;  // a solver's answers have every digit
    for (PointwiseSample& sample : printed.samples) sample.torques_given.setZero();
    out = deviationTexts(motors, printed);
  }
  if (out.summary.empty()) return out;
  if (const std::size_t off = deviationOf(torques).count; off > 0)
    out.deviation += fmt::format("; off in {} of {} samples, {:.3g} %", off, torques.file.rows(),
                                 100.0 * static_cast<double>(off) / static_cast<double>(torques.file.rows()));
  Explanation explanation = alone.explanation ? *alone.explanation : explanationOf(scenario, torques, asked);
  out.cause = std::move(explanation.text);
  out.claim = explanation.claim;
  out.named = std::move(explanation.named);
  out.others = std::move(explanation.others);
  out.together = std::move(explanation.together);
  out.terms = asked.terms;
  for (TermError& term : out.terms)
    if (term.term == repeat_term) term.error = std::max(term.error, alone.change);
  return out;
}

void addDiagnosis(const Diagnosis& diagnosis, ValidationResult& result) {
  if (diagnosis.summary.empty()) return;
  result.cause_words = {diagnosis.deviation, diagnosis.cause, diagnosis.claim};
  result.cause = diagnosis.named;
  result.causes = diagnosis.others;
  result.causes_together = diagnosis.together;
  result.terms = diagnosis.terms;
  nameState(result);
  sayCause(diagnosis.summary, result);
}

}  // namespace ursula
