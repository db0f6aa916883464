#include "validation/samples/roads.h"

#include "model/loops/maximal/maximal_loop.h"
#include "model/loops/mujoco/mujoco_loop.h"
#include "model/loops/simbody/simbody_loop.h"

namespace ursula {

std::vector<RoadTorques> roadTorques(const Scenario& scenario, const std::vector<PointwiseSample>& samples) {
  SimbodyLoop twin(*scenario.manipulator, SimbodyLoop::Topology::tree_through_leg_1, scenario.load);
  MaximalLoop maximal(*scenario.manipulator, scenario.load);
  const auto mujoco = makeMujocoLoop(*scenario.manipulator, scenario.load);
  std::vector<RoadTorques> out;
  out.reserve(samples.size());
  for (const PointwiseSample& sample : samples) {
    RoadTorques road;
    twin.place(sample.motion);
    road.twin = twin.inverseDynamics();
    road.maximal = maximal.inverseDynamics(sample.motion);
    if (mujoco) road.mujoco = mujoco->inverseDynamics(sample.motion);
    out.push_back(road);
  }
  return out;
}

std::vector<RoadSample> runRoads(const std::vector<RoadTorques>& roads, const std::vector<PointwiseSample>& samples,
                                 const RoundingProfile& profile) {
  SecondLook look_twin(profile), look_maximal(profile), look_mujoco(profile);
  std::vector<RoadSample> out;
  out.reserve(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const PointwiseSample& sample = samples[k];
    RoadSample road;
    road.t = sample.motion.t;
    road.conditioning = sample.conditioning;
    road.subject = sample.torques;
    road.simbody = sample.torques_simbody;
    road.twin = roads[k].twin;
    road.maximal = roads[k].maximal;
    road.mujoco = roads[k].mujoco;
    const auto limit = [&](SecondLook& look, Rounded quantity, const Vector6d& torques) {
      const double error = (road.subject - torques).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
      return look.limit(error, sample.conditioning, quantity, sample.motion);
    };
    road.limit_twin = limit(look_twin, Rounded::twin, road.twin);
    road.limit_maximal = limit(look_maximal, Rounded::maximal, road.maximal);
    road.limit_mujoco = road.mujoco ? limit(look_mujoco, Rounded::mujoco, *road.mujoco) : 0;
    road.limit = sample.torque.limit + road.limit_twin + road.limit_maximal + road.limit_mujoco;
    out.push_back(road);
  }
  return out;
}

std::vector<RoadSample> runRoads(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                 const RoundingProfile& profile) {
  return runRoads(roadTorques(scenario, samples), samples, profile);
}

}  // namespace ursula
