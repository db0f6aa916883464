// Several errors of a scenario at once.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "model/scenario.h"
#include "model/scenario_excerpt.h"
#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/model/scenario_text.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

std::string changed(std::initializer_list<std::pair<const char*, const char*>> changes) {
  std::string text = good_scenario;
  for (const auto& [from, to] : changes) text = replaced(text, from, to);
  return text;
}

/// "6:1 unknown key 'mas'", a line for each error.
std::vector<std::string> errorsAt(const std::string& text, const std::filesystem::path& file) {
  std::istringstream lines(refusal<ScenarioError>([&] { parseScenario(text, file); }));
  std::vector<std::string> out;
  for (std::string line; std::getline(lines, line);) out.push_back(line.substr(0, line.find(", expected")));
  return out;
}
std::vector<std::string> errorsOf(const std::string& text) { return errorsAt(text, "a.toml"); }

TEST(ScenarioErrors, areAllToldInTheOrderOfTheFile) {
  const std::string text = changed({{"mass = 500.0", "zz = 1\naa = 2"},
                                    {"platform_point = [0.0667", "platform_pt = [0.0667"},
                                    {"base_axis = [-0.9397, 0.0, 0.3420]", "base_axis = \"up\""},
                                    {"mass = 9.0", "mass = -9.0"},
                                    {"radius = 0.2", "radius = [0.2]"},
                                    {"duration = 3.0", "duration = 0"}});
  EXPECT_THAT(
      errorsOf(text),
      testing::ElementsAre(HasSubstr("unknown key 'zz'"), HasSubstr("unknown key 'aa'"),
                           HasSubstr("manipulator.leg_defaults.distal.mass: -9"),
                           HasSubstr("manipulator.leg[1].base_axis: a string"), HasSubstr("unknown key 'platform_pt'"),
                           HasSubstr("trajectory.duration: 0"), HasSubstr("trajectory.radius: an array")));
}

TEST(ScenarioErrors, areToldOnceEach) {
  EXPECT_THAT(errorsOf(changed({{"mass = 500.0", "mass = -500.0"}, {"mass = 9.0", "mass = -9.0"}})),
              testing::ElementsAre(HasSubstr("manipulator.platform.mass: -500"),
                                   HasSubstr("manipulator.leg_defaults.distal.mass: -9")));
  EXPECT_EQ(errorsOf(changed({{"mass = 9.0", "mass = -9.0"}})).size(), 1u) << "six legs have this link";
}

TEST(ScenarioErrors, includeWhatOnlyTheReaderKnows) {
  EXPECT_THAT(
      errorsOf(
          changed({{"inertia = [3.3, 3.3, 0.015]", "inertia = [33.0, 3.3, 0.015]"}, {"pitch = 1.2", "pitch = 0"}})),
      testing::ElementsAre(HasSubstr("manipulator.leg_defaults.distal.inertia"), HasSubstr("trajectory.pitch: 0")));
}

/// Beside an error, no valid value is called wrong: each shipped scenario with one wrong key has one error.
TEST(ScenarioErrors, leaveValidValuesAlone) {
  int scenarios = 0;
  for (const auto& entry : std::filesystem::directory_iterator(URSULA_SCENARIOS)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string text = TemporaryFolder::read(entry.path()) + "\n[zz]\na = 1\n";
    EXPECT_THAT(errorsAt(text, entry.path()), testing::ElementsAre(HasSubstr("unknown key 'zz'"))) << entry.path();
    ++scenarios;
  }
  EXPECT_GT(scenarios, 20);
  std::string carriages =
      TemporaryFolder::read(std::string(URSULA_SCENARIOS) + "/../apps/starting/PUS.toml") + "\n[zz]\na = 1\n";
  carriages = replaced(carriages, "proximal = {", "proximal = { length = 0.0,");
  EXPECT_THAT(errorsOf(carriages), testing::ElementsAre(HasSubstr("unknown key 'zz'")));
  EXPECT_EQ(errorsOf(replaced(carriages, "mass = 8.0", "mass = -8.0")).size(), 2u);
}

TEST(ScenarioErrors, areAtMostTen) {
  std::string text = good_scenario, keys;
  for (int k = 1; k <= 12; ++k) keys += fmt::format("odd_{} = {}\n", k, k);
  text = replaced(text, "[manipulator]\n", "[manipulator]\n" + keys);
  const std::vector<std::string> errors = errorsOf(text);
  ASSERT_EQ(errors.size(), 11u);
  EXPECT_THAT(errors.front(), HasSubstr("unknown key 'odd_1'"));
  EXPECT_THAT(errors[9], HasSubstr("unknown key 'odd_10'"));
  EXPECT_EQ(errors.back(), "and 2 more errors");
}

TEST(ScenarioErrors, haveTheirLinesWithACaret) {
  try {
    parseScenario(changed({{"mass = 500.0", "mas = 500.0"}, {"pitch = 1.2", "pitch = 0"}}), "a.toml");
    FAIL() << "nothing thrown";
  } catch (const ScenarioError& error) {
    const std::string said = atLength(error);
    EXPECT_EQ(std::count(said.begin(), said.end(), '^'), 2) << said;
    EXPECT_THAT(said, HasSubstr("mas = 500.0\n"));
    EXPECT_THAT(said, HasSubstr("pitch = 0\n"));
    EXPECT_LT(said.find("mas = 500.0"), said.find("trajectory.pitch: 0"));
  }
}

}  // namespace
}  // namespace ursula
