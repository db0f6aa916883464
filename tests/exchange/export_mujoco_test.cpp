// MuJoCo reads what was exported, has the scenario's bodies and closed loops, and answers with the scenario's efforts.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "parts/exchange/write/export.h"
#include "tests/exchange/export_mujoco_internal.h"

namespace ursula::exchange {
namespace {

using closed_chain::Machine, closed_chain::Recipe;

double errorOf(Machine& machine, const Scenario& scenario, double t, Recipe recipe = Recipe::exact) {
  const Vector6d expected = expectedEfforts(scenario, t);
  return (machine.efforts(asked(scenario.trajectory->at(t)), recipe) - expected).norm() / expected.norm();
}

TEST(ExportMujoco, HasTheBodies) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    InMujoco model(textOf(scenario, ModelFormat::mjcf));
    EXPECT_LE(deviation(model.bodies(), expectedBodies(scenario)), rounding) << name;
  }
}

TEST(ExportMujoco, LoopsAreClosedAtTheFilesPose) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    InMujoco model(textOf(scenario, ModelFormat::mjcf));
    mj_resetData(&model.model(), &model.data());
    const Eigen::VectorXd gap = model.gap();
    ASSERT_EQ(gap.size(), 3 * scenario.manipulator->legCount());
    EXPECT_LT(gap.cwiseAbs().maxCoeff(), 1e-12) << name;
  }
}

TEST(ExportMujoco, CoordinatesAreTheScenarios) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    InMujoco read(textOf(scenario, ModelFormat::mjcf));
    const mjModel& model = read.model();
    const Noc<double> noc(*scenario.manipulator);
    NocWorkspace<double> work;
    noc.inverseKinematics(scenario.trajectory->at(0), work);
    const JointVariables<double> q = noc.angles(work);
    int found = 0;
    for (int leg = 0; leg < scenario.manipulator->legCount(); ++leg)
      for (const Coordinate coordinate : rowOf(scenario.manipulator->leg(leg).kind).coordinates) {
        if (isInBall(scenario.manipulator->leg(leg), coordinate)) continue;
        const std::string joint = fmt::format("leg_{}_{}", leg + 1, nameOf(coordinate));
        const int id = mj_name2id(&model, mjOBJ_JOINT, joint.c_str());
        ASSERT_GE(id, 0) << name << ' ' << joint;
        const double apart = model.qpos0[model.jnt_qposadr[id]] - q.of(coordinate)(leg);
        EXPECT_NEAR(apart, 0, 1e-12) << name << ' ' << joint;
        ++found;
      }
    EXPECT_EQ(found, axesOf(scenario));
  }
}

/// Both sides solve 24 equations, whose condition costs some three digits of the sixteen; 1e-9 leaves three more.
TEST(ExportMujoco, GivesTheScenariosEfforts) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    InMujoco model(textOf(scenario, ModelFormat::mjcf));
    for (const double share : {0.0, 0.37, 1.0})
      EXPECT_LT(errorOf(model, scenario, share * scenario.trajectory->duration()), 1e-9) << name << ' ' << share;
  }
}

/// At zero coordinates a thin leg has no inertia about its first axis; the file's pose is one that the machine takes.
TEST(ExportMujoco, ThinLegsAreLoaded) {
  Scenario scenario = machine("apps/starting/UPS.toml");
  ManipulatorParameters parameters = scenario.manipulator->parameters();
  for (Leg& leg : parameters.legs) leg.proximal.inertia(2, 2) = leg.distal.inertia(2, 2) = 0;
  scenario.manipulator = std::make_shared<Manipulator>(parameters);
  InMujoco model(textOf(scenario, ModelFormat::mjcf));
  EXPECT_LT(errorOf(model, scenario, 0.37 * scenario.trajectory->duration()), 1e-9);
}

TEST(ExportMujoco, OtherRecipesAreWrong) {
  const Scenario scenario = machine("scenarios/flight-simulator.toml");
  InMujoco model(textOf(scenario, ModelFormat::mjcf));
  const double t = 0.37 * scenario.trajectory->duration();
  EXPECT_LT(errorOf(model, scenario, t), 1e-9);
  for (const Recipe recipe :
       {Recipe::inverse, Recipe::tree, Recipe::least_squares, Recipe::no_bias, Recipe::global_angular})
    EXPECT_GT(errorOf(model, scenario, t, recipe), 1e-6) << static_cast<int>(recipe);
}

TEST(ExportMujoco, ATensorThatIsNotTurnedIsSeen) {
  const Scenario scenario = machine("scenarios/full-tensors.toml");
  std::vector<Assumption> notes;
  InMujoco model(mjcfText(withTensorNotTurned(scenario), notes));
  EXPECT_GT(deviation(model.bodies(), expectedBodies(scenario)), 1e-3);
  EXPECT_GT(errorOf(model, scenario, 0.37 * scenario.trajectory->duration()), 1e-6);
}

TEST(ExportMujoco, MotorsStandInTheScenariosOrder) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    InMujoco model(textOf(scenario, ModelFormat::mjcf));
    ASSERT_EQ(model.model().nu, motor_count);
    for (int k = 0; k < motor_count; ++k) {
      const Motor& motor = scenario.manipulator->motors()[static_cast<std::size_t>(k)];
      EXPECT_EQ(std::string(mj_id2name(&model.model(), mjOBJ_ACTUATOR, k)),
                fmt::format("leg_{}_{}", motor.leg + 1, nameOf(motor.coordinate)));
    }
  }
}

}  // namespace
}  // namespace ursula::exchange
