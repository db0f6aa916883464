#include "parts/random/random_parts.h"

#include <algorithm>
#include <cmath>

#include "base/scalar.h"
#include "model/trajectories/trajectories.h"

namespace ursula {
namespace {

using Shift = Eigen::Matrix<double, 6, 1>;  ///< of the platform's middle in lengths, and its rotation as a vector

/// Moves the design's pose by the platform's middle instead of P, so that rotations about a distant P do not move the
/// platform away.
TimedPose poseAt(const RandomRecipe& recipe, const Design& design, double time, const Shift& shift) {
  const Vector3d middle = design.position + design.orientation * design.middle + recipe.length * shift.head<3>();
  const double angle = shift.tail<3>().norm();
  const Vector3d axis = angle > 0 ? Vector3d(shift.tail<3>() / angle) : Vector3d(Vector3d::UnitX());
  const Eigen::Quaterniond q = (Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)) * design.orientation).normalized();
  TimedPose pose;
  pose.time = time;
  pose.position = middle - q * design.middle;
  pose.orientation << q.w(), q.vec();
  return pose;
}

/// The size of a motion, in lengths and in radians.
struct Reach {
  double shift, turn;
  Shift draw(Dice& dice) const {
    Shift out;
    out << dice.vector(shift), dice.vector(turn);
    return out;
  }
};

Reach randomReach(Dice& dice, double share) {
  return {share * dice.uniform(0.05, 0.2), share * dice.uniform(0.05, 0.3)};
}

std::shared_ptr<const Trajectory> helixMotion(const Design& design, double share) {
  HelixParameters helix = design.helix;
  const double middle = (helix.start_angle + helix.end_angle) / 2;
  const double half = share * (helix.end_angle - helix.start_angle) / 2;
  helix.start_angle = middle - half;
  helix.end_angle = middle + half;
  for (double* rate : {&helix.start_rate, &helix.end_rate, &helix.start_acceleration, &helix.end_acceleration})
    *rate *= share;
  return makeHelix(helix);
}

std::shared_ptr<const Trajectory> holdMotion(Dice& dice, const RandomRecipe& recipe, const Design& design,
                                             double share) {
  const TimedPose pose = poseAt(recipe, design, 0, randomReach(dice, share).draw(dice));
  return makeHold(pose.position, pose.orientation, recipe.duration);
}

/// Times from 0 to `duration` whose intervals differ by a factor of up to `uneven`.
std::vector<double> randomTimes(Dice& dice, double duration, int count, double uneven) {
  std::vector<double> times{0};
  for (int k = 1; k < count; ++k) times.push_back(times.back() + dice.spread(1, uneven));
  const double last = times.back();
  for (double& time : times) time *= duration / last;
  return times;
}

/// Returns waypoints of one of three sorts: a few at nearly even times; many, each near its predecessor; or some
/// intervals of a twentieth of the others.
std::shared_ptr<const Trajectory> waypointMotion(Dice& dice, const RandomRecipe& recipe, const Design& design,
                                                 double share) {
  const bool tight = recipe.pace == Pace::tight, abrupt = recipe.pace == Pace::abrupt;
  const int count = tight ? dice.whole(8, 24) : dice.whole(2, 5) + (abrupt ? 1 : 0);
  const Reach reach = randomReach(dice, share);
  const double step = tight ? 0.3 : 1;
  std::vector<TimedPose> points;
  Shift shift = reach.draw(dice);
  for (const double time : randomTimes(dice, recipe.duration, count, abrupt ? 20 : 3)) {
    points.push_back(poseAt(recipe, design, time, shift));
    shift = (1 - step) * shift + step * reach.draw(dice);
  }
  return makeWaypoints(points);
}

/// A sum of two oscillations in each of six directions.
class Waves {
 public:
  Waves(Dice& dice, const Reach& reach, double most_turns) {
    for (int k = 0; k < 2; ++k) {
      amplitudes_[k] = reach.draw(dice) / 2;
      for (int j = 0; j < 6; ++j) {
        turns_[k](j) = dice.uniform(0.2, most_turns);
        phases_[k](j) = dice.uniform(-pi, pi);
      }
    }
  }
  Shift at(double s) const {
    Shift out = Shift::Zero();
    for (int k = 0; k < 2; ++k)
      out.array() += amplitudes_[k].array() * (2 * pi * s * turns_[k] + phases_[k]).array().sin();
    return out;
  }

 private:
  Shift amplitudes_[2], turns_[2], phases_[2];
};

/// Returns the size of noise in lengths. Noise of ε lengths at intervals h causes accelerations of ε / h², which are
/// limited to a few times the machine's unit.
double noiseOf(Dice& dice, const RandomRecipe& recipe, double share, int count) {
  if (!recipe.noisy) return 0;
  const double h = recipe.duration / recipe.time() / (count - 1);
  return share * std::min(dice.spread(0.003, 1) * h * h, 0.01);
}

std::shared_ptr<const Trajectory> sampleMotion(Dice& dice, const RandomRecipe& recipe, const Design& design,
                                               double share) {
  const int count = recipe.pace == Pace::tight ? dice.whole(40, 120) : dice.whole(7, 40);
  // The waves have at least six samples per turn, and no more turns than natural times.
  const double most = std::min(1 + recipe.duration / recipe.time(), count / 6.0);
  const Waves waves(dice, randomReach(dice, share), std::max(most, 0.3));
  const double noise = noiseOf(dice, recipe, share, count);
  const double uneven = dice.chance(0.5) ? 1 : 1.5;
  std::vector<TimedPose> samples;
  for (const double time : randomTimes(dice, recipe.duration, count, uneven)) {
    const Shift shaken = waves.at(time / recipe.duration) + Reach{noise, noise}.draw(dice);
    samples.push_back(poseAt(recipe, design, time, shaken));
  }
  return makeSamples(samples);
}

}  // namespace

std::shared_ptr<const Trajectory> randomMotion(Dice& dice, const RandomRecipe& recipe, const Design& design,
                                               double share) {
  switch (recipe.motion) {
    case MotionKind::helix:
      return helixMotion(design, share);
    case MotionKind::hold:
      return holdMotion(dice, recipe, design, share);
    case MotionKind::waypoints:
      return waypointMotion(dice, recipe, design, share);
    case MotionKind::samples:
      break;
  }
  return sampleMotion(dice, recipe, design, share);
}

}  // namespace ursula
