// The verdict of mechanisms: right efforts pass, wrong ones fail with the motor named.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "model/instants.h"
#include "tests/base/temporary_folder.h"
#include "tests/loops/loop_scenario.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/outside/given_motion.h"
#include "validation/outside/outside_simulator.h"

namespace ursula {
namespace {

/// The NOC's efforts of a machine along the scenario's motion, as a file would have them.
GivenEfforts effortsOf(const MechanismScenario& scenario) {
  const MechanismAlong along(scenario);
  GivenEfforts out;
  out.name = "mine.csv";
  LoopWork work;
  for (const double t : equallySpaced(scenario.trajectory->duration(), 101)) {
    out.t.push_back(t);
    out.efforts.push_back(along.motion().inverseDynamics(t, work));
    out.precision.emplace_back(MotorEfforts::Zero(out.efforts.back().size()));
  }
  return out;
}

ValidationResult judged(const MechanismScenario& scenario, GivenEfforts efforts) {
  MechanismSubject subject;
  subject.about = {efforts.name, Formulation::external, CalledBy::torques};
  subject.given = std::make_shared<const GivenEfforts>(std::move(efforts));
  return validateMechanism(scenario, subject);
}

MechanismScenario shortened(MechanismScenario scenario) {
  scenario.simulation.samples = 31;
  return scenario;
}

/// Three revolutions there and back in two seconds: a replay in few steps grows beyond all numbers.
TEST(FastMotions, haveAVerdict) {
  for (const double turns : {3.2, 6.5}) {
    MechanismScenario scenario = shortened(loopScenario("../../../scenarios/mechanisms/fourbar"));
    scenario.trajectory = makeFourier(2, 2, {{0.1, {turns}, {0.1}}});
    const ValidationResult result = validateMechanism(scenario);
    EXPECT_NE(result.verdict, Verdict::fail) << turns;
    const Check* check = findCheck(result.checks, "torque.pointwise");
    ASSERT_NE(check, nullptr);
    EXPECT_EQ(check->verdict, Verdict::pass);
    GivenEfforts wrong = effortsOf(scenario);
    for (MotorEfforts& efforts : wrong.efforts) efforts *= 1.001;
    EXPECT_EQ(judged(scenario, std::move(wrong)).verdict, Verdict::fail);
  }
}

class MechanismVerdict : public testing::TestWithParam<const char*> {};

TEST_P(MechanismVerdict, ofTheNocIsPass) {
  const ValidationResult result = validateMechanism(shortened(loopScenario(GetParam())));
  std::string failed;
  for (const Check& check : result.checks)
    if (check.verdict != Verdict::pass && check.verdict != Verdict::not_applicable) failed += check.name + " ";
  EXPECT_EQ(result.verdict, Verdict::pass) << failed;
  for (const char* name : {"torque.pointwise", "torque.twin", "torque.between", "acceleration.pointwise",
                           "direct.pointwise", "complement.orthogonality", "complement.rank", "kinematics.positions",
                           "invariance.rotation", "invariance.labels", "invariance.units", "energy.power"}) {
    const Check* check = findCheck(result.checks, name);
    ASSERT_NE(check, nullptr) << name;
    EXPECT_EQ(check->verdict, Verdict::pass) << name;
    EXPECT_TRUE(std::isfinite(check->value)) << name;
  }
  EXPECT_EQ(result.kind, "mechanism");
  ASSERT_TRUE(result.deviation);
  EXPECT_GT(result.deviation->largest_effort, 0);
}

TEST_P(MechanismVerdict, ofRightEffortsIsPassAndOfAMillionthOffInOneMotorIsFail) {
  const MechanismScenario scenario = loopScenario(GetParam());
  const GivenEfforts right = effortsOf(scenario);
  EXPECT_EQ(judged(scenario, right).verdict, Verdict::pass);
  GivenEfforts wrong = right;
  for (MotorEfforts& each : wrong.efforts) each(0) *= 1 + 3e-6;
  const ValidationResult result = judged(scenario, wrong);
  EXPECT_EQ(result.verdict, Verdict::fail);
  ASSERT_TRUE(result.deviation);
  EXPECT_EQ(result.deviation->where, scenario.mechanism->motor(0).name);
  EXPECT_EQ(findCheck(result.checks, "torque.against_noc")->verdict, Verdict::fail);
  EXPECT_EQ(findCheck(result.checks, "torque.pointwise")->verdict, Verdict::fail);
}

/// Each motor of these machines works along the motion.
TEST_P(MechanismVerdict, ofThePowerSeesAMillionthInEachMotor) {
  const MechanismScenario scenario = loopScenario(GetParam());
  const GivenEfforts right = effortsOf(scenario);
  const Check passed = *findCheck(judged(scenario, right).checks, "energy.power");
  EXPECT_EQ(passed.verdict, Verdict::pass) << passed.why;
  EXPECT_GT(passed.limit, 0);
  for (Eigen::Index k = 0; k < right.efforts.front().size(); ++k) {
    GivenEfforts wrong = right;
    for (MotorEfforts& each : wrong.efforts) each(k) *= 1 + 1e-6;
    const Check failed = *findCheck(judged(scenario, wrong).checks, "energy.power");
    EXPECT_EQ(failed.verdict, Verdict::fail) << k << ": " << failed.value << " of " << failed.limit;
  }
}

TEST(MechanismPower, ofAMachineAtRestDoesNotApply) {
  MechanismScenario scenario = loopScenario("fourbar");
  scenario.trajectory = makeMotorHold(1, scenario.trajectory->at(0).q);
  const ValidationResult result = validateMechanism(shortened(scenario));
  EXPECT_EQ(findCheck(result.checks, "energy.power")->verdict, Verdict::not_applicable);
  EXPECT_EQ(result.verdict, Verdict::pass);
}

TEST_P(MechanismVerdict, ofAMassOffByATenThousandthIsFail) {
  const MechanismScenario scenario = loopScenario(GetParam());
  const MechanismScenario other = changedScenario(scenario, [](MechanismParameters& machine) {
    for (MechanismBody& body : machine.bodies) body.mass *= 1.0001;
  });
  EXPECT_EQ(judged(scenario, effortsOf(other)).verdict, Verdict::fail);
}

INSTANTIATE_TEST_SUITE_P(Machines, MechanismVerdict,
                         testing::Values("fourbar", "planar3rrr", "ankle", "delta", "delta_balls", "boom_rub",
                                         "fourbar_rub"),
                         [](const auto& machine) { return std::string(machine.param); });

/// Direct dynamics of a machine along the scenario's motion, under efforts changed by `change`.
MechanismSimulator simulatorOf(const MechanismAlong& along, long& asked,
                               const std::function<void(MotorEfforts&)>& change = nullptr) {
  MechanismSimulator out;
  out.about = {"mine", Formulation::external, CalledBy::program};
  out.accelerations = [&along, &asked, change](const auto& states, const auto& efforts) {
    std::vector<Eigen::VectorXd> found;
    LoopWork work;
    for (std::size_t k = 0; k < states.size(); ++k) {
      MotorEfforts used = efforts[k];
      if (change) change(used);
      const MotorMotion& motion = states[k].motion;
      EXPECT_EQ(motion.qddot.norm(), 0) << "the answer is given away";
      found.push_back(along.solver().directDynamics(motion, used, along.motion().near(motion.t), work));
    }
    asked += static_cast<long>(states.size());
    return found;
  };
  return out;
}

TEST_P(MechanismVerdict, ofARightSimulatorIsPassAndOfAWrongOneFail) {
  const MechanismScenario scenario = loopScenario(GetParam());
  const MechanismAlong right(scenario);
  long asked = 0;
  const ValidationResult passed = validateSimulator(scenario, simulatorOf(right, asked));
  std::string failed;
  for (const Check& check : passed.checks)
    if (check.verdict == Verdict::fail || check.verdict == Verdict::inconclusive)
      failed += check.name + ": " + check.why;
  EXPECT_EQ(passed.verdict, Verdict::pass) << failed;
  EXPECT_LE(asked, 2000);
  const MechanismScenario heavier = changedScenario(scenario, [](MechanismParameters& machine) {
    for (MechanismBody& body : machine.bodies) body.mass *= 1.0001;
  });
  const MechanismAlong other(heavier);
  asked = 0;
  EXPECT_EQ(validateSimulator(scenario, simulatorOf(other, asked)).verdict, Verdict::fail);
  EXPECT_LE(asked, 2000);
  const auto stronger = [](MotorEfforts& efforts) { efforts(0) *= 1 + 1e-5; };
  EXPECT_EQ(validateSimulator(scenario, simulatorOf(right, asked, stronger)).verdict, Verdict::fail);
}

/// The file of a motion, as another program has it.
std::filesystem::path motionFile(const TemporaryFolder& folder, const MechanismScenario& scenario) {
  std::vector<std::string> names = {"t_s"};
  std::vector<std::vector<double>> columns(1 + scenario.mechanism->motorCount());
  for (std::size_t k = 0; k < scenario.mechanism->motorCount(); ++k)
    names.push_back(motorColumn(*scenario.mechanism, k, "q"));
  for (const double t : equallySpaced(scenario.trajectory->duration(), 401)) {
    columns[0].push_back(t);
    const MotorMotion motion = scenario.trajectory->at(t);
    for (std::size_t k = 0; k + 1 < columns.size(); ++k)
      columns[k + 1].push_back(motion.q(static_cast<Eigen::Index>(k)));
  }
  return folder.write("motion.csv", csvText(names, columns));
}

TEST(MechanismMotion, ofAFileIsJudgedByItsEfforts) {
  const TemporaryFolder folder;
  MechanismScenario scenario = loopScenario("ankle");
  scenario.tolerance = EffortTolerance{1e-4, 0};
  const auto file = motionFile(folder, scenario);
  const ValidationResult right = validateMotion(scenario, file, nullptr);
  EXPECT_EQ(right.verdict, Verdict::pass);
  GivenEfforts given = effortsOf(scenario);
  EXPECT_EQ(validateMotion(scenario, file, &given).verdict, Verdict::pass);
  for (MotorEfforts& each : given.efforts) each(0) *= 1.01;
  EXPECT_EQ(validateMotion(scenario, file, &given).verdict, Verdict::fail);
  const MechanismScenario heavier = changedScenario(scenario, [](MechanismParameters& machine) {
    for (MechanismBody& body : machine.bodies) body.mass *= 1.01;
  });
  const GivenEfforts of_lighter = effortsOf(scenario);
  EXPECT_EQ(validateMotion(heavier, file, &of_lighter).verdict, Verdict::fail);
}

TEST(MechanismTolerance, ofTheUserDecides) {
  MechanismScenario scenario = loopScenario("fourbar");
  GivenEfforts wrong = effortsOf(scenario);
  for (MotorEfforts& each : wrong.efforts) each *= 1.001;
  EXPECT_EQ(judged(scenario, wrong).verdict, Verdict::fail);
  scenario.tolerance = EffortTolerance{0.01, 0};
  const ValidationResult result = judged(scenario, wrong);
  EXPECT_EQ(result.verdict, Verdict::pass);
  EXPECT_EQ(result.limits, LimitBy::user);
  scenario.tolerance = EffortTolerance{2, 0};
  EXPECT_THROW(judged(scenario, wrong), ScenarioError) << "zeros would pass";
}

TEST(MechanismDigits, countAsPrinted) {
  const MechanismScenario scenario = loopScenario("fourbar");
  GivenEfforts rounded = effortsOf(scenario);
  for (std::size_t i = 0; i < rounded.t.size(); ++i) {
    rounded.efforts[i] = (rounded.efforts[i] * 1e4).array().round() / 1e4;
    rounded.precision[i].setConstant(0.5e-4);
  }
  EXPECT_NE(judged(scenario, rounded).verdict, Verdict::fail);
  rounded.efforts[50](0) += 2e-3;
  EXPECT_EQ(judged(scenario, rounded).verdict, Verdict::fail);
}

/// Keeps the rows from `first` to `last`, each `step`-th.
GivenEfforts rowsOf(const GivenEfforts& all, std::size_t first, std::size_t last, std::size_t step = 1) {
  GivenEfforts out = all;
  out.t.clear(), out.efforts.clear(), out.precision.clear();
  for (std::size_t i = first; i <= last; i += step) {
    out.t.push_back(all.t[i]);
    out.efforts.push_back(all.efforts[i]);
    out.precision.push_back(all.precision[i]);
  }
  return out;
}

/// Right rows say nothing of what lies beyond or far between them.
TEST(MechanismCover, ofAPartOfTheMotionIsInconclusive) {
  MechanismScenario scenario = loopScenario("fourbar");
  const GivenEfforts all = effortsOf(scenario);
  const double largest = judged(scenario, all).deviation->largest_effort;
  GivenEfforts holed = rowsOf(all, 0, 6);
  const GivenEfforts end = rowsOf(all, 94, 100);
  holed.t.insert(holed.t.end(), end.t.begin(), end.t.end());
  holed.efforts.insert(holed.efforts.end(), end.efforts.begin(), end.efforts.end());
  holed.precision.insert(holed.precision.end(), end.precision.begin(), end.precision.end());
  for (const double relative : {0.0, 0.01}) {
    if (relative > 0) scenario.tolerance = EffortTolerance{relative, 0};
    for (const GivenEfforts& part : {rowsOf(all, 30, 30), rowsOf(all, 0, 100, 100), rowsOf(all, 0, 50), holed}) {
      const ValidationResult result = judged(scenario, part);
      EXPECT_EQ(result.verdict, Verdict::inconclusive) << part.t.size();
      const Check* between = findCheck(result.checks, "torque.between");
      ASSERT_NE(between, nullptr);
      EXPECT_EQ(between->reason, Reason::not_covered);
      EXPECT_NEAR(result.deviation->largest_effort, largest, 0.01 * largest) << "of the whole motion";
    }
    EXPECT_EQ(judged(scenario, rowsOf(all, 0, 99)).verdict, Verdict::pass) << "the last row is one step early";
    EXPECT_EQ(judged(scenario, rowsOf(all, 0, 100, 5)).verdict, Verdict::pass) << "21 rows";
  }
}

/// Friction of passive joints is in the model and not in the efforts: the scenario can leave it out.
TEST(MechanismSize, namesWhatTheScenarioCanLeaveOut) {
  const MechanismScenario scenario = loopScenario("fourbar");
  const MechanismScenario rubbing = changedScenario(scenario, [](MechanismParameters& machine) {
    for (MechanismJoint& joint : machine.joints)
      if (!joint.closure) joint.damping = 0.05;
  });
  const auto without = [&](bool motors) {
    return changedScenario(rubbing, [motors](MechanismParameters& machine) {
      for (MechanismJoint& joint : machine.joints)
        if (joint.driven == motors) joint.damping = 0;
    });
  };
  const ValidationResult passive = judged(rubbing, effortsOf(without(false)));
  ASSERT_TRUE(passive.size);
  EXPECT_EQ(passive.size->grade, FailureGrade::modelling);
  ASSERT_EQ(passive.size->remedy.size(), 1U);
  EXPECT_EQ(passive.size->remedy.front().key, "mechanism.leave_out");
  EXPECT_EQ(passive.size->remedy.front().value, "passive-friction");
  const ValidationResult remedied = judged(without(false), effortsOf(without(false)));  // its model is not the file's
  for (const char* check : {"torque.against_noc", "torque.pointwise", "torque.twin"})
    EXPECT_EQ(findCheck(remedied.checks, check)->verdict, Verdict::pass) << check;
  const ValidationResult motors = judged(rubbing, effortsOf(without(true)));
  ASSERT_TRUE(motors.size);
  ASSERT_EQ(motors.size->remedy.size(), 1U);
  EXPECT_EQ(motors.size->remedy.front().key,
            "mechanism.numbers.joint." + scenario.mechanism->motor(0).name + ".damping");
  const ValidationResult heavier = judged(rubbing, effortsOf(changedScenario(rubbing, [](MechanismParameters& machine) {
                                            for (MechanismBody& body : machine.bodies) body.mass *= 1.1;
                                          })));
  ASSERT_TRUE(heavier.size);
  EXPECT_TRUE(heavier.size->remedy.empty());
}

TEST(MechanismClosures, joinTwoBodiesOfWhichOneMoves) {
  const MechanismScenario scenario = loopScenario("fourbar");
  const std::string link = scenario.mechanism->bodies()[scenario.mechanism->output()].name;
  const auto refusal = [&](const std::string& close) -> std::string {
    MechanismChoices choices;
    choices.close = {close};
    try {
      partModelReader()(scenario.model, choices);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal(link + ":" + link), testing::HasSubstr("it joins " + link + " to itself"));
  EXPECT_THAT(refusal("world:world"), testing::HasSubstr("to itself"));
}

}  // namespace
}  // namespace ursula
