// The closed loop in Simbody by itself: two topologies of one machine, and the properties of both. This program does
// not link the solver.

#include "simbody/simbody_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/real50.h"
#include "tests/support/motions.h"
#include "tests/support/numbers.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

using Topology = SimbodyLoop::Topology;

/// Rounding on the way from a pose to accelerations and torques and back. There is one error for each of the 30
/// coordinates on either side of a comparison, times a condition number below 1e3 for these machines near their
/// helices.
constexpr double room = 64 * 1e3 * eps;

double norm(const JointVariables<double>& a, const JointVariables<double>& b) {
  return std::sqrt((a.phi - b.phi).squaredNorm() + (a.psi - b.psi).squaredNorm() + (a.theta - b.theta).squaredNorm());
}

double scaleOf(const JointVariables<double>& a) {
  return norm(a, {Vector6d::Zero(), Vector6d::Zero(), Vector6d::Zero()});
}

double offTwistRate(const SimbodyLoop& loop, const Motion<double>& motion) {
  const Motion<double> found = loop.platform();
  return (found.p_ddot - motion.p_ddot).norm() + (found.omega_dot - motion.omega_dot).norm();
}

class Loop : public testing::TestWithParam<std::string> {
 protected:
  SimbodyLoop loop(Topology topology, const std::shared_ptr<const Load>& load = nullptr) const {
    return SimbodyLoop(*scenario_.manipulator, topology, load);
  }
  Scenario scenario_ = vectorScenario(GetParam());
  std::vector<VectorRow> rows_ = vectorRows(GetParam());
  SeededDraws dice_{41};
};

constexpr Topology topologies[] = {Topology::ball_per_leg, Topology::tree_through_leg_1};

/// The vectors are the truth at position level, made without Simbody and without the paper's rates.
TEST_P(Loop, hasTheJointMotionAndTorquesOfTheVectors) {
  double worst = 0;
  const auto expect = [&](const JointVariables<double>& found, const JointVariables<Real50>& truth) {
    const JointVariables<double> expected{truth.phi.cast<double>(), truth.psi.cast<double>(),
                                          truth.theta.cast<double>()};
    worst = std::max(worst, norm(found, expected) / scaleOf(expected));
  };
  for (const Topology topology : topologies) {
    SimbodyLoop at = loop(topology);
    for (const VectorRow& row : rows_) {
      const JointMotion found = at.place(rounded(row.motion));
      expect(found.q, row.q);
      expect(found.q_dot, row.q_dot);
      expect(found.q_ddot, row.q_ddot);
      const Vector6d expected = row.torques.cast<double>();
      worst = std::max(worst, (at.inverseDynamics() - expected).norm() / expected.norm());
    }
  }
  std::cout << "Simbody against the vectors: " << worst << '\n';
  EXPECT_LE(worst, room);
  EXPECT_GT(worst, 0);
}

TEST_P(Loop, closesTheLoopsAndTakesThePlatformWhereItIsTold) {
  for (const Topology topology : topologies) {
    SimbodyLoop at = loop(topology);
    for (int k = 0; k < 5; ++k) {
      const Motion<double> motion = randomState(scenario_, dice_);
      at.place(motion);
      EXPECT_LE(at.closure().position, room);
      EXPECT_LE(at.closure().velocity, room);
      const Motion<double> found = at.platform();
      EXPECT_LE((found.p - motion.p).norm() + (found.Q - motion.Q).norm(), room);
      EXPECT_LE((found.p_dot - motion.p_dot).norm() + (found.omega - motion.omega).norm(), room);
      EXPECT_LE(offTwistRate(at, motion), 10 * room);
    }
  }
}

/// Control: the closure reveals a wrong angle and a wrong rate.
TEST_P(Loop, closureSeesAnOpenLoop) {
  SimbodyLoop at = loop(Topology::ball_per_leg);
  const Motion<double> motion = randomState(scenario_, dice_);
  const JointMotion right = at.place(motion);
  JointMotion off = right;
  off.q.psi(2) += 1e-6;
  at.place(motion, off);
  EXPECT_GT(at.closure().position, 1e-7);
  off = right;
  off.q_dot.theta(4) += 1e-6;
  at.place(motion, off);
  EXPECT_LE(at.closure().position, room);
  EXPECT_GT(at.closure().velocity, 1e-7);
  at.place(motion, right);
  EXPECT_LE(at.closure().velocity, room);
}

