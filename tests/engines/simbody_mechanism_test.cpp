// Mechanisms of model files in Simbody, with two trees each, against reference vectors that were made without either.

#include "simbody/simbody_mechanism.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "base/csv.h"
#include "tests/engines/loop_rows.h"
#include "tests/support/idle_wheels.h"

namespace ursula {
namespace {

using Tree = SimbodyMechanism::Tree;

/// Rounding in some 50 coordinates, times a condition number below 1e2 of these machines.
constexpr double room = 1e-12;

double largestEffort(const std::vector<LoopRow>& rows) {
  double out = 0;
  for (const LoopRow& row : rows) out = std::max(out, row.efforts.cwiseAbs().maxCoeff());
  return out;
}

/// How far the state's derivative is off Simbody's own accelerations, relative to them.
double derivativeError(SimbodyMechanism& loop, const Eigen::VectorXd& efforts) {
  const std::vector<double> y = loop.state();
  std::vector<double> y_dot(y.size());
  loop.accelerations(efforts);
  const Eigen::VectorXd own = loop.openTree().u_dot;
  loop.derivative(0, y.data(), efforts, y_dot.data());
  return (Eigen::Map<const Eigen::VectorXd>(y_dot.data(), y_dot.size()).tail(own.size()) - own).norm() / own.norm();
}

double effortError(const Mechanism& mechanism, Tree tree, const std::vector<LoopRow>& rows) {
  SimbodyMechanism loop(mechanism, tree);
  double worst = 0;
  for (const LoopRow& row : rows) {
    loop.place(row.motion);
    worst = std::max(worst, (loop.inverseDynamics() - row.efforts).cwiseAbs().maxCoeff());
  }
  return worst / largestEffort(rows);
}

class LoopOfFile : public testing::TestWithParam<std::string> {
 protected:
  Mechanism mechanism_{loopMachine(GetParam())};
  std::vector<LoopRow> rows_ = loopRows(GetParam(), mechanism_.motorCount());
};

constexpr Tree trees[] = {Tree::other, Tree::of_file};

/// Wheels that nothing drives keep û·ω = 0: they have the efforts of welded ones without axial inertia.
TEST_P(LoopOfFile, holdsIdleWheelsAtRest) {
  MechanismParameters machine = loopMachine(GetParam());
  addWheels(machine, mechanism_.output());
  MechanismParameters welded = machine;
  weldWheels(welded);
  for (const Tree tree : trees) {
    SimbodyMechanism reference(Mechanism(welded), tree), loop(Mechanism(machine), tree);
    std::vector<LoopRow> rows = rows_;
    double moving = 0, spin = 0;
    for (LoopRow& row : rows) {
      reference.place(row.motion);
      row.efforts = reference.inverseDynamics();
      loop.place(row.motion);
      const SimbodyMechanism::BodyState wheel = loop.bodies().back();
      moving = std::max(moving, wheel.twist.head<3>().norm());
      spin = std::max(spin,
                      std::abs(wheel.twist.head<3>().dot(wheel.displacement.linear() * machine.joints.back().axis[0])));
    }
    EXPECT_LT(effortError(Mechanism(machine), tree, rows), 10 * room);
    EXPECT_TRUE(moving > 1e-3 || GetParam() == "delta") << moving;  // its plate only translates
    EXPECT_LT(spin, 1e-12);
    MechanismParameters wrong = machine;
    wrong.bodies.back().mass *= 1.01;
    EXPECT_GT(effortError(Mechanism(wrong), tree, rows), 1e3 * room);
  }
}

TEST_P(LoopOfFile, hasTheEffortsOfTheVectors) {
  for (const Tree tree : trees) {
    const double error = effortError(mechanism_, tree, rows_);
    std::cout << GetParam() << ": " << SimbodyMechanism(mechanism_, tree).tree() << ", efforts within " << error
              << " of the largest\n";
    EXPECT_LT(error, room);
  }
}

TEST_P(LoopOfFile, acceleratesAsCommandedUnderItsEfforts) {
  for (const Tree tree : trees) {
    SimbodyMechanism loop(mechanism_, tree);
    double worst = 0;
    for (const LoopRow& row : rows_) {
      loop.place(row.motion);
      const Eigen::VectorXd efforts = loop.inverseDynamics();
      const double scale = row.motion.qddot.norm();
      worst = std::max(worst, (loop.accelerations(efforts) - row.motion.qddot).norm() / scale);
      worst = std::max(worst, (loop.accelerationsByElimination(efforts) - row.motion.qddot).norm() / scale);
    }
    std::cout << GetParam() << (loop.usesSimbodysOwn() ? ", Simbody's own: " : ", eliminated: ") << worst << '\n';
    EXPECT_LT(worst, 10 * room);  // there and back
  }
}

TEST_P(LoopOfFile, hasTheDerivativeOfSimbodysOwnAccelerations) {
  for (const Tree tree : trees) {
    SimbodyMechanism loop(mechanism_, tree);
    for (const LoopRow& row : rows_) {
      loop.place(row.motion);
      EXPECT_LT(derivativeError(loop, 1.1 * row.efforts), 10 * room);
    }
  }
}

TEST_P(LoopOfFile, movesAllBodiesAlikeInBothTrees) {
  SimbodyMechanism one(mechanism_, Tree::other), two(mechanism_, Tree::of_file);
  for (const LoopRow& row : rows_) {
    one.place(row.motion);
    two.place(row.motion);
    EXPECT_LT(one.closure().position, 1e-14 * mechanism_.length());
    EXPECT_LT(one.closure().velocity, 1e-13);
    const auto a = one.bodies(), b = two.bodies();
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_LT((a[i].displacement.matrix() - b[i].displacement.matrix()).norm(), room) << mechanism_.bodies()[i].name;
      EXPECT_LT((a[i].twist - b[i].twist).norm(), 10 * room) << mechanism_.bodies()[i].name;
      EXPECT_LT((a[i].twist_rate - b[i].twist_rate).norm(), 100 * room) << mechanism_.bodies()[i].name;
    }
    const auto energy = one.energy(), other = two.energy();
    EXPECT_NEAR(energy.kinetic, other.kinetic, room);
    EXPECT_NEAR(energy.potential, other.potential, 10 * room);
  }
}

TEST_P(LoopOfFile, cutsOtherJointsThanTheFile) {
  const auto own = SimbodyMechanism(mechanism_, Tree::other).cutJoints();
  const auto of_file = SimbodyMechanism(mechanism_, Tree::of_file).cutJoints();
  EXPECT_NE(own, of_file);
  for (const std::size_t j : of_file) EXPECT_TRUE(mechanism_.joints()[j].closure);
  for (const std::size_t j : own) EXPECT_FALSE(mechanism_.joints()[j].closure);
}

TEST_P(LoopOfFile, seesAMassThatIsWrongByOneInTenThousand) {
  MechanismParameters wrong = mechanism_.parameters();
  const auto heaviest = std::max_element(wrong.bodies.begin(), wrong.bodies.end(),
                                         [](const auto& a, const auto& b) { return a.mass < b.mass; });
  heaviest->mass *= 1 + 1e-4;
  EXPECT_GT(effortError(Mechanism(wrong), Tree::other, rows_), 1e4 * room);
}

INSTANTIATE_TEST_SUITE_P(Files, LoopOfFile, testing::Values("fourbar", "planar3rrr", "ankle", "delta"),
                         [](const auto& each) { return each.param; });

/// Hinges close a planar loop with three equations too many, and change nothing.
TEST(LoopsOfFiles, areTheSameIfHingesCloseAPlanarLoop) {
  for (const char* name : {"fourbar", "planar3rrr"}) {
    MechanismParameters machine = loopMachine(name);
    const std::vector<LoopRow> rows = loopRows(name, machine.motors.size());
    for (MechanismJoint& joint : machine.joints)
      if (joint.closure) {
        joint.kind = JointKind::revolute;
        joint.axis[0] = machine.joints[0].axis[0];
      }
    for (const Tree tree : trees) {
      EXPECT_LT(effortError(Mechanism(machine), tree, rows), room);
      SimbodyMechanism loop(Mechanism(machine), tree);
      EXPECT_TRUE(loop.usesSimbodysOwn());
      for (const LoopRow& row : rows) {
        loop.place(row.motion);
        EXPECT_LT((loop.accelerations(row.efforts) - row.motion.qddot).norm(), 10 * room * row.motion.qddot.norm());
        EXPECT_LT(derivativeError(loop, row.efforts), 10 * room);
      }
    }
  }
}

}  // namespace
}  // namespace ursula
