// Waypoints and hold: derivatives against differences of the pose in 50 digits, smoothness at the knots, and refusals.

#include "model/trajectories/trajectories.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/real50.h"
#include "tests/model/derivatives.h"
#include "tests/model/refusals.h"
#include "tests/support/matchers.h"
#include "tests/support/numbers.h"

namespace ursula {
namespace {

using testing::FieldsAre;

Eigen::Vector4d turn(double angle, const Vector3d& axis) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, axis.normalized()));
  return {q.w(), q.x(), q.y(), q.z()};
}

/// Four poses with uneven times, turns about changing axes, and one quaternion of the other sign.
std::vector<TimedPose> fourPoints() {
  return {{0.0, {0.0, 0.0, 0.8}, turn(0.0, {0, 0, 1})},
          {0.9, {0.1, -0.2, 1.0}, turn(0.7, {1, 0.2, 0})},
          {1.4, {0.3, -0.1, 1.1}, -turn(1.1, {0.3, 1, -0.4})},
          {3.0, {0.0, 0.1, 0.9}, turn(-0.3, {0, 0, 1})}};
}

Matrix3<Real50> rotation(const Eigen::Vector4d& q) {
  const Eigen::Matrix<Real50, 4, 1> r = q.cast<Real50>();
  return Eigen::Quaternion<Real50>(r(0), r(1), r(2), r(3)).normalized().toRotationMatrix();
}

TEST(Waypoints, haveExactDerivatives) {
  const auto motion = makeWaypoints(fourPoints());
  EXPECT_LE(derivativeMismatch(*motion, instantsInside(3.0, 60)).worst(), difference_tolerance);
  using Part = Falsified::Part;
  for (const Part part : {Part::omega, Part::omega_dot, Part::p_dot, Part::p_ddot})
    EXPECT_GT(derivativeMismatch(Falsified(*motion, part, 1e-15), instantsInside(3.0, 60)).worst(), 5e-16);
}

TEST(Waypoints, passThroughEveryPoint) {
  const auto motion = makeWaypoints(fourPoints());
  EXPECT_EQ(motion->kind(), "waypoints");
  EXPECT_EQ(motion->duration(), 3.0);
  for (const TimedPose& point : fourPoints()) {
    const Motion<Real50> exact = motion->at(Real50(point.time));
    EXPECT_LE((exact.p - point.position.cast<Real50>()).norm().convert_to<double>(), 1e-45);
    EXPECT_LE((exact.Q - rotation(point.orientation)).norm().convert_to<double>(), 1e-45);
    const Motion<double> rounded = motion->at(point.time);
    EXPECT_LE((rounded.p - point.position).norm(), 64 * eps);
    EXPECT_LE((rounded.Q.cast<Real50>() - rotation(point.orientation)).norm().convert_to<double>(), 64 * eps);
  }
}

TEST(Waypoints, areAtRestAtBothEndsAndNowhereBetween) {
  const auto motion = makeWaypoints(fourPoints());
  for (const double t : {0.0, 3.0}) {
    const Motion<Real50> end = motion->at(Real50(t));
    EXPECT_LE((end.p_dot.norm() + end.omega.norm()).convert_to<double>(), 1e-44);
    EXPECT_LE((end.p_ddot.norm() + end.omega_dot.norm()).convert_to<double>(), 1e-44);
  }
  for (const double t : {0.9, 1.4}) {
    EXPECT_GT(motion->at(t).p_dot.norm(), 0.01);
    EXPECT_GT(motion->at(t).omega.norm(), 0.01);
  }
}

/// One-sided second differences of the accelerations, which are fourth derivatives from the left and from the right.
template <class Part>
double fourthDerivativeJump(const Trajectory& motion, double knot, Part part, double& size) {
  const Real50 t(knot), h("1e-12");
  const auto at = [&](int k) { return part(motion.at(Real50(t + k * h))); };
  const Vector3<Real50> right = (at(2) - 2 * at(1) + at(0)) / (h * h);
  const Vector3<Real50> left = (at(-2) - 2 * at(-1) + at(0)) / (h * h);
  size = right.norm().convert_to<double>();
  return (right - left).norm().convert_to<double>();
}

