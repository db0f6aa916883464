#include <functional>

#include "parts/causes/fits.h"
#include "parts/causes/tried_causes.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using MotionChange = void (*)(Motion<double>&);

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

/// A term, and the efforts of a solver without it.
struct TermRow {
  TorqueTerm term;
  std::function<EffortsOf(const Scenario&)> without;
};

/// Without τ(from) − τ(to) of two changed motions.
EffortsOf withoutChange(const Scenario& scenario, MotionChange from, MotionChange to) {
  return [noc = nocSubject(*scenario.manipulator, scenario.load), from, to](Motion<double> motion) {
    Motion<double> other = motion;
    const Vector6d right = noc.torques(motion);
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

std::vector<TermRow> termsOf(const Scenario& scenario) {
  std::vector<TermRow> out;
  const auto add = [&out](const TorqueTerm& term, const std::function<EffortsOf(const Scenario&)>& without) {
    out.push_back({term, without});
  };
  const auto machine = [](void (*change)(ManipulatorParameters&)) {
    return [change](const Scenario& of) {
      ManipulatorParameters changed = of.manipulator->parameters();
      change(changed);
      return nocSubject(Manipulator(changed), of.load).torques;
    };
  };
  const auto motion = [](MotionChange from, MotionChange to) {
    return [from, to](const Scenario& of) { return withoutChange(of, from, to); };
  };
  const auto formula = [](const WrongFormula& wrong) {
    return [error = wrong.formula_error](const Scenario& of) {
      return wrongNocSubject(*of.manipulator, of.load, WithFormulaErrors(error)).torques;
    };
  };
  add({"gravity", "gravity", "all", {}, scenario.manipulator->gravity().norm()}, machine(withoutGravity));
  add({"everything that moves (all but statics)"}, motion(keep, rest));
  add({"the torques of acceleration (inertia)", "inertia", "all"}, motion(keep, doNotAccelerate));
  add({"the torques of velocity (Coriolis, centrifugal, gyroscopic, friction)"}, motion(doNotAccelerate, rest));
  add({"friction", "friction", "all"}, machine(withoutFriction));
  if (scenario.load)
    add({"the load", "load", "platform"},
        [](const Scenario& of) { return nocSubject(*of.manipulator, nullptr).torques; });
  for (const WrongFormula& part : parts) add({part.name, part.term, part.body}, formula(part));
  if (hasPaperLegs(*scenario.manipulator))
    for (const WrongFormula& wrong : printed) add({wrong.name, "", "", 1.0}, formula(wrong));
  return out;
}

/// 1 + x times a term.
void addScaled(const TermRow& row, TriedCauses& out) {
  Cause cause;
  cause.solver = [without = row.without](const Scenario& of, double x) {
    return [right = nocSubject(*of.manipulator, of.load), other = without(of), x](const Motion<double>& motion) {
      const Vector6d efforts = right.torques(motion);
      return Vector6d(efforts + x * (efforts - other(motion)));
    };
  };
  cause.named = [term = row.term](double x, double) {
    return NamedCause{CauseKind::scale, term.term, term.body, "", "", 1, 1 + x};
  };
  out.push(cause);
}

}  // namespace

std::vector<TorqueTerm> torqueTerms(const Scenario& scenario, const std::vector<Motion<double>>& motions,
                                    const std::vector<Vector6d>& exact) {
  std::vector<TorqueTerm> out;
  for (TermRow& row : termsOf(scenario)) {
    const bool has_efforts = unlessRefused([&] {
                               const EffortsOf without = row.without(scenario);
                               const double sign = row.term.fixed ? -1 : 1;  // what a printed formula adds
                               for (std::size_t k = 0; k < exact.size(); ++k)
                                 row.term.torques.emplace_back(sign * (exact[k] - without(motions[k])));
                               return true;
                             }).has_value();
    if (has_efforts) out.push_back(std::move(row.term));
  }
  return out;
}

void addTerms(TriedCauses& out) {
  for (const TermRow& row : termsOf(out.scenario)) {
    if (row.term.term.empty()) continue;
    if (row.term.gravity > 0) addScaled(row, out);
    out.add({row.term.name + " left out", {CauseKind::missing_term, row.term.term, row.term.body}}, row.without);
    out.add({row.term.name + " with the wrong sign", {CauseKind::sign, row.term.term, row.term.body}},
            [without = row.without](const Scenario& of) {
              return [right = nocSubject(*of.manipulator, of.load), wrong = without(of)](const Motion<double>& motion) {
                return Vector6d(2 * wrong(motion) - right.torques(motion));
              };
            });
  }
}

}  // namespace ursula
