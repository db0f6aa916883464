// The whole validation: its verdict, names and records, and that it is reproducible.

#include "validation/validate.h"
#include "model/instants.h"
#include "validation/evidence/injected_fault.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nocsolver/errors.h"
#include "parts/fast/fast_samples.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "report/files/report.h"
#include "report/files/written_files.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/evidence/reference.h"

namespace ursula {
namespace {

const std::vector<std::string> promised = {"kinematics.joint_angles",
                                           "kinematics.joint_rates",
                                           "kinematics.joint_accelerations",
                                           "kinematics.positions",
                                           "kinematics.twists",
                                           "kinematics.accelerations",
                                           "torque.pointwise",
                                           "acceleration.pointwise",
                                           "replay.position",
                                           "replay.orientation",
                                           "closure.position",
                                           "closure.velocity",
                                           "energy.balance",
                                           "torque.twin",
                                           "torque.maximal",
                                           "torque.between",
                                           "feedback.torque"};

/// Checks of a subject that is a complete solver.
const std::vector<std::string> of_solvers = {
    "direct.pointwise",    "direct.off_path",          "invariance.rotation",
    "invariance.labels",   "invariance.mass",          "invariance.time_reversal",
    "kinematics.jacobian", "kinematics.jacobian_rate", "kinematics.jacobian_difference"};

constexpr int few_samples = 21;  ///< for speed

Scenario helix() { return scenarioOf("paper-helix", few_samples); }

/// Leaves out the sources of the error, and what is judged beside the promised checks, for speed.
const ValidationOptions without_extras{false, false, false};

/// The same on the helix, whose reference all tests share.
ValidationOptions onHelix(const std::shared_ptr<const InjectedFault>& fault = nullptr, bool whole = false) {
  ValidationOptions out{whole, whole, whole};
  out.reference = referenceOf("paper-helix", few_samples);
  out.fault = fault;
  return out;
}

class Validate : public testing::TestWithParam<std::string> {};

TEST_P(Validate, theSolverPasses) {
  const Scenario scenario = scenarioOf(GetParam(), few_samples);
  const bool whole = GetParam() == "paper-helix" || GetParam() == "random-4";  // the others for speed without extras
  const ValidationResult result = validate(scenario, solverOf(scenario), whole ? ValidationOptions{} : without_extras);
  EXPECT_EQ(others(result.checks, Verdict::pass), "");
  EXPECT_EQ(result.verdict, Verdict::pass);
  EXPECT_EQ(result.scenario, GetParam());
  for (const std::string& name : promised) EXPECT_NE(findCheck(result.checks, name), nullptr) << name;
  for (const std::string& name : of_solvers) EXPECT_NE(findCheck(result.checks, name), nullptr) << name;
  for (const char* name : {"reactions.pointwise", "integration.ladder", "integration.second"})
    EXPECT_EQ(verdictOf(result.checks, name), whole ? "pass" : "not_applicable") << name;
  EXPECT_EQ(result.limits, LimitBy::derived);
  for (const Check& check : result.checks) {
    if (check.verdict != Verdict::not_applicable) {
      EXPECT_NE(check.basis, "") << check.name;
    }
    EXPECT_NE(check.why, "") << check.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, Validate, testing::ValuesIn(vectorNames()),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

/// Simbody's own forward dynamics has no answer there, and nothing else may miss.
TEST(ValidateResult, legsWithoutMassAreJudgedInFull) {
  Scenario massless = helix();
  ManipulatorParameters parameters = massless.manipulator->parameters();
  for (Leg& leg : parameters.legs)
    for (Link* link : {&leg.proximal, &leg.distal}) *link = Link{link->length};
  massless.manipulator = std::make_shared<Manipulator>(parameters);
  const ValidationResult right = validate(massless, solverOf(massless), {});
  EXPECT_EQ(others(right.checks, Verdict::pass), "");
  EXPECT_EQ(verdictOf(right.checks, "integration.second"), "not_applicable");
  EXPECT_EQ(validate(massless, solverOf(helix()), without_extras).verdict, Verdict::fail);
}

TEST(ValidateResult, carriesSeriesAndProvenance) {
  const ValidationResult result = validate(helix(), solverOf(helix()), onHelix());
  EXPECT_EQ(result.timeseries.rows(), 21u);
  for (const char* column : {"t_s", "p_x_m", "q_w", "tau_6_Nm", "simbody_tau_1_Nm", "sim_p_z_m", "sim_q_z", "error_p_m",
                             "error_q_rad", "closure_p_m", "error_energy_J"})
    EXPECT_NE(result.timeseries.find(column), nullptr) << column;
  std::vector<std::string> keys;
  for (const auto& [key, value] : result.provenance) {
    keys.push_back(key);
    EXPECT_NE(value, "") << key;
  }
  EXPECT_THAT(keys, testing::IsSupersetOf({"scenario sha1", "commit", "compiler", "flags", "Simbody", "MuJoCo",
                                           "integrator", "tolerance", "samples"}));
}

std::shared_ptr<const InjectedFault> faultOf(const std::shared_ptr<const FastFault>& kernels) {
  InjectedFault out;
  out.witness = kernels;
  return std::make_shared<const InjectedFault>(out);
}

/// The users' kernels are judged beside the NOC, and their errors are not the NOC's.
TEST(ValidateControl, aWrongFastKernelFailsAndTheNocHolds) {
  const auto kernels = std::make_shared<FastFault>();
  kernels->answers = [](FastAnswers& answers) {
    for (Vector6d& torques : answers.torques_in_batch) torques(0) *= 1 + 1e-7;
  };
  const auto fault = faultOf(kernels);
  const ValidationResult result = validate(helix(), onHelix(fault));
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_EQ(result.subject.formulation, Formulation::noc);
  EXPECT_EQ(firstFailing(result.checks), "fast.inverse_batch");
  EXPECT_TRUE(onlyFastFails(result.checks));
  for (const char* name : {"torque.between", "torque.pointwise"})
    EXPECT_EQ(verdictOf(result.checks, name), "pass") << "of one pose at a time the kernels are right: " << name;
  ASSERT_TRUE(result.deviation);
  EXPECT_FALSE(std::isnan(result.deviation->largest));
}

/// Only the last pose of a long batch is wrong; the batch's length fills no whole number of blocks.
TEST(ValidateControl, aWrongPoseAtTheEndOfABatchFails) {
  const auto kernels = std::make_shared<FastFault>();
  kernels->answers = [](FastAnswers& answers) {
    ASSERT_GT(answers.torques_in_batch.size(), 4000U);
    answers.torques_in_batch.back()(0) *= 1 + 1e-7;
  };
  EXPECT_EQ(firstFailing(validate(helix(), onHelix(faultOf(kernels))).checks), "fast.inverse_batch");
}

/// If the kernels for single poses are wrong, the NOC is still compared with Simbody between the samples, and its
/// deviation is known.
TEST(ValidateControl, aWrongKernelOfOnePoseLeavesTheDeviationKnown) {
  const auto kernels = std::make_shared<FastFault>();
  kernels->answers = [](FastAnswers& answers) { answers.torques.front()(0) *= 1 + 1e-7; };
  const ValidationResult result = validate(helix(), onHelix(faultOf(kernels)));
  EXPECT_EQ(firstFailing(result.checks), "fast.inverse");
  EXPECT_EQ(verdictOf(result.checks, "torque.between"), "pass");
  ASSERT_TRUE(result.deviation);
  EXPECT_FALSE(std::isnan(result.deviation->largest));
}

/// An error of the NOC is not an error of the fast kernels, although both checks see it.
TEST(ValidateControl, aWrongNocFailsAndTheTorquesAreNamed) {
  for (const FormulaError formula_error : {FormulaError::scaled_efforts, FormulaError::scaled_first_effort}) {
    const SubjectOf wrong = [formula_error](const Scenario& s) {
      return wrongNocSubject(*s.manipulator, s.load, WithFormulaErrors(formula_error));
    };
    const ValidationResult result = validateMade(helix(), wrong, onHelix());
    EXPECT_EQ(result.verdict, Verdict::fail);
    EXPECT_EQ(firstFailing(result.checks), "torque.pointwise");
    EXPECT_FALSE(onlyFastFails(result.checks));
  }
}

TEST(ValidateControl, torquesThatAreNoNumbersNeverPass) {
  Subject subject = scaledTorques(solverOf(helix()), std::nan(""));
  subject.kinematics = nullptr;
  const ValidationResult result = validate(helix(), subject, onHelix(nullptr, true));
  EXPECT_EQ(result.verdict, Verdict::fail);
  for (const std::string& name : promised)
    EXPECT_EQ(verdictOf(result.checks, name), name.rfind("kinematics.", 0) == 0 ? "not_applicable" : "fail") << name;
  for (const char* name : {"direct.pointwise", "direct.off_path"})
    EXPECT_EQ(verdictOf(result.checks, name), "pass") << name << ": its direct dynamics are right";
}

/// With torques alone, only checks that need a solver are left out.
TEST(ValidateControl, torquesAloneAreJudgedByWhatNeedsNoMore) {
  const ValidationResult result = validate(helix(), torquesAlone(helix()), onHelix());
  EXPECT_EQ(result.verdict, Verdict::pass) << others(result.checks, Verdict::pass);
  for (const std::string& name : promised)
    EXPECT_EQ(verdictOf(result.checks, name), name.rfind("kinematics.", 0) == 0 ? "not_applicable" : "pass") << name;
  for (const std::string& name : of_solvers) EXPECT_EQ(verdictOf(result.checks, name), "not_applicable") << name;
}

/// The parts that depend on the scenario alone may be made before, for many subjects.
TEST(ValidateResult, isTheSameWithAReferenceMadeBefore) {
  const auto run = [](const ValidationOptions& options) {
    return report::summaryJson(validate(helix(), solverOf(helix()), options));
  };
  run(onHelix());
  EXPECT_EQ(run(onHelix()), run(without_extras)) << "the first left something behind";
}

/// Results that other threads make in advance equal those made on request.
TEST(ValidateResult, isTheSameWhateverTheNumberOfThreads) {
  const auto run = [](int threads) {
    ValidationOptions options;
    options.threads = threads;
    return report::summaryJson(validate(helix(), options));
  };
  EXPECT_EQ(run(5), run(1));
}

/// Tests the checks of replays: a state falsified after each step fails them, and no pointwise check.
TEST(ValidateControl, aFaultyReplayFails) {
  const auto fault = std::make_shared<InjectedFault>();
  fault->replay = [](ReplaySettings& settings) {
    settings.fault = [](double, std::vector<double>& x) {
      for (double& each : x) each *= 1 + 1e-9;
    };
  };
  const ValidationResult result = validate(helix(), onHelix(fault));
  EXPECT_EQ(verdictOf(result.checks, "replay.position"), "fail");
  for (const char* name : {"torque.pointwise", "torque.between", "acceleration.pointwise", "direct.off_path"})
    EXPECT_EQ(verdictOf(result.checks, name), "pass") << name;
}

/// Verdicts are the same whether the subject is made for the well-scaled or for the given scenario.
TEST(ValidateResult, doesNotDependOnHowTheSubjectIsMade) {
  const ValidationResult made = validateMade(helix(), solverOf, onHelix()), own = validate(helix(), onHelix());
  ASSERT_EQ(made.checks.size(), own.checks.size());
  for (std::size_t k = 0; k < made.checks.size(); ++k) {
    EXPECT_EQ(made.checks[k].name, own.checks[k].name);
    ASSERT_EQ(made.checks[k].verdict, own.checks[k].verdict) << made.checks[k].name;
    if (made.checks[k].verdict == Verdict::not_applicable) continue;
    EXPECT_EQ(made.checks[k].value, own.checks[k].value) << made.checks[k].name;
    EXPECT_EQ(made.checks[k].limit, own.checks[k].limit) << made.checks[k].name;
  }
}

TEST(ValidateControl, aSubjectThatRefusesFailsWithItsReason) {
  Subject subject = solverOf(helix());
  subject.torques = [](const Motion<double>& motion) -> Vector6d {
    throw SingularJacobian("B is singular, its smallest pivot over its largest", -1, motion.t, 0, 1e-15, "");
  };
  ValidationResult result = validate(helix(), subject, onHelix(nullptr, true));
  EXPECT_EQ(result.verdict, Verdict::fail);
  const auto is_shared = [](const Check& check) { return check.name.rfind("motion.", 0) == 0; };  // not the subject's
  result.checks.erase(std::remove_if(result.checks.begin(), result.checks.end(), is_shared), result.checks.end());
  EXPECT_EQ(others(result.checks, Verdict::fail), "");
  EXPECT_NE(findCheck(result.checks, "torque.pointwise")->why.find("B is singular"), std::string::npos);
}

TEST(ValidateControl, aMotionOutOfReachIsNotJudged) {
  Scenario scenario = helix();
  HelixParameters high;
  high.radius = 0.2, high.pitch = 1.2, high.end_angle = 1, high.height_phase = 20;
  scenario.trajectory = makeHelix(high);
  EXPECT_THROW(validate(scenario), PoseError);
}

TEST(EquallySpaced, hasBothEnds) {
  EXPECT_EQ(equallySpaced(3, 4), (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(equallySpaced(0.7, 301).back(), 0.7);
}

}  // namespace
}  // namespace ursula
