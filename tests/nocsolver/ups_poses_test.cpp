// All poses of a Stewart–Gough platform: found from their lengths, counted, and compared with published machines.

#include <gtest/gtest.h>

#include "model/scenario.h"
#include "parts/fast/solver.h"
#include "tests/nocsolver/ups_poses_cases.h"

namespace ursula {
namespace {

using namespace ups_cases;

void expectFound(const Case& made, int counted, int at_infinity) {
  const UpsPoses poses = made.poses();
  EXPECT_EQ(poses.counted, counted);
  EXPECT_EQ(poses.at_infinity, at_infinity);
  EXPECT_LE(nearest(poses, made.at), expectedError(made));
  EXPECT_LE(largestResidual(poses), 64 * eps);
  EXPECT_EQ(real(poses) % 2, 0) << "complex ones come in pairs, and there are 40";
}

TEST(UpsPoses, FindsThePoseAgainForManyMachines) {
  for (unsigned seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    expectFound(thrown(seed), 40, 0);
  }
}

/// Mirroring at the base's plane, and of the platform at its own, turns a pose into another one.
TEST(UpsPoses, OfPlanarMachinesComeInMirroredPairs) {
  const Matrix3d mirror = Vector3d(1, 1, -1).asDiagonal();
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const Case made = thrown(1000 + seed, true);
    expectFound(made, 40, 0);
    const UpsPoses poses = made.poses();
    for (const UpsPose& pose : poses.list) EXPECT_LE(nearest(poses, {mirror * pose.p, mirror * pose.Q * mirror}), 1e-8);
  }
}

TEST(UpsPoses, DoNotHaveThePoseOfOtherLengths) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const Case made = thrown(2000 + seed);
    Vector6d lengths = made.machine.lengths(made.at);
    lengths(seed % 6) += 1e-3;
    const UpsPoses poses = upsPoses(made.machine.a, made.machine.b, lengths);
    EXPECT_EQ(poses.counted, 40);
    EXPECT_GE(nearest(poses, made.at), 1e-4);  // legs change no faster than √2 times this, and by 1e-3
  }
}

/// P. Dietmaier, "The Stewart–Gough platform of general geometry can have 40 real postures", ARK 1998: to the six
/// digits printed, as quoted in the documentation of the CUIK suite ("Dietmeier.world") and in Drake's tests of inverse
/// kinematics with mixed integers.
TEST(UpsPoses, OfDietmaiersMachineAreFortyAndReal) {
  const Points a = {Vector3d(0, 0, 0),
                    Vector3d(1.107915, 0, 0),
                    Vector3d(0.549094, 0.756063, 0),
                    Vector3d(0.735077, -0.223935, 0.525991),
                    Vector3d(0.514188, -0.526063, -0.368418),
                    Vector3d(0.590473, 0.094733, -0.205018)};
  const Points b = {Vector3d(0, 0, 0),
                    Vector3d(0.542805, 0, 0),
                    Vector3d(0.956919, -0.528915, 0),
                    Vector3d(0.665885, -0.353482, 1.402538),
                    Vector3d(0.478359, 1.158742, 0.107672),
                    Vector3d(-0.137087, -0.235121, 0.353913)};
  Vector6d lengths;
  lengths << 1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071;
  const UpsPoses poses = upsPoses(a, b, lengths);
  ASSERT_EQ(poses.list.size(), 40U);
  EXPECT_EQ(poses.counted, 40);
  EXPECT_LE(largestResidual(poses), 16 * eps);
  double apart = 1;
  for (const UpsPose& one : poses.list) {
    EXPECT_EQ(one.multiplicity, 1);
    EXPECT_LE((one.Q.transpose() * one.Q - Matrix3d::Identity()).norm(), 16 * eps);
    EXPECT_LE((Eigen::Quaterniond(one.q(0), one.q(1), one.q(2), one.q(3)).toRotationMatrix() - one.Q).norm(), 16 * eps);
    EXPECT_GE(one.q(0), 0);
    for (const UpsPose& other : poses.list)
      if (&one != &other) apart = std::min(apart, distance(one, {other.p, other.Q}));
  }
  EXPECT_GE(apart, 0.01);
}

/// A 3–3 machine, with joints in pairs, has 16 poses (Nanua, Waldron and Murthy 1990: eight and their mirror images).
TEST(UpsPoses, OfOctahedralMachinesAreSixteen) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Case made = thrown(3000 + seed, true);
    Points &a = made.machine.a, &b = made.machine.b;
    for (std::size_t i = 0; i < 6; i += 2) {
      a[i + 1] = a[i];
      b[i] = b[(i + 5) % 6];
    }
    expectFound(made, 16, 24);
  }
}

/// A 3–2–1 machine intersects three spheres, then two, then one, which gives 2 · 2 · 2 poses. It has infinitely many
/// solutions at infinity, so paths are tracked.
TEST(UpsPoses, OfThreeTwoOneMachinesAreEight) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    Case made = thrown(4000 + seed);
    Points& b = made.machine.b;
    b[1] = b[2] = b[0];
    b[4] = b[3];
    expectFound(made, 8, 32);
  }
}

/// Two level semi-regular hexagons, as in many simulators, at their most symmetrical pose.
TEST(UpsPoses, OfASimulatorAtHome) {
  Case made;
  made.at = {Vector3d(0, 0, 1.2), Matrix3d::Identity()};
  const double pi = std::acos(-1.0);
  for (std::size_t i = 0; i < 6; ++i) {
    const double sector = static_cast<double>(i / 2) * 2 * pi / 3, side = i % 2 == 0 ? -1 : 1;
    const double at_base = sector + side * 0.2, on_platform = sector + side * (pi / 3 - 0.15);
    made.machine.a[i] = 1.5 * Vector3d(std::cos(at_base), std::sin(at_base), 0);
    made.machine.b[i] = Vector3d(std::cos(on_platform), std::sin(on_platform), 0);
  }
  expectFound(made, 28, 12);
}

