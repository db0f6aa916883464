// Poses at and near a singular B, where two poses merge, and angles that leave the platform free to move.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/nocsolver/direct_kinematics_cases.h"

namespace ursula {
namespace {

/// A machine, and a pose at which det B changes sign on a straight way from a regular pose.
struct Fold {
  Case made;
  Vector3d move, turn;
  double at = 0;

  Motion<double> motion(double offset = 0) const {
    const double way = at + offset;
    return displaced(made.motion, way * move, way * turn);
  }
};

/// Returns nullopt if the way leads out of reach or meets no singular pose.
std::optional<Fold> findFold(const Scenario& paper, SeededDraws& dice) {
  ManipulatorParameters parameters = thrown(paper.manipulator->parameters(), dice, 0.05);
  for (Leg& leg : parameters.legs) {  // long legs, so that singular poses are in reach
    leg.proximal.length *= 1.5;
    leg.distal.length *= 1.5;
  }
  Fold fold;
  fold.made.manipulator = std::make_shared<Manipulator>(parameters);
  fold.made.kinematics = std::make_shared<DirectKinematics>(*fold.made.manipulator);
  fold.made.motion = paper.trajectory->at(1.5);
  fold.move = dice.vector(0.3);
  fold.turn = dice.vector(1).normalized();
  const auto determinant = [&](double way) {
    return Conditioned(*fold.made.kinematics, displaced(fold.made.motion, way * fold.move, way * fold.turn))
        .determinant;
  };
  try {
    const double sign = determinant(0);
    double low = 0, high = 0;
    for (high = 0.05; determinant(high) * sign > 0; high += 0.05) {
      if (high > 2) return std::nullopt;
      low = high;
    }
    for (double middle = (low + high) / 2; middle != low && middle != high; middle = (low + high) / 2)
      (determinant(middle) * sign > 0 ? low : high) = middle;
    fold.at = low;
    return fold;
  } catch (const PoseError&) {
    return std::nullopt;
  }
}

/// Along the null vector [ω; v] of B the mismatch of the planes grows as ½ h t², h = |Σ uᵢ xᵢᵀ(ω × (ω × Qbᵢ))|, and
/// below δ it cannot be told from 0: t ≤ (2δ/h)^½.
struct DoubleRoot {
  Conditioned conditioned;
  double uncertainty = 0;  ///< m, with moments divided by the machine's length
  Vector6d left;           ///< u

