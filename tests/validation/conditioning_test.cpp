// The factors of every pointwise limit are compared with their definitions by another formulation. Rounding stays
// within the limits, which are not much larger.

#include "validation/limits/conditioning.h"
#include "parts/fast/solver.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/real50.h"
#include "nocsolver/errors.h"
#include "tests/support/motions.h"
#include "tests/support/vectors.h"
#include "validation/subject/frame_change.h"

namespace ursula {
namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();

class ConditioningOf : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = vectorScenario(GetParam());
  SeededDraws dice_{31};
};

/// κ(B)² is the ratio of the eigenvalues of BᵀB.
TEST_P(ConditioningOf, kappaBIsThatOfB) {
  const Solver<double> solver(*scenario_.manipulator);
  ConditioningProbe probe(*scenario_.manipulator, nullptr);
  for (int k = 0; k < 5; ++k) {
    const Motion<double> motion = randomState(scenario_, dice_);
    Workspace<double> work;
    solver.inverseKinematics(motion, work);
    solver.jacobians(motion, work);
    const Conditioning found = probe.at(motion);
    Matrix6d B = solver.B(work);
    B.leftCols<3>() /= found.length;
    const Vector6d eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix6d>(B.transpose() * B).eigenvalues();
    const double expected = std::sqrt(eigenvalues(5) / eigenvalues(0));
    EXPECT_NEAR(found.kappa_B / expected, 1, 64 * eps * expected * expected);
  }
}

/// ‖S T_P I⁻¹‖ column by column, from the platform's accelerations under unit torques.
TEST_P(ConditioningOf, responseIsThatOfTheAccelerationsToTorques) {
  const Solver<double> solver(*scenario_.manipulator);
  ConditioningProbe probe(*scenario_.manipulator, nullptr);
  for (int k = 0; k < 5; ++k) {
    const Motion<double> motion = randomState(scenario_, dice_);
    Workspace<double> work;
    const Conditioning found = probe.at(motion);
    const Vector6d torques = solver.inverseDynamics(motion, work);
    const Vector6d base = solver.directDynamics(motion, torques, work);
    const double size = 1e3;  // the response is linear, so these are as large as the torques themselves
    double sum = 0;
    for (int j = 0; j < leg_count; ++j) {
      Vector6d change = (solver.directDynamics(motion, torques + size * Vector6d::Unit(j), work) - base) / size;
      change.head<3>() *= found.length;
      sum += change.squaredNorm();
    }
    const double room = found.accelerationRounding() / size * std::sqrt(6.0) / found.response;
    EXPECT_NEAR(std::sqrt(sum) / found.response, 1, room);
    EXPECT_LE(room, 1e-6);
  }
}

TEST_P(ConditioningOf, legsAreJudgedByTheirSinesAndLevers) {
  const Solver<double> solver(*scenario_.manipulator);
  ConditioningProbe probe(*scenario_.manipulator, nullptr);
  const Motion<double> motion = randomState(scenario_, dice_);
  Workspace<double> work;
  solver.inverseKinematics(motion, work);
  const JointVariables<double> q = solver.angles(work);
  const Conditioning found = probe.at(motion);
  Eigen::Index leg = 0;
  EXPECT_NEAR(q.theta.array().sin().abs().minCoeff(&leg), found.smallest_sine, 16 * eps);
  EXPECT_EQ(found.smallest_sine_leg, leg);
  EXPECT_GE(found.kappa_legs * (1 + 16 * eps), 1 / (found.smallest_sine * found.smallest_sine));
}

/// The error of doubles against 50 digits is within the limit, and the limit is within five orders of magnitude of it.
TEST_P(ConditioningOf, torqueRoundingIsKeptAndMeansSomething) {
  const Solver<double> solver(*scenario_.manipulator);
  const FastDynamics<Real50> exact(*scenario_.manipulator);
  ConditioningProbe probe(*scenario_.manipulator, nullptr);
  double closest = 0;
  for (const VectorRow& row : vectorRows(GetParam())) {
    Workspace<double> work;
    const Motion<double> motion = rounded(row.motion);
    const Vector6d right = exact.inverseDynamics(row.motion).cast<double>();
    const double error = (solver.inverseDynamics(motion, work) - right).norm();
    const double limit = probe.at(motion).torqueRounding();
    EXPECT_LE(error, limit);
    closest = std::max(closest, error / limit);
  }
  std::cout << "the closest torque is at " << closest << " of its limit\n";
  EXPECT_GT(closest, 1e-5);
}

