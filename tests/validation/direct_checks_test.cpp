// Direct dynamics on trial: the mass matrix column by column, and the growth of deviations.

#include "validation/checks/direct_checks.h"

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
    Scenario scenario = scenarioOf(GetParam());
    scenario.simulation.samples = 31;
    reference_ = makeReference(scenario);
    right_ = solverOf(here());
    samples_ = runPointwise(here(), right_, reference_->instants, reference_->profile);
  }
  const Scenario& here() const { return reference_->scenario; }
  Subject with(const Accelerations& accelerations) const {
    Subject subject = right_;
    subject.accelerations = accelerations;
    return subject;
  }
  Check pointwise(const Subject& subject) const {
    return judgeDirect(reference_->direct(), subject, samples_, reference_->profile);
  }
  Check growth(const Subject& subject, bool second_look = true) const {
    return judgeGrowth(reference_->beside().growthOf(subject.accelerations), reference_->beside(), {}, second_look);
  }
  /// M (1 + share) for M: the acceleration that torques give is smaller by as much.
  Subject heavier(double share) const {
    return with([this, share](const Motion<double>& motion, const Vector6d& torques) {
      const KinematicAnswer answer = right_.kinematics(motion);
      const Vector6d rest = answer.T_rate * answer.joints.q_dot.phi;
      return Vector6d(rest + (right_.accelerations(motion, torques) - rest) / (1 + share));
    });
  }
  /// What the pose does to the acceleration, off by that share; on the commanded motion nothing is.
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
  const Check direct = pointwise(right_), grown = growth(right_);
  EXPECT_EQ(direct.verdict, Verdict::pass) << direct.why;
  EXPECT_GT(direct.value, 0);
  EXPECT_EQ(grown.verdict, Verdict::pass) << grown.why << ' ' << grown.value << " of " << grown.limit;
  EXPECT_GT(grown.value, 0);
  EXPECT_LT(grown.limit, 1e-2) << "the limit says little";
}

TEST_P(Direct, aMassMatrixOffByAHundredMillionthFails) {
  EXPECT_EQ(pointwise(heavier(1e-8)).verdict, Verdict::fail);
  EXPECT_EQ(pointwise(heavier(0)).verdict, Verdict::pass) << "the control's own way round";
}

/// Under the commanded torques nothing is wrong: it shows where that motor's is changed.
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

TEST_P(Direct, aStiffnessOffByAHundredthFailsTheGrowthAlone) {
  for (const double share : {0.01, -0.01}) {
    EXPECT_EQ(growth(stiffer(share)).verdict, Verdict::fail) << share;
    EXPECT_EQ(pointwise(stiffer(share)).verdict, Verdict::pass) << share;
  }
  EXPECT_EQ(growth(stiffer(0)).verdict, Verdict::pass);
}

/// How far off the path Simbody is put, and so all that the limit is made of but the subject's own resolution, is none
/// of the subject's business.
TEST_P(Direct, theDeviationIsTheRightSolversWhoeverIsOnTrial) {
  const BesidePath& path = reference_->beside();
  const Growth own = path.growthOf(right_.accelerations), other = path.growthOf(stiffer(0.5).accelerations);
  EXPECT_LE((own.Phi - path.right().Phi).norm(), 1e-6 * own.Phi.norm());  // of another formulation
  ASSERT_GT((other.Phi - own.Phi).norm(), 0.01 * own.Phi.norm()) << "the control changes nothing";
  const auto deviation = [](const Check& check) { return check.why.substr(0, check.why.find(" grows")); };
  EXPECT_EQ(deviation(growth(stiffer(0.5), false)), deviation(growth(right_, false)));
  EXPECT_NEAR(path.size() * path.right().Phi.topRows<6>().norm(), 1e-5 * reference_->replays().amplification.length(),
              1e-12);
}

TEST_P(Direct, replaysBesideThePathAreTheSameMadeAfresh) {
  const ReplayPlan& plan = reference_->replays().plan;
  const BesidePath afresh(here(), plan.torques, reference_->replays().amplification, plan.acceleration,
                          10 * coarser * plan.tolerance);
  EXPECT_EQ(afresh.size(), reference_->beside().size());
  EXPECT_EQ(afresh.ends().whole_apart, reference_->beside().ends().whole_apart);
  EXPECT_EQ(afresh.ends().above, reference_->beside().ends().above);
  EXPECT_NE(afresh.ends().above, afresh.ends().below);
}

TEST_P(Direct, noNumberIsNoAgreement) {
  const Subject none =
      with([](const Motion<double>&, const Vector6d&) { return Vector6d(Vector6d::Constant(std::nan(""))); });
  EXPECT_EQ(pointwise(none).verdict, Verdict::fail);
  EXPECT_EQ(growth(none).verdict, Verdict::fail);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Direct, testing::Values("paper-helix", "proving-ground", "millimetres"),
                         [](const auto& name) { return asTestName(name.param); });

TEST(DirectChecks, noSampleFails) {
  const Scenario scenario = scenarioOf("paper-helix");
  EXPECT_EQ(judgeDirect({}, solverOf(scenario), {}, RoundingProfile(scenario, 2)).verdict, Verdict::fail);
}

}  // namespace
}  // namespace ursula
