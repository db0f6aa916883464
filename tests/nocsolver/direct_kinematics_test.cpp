// Compares poses from actuated angles with the poses that the angles come from, and with the paper's 18 equations,
// written here from raw parameters.

#include "parts/poses/direct_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "base/real50.h"
#include "tests/nocsolver/direct_kinematics_cases.h"
#include "tests/nocsolver/rounding.h"

namespace ursula {
namespace {

double wider(double worst, double error) { return error <= worst ? worst : error; }  // keeps a NaN

/// Q̂ᵢ of (2b), with the frame that is valid for any tilt but 90°.
Matrix3d fixedFrame(const Leg& leg) {
  const Vector3d u = leg.base_axis.normalized(), x_hat = u.cross(Vector3d::UnitZ()).normalized();
  Matrix3d Q_hat;
  Q_hat << x_hat, u, x_hat.cross(u);
  return Q_hat;
}

/// (27) over l + s and (13), from raw parameters, at one leg within reach; m.
double legMismatch(const Leg& leg, double phi, const PlatformPose& pose, const LegAtPose& at) {
  const Vector3d AB = -leg.base_point + pose.p + pose.Q * leg.platform_point;
  const Vector3d k = fixedFrame(leg).transpose() * AB;
  const double l = leg.proximal.length, s = leg.distal.length, sum = at.psi + at.theta;
  const Vector3d by_angles(0, l * std::cos(at.psi) - s * std::cos(sum), l * std::sin(at.psi) - s * std::sin(sum));
  const Vector3d by_k(k.x() * std::cos(phi) + k.z() * std::sin(phi), k.y(),
                      -k.x() * std::sin(phi) + k.z() * std::cos(phi));
  if (!at.in_reach) return std::abs(by_k.x());
  const double law = l * l + s * s - 2 * l * s * std::cos(at.theta) - AB.squaredNorm();
  return wider((by_angles - by_k).norm(), std::abs(law) / (l + s));
}

double mismatch(const Manipulator& manipulator, const Vector6d& phi, const PlatformPose& pose) {
  double worst = 0;
  for (int i = 0; i < leg_count; ++i)
    worst = wider(worst, legMismatch(manipulator.leg(i), phi(i), pose, pose.legs[static_cast<std::size_t>(i)]));
  return worst;
}

/// Results of round trips over many machines and poses, each over its limit.
struct RoundTrips {
  int tested = 0, lost = 0, missing = 0, assembling = 0, out_of_reach = 0, behind = 0, ambiguous = 0;
  double error = 0, mismatch = 0, residual = 0;

