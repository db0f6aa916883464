#include "validation/causes/hypothesis_terms.h"

#include <functional>

#include "nocsolver/errors.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using Rows = std::vector<Vector6d>;
using MotionChange = std::function<void(Motion<double>&)>;

Rows torquesOf(const Subject& subject, const std::vector<Motion<double>>& motions) {
  Rows out;
  out.reserve(motions.size());
  for (const Motion<double>& motion : motions) out.push_back(subject.torques(motion));
  return out;
}

Rows difference(const Rows& a, const Rows& b) {
  Rows out(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) out[k] = a[k] - b[k];
  return out;
}

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

/// Collects terms; it skips those that throw or that the changed machine cannot have.
class Collector {
 public:
  Collector(const Scenario& scenario, const std::vector<Motion<double>>& motions, const Rows& exact)
      : scenario_(scenario), motions_(motions), exact_(exact) {}

  std::vector<TorqueTerm> terms() { return std::move(terms_); }

  /// Adds the effect of a change of the machine: what it removes from the torques (`sign` 1) or adds (−1).
  void addChange(const std::string& name, const std::function<void(ManipulatorParameters&)>& change, double sign) {
    ManipulatorParameters parameters = scenario_.manipulator->parameters();
    change(parameters);
    add(name, {}, sign, [&] { return torquesOf(nocSubject(Manipulator(parameters), scenario_.load), motions_); });
  }

  void addFormulaError(const WrongFormula& formula, std::optional<double> fixed, double sign) {
    add(formula.name, fixed, sign, [&] {
      return torquesOf(
          wrongNocSubject(*scenario_.manipulator, scenario_.load, WithFormulaErrors(formula.formula_error)), motions_);
    });
  }

  /// Describes the term `of` if it was the last added.
  void describe(const char* of, const char* term, const char* body, double size = 0) {
    if (terms_.empty() || terms_.back().name != of) return;
    terms_.back().term = term;
    terms_.back().body = body;
    terms_.back().size = size;
  }

  void addLoad() {
    if (scenario_.load)
      add("the load", {}, 1, [&] { return torquesOf(nocSubject(*scenario_.manipulator, nullptr), motions_); });
  }

  /// Adds τ(from) − τ(to) for changed motions.
  void addMotionChange(const std::string& name, const MotionChange& from, const MotionChange& to) {
    add(name, {}, 1, [&] { return difference(exact_, difference(changed(from), changed(to))); });
  }

 private:
  Rows changed(const MotionChange& change) const {
    std::vector<Motion<double>> motions = motions_;
    for (Motion<double>& motion : motions) change(motion);
    return torquesOf(nocSubject(*scenario_.manipulator, scenario_.load), motions);
  }

  void add(const std::string& name, std::optional<double> fixed, double sign, const std::function<Rows()>& without) {
    try {
      Rows term = difference(exact_, without());
      for (Vector6d& row : term) row *= sign;
      terms_.push_back({name, std::move(term), fixed});
    } catch (const PoseError&) {
    } catch (const std::invalid_argument&) {
    }
  }

  const Scenario& scenario_;
  const std::vector<Motion<double>>& motions_;
  const Rows& exact_;
  std::vector<TorqueTerm> terms_;
};

void withoutFriction(ManipulatorParameters& machine) {
  for (Leg& leg : machine.legs) {
    leg.friction = {};
    leg.coulomb.phi = leg.coulomb.psi = leg.coulomb.theta = leg.coulomb.d = 0;
  }
}

void addParts(Collector& out, double scenario_gravity) {
  const auto same = [](Motion<double>&) {};
  const auto unaccelerated = [](Motion<double>& motion) {
    motion.omega_dot.setZero();
    motion.p_ddot.setZero();
  };
  const auto at_rest = [unaccelerated](Motion<double>& motion) {
    unaccelerated(motion);
    motion.omega.setZero();
    motion.p_dot.setZero();
  };
  out.addChange(
      "gravity", [](ManipulatorParameters& machine) { machine.gravity.setZero(); }, 1);
  out.describe("gravity", "gravity", "all", scenario_gravity);
  out.addMotionChange("everything that moves (all but statics)", same, at_rest);
  out.addMotionChange("the torques of acceleration (inertia)", same, unaccelerated);
  out.describe("the torques of acceleration (inertia)", "inertia", "all");
  out.addMotionChange("the torques of velocity (Coriolis, centrifugal, gyroscopic, friction)", unaccelerated, at_rest);
  out.addChange("friction", withoutFriction, 1);
  out.describe("friction", "friction", "all");
  out.addLoad();
  out.describe("the load", "load", "platform");
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
  Collector out(scenario, motions, exact);
  addParts(out, scenario.manipulator->gravity().norm());
  for (const WrongFormula& part : parts) {
    out.addFormulaError(part, {}, 1);
    out.describe(part.name, part.term, part.body);
  }
  if (hasPaperLegs(*scenario.manipulator))
    for (const WrongFormula& formula : printed) out.addFormulaError(formula, 1.0, -1);
  return out.terms();
}

}  // namespace ursula
