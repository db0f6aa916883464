// Compares the audit's printed formulas with the solver's errors, which are two independent readings of the same print.
// Compares the audit's reference with the solver in every angle, rate and torque.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "model/scenario.h"
#include "nocsolver/noc/noc.h"
#include "parts/audit/effect.h"
#include "parts/audit/formula.h"

namespace ursula::audit {
namespace {

Scenario paperHelix() { return readScenario(URSULA_SCENARIOS "/paper-helix.toml"); }

/// The results of the solver with an error, in the order of the formula's values.
using SolverReading = std::function<Values(const Noc<S, WithFormulaErrors>&, const Motion<S>&, NocWorkspace<S>&)>;

template <class F>
SolverReading overJoints(F pick) {
  return [pick](const Noc<S, WithFormulaErrors>& solver, const Motion<S>& motion, NocWorkspace<S>& work) {
    solver.inverseKinematics(motion, work);
    solver.jacobians(motion, work);
    Values all;
    for (int i = 0; i < leg_count; ++i) append(all, S(pick(solver, work, i)));
    return all;
  };
}

/// Reads three components of a twist or its rate, for proximal or distal links or both.
SolverReading overLinks(bool rate, int first, bool proximal, bool distal) {
  return [=](const Noc<S, WithFormulaErrors>& solver, const Motion<S>& motion, NocWorkspace<S>& work) {
    BodyMotions<S> bodies;
    solver.inverseKinematics(motion, work);
    solver.bodyMotions(motion, work, bodies);
    Values all;
    for (std::size_t i = 0; i < leg_count; ++i)
      for (const bool far : {false, true}) {
        if (!(far ? distal : proximal)) continue;
        const BodyMotion<S>& body = bodies[far ? leg_count + i : i];
        append(all, V((rate ? body.twist_rate : body.twist).segment<3>(first)));
      }
    return all;
  };
}

std::vector<std::pair<std::string, SolverReading>> readings() {
  const auto rates = [](int which) {
    return overJoints([which](const auto&, const NocWorkspace<S>& work, int i) {
      return work.legs[static_cast<std::size_t>(i)].rate(which);
    });
  };
  const auto accelerations = [](int which) {
    return overJoints([which](const auto&, const NocWorkspace<S>& work, int i) {
      return work.legs[static_cast<std::size_t>(i)].acceleration(which);
    });
  };
  return {{"(4c)", accelerations(2)},
          {"(14a)", overJoints([](const auto& solver, const auto& work, int i) { return solver.angles(work).phi(i); })},
          {"(14b)", overJoints([](const auto& solver, const auto& work, int i) { return solver.angles(work).psi(i); })},
          {"(15a)", rates(0)},
          {"(15b)", rates(1)},
          {"(16)", overLinks(false, 0, true, true)},
          {"(17a)", overLinks(true, 0, true, false)},
          {"(17b)", overLinks(true, 0, false, true)},
          {"(19a)", accelerations(0)},
          {"(19b)", accelerations(1)},
          {"(23) a", overJoints([](const auto&, const auto& work, int i) { return work.A(i); })},
          {"(26) ȧ", overJoints([](const auto&, const auto& work, int i) {
             return work.legs[static_cast<std::size_t>(i)].row[0].A_dot;
           })},
          {"(43b)", overLinks(true, 3, false, true)},
          {"(43b) Ω̇²", overLinks(true, 3, false, true)},
          {"(43b) σ + [s]", overLinks(true, 3, false, true)},
          {"(43b) twice", overLinks(true, 3, false, true)}};
}

std::vector<Formula> formulas() {
  std::vector<Formula> all;
  for (auto make : {displacementFormulas, rateFormulas, accelerationFormulas, jacobianFormulas, bodyFormulas})
    for (Formula& formula : make()) all.push_back(std::move(formula));
  return all;
}

double largestDifference(const Values& a, const Values& b) {
  if (a.size() != b.size() || a.empty()) return std::nan("");
  S worst(0);
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, S(abs(S(a[k] - b[k]))));
  return worst.convert_to<double>();
}

/// The error of second differences in 50 digits, with a margin for conditioning, as in audit_test.cpp.
constexpr double rounding = 1e-33;

TEST(AuditFormulas, asPrintedAreTheSolversFormulaErrors) {
  const Scenario scenario = paperHelix();
  const ReferenceState reference = ReferenceMechanism(*scenario.manipulator, *scenario.trajectory).at(S("1.1"));
  const std::vector<Formula> all = formulas();
  for (const auto& [name, reading] : readings()) {
    const std::string& equation = name;  // C++17 lambdas cannot capture a structured binding
    const auto found = std::find_if(all.begin(), all.end(), [&](const Formula& f) { return f.equation == equation; });
    ASSERT_NE(found, all.end()) << equation;
    WithFormulaErrors formula_errors;
    for (FormulaError formula_error : found->errors) formula_errors.set(formula_error);
    NocWorkspace<S> work;
    const Values printed = found->printed.side(reference);
    EXPECT_LE(
        largestDifference(
            reading(Noc<S, WithFormulaErrors>(*scenario.manipulator, formula_errors), reference.motion, work), printed),
        rounding)
        << equation;
    // Control: without the error the solver's result is different, and is the truth.
    const Values right = reading(Noc<S, WithFormulaErrors>(*scenario.manipulator), reference.motion, work);
    EXPECT_GT(largestDifference(right, printed), 1e-6) << equation;
    EXPECT_LE(largestDifference(right, found->truth(reference)), rounding) << equation;
  }
}

/// The torque that is no number comes first, and right ones follow.
TEST(AuditEffects, keepATorqueThatIsNoNumber) {
  const Scenario scenario = paperHelix();
  const Torques right = torquesWith(scenario, WithFormulaErrors(), false);
  const auto errorWith = [&](double off) {
    const auto torques = [&](const Motion<double>& m) {
      return Vector6d(right(m) + (m.t == 0 ? off : 0) * Vector6d::Unit(4));
    };
    return effectOf(scenario, torques, 3, 1e-4).torque_error;
  };
  EXPECT_TRUE(std::isnan(errorWith(std::nan(""))));
  EXPECT_NEAR(errorWith(2), 2, 1e-6);
}

TEST(AuditWitness, agreesWithTheSolver) {
  const Scenario scenario = paperHelix();
  const ReferenceMechanism mechanism(*scenario.manipulator, *scenario.trajectory);
  const Noc<S> solver(*scenario.manipulator);
  for (const char* instant : {"0.4", "1.7", "2.9"}) {
    const ReferenceState reference = mechanism.at(S(instant));
    NocWorkspace<S> work;
    const double off =
        (solver.inverseDynamics(reference.motion, work) - reference.torques).cwiseAbs().maxCoeff().convert_to<double>();
    EXPECT_LE(off, rounding * reference.torques.cwiseAbs().maxCoeff().convert_to<double>());
    EXPECT_GT(reference.torques.norm(), 1000);
    EXPECT_LE((solver.accelerations(work).phi - reference.phi_ddot()).norm(), rounding);
  }
}

TEST(AuditWitness, differencesAreOfEighthOrder) {
  using One = Eigen::Matrix<S, 1, 1>;
  const auto f = [](const S& x) { return One(exp(x)); };
  const auto error = [&](const char* step) {
    const auto d = differentiated(f, S(step));
    return std::max(abs(S(d.first(0) - 1)), abs(S(d.second(0) - 1)));
  };
  const double order = std::log10((error("1e-2") / error("1e-3")).convert_to<double>());
  EXPECT_NEAR(order, 8, 0.1);
}

}  // namespace
}  // namespace ursula::audit
