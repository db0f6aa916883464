// Poses of a Stewart–Gough platform where two poses merge, and machines whose platform is free to move.

#include <gtest/gtest.h>

#include <iostream>
#include <optional>

#include "parts/poses/direct_kinematics.h"
#include "tests/nocsolver/ups_poses_cases.h"

namespace ursula {
namespace {

using namespace ups_cases;

/// A machine whose legs are those of a singular pose, where two poses merge.
std::optional<Case> singular(unsigned seed) {
  Case made = thrown(seed);
  Dice dice(seed + 1000);
  const Vector3d move = dice.vector(), axis = dice.vector().normalized();
  const auto at = [&](double way) -> Placement {
    return {made.at.p + way * move, Eigen::AngleAxisd(way, axis) * made.at.Q};
  };
  const auto determinant = [&](double way) { return made.machine.jacobian(at(way)).determinant(); };
  const double sign = determinant(0);
  double low = 0, high = 0.05;
  for (; determinant(high) * sign > 0; high += 0.05) {
    if (high > 3) return std::nullopt;
    low = high;
  }
  for (double middle = (low + high) / 2; middle != low && middle != high; middle = (low + high) / 2)
    (determinant(middle) * sign > 0 ? low : high) = middle;
  made.at = at(low);
  return made;
}

/// Along the null vector [ω; v] of J the lengths grow as κ t², κ = ½ |Σ uᵢ f″ᵢ|; their error is some 16 roundings.
double spread(const Case& made) {
  const Eigen::JacobiSVD<Matrix6d> svd(made.machine.jacobian(made.at), Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector3d omega = svd.matrixV().col(5).head<3>(), v = svd.matrixV().col(5).tail<3>();
  double kappa = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Vector3d Qb = made.at.Q * made.machine.b[i], leg = made.at.p + Qb - made.machine.a[i];
    const Vector3d moved = v + omega.cross(Qb), n = leg.normalized();
    const double across = (moved - n * n.dot(moved)).squaredNorm() / leg.norm();
    kappa += svd.matrixU()(static_cast<Eigen::Index>(i), 5) * (across + n.dot(omega.cross(omega.cross(Qb)))) / 2;
  }
  return std::sqrt(16 * 6 * eps / std::abs(kappa));
}

TEST(UpsPoses, MergeAtSingularOnes) {
  int tried = 0, doubled = 0;
  for (unsigned seed = 5000; tried < 40; ++seed) {
    const std::optional<Case> made = singular(seed);
    if (!made) continue;
    SCOPED_TRACE(seed);
    ++tried;
    const UpsPoses poses = made->poses();
    EXPECT_EQ(poses.counted, 40);
    EXPECT_LE(nearest(poses, made->at), 4 * spread(*made));
    doubled +=
        std::any_of(poses.list.begin(), poses.list.end(), [](const UpsPose& pose) { return pose.multiplicity == 2; });
  }
  std::cout << doubled << " of " << tried << " are double\n";
  EXPECT_GE(doubled, tried / 2);
}

/// Similar hexagons on a conic let the platform move, whatever the lengths are. So do joints on a line, and two equal
/// legs.
TEST(UpsPoses, AreRefusedWhereThePlatformIsFree) {
  Case similar = thrown(7000), line = similar, twice = similar;
  for (std::size_t i = 0; i < 6; ++i) {
    const double angle = similar.machine.a[i].x() * 3;
    similar.machine.a[i] = Vector3d(std::cos(angle), std::sin(angle), 0);
    similar.machine.b[i] = similar.machine.a[i] / 2;
    line.machine.a[i].tail<2>().setZero();
  }
  twice.machine.a[1] = twice.machine.a[0];
  twice.machine.b[1] = twice.machine.b[0];
  EXPECT_THROW(similar.poses(), UndeterminedPose);
  EXPECT_THROW(line.poses(), UndeterminedPose);
  EXPECT_THROW(twice.poses(), UndeterminedPose);
  similar.machine.b[0].x() += 0.1;  // no longer similar
  EXPECT_LE(nearest(similar.poses(), similar.at), expectedError(similar));
}

/// For very long legs the platform is a point, whose orientation is undetermined.
TEST(UpsPoses, OfLegsTooLongForTheirJointsAreRefused) {
  const Case near = thrown(7000);
  const auto posesFrom = [&near](double distance) {
    Vector6d lengths;
    for (std::size_t i = 0; i < 6; ++i)
      lengths(static_cast<Eigen::Index>(i)) = (Vector3d(0, 0, distance) + near.machine.b[i] - near.machine.a[i]).norm();
    return upsPoses(near.machine.a, near.machine.b, lengths);
  };
  const UpsPoses found = posesFrom(1e3);
  EXPECT_TRUE(found.complete());
  EXPECT_TRUE(std::any_of(found.list.begin(), found.list.end(), [](const UpsPose& pose) {
    return (pose.Q - Matrix3d::Identity()).norm() < 1e-6 && std::abs(pose.p.z() - 1e3) < 1e-3;
  }));
  for (const double distance : {1e5, 1e6, 1e9}) EXPECT_THROW(posesFrom(distance), UndeterminedPose) << distance;
}

TEST(UpsPoses, OfNoSizeAreRefused) {
  Points origin;
  origin.fill(Vector3d::Zero());
  EXPECT_THROW(upsPoses(origin, origin, Vector6d::Zero()), UndeterminedPose);
}

}  // namespace
}  // namespace ursula
