#include <algorithm>
#include <cmath>
#include <utility>

#include "parts/causes/explanation.h"
#include "parts/causes/fits.h"
#include "parts/causes/pursuit.h"
#include "parts/causes/tried_causes.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using Eigen::VectorXd;
using Motions = std::vector<Motion<double>>;

constexpr std::size_t few_instants = 30, least_instants = 8;
/// A single mistake that leaves fewer limits than this needs no second one.
constexpr double far_beyond = 20;

VectorXd stacked(const std::vector<Vector6d>& rows) {
  VectorXd out(motor_count * static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k)
    out.segment<motor_count>(motor_count * static_cast<Eigen::Index>(k)) = rows[k];
  return out;
}

/// Several causes put into the closed form at once: wrong machine, misread motion, then what formulas add.
class Together {
 public:
  Together(const Scenario& scenario, const std::vector<Cause>& causes) : scenario_(scenario), causes_(causes) {}

  std::optional<VectorXd> operator()(const Motions& motions, const std::vector<std::size_t>& which,
                                     const VectorXd& x) const {
    return unlessRefused([&] { return stacked(efforts(motions, which, x)); });
  }

  EffortsTogether at(const Motions& motions) const {
    return [this, &motions](const auto& which, const auto& x) { return (*this)(motions, which, x); };
  }

 private:
  std::vector<Vector6d> efforts(const Motions& motions, const std::vector<std::size_t>& which,
                                const VectorXd& x) const {
    ManipulatorParameters machine = scenario_.manipulator->parameters();
    const auto number = [&x](std::size_t i) { return x(static_cast<Eigen::Index>(i)); };
    bool is_changed = false;
    for (std::size_t i = 0; i < which.size(); ++i)
      if (const auto& change = causes_[which[i]].machine) change(machine, number(i)), is_changed = true;
    Scenario other = scenario_;
    if (is_changed) other.manipulator = std::make_shared<const Manipulator>(machine);
    const Subject right = nocSubject(withoutStroke(*other.manipulator), other.load);
    std::vector<EffortsOf> formulas;
    for (std::size_t i = 0; i < which.size(); ++i)
      if (const Cause& cause = causes_[which[i]]; !cause.machine && !cause.reading)
        formulas.push_back(cause.solver(other, number(i)));
    std::vector<Vector6d> out;
    for (Motion<double> motion : motions) {
      for (std::size_t i = 0; i < which.size(); ++i)
        if (const auto& read = causes_[which[i]].reading) read(motion, number(i));
      const Vector6d without = right.torques(motion);
      out.push_back(without);
      for (const EffortsOf& formula : formulas) out.back() += formula(motion) - without;
    }
    return out;
  }

  const Scenario& scenario_;
  const std::vector<Cause>& causes_;
};

/// The causes that can be one of several, terms left out first.
std::vector<Cause> causesToPursue(const Scenario& scenario, bool along_motion) {
  TriedCauses out{scenario};
  if (along_motion) addDelay(out);
  addTerms(out);
  addEveryCause(out);
  const auto isUnnamed = [](const Cause& cause) {
    return !cause.named || std::find(cause.starts.begin(), cause.starts.end(), 0) == cause.starts.end();
  };
  out.causes.erase(std::remove_if(out.causes.begin(), out.causes.end(), isUnnamed), out.causes.end());
  return std::move(out.causes);
}

VectorXd effectOf(const Cause& cause, const TorqueResidual& data, const VectorXd& right) {
  constexpr double step = 1e-5;
  const auto effect = [&]() -> VectorXd {
    if (!cause.fitted) return stacked(cause.torques(0, data.motions)) - right;
    if (cause.slope) return stacked(cause.slope(data.motions));
    return (stacked(cause.torques(step, data.motions)) - stacked(cause.torques(-step, data.motions))) / (2 * step);
  };
  return unlessRefused(effect).value_or(VectorXd::Constant(right.size(), NAN));
}

/// Without the ends of the motion, so that a delay has efforts.
TorqueResidual innerOf(const TorqueResidual& data, double duration) {
  TorqueResidual inner;
  inner.motors = data.motors;
  for (std::size_t k = 0; k < data.motions.size(); ++k)
    if (std::abs(data.motions[k].t - duration / 2) < 0.45 * duration) inner.add(data, k);
  inner.commanded = inner.motions.size();
  return inner;
}

/// Names the cause of efforts that differ from the right ones by `effect`.
NameAlone nameAlone(const Scenario& scenario, const TorqueResidual& data) {
  return [&scenario, &data](const VectorXd& effect) -> std::optional<NamedAlone> {
    TorqueResidual alone = data;
    for (std::size_t k = 0; k < data.motions.size(); ++k)
      alone.residual[k] = effect.segment<motor_count>(motor_count * static_cast<Eigen::Index>(k));
    for (Vector6d& limit : alone.limit) limit *= std::max(1.0, data.growth() / alone.growth());
    const std::vector<Hypothesis> fitted = fitHypotheses(scenario, alone);
    if (fitted.empty()) return std::nullopt;
    const std::vector<Hypothesis> best = bestOf(fitted);
    if (!explains(best.front()) || !best.front().named) return std::nullopt;
    const Explanation said = named(best, alone, "");
    const auto words = [first = best.front()](double wider) { return first.says ? first.says(wider) : first.text; };
    if (said.named) return NamedAlone{*said.named, words};
    if (said.others.empty()) return std::nullopt;
    return NamedAlone{said.others.front(), words, othersText(best), {said.others.begin() + 1, said.others.end()}};
  };
}

}  // namespace

Explanation severalMistakes(const Scenario& scenario, const TorqueResidual& data, double left) {
  const bool along_motion = data.commanded == data.motions.size();
  if (data.commanded < least_instants || left < far_beyond || isNoise(data.alongMotion())) return {};
  const TorqueResidual inner = along_motion ? innerOf(data, scenario.trajectory->duration()) : data;
  const TorqueResidual few = inner.picked(along_motion ? few_instants : 2 * few_instants);
  const std::vector<Cause> causes = causesToPursue(scenario, along_motion);
  const VectorXd right = stacked(few.exact);
  std::vector<Suspect> suspects;
  for (const Cause& cause : causes)
    suspects.push_back({cause.named(0, 0).value_or(NamedCause{}), effectOf(cause, few, right), cause.fitted});
  const bool has_delay = !suspects.empty() && suspects.front().named.kind == CauseKind::delay;
  const Together together(scenario, causes);
  const Pursuit pursuit(std::move(suspects), right, right + stacked(few.residual), data.growth() * stacked(few.limit),
                        motor_count, together.at(few.motions));
  const std::vector<Mistakes> sets = pursuit.best();
  if (sets.empty()) return {};
  const auto& which = sets.front().which;
  const bool is_late = has_delay && std::find(which.begin(), which.end(), std::size_t{0}) != which.end();
  const TorqueResidual& there = is_late ? inner : data;
  const std::optional<SeveralNamed> each =
      nameEach(pursuit, sets, stacked(there.residual), together.at(there.motions), nameAlone(scenario, there));
  if (!each) return {};
  Explanation out{each->words};
  if (each->is_sure) {
    out.named = each->together.front();
    out.together = each->together;
  } else {
    out.others = each->together;
    out.others.insert(out.others.end(), each->ties.begin(), each->ties.end());
  }
  return out;
}

}  // namespace ursula
