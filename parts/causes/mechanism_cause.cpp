#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/dense.h"
#include "parts/causes/explanation.h"
#include "parts/causes/few_digits.h"
#include "parts/causes/mechanism_tried.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace mechanisms {
namespace {

/// A likely explanation of one part leaves less than this share of the deviation; one that is listed leaves less.
constexpr double may_remain = 0.01, worth_listing = 0.9;
constexpr std::size_t most_instants = 300, most_ranked = 3, least_instants = 4;

EffortResidual residualOf(const MechanismEvidence& evidence) {
  EffortResidual out;
  out.mechanism = evidence.scenario->mechanism.get();
  out.motion = evidence.motion;
  out.motors = evidence.efforts_in.size();
  const std::size_t rows = evidence.samples.size(), count = std::min(rows, most_instants);
  const auto size = static_cast<Eigen::Index>(count) * out.motors;
  for (VectorXd* each : {&out.noc, &out.found, &out.limit, &out.rounds}) each->resize(size);
  MotorEfforts most = MotorEfforts::Zero(out.motors), right = most;
  for (const MechanismSample& sample : evidence.samples) {
    most = most.cwiseMax(sample.subject.cwiseAbs());
    right = right.cwiseMax(sample.scale.cwiseAbs());
  }
  for (std::size_t i = 0; i < count; ++i) {
    const MechanismSample& sample = evidence.samples[count == 1 ? 0 : i * (rows - 1) / (count - 1)];
    const auto at = static_cast<Eigen::Index>(i) * out.motors;
    out.t.push_back(sample.motion.t);
    out.instants.push_back(instantAt(*evidence.motion, sample.motion.t));
    out.noc.segment(at, out.motors) = sample.noc;
    out.found.segment(at, out.motors) = sample.subject;
    if (evidence.gives_accelerations) out.inertia.push_back(inverseOf(sample.inverse_inertia));
    for (Eigen::Index k = 0; k < out.motors; ++k) {
      const double growth = right(k) > 0 ? std::max(1.0, most(k) / right(k)) : 1;
      out.rounds(at + k) = growth * evidence.limit(sample, k) / evidence.efforts_in(k);
      out.limit(at + k) = std::max(out.rounds(at + k) + sample.given(k), 1e-300);
    }
  }
  return out;
}

/// Whether the motors stand still: too many causes then make the same few numbers.
bool isAtRest(const EffortResidual& data) {
  const Instant& first = data.instants.front();
  return std::all_of(data.instants.begin(), data.instants.end(), [&](const Instant& each) {
    return each.motion.q == first.motion.q && each.motion.qddot == first.motion.qddot;
  });
}

/// Whether every effort has few digits, and the right one is as near as these allow.
bool nameDigits(const EffortResidual& data, bool is_single, ValidationResult& result) {
  std::vector<Answer> answers;
  bool slides = true;
  for (Eigen::Index i = 0; i < data.found.size(); ++i) {
    const double found = data.found(i);
    answers.push_back({found, data.noc(i), data.limit(i), data.limit(i)});
  }
  for (std::size_t k = 0; k < data.mechanism->motorCount(); ++k) slides = slides && data.mechanism->motor(k).slides();
  std::string words;
  if (is_single && areNearSingle(answers))
    words = "the efforts have single precision";
  else if (const auto rounded = roundedTo(answers, slides ? "N" : "N m"))
    words = "few digits: every effort is rounded to " + *rounded;
  if (words.empty()) return false;
  result.cause = NamedCause{CauseKind::digits};
  result.cause->body = "all";
  result.cause->explained = 1;
  result.cause_words.cause = words;
  result.cause_words.claim = CauseClaim::likely;
  return true;
}

/// Names an interval in which the efforts are wrong, if they are right in a tenth of the motion at least.
bool nameWindow(const EffortResidual& data, ValidationResult& result) {
  std::vector<std::size_t> off;
  std::vector<int> motors;
  for (std::size_t i = 0; i < data.t.size(); ++i) {
    bool is_off = false;
    for (Eigen::Index k = 0; k < data.motors; ++k) {
      const Eigen::Index at = static_cast<Eigen::Index>(i) * data.motors + k;
      if (std::abs(data.found(at) - data.noc(at)) <= data.limit(at)) continue;
      is_off = true;
      if (std::find(motors.begin(), motors.end(), static_cast<int>(k)) == motors.end())
        motors.push_back(static_cast<int>(k));
    }
    if (is_off) off.push_back(i);
  }
  if (off.size() < 3) return false;
  const std::size_t span = off.back() + 1 - off.front();
  if (20 * off.size() < 19 * span || 10 * span > 9 * data.t.size()) return false;
  NamedCause named{CauseKind::window};
  named.from_s = data.t[off.front()];
  named.to_s = data.t[off.back()];
  named.explained = 1;
  if (static_cast<Eigen::Index>(motors.size()) == data.motors)
    named.body = "all";
  else if (motors.size() == 1)
    named.motor = motors.front() + 1;
  result.cause = named;
  result.cause_words.cause = fmt::format("right but from t = {:.6g} to {:.6g} s", *named.from_s, *named.to_s);
  result.cause_words.claim = CauseClaim::interval;
  return true;
}

/// Lists what explains most of the deviation. Several fitted numbers explain much of anything, so they are no part.
void listParts(std::vector<Fitted> fitted, const EffortResidual& data, ValidationResult& result) {
  fitted.erase(std::remove_if(fitted.begin(), fitted.end(),
                              [&](const Fitted& one) {
                                return one.is_smooth || one.unexplained > worth_listing ||
                                       one.of_found > worth_listing || one.numbers > 1 ||
                                       10 * one.numbers > data.noc.size();
                              }),
               fitted.end());
  std::stable_sort(fitted.begin(), fitted.end(),
                   [](const Fitted& a, const Fitted& b) { return a.unexplained < b.unexplained; });
  result.cause_words.claim = CauseClaim::none;
  result.cause_words.cause = "no simple explanation";
  if (fitted.empty()) return;
  const Fitted& first = fitted.front();
  if (first.unexplained > may_remain) {
    result.cause_words.cause += fmt::format(". The best: {}, which explains only {}", inWords(first), percentOf(first));
  } else {
    result.cause_words.claim = CauseClaim::part;
    result.cause_words.cause = fmt::format(
        "a likely part: {}, which explains {}. What remains is up to {:.3g} times the limit of rounding and "
        "digits",
        inWords(first), percentOf(first), first.beyond);
  }
  for (const Fitted& one : std::as_const(fitted)) {
    const auto isSame = [&](const Fitted& other) { return inWords(other) == inWords(one); };
    if (result.causes.size() == most_ranked || std::any_of(std::as_const(fitted).data(), &one, isSame)) continue;
    result.causes.push_back(withShare(one));
    if (&one != &first)
      result.cause_words.cause +=
          fmt::format(". Next: {}, {:.3g} %", inWords(one), 100 * result.causes.back().explained);
  }
}

/// "crank_hinge by up to 0.2 N m at t = 0.3 s"; empty if every motor is within its limits.
std::string deviationIn(const EffortResidual& data) {
  std::string out;
  for (Eigen::Index k = 0; k < data.motors; ++k) {
    double largest = 0, at_s = 0;
    for (std::size_t i = 0; i < data.t.size(); ++i) {
      const Eigen::Index at = static_cast<Eigen::Index>(i) * data.motors + k;
      const double off = std::abs(data.found(at) - data.noc(at));
      if (!(off > data.limit(at)) || off <= largest) continue;
      largest = off;
      at_s = data.t[i];
    }
    if (largest > 0)
      out += fmt::format("{}{} by up to {:.4g} {} at t = {:.6g} s", out.empty() ? "" : "; ",
                         data.mechanism->motor(k).name, largest, data.mechanism->motor(k).slides() ? "N" : "N m", at_s);
  }
  return out;
}

}  // namespace

