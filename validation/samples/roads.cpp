#include "validation/samples/roads.h"

namespace ursula {

std::vector<RoadTorques> roadTorques(const Scenario& scenario, const std::vector<double>& instants) {
  const OfFurtherRoads<std::unique_ptr<Road>> roads = makeFurtherRoads(*scenario.manipulator, scenario.load);
  std::vector<RoadTorques> out(instants.size());
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const Motion<double> motion = scenario.trajectory->at(instants[i]);
    for (std::size_t k = 0; k < further_road_count; ++k)
      if (roads[k]) out[i][k] = roads[k]->inverseDynamics(motion);
  }
  return out;
}

std::vector<RoadSample> runRoads(const std::vector<RoadTorques>& roads, const std::vector<PointwiseSample>& samples,
                                 const RoundingProfile& profile) {
  std::vector<SecondLook> looks(further_road_count, SecondLook(profile));
  std::vector<RoadSample> out;
  out.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const PointwiseSample& sample = samples[i];
    RoadSample road;
    road.t = sample.motion.t;
    road.conditioning = sample.conditioning;
    road.subject = sample.torques;
    road.simbody = sample.torques_simbody;
    road.further = roads[i];
    road.limit = sample.torque.limit;
    for (std::size_t k = 0; k < further_road_count; ++k) {
      if (!road.further[k]) continue;
      const double error = (road.subject - *road.further[k]).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
      road.limits[k] = looks[k].limit(error, sample.conditioning, ofFurtherRoad(k), sample.motion);
      road.limit += road.limits[k];
    }
    out.push_back(road);
  }
  return out;
}

std::vector<RoadSample> runRoads(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                 const RoundingProfile& profile) {
  return runRoads(roadTorques(scenario, instantsOf(samples)), samples, profile);
}

}  // namespace ursula
