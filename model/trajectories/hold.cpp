#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/errors.h"
#include "base/real50.h"
#include "model/exact_trajectory.h"
#include "model/pose_spline.h"
#include "model/scenario_keys.h"
#include "model/trajectories/trajectories.h"
#include "model/trajectories/trajectory_kinds.h"

namespace ursula {

template <class S>
class HoldKernel {
 public:
  HoldKernel(const Vector3d& position, const Eigen::Vector4d& orientation) {
    pose_.p = position.cast<S>();
    const Eigen::Quaterniond q(orientation(0), orientation(1), orientation(2), orientation(3));
    pose_.Q = q.cast<S>().normalized().toRotationMatrix();
  }

  Motion<S> at(const S& t) const {
    Motion<S> motion = pose_;
    motion.t = t;
    return motion;
  }

 private:
  Motion<S> pose_;
};

std::unique_ptr<Trajectory> makeHold(const Vector3d& position, const Eigen::Vector4d& orientation, double duration) {
  if (!position.allFinite()) throw InvalidParameter("trajectory.position", "a non-finite entry", "finite numbers");
  requireUnit(orientation, 1e-3, [](const std::string& value, const std::string& bound) {
    throw InvalidParameter("trajectory.orientation", value, bound);
  });
  if (!(std::isfinite(duration) && duration > 0))
    throw InvalidParameter("trajectory.duration", fmt::format("{}", duration), "> 0 and finite");
  return std::make_unique<KernelTrajectory<HoldKernel>>(
      "hold", duration, HoldKernel<double>(position, orientation), HoldKernel<Real50>(position, orientation),
      [=](const Vector3d& origin) { return makeHold(position - origin, orientation, duration); });
}

std::vector<ScenarioTable> holdKeys() {
  return {{"trajectory.hold",
           "[trajectory], kind = \"hold\"",
           "Stays where it is.",
           {kindKey(),
            positionKey(),
            orientationKeys()[0],
            orientationKeys()[1],
            {"duration", KeyType::number, "s", required_key, "", above_zero}}}};
}

std::shared_ptr<const Trajectory> readHold(const TomlSection& table) {
  table.allowOnly(scenarioTable("trajectory.hold"));
  TimedPose pose;
  double duration = 0;
  table.require("position", pose.position);
  pose.orientation = readOrientation(table);
  table.require("duration", duration);
  return makeHold(pose.position, pose.orientation, duration);
}

}  // namespace ursula
