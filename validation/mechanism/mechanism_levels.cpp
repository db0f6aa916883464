#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simbody/simbody_mechanism.h"
#include "validation/mechanism/mechanism_evidence.h"

namespace ursula {

double MechanismEvidence::shape(const MechanismSample& sample, Eigen::Index k) const {
  return rounding * sample.condition * sample.condition * sample.scale(k) * efforts_in(k);
}

MotorEfforts MechanismEvidence::response(const MechanismSample& sample) const {
  MotorEfforts each(sample.scale.size());
  for (Eigen::Index k = 0; k < each.size(); ++k) each(k) = shape(sample, k) / efforts_in(k);
  return sample.inverse_inertia.cwiseAbs() * each;
}

SimbodyMechanism& MechanismEvidence::placed() const {
  for (const MechanismEngine& engine : engines)
    if (engine.placed) return *engine.placed;
  throw std::logic_error("no engine has placed a loop");
}

double MechanismEvidence::levelOfSimbody() const {
  double out = 0;
  for (const MechanismEngine& engine : engines)
    if (engine.engine == "Simbody") out = std::max(out, engine.level);
  return out;
}

namespace {

/// Moves each number by one rounding, or zeros by one of the largest.
MotorMotion movedByRounding(MotorMotion motion) {
  double sign = 1;
  for (Eigen::VectorXd* each : {&motion.q, &motion.qdot, &motion.qddot}) {
    const double size = std::max(each->cwiseAbs().maxCoeff(), 1e-3);
    for (Eigen::Index k = 0; k < each->size(); ++k, sign = -sign) (*each)(k) += sign * rounding * size;
  }
  return motion;
}

constexpr double safety = 10;  // as for manipulators

/// Returns some of the samples.
std::vector<const MechanismSample*> someOf(const std::vector<MechanismSample>& samples) {
  constexpr std::size_t instants = 12;
  const std::size_t step = std::max<std::size_t>(1, samples.size() / instants);
  std::vector<const MechanismSample*> out;
  for (std::size_t i = 0; i < samples.size(); i += step) out.push_back(&samples[i]);
  return out;
}

/// Measures how the NOC's efforts change if the motion, or time, changes by one rounding.
void measureMotion(const MechanismSample& sample, const MotorMotion& moved, MechanismEvidence& evidence) {
  const LoopMotion& motion = *evidence.motion;
  LoopWork work;
  loops::LoopPose pose = motion.near(sample.motion.t);
  motion.solver().moveTo(moved.q, pose);
  MotorEfforts change = (motion.solver().inverseDynamics(moved, pose, work) - sample.noc).cwiseAbs();
  const double duration = motion.trajectory().duration();
  const double later =
      sample.motion.t < duration / 2 ? sample.motion.t + rounding * duration : sample.motion.t - rounding * duration;
  change += (motion.inverseDynamics(later, work) - sample.noc).cwiseAbs();
  for (Eigen::Index k = 0; k < change.size(); ++k)
    if (const double shape = evidence.shape(sample, k); shape > 0)
      evidence.motion_level = std::max(evidence.motion_level, safety * change(k) * evidence.efforts_in(k) / shape);
}

/// The efforts at an instant of an engine that stands at the motion's end. Straight from there the loops may lead
/// through a singular pose, which the motion avoids: then it goes back along the samples.
MotorEfforts askedAgain(const MechanismEngine& engine, const MotorMotion& motion,
                        const std::vector<MechanismSample>& samples) {
  try {
    return engine.efforts(motion);
  } catch (const std::domain_error&) {
    for (auto sample = samples.rbegin(); sample != samples.rend() && sample->motion.t >= motion.t; ++sample)
      engine.efforts(sample->motion);
    return engine.efforts(motion);
  }
}

}  // namespace

void measureLevels(MechanismEvidence& evidence) {
  for (const MechanismSample* sample : someOf(evidence.samples)) {
    const MotorMotion moved = movedByRounding(sample->motion);
    measureMotion(*sample, moved, evidence);
    for (std::size_t e = 0; e < evidence.engines.size(); ++e) {
      MechanismEngine& engine = evidence.engines[e];
      const MotorEfforts change = askedAgain(engine, moved, evidence.samples) - sample->engines[e];
      for (Eigen::Index k = 0; k < change.size(); ++k)
        if (const double shape = evidence.shape(*sample, k); shape > 0)
          engine.level = std::max(engine.level, safety * std::abs(change(k)) * evidence.efforts_in(k) / shape);
    }
    const MotorEfforts change = evidence.placed().accelerations(sample->subject) - sample->acceleration;
    const MotorEfforts response = evidence.response(*sample);
    for (Eigen::Index k = 0; k < change.size(); ++k)
      if (response(k) > 0)
        evidence.acceleration_level = std::max(evidence.acceleration_level, safety * std::abs(change(k)) / response(k));
  }
}

}  // namespace ursula
