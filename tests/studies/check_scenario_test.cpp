// The warnings of `ursula check`: each with its number and place, and none in good scenarios.

#include "validation/check_scenario/check_scenario.h"

#include "report/page/scenario_picture.h"

#include <gtest/gtest.h>

#include "model/trajectories/trajectories.h"
#include "tests/model/refusals.h"
#include "tests/model/scenario_text.h"
#include "tests/support/matchers.h"
#include "tests/validation/scenario_files.h"
#include "validation/subject/motion_check.h"
#include "validation/subject/singular_everywhere.h"

namespace ursula {
namespace {

using testing::IsEmpty;

std::vector<std::string> warningsOf(const std::string& text) { return warnings(parseScenario(text, "a.toml")); }

std::string holding(const std::string& orientation) {
  return good_scenario.substr(0, good_scenario.find("[trajectory]")) +
         "[trajectory]\nkind = \"hold\"\nposition = [0, 0, 0.9]\nduration = 1\n" + orientation + "\n";
}

struct Odd {
  const char* name;
  const char* from;
  const char* to;    ///< an @ marks the place
  const char* says;  ///< with the number
};

class OddScenario : public testing::TestWithParam<Odd> {};

TEST_P(OddScenario, isWarnedOfAtItsPlaceWithTheNumber) {
  const MarkedText changed = marked(replaced(good_scenario, GetParam().from, GetParam().to));
  const std::vector<std::string> found = warningsOf(changed.text);
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found, testing::Contains(testing::AllOf(StartsWith("a.toml:" + changed.place + ": warning: "),
                                                      HasSubstr(GetParam().says))));
}

INSTANTIATE_TEST_SUITE_P(
    Name, OddScenario,
    testing::Values(
        Odd{"gravity_up", "[manipulator]\n", "[manipulator]\ngravity = @[0, 0, 9.81]\n", "its z is +9.81 m/s2"},
        Odd{"gravity_size", "[manipulator]\n", "[manipulator]\ngravity = @[0, 0, -9810]\n", "9810 m/s2 in size"},
        Odd{"centre_beyond", "mass = 10.0, center_of_mass = 0.7", "mass = 10.0, center_of_mass = @1.5",
            "1.5 m is beyond the link, which reaches from 0 to 1.4 m"},
        Odd{"centre_before", "mass = 10.0, center_of_mass = 0.7", "mass = 10.0, center_of_mass = @-0.1",
            "-0.1 m is before the link"},
        Odd{"inertia_large", "[4.2, 4.2, 0.015]", "@[420, 420, 0.015]", "420 kg m2 is more than 10 kg can have"},
        Odd{"inertia_about_the_joint", "[4.2, 4.2, 0.015]", "@[6.533, 6.533, 0.015]", "Is it about the joint?"},
        Odd{"inertia_small", "[4.2, 4.2, 0.015]", "@[4.2e-6, 4.2e-6, 1.5e-8]", "has all of 10 kg within 0.000648 m"},
        Odd{"inertia_order", "[4.2, 4.2, 0.015]", "@[0.015, 4.2, 4.2]", "its third entry, 4.2 kg m2"},
        Odd{"platform_inertia", "[800.0, 810.0, 820.0]", "@[8e8, 8.1e8, 8.2e8]", "8.2e+08 kg m2 is that of 500 kg at"},
        Odd{"axis", "[0.9397, 0.0, 0.3420]", "@[9.397, 0.0, 3.420]", "is 10 long and gets normalised"},
        Odd{"degrees", "-1.5707963267948966", "@-90", "-90 rad are 14.3 turns: did you mean start_angle_deg = -90?"},
        Odd{"haste", "duration = 3.0", "duration = @0.01", "0.01 s make the platform accelerate by"},
        Odd{"milliseconds", "duration = 3.0", "duration = @3000.0", "3000 s: did you mean ms? 3000 ms are 3 s"}),
    [](const testing::TestParamInfo<Odd>& row) { return row.param.name; });

TEST(OddScenario, isNoGoodOne) {
  EXPECT_THAT(warningsOf(good_scenario), IsEmpty());
  EXPECT_THAT(warnings(scenarioOf("paper-helix")), IsEmpty());
  EXPECT_THAT(warnings(scenarioOf("waypoints")), IsEmpty());
  EXPECT_THAT(warnings(scenarioOf("samples")), IsEmpty());
}

TEST(OddScenario, whatSixLegsInheritIsSaidOnce) {
  const std::vector<std::string> found = warningsOf(replaced(good_scenario, "[4.2, 4.2, 0.015]", "[420, 420, 0.015]"));
  EXPECT_THAT(found, ElementsAre(HasSubstr("manipulator.leg_defaults.proximal.inertia (of leg 1): 420 kg m2")));
}

TEST(OddScenario, scalarLastIsTold) {
  EXPECT_THAT(warningsOf(holding("orientation = [0.0, 0.0, 0.0872, 0.9962]")),
              ElementsAre(testing::AllOf(HasSubstr("turns the platform by 180 degrees"), HasSubstr("[w, x, y, z]"))));
  EXPECT_THAT(warningsOf(holding("orientation = [0.9962, 0.0, 0.0, 0.0872]")), IsEmpty());
}

TEST(OddScenario, aPlatformPointFarOutAndMillimetresAreToldThoughTheMotionCannotBeMade) {
  EXPECT_THAT(warningsOf(replaced(good_scenario, "platform_point = [-0.0667, -1.3847, 0.0]",
                                  "platform_point = [-0.0667, -6.3847, 0.0]")),
              testing::Contains(HasSubstr("is 6.38505 m from the platform's origin")));
  EXPECT_THAT(warningsOf(replaced(good_scenario, "distal = { length = 1.3", "distal = { length = 1300")),
              testing::Contains(
                  HasSubstr("1300 m, while the leg's other link is 1.4 m long: did you mean mm? 1300 mm are 1.3 m")));
}

Scenario starting(const std::string& kind) {
  return readScenario(std::string(URSULA_SCENARIOS) + "/../apps/starting/" + kind + ".toml");
}

/// The scenario with a change to every leg.
template <class Change>
Scenario startingWith(const std::string& kind, Change&& change) {
  Scenario scenario = starting(kind);
  ManipulatorParameters machine = scenario.manipulator->parameters();
  for (Leg& leg : machine.legs) change(leg);
  scenario.manipulator = std::make_shared<const Manipulator>(machine);
  return scenario;
}

TEST(OddScenario, isNoGoodOneOfAnotherKind) {
  for (const char* kind : {"UPS", "RUS", "PUS"}) EXPECT_THAT(warnings(starting(kind)), IsEmpty()) << kind;
}

TEST(OddScenario, legsOfOtherKindsHaveLimitsOfTheirOwn) {
  const auto longest = startingWith("UPS", [](Leg& leg) { leg.proximal.length = 0.85; });
  EXPECT_THAT(warnings(longest), testing::Contains(HasSubstr("m from an end of its cylinder, which is 0.85 m long")));
  const auto across = startingWith("PUS", [](Leg& leg) { leg.distal.length = 1.1862; });
  EXPECT_THAT(warnings(across), testing::Contains(HasSubstr("degrees from across its rail")));
  // A carriage has no length.
  const auto carriage = startingWith("PUS", [](Leg& leg) { leg.proximal.inertia *= 100; });
  EXPECT_THAT(warnings(carriage), IsEmpty());
}

/// A motion sampled every 10 ms; `late` is added to one stamp, and `wave` to each by its own sine.
Scenario sampledWith(double late, double wave) {
  Scenario scenario = starting("UPS");
  std::vector<TimedPose> samples;
  for (int k = 0; k <= 400; ++k) {
    const double s = k / 400.0, path = s * s * s * (10 - 15 * s + 6 * s * s);
    const double t = 0.01 * k + (k == 150 ? late : 0) + wave * std::sin(2.0 * k) * (k == 0 ? 0 : 1);
    samples.push_back({t, {0, 0, 1.4 + 0.1 * path}, {1, 0, 0, 0}});
  }
  scenario.trajectory = makeSamples(samples);
  return scenario;
}

TEST(OddScenario, oneStampThatIsLateIsNamedByItsRow) {
  for (const double late : {0.0094, -0.003, 0.0006})
    EXPECT_THAT(warnings(sampledWith(late, 0)),
                testing::Contains(testing::AllOf(HasSubstr("row 151 of the samples has t = 1."),
                                                 HasSubstr(late > 0 ? " s later than" : " s earlier than"))))
        << late;
  EXPECT_THAT(warnings(sampledWith(0, 0)), IsEmpty());
  EXPECT_THAT(warnings(sampledWith(0, 0.001)), testing::Not(testing::Contains(HasSubstr("of the samples has t"))))
      << "rows that are all uneven are no slip of one";
}

/// Puts each platform point where the base's own is, `share` as far out, turned about z and moved by `by`.
Scenario withSimilarHexagons(double share, double by) {
  Scenario scenario = starting("UPS");
  ManipulatorParameters machine = scenario.manipulator->parameters();
  double side = 1;
  for (Leg& leg : machine.legs) {
    leg.platform_point = share * leg.base_point + by * side * Vector3d::UnitX();
    side = -side;
  }
  scenario.manipulator = std::make_shared<const Manipulator>(machine);
  return scenario;
}

TEST(SingularMachine, isToldOfSimilarHexagonsOnACircleAlone) {
  const auto found = singularEverywhere(withSimilarHexagons(0.6, 0));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->similarity, 0.6, 1e-12);
  EXPECT_THAT(found->words(),
              testing::AllOf(StartsWith("singular in every pose: similar hexagons at base and platform"),
                             HasSubstr("move the joints pairwise")));
  const auto nearly = singularEverywhere(withSimilarHexagons(0.6, 1e-6));
  ASSERT_TRUE(nearly);
  EXPECT_THAT(nearly->words(), StartsWith("nearly singular in every pose"));
  EXPECT_FALSE(singularEverywhere(withSimilarHexagons(0.6, 0.05)));
  for (const char* kind : {"URS", "UPS", "RUS", "PUS"}) EXPECT_FALSE(singularEverywhere(starting(kind))) << kind;
  EXPECT_THAT(warnings(withSimilarHexagons(0.6, 0)),
              testing::Contains(HasSubstr("manipulator.leg: the machine is singular in every pose")));
}

