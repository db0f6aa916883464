#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/subject.h"

namespace ursula {

/// One way for the solver's side to be wrong, put into an otherwise right solver.
struct Defect {
  std::string name;
  std::string group;  ///< "formula", "term", "parameter", "motion" or "torque"
  std::function<Subject(const Scenario&)> subject;
};

/// Every defect that `ursula prove` injects, at least 60, one at a time.
std::vector<Defect> allDefects();

/// A continuous parameter of the machine: `disturb` makes it wrong by a relative error (of the largest moment for an
/// inertia entry, of the vector's norm for points, turned by that angle for axes).
struct Parameter {
  std::string name;   ///< "leg[2].proximal.mass"
  std::string group;  ///< "mass", "center", "length", "point", "axis", "inertia", "gravity", "friction"
  std::function<void(ManipulatorParameters&, double relative)> disturb;
};

/// All of them: 13 of platform and gravity, and those of six legs.
std::vector<Parameter> allParameters();

/// The solver with one parameter wrong.
Subject disturbedSubject(const Scenario& scenario, const Parameter& parameter, double relative);

}  // namespace ursula
