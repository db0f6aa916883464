#include "validation/samples/engines.h"

namespace ursula {

std::vector<EngineTorques> engineTorques(const Scenario& scenario, const std::vector<double>& instants,
                                         const Deadline& deadline, const OfFurtherEngines<EngineFault>& faults) {
  const OfFurtherEngines<std::unique_ptr<Engine>> engines =
      makeFurtherEngines(*scenario.manipulator, scenario.load, faults);
  std::vector<EngineTorques> out(instants.size());
  for (std::size_t i = 0; i < instants.size(); ++i) {
    deadline.require();
    const Motion<double> motion = scenario.trajectory->at(instants[i]);
    for (std::size_t k = 0; k < furtherEngines().size(); ++k)
      if (engines[k]) out[i][k] = engines[k]->inverseDynamics(motion);
  }
  return out;
}

std::vector<EngineSample> runEngines(const std::vector<EngineTorques>& engines,
                                     const std::vector<PointwiseSample>& samples, const RoundingProfile& profile) {
  std::vector<RemeasuredLimits> looks(furtherEngines().size(), RemeasuredLimits(profile));
  std::vector<EngineSample> out;
  out.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const PointwiseSample& sample = samples[i];
    EngineSample engine;
    engine.t = sample.motion.t;
    engine.subject = sample.torques;
    engine.simbody = sample.torques_simbody;
    engine.further = engines[i];
    engine.limit = sample.torque.limit;
    for (std::size_t k = 0; k < furtherEngines().size(); ++k) {
      if (!engine.further[k]) continue;
      const double error = (engine.subject - *engine.further[k]).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
      engine.limits[k] = looks[k].limit(error, sample.conditioning, ofFurtherEngine(k), sample.motion);
    }
    out.push_back(engine);
  }
  return out;
}

std::vector<EngineSample> runEngines(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                     const RoundingProfile& profile) {
  return runEngines(engineTorques(scenario, instantsOf(samples)), samples, profile);
}

}  // namespace ursula
