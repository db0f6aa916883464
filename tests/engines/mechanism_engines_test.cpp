// Mechanisms in maximal coordinates and in MuJoCo, against reference vectors that were made without either.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <type_traits>
#include <vector>

#include "base/csv.h"
#include "parts/engines/closed_mechanism.h"
#include "parts/engines/voting_engines.h"
#include "tests/engines/loop_rows.h"
#include "tests/support/idle_wheels.h"

namespace ursula {
namespace {

struct Maximal {
  static constexpr BuildTree* build = buildMaximal;
};
struct Mujoco {
  static constexpr BuildTree* build = buildMujoco;
};

/// Rounding in some 100 constraints, times a condition number below 1e2 of these machines.
constexpr double room = 1e-11;

/// The largest error of efforts, relative to the largest effort.
template <class AnEngine>
double errorOf(const MechanismParameters& machine, const std::vector<LoopRow>& rows) {
  ClosedMechanism engine(Mechanism(machine), AnEngine::build);
  double worst = 0, largest = 0;
  for (const LoopRow& row : rows) {
    const Eigen::VectorXd difference = engine.inverseDynamics(row.motion) - row.efforts;
    worst = std::max(worst, difference.cwiseAbs().maxCoeff());
    largest = std::max(largest, row.efforts.cwiseAbs().maxCoeff());
  }
  return worst / largest;
}

template <class AnEngine>
class MechanismEngines : public testing::Test {
 protected:
  void SetUp() override {
    if (std::is_same_v<AnEngine, Mujoco> && !mujocoAvailable()) GTEST_SKIP() << "without MuJoCo";
  }
};
using AllEngines = testing::Types<Maximal, Mujoco>;
TYPED_TEST_SUITE(MechanismEngines, AllEngines);

constexpr const char* machines[] = {"fourbar", "planar3rrr", "ankle", "delta"};

TYPED_TEST(MechanismEngines, haveTheEffortsOfTheVectors) {
  for (const char* name : machines) {
    const MechanismParameters machine = loopMachine(name);
    const double error = errorOf<TypeParam>(machine, loopRows(name, machine.motors.size()));
    std::cout << name << ": within " << error << " of the largest effort\n";
    EXPECT_LT(error, room) << name;
  }
}

TYPED_TEST(MechanismEngines, seeAMassThatIsWrongByOneInTenThousand) {
  for (const char* name : machines) {
    MechanismParameters machine = loopMachine(name);
    const auto heaviest = std::max_element(machine.bodies.begin(), machine.bodies.end(),
                                           [](const auto& a, const auto& b) { return a.mass < b.mass; });
    heaviest->mass *= 1 + 1e-4;
    EXPECT_GT(errorOf<TypeParam>(machine, loopRows(name, machine.motors.size())), 1e4 * room) << name;
  }
}

/// Hinges close a planar loop with three equations too many, and change nothing.
TYPED_TEST(MechanismEngines, takeRedundantClosures) {
  for (const char* name : {"fourbar", "planar3rrr"}) {
    MechanismParameters machine = loopMachine(name);
    for (MechanismJoint& joint : machine.joints)
      if (joint.closure) {
        joint.kind = JointKind::revolute;
        joint.axis[0] = machine.joints[0].axis[0];
      }
    EXPECT_LT(errorOf<TypeParam>(machine, loopRows(name, machine.motors.size())), room) << name;
  }
}

/// Wheels that nothing drives keep û·ω = 0: they have the efforts of welded ones without axial inertia.
TYPED_TEST(MechanismEngines, holdIdleWheelsAtRest) {
  for (const char* name : machines) {
    MechanismParameters machine = loopMachine(name);
    addWheels(machine, Mechanism(machine).output());
    MechanismParameters welded = machine;
    weldWheels(welded);
    std::vector<LoopRow> rows = loopRows(name, machine.motors.size());
    ClosedMechanism reference{Mechanism(welded), TypeParam::build};
    for (LoopRow& row : rows) row.efforts = reference.inverseDynamics(row.motion);
    EXPECT_LT(errorOf<TypeParam>(machine, rows), room) << name;
    machine.bodies.back().mass *= 1.01;
    EXPECT_GT(errorOf<TypeParam>(machine, rows), 1e2 * room) << name;
  }
}

/// The same joints, read from the other end.
TYPED_TEST(MechanismEngines, doNotDependOnParentsAndChildren) {
  for (const char* name : machines) {
    MechanismParameters machine = loopMachine(name);
    for (MechanismJoint& joint : machine.joints) {
      if (joint.kind != JointKind::revolute || joint.closure) continue;
      std::swap(joint.parent, joint.child);
      joint.axis[0] *= -1;
    }
    EXPECT_LT(errorOf<TypeParam>(machine, loopRows(name, machine.motors.size())), room) << name;
  }
}

}  // namespace
}  // namespace ursula
