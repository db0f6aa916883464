#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/instants.h"
#include "tests/support/vectors.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/subject.h"
#include "validation/validate.h"

namespace ursula {

inline Subject solverOf(const Scenario& scenario) { return nocSubject(*scenario.manipulator, scenario.load); }

/// Another instant count, for speed.
inline Scenario scenarioOf(const std::string& name, int samples) {
  Scenario scenario = scenarioOf(name);
  scenario.simulation.samples = samples;
  return scenario;
}

/// The reference of that scenario, made once for all tests of a process.
inline std::shared_ptr<const Reference> referenceOf(const std::string& name, int samples) {
  static std::map<std::pair<std::string, int>, std::shared_ptr<const Reference>> made;
  std::shared_ptr<const Reference>& reference = made[{name, samples}];
  if (!reference) reference = makeReference(scenarioOf(name, samples));
  return reference;
}

using TorqueChange = std::function<Vector6d(const Motion<double>& motion, const Vector6d& torques)>;

/// The subject with other torques, made of its own.
inline Subject changedTorques(Subject subject, const TorqueChange& change) {
  subject.torques = [right = subject.torques, change](const Motion<double>& motion) {
    return change(motion, right(motion));
  };
  return subject;
}

inline Subject scaledTorques(const Subject& subject, double factor) {
  return changedTorques(subject, [factor](const auto&, const Vector6d& torques) { return Vector6d(factor * torques); });
}

/// The solver's torques without its other answers.
inline Subject torquesAlone(const Scenario& scenario) {
  Subject subject = solverOf(scenario);
  subject.kinematics = nullptr;
  subject.accelerations = nullptr;
  subject.rebuilt = nullptr;
  return subject;
}

/// The solver's pointwise samples at equally spaced instants.
inline std::vector<PointwiseSample> rightSamples(const Scenario& scenario, int count) {
  return runPointwise(scenario, solverOf(scenario), equallySpaced(scenario.trajectory->duration(), count));
}

}  // namespace ursula