TEST(Waypoints, areFourTimesContinuouslyDifferentiableAtTheKnots) {
  const auto motion = makeWaypoints(fourPoints());
  for (const double knot : {0.9, 1.4}) {
    const Real50 t(knot), h("1e-30");
    const Motion<Real50> before = motion->at(Real50(t - h)), after = motion->at(Real50(t + h));
    EXPECT_GT(before.p_ddot.norm(), 0.01);
    EXPECT_LE((before.p_ddot - after.p_ddot).norm().convert_to<double>(), 1e-24);
    EXPECT_LE((before.omega_dot - after.omega_dot).norm().convert_to<double>(), 1e-24);
    // The one-sided differences are off by 2 h times the fifth derivative of the motion, some 1e4.
    double size = 0;
    EXPECT_LE(fourthDerivativeJump(
                  *motion, knot, [](const auto& m) { return m.p_ddot; }, size),
              1e-7);
    EXPECT_GT(size, 0.1);
    EXPECT_LE(fourthDerivativeJump(
                  *motion, knot, [](const auto& m) { return m.omega_dot; }, size),
              1e-7);
    EXPECT_GT(size, 0.1);
  }
}

TEST(Waypoints, inDoubleAreTheExactOnesRounded) {
  const auto motion = makeWaypoints(fourPoints());
  // The shortest piece lasts 0.5 s. In an acceleration, coefficients of s⁵ have the factor 20 / 0.25 and six roundings
  // each.
  EXPECT_LE(roundingError(*motion, instantsInside(3.0, 200)), 480 * eps);
  for (const double t : instantsInside(3.0, 50)) EXPECT_LE(orthonormalityError(motion->at(t).Q), 16 * eps);
}

TEST(Waypoints, fromRestToRestAreTheQuinticOfTheAppendix) {
  const auto motion = makeWaypoints({{0, {0, 0, 1}, {1, 0, 0, 0}}, {2, {1, 0, 1}, {1, 0, 0, 0}}});
  for (const double s : {0.1, 0.37, 0.5, 0.93}) {
    const double expected = s * s * s * (10 + s * (-15 + 6 * s));
    EXPECT_NEAR(motion->at(2 * s).p.x(), expected, 16 * eps);
    EXPECT_EQ(motion->at(2 * s).omega.norm(), 0);
  }
}

TEST(Waypoints, takeTheShortWayRoundWhateverTheSignOfTheQuaternion) {
  const auto points = [](double sign) {
    return std::vector<TimedPose>{{0, {0, 0, 1}, {1, 0, 0, 0}}, {1, {0, 0, 1}, sign * turn(0.6, {0, 0, 1})}};
  };
  const auto plus = makeWaypoints(points(1)), minus = makeWaypoints(points(-1));
  EXPECT_EQ(plus->at(0.4).Q, minus->at(0.4).Q);
  EXPECT_GT(plus->at(0.5).omega.z(), 0.5);
  EXPECT_NEAR(std::atan2(plus->at(0.5).Q(1, 0), plus->at(0.5).Q(0, 0)), 0.3, 8 * eps);
}

TEST(Waypoints, normaliseQuaternionsNearUnitLength) {
  std::vector<TimedPose> points = fourPoints();
  points[1].orientation *= 1.0009;
  const Matrix3<Real50> Q = makeWaypoints(points)->at(Real50(0.9)).Q;
  EXPECT_LE((Q - rotation(points[1].orientation)).norm().convert_to<double>(), 1e-45);
}

struct PointRefusal {
  const char* name;
  void (*fault)(std::vector<TimedPose>&);
  const char* place;
  const char* value;
  const char* bound;
};

class RefusedWaypoints : public testing::TestWithParam<PointRefusal> {};

TEST_P(RefusedWaypoints, nameTheFirstBadPoint) {
  std::vector<TimedPose> points = fourPoints();
  GetParam().fault(points);
  EXPECT_THAT(refusedParameter([&] { makeWaypoints(points); }),
              FieldsAre(GetParam().place, HasSubstr(GetParam().value), HasSubstr(GetParam().bound)));
}

