// Engines side by side on machines with any closed loops: the exact recipes are right, the usual calls are not, and
// what the page shows is what ran.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "parts/engines/side_by_side/side_by_side.h"
#include "tests/support/matchers.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

MechanismScenario shippedMechanism(const std::string& name) {
  return readMechanism(URSULA_SCENARIOS "/mechanisms/" + name + ".toml");
}

SideBySide foundOf(const MechanismScenario& scenario) {
  SideBySideOptions options;
  options.samples = 9;
  return engineSideBySide(scenario, options);
}

/// The scenario with its mechanism changed.
template <class Change>
MechanismScenario changed(MechanismScenario scenario, const Change& change) {
  MechanismParameters machine = scenario.mechanism->parameters();
  change(machine);
  scenario.mechanism = std::make_shared<Mechanism>(machine);
  return scenario;
}

const EngineResult* engineOf(const SideBySide& found, const std::string& name) {
  for (const EngineResult& engine : found.engines)
    if (engine.kind->name == name) return &engine;
  return nullptr;
}

TEST(EnginesOfMechanisms, exactRecipeIsRightAndTheObviousCallIsWrong) {
  for (const char* name : {"fourbar", "fivebar", "delta"}) {
    const SideBySide found = foundOf(shippedMechanism(name));
    ASSERT_GE(found.engines.size(), 2u);
    EXPECT_EQ(found.motors.size(), static_cast<std::size_t>(found.efforts.cols()));
    for (const EngineResult& engine : found.engines) {
      SCOPED_TRACE(std::string(name) + ", " + engine.kind->name);
      ASSERT_EQ(engine.refused, "");
      EXPECT_LE(engine.of(Recipe::exact).error, 1e-13);
      EXPECT_LE(engine.of(Recipe::exact).power, 1e-13);
      EXPECT_LE(engine.gap, 1e-14);
      EXPECT_GT(engine.of(Recipe::no_bias).error, 1e-4);
      if (!engine.kind->in_tree) continue;
      EXPECT_GT(engine.of(Recipe::open).error, 0.1);
      EXPECT_GT(engine.of(Recipe::least_squares).error, 0.1);
      if (!engine.kind->has_own_inverse) continue;
      EXPECT_GT(engine.of(Recipe::own_inverse).error, 0.1);
      EXPECT_GT(engine.of(Recipe::own_inverse_hard).error, 10 * engine.of(Recipe::own_inverse).error)
          << "harder loops take J̇ u for an error";
    }
  }
}

/// A control: engines of a machine with another mass differ from the NOC of this one.
TEST(EnginesOfMechanisms, seeWhereAMachineIsAnother) {
  const MechanismScenario scenario = shippedMechanism("delta"),
                          other = changed(scenario,
                                          [](MechanismParameters&machine) { machine.bodies.back().mass *= 1 + 1e-6; });
  const SideBySide right = foundOf(scenario), wrong = foundOf(other);
  for (std::size_t k = 0; k < right.engines.size(); ++k) {
    const Eigen::MatrixXd off = wrong.engines[k].of(Recipe::exact).efforts - right.efforts;
    EXPECT_GT(off.cwiseAbs().maxCoeff(), 1e-9 * right.largest_effort) << right.engines[k].kind->name;
    EXPECT_LE((right.engines[k].of(Recipe::exact).efforts - right.efforts).cwiseAbs().maxCoeff(),
              1e-13 * right.largest_effort);
  }
}

