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
#include "parts/engines/maximal/maximal_mechanism.h"
#include "parts/engines/mujoco/mujoco_mechanism.h"
#include "parts/engines/voting_engines.h"
#include "parts/exchange/import.h"

namespace ursula {
namespace {

/// Rounding in some 100 constraints, times a condition number below 1e2 of these machines.
constexpr double room = 1e-11;

MechanismParameters machineOf(const std::string& name) {
  return exchange::readModel(std::string(URSULA_VECTORS) + "/loops/" + name + ".xml");
}

/// One row of NAME.csv.
struct VectorRow {
  MotorMotion motion;
  Eigen::VectorXd efforts;
};

std::vector<VectorRow> vectorsOf(const std::string& name, std::size_t motors) {
  const CsvTable table = readCsv(std::string(URSULA_VECTORS) + "/loops/" + name + ".csv");
  std::vector<VectorRow> out(table.rows());
  for (std::size_t row = 0; row < out.size(); ++row) {
    const auto read = [&](const char* what, const char* unit) {
      Eigen::VectorXd numbers(static_cast<Eigen::Index>(motors));
      for (std::size_t k = 0; k < motors; ++k)
        numbers(static_cast<Eigen::Index>(k)) = table.at(what + std::to_string(k + 1) + unit)[row];
      return numbers;
    };
    out[row].motion = {table.at("t_s")[row], read("q_", "_rad"), read("qdot_", "_rad_s"), read("qddot_", "_rad_s2")};
    out[row].efforts = read("tau_", "_Nm");
  }
  return out;
}

/// The largest error of efforts, relative to the largest effort.
template <class AnEngine>
double errorOf(const MechanismParameters& machine, const std::vector<VectorRow>& rows) {
  AnEngine engine{Mechanism(machine)};
  double worst = 0, largest = 0;
  for (const VectorRow& row : rows) {
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
    if (std::is_same_v<AnEngine, MujocoMechanism> && !mujocoAvailable()) GTEST_SKIP() << "without MuJoCo";
  }
};
using AllEngines = testing::Types<MaximalMechanism, MujocoMechanism>;
TYPED_TEST_SUITE(MechanismEngines, AllEngines);

constexpr const char* machines[] = {"fourbar", "planar3rrr", "ankle", "delta"};

TYPED_TEST(MechanismEngines, haveTheEffortsOfTheVectors) {
  for (const char* name : machines) {
    const MechanismParameters machine = machineOf(name);
    const double error = errorOf<TypeParam>(machine, vectorsOf(name, machine.motors.size()));
    std::cout << name << ": within " << error << " of the largest effort\n";
    EXPECT_LT(error, room) << name;
  }
}

TYPED_TEST(MechanismEngines, seeAMassThatIsWrongByOneInTenThousand) {
  for (const char* name : machines) {
    MechanismParameters machine = machineOf(name);
    const auto heaviest = std::max_element(machine.bodies.begin(), machine.bodies.end(),
                                           [](const auto& a, const auto& b) { return a.mass < b.mass; });
    heaviest->mass *= 1 + 1e-4;
    EXPECT_GT(errorOf<TypeParam>(machine, vectorsOf(name, machine.motors.size())), 1e4 * room) << name;
  }
}

/// Hinges close a planar loop with three equations too many, and change nothing.
TYPED_TEST(MechanismEngines, takeRedundantClosures) {
  for (const char* name : {"fourbar", "planar3rrr"}) {
    MechanismParameters machine = machineOf(name);
    for (MechanismJoint& joint : machine.joints)
      if (joint.closure) {
        joint.kind = JointKind::revolute;
        joint.axis[0] = machine.joints[0].axis[0];
      }
    EXPECT_LT(errorOf<TypeParam>(machine, vectorsOf(name, machine.motors.size())), room) << name;
  }
}

/// The same joints, read from the other end.
TYPED_TEST(MechanismEngines, doNotDependOnParentsAndChildren) {
  for (const char* name : machines) {
    MechanismParameters machine = machineOf(name);
    for (MechanismJoint& joint : machine.joints) {
      if (joint.kind != JointKind::revolute || joint.closure) continue;
      std::swap(joint.parent, joint.child);
      joint.axis[0] *= -1;
    }
    EXPECT_LT(errorOf<TypeParam>(machine, vectorsOf(name, machine.motors.size())), room) << name;
  }
}

}  // namespace
}  // namespace ursula
