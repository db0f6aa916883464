#include <gtest/gtest.h>

#include "model/number_tolerances.h"
#include "model/scenario_files.h"
#include "model/scenario_json.h"
#include "tests/model/scenario_text.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

const char* const mass = "mass = 500.0";

std::string withMass(const std::string& written) { return replaced(good_scenario, mass, written); }

std::string refusalOf(const std::string& text) {
  try {
    parseScenario(text, "s.toml");
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

TEST(Tolerances, valueIsReadAndToleranceIsStated) {
  const Scenario scenario = parseScenario(withMass("mass = { value = 501.0, tolerance = 2.5 }"), "s.toml");
  EXPECT_EQ(scenario.manipulator->platform().mass, 501.0);
  const NumberTolerances found = statedTolerances(scenario);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.at("manipulator.platform.mass"), 2.5);
  EXPECT_TRUE(statedTolerances(parseScenario(good_scenario, "s.toml")).empty());
}

TEST(Tolerances, ofArraysAreForAllEntriesOrOneEach) {
  const std::string center = "center_of_mass = [0.0, 0.0, 1.88]";
  const auto with = [&](const std::string& written) {
    return statedTolerances(parseScenario(replaced(good_scenario, center, written), "s.toml"));
  };
  for (const char* written : {"center_of_mass = { value = [0.0, 0.0, 1.88], tolerance = 0.1 }",
                              "center_of_mass = { value = [0.0, 0.0, 1.88], tolerance = [0.1, 0.1, 0.1] }"}) {
    const NumberTolerances found = with(written);
    ASSERT_EQ(found.size(), 3U) << written;
    EXPECT_EQ(found.at("manipulator.platform.center_of_mass.2"), 0.1);
  }
  const NumberTolerances one = with("center_of_mass = [0.0, 0.0, { value = 1.88, tolerance = 0.2 }]");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one.at("manipulator.platform.center_of_mass.2"), 0.2);
}

TEST(Tolerances, legHasThoseOfTheDefaultsThatItDoesNotOverride) {
  std::string text = replaced(good_scenario, "proximal = { length = 1.4, mass = 10.0,",
                              "proximal = { length = 1.4, mass = { value = 10.0, tolerance = 0.05 },");
  text = replaced(text, "[[manipulator.leg]]", "[[manipulator.leg]]\nproximal = { mass = 11.0 }");
  const NumberTolerances found = statedTolerances(parseScenario(text, "s.toml"));
  EXPECT_EQ(found.size(), 5U);
  EXPECT_EQ(found.count("manipulator.leg.1.proximal.mass"), 0U);
  EXPECT_EQ(found.at("manipulator.leg.6.proximal.mass"), 0.05);
}

TEST(Tolerances, refusalsHaveTheirPlace) {
  EXPECT_THAT(refusalOf(withMass("mass = { value = 500.0 }")),
              HasSubstr("missing key 'tolerance' in manipulator.platform.mass"));
  EXPECT_THAT(refusalOf(withMass("mass = { value = 500.0, tolerance = -1 }")),
              HasSubstr("expected a finite number >= 0"));
  EXPECT_THAT(refusalOf(withMass("mass = { value = 500.0, tolerence = 1 }")), HasSubstr("unknown key 'tolerence'"));
  EXPECT_THAT(refusalOf(withMass("mass = { value = \"heavy\", tolerance = 1 }")), HasSubstr("expected a number"));
  EXPECT_THAT(refusalOf(withMass("mass = { value = -5.0, tolerance = 1 }")),
              HasSubstr("manipulator.platform.mass: -5"));
}

TEST(Tolerances, stayInTheDocumentAsJson) {
  const Scenario scenario = parseScenario(withMass("mass = { value = 501.0, tolerance = 2.5 }"), "s.toml");
  const Scenario again = parseScenario(tomlOfJson(scenarioJson(scenario), "t.toml"), "t.toml");
  EXPECT_EQ(statedTolerances(again), statedTolerances(scenario));
  EXPECT_EQ(placeInFile(scenario, "manipulator.platform.mass").number, 501.0);
}

}  // namespace
}  // namespace ursula