  void add(const Case& made, const Vector6d& phi, const Conditioned& conditioned) {
    const PlatformPoses poses = made.kinematics->poses(phi);
    const PlatformPose* pose = nearestPose(poses, made.motion);
    const double off = pose == nullptr ? INFINITY : poseError(*pose, made.motion) / conditioned.limit();
    ++tested;
    if (!(off <= 1) || !pose->assembles || !pose->front) ++lost;
    error = wider(error, off);
    if (poses.counted != 8) ++missing;
    int alike = 0;
    for (const PlatformPose& each : poses) {
      const double limit = 64 * eps * sizeOf(made.kinematics->solver().machine(), each.p);
      mismatch = wider(mismatch, ursula::mismatch(*made.manipulator, phi, each) / limit);
      residual = wider(residual, each.residual / limit);
      (each.assembles ? assembling : out_of_reach) += 1;
      if (each.assembles && !each.front) ++behind;
      if (each.assembles && each.front) ++alike;
    }
    if (alike > 1) ++ambiguous;
  }
};

std::ostream& operator<<(std::ostream& out, const RoundTrips& trips) {
  return out << trips.tested << " round trips, " << trips.lost << " lost; largest share of the limit: error "
             << trips.error << ", 18 equations " << trips.mismatch << ", residual " << trips.residual << "; "
             << trips.assembling << " poses assemble, " << trips.out_of_reach << " do not, " << trips.behind
             << " behind an axis; " << trips.ambiguous << " with more than one pose of the same angles and sides\n";
}

TEST(DirectKinematics, FindsThePoseAgainForTenThousandMachinesAndPoses) {
  const Scenario paper = vectorScenario("paper-helix");
  SeededDraws dice(20240611);
  RoundTrips trips;
  for (int n = 0; n < 10000; ++n) {
    const Case made = feasibleCase(paper, dice, n % 2 == 0 ? 0.03 : 0.1);
    const Conditioned conditioned(*made.kinematics, made.motion);
    trips.add(made, conditioned.phi, conditioned);
  }
  std::cout << trips;
  EXPECT_EQ(trips.lost, 0);
  EXPECT_EQ(trips.missing, 0) << "of eight solutions in the complex numbers";
  EXPECT_LE(trips.error, 1);
  EXPECT_LE(trips.mismatch, 1);
  EXPECT_LE(trips.residual, 1);
  // The test was not vacuous: there were other poses than the wanted one.
  EXPECT_GT(trips.out_of_reach, 0);
  EXPECT_GT(trips.behind, 0);
  EXPECT_GT(trips.ambiguous, 0);
}

/// Angles by (14a) with +aᵢ as printed in (5), (27). Then no leg reaches, so only φ can be compared.
Vector6d anglesAsPrinted(const Manipulator& manipulator, const Motion<double>& motion) {
  Vector6d phi;
  for (int i = 0; i < leg_count; ++i) {
    const Leg& leg = manipulator.leg(i);
    const Vector3d k = fixedFrame(leg).transpose() * (leg.base_point + motion.p + motion.Q * leg.platform_point);
    phi(i) = std::atan2(-k.x(), k.z());
  }
  return phi;
}

TEST(DirectKinematics, LosesThePoseForOtherAnglesOrTheClosureAsPrinted) {
  const Scenario paper = vectorScenario("paper-helix");
  SeededDraws dice(7);
  RoundTrips perturbed, printed;
  for (int n = 0; n < 100; ++n) {
    const Case made = feasibleCase(paper, dice, 0.03);
    const Conditioned conditioned(*made.kinematics, made.motion);
    Vector6d phi = conditioned.phi;
    phi(n % leg_count) += 1e-6;
    perturbed.add(made, phi, conditioned);
    printed.add(made, anglesAsPrinted(*made.manipulator, made.motion), conditioned);
  }
  EXPECT_EQ(perturbed.lost, perturbed.tested);
  EXPECT_EQ(printed.lost, printed.tested);
  EXPECT_LE(perturbed.mismatch, 1) << "for angles that are not the pose's, still poses";
}

TEST(DirectKinematics, ListsPosesInOrderWithWhatTheyNeedOfTheLegs) {
  const Scenario paper = vectorScenario("paper-helix");
  SeededDraws dice(11);
  bool far = false;
  for (int n = 0; n < 200; ++n) {
    const Case made = feasibleCase(paper, dice, 0.05);
    const PlatformPoses poses = made.kinematics->poses(Conditioned(*made.kinematics, made.motion).phi);
    int multiplicities = 0;
    for (const PlatformPose* pose = poses.begin(); pose != poses.end(); ++pose) {
      multiplicities += pose->multiplicity;
      EXPECT_GE(pose->q(0), 0);
      EXPECT_TRUE(pose == poses.begin() || pose[-1].assembles || !pose->assembles) << "assembling ones come first";
      bool all = true;
      for (int i = 0; i < leg_count; ++i) {
        const Leg& leg = made.manipulator->leg(i);
        const LegAtPose& at = pose->legs[static_cast<std::size_t>(i)];
        const double l = leg.proximal.length, s = leg.distal.length;
        const double distance = (pose->p + pose->Q * leg.platform_point - leg.base_point).norm();
        EXPECT_NEAR(at.distance, distance, 64 * eps * distance);
        EXPECT_EQ(at.in_reach, std::abs(l - s) <= distance && distance <= l + s);
        EXPECT_EQ(std::isnan(at.theta), !at.in_reach);
        EXPECT_TRUE(!at.in_reach || (std::sin(at.theta) > 0) == (leg.knee == Knee::positive));
        all = all && at.in_reach;
      }
      EXPECT_EQ(pose->assembles, all);
      far = far || !all;
    }
    EXPECT_EQ(multiplicities % 2, 0) << "the others come in conjugate pairs";
    EXPECT_LE(multiplicities, 8);
  }
  EXPECT_TRUE(far) << "no pose out of reach among them";
}

/// The other bend of each knee satisfies (13) and (27) as well.
TEST(DirectKinematics, TheOtherBendOfTheKneeReachesToo) {
  const Scenario paper = vectorScenario("paper-helix");
  const DirectKinematics kinematics(*paper.manipulator);
  const Conditioned conditioned(kinematics, paper.trajectory->at(1));
  PlatformPose pose = *kinematics.poses(conditioned.phi).begin();
  for (int i = 0; i < leg_count; ++i) {
    LegAtPose& at = pose.legs[static_cast<std::size_t>(i)];
    const double l = paper.manipulator->leg(i).proximal.length, s = paper.manipulator->leg(i).distal.length;
    at.psi -= 2 * std::atan2(s * std::sin(at.theta), l - s * std::cos(at.theta));
    at.theta = -at.theta;
  }
  EXPECT_LE(mismatch(*paper.manipulator, conditioned.phi, pose), 64 * eps * conditioned.size);
  pose.legs[0].psi += 1e-9;
  EXPECT_GT(mismatch(*paper.manipulator, conditioned.phi, pose), 64 * eps * conditioned.size);
}

Vector6d doubles(const Vector6<Real50>& from) { return from.cast<double>(); }

/// Twist and twist rate against the vectors, whose rates of φ were differentiated numerically in 60 digits.
TEST(DirectKinematics, GivesTwistAndTwistRateOfTheVectors) {
  double worst = 0, disturbed = INFINITY;
  for (const std::string& name : vectorNames()) {
    const DirectKinematics kinematics(*vectorScenario(name).manipulator);
    for (const VectorRow& row : vectorRows(name)) {
      const Motion<double> commanded = rounded(row.motion);
      const PlatformPoses poses = kinematics.poses(doubles(row.q.phi));
      const PlatformPose* pose = nearestPose(poses, commanded);
      ASSERT_TRUE(pose != nullptr && poseError(*pose, commanded) <= Conditioned(kinematics, commanded).limit()) << name;
      Workspace<double> work;
      const auto error = [&](const Vector6d& phi_ddot) {
        const Motion<double> found = kinematics.motion(*pose, doubles(row.q_dot.phi), phi_ddot, work);
        const double scale = commanded.omega.norm() + commanded.p_dot.norm() + commanded.omega_dot.norm() +
                             commanded.p_ddot.norm() + row.q_ddot.phi.cast<double>().norm() +
                             row.q_dot.phi.cast<double>().squaredNorm() + eps;
        const double off = (found.omega - commanded.omega).norm() + (found.p_dot - commanded.p_dot).norm() +
                           (found.omega_dot - commanded.omega_dot).norm() + (found.p_ddot - commanded.p_ddot).norm();
        return off / (scale * roundingLimit(kinematics.solver().noc(), work));
      };
      worst = wider(worst, error(doubles(row.q_ddot.phi)));
      disturbed = std::min(disturbed, error(doubles(row.q_ddot.phi) + Vector6d::Constant(1e-6)));
    }
  }
  std::cout << "twist and its rate, largest share of the limit: " << worst << '\n';
  EXPECT_LE(worst, 1);
  EXPECT_GT(disturbed, 1) << "1e-6 rad/s² of the actuators would pass unseen";
}

}  // namespace
}  // namespace ursula