/// At rest soft closures exert no force if they are in their places, so mj_inverse answers as for an open tree.
TEST(EnginesOfMechanisms, atRestSoftLoopsAreAsOpenOnes) {
  const std::string welded = URSULA_SOURCE "/tests/vectors/loops/fourbar_relpose.toml";
  for (const MechanismScenario& moving :
       {shippedMechanism("fivebar"), shippedMechanism("delta"), readMechanism(welded)})
    for (const bool is_at_rest : {true, false}) {
      SCOPED_TRACE(moving.name);
      MechanismScenario scenario = moving;
      if (is_at_rest) scenario.trajectory = makeMotorHold(1, moving.trajectory->at(0.7).q);
      const SideBySide found = foundOf(scenario);
      const EngineResult* engine = engineOf(found, "MuJoCo");
      if (engine == nullptr) GTEST_SKIP() << "without MuJoCo";
      ASSERT_EQ(engine->of(Recipe::own_inverse).refused, "");
      const double off = (engine->of(Recipe::own_inverse).efforts - engine->of(Recipe::open).efforts).norm();
      EXPECT_EQ(off < 1e-9 * found.largest_effort, is_at_rest) << off;
      EXPECT_EQ(engine->of(Recipe::no_bias).error < 1e-13, is_at_rest);
    }
}

/// Loads of all kinds, redundant closures, sliding motors.
TEST(EnginesOfMechanisms, knowLoadsAndRedundantClosures) {
  const MechanismScenario loaded = changed(shippedMechanism("fourbar"), [](MechanismParameters& machine) {
    for (MechanismJoint& joint : machine.joints) {
      if (joint.closure) {
        joint.kind = JointKind::revolute;
        joint.axis[0] = machine.joints[0].axis[0];
      } else {
        joint.friction = 0.1;
        joint.stiffness = 0.5;
        joint.rotor_inertia = 0.01;
      }
    }
  });
  const SideBySide found = foundOf(loaded);
  EXPECT_GT((found.efforts - foundOf(shippedMechanism("fourbar")).efforts).norm(), 0.1) << "loads weigh in";
  for (const EngineResult& engine : found.engines) {
    ASSERT_EQ(engine.refused, "") << engine.kind->name;
    EXPECT_LE(engine.of(Recipe::exact).error, 1e-13) << engine.kind->name;
    if (engine.kind->has_own_inverse) {
      EXPECT_EQ(engine.of(Recipe::own_inverse).refused, "") << "two points of the hinge are pinned";
    }
  }
}

/// Without loops the usual call is right, but for maximal coordinates, in which every joint is a constraint.
TEST(EnginesOfMechanisms, withoutLoopsTheObviousCallIsRight) {
  MechanismScenario scenario = changed(shippedMechanism("fourbar"), [](MechanismParameters& machine) {
    machine.motors.clear();
    std::vector<MechanismJoint> kept;
    for (const MechanismJoint& joint : machine.joints)
      if (!joint.closure) kept.push_back(joint);
    machine.joints = kept;
    for (const MechanismJoint& joint : kept) machine.motors.push_back(joint.name);
  });
  scenario.trajectory = makeFourier(1, 1, std::vector<FourierSeries>(3, {0.1, {0.3}, {}}));
  for (const EngineResult& engine : foundOf(scenario).engines) {
    ASSERT_EQ(engine.refused, "") << engine.kind->name;
    EXPECT_EQ(engine.of(engine.kind->obvious).error < 1e-13, engine.kind->in_tree) << engine.kind->name;
    EXPECT_LE(engine.of(Recipe::exact).error, 1e-13);
    EXPECT_THAT(sentence(engine), HasSubstr(engine.kind->loop_call));
    EXPECT_EQ(sentence(engine).find("is as good") != std::string::npos, engine.kind->in_tree);
  }
}

MechanismScenario fourbarCutByAUniversalJoint() {
  return changed(shippedMechanism("fourbar"), [](MechanismParameters& machine) {
    for (MechanismJoint& joint : machine.joints)
      if (joint.closure) {
        joint.kind = JointKind::universal;
        joint.axis = {machine.joints[0].axis[0], Vector3d(machine.joints[0].axis[0].unitOrthogonal())};
      }
  });
}

