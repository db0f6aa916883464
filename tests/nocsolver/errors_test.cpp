// Poses at which the formulas fail are refused with their type, leg, instant and number; poses next to them are not.

#include "nocsolver/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "parts/fast/solver.h"
#include "tests/support/matchers.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

constexpr int odd = 3;  ///< the changed leg, which is leg 4 for people
constexpr double instant = 1.25;

/// The paper's machine with a level platform at z = 0.9 m and one different leg. That leg stands along +z of B below
/// its platform point, with its actuated axis along +x, so that every number of its triangle is a double.
struct Case {
  Case(const Vector3d& AB, double l, double s) {
    const Scenario scenario = vectorScenario("paper-helix");
    parameters = scenario.manipulator->parameters();
    motion.t = instant;
    motion.p = {0, 0, 0.9};
    motion.omega = {0.1, 0.2, 0.3};
    motion.p_dot = {0.3, 0.2, 0.1};
    Leg& leg = parameters.legs[odd];
    leg.platform_point = {1, 0.5, 0.1};
    leg.base_point = leg.platform_point + motion.p - AB;
    leg.base_axis = {1, 0, 0};
    leg.proximal.length = l;
    leg.distal.length = s;
  }
  ManipulatorParameters parameters;
  Motion<double> motion;
};

/// The E that `call` throws.
template <class E, class F>
std::optional<E> thrown(F&& call) {
  try {
    call();
  } catch (const E& error) {
    return error;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another type: " << error.what();
  }
  return std::nullopt;
}

template <class E>
std::optional<E> refusalOf(const Case& at) {
  const Noc<double> solver{Manipulator(at.parameters)};
  NocWorkspace<double> work;
  return thrown<E>([&] { solver.inverseDynamics(at.motion, work); });
}

template <class E>
void expectNamed(const std::optional<E>& error, double measure, double bound, const std::string& what) {
  ASSERT_TRUE(error.has_value()) << "nothing thrown";
  EXPECT_EQ(error->leg(), odd);
  EXPECT_EQ(error->instant(), instant);
  EXPECT_NEAR(error->measure(), measure, 1e-15);
  EXPECT_NEAR(error->bound(), bound, 1e-15 + 1e-9 * bound);
  EXPECT_THAT(error->what(), HasSubstr("leg 4"));
  EXPECT_THAT(error->what(), HasSubstr("t = 1.25 s"));
  EXPECT_THAT(error->what(), HasSubstr(what));
}

const double root_eps = std::sqrt(Eigen::NumTraits<double>::epsilon());

TEST(OutOfReach, tooFar) { expectNamed(refusalOf<OutOfReach>(Case({0, 0, 2}, 0.75, 1.0)), 2, 1.75, "is out of reach"); }

TEST(OutOfReach, tooNear) {
  expectNamed(refusalOf<OutOfReach>(Case({0, 0, 0.5}, 2.0, 1.0)), 0.5, 1, "is out of reach");
}

TEST(OutOfReach, displacementsRefuseToo) {
  const Case at({0, 0, 2}, 0.75, 1.0);
  const Noc<double> solver{Manipulator(at.parameters)};
  NocWorkspace<double> work;
  EXPECT_THROW(solver.displacements(at.motion, work), OutOfReach);
  EXPECT_THROW(solver.directDynamics(at.motion, Vector6d::Zero(), work), OutOfReach);
}

TEST(OutOfReach, notANumberReachesNothing) {
  Case at({0, 0, 2}, 1.5, 1.0);
  at.motion.p.x() = std::nan("");
  const Noc<double> solver{Manipulator(at.parameters)};
  NocWorkspace<double> work;
  EXPECT_THROW(solver.inverseDynamics(at.motion, work), PoseError);
}

TEST(StretchedLeg, stretched) {
  expectNamed(refusalOf<StretchedLeg>(Case({0, 0, 2}, 1.25, 0.75)), 0, root_eps, "|sin theta|");
}