std::shared_ptr<const Load> someLoad(Load::Frame frame) {
  const auto load = std::make_shared<Load>();
  load->force = {300, -200, 500};
  load->moment = {40, 50, -60};
  load->point = {0.1, -0.2, 0.3};
  load->frame = frame;
  return load;
}

TEST_P(Loop, bodiesAndTorquesAgreeBetweenTheTopologies) {
  for (const auto& load :
       {std::shared_ptr<const Load>(), someLoad(Load::Frame::base), someLoad(Load::Frame::platform)}) {
    SimbodyLoop six = loop(Topology::ball_per_leg, load), tree = loop(Topology::tree_through_leg_1, load);
    const Motion<double> motion = randomState(scenario_, dice_);
    six.place(motion);
    tree.place(motion);
    const Vector6d torques = six.inverseDynamics();
    EXPECT_LE((torques - tree.inverseDynamics()).norm(), room * torques.norm());
    EXPECT_GT(torques.norm(), 1);
    const BodyMotions<double> a = six.bodies(), b = tree.bodies();
    for (std::size_t k = 0; k < body_count; ++k) {
      EXPECT_LE((a[k].c - b[k].c).norm() + (a[k].R - b[k].R).norm(), room) << "body " << k;
      EXPECT_LE((a[k].twist - b[k].twist).norm(), room * (1 + a[k].twist.norm())) << "body " << k;
      EXPECT_LE((a[k].twist_rate - b[k].twist_rate).norm(), 10 * room * (1 + a[k].twist_rate.norm())) << "body " << k;
    }
  }
}

TEST_P(Loop, acceleratesAsCommandedUnderItsOwnTorques) {
  for (const Topology topology : topologies) {
    SimbodyLoop at = loop(topology, someLoad(Load::Frame::platform));
    const Motion<double> motion = randomState(scenario_, dice_);
    at.place(motion);
    const Vector6d torques = at.inverseDynamics();
    const auto error = [&](const Vector6d& applied) {
      at.accelerate(applied);
      return offTwistRate(at, motion);
    };
    // Here the effects of the torques alone cancel.
    EXPECT_LE(error(torques), room * (motion.p_ddot.norm() + motion.omega_dot.norm() + error(Vector6d::Zero())));
    EXPECT_GT(error(torques + 1e-3 * Vector6d::Unit(2)), 1e-7) << "it sees a millinewton metre";
  }
}

/// Rotors add j q̈ to the efforts and ½ j q̇² to the energy. The dynamics of both topologies, by elimination and by
/// Simbody, give the accelerations back.
TEST_P(Loop, hasTheRotorsOfItsMotors) {
  ManipulatorParameters machine = scenario_.manipulator->parameters();
  Vector6d rotors;
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = scenario_.manipulator->motors()[static_cast<std::size_t>(m)];
    rotors(m) = machine.legs[static_cast<std::size_t>(motor.leg)].rotor_inertia.on(motor.coordinate) = 2 + m;
  }
  const Motors& motors = scenario_.manipulator->motors();
  for (const Topology topology : topologies) {
    SimbodyLoop plain = loop(topology), with(Manipulator(machine), topology);
    const Motion<double> motion = randomState(scenario_, dice_);
    const JointMotion joints = with.place(motion);
    plain.place(motion);
    const Vector6d rate = joints.q_dot.driven(motors), acceleration = joints.q_ddot.driven(motors);
    const Vector6d torques = with.inverseDynamics(), more = rotors.cwiseProduct(acceleration);
    EXPECT_LE((torques - plain.inverseDynamics() - more).norm(), room * torques.norm());
    EXPECT_GT(more.norm(), 1e3 * room * torques.norm());
    const double energy = rotors.dot(rate.cwiseAbs2()) / 2;
    EXPECT_LE(std::abs(with.energy().kinetic - plain.energy().kinetic - energy), room * with.energy().kinetic);
    EXPECT_EQ(with.energy().potential, plain.energy().potential);
    with.place(motion, joints);
    EXPECT_LE((with.inverseDynamics() - torques).norm(), room * torques.norm());
    with.accelerate(torques);
    EXPECT_LE(offTwistRate(with, motion), 1e3 * room);
    if (topology == Topology::ball_per_leg) {
      EXPECT_LE(with.ownTwistRateError(torques).norm(), 1e3 * room);
    }
  }
}

