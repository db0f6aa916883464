// Tests of direct dynamics: the mass matrix column by column, and states off the path.

#include "validation/checks/judges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/evidence/reference.h"

namespace ursula {
namespace {

using Accelerations = std::function<Vector6d(const Motion<double>&, const Vector6d& torques)>;

class Direct : public testing::TestWithParam<std::string> {
 protected:
  Direct() {
    reference_ = referenceOf(GetParam(), 31);
    right_ = solverOf(here());
    samples_ = runPointwise(here(), right_, reference_->instants, reference_->rounding().profile);
  }
  const Scenario& here() const { return reference_->scenario; }
  Subject with(const Accelerations& accelerations) const {
    Subject subject = right_;
    subject.accelerations = accelerations;
    return subject;
  }
  Check pointwise(const Subject& subject) const {
    return judgeDirect(reference_->direct(), subject, samples_, reference_->rounding().profile);
  }
  Check offPath(const Subject& subject) const {
    return judgeOffPath(reference_->direct(), subject, samples_, reference_->rounding().profile);
  }
  /// A subject with M (1 + share) instead of M, whose accelerations under torques are smaller by that share.
  Subject heavier(double share) const {
    return with([this, share](const Motion<double>& motion, const Vector6d& torques) {
      const KinematicAnswer answer = right_.kinematics(motion);
      const Vector6d rest = answer.T_rate * answer.joints.q_dot.phi;
      return Vector6d(rest + (right_.accelerations(motion, torques) - rest) / (1 + share));
    });
  }
  /// A subject in which the pose's effect on the acceleration is wrong by that share; on the commanded motion it is
  /// right.
  Subject stiffer(double share) const {
    return with([this, share](const Motion<double>& motion, const Vector6d& torques) {
      Motion<double> commanded = motion;
      const Motion<double> at = here().trajectory->at(motion.t);
      commanded.p = at.p;
      commanded.Q = at.Q;
      const Vector6d found = right_.accelerations(motion, torques);
      return Vector6d(found + share * (found - right_.accelerations(commanded, torques)));
    });
  }

  std::shared_ptr<const Reference> reference_;
  Subject right_;
  std::vector<PointwiseSample> samples_;
};

TEST_P(Direct, theSolversPasses) {
  for (const Check& check : {pointwise(right_), offPath(right_)}) {
    EXPECT_EQ(check.verdict, Verdict::pass) << check.name << ": " << check.why;
    EXPECT_GT(check.value, 0) << check.name;
    EXPECT_LT(check.missed, 1e-9) << check.name << ": the limit says little";
  }
}

TEST_P(Direct, aMassMatrixOffByAHundredMillionthFails) {
  EXPECT_EQ(pointwise(heavier(1e-8)).verdict, Verdict::fail);
  EXPECT_EQ(pointwise(heavier(0)).verdict, Verdict::pass) << "the control's own way round";
}

/// Under the commanded torques nothing is wrong; the error shows if that motor's torque changes.
TEST_P(Direct, oneColumnOffIsSeenAndNamed) {
  for (int motor = 0; motor < leg_count; ++motor) {
    const Check check = pointwise(with([&, motor](const Motion<double>& motion, Vector6d torques) {
      const double change = torques(motor) - right_.torques(motion)(motor);
      torques(motor) += 1e-7 * change;
      return right_.accelerations(motion, torques);
    }));
    EXPECT_EQ(check.verdict, Verdict::fail);
    EXPECT_THAT(check.why, testing::HasSubstr("motor " + std::to_string(motor + 1) + " changed"));
  }
}

TEST_P(Direct, aStiffnessOffByAMillionthFailsOffThePathAlone) {
  for (const double share : {1e-6, -1e-6}) {
    EXPECT_EQ(offPath(stiffer(share)).verdict, Verdict::fail) << share;
    EXPECT_EQ(pointwise(stiffer(share)).verdict, Verdict::pass) << share;
  }
  EXPECT_EQ(offPath(stiffer(0)).verdict, Verdict::pass);
}

TEST_P(Direct, everyInstantHasStatesBesideThePathOnBothSides) {
  ASSERT_GT(reference_->direct().size(), 10U);
  for (const DirectSample& here : reference_->direct()) {
    const Motion<double>& commanded = samples_[here.sample].motion;
    ASSERT_EQ(here.off_path.size(), 2U);
    const Motion<double>&above = here.off_path[0].state, below = here.off_path[1].state;
    EXPECT_GT((above.p - commanded.p).norm(), 0);
    EXPECT_GT((above.Q - commanded.Q).norm(), 0);
    EXPECT_GT((above.p_dot - commanded.p_dot).norm(), 0);
    EXPECT_GT((above.omega - commanded.omega).norm(), 0);
    EXPECT_LT((above.p + below.p - 2 * commanded.p).norm(), 1e-12 * commanded.p.norm());
  }
}

TEST_P(Direct, noNumberIsNoAgreement) {
  const Subject none =
      with([](const Motion<double>&, const Vector6d&) { return Vector6d(Vector6d::Constant(std::nan(""))); });
  EXPECT_EQ(pointwise(none).verdict, Verdict::fail);
  EXPECT_EQ(offPath(none).verdict, Verdict::fail);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Direct, testing::Values("paper-helix", "proving-ground", "millimetres"),
                         [](const auto& name) { return asTestName(name.param); });

/// On the path nothing moves and no force acts, so nothing rounds; off the path there is rounding.
TEST(DirectChecks, aMachineAtRestWithoutWeightPasses) {
  Scenario scenario = scenarioOf("hold");
  ManipulatorParameters machine = scenario.manipulator->parameters();
  machine.gravity.setZero();
  scenario.manipulator = std::make_shared<const Manipulator>(machine);
  const Reference reference(scenario);
  const Subject right = solverOf(reference.scenario);
  const auto samples = runPointwise(reference.scenario, right, reference.instants, reference.rounding().profile);
  EXPECT_EQ(samples.front().torques_simbody.norm(), 0);
  const Check check = judgeOffPath(reference.direct(), right, samples, reference.rounding().profile);
  EXPECT_EQ(check.verdict, Verdict::pass) << check.value << " of " << check.limit;
  EXPECT_GT(check.value, 0);
}

TEST(DirectChecks, noSampleFails) {
  const Scenario scenario = scenarioOf("paper-helix");
  const RoundingProfile profile(scenario, 2);
  EXPECT_EQ(judgeDirect({}, solverOf(scenario), {}, profile).verdict, Verdict::fail);
  EXPECT_EQ(judgeOffPath({}, solverOf(scenario), {}, profile).verdict, Verdict::fail);
}

}  // namespace
}  // namespace ursula