/// MuJoCo has no constraint for a universal joint: only that recipe is without an answer.
TEST(EnginesOfMechanisms, aRecipeWithoutAnswerSaysWhy) {
  const SideBySide found = foundOf(fourbarCutByAUniversalJoint());
  const EngineResult* engine = engineOf(found, "MuJoCo");
  if (engine == nullptr) GTEST_SKIP() << "without MuJoCo";
  EXPECT_LE(engine->of(Recipe::exact).error, 1e-13);
  const std::string why = "its equality constraints do not hold the cut joint pin";
  EXPECT_EQ(engine->of(Recipe::own_inverse).refused, why);
  EXPECT_THAT(sentence(*engine), HasSubstr("no answer by mj_inverse"));
  EXPECT_THAT(sideBySideHtml(found), HasSubstr(why));
  EXPECT_THAT(sideBySideJson(found), HasSubstr(why));
  EXPECT_THAT(effortsCsv(found), Not(HasSubstr("mujoco_own_inverse")));
  EXPECT_THAT(effortsCsv(foundOf(shippedMechanism("fourbar"))), HasSubstr("mujoco_own_inverse"));
}

/// The default softness opens the loops by tenths of a millimetre, the hardest by a hundredth of that.
TEST(EnginesOfMechanisms, softLoopsAreMovedInTime) {
  for (const char* name : {"fourbar", "fivebar", "delta"}) {
    SCOPED_TRACE(name);
    const MechanismScenario scenario = shippedMechanism(name);
    const SideBySide found = foundOf(scenario);
    const EngineResult* engine = engineOf(found, "MuJoCo");
    if (engine == nullptr) GTEST_SKIP() << "without MuJoCo";
    ASSERT_EQ(engine->in_time.size(), 2u);
    const TimeSteppingResult &soft = engine->in_time[0], &hard = engine->in_time[1];
    for (const TimeSteppingResult* each : {&soft, &hard}) {
      EXPECT_EQ(each->gave_up, "");
      EXPECT_EQ(each->steps, 250);
      EXPECT_GT(each->work, 0);
      EXPECT_LT(std::abs(each->energy), 0.02 * each->work) << "weight, springs, friction and rotors are all counted";
      EXPECT_LT(each->away, 0.01 * scenario.mechanism->length());
    }
    EXPECT_GT(soft.gap, 50 * hard.gap);
    EXPECT_GT(soft.sag, 50 * hard.sag);
    EXPECT_GT(hard.gap, 1e-9) << "and never rigid";
    EXPECT_THAT(sideBySideHtml(found), HasSubstr("sag of the output body"));
  }
}

/// A control: with efforts that are too small by a tenth the motors fall behind.
TEST(EnginesOfMechanisms, movedMotorsFollowTheEfforts) {
  if (!loopEngineNamed("MuJoCo")->available()) GTEST_SKIP() << "without MuJoCo";
  const MechanismScenario scenario = shippedMechanism("delta");
  const MechanismAlong along(scenario);
  LoopWork work;
  std::vector<double> off;
  for (const double factor : {1.0, 0.9}) {
    ClosedMechanism engine(*scenario.mechanism, buildMujoco);
    const Rigidity hard = engine.rigidities().at(1);
    engine.start(hard, scenario.trajectory->at(0));
    for (int k = 0; k < 50; ++k) engine.step(factor * along.motion().inverseDynamics(k * hard.step, work));
    off.push_back((engine.moved().q - scenario.trajectory->at(50 * hard.step).q).norm());
  }
  EXPECT_LT(off[0], 1e-3);
  EXPECT_GT(off[1], 20 * off[0]);
}

/// Efforts are right all the same.
TEST(EnginesOfMechanisms, whatCannotBeMovedSaysWhy) {
  const SideBySide found = foundOf(fourbarCutByAUniversalJoint());
  const EngineResult* engine = engineOf(found, "MuJoCo");
  if (engine == nullptr) GTEST_SKIP() << "without MuJoCo";
  for (const TimeSteppingResult& each : engine->in_time) {
    EXPECT_EQ(each.steps, 0);
    EXPECT_THAT(each.gave_up, HasSubstr("cut joint pin"));
  }
}

