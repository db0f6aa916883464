#include "tests/support/motions.h"

#include <Eigen/Geometry>
#include <vector>

#include "model/trajectories/trajectories.h"

namespace ursula {
namespace {

Motion<double> deviated(Motion<double> motion, SeededDraws& dice) {
  motion.p += dice.vector(0.05);
  const Vector3d turn = dice.vector(0.1);
  motion.Q = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * motion.Q;
  return motion;
}

}  // namespace

std::unique_ptr<Trajectory> tumbling(const Scenario& scenario, unsigned seed) {
  SeededDraws dice(seed);
  const double duration = scenario.trajectory->duration();
  std::vector<TimedPose> points;
  for (int k = 0; k < 5; ++k) {
    const double t = duration * k / 4;
    const Motion<double> motion = deviated(scenario.trajectory->at(t), dice);
    const Eigen::Quaterniond q(motion.Q);
    points.push_back({t, motion.p, {q.w(), q.x(), q.y(), q.z()}});
  }
  return makeWaypoints(points);
}

Motion<double> randomState(const Scenario& scenario, SeededDraws& dice) {
  Motion<double> motion = deviated(scenario.trajectory->at(dice.between(0, scenario.trajectory->duration())), dice);
  motion.omega = dice.vector(1);
  motion.p_dot = dice.vector(1);
  motion.omega_dot = dice.vector(2);
  motion.p_ddot = dice.vector(2);
  return motion;
}

}  // namespace ursula
