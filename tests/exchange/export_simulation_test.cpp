// MuJoCo drives the exported machine with the scenario's efforts. Its loops are soft; a loop that carries λ gapes by
//
//   g = (R λ − Ġq̇)/k,  R = (1 − d)/d · A,  k = 1/(d T)²                                                       (1)
//
// with impedance d and time constant T of the file and MuJoCo's estimate A of the inverse mass at the loop: what its
// regularised constraint, G q̈ + R f = −b ġ − k g, leaves where it varies slowly. It has no Ġq̇. Critically damped, it
// is not overshot; what the rate of (1) adds is b ġ, of the order of T times the rate of the motion, 2 ms · 30/s.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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
  double gap = 0, gap_by_1 = 0;  ///< largest, m; (1) with both parts' sizes
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
    for (int row = 0; row < machine.gaps(); ++row) {
      const double force = data.efc_R[row] * std::abs(exact.multipliers()(row)), bias = std::abs(exact.bias()(row));
      out.gap_by_1 = std::max(out.gap_by_1, (force + bias) / data.efc_KBIP[4 * row]);
    }
    out.gap = std::max(out.gap, machine.gap().cwiseAbs().maxCoeff());
    const double* P = data.xpos + 3 * mj_name2id(&machine.model(), mjOBJ_BODY, "platform");
    out.drift = std::max(out.drift, (Eigen::Map<const Vector3d>(P) - motion.p).norm());
  }
  mjcb_control = nullptr;
  return out;
}

std::string withImpedance(std::string text, const std::string& impedance) {
  const std::string written = "0.9999";
  for (std::size_t at = text.find(written); at != std::string::npos; at = text.find(written, at + 1))
    text.replace(at, written.size(), impedance);
  return text;
}

TEST(ExportSimulation, FollowsTheMotionAsFarAsItsLoopsAreHard) {
  for (const char* name : {"apps/starting/UPS.toml", "apps/starting/RUS.toml", "apps/starting/URS.toml"}) {
    const Scenario scenario = machine(name);
    const std::string text = textOf(scenario, ModelFormat::mjcf);
    std::array<Followed, 3> by;
    const std::array<const char*, 3> impedances = {"0.9999", "0.999", "0.99"};
    for (std::size_t k = 0; k < by.size(); ++k) {
      by[k] = follow(scenario, withImpedance(text, impedances[k]), 0.5);
      std::printf("%s, impedance %s: gap %.3g m, by (1) %.3g m, drift %.3g m\n", name, impedances[k], by[k].gap,
                  by[k].gap_by_1, by[k].drift);
      EXPECT_LE(by[k].gap, 1.1 * by[k].gap_by_1) << name << ' ' << impedances[k];
      EXPECT_GE(by[k].gap, 0.5 * by[k].gap_by_1) << name << ' ' << impedances[k];
    }
    // What the platform is off by comes of what the loops give way, 1 − d.
    EXPECT_NEAR(by[2].drift / by[1].drift, 10, 3) << name;
    EXPECT_LE(by[0].drift, by[1].drift / 3) << name;
  }
}

/// Rods that spin freely do not: nothing turns them about their lines.
TEST(ExportSimulation, FreeRodsFollow) {
  const Scenario scenario = machine("scenarios/free-rods.toml");
  const std::string text = textOf(scenario, ModelFormat::mjcf);
  EXPECT_NE(text.find("type=\"ball\""), std::string::npos);
  const Followed hard = follow(scenario, text, 0.2), soft = follow(scenario, withImpedance(text, "0.99"), 0.2);
  EXPECT_LT(hard.drift, soft.drift / 3);
  EXPECT_LE(hard.gap, 1.1 * hard.gap_by_1);
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