TEST(EnginesOfMechanisms, motorsAndCutsHaveTheFilesNames) {
  const SideBySide found = foundOf(shippedMechanism("delta"));
  const auto json = nlohmann::json::parse(sideBySideJson(found));
  EXPECT_EQ(json.at("motors").at(1).at("name"), "left");
  EXPECT_EQ(json.at("motors").at(1).at("unit"), "Nm");
  EXPECT_EQ(json.at("model"), "delta.xml");
  for (const char* cut : {"front_ball_a", "right_ball_b"})
    EXPECT_THAT(engineOf(found, "Simbody")->cut, testing::Contains(cut));
  for (const EngineResult& engine : found.engines)
    for (const RecipeResult& each : engine.recipes) {
      const auto m = static_cast<std::size_t>(each.motor);
      EXPECT_THAT(worstText(each, found), HasSubstr(found.motors[m].name));
      const auto at = std::find(found.t.begin(), found.t.end(), each.at) - found.t.begin();
      EXPECT_EQ(std::abs(each.efforts(at, each.motor) - found.efforts(at, each.motor)), each.deviation);
      EXPECT_EQ(each.deviation / found.largest_effort, each.error);
    }
}

TEST(EnginesOfMechanisms, effortsAreWritten) {
  const SideBySide found = foundOf(shippedMechanism("fivebar"));
  const std::string csv = effortsCsv(found);
  EXPECT_THAT(csv, testing::StartsWith("t_s,tau_1_Nm,tau_2_Nm,simbody_exact_tau_1_Nm,simbody_exact_tau_2_Nm,"));
  EXPECT_THAT(csv, HasSubstr(",maximal_coordinates_no_bias_tau_2_Nm"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + found.instants);
  EXPECT_THAT(csv, HasSubstr(fmt::format("\n{},{},{},", found.t[3], found.efforts(3, 0), found.efforts(3, 1))));
}

/// The page's code is cut from the sources at build time; it must have the calls that the sentences name.
TEST(EnginesOfMechanisms, pageShowsTheCallsThatRan) {
  const SideBySide found = foundOf(shippedMechanism("fivebar"));
  const std::string page = sideBySideHtml(found);
  const auto sourceOf = [](const char* file) {
    std::ifstream in(std::string(URSULA_SOURCE) + "/" + file);
    return std::string((std::istreambuf_iterator<char>(in)), {});
  };
  const std::vector<std::vector<const char*>> rows = {
      {"Simbody", "simbody/simbody_mechanism_dynamics.cpp", "matter.calcResidualForceIgnoringConstraints("},
      {"maximal coordinates", "parts/engines/maximal/maximal_mechanism.cpp", "cross(I * at.w)"},
      {"MuJoCo", "parts/engines/mujoco/mujoco_tree.cpp", "mj_rne(model_.get(), data_.get(), 1, out.data());"},
      {"DART", "parts/engines/dart/dart_tree.cpp", "computeInverseDynamics();"}};
  for (const auto& row : rows) {
    const LoopEngineKind* kind = loopEngineNamed(row[0]);
    ASSERT_NE(kind, nullptr);
    EXPECT_THAT(std::string(kind->code), HasSubstr(row[2]));
    EXPECT_THAT(sourceOf(row[1]), HasSubstr(std::string(kind->code))) << "as it is compiled";
    EXPECT_EQ(page.find(row[2]) != std::string::npos, kind->available()) << row[0];
  }
  EXPECT_THAT(std::string(loopEngineNamed("MuJoCo")->own_code), HasSubstr("mj_inverse("));
  EXPECT_THAT(page, HasSubstr("fivebar.xml"));
  EXPECT_THAT(page, Not(HasSubstr("https://")));
}

}  // namespace
}  // namespace ursula