using Points = std::vector<TimedPose>;
INSTANTIATE_TEST_SUITE_P(
    All, RefusedWaypoints,
    testing::Values(
        PointRefusal{"one", [](Points& p) { p.resize(1); }, "trajectory.points", "1 pose", ">= 2"},
        PointRefusal{"none", [](Points& p) { p.clear(); }, "trajectory.points", "0 poses", ">= 2"},
        PointRefusal{"late", [](Points& p) { p[0].time = 0.1; }, "trajectory.points[1].time", "0.1", "0, since"},
        PointRefusal{"equal", [](Points& p) { p[2].time = 0.9; }, "trajectory.points[3].time", "0.9", "> 0.9"},
        PointRefusal{"back", [](Points& p) { p[3].time = 1; }, "trajectory.points[4].time", "1", "> 1.4"},
        PointRefusal{"nan_time", [](Points& p) { p[1].time = nan; }, "trajectory.points[2].time", "nan", "finite"},
        PointRefusal{"position", [](Points& p) { p[1].position.y() = nan; }, "trajectory.points[2].position",
                     "non-finite", "finite"},
        PointRefusal{"long", [](Points& p) { p[2].orientation *= 1.0011; }, "trajectory.points[3].orientation",
                     "norm 1.001", "1 within 0.001"},
        PointRefusal{"zero", [](Points& p) { p[2].orientation.setZero(); }, "trajectory.points[3].orientation",
                     "norm 0", "1 within 0.001"},
        PointRefusal{"nan", [](Points& p) { p[2].orientation(3) = nan; }, "trajectory.points[3].orientation",
                     "norm nan", "1 within 0.001"},
        PointRefusal{"half_turn",
                     [](Points& p) {
                       p[1].orientation = turn(3.1, {1, 0, 0});
                     },
                     "trajectory.points[2].orientation", "turned by 177.6 degrees", "<= 170 degrees"},
        PointRefusal{"swing",
                     [](Points& p) {
                       // The spline overshoots after nearly half a turn within a hundredth of the next piece's time.
                       p = {{0, {0, 0, 1}, turn(0, {1, 0, 0})},
                            {0.01, {0, 0, 1}, turn(2.9, {1, 0, 0})},
                            {3, {0, 0, 1}, turn(2.9, {1, 0, 0})},
                            {6, {0, 0, 1}, turn(2.9, {1, 0, 0})}};
                     },
                     "trajectory.points[4].orientation", "swings too far", "evenly"}),
    [](const auto& row) { return row.param.name; });

TEST(Hold, staysWhereItIs) {
  const auto hold = makeHold({0.1, -0.2, 1.3}, 1.0005 * turn(0.4, {1, 2, 3}), 2.5);
  EXPECT_EQ(hold->kind(), "hold");
  EXPECT_EQ(hold->duration(), 2.5);
  for (const double t : {0.0, 1.1, 2.5}) {
    const Motion<Real50> motion = hold->at(Real50(t));
    EXPECT_EQ(motion.t, Real50(t));
    EXPECT_EQ(motion.p, Vector3d(0.1, -0.2, 1.3).cast<Real50>());
    EXPECT_LE((motion.Q - rotation(1.0005 * turn(0.4, {1, 2, 3}))).norm().convert_to<double>(), 1e-48);
    EXPECT_TRUE(motion.p_dot.isZero(0) && motion.p_ddot.isZero(0));
    EXPECT_TRUE(motion.omega.isZero(0) && motion.omega_dot.isZero(0));
    EXPECT_LE(orthonormalityError(hold->at(t).Q), 8 * eps);
  }
  EXPECT_EQ(derivativeMismatch(*hold, {0.3, 1.7}).worst(), 0);
}

TEST(Hold, refusesWhatIsNoPose) {
  const Vector3d p(0, 0, 1);
  const Eigen::Vector4d q(1, 0, 0, 0);
  EXPECT_THAT(refusedParameter([&] { makeHold(p, q, 0); }), FieldsAre("trajectory.duration", "0", "> 0 and finite"));
  EXPECT_THAT(refusedParameter([&] { makeHold(p, q, nan); }),
              FieldsAre("trajectory.duration", "nan", "> 0 and finite"));
  EXPECT_THAT(refusedParameter([&] {
                makeHold({nan, 0, 1}, q, 1);
              }),
              FieldsAre("trajectory.position", "a non-finite entry", "finite numbers"));
  EXPECT_THAT(refusedParameter([&] { makeHold(p, 1.01 * q, 1); }),
              FieldsAre("trajectory.orientation", "a quaternion of norm 1.01", "1 within 0.001"));
}

}  // namespace
}  // namespace ursula