/// Here Simbody's own forward dynamics drops multipliers, and its error is as large as gravity.
TEST_P(Loop, acceleratesAsCommandedWithNearlyMasslessRods) {
  ManipulatorParameters light = scenario_.manipulator->parameters();
  for (Leg& leg : light.legs) {
    leg.distal.mass = 1e-9;
    leg.distal.center_of_mass = 0;
    leg.distal.inertia = Vector3d(1e-10, 1e-10, 1e-12).asDiagonal();
  }
  SimbodyLoop at(Manipulator(light), Topology::ball_per_leg);
  const Motion<double> motion = randomState(scenario_, dice_);
  at.place(motion);
  const Vector6d torques = at.inverseDynamics();
  at.accelerate(torques);
  const double size = motion.p_ddot.norm() + motion.omega_dot.norm() + 9.81;
  EXPECT_LE(offTwistRate(at, motion), room * size);
  EXPECT_LE(at.gapAcceleration(), room * size);
  EXPECT_GT(torques.norm(), 1);
  at.accelerate(torques + 1e-3 * torques.norm() * Vector6d::Unit(2));
  EXPECT_GT((at.platform().p_ddot - motion.p_ddot).norm(), 1e-6) << "it sees a thousandth";
}

/// d(energy)/dt = power, the derivative by a central difference along the state's own motion.
TEST_P(Loop, energyGrowsByThePower) {
  for (const Topology topology : topologies) {
    SimbodyLoop at = loop(topology, someLoad(Load::Frame::base));
    at.place(randomState(scenario_, dice_));
    const std::vector<double> x = at.state();
    std::vector<double> rate(x.size()), moved(x.size());
    const Vector6d torques(100, -200, 300, 50, -60, 70);
    at.derivative(0, x.data(), torques, rate.data());
    const SimbodyLoop::Power power = at.power();
    const double sum = power.actuators + power.friction + power.load;
    const double step = 1e-5;
    const auto energy = [&](double h) {
      for (std::size_t k = 0; k < x.size(); ++k) moved[k] = x[k] + h * rate[k];
      at.setState(h, moved.data());
      const SimbodyLoop::Energy found = at.energy();
      return found.kinetic + found.potential;
    };
    const double slope = (energy(step) - energy(-step)) / (2 * step);
    const double size = std::abs(energy(0)) + std::abs(sum);
    // Truncation is step² over the square of the motion's time, some 0.1 s; rounding is eps / step.
    EXPECT_NEAR(slope, sum, size * (step * step / 0.01 + 64 * eps / step));
    EXPECT_GT(std::abs(sum), 1e3 * size * (step * step / 0.01 + 64 * eps / step)) << "the room says nothing";
    EXPECT_LE(power.friction, 0);
  }
}

TEST_P(Loop, stateIsWhatWasSet) {
  SimbodyLoop at = loop(Topology::ball_per_leg), other = loop(Topology::ball_per_leg);
  at.place(randomState(scenario_, dice_));
  const std::vector<double> x = at.state();
  ASSERT_EQ(static_cast<int>(x.size()), at.stateSize());
  other.setState(0, x.data());
  EXPECT_EQ(other.state(), x);
  EXPECT_LE(norm(other.joints().q, at.joints().q), 0);
  EXPECT_LE((other.platform().p - at.platform().p).norm(), 0);
}

