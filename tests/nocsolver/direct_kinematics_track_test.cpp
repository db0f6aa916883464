// Tracking one pose along the paper's helix; Newton's convergence; no use of the heap.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/nocsolver/direct_kinematics_cases.h"
#include "tests/support/allocation_counter.h"

namespace ursula {
namespace {

TEST(DirectKinematics, TracksThePaperHelix) {
  const Scenario paper = vectorScenario("paper-helix");
  const DirectKinematics kinematics(*paper.manipulator);
  const auto commanded = [&](int n) { return paper.trajectory->at(n * paper.trajectory->duration() / 300); };
  std::optional<PlatformPose> pose = *kinematics.poses(Conditioned(kinematics, commanded(0)).phi).begin();
  ASSERT_LE(poseError(*pose, commanded(0)), Conditioned(kinematics, commanded(0)).limit());
  double worst = 0, stale = INFINITY;
  for (int n = 1; n <= 300; ++n) {
    const Conditioned conditioned(kinematics, commanded(n));
    stale = n < 10 || n > 290 ? stale : std::min(stale, poseError(*pose, commanded(n)) / conditioned.limit());
    pose = kinematics.track(conditioned.phi, *pose);
    ASSERT_TRUE(pose) << "step " << n;
    const double off = poseError(*pose, commanded(n)) / conditioned.limit();
    worst = off <= worst ? worst : off;
    EXPECT_TRUE(pose->assembles && pose->front);
    EXPECT_LE(pose->residual, 64 * eps * conditioned.size);
  }
  std::cout << "tracking the helix, largest share of the limit: " << worst << '\n';
  EXPECT_LE(worst, 1);
  EXPECT_GT(stale, 1) << "the pose of the step before would have passed";
}

TEST(DirectKinematics, TracksTheBranchThatItIsOnAndNoOther) {
  const Scenario paper = vectorScenario("paper-helix");
  SeededDraws dice(5);
  int others = 0;
  for (int n = 0; n < 200; ++n) {
    const Case made = feasibleCase(paper, dice, 0.03);
    const Conditioned now(*made.kinematics, made.motion);
    Vector6d ahead = now.phi;
    for (int i = 0; i < leg_count; ++i) ahead(i) += dice.between(-1e-6, 1e-6);
    const PlatformPoses poses = made.kinematics->poses(now.phi);
    for (const PlatformPose& from : poses) {
      const std::optional<PlatformPose> to = made.kinematics->track(ahead, from);
      if (!to) continue;
      Motion<double> motion;
      motion.p = from.p;
      motion.Q = from.Q;
      EXPECT_EQ(nearestPose(poses, motion), &from);
      motion.p = to->p;
      motion.Q = to->Q;
      EXPECT_EQ(nearestPose(poses, motion), &from);
      if (!from.assembles) ++others;
    }
  }
  EXPECT_GT(others, 0);
}

/// If J has condition κ, a step leaves at most κ e²/length of an error e, because the planes' second derivatives are
/// those of Q b, at most ‖b‖ per rad².
TEST(DirectKinematics, NewtonConvergesQuadratically) {
  const Scenario paper = vectorScenario("paper-helix");
  const DirectKinematics kinematics(*paper.manipulator);
  const MachineParameters<double>& model = kinematics.solver().machine();
  int judged = 0;
  for (const double t : {0.3, 1.0, 2.0, 2.9}) {
    const Conditioned conditioned(kinematics, paper.trajectory->at(t));
    const PlatformPose there = *kinematics.poses(conditioned.phi).begin();
    const direct::Planes planes(model, conditioned.phi);
    direct::PlacedPlatform pose{there.p + Vector3d(2e-3, -1e-3, 1e-3),
                                (there.q + Eigen::Vector4d(0, 1e-3, -1e-3, 1e-3)).normalized()};
    int sign = 0;
    double before = planes.newtonStep(planes.mismatch(pose), pose, sign);
    for (int i = 0; i < 3; ++i) {
      const double step = planes.newtonStep(planes.mismatch(pose), pose, sign);
      EXPECT_LE(step, conditioned.condition() * before * before / model.length + conditioned.limit());
      if (step > conditioned.limit()) ++judged;
      before = step;
    }
    EXPECT_LE(before, conditioned.limit()) << "three steps from 2 mm are enough";
  }
  EXPECT_GT(judged, 0);
}

TEST(DirectKinematics, DoesNotAllocate) {
  const Scenario paper = vectorScenario("paper-helix");
  const DirectKinematics kinematics(*paper.manipulator);
  const Vector6d phi = Conditioned(kinematics, paper.trajectory->at(1)).phi;
  const Vector6d ahead = Conditioned(kinematics, paper.trajectory->at(1.01)).phi;
  Workspace<double> work;
  PlatformPoses poses = kinematics.poses(phi);
  std::optional<PlatformPose> next;
  Motion<double> motion;
  EXPECT_EQ(allocationsIn([&] {
              poses = kinematics.poses(phi);
              next = kinematics.track(ahead, *poses.begin());
              motion = kinematics.motion(*poses.begin(), ahead - phi, phi, work);
            }),
            0);
  EXPECT_TRUE(next && motion.p_ddot.allFinite());
}

}  // namespace
}  // namespace ursula