TEST(UpsPoses, AreNoneWhereTheLegsAreTooShort) {
  const Case made = thrown(6000);
  const UpsPoses poses = upsPoses(made.machine.a, made.machine.b, Vector6d::Constant(1e-3));
  EXPECT_EQ(poses.counted, 40);
  EXPECT_TRUE(poses.list.empty());
}

TEST(UpsPoses, AreTheSameEveryTime) {
  const Case made = thrown(6001);
  const UpsPoses first = made.poses(), second = made.poses();
  ASSERT_EQ(first.list.size(), second.list.size());
  for (std::size_t i = 0; i < first.list.size(); ++i) {
    EXPECT_EQ(first.list[i].p, second.list[i].p);
    EXPECT_EQ(first.list[i].Q, second.list[i].Q);
  }
}

/// The unit of length and the frames are the user's choice.
TEST(UpsPoses, DoNotDependOnUnitsAndOrigins) {
  Case made = thrown(6002);
  const std::size_t before = made.poses().list.size();
  const double unit = 1000;
  const Vector3d origin(5, -3, 2);
  for (Vector3d& point : made.machine.a) point = unit * (point + origin);
  for (Vector3d& point : made.machine.b) point *= unit;
  made.at.p = unit * (made.at.p + origin);
  const UpsPoses poses = made.poses();
  EXPECT_EQ(poses.counted, 40);
  EXPECT_EQ(poses.list.size(), before);
  EXPECT_LE(nearest(poses, made.at), unit * expectedError(thrown(6002)) * origin.norm());
}

Vector6d drivenAt(const Manipulator& machine, const Motion<double>& motion) {
  const Solver<double> solver(machine);
  Workspace<double> work;
  solver.inverseKinematics(motion, work);
  const JointVariables<double> joints = solver.angles(work);
  Vector6d out;
  for (int i = 0; i < leg_count; ++i) {
    const LegKindRow& row = rowOf(machine.leg(i).kind);
    out(i) = joints.of(row.coordinates[row.actuated])(i);
  }
  return out;
}

/// Legs of RUS, PUS and UPS under one platform: the mixture without its URS legs.
Manipulator mixedMachine(const Scenario& mixture) {
  ManipulatorParameters machine = mixture.manipulator->parameters();
  const Motion<double> motion = mixture.trajectory->at(0);
  for (Leg& leg : machine.legs)
    if (leg.kind == LegKind::URS) {
      const double d = (motion.p + motion.Q * leg.platform_point - leg.base_point).norm();
      leg.kind = LegKind::UPS;
      leg.actuated = {false, false, true};
      leg.distal.length = 0.6 * d;
      leg.proximal.length = 0.8 * d;
    }
  return Manipulator(machine);
}

void expectFoundAgain(const Manipulator& machine, const Motion<double>& motion) {
  ASSERT_TRUE(tipsAreOnSpheres(machine));
  const Vector6d driven = drivenAt(machine, motion);
  const UpsPoses poses = upsPoses(machine, driven);
  EXPECT_TRUE(poses.complete());
  const auto apart = [&](const UpsPose& pose) { return distance(pose, {motion.p, motion.Q}); };
  const auto nearest = std::min_element(poses.list.begin(), poses.list.end(),
                                        [&](const UpsPose& a, const UpsPose& b) { return apart(a) < apart(b); });
  ASSERT_NE(nearest, poses.list.end());
  EXPECT_LE(apart(*nearest), 1e-10);
  for (int i = 0; i < leg_count; ++i) {
    Leg leg = machine.leg(i);
    EXPECT_TRUE(isOnItsBranch(leg, driven(i), *nearest)) << i;
    leg.knee = leg.knee == Knee::positive ? Knee::negative : Knee::positive;
    EXPECT_EQ(isOnItsBranch(leg, driven(i), *nearest), leg.kind == LegKind::UPS) << i;
  }
}

TEST(UpsPoses, AreThoseOfCranksAndCarriagesToo) {
  for (const char* name : {"hexa", "hexaglide", "flight-simulator"}) {
    SCOPED_TRACE(name);
    const Scenario scenario = readScenario(std::string(URSULA_SCENARIOS) + "/" + name + ".toml");
    for (const double share : {0.1, 0.5, 0.9})
      expectFoundAgain(*scenario.manipulator, scenario.trajectory->at(share * scenario.trajectory->duration()));
  }
  const Scenario mixture = readScenario(URSULA_SCENARIOS "/mixture.toml");
  EXPECT_FALSE(tipsAreOnSpheres(*mixture.manipulator));
  expectFoundAgain(mixedMachine(mixture), mixture.trajectory->at(0));
}

TEST(UpsPoses, RefuseWhatIsNoMachine) {
  const Case made = thrown(7001);
  const Vector6d lengths = made.machine.lengths(made.at);
  Vector6d negative = lengths, no_number = lengths;
  negative(3) = -0.1;
  no_number(2) = std::numeric_limits<double>::quiet_NaN();
  Points a = made.machine.a;
  a[4].y() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(upsPoses(made.machine.a, made.machine.b, negative), std::invalid_argument);
  EXPECT_THROW(upsPoses(made.machine.a, made.machine.b, no_number), std::invalid_argument);
  EXPECT_THROW(upsPoses(a, made.machine.b, lengths), std::invalid_argument);
  EXPECT_NO_THROW(upsPoses(made.machine.a, made.machine.b, lengths));
}

}  // namespace
}  // namespace ursula