  DoubleRoot(const DirectKinematics& kinematics, const Motion<double>& motion)
      : conditioned(kinematics, motion), left(conditioned.svd.matrixU().col(5)) {
    const MachineParameters<double>& model = kinematics.solver().machine();
    const direct::Planes planes(model, conditioned.phi);
    const direct::Elimination elimination = planes.eliminateP();
    const Vector3d omega = conditioned.svd.matrixV().col(5).head<3>() / model.length;
    double h = 0;
    for (int i = 0; i < leg_count; ++i)
      h += left(i) * planes.x(i).dot(omega.cross(omega.cross(motion.Q * model.legs[static_cast<std::size_t>(i)].b)));
    // 64 roundings at the size of the machine, amplified by the elimination of p and the choice of three quadrics.
    const double delta = 64 * eps * conditioned.size / (elimination.normals * elimination.independence);
    uncertainty = std::sqrt(2 * delta / std::abs(h));
  }
};

struct Found {
  int poses = 0, doubles = 0, lost = 0, missing = 0;
  double error = 0;  ///< over the limit
};

void look(const Fold& fold, double offset, double uncertainty, Found& found) {
  const Motion<double> motion = fold.motion(offset);
  const Conditioned conditioned(*fold.made.kinematics, motion);
  const PlatformPoses poses = fold.made.kinematics->poses(conditioned.phi);
  const PlatformPose* pose = nearestPose(poses, motion);
  ++found.poses;
  if (poses.counted != 8) ++found.missing;
  if (pose == nullptr) {
    ++found.lost;
    return;
  }
  if (pose->multiplicity == 2) ++found.doubles;
  const double limit = pose->multiplicity > 1 ? 2 * uncertainty : std::min(conditioned.limit(), 2 * uncertainty);
  const double off = poseError(*pose, motion) / limit;
  found.error = off <= found.error ? found.error : off;
  if (!(off <= 1)) ++found.lost;
}

TEST(DirectKinematics, FindsSingularPosesAsDoubleAndTheirNeighboursAsPairs) {
  const Scenario paper = vectorScenario("paper-helix");
  SeededDraws dice(31);
  Found singular, near, apart;
  for (int folds = 0; folds < 200;) {
    const std::optional<Fold> fold = findFold(paper, dice);
    if (!fold) continue;
    ++folds;
    const double uncertainty = DoubleRoot(*fold->made.kinematics, fold->motion()).uncertainty;
    try {
      look(*fold, 0, uncertainty, singular);
      for (const double offset : {-1e-10, -1e-9, -1e-8, -1e-7, -1e-6, -1e-5}) look(*fold, offset, uncertainty, near);
      look(*fold, -1e-3, uncertainty + 1, apart);
    } catch (const PoseError&) {  // the neighbour is out of reach
    }
  }
  std::cout << "singular poses: " << singular.doubles << " of " << singular.poses << " double, error " << singular.error
            << " of the limit; near ones: " << near.doubles << " of " << near.poses << ", error " << near.error
            << "; 1e-3 away: " << apart.doubles << " of " << apart.poses << ", error " << apart.error << '\n';
  EXPECT_GE(singular.poses, 150);
  EXPECT_EQ(singular.doubles, singular.poses);
  EXPECT_EQ(apart.doubles, 0) << "poses that differ are not one";
  for (const Found& found : {singular, near, apart}) {
    EXPECT_EQ(found.lost, 0);
    EXPECT_EQ(found.missing, 0);
  }
}

/// The angles move across a fold in φ. A φ̇ = B t_P has a solution only for uᵀA φ̇ = 0, so ±A⁻¹u leads to two poses on
/// one side and to none on the other.
TEST(DirectKinematics, APairOfPosesVanishesAcrossAFoldAndTrackingSaysSo) {
  const Scenario paper = vectorScenario("paper-helix");
  SeededDraws dice(37);
  int folds = 0, refused = 0, followed = 0;
  while (folds < 50) {
    const std::optional<Fold> fold = findFold(paper, dice);
    if (!fold) continue;
    const DirectKinematics& kinematics = *fold->made.kinematics;
    const DoubleRoot root(kinematics, fold->motion());
    Vector6d step = root.left;
    Workspace<double> work;
    kinematics.solver().displacements(fold->motion(), work);
    for (int i = 0; i < leg_count; ++i) step(i) /= work.legs[static_cast<std::size_t>(i)].row[0].A;
    const Vector6d ahead = root.conditioned.phi + 1e-4 * step, behind = root.conditioned.phi - 1e-4 * step;
    const PlatformPoses one = kinematics.poses(ahead), other = kinematics.poses(behind);
    if (std::abs(one.size - other.size) != 2) continue;  // another fold within 1e-4
    ++folds;
    const bool vanishes_ahead = one.size < other.size;
    const PlatformPose from = *nearestPose(vanishes_ahead ? other : one, fold->motion());
    if (!kinematics.track(vanishes_ahead ? ahead : behind, from)) ++refused;
    if (kinematics.track((vanishes_ahead ? behind : ahead) + 1e-6 * step, from)) ++followed;
  }
  EXPECT_EQ(refused, folds);
  EXPECT_EQ(followed, folds) << "a refusal that comes whatever is asked for says nothing";
}

/// The pivot ratio with which the machine is refused, or 1.
template <class Change>
double refusal(Change&& change) {
  const Scenario paper = vectorScenario("paper-helix");
  ManipulatorParameters parameters = paper.manipulator->parameters();
  for (int i = 0; i < leg_count; ++i) change(parameters.legs[static_cast<std::size_t>(i)], i);
  const DirectKinematics kinematics{Manipulator(parameters)};
  try {
    const PlatformPoses poses = kinematics.poses((Vector6d() << 0.1, -0.2, 0.3, 0.15, -0.25, 0.35).finished());
    EXPECT_EQ(poses.counted, 8);
  } catch (const UndeterminedPose& refused) {
    EXPECT_LE(refused.measure(), refused.bound());
    return refused.measure();
  }
  return 1;
}

TEST(DirectKinematics, RefusesAnglesThatLeaveThePlatformFree) {
  const auto parallel_axes = [](double tilt) {
    return [tilt](Leg& leg, int i) { leg.base_axis = Vector3d(1, tilt * (i - 2), tilt * i * i); };
  };
  const auto points_in_line = [](double off) {
    return [off](Leg& leg, int i) { leg.platform_point = Vector3d(0.3 * i - 0.7, off * i * (i - 3), off * (i % 2)); };
  };
  const auto points_in_one = [](double off) { return [off](Leg& leg, int) { leg.platform_point *= off; }; };
  EXPECT_LT(refusal(parallel_axes(0)), 1) << "all planes along one axis: free along it";
  EXPECT_LT(refusal(points_in_line(0)), 1) << "all Bᵢ in a line: free to turn about it";
  EXPECT_LT(refusal(points_in_one(0)), 1) << "all Bᵢ in P: free to turn";
  const DirectKinematics of_paper(*vectorScenario("paper-helix").manipulator);
  EXPECT_THROW(of_paper.poses(Vector6d::Zero()), UndeterminedPose) << "all planes upright: free to rise and fall";
  EXPECT_EQ(refusal(parallel_axes(1e-2)), 1);
  EXPECT_EQ(refusal(points_in_line(1e-2)), 1);
  EXPECT_EQ(refusal(points_in_one(1e-2)), 1);
}

TEST(DirectKinematics, RefusesAnglesThatAreNoNumbers) {
  const DirectKinematics kinematics(*vectorScenario("paper-helix").manipulator);
  Vector6d phi = (Vector6d() << 0.1, -0.2, 0.3, 0.15, -0.25, 0.35).finished();
  EXPECT_NO_THROW(kinematics.poses(phi));
  phi(3) = std::nan("");
  EXPECT_THROW(kinematics.poses(phi), std::invalid_argument);
  EXPECT_FALSE(kinematics.track(phi, PlatformPose{}));
}

}  // namespace
}  // namespace ursula