INSTANTIATE_TEST_SUITE_P(Machines, Loop, testing::Values("paper-helix", "random-1", "random-4", "random-6"),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

TEST(LoopSizes, sixDegreesOfFreedomEitherWay) {
  const Scenario scenario = vectorScenario("paper-helix");
  const auto size = [&](Topology topology) { return SimbodyLoop(*scenario.manipulator, topology).stateSize(); };
  EXPECT_EQ(size(Topology::ball_per_leg), 6 * 3 + 7 + 24);        // a quaternion for the free platform
  EXPECT_EQ(size(Topology::tree_through_leg_1), 6 * 3 + 4 + 21);  // and for its ball on leg 1
}

/// Viscous and Coulomb friction of the knees act against their rates.
TEST(LoopFriction, costsTorqueAndPower) {
  const Scenario scenario = vectorScenario("paper-helix");
  ManipulatorParameters parameters = scenario.manipulator->parameters();
  SeededDraws dice(43);
  const Motion<double> motion = randomState(scenario, dice);
  SimbodyLoop smooth(*scenario.manipulator);
  const JointMotion joints = smooth.place(motion);
  const Vector6d without = smooth.inverseDynamics();

  Leg& leg = parameters.legs[1];
  leg.friction.phi = 3;
  leg.coulomb.phi = 2;
  leg.coulomb.smoothing_speed = 0.1;
  SimbodyLoop rough{Manipulator(parameters)};
  rough.place(motion);
  const Vector6d change = rough.inverseDynamics() - without;
  const double rate = joints.q_dot.phi(1), expected = 3 * rate + 2 * std::tanh(rate / 0.1);
  EXPECT_NEAR(change(1), expected, room * without.norm());
  EXPECT_LE((change - change(1) * Vector6d::Unit(1)).norm(), room * without.norm());
  EXPECT_GT(std::abs(expected), 1e3 * room * without.norm());
  rough.accelerate(rough.inverseDynamics());
  EXPECT_NEAR(rough.power().friction, -expected * rate, 64 * eps * std::abs(expected * rate));
  EXPECT_LT(rough.power().friction, -1e-3);
}

TEST(LoopErrors, aPoseOutOfReachIsRefusedByItsLeg) {
  const Scenario scenario = vectorScenario("paper-helix");
  SimbodyLoop loop(*scenario.manipulator);
  Motion<double> motion = scenario.trajectory->at(1);
  motion.p.z() += 5;
  try {
    loop.place(motion);
    ADD_FAILURE() << "nothing thrown";
  } catch (const std::domain_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("leg 1 (URS) cannot reach at t = 1 s"));
  }
  EXPECT_NO_THROW(loop.place(scenario.trajectory->at(1))) << "and is as good as before";
}

TEST(LoopIntegration, rungeKuttaMersonObservesEveryInstantAskedFor) {
  const Scenario scenario = vectorScenario("paper-helix");
  SimbodyLoop loop(*scenario.manipulator), commanded(*scenario.manipulator);
  loop.place(scenario.trajectory->at(0));
  const auto torques = [&](double t) {
    commanded.place(scenario.trajectory->at(t));
    return commanded.inverseDynamics();
  };
  std::vector<double> observed;
  double error = 0;
  const SimbodyLoop::Counters counters = loop.integrateRungeKuttaMerson(1e-8, torques, {0.1, 0.25, 0.3}, [&](double t) {
    observed.push_back(t);
    error = std::max(error, (loop.platform().p - scenario.trajectory->at(t).p).norm());
  });
  EXPECT_EQ(observed, (std::vector<double>{0, 0.1, 0.25, 0.3}));
  EXPECT_FALSE(counters.gave_up);
  EXPECT_GT(counters.steps, 2);
  EXPECT_GE(counters.derivative_evaluations, 4 * counters.steps);
  EXPECT_LE(error, 1e-6);  // the requested accuracy, over some steps, slightly amplified
  EXPECT_GT(error, 0);
}

TEST(LoopIntegration, effortsThatFailAtOnceGiveUpTheIntegrationOnly) {
  const Scenario scenario = vectorScenario("paper-helix");
  SimbodyLoop loop(*scenario.manipulator);
  loop.place(scenario.trajectory->at(0));
  const auto none = [](double) -> Vector6d { throw std::runtime_error("the solver is gone"); };
  const SimbodyLoop::Counters counters = loop.integrateRungeKuttaMerson(1e-8, none, {0.1}, [](double) {});
  EXPECT_TRUE(counters.gave_up);
  EXPECT_EQ(counters.steps, 0);
}

}  // namespace
}  // namespace ursula
