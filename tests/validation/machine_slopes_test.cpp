// What changes of a machine do to its torques, by exact derivatives, against differences of the torques themselves.

#include "parts/causes/machine_slopes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "model/scenario.h"
#include "parts/causes/tied_parameters.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using Rows = std::vector<Vector6d>;

Rows differences(const Scenario& scenario, const MachineSlopes::Change& change,
                 const std::vector<Motion<double>>& motions) {
  constexpr double step = 1e-5;
  const auto at = [&](double x) {
    ManipulatorParameters machine = scenario.manipulator->parameters();
    change(machine, x);
    return nocSubject(Manipulator(machine), scenario.load);
  };
  const Subject above = at(step), below = at(-step);
  Rows out;
  for (const Motion<double>& motion : motions)
    out.emplace_back((above.torques(motion) - below.torques(motion)) / (2 * step));
  return out;
}

class SlopesOf : public testing::TestWithParam<const char*> {};

TEST_P(SlopesOf, areThoseOfTheTorques) {
  const Scenario scenario = readScenario(std::string(URSULA_SCENARIOS "/") + GetParam() + ".toml");
  std::vector<Motion<double>> motions;
  for (const double share : {0.1, 0.45, 0.8})
    motions.push_back(scenario.trajectory->at(share * scenario.trajectory->duration()));
  MachineSlopes slopes(scenario);
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  double size = 0;
  for (const Motion<double>& motion : motions) size = std::max(size, right.torques(motion).norm());
  int seen = 0;
  for (const TiedParameters& tied : tiedParameters(*scenario.manipulator)) {
    const NumberGroup group = tied.members.front().group();
    if (group == NumberGroup::inertia || group == NumberGroup::friction) continue;
    const auto change = [&tied](ManipulatorParameters& machine, double x) { tied.disturb(machine, x); };
    const Rows found = slopes.along(change, motions), expected = differences(scenario, change, motions);
    ASSERT_EQ(found.size(), motions.size());
    for (std::size_t k = 0; k < motions.size(); ++k) {
      EXPECT_LE((found[k] - expected[k]).norm(), 1e-7 * (expected[k].norm() + size)) << tied.words;
      if (expected[k].norm() > 1e-3 * size) ++seen;
    }
  }
  EXPECT_GT(seen, 30);
}

INSTANTIATE_TEST_SUITE_P(Machines, SlopesOf, testing::Values("proving-ground", "ups-friction-load", "mixture"),
                         [](const auto& name) {
                           std::string out = name.param;
                           for (char& letter : out)
                             if (letter == '-') letter = '_';
                           return out;
                         });

}  // namespace
}  // namespace ursula
