// Random scenarios differ in every number, from each other and from leg to leg. Nothing is validated.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "model/machine_numbers.h"
#include "tests/studies/drawn_scenarios.h"
#include "tests/validation/scenario_numbers.h"

namespace ursula {
namespace {

std::vector<ManipulatorParameters> machines() {
  std::vector<ManipulatorParameters> out;
  for (const Scenario& scenario : drawnScenarios()) out.push_back(scenario.manipulator->parameters());
  return out;
}

using Seen = std::map<std::string, std::vector<double>>;

/// The numbers of a machine with six legs of the paper's kind.
std::vector<MachineNumber> numbers() { return machineNumbers({}); }

/// Names of numbers of which two values are equal, or which have fewer values than `at_least`.
std::vector<std::string> constantsIn(const Seen& seen, std::size_t at_least) {
  std::vector<std::string> out;
  for (const auto& [name, values] : seen) {
    const std::set<double> different(values.begin(), values.end());
    if (values.size() < at_least || different.size() != values.size()) out.push_back(name);
  }
  return out;
}

/// Machine numbers that two of the machines share, or that are zero in nearly all.
std::vector<std::string> constantsOf(std::vector<ManipulatorParameters> all) {
  Seen seen;
  for (const MachineNumber& number : numbers()) {
    std::vector<double>& values = seen[number.path];
    for (ManipulatorParameters& machine : all)
      if (const double value = number.get(machine); value != 0) values.push_back(value);
  }
  return constantsIn(seen, all.size() / 5);
}

TEST(RandomMachines, varyInEveryNumber) {
  EXPECT_EQ(numbers().size(), 13u + 6 * 34);
  EXPECT_THAT(constantsOf(machines()), testing::IsEmpty());
}

/// Negative control: a generator that never varies one number is detected, with the number's name.
TEST(RandomMachines, wouldBeFoundOutWithOneNumberConstant) {
  std::vector<ManipulatorParameters> all = machines();
  all.resize(60);
  for (const MachineNumber& number : numbers()) {
    std::vector<ManipulatorParameters> fake = all;
    for (ManipulatorParameters& machine : fake) number.set(machine, 0.25);
    EXPECT_THAT(constantsOf(fake), testing::Contains(number.path));
    for (ManipulatorParameters& machine : fake) number.set(machine, 0);
    EXPECT_THAT(constantsOf(fake), testing::Contains(number.path));
  }
}

/// Every kind of motion and of load has numbers that vary, too.
TEST(RandomScenarios, varyInMotionAndLoad) {
  Seen seen;
  const auto note = [&](const std::vector<NamedNumber>& found) {
    for (const NamedNumber& number : found) seen[number.name].push_back(number.value);
  };
  for (const Scenario& scenario : drawnScenarios()) {
    note(motionNumbers(*scenario.trajectory));
    if (scenario.load) note(loadNumbers(*scenario.load, scenario.trajectory->duration()));
  }
  // The helix's normal is level, so its triad has an entry that is always zero.
  for (auto entry = seen.begin(); entry != seen.end();)
    entry = entry->first.find("helix") == 0 && entry->second.front() == 0 ? seen.erase(entry) : std::next(entry);
  EXPECT_EQ(seen.size(), 4u * 37 - 3 + 2 * 21);
  EXPECT_THAT(constantsIn(seen, scenarios_drawn / 20), testing::IsEmpty());
}

}  // namespace
}  // namespace ursula
