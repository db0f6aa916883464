#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/errors.h"
#include "nocsolver/errors.h"
#include "validation/findings/findings.h"
#include "validation/subject/subject.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

using Parameters = ManipulatorParameters;
using Samples = std::vector<PointwiseSample>;

/// A way to idealise the legs, as a scenario can say it.
struct Idealisation {
  const char* name;
  ScenarioChange left_out;
  void (*apply)(Leg&);
  bool is_all = false;
};

const std::vector<Idealisation>& idealisations() {
  static const std::vector<Idealisation> all = {
      {"spin", {"manipulator.leg_defaults.spin", "free"}, [](Leg& leg) { leg.spins = leg.kind != LegKind::URS; }},
      {"spin", {"manipulator.leg_defaults.spin", "held"}, [](Leg& leg) { leg.spins = false; }},
      {"rotor_inertia", {"manipulator.leg_defaults.rotor_inertia", "{}"}, [](Leg& leg) { leg.rotor_inertia = {}; }},
      {"friction", {"manipulator.leg_defaults.friction", "{}"}, [](Leg& leg) { leg.friction = {}; }},
      {"coulomb", {"manipulator.leg_defaults.coulomb", "{}"}, [](Leg& leg) { leg.coulomb = {}; }},
      {"legs",
       {"manipulator.legs", "massless"},
       [](Leg& leg) {
         for (Link* link : {&leg.proximal, &leg.distal}) *link = Link{link->length};
       },
       true}};
  return all;
}

/// The machine with other legs, in natural units; null if no machine can have them. Made of the machine as given, since
/// links that spin freely lose a moment of inertia.
std::shared_ptr<const Manipulator> idealised(Parameters machine, const FrameChange& natural,
                                             const std::vector<const Idealisation*>& ways) {
  for (const Idealisation* way : ways)
    for (Leg& leg : machine.legs) way->apply(leg);
  try {
    return std::make_shared<const Manipulator>(natural.transformed(Manipulator(machine)));
  } catch (const InvalidParameter&) {
    return nullptr;
  }
}

Samples picked(const Samples& samples, std::size_t most) {
  Samples out;
  const std::size_t count = std::min(samples.size(), most);
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(samples[count == 1 ? 0 : i * (samples.size() - 1) / (count - 1)]);
  return out;
}

using ChangeMotion = std::function<void(Motion<double>&)>;

/// Efforts of all samples; empty if the machine has none.
std::vector<double> effortsOf(const Manipulator& machine, const std::shared_ptr<const Load>& load,
                              const Samples& samples, const ChangeMotion& change = {}) {
  const Subject noc = nocSubject(machine, load);
  std::vector<double> out;
  try {
    for (const PointwiseSample& sample : samples) {
      Motion<double> motion = sample.motion;
      if (change) change(motion);
      const Vector6d efforts = noc.torques(motion);
      out.insert(out.end(), efforts.data(), efforts.data() + motor_count);
    }
  } catch (const PoseError&) {
    return {};
  }
  return out;
}

/// The terms of the equations as a whole, then what idealisations leave out.
class Terms {
 public:
  Terms(const Scenario& scenario, const Samples& samples, const Scenario& given, const FrameChange& natural)
      : scenario_(scenario),
        samples_(samples),
        given_(given),
        natural_(natural),
        right_(effortsOf(*scenario.manipulator, scenario.load, samples)) {
    Parameters weightless = scenario.manipulator->given();
    weightless.gravity.setZero();
    add({"gravity"}, effortsOf(Manipulator(weightless), scenario.load, samples));
    const auto unaccelerated = [](Motion<double>& motion) {
      motion.omega_dot.setZero();
      motion.p_ddot.setZero();
    };
    const auto still = [](Motion<double>& motion) {
      motion.omega.setZero();
      motion.p_dot.setZero();
    };
    add({"acceleration"}, effortsOf(*scenario.manipulator, scenario.load, samples, unaccelerated));
    add({"velocity"}, effortsOf(*scenario.manipulator, scenario.load, samples, still));
    for (const Idealisation& way : idealisations()) {
      const auto machine = idealised(given.manipulator->given(), natural, {&way});
      if (machine) add({way.name, {}, {way.left_out}, way.is_all}, effortsOf(*machine, scenario.load, samples));
    }
  }

  const std::vector<ModelTerm>& all() const { return terms_; }
  const std::vector<double>& right() const { return right_; }

  /// Whether the efforts are right by Simbody, too, if the scenario has these changes.
  bool areRightWith(const std::vector<ScenarioChange>& changes, double allowed) const {
    std::vector<const Idealisation*> ways;
    for (const Idealisation& way : idealisations())
      for (const ScenarioChange& change : changes)
        if (way.left_out.key == change.key && way.left_out.value == change.value) ways.push_back(&way);
    Scenario other = scenario_;
    other.manipulator = idealised(given_.manipulator->given(), natural_, ways);
    if (!other.manipulator) return false;
    const Samples few = picked(samples_, 300);
    std::vector<double> instants;
    for (const PointwiseSample& sample : few) instants.push_back(sample.motion.t);
    Subject given;
    given.torques = [&few](const Motion<double>& motion) { return few[indexFrom(few, motion.t)].torques; };
    const Samples judged = runPointwise(other, given, instants);
    for (std::size_t i = 0; i < judged.size(); ++i) {
      const Vector6d error = (few[i].torques - judged[i].torques_simbody).cwiseAbs();
      const Vector6d limit = (judged[i].torqueLimits() + few[i].torques_given).cwiseMax(allowed);
      if (!(error.array() <= limit.array()).all()) return false;
    }
    return true;
  }

 private:
  void add(ModelTerm term, const std::vector<double>& without) {
    if (without.size() != right_.size()) return;
    for (std::size_t i = 0; i < right_.size(); ++i) term.efforts.push_back(right_[i] - without[i]);
    terms_.push_back(std::move(term));
  }

  const Scenario& scenario_;
  const Samples& samples_;
  const Scenario& given_;
  const FrameChange& natural_;
  std::vector<double> right_;
  std::vector<ModelTerm> terms_;
};

}  // namespace

std::optional<FailureSize> failureSize(const Scenario& scenario, const Samples& all, const Scenario& given,
                                       const FrameChange& natural, const ValidationResult& result) {
  constexpr std::size_t most = 1000;
  if (!result.deviation || all.empty()) return std::nullopt;
  const Samples samples = picked(all, most);
  const Terms terms(scenario, samples, given, natural);
  JudgedEfforts efforts;
  efforts.largest = result.deviation->largest_effort / natural.units.effort();
  efforts.allowed = result.deviation->allowed / natural.units.effort();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vector6d limits = samples[i].torqueLimits();
    for (Eigen::Index k = 0; k < motor_count && terms.right().size() > 0; ++k) {
      efforts.residual.push_back(samples[i].torques(k) - terms.right()[efforts.residual.size()]);
      efforts.limits.push_back(limits(k));
      efforts.condition.push_back(samples[i].conditioning.kappa_B);
    }
  }
  return sizeOf(efforts, terms.all(), result, [&](const std::vector<ScenarioChange>& changes) {
    return terms.areRightWith(changes, efforts.allowed);
  });
}

}  // namespace ursula