std::vector<Fitted> fittedCauses(const EffortResidual& data) {
  std::vector<Tried> tried;
  for (const auto add : {addAccelerationCauses, addEffortCauses, addClosureCauses, addJointTerms, addBodyCauses,
                         addJointNumbers, addBodyNumbers})
    add(data, tried);
  std::vector<Fitted> out = fitAll(tried, data);
  addDelay(data, out);
  std::stable_sort(out.begin(), out.end(), [](const Fitted& a, const Fitted& b) { return a.numbers < b.numbers; });
  return out;
}

namespace {

/// Names a place or an axis of a joint if no other mistake explains everything.
bool nameGeometry(const EffortResidual& data, const std::vector<Fitted>& others, ValidationResult& result) {
  if (others.empty()) return false;
  std::vector<Fitted> all = fittedGeometry(data);
  all.insert(all.end(), others.begin(), others.end());
  std::stable_sort(all.begin(), all.end(), [](const Fitted& a, const Fitted& b) { return a.numbers < b.numbers; });
  return nameAll(all, result);
}

}  // namespace
}  // namespace mechanisms

AddMechanismCause addMechanismCause;

void addMechanismCause(const MechanismScenario&, const MechanismEvidence& evidence, ValidationResult& result) {
  using namespace mechanisms;
  if (evidence.samples.empty() || evidence.motion == nullptr) return;
  const EffortResidual data = residualOf(evidence);
  result.cause_words.off = deviationIn(data);
  if (result.cause_words.off.empty() || !data.found.allFinite()) return;
  if (!evidence.no_cause.empty()) {
    result.cause_words.cause = evidence.no_cause;
  } else if (!nameDigits(data, evidence.all_single, result)) {
    std::vector<Fitted> fitted;
    if (data.instants.size() >= least_instants && !isAtRest(data)) fitted = fittedCauses(data);
    const auto least = std::min_element(fitted.begin(), fitted.end(),
                                        [](const Fitted& a, const Fitted& b) { return a.beyond < b.beyond; });
    if (!nameAll(fitted, result) && !nameGeometry(data, fitted, result) &&
        !(least != fitted.end() && nameSeveral(data, least->beyond, result)) && !nameWindow(data, result))
      listParts(fitted, data, result);
  }
  result.terms = askedApart(evidence);
  nameState(result);
  sayCause(result.cause_words.off, result);
}

}  // namespace ursula