TEST_P(ConditioningOf, aLoadOnlyRaisesTheLimit) {
  const auto load = std::make_shared<Load>();
  load->force = {1e4, -2e4, 3e4};
  const Motion<double> motion = randomState(scenario_, dice_);
  const Conditioning without = ConditioningProbe(*scenario_.manipulator, nullptr).at(motion);
  const Conditioning with = ConditioningProbe(*scenario_.manipulator, load).at(motion);
  EXPECT_GT(with.torqueRounding(), without.torqueRounding());
  EXPECT_EQ(with.kappa_B, without.kappa_B);
}

/// A free distal link, pushed at its end, moves there by Newton and Euler. It never moves more than by the largest
/// compliance, and in the worst direction of the worst leg not much less.
TEST_P(ConditioningOf, legComplianceIsThatOfAPushedLink) {
  const Conditioning found = ConditioningProbe(*scenario_.manipulator, nullptr).at(randomState(scenario_, dice_));
  double most = 0;
  for (int i = 0; i < leg_count; ++i) {
    const Link& link = scenario_.manipulator->leg(i).distal;
    const Vector3d arm(0, 0, link.length - link.center_of_mass);
    for (int k = 0; k < 200; ++k) {
      const Vector3d force = dice_.vector(1).normalized();
      const Vector3d spin = link.inertia.ldlt().solve(arm.cross(force));
      most = std::max(most, (force / link.mass + spin.cross(arm)).norm());
    }
  }
  EXPECT_LE(most, found.leg_compliance);
  EXPECT_GT(most, 0.5 * found.leg_compliance);
  EXPECT_DOUBLE_EQ(found.shape(Rounded::gaps), eps * (found.compliance + found.leg_compliance) * found.force_scale);
  EXPECT_GT(found.shape(Rounded::gaps), 0);
}

/// A limit is a shape times a level, and each quantity has its own.
TEST_P(ConditioningOf, limitsAreShapesTimesLevels) {
  Conditioning found = ConditioningProbe(*scenario_.manipulator, nullptr).at(randomState(scenario_, dice_));
  for (std::size_t q = 0; q < rounded_count; ++q) {
    const auto quantity = static_cast<Rounded>(q);
    EXPECT_GT(found.shape(quantity), 0) << q;
    EXPECT_LT(found.shape(quantity), 1e-6) << q;
    EXPECT_DOUBLE_EQ(found.rounding(quantity), rounding_depth * found.shape(quantity)) << "nothing was measured";
    found.levels[q] = static_cast<double>(q);
  }
  for (std::size_t q = 0; q < rounded_count; ++q)
    EXPECT_EQ(found.rounding(static_cast<Rounded>(q)), static_cast<double>(q) * found.shape(static_cast<Rounded>(q)));
  EXPECT_EQ(found.torqueRounding(), found.rounding(Rounded::torque));
  EXPECT_EQ(found.accelerationRounding(), found.rounding(Rounded::acceleration));
}

