// MuJoCo drives the exported machine with the scenario's efforts. Its loops are soft; a loop that carries λ gapes by
//
//   g = R λ / k,  R = (1 − d)/d · A,  k = 1/(d T)²                                                              (1)
//
// with impedance d and time constant T of the file and MuJoCo's estimate A of the inverse mass at the loop: what its
// regularised constraint, A f + a₀ + R f = −b ġ − k g, leaves at rest. Critically damped, it is not overshot.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/exchange/export_mujoco_internal.h"

namespace ursula::exchange {
namespace {

/// MuJoCo asks for controls within its steps, too.
struct Driver {
  const Scenario* scenario = nullptr;
  std::unique_ptr<Noc<double>> noc;
  NocWorkspace<double> work;
};
Driver driver;

void drive(const mjModel*, mjData* data) {
  const Vector6d efforts = driver.noc->inverseDynamics(driver.scenario->trajectory->at(data->time), driver.work);
  std::copy_n(efforts.data(), motor_count, data->ctrl);
}

struct Followed {
  double gap = 0, gap_by_1 = 0;  ///< largest, m
  double drift = 0;              ///< of P from the motion, largest, m
};

Followed follow(const Scenario& scenario, const std::string& text, double end) {
  InMujoco machine(text), exact(text);
  machine.place(asked(scenario.trajectory->at(0)));
  machine.move(asked(scenario.trajectory->at(0)), closed_chain::Recipe::exact);
  driver.scenario = &scenario;
  driver.noc = std::make_unique<Noc<double>>(*scenario.manipulator);
  mjcb_control = drive;
  Followed out;
  mjData& data = machine.data();
  for (int step = 0; data.time < end; ++step) {
    mj_step(&machine.model(), &data);
    if (step % 20 != 0) continue;
    const Motion<double> motion = scenario.trajectory->at(data.time);
    static_cast<void>(exact.efforts(asked(motion)));
    mj_forward(&machine.model(), &data);
    for (int row = 0; row < machine.gaps(); ++row)
      out.gap_by_1 =
          std::max(out.gap_by_1, data.efc_R[row] * std::abs(exact.multipliers()(row)) / data.efc_KBIP[4 * row]);
    out.gap = std::max(out.gap, machine.gap().cwiseAbs().maxCoeff());
    const double* P = data.xpos + 3 * mj_name2id(&machine.model(), mjOBJ_BODY, "platform");
    out.drift = std::max(out.drift, (Eigen::Map<const Vector3d>(P) - motion.p).norm());
  }
  mjcb_control = nullptr;
  return out;
}

/// Ten times as soft.
std::string softer(std::string text) {
  const std::string hard = "0.9999 0.9999", soft = "0.999 0.999";
  for (std::size_t at = text.find(hard); at != std::string::npos; at = text.find(hard, at))
    text.replace(at, hard.size(), soft);
  return text;
}

TEST(ExportSimulation, FollowsTheMotionAsFarAsItsLoopsAreHard) {
  for (const char* name : {"apps/starting/UPS.toml", "apps/starting/RUS.toml"}) {
    const Scenario scenario = machine(name);
    const std::string text = textOf(scenario, ModelFormat::mjcf);
    const Followed hard = follow(scenario, text, 0.5), soft = follow(scenario, softer(text), 0.5);
    std::printf("%s: gap %.3g m, by (1) %.3g m, drift %.3g m; ten times as soft: %.3g m, %.3g m, %.3g m\n", name,
                hard.gap, hard.gap_by_1, hard.drift, soft.gap, soft.gap_by_1, soft.drift);
    EXPECT_LE(hard.gap, 1.1 * hard.gap_by_1) << name;
    EXPECT_GE(hard.gap, 0.5 * hard.gap_by_1) << name;
    EXPECT_LE(soft.gap, 1.1 * soft.gap_by_1) << name;
    // What the platform is off by comes of the gaps: it goes with them.
    EXPECT_NEAR(soft.drift / hard.drift, 10, 2) << name;
  }
}

/// A machine of other efforts does not follow.
TEST(ExportSimulation, AHeavierPlatformIsSeen) {
  const Scenario scenario = machine("apps/starting/UPS.toml");
  ManipulatorParameters heavier = scenario.manipulator->parameters();
  heavier.platform.mass *= 1.01;
  Scenario other = machine("apps/starting/UPS.toml");
  other.manipulator = std::make_shared<Manipulator>(heavier);
  EXPECT_GT(follow(scenario, textOf(other, ModelFormat::mjcf), 0.5).drift,
            100 * follow(scenario, textOf(scenario, ModelFormat::mjcf), 0.5).drift);
}

}  // namespace
}  // namespace ursula::exchange
