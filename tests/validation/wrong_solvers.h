#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/instants.h"
#include "parts/causes/asked_apart.h"
#include "parts/causes/diagnosis.h"
#include "parts/causes/tried_causes.h"
#include "tests/support/changed.h"
#include "tests/support/motions.h"
#include "tests/support/vectors.h"
#include "validation/subject/torque_file.h"

namespace ursula {

using Machine = ManipulatorParameters;
using Answering = std::function<Vector6d(const Motion<double>&)>;
using Rows = std::vector<Vector6d>;

/// A scenario at equally spaced instants, and what is said of somebody's efforts there.
struct Trial {
  Scenario scenario;
  int count = 41;

  std::vector<double> t() const { return equallySpaced(scenario.trajectory->duration(), count); }
  std::vector<Motion<double>> motions() const {
    std::vector<Motion<double>> out;
    for (const double at : t()) out.push_back(scenario.trajectory->at(at));
    return out;
  }
  Rows answers(const Answering& solver) const {
    Rows out;
    for (const Motion<double>& motion : motions()) out.push_back(solver(motion));
    return out;
  }
  /// The right solver, or one of another machine.
  Answering solver(const MachineChange& change = [](Machine&) {}) const {
    return nocSubject(withoutStroke(*changed(scenario, change).manipulator), scenario.load).torques;
  }
  Rows right() const { return answers(solver()); }
  Rows rightBut(const std::function<void(std::size_t k, Vector6d&)>& change) const {
    Rows out = right();
    for (std::size_t k = 0; k < out.size(); ++k) change(k, out[k]);
    return out;
  }
  Diagnosis said(const Rows& efforts, const AskedApart& asked = {}) const {
    const GivenTorques given{"solver", t(), efforts};
    return diagnose(scenario, runExternal(scenario, torqueFileOf(given, scenario.manipulator->motors())), asked);
  }
  Diagnosis said(const MachineChange& change) const { return said(answers(solver(change))); }
};

inline const Trial& onHelix() {
  static const Trial trial{vectorScenario("paper-helix"), 61};
  return trial;
}

/// A scenario of the source tree, on a motion that turns about every axis.
inline Scenario tumblingOf(const std::string& path) {
  Scenario out = readScenario(std::string(URSULA_SOURCE) + path);
  out.trajectory = std::shared_ptr<const Trajectory>(tumbling(out, 3));
  return out;
}

/// Expects that a cause is named, of this kind.
inline NamedCause named(const Diagnosis& said, CauseKind kind) {
  EXPECT_TRUE(said.named) << said.cause;
  const NamedCause found = said.named.value_or(NamedCause{});
  EXPECT_EQ(found.kind, kind) << said.cause;
  return found;
}

}  // namespace ursula
