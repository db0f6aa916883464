#include <algorithm>

#include "parts/causes/blind_spots.h"
#include "parts/causes/mechanism_tried.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula::mechanisms {
namespace {

/// The right efforts of some instants as a residual without any; `rounding` gets the limit of each instant.
EffortResidual rightEfforts(const MechanismScenario& scenario, const LoopMotion& motion,
                            std::vector<VectorXd>& rounding) {
  EffortResidual out;
  out.mechanism = scenario.mechanism.get();
  out.motion = &motion;
  out.motors = static_cast<Eigen::Index>(scenario.mechanism->motorCount());
  out.noc.resize(static_cast<Eigen::Index>(blind_instants) * out.motors);
  const MechanismEvidence limits;
  for (std::size_t k = 0; k < blind_instants; ++k) {
    const double t = scenario.trajectory->duration() * static_cast<double>(k) / (blind_instants - 1);
    LoopWork work;
    out.noc.segment(static_cast<Eigen::Index>(k) * out.motors, out.motors) = motion.inverseDynamics(t, work);
    const double condition = 1 / work.reciprocal_condition;
    rounding.emplace_back(limits.level * ursula::rounding * condition * condition * motion.solver().effortScale(work));
    out.t.push_back(t);
    out.instants.push_back(instantAt(motion, t));
  }
  out.found = out.noc;
  out.limit = VectorXd::Constant(out.noc.size(), 1e-300);
  return out;
}

/// Terms of joints that the machine does not have.
void addAbsent(const Mechanism& mechanism, BlindSpots& out) {
  const auto none = [&](double MechanismJoint::*number) {
    return std::all_of(mechanism.joints().begin(), mechanism.joints().end(),
                       [&](const MechanismJoint& joint) { return joint.*number == 0; });
  };
  const auto add = [&](const char* term, bool is_absent) {
    const NamedCause named{CauseKind::missing_term, term, "all"};
    if (is_absent) out.add(inWords({named, "the model has none"}), named, 0);
  };
  add("friction", none(&MechanismJoint::damping) && none(&MechanismJoint::friction));
  add("rotor_inertia", none(&MechanismJoint::rotor_inertia));
  add("springs", none(&MechanismJoint::stiffness));
}

void tryOne(const Tried& tried, const EffortResidual& data, BlindSpots& out) {
  if (tried.steps.size() > 1 || (tried.named.kind == CauseKind::closure && tried.steps.size() > 0)) return;
  const bool is_place = tried.named.parameter.find(".center_of_mass.") != std::string::npos;
  const VectorXd x = (is_place ? 10 : wrong_by) * tried.steps;  // a hundredth of the machine's length
  Fitted mistake{tried.named, tried.detail};
  if (tried.finish) static_cast<void>(tried.finish(x, VectorXd::Zero(x.size()), mistake.named));
  mistake.named.uncertainty.reset();
  const VectorXd change = tried.change(data, x);
  out.tryOut(inWords(mistake), mistake.named, [&](std::size_t k) -> VectorXd {
    return out.right(k) + change.segment(static_cast<Eigen::Index>(k) * data.motors, data.motors);
  });
}

}  // namespace

std::vector<BlindSpot> blindSpotsOf(const MechanismScenario& scenario);
std::vector<BlindSpot> blindSpotsOf(const MechanismScenario& scenario) {
  const MechanismAlong along(scenario);
  std::vector<VectorXd> right, rounding;
  const EffortResidual data = rightEfforts(scenario, along.motion(), rounding);
  for (std::size_t k = 0; k < blind_instants; ++k)
    right.emplace_back(data.noc.segment(static_cast<Eigen::Index>(k) * data.motors, data.motors));
  BlindSpots out(std::move(right), std::move(rounding), scenario.tolerance, scenario.trajectory->duration());
  std::vector<Tried> tried;
  for (const auto add : {addClosureCauses, addJointTerms, addBodyCauses, addJointNumbers, addBodyNumbers})
    add(data, tried);
  for (const Tried& each : tried) tryOne(each, data, out);
  addAbsent(*scenario.mechanism, out);
  const auto name = [&](int motor) { return "'" + scenario.mechanism->motor(motor).name + "'"; };
  out.addOfEfforts(name);
  return out.list(0);
}

}  // namespace ursula::mechanisms