/// Shapes do not depend on the machine's place and orientation or on units.
TEST_P(ConditioningOf, shapesDoNotDependOnTheFrameChange) {
  const Motion<double> motion = randomState(scenario_, dice_);
  const Conditioning here = ConditioningProbe(*scenario_.manipulator, scenario_.load).at(motion);
  FrameChange there = randomFrameChange(17, 3 * here.length, *scenario_.manipulator);
  const auto shapeThere = [&](Rounded quantity) {
    return ConditioningProbe(there.transformed(*scenario_.manipulator), there.transformed(scenario_.load))
        .at(there.transformed(motion))
        .shape(quantity);
  };
  const Units u = there.units;
  const std::pair<Rounded, double> units[] = {{Rounded::angles, 1},
                                              {Rounded::rates, 1 / u.time},
                                              {Rounded::accelerations, 1 / (u.time * u.time)},
                                              {Rounded::positions, u.length},
                                              {Rounded::twists, u.velocity()},
                                              {Rounded::twist_rates, u.acceleration()},
                                              {Rounded::jacobian, u.velocity()},
                                              {Rounded::jacobian_rate, u.acceleration()},
                                              {Rounded::shaping, u.length},
                                              {Rounded::torque, u.torque()},
                                              {Rounded::acceleration, u.acceleration()},
                                              {Rounded::effort, u.torque()},
                                              {Rounded::gaps, u.acceleration()},
                                              {Rounded::reactions, u.force()},
                                              {Rounded::direct, u.acceleration()}};
  for (const auto& [quantity, unit] : units)
    EXPECT_NEAR(shapeThere(quantity) * unit / here.shape(quantity), 1, 1e-9) << static_cast<int>(quantity);
}

INSTANTIATE_TEST_SUITE_P(Machines, ConditioningOf, testing::ValuesIn(vectorNames()),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

/// κ(I) of a machine's inertia agrees with the inverse's norm. It does not depend on a motor's unit, and within the
/// paper's range I has digits.
TEST_P(ConditioningOf, inertiaHasDigits) {
  const Conditioning found = ConditioningProbe(*scenario_.manipulator, nullptr).at(randomState(scenario_, dice_));
  EXPECT_GE(found.kappa_I, 1);
  EXPECT_LT(found.kappa_I, 1e8);
  EXPECT_TRUE(found.hasDigitsOfI());
  EXPECT_TRUE(std::isfinite(found.rounding(Rounded::direct)));
}

/// The platform is so heavy that its rotations are lost in I. Then direct dynamics has no limit, but inverse dynamics
/// has.
TEST(ConditioningOfAHeavyPlatform, directDynamicsCannotBeJudged) {
  const Scenario scenario = vectorScenario("paper-helix");
  for (const auto& [mass, has_digits] : {std::pair{1e6, true}, {1e18, false}}) {
    ManipulatorParameters parameters = scenario.manipulator->parameters();
    parameters.platform.mass = mass;
    const Conditioning found = ConditioningProbe(Manipulator(parameters), nullptr).at(scenario.trajectory->at(1));
    EXPECT_EQ(found.hasDigitsOfI(), has_digits) << found.kappa_I;
    for (const Rounded quantity : {Rounded::direct, Rounded::solver_direct}) {
      EXPECT_EQ(std::isfinite(found.rounding(quantity)), has_digits);
      EXPECT_EQ(causeOfRounding(found, quantity).find("kappa(I)") == std::string::npos, has_digits);
    }
    EXPECT_TRUE(std::isfinite(found.rounding(Rounded::torque)));
  }
}

/// Limits grow without bound towards a stretched leg, and there the probe throws.
TEST(ConditioningNearTheReach, growsAndThenRefuses) {
  const Scenario scenario = vectorScenario("paper-helix");
  ConditioningProbe probe(*scenario.manipulator, nullptr);
  Motion<double> motion = scenario.trajectory->at(0);
  double reach = 0, beyond = 10;  // the lift of P, bisected to the edge of the workspace
  const auto raised = [&](double by) {
    Motion<double> out = motion;
    out.p.z() += by;
    return out;
  };
  for (int k = 0; k < 60; ++k) {
    const double middle = (reach + beyond) / 2;
    try {
      probe.at(raised(middle));
      reach = middle;
    } catch (const PoseError&) {
      beyond = middle;
    }
  }
  EXPECT_GT(reach, 0.1);
  EXPECT_THROW(probe.at(raised(beyond)), PoseError);
  double before = 0;
  for (const double distance : {1e-1, 1e-2, 1e-4, 1e-6}) {
    const Conditioning found = probe.at(raised(reach - distance));
    EXPECT_GT(found.kappa_legs, 5 * before);
    before = found.kappa_legs;
  }
}

}  // namespace
}  // namespace ursula
