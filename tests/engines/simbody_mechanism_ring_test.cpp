// One loop of a crank, a rod and a slider in Simbody, with each of its joints cut in turn, turned around or open: none
// of that changes what the machine is.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simbody/simbody_mechanism.h"
#include "tests/engines/slider_crank.h"

namespace ursula {
namespace {

using Tree = SimbodyMechanism::Tree;

MotorMotion motionAt(double t) {
  const auto one = [](double x) { return Eigen::VectorXd::Constant(1, x); };
  return {t, one(0.1 + 0.2 * std::sin(t)), one(0.2 * std::cos(t)), one(-0.2 * std::sin(t))};
}

/// Efforts at three instants, and the accelerations under them.
struct Answers {
  Eigen::VectorXd efforts = Eigen::VectorXd(3);
  std::vector<SimbodyMechanism::BodyState> bodies;
};

Answers answersOf(SimbodyMechanism& loop) {
  Answers out;
  for (int i = 0; i < 3; ++i) {
    const MotorMotion motion = motionAt(0.8 * i);
    loop.place(motion);
    const Eigen::VectorXd efforts = loop.inverseDynamics();
    out.efforts(i) = efforts(0);
    EXPECT_NEAR(loop.accelerationsByElimination(efforts)(0), motion.qddot(0), 1e-11);
    EXPECT_NEAR(loop.accelerations(efforts)(0), motion.qddot(0), 1e-11);
    EXPECT_NEAR(loop.motorCoordinates()(0), motion.q(0), 1e-14);
    EXPECT_NEAR(loop.motorRates()(0), motion.qdot(0), 1e-14);
  }
  out.bodies = loop.bodies();
  return out;
}

void expectAlike(const Answers& a, const Answers& b, const std::string& what) {
  EXPECT_LT((a.efforts - b.efforts).norm(), 1e-12 * a.efforts.norm()) << what;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_LT((a.bodies[i].twist - b.bodies[i].twist).norm(), 1e-12) << what << i;
    EXPECT_LT((a.bodies[i].twist_rate - b.bodies[i].twist_rate).norm(), 1e-11) << what << i;
  }
}

/// With equal ranks the last joint of the list is cut.
TEST(SimbodyMechanismRing, isTheSameWhicheverJointIsCutOrTurnedAround) {
  for (const auto& [with_loads, motor] : {std::pair(false, "hinge"), {true, "hinge"}, {true, "rail"}}) {
    MechanismParameters machine = with_loads ? loaded(sliderCrank()) : sliderCrank();
    machine.motors = {motor};
    SimbodyMechanism first{Mechanism(machine)};
    const Answers expected = answersOf(first);
    for (std::size_t cut = 0; cut < machine.joints.size(); ++cut)
      for (const bool is_turned : {false, true}) {
        if (machine.joints[cut].name == motor) continue;
        MechanismParameters other = machine;
        std::rotate(other.joints.begin() + static_cast<long>(cut), other.joints.begin() + static_cast<long>(cut) + 1,
                    other.joints.end());
        if (is_turned)
          for (MechanismJoint& at : other.joints) at = turnedAround(at);
        other.joints.back().closure = true;
        SimbodyMechanism loop(Mechanism(other), Tree::of_file);
        EXPECT_EQ(loop.tree(), "cuts " + machine.joints[cut].name);
        expectAlike(answersOf(loop), expected, loop.tree());
      }
  }
}

TEST(SimbodyMechanismRing, isTheSameIfItsReferencePoseIsOpen) {
  MechanismParameters machine = loaded(sliderCrank());
  machine.joints[2].friction = 0.3;
  SimbodyMechanism closed{Mechanism(machine)};
  const Answers expected = answersOf(closed);
  EXPECT_LT(closed.gap(), 1e-15);
  Eigen::Isometry3d by(Eigen::AngleAxisd(0.05, Vector3d(0.6, 0, 0.8)));
  by.translation() << 0.01, -0.02, 0.03;
  for (const std::size_t moved : {std::size_t{2}, std::size_t{3}})
    for (std::size_t cut = 1; cut < 4; ++cut) {
      MechanismParameters other = displaced(machine, moved, by);
      for (MechanismJoint& at : other.joints)
        if (at.kind == JointKind::ball) at.turn.setIdentity();
      std::swap(other.joints[cut], other.joints.back());
      SimbodyMechanism loop(Mechanism(other), Tree::of_file);
      EXPECT_GT(loop.gap(), 1e-3);
      expectAlike(answersOf(loop), expected, loop.tree());
    }
}

/// The motor's power is the rate of the energy, of rotors, gravity and springs as well.
TEST(SimbodyMechanismRing, keepsItsEnergyButForTheMotorsPower) {
  MechanismParameters machine = loaded(sliderCrank());
  for (MechanismJoint& at : machine.joints) at.damping = at.friction = 0;
  SimbodyMechanism loop{Mechanism(machine)};
  const auto energyAt = [&](double t) {
    loop.place(motionAt(t));
    return loop.energy().kinetic + loop.energy().potential;
  };
  constexpr double h = 1e-3;
  const double rate =
      (8 * (energyAt(0.7 + h) - energyAt(0.7 - h)) - (energyAt(0.7 + 2 * h) - energyAt(0.7 - 2 * h))) / (12 * h);
  loop.place(motionAt(0.7));
  EXPECT_NEAR(loop.inverseDynamics()(0) * motionAt(0.7).qdot(0), rate, 1e-9 * std::abs(rate));
}

/// The rod as two halves with a fixed joint in the tree, or one that closes the loop, and with a massless tool on it.
TEST(SimbodyMechanismRing, isTheSameIfItsRodIsWelded) {
  const MechanismParameters machine = loaded(sliderCrank());
  SimbodyMechanism whole{Mechanism(machine)};
  Answers expected = answersOf(whole);
  MechanismParameters other = machine;
  const Vector3d shift = 0.05 * (machine.joints[2].centre - machine.joints[1].centre);
  MechanismBody& half = other.bodies[2];
  half.mass /= 2;
  half.inertia =
      half.inertia / 2 - half.mass * (shift.squaredNorm() * Matrix3d::Identity() - shift * shift.transpose());
  other.bodies.insert(other.bodies.end(), {half, body("tool", 0, Vector3d::Zero(), Vector3d::Zero())});
  other.bodies[2].center_of_mass += shift;
  other.bodies[4].center_of_mass -= shift;
  other.joints[2].parent = 4;
  other.joints.push_back(joint("tool", JointKind::fixed, 2, 5, other.joints[1].centre));
  other.joints.push_back(joint("weld", JointKind::fixed, 4, 2, machine.bodies[2].center_of_mass));
  for (const bool closes : {false, true}) {
    other.joints.back().closure = closes;
    SimbodyMechanism loop(Mechanism(other), Tree::of_file);
    EXPECT_EQ(loop.tree(), closes ? "cuts weld" : "cuts rail");
    Answers found = answersOf(loop);
    found.bodies.resize(4);
    found.bodies[2] = expected.bodies[2];  // its mass centre is another
    expectAlike(found, expected, loop.tree());
  }
}

/// The universal joint as two hinges with a massless body between them: left out, in the tree, or a tip.
TEST(SimbodyMechanismRing, isTheSameWithAMasslessBody) {
  for (const bool with_loads : {false, true}) {
    MechanismParameters machine = with_loads ? loaded(sliderCrank()) : sliderCrank();
    machine.joints[1] = sliderCrank().joints[1];  // without loads
    SimbodyMechanism whole{Mechanism(machine)};
    const Answers expected = answersOf(whole);
    MechanismParameters other = machine;
    other.bodies.push_back(body("between", 0, Vector3d::Zero(), Vector3d::Zero()));
    MechanismJoint &first = other.joints[1], second = other.joints[1];
    first.kind = second.kind = JointKind::revolute;
    first.child = second.parent = 4;
    second.axis[0] = second.axis[1];
    second.name = "second";
    other.joints.push_back(second);
    for (MechanismJoint& at : other.joints)
      if (at.name == "ball" || at.name == "rail") at.closure = true;
    std::vector<SimbodyMechanism::BodyState> between;
    for (const Tree tree : {Tree::other, Tree::of_file}) {
      SimbodyMechanism loop(Mechanism(other), tree);
      Answers found = answersOf(loop);
      between.push_back(found.bodies.back());
      found.bodies.pop_back();
      expectAlike(found, expected, loop.tree());
      const std::string of_file = with_loads ? "cuts second" : "cuts rail";
      EXPECT_EQ(loop.tree(), tree == Tree::other ? "cuts cross with second" : of_file);
    }
    EXPECT_LT((between[0].twist - between[1].twist).norm(), 1e-12);
    EXPECT_LT((between[0].twist_rate - between[1].twist_rate).norm(), 1e-11);
  }
}

TEST(SimbodyMechanismRing, hasAnOpenChain) {
  MechanismParameters machine = loaded(sliderCrank());
  machine.joints.pop_back();
  machine.joints[2].kind = JointKind::revolute;
  machine.joints[1].kind = JointKind::prismatic;
  machine.joints[2].axis[0] = Vector3d(0, 1, 0);
  machine.motors = {"ball", "hinge", "cross"};
  SimbodyMechanism loop{Mechanism(machine)};
  EXPECT_EQ(loop.tree(), "cuts no joint");
  const MotorMotion motion{0, Eigen::Vector3d(1, 2, 0.3), Eigen::Vector3d(2, -1, 0.4), Eigen::Vector3d(3, 1, 2)};
  loop.place(motion);
  EXPECT_LT((loop.accelerations(loop.inverseDynamics()) - motion.qddot).norm(), 1e-12);
  EXPECT_LT((loop.motorRates() - motion.qdot).norm(), 1e-14);
  loop.project();
  EXPECT_EQ(loop.closure().position, 0);
}

TEST(SimbodyMechanismRing, leavesOutTheWeightOfWeightlessBodies) {
  MechanismParameters light = sliderCrank(), none = sliderCrank();
  for (MechanismBody& each : light.bodies) each.weightless = true;
  none.gravity.setZero();
  SimbodyMechanism a{Mechanism(light)}, b{Mechanism(none)};
  expectAlike(answersOf(a), answersOf(b), "weightless");
}

TEST(SimbodyMechanismRing, integratesToTheMotionThatItsEffortsCommand) {
  SimbodyMechanism loop{Mechanism(loaded(sliderCrank()))}, inverse{Mechanism(loaded(sliderCrank()))};
  loop.place(motionAt(0));
  std::vector<double> y = loop.state();
  const auto n = static_cast<Eigen::Index>(y.size());
  const auto rate = [&](double t, const Eigen::VectorXd& at) {
    inverse.place(motionAt(t));
    Eigen::VectorXd out(n);
    loop.derivative(t, at.data(), inverse.inverseDynamics(), out.data());
    return out;
  };
  Eigen::VectorXd x = Eigen::Map<Eigen::VectorXd>(y.data(), n);
  constexpr double h = 0.005;
  for (int i = 0; i < 100; ++i) {
    const double t = i * h;
    const Eigen::VectorXd a = rate(t, x), b = rate(t + h / 2, x + h / 2 * a), c = rate(t + h / 2, x + h / 2 * b),
                          d = rate(t + h, x + h * c);
    x += h / 6 * (a + 2 * b + 2 * c + d);
  }
  loop.setState(100 * h, x.data());
  EXPECT_NEAR(loop.motorCoordinates()(0), motionAt(100 * h).q(0), 1e-8);
  EXPECT_LT(loop.closure().position, 1e-8);
  loop.project();
  EXPECT_LT(loop.closure().position, 1e-15);
  EXPECT_LT(loop.closure().velocity, 1e-14);
}

/// A thin rod between two balls may spin about its own line, which nothing turns.
TEST(SimbodyMechanismRing, hasNoSpinOfARodBetweenBalls) {
  MechanismParameters machine = sliderCrank();
  const Vector3d B = machine.joints[1].centre, C = machine.joints[2].centre, line = (C - B).normalized();
  machine.joints[1].kind = JointKind::ball;
  MechanismBody& rod = machine.bodies[2];
  rod.center_of_mass = B + 0.4 * (C - B);
  for (const double along : {0.0, 1e-3}) {
    rod.inertia = 0.02 * (Matrix3d::Identity() - line * line.transpose()) + along * line * line.transpose();
    std::vector<Answers> found;
    for (const std::size_t cut : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
      MechanismParameters other = machine;
      std::swap(other.joints[cut], other.joints.back());
      SimbodyMechanism loop(Mechanism(other), Tree::of_file);
      EXPECT_FALSE(loop.usesSimbodysOwn());
      found.push_back(answersOf(loop));
      const SimbodyMechanism::BodyState& state = found.back().bodies[2];
      EXPECT_NEAR((state.displacement.linear() * line).dot(state.twist.head<3>()), 0, 1e-14);
      EXPECT_NEAR((state.displacement.linear() * line).dot(state.twist_rate.head<3>()), 0, 1e-12);
      expectAlike(found.back(), found.front(), loop.tree());
    }
  }
}

/// The rod is nearly along the second axis of its universal joint, so its tip reaches only a narrow belt.
TEST(SimbodyMechanismRing, refusesAMotionOutOfReachAndStaysWhereItWas) {
  MechanismParameters machine = sliderCrank();
  machine.joints[1].axis[1] = Vector3d(1, 0, 0);
  for (const Tree tree : {Tree::other, Tree::of_file}) {
    SimbodyMechanism loop(Mechanism(machine), tree);
    loop.place(motionAt(0.5));
    const Eigen::VectorXd before = loop.inverseDynamics();
    MotorMotion far = motionAt(1);
    far.q(0) = 0.6;
    EXPECT_THAT([&] { loop.place(far); },
                testing::ThrowsMessage<std::domain_error>(testing::HasSubstr("rail closes cannot follow the motors")));
    EXPECT_NEAR(loop.motorCoordinates()(0), motionAt(0.5).q(0), 1e-14);
    EXPECT_LT((loop.inverseDynamics() - before).norm(), 1e-12 * before.norm());
    loop.reset();
    loop.place(motionAt(0.5));
    EXPECT_LT((loop.inverseDynamics() - before).norm(), 1e-12 * before.norm());
  }
}

TEST(SimbodyMechanismRing, refusesAnInertiaThatNoBodyHas) {
  MechanismParameters machine = sliderCrank();
  machine.bodies[2].inertia = Vector3d(1, 1, 5).asDiagonal();
  EXPECT_THROW(SimbodyMechanism{Mechanism(machine)}, std::domain_error);
}

}  // namespace
}  // namespace ursula