TEST(SingularMachine, isRefusedAsOne) {
  const Scenario similar = withSimilarHexagons(0.6, 0);
  EXPECT_THAT(refusal<ScenarioError>([&] { tryMotion(similar); }),
              testing::AllOf(HasSubstr("error: the machine is singular in every pose"),
                             testing::Not(HasSubstr("on one side"))));
}

TEST(Picture, isWellFormedWhateverTheNameIs) {
  const std::string svg =
      picture(parseScenario(replaced(good_scenario, "name = \"small\"", "name = \"a]]>b & <c>\""), "a.toml"));
  EXPECT_THAT(svg, testing::AllOf(HasSubstr("a]]&gt;b &amp; &lt;c&gt;"), testing::Not(HasSubstr("]]>"))));
}

TEST(Picture, drawsTheMachineInTwoViews) {
  const std::string svg = picture(parseScenario(good_scenario, "a.toml"));
  const auto count = [&svg](const std::string& what) {
    std::size_t found = 0;
    for (auto at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("class=\"proximal\""), 12u);
  EXPECT_EQ(count("class=\"distal\""), 12u);
  EXPECT_EQ(count("class=\"unreached\""), 0u);
  EXPECT_EQ(count("nan"), 0u);
  EXPECT_THAT(svg, HasSubstr("small, t = 0<"));
}

TEST(Picture, drawsCylindersAndRails) {
  const std::string ups = picture(starting("UPS")), pus = picture(starting("PUS"));
  EXPECT_THAT(ups, HasSubstr("class=\"proximal cylinder\""));
  EXPECT_THAT(ups, testing::Not(HasSubstr("class=\"rail\"")));
  EXPECT_THAT(pus, HasSubstr("class=\"rail\""));
  EXPECT_THAT(pus, HasSubstr("class=\"carriage\""));
}

TEST(Picture, hasOneLabelForLegsAtOnePlaceOfThePage) {
  const std::string svg = picture(starting("UPS"));  // symmetric: from the front two legs stand behind two others
  for (const char* label : {">1, 2<", ">3, 6<", ">4, 5<", ">3<", ">6<"}) EXPECT_THAT(svg, HasSubstr(label));
}

TEST(Picture, ofAPoseOutOfReachSaysSo) {
  const std::string far = replaced(good_scenario, "height_phase = 2.2", "height_phase = 6");
  const std::string svg = picture(parseScenario(far, "a.toml"));
  EXPECT_THAT(svg, HasSubstr("the legs cannot take this pose"));
  EXPECT_THAT(svg, HasSubstr("class=\"unreached\""));
}

}  // namespace
}  // namespace ursula