TEST(StretchedLeg, folded) {
  expectNamed(refusalOf<StretchedLeg>(Case({0, 0, 0.5}, 1.5, 1.0)), 0, root_eps, "|sin theta|");
}

TEST(StretchedLeg, hasDisplacementsYet) {
  const Case at({0, 0, 2}, 1.25, 0.75);
  const Noc<double> solver{Manipulator(at.parameters)};
  NocWorkspace<double> work;
  EXPECT_NO_THROW(solver.displacements(at.motion, work));
  EXPECT_NEAR(solver.angles(work).theta(odd), 3.14159265358979323846, 1e-15);
}

TEST(StretchedLeg, nextToItIsNone) {
  EXPECT_FALSE(refusalOf<StretchedLeg>(Case({0, 0, 2}, 1.25, 0.75 + 1e-14)));
  EXPECT_FALSE(refusalOf<StretchedLeg>(Case({0, 0, 0.5}, 1.5 - 1e-14, 1.0)));
  EXPECT_TRUE(refusalOf<OutOfReach>(Case({0, 0, 2}, 1.25, 0.75 - 1e-14)));
}

TEST(PointOnAxis, onIt) {
  expectNamed(refusalOf<PointOnAxis>(Case({2, 0, 0}, 1.5, 1.0)), 0, 2.5 * root_eps, "has B on its axis");
}

TEST(PointOnAxis, nextToItIsNone) {
  EXPECT_FALSE(refusalOf<PointOnAxis>(Case({2, 0, 1e-6}, 1.5, 1.0)));
  EXPECT_TRUE(refusalOf<PointOnAxis>(Case({2, 0, 1e-8}, 1.5, 1.0)));
}

/// Two equal legs, which give two equal rows of B.
Case twoEqualLegs(double difference) {
  Case at({0, 0, 2}, 1.5, 1.0);
  at.parameters.legs[odd + 1] = at.parameters.legs[odd];
  at.parameters.legs[odd + 1].base_axis.y() += difference;
  return at;
}

TEST(SingularJacobian, namesItsPivots) {
  const auto error = refusalOf<SingularJacobian>(twoEqualLegs(0));
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->leg(), -1);
  EXPECT_EQ(error->instant(), instant);
  EXPECT_LE(error->measure(), error->bound());
  EXPECT_EQ(error->bound(), 16 * Eigen::NumTraits<double>::epsilon());
  EXPECT_THAT(error->what(), HasSubstr("B is singular"));
  EXPECT_THAT(error->what(), HasSubstr("t = 1.25 s"));
}

TEST(SingularJacobian, nextToItIsNone) { EXPECT_FALSE(refusalOf<SingularJacobian>(twoEqualLegs(1e-6))); }

/// Torques act at a singular pose, too, although (36), in the rates of the motors, has no answer there.
TEST(SingularJacobian, doesNotHinderDirectDynamics) {
  const Case at = twoEqualLegs(0);
  const Manipulator machine(at.parameters);
  const Noc<double> solver{machine};
  NocWorkspace<double> work;
  EXPECT_TRUE(Solver<double>(machine).directDynamics(at.motion, Vector6d::Ones(), work).allFinite());
  EXPECT_THROW(solver.directDynamics(at.motion, Vector6d::Ones(), work), SingularJacobian);
  EXPECT_NO_THROW(solver.inverseKinematics(at.motion, work));
  EXPECT_THROW(solver.jacobians(at.motion, work), SingularJacobian);
}

/// Control: the cases' machine is good.
TEST(GoodPose, isTaken) {
  const Case at({0, 0, 2}, 1.5, 1.0);
  const Noc<double> solver{Manipulator(at.parameters)};
  NocWorkspace<double> work;
  EXPECT_TRUE(solver.inverseDynamics(at.motion, work).allFinite());
}

}  // namespace
}  // namespace ursula
