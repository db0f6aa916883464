#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/evidence/injected_fault.h"
#include "validation/subject/parameters.h"
#include "validation/subject/subject.h"

namespace ursula {

/// One way to be wrong, put into an otherwise right validation at one of three places. What is empty stays right.
struct Defect {
  std::string name;
  std::string group;                       ///< "formula", "term", "parameter", …
  SubjectOf subject = nullptr;             ///< the solver on trial
  InjectedFault::Seen scenario = nullptr;  ///< what all formulations are given: commanded motion, load
  InjectedFault fault = {};                ///< an experiment
  /// On how many formulations it must be caught. 1 where by its nature only one can see it: direct dynamics and
  /// reactions, which Simbody alone has beside the solver; what all formulations share; an engine; what the motion does
  /// not reach.
  int engines = 2;
  bool control = false;  ///< no defect, by the mechanism of others: it must pass
};

/// Every defect that `ursula prove` injects into this machine, at least 150, one at a time. What a machine has not (a
/// knee, a coordinate that slides) has no defect; what is zero in it has some that change nothing.
std::vector<Defect> allDefects(const Manipulator& machine);

/// The solver with one parameter wrong.
Subject disturbedSubject(const Scenario& scenario, const Parameter& parameter, double relative);

}  // namespace ursula
