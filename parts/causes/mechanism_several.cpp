#include <algorithm>
#include <cmath>
#include <utility>

#include "parts/causes/mechanism_tried.h"
#include "parts/causes/pursuit.h"

namespace ursula::mechanisms {
namespace {

constexpr std::size_t few_instants = 30;
/// A single mistake that leaves fewer limits than this needs no second one.
constexpr double far_beyond = 20;

}  // namespace

EffortResidual picked(const EffortResidual& data, const std::vector<std::size_t>& rows, double shift) {
  EffortResidual out = data;
  out.t.clear(), out.instants.clear();
  const auto size = static_cast<Eigen::Index>(rows.size()) * data.motors;
  for (VectorXd* each : {&out.noc, &out.found, &out.limit, &out.rounds}) each->resize(size);
  LoopWork work;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto to = static_cast<Eigen::Index>(i) * data.motors;
    const auto from = static_cast<Eigen::Index>(rows[i]) * data.motors;
    out.t.push_back(data.t[rows[i]] + shift);
    out.instants.push_back(shift == 0 ? data.instants[rows[i]] : instantAt(*data.motion, out.t.back()));
    out.found.segment(to, data.motors) = data.found.segment(from, data.motors);
    out.limit.segment(to, data.motors) = data.limit.segment(from, data.motors);
    out.rounds.segment(to, data.motors) = data.rounds.segment(from, data.motors);
    if (shift == 0)
      out.noc.segment(to, data.motors) = data.noc.segment(from, data.motors);
    else
      out.noc.segment(to, data.motors) = data.motion->inverseDynamics(out.t.back(), work);
  }
  return out;
}

