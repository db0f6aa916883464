#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/evidence/injected_fault.h"
#include "validation/subject/parameters.h"
#include "validation/subject/subject.h"

namespace ursula {

/// One defect in an otherwise right validation, at one of three places. Empty members change nothing.
struct Defect {
  std::string name;
  std::string group;            ///< "formula", "term", "parameter", …
  SubjectOf subject = nullptr;  ///< the solver under test
  InjectedFault::ScenarioChange scenario =
      nullptr;               ///< the changed scenario for all formulations: commanded motion, load
  InjectedFault fault = {};  ///< a changed experiment
  /// Number of formulations that must catch it. It is 1 if by its nature only one can see it. Such defects are in
  /// direct dynamics and reactions (only Simbody has them), in shared parts, or in an engine, or do not affect the
  /// motion.
  int engines = 2;
  bool control = false;  ///< no defect, but the same mechanism: it must pass
};

/// Returns every defect that `ursula prove` injects into this machine, one at a time, at least 150. Parts that a
/// machine lacks (a knee, a sliding coordinate) have no defect; some defects of zero values change nothing.
std::vector<Defect> allDefects(const Manipulator& machine);

/// The solver with one wrong parameter.
Subject disturbedSubject(const Scenario& scenario, const Parameter& parameter, double relative);

}  // namespace ursula
