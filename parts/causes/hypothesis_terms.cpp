#include <functional>

#include "nocsolver/errors.h"
#include "parts/causes/fits.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using MotionChange = void (*)(Motion<double>&);

/// The efforts of a motion without the term; `right` are those with it.
using Without = std::function<Vector6d(const Motion<double>&, const Vector6d& right)>;

struct WrongFormula {
  FormulaError formula_error;
  const char* name;
  const char* term = "";  ///< name in the contract
  const char* body = "";
};

/// Parts that the solver can omit; they may also be scaled.
const WrongFormula parts[] = {
    {FormulaError::drop_gravity_platform, "the platform's gravity", "gravity", "platform"},
    {FormulaError::drop_gravity_legs, "the links' gravity", "gravity", "legs"},
    {FormulaError::drop_centrifugal, "the centrifugal terms", "centripetal", "legs"},
    {FormulaError::drop_coriolis, "the Coriolis terms", "coriolis", "legs"},
    {FormulaError::drop_gyroscopic_legs, "the links' gyroscopic moments", "gyroscopic", "legs"},
    {FormulaError::drop_gyroscopic_platform, "the platform's gyroscopic moment", "gyroscopic", "platform"},
    {FormulaError::drop_platform_centripetal, "the platform's centripetal acceleration", "centripetal", "platform"},
    {FormulaError::drop_link_coupling, "the terms in the elbow's motion", "coriolis", "distal"},
};

const WrongFormula printed[] = {
    {FormulaError::eq2, "(2a,b) as printed"},
    {FormulaError::eq4c, "(4c) as printed"},
    {FormulaError::eq14a, "(14a) as printed"},
    {FormulaError::eq14b, "(14b) as printed"},
    {FormulaError::eq15a, "(15a) as printed"},
    {FormulaError::eq16, "(16) as printed"},
    {FormulaError::eq17, "(17a,b) as printed"},
    {FormulaError::eq19a, "(19a) as printed"},
    {FormulaError::eq19b, "(19b) as printed"},
    {FormulaError::eq23, "(23) as printed"},
    {FormulaError::eq43b_omega_dot, "(43b) as printed, the rate for the square"},
    {FormulaError::eq43b_sigma, "(43b) as printed, sigma + [s]"},
    {FormulaError::eq43b_doubled, "(43b) as printed, its last terms doubled"},
    {FormulaError::eq47, "the text by (47) as printed"},
};

void keep(Motion<double>& /*motion*/) {}
void doNotAccelerate(Motion<double>& motion) {
  motion.omega_dot.setZero();
  motion.p_ddot.setZero();
}
void rest(Motion<double>& motion) {
  doNotAccelerate(motion);
  motion.omega.setZero();
  motion.p_dot.setZero();
}

void withoutGravity(ManipulatorParameters& machine) { machine.gravity.setZero(); }
void withoutFriction(ManipulatorParameters& machine) {
  for (Leg& leg : machine.legs) {
    leg.friction = {};
    leg.coulomb.phi = leg.coulomb.psi = leg.coulomb.theta = leg.coulomb.d = 0;
  }
}

Without by(const Subject& subject) {
  return [subject](const Motion<double>& motion, const Vector6d& /*right*/) { return subject.torques(motion); };
}

/// Without τ(from) − τ(to) of two changed motions.
Without withoutChange(const Scenario& scenario, MotionChange from, MotionChange to) {
  return
      [noc = nocSubject(*scenario.manipulator, scenario.load), from, to](Motion<double> motion, const Vector6d& right) {
        Motion<double> other = motion;
        from(motion);
        to(other);
        return Vector6d(right - (noc.torques(motion) - noc.torques(other)));
      };
}

/// Whether the paper's formulas, with their numbers, are those of a leg.
bool hasPaperLegs(const Manipulator& machine) {
  for (int i = 0; i < machine.legCount(); ++i)
    if (machine.leg(i).kind == LegKind::URS) return true;
  return false;
}

}  // namespace

std::vector<TorqueTerm> torqueTerms(const Scenario& scenario, const std::vector<Motion<double>>& motions,
                                    const std::vector<Vector6d>& exact) {
  std::vector<TorqueTerm> out;
  const auto add = [&](TorqueTerm term, const std::function<Without()>& solver) {
    try {
      const Without without = solver();
      const double sign = term.fixed ? -1 : 1;  // what a printed formula adds
      for (std::size_t k = 0; k < exact.size(); ++k)
        term.torques.emplace_back(sign * (exact[k] - without(motions[k], exact[k])));
      out.push_back(std::move(term));
    } catch (const PoseError&) {
    } catch (const std::invalid_argument&) {
    }
  };
  const auto machine = [&scenario](void (*change)(ManipulatorParameters&)) {
    return [&scenario, change] {
      ManipulatorParameters changed = scenario.manipulator->parameters();
      change(changed);
      return by(nocSubject(Manipulator(changed), scenario.load));
    };
  };
  const auto motion = [&scenario](MotionChange from, MotionChange to) {
    return [&scenario, from, to] { return withoutChange(scenario, from, to); };
  };
  const auto formula = [&scenario](const WrongFormula& wrong) {
    return [&] {
      return by(wrongNocSubject(*scenario.manipulator, scenario.load, WithFormulaErrors(wrong.formula_error)));
    };
  };
  add({"gravity", "gravity", "all", {}, scenario.manipulator->gravity().norm()}, machine(withoutGravity));
  add({"everything that moves (all but statics)"}, motion(keep, rest));
  add({"the torques of acceleration (inertia)", "inertia", "all"}, motion(keep, doNotAccelerate));
  add({"the torques of velocity (Coriolis, centrifugal, gyroscopic, friction)"}, motion(doNotAccelerate, rest));
  add({"friction", "friction", "all"}, machine(withoutFriction));
  if (scenario.load)
    add({"the load", "load", "platform"}, [&] { return by(nocSubject(*scenario.manipulator, nullptr)); });
  for (const WrongFormula& part : parts) add({part.name, part.term, part.body}, formula(part));
  if (hasPaperLegs(*scenario.manipulator))
    for (const WrongFormula& wrong : printed) add({wrong.name, "", "", 1.0}, formula(wrong));
  return out;
}

}  // namespace ursula