namespace {

std::vector<std::size_t> rowsOf(const EffortResidual& data) {
  std::vector<std::size_t> out(data.t.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = i;
  return out;
}

/// Several mistakes at once: another time, another machine, then what formulas add. The first suspect is a delay.
class Together {
 public:
  explicit Together(const EffortResidual& data) : data_(data) {
    for (const auto add : {addJointTerms, addBodyCauses, addClosureCauses, addJointNumbers, addBodyNumbers})
      add(data, tried_);
    const auto has_many = [](const Tried& one) { return one.steps.size() > 1; };
    tried_.erase(std::remove_if(tried_.begin(), tried_.end(), has_many), tried_.end());
  }

  std::vector<Suspect> suspects() const {
    std::vector<Suspect> out;
    const double step = 1e-5 * data_.motion->trajectory().duration();
    const auto slope = [&](std::size_t place, double h) -> VectorXd {
      const std::optional<VectorXd> above = (*this)({place}, VectorXd::Constant(1, h));
      const std::optional<VectorXd> below = (*this)({place}, VectorXd::Constant(1, -h));
      if (!above || !below) return VectorXd::Constant(data_.noc.size(), NAN);
      return (*above - *below) / (2 * h);
    };
    out.push_back({{CauseKind::delay}, slope(0, step), true, step});
    for (std::size_t i = 0; i < tried_.size(); ++i) {
      const Tried& one = tried_[i];
      if (one.steps.size() == 0)
        out.push_back({one.named, one.change(data_, one.steps)});
      else
        out.push_back({one.named, slope(i + 1, 1e-3 * one.steps(0)), true, 1e-3 * one.steps(0)});
    }
    return out;
  }

  std::optional<VectorXd> operator()(const std::vector<std::size_t>& which, const VectorXd& x) const {
    try {
      return efforts(which, x);
    } catch (const std::exception&) {  // no such machine or instant
      return std::nullopt;
    }
  }

 private:
  VectorXd efforts(const std::vector<std::size_t>& which, const VectorXd& x) const {
    MechanismParameters parameters = data_.mechanism->parameters();
    std::optional<EffortResidual> later;
    bool is_changed = false;
    for (std::size_t i = 0; i < which.size(); ++i) {
      const VectorXd number = x.segment(static_cast<Eigen::Index>(i), 1);
      if (which[i] == 0)
        later = picked(data_, rowsOf(data_), -number(0));
      else if (tried_[which[i] - 1].machine)
        tried_[which[i] - 1].machine(parameters, number), is_changed = true;
    }
    EffortResidual of = later ? std::move(*later) : data_;
    VectorXd out = of.noc;
    const Mechanism changed(parameters);
    if (is_changed)
      out += of.each(
          [&](const Instant& at) { return VectorXd(effortsOf(changed, at) - effortsOf(*data_.mechanism, at)); });
    of.mechanism = &changed;
    for (std::size_t i = 0; i < which.size(); ++i)
      if (which[i] > 0 && !tried_[which[i] - 1].machine)
        out += tried_[which[i] - 1].change(of, x.segment(static_cast<Eigen::Index>(i), 1));
    return out;
  }

  const EffortResidual& data_;
  std::vector<Tried> tried_;
};

/// Rows within a part of the motion around its middle, at most `most` of them.
std::vector<std::size_t> rowsWithin(const EffortResidual& data, double from, double to, std::size_t most) {
  std::vector<std::size_t> all, out;
  for (std::size_t i = 0; i < data.t.size(); ++i)
    if (data.t[i] >= from && data.t[i] <= to) all.push_back(i);
  const std::size_t count = std::min(most, all.size());
  for (std::size_t i = 0; i < count; ++i) out.push_back(all[count == 1 ? 0 : i * (all.size() - 1) / (count - 1)]);
  return out;
}

/// Names the cause of efforts that differ from the right ones by `effect`.
NameAlone nameAlone(const EffortResidual& data) {
  return [&data](const VectorXd& effect) -> std::optional<NamedAlone> {
    EffortResidual alone = data;
    alone.found = data.noc + effect;
    const double growth =
        std::max(1.0, data.found.cwiseAbs().maxCoeff() / std::max(alone.found.cwiseAbs().maxCoeff(), 1e-300));
    alone.limit *= growth, alone.rounds *= growth;
    const std::optional<Explained> all = explained(fittedCauses(alone));
    if (!all) return std::nullopt;
    const auto words = [first = all->first](double wider) {
      Fitted one = first;
      if (one.named.uncertainty) *one.named.uncertainty *= wider;
      return inWords(one);
    };
    NamedAlone out{withShare(all->first), words, othersIn(all->others)};
    for (const Fitted& one : all->others) out.ties.push_back(withShare(one));
    return out;
  };
}

}  // namespace

bool nameSeveral(const EffortResidual& data, double left, ValidationResult& result) {
  if (left < far_beyond) return false;
  const double T = data.motion->trajectory().duration();
  const EffortResidual inner = picked(data, rowsWithin(data, 0.05 * T, 0.95 * T, data.t.size()), 0);
  const EffortResidual few = picked(inner, rowsWithin(inner, 0, T, few_instants), 0);
  const auto at = [](const Together& all) -> EffortsTogether {
    return [&all](const auto& which, const auto& x) { return all(which, x); };
  };
  const Together together(few);
  const Pursuit pursuit(together.suspects(), few.noc, few.found, few.limit, few.motors, at(together));
  const std::vector<Mistakes> sets = pursuit.best();
  if (sets.empty()) return false;
  const auto& which = sets.front().which;
  const EffortResidual& there = std::find(which.begin(), which.end(), std::size_t{0}) != which.end() ? inner : data;
  const Together of_all(there);
  const std::optional<SeveralNamed> each = nameEach(pursuit, sets, there.residual(), at(of_all), nameAlone(there));
  if (!each) return false;
  if (each->is_sure) {
    result.causes_together = each->together;
    result.cause = each->together.front();
  } else {
    result.causes = each->together;
    result.causes.insert(result.causes.end(), each->ties.begin(), each->ties.end());
  }
  result.cause_words.cause = each->words;
  result.cause_words.claim = CauseClaim::likely;
  return true;
}

}  // namespace ursula::mechanisms
