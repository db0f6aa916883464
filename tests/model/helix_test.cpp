// The helix of the paper's Appendix: its closed forms against differences of its own pose in 50 digits, and against the
// properties that (49)-(55) give a curve: ends, tangent, normal.

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/real50.h"
#include "model/trajectory.h"
#include "tests/model/derivatives.h"
#include "tests/model/refusals.h"
#include "tests/support/numbers.h"

namespace ursula {
namespace {

using testing::FieldsAre;

HelixParameters paperHelix() {
  HelixParameters helix;
  helix.duration = 3.0;
  helix.radius = 0.2;
  helix.pitch = 1.2;
  helix.start_angle = -1.5707963267948966;
  helix.end_angle = -1.0471975511965976;
  helix.height_phase = 2.2;
  return helix;
}

/// No parameter has its default, and the pitch is negative.
HelixParameters generalHelix() {
  HelixParameters helix = paperHelix();
  helix.duration = 1.7;
  helix.pitch = -0.35;
  helix.phase = 0.4;
  helix.start_rate = 0.8;
  helix.end_rate = -1.3;
  helix.start_acceleration = -2.5;
  helix.end_acceleration = 3.75;
  return helix;
}

class Helix : public testing::TestWithParam<HelixParameters> {};
INSTANTIATE_TEST_SUITE_P(PaperAndGeneral, Helix, testing::Values(paperHelix(), generalHelix()));

TEST_P(Helix, hasExactDerivatives) {
  const auto helix = makeHelix(GetParam());
  EXPECT_LE(derivativeMismatch(*helix, instantsInside(helix->duration(), 40)).worst(), difference_tolerance);
}

TEST_P(Helix, differencesCatchAnErrorInAnyDerivative) {
  const auto helix = makeHelix(GetParam());
  using Part = Falsified::Part;
  for (const Part part : {Part::omega, Part::omega_dot, Part::p_dot, Part::p_ddot}) {
    const Falsified wrong(*helix, part, 1e-15);
    EXPECT_GT(derivativeMismatch(wrong, instantsInside(helix->duration(), 40)).worst(), 5e-16);
  }
}

TEST_P(Helix, moves) {
  const auto helix = makeHelix(GetParam());
  EXPECT_GT(helix->at(helix->duration() / 2).p_dot.norm(), 0.1);
  EXPECT_GT(helix->at(helix->duration() / 4).omega_dot.norm(), 0.1);
}

TEST_P(Helix, startsAndEndsAsAsked) {
  const HelixParameters& asked = GetParam();
  const auto helix = makeHelix(asked);
  const auto expectEnd = [&](double t, double beta, double rate, double acceleration) {
    const Motion<Real50> motion = helix->at(Real50(t));
    const Real50 c = cos(Real50(beta) + Real50(asked.phase)), s = sin(Real50(beta) + Real50(asked.phase));
    const Vector3<Real50> p(Real50(asked.radius) * c, Real50(asked.radius) * s,
                            Real50(asked.pitch) * (Real50(beta) + Real50(asked.height_phase)));
    const double tolerance = 1e-45;  // some hundred roundings of the 50-digit scalar
    EXPECT_LE((motion.p - p).norm().convert_to<double>(), tolerance);
    EXPECT_LE(abs(motion.omega.z() - Real50(rate)).convert_to<double>(), tolerance);
    EXPECT_LE(abs(motion.omega_dot.z() - Real50(acceleration)).convert_to<double>(), tolerance);
  };
  expectEnd(0, asked.start_angle, asked.start_rate, asked.start_acceleration);
  expectEnd(asked.duration, asked.end_angle, asked.end_rate, asked.end_acceleration);
}

TEST_P(Helix, carriesTheFrenetTriad) {
  const auto helix = makeHelix(GetParam());
  const HelixParameters& asked = GetParam();
  for (const double t : instantsInside(helix->duration(), 17)) {
    const Motion<Real50> motion = helix->at(Real50(t));
    EXPECT_LE(orthonormalityError(motion.Q), 1e-48);
    const Vector3<Real50> e_n = motion.Q.col(1), e_t = motion.Q.col(2);
    // Q = [−e_b, e_n, e_t]: e_t along the velocity, with β̇; e_n towards the axis of the helix.
    const Real50 rate = motion.omega.z();
    const Real50 speed = sqrt(Real50(asked.radius) * asked.radius + Real50(asked.pitch) * asked.pitch) * rate;
    EXPECT_LE((motion.p_dot - speed * e_t).norm().convert_to<double>(), 1e-45);
    const Vector3<Real50> inward(-motion.p.x(), -motion.p.y(), Real50(0));
    EXPECT_LE((inward / Real50(asked.radius) - e_n).norm().convert_to<double>(), 1e-45);
    EXPECT_LE((motion.Q.col(0) + e_t.cross(e_n)).norm().convert_to<double>(), 1e-45);
  }
}

TEST_P(Helix, inDoubleIsTheExactOneRounded) {
  const auto helix = makeHelix(GetParam());
  // Horner's rule takes some 15 roundings of terms that are up to 12 times their sum.
  EXPECT_LE(roundingError(*helix, instantsInside(helix->duration(), 100)), 200 * eps);
}

/// A rounding of the angle itself, 1e6 eps, would show beside the 200 eps above.
TEST(HelixOfManyTurns, losesNoDigits) {
  HelixParameters far = generalHelix();
  far.phase = 1e6;
  HelixParameters begun_late = generalHelix();
  begun_late.start_angle += 0x1p20;
  begun_late.end_angle += 0x1p20;
  begun_late.height_phase = -0x1p20;
  for (const HelixParameters& each : {far, begun_late}) {
    const auto helix = makeHelix(each);
    for (const double t : {0.0, 0.3, 1.1, 1.7}) {
      const Motion<double> rounded = helix->at(t);
      const Motion<Real50> exact = helix->at(Real50(t));
      EXPECT_LE((rounded.Q - exact.Q.cast<double>()).norm(), 200 * eps);
      EXPECT_LE((rounded.p_ddot - exact.p_ddot.cast<double>()).norm(), 200 * eps * exact.p_ddot.cast<double>().norm());
    }
    EXPECT_GT((helix->at(0).Q - makeHelix(generalHelix())->at(0).Q).norm(), 0.01);  // the angle is another one
  }
}

TEST(PaperHelixMotion, startsAndEndsAtRest) {
  const auto helix = makeHelix(paperHelix());
  for (const Real50& t : {Real50(0), Real50(3)}) {
    const Motion<Real50> motion = helix->at(t);
    EXPECT_LE((motion.p_dot.norm() + motion.omega.norm()).convert_to<double>(), 1e-45);
    EXPECT_LE((motion.p_ddot.norm() + motion.omega_dot.norm()).convert_to<double>(), 1e-45);
  }
  // The quintic from rest to rest is half way at half time, with 15/8 of the mean rate.
  const Motion<Real50> middle = helix->at(Real50(1.5));
  const Real50 mean = (Real50(-1.0471975511965976) - Real50(-1.5707963267948966)) / 3;
  EXPECT_LE(abs(middle.omega.z() - 15 * mean / 8).convert_to<double>(), 1e-45);
  EXPECT_EQ(helix->kind(), "helix");
  EXPECT_EQ(helix->duration(), 3.0);
}

struct HelixRefusal {
  const char* key;
  double HelixParameters::*member;
  double value;
  const char* shown;
  const char* bound;
};

class RefusedHelix : public testing::TestWithParam<HelixRefusal> {};

TEST_P(RefusedHelix, namesKeyValueAndBound) {
  HelixParameters helix = paperHelix();
  helix.*GetParam().member = GetParam().value;
  EXPECT_THAT(refusedParameter([&] { makeHelix(helix); }),
              FieldsAre(std::string("trajectory.") + GetParam().key, GetParam().shown, GetParam().bound));
}

using P = HelixParameters;
INSTANTIATE_TEST_SUITE_P(
    All, RefusedHelix,
    testing::Values(HelixRefusal{"duration", &P::duration, 0, "0", "> 0"},
                    HelixRefusal{"duration", &P::duration, -3, "-3", "> 0"},
                    HelixRefusal{"duration", &P::duration, inf, "inf", "a finite number"},
                    HelixRefusal{"duration", &P::duration, 1e-200, "1e-200", "a motion whose acceleration is finite"},
                    HelixRefusal{"radius", &P::radius, 0, "0", "> 0"},
                    HelixRefusal{"radius", &P::radius, -0.2, "-0.2", "> 0"},
                    HelixRefusal{"radius", &P::radius, nan, "nan", "a finite number"},
                    HelixRefusal{"pitch", &P::pitch, 0, "0", "not 0"},
                    HelixRefusal{"pitch", &P::pitch, -inf, "-inf", "a finite number"},
                    HelixRefusal{"start_angle", &P::start_angle, nan, "nan", "a finite number"},
                    HelixRefusal{"end_angle", &P::end_angle, nan, "nan", "a finite number"},
                    HelixRefusal{"phase", &P::phase, nan, "nan", "a finite number"},
                    HelixRefusal{"height_phase", &P::height_phase, nan, "nan", "a finite number"},
                    HelixRefusal{"start_rate", &P::start_rate, nan, "nan", "a finite number"},
                    HelixRefusal{"end_rate", &P::end_rate, inf, "inf", "a finite number"},
                    HelixRefusal{"start_acceleration", &P::start_acceleration, nan, "nan", "a finite number"},
                    HelixRefusal{"end_acceleration", &P::end_acceleration, nan, "nan", "a finite number"}));

}  // namespace
}  // namespace ursula
