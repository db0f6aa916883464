// `ursula init` and `ursula check`, and the errors for an impossible motion.

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/utf8.h"
#include "tests/end_to_end/program.h"
#include "tests/model/scenario_text.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

using testing::ContainsRegex;

TEST(Init, writesAScenarioThatPassesTheCheckAndCanBeComputed) {
  const Program ursula;
  ursula.passing("init robot.toml");
  EXPECT_THAT(ursula.read("robot.toml"), HasSubstr("name = \"robot\""));
  const UrsulaRun check = ursula.passing("check robot.toml");
  EXPECT_THAT(check.out, StartsWith("robot.toml: the scenario and its motion are valid; 0 warnings\nnot shown"));
  ursula.passing("inverse robot.toml --samples 3");
  EXPECT_EQ(ursula("init - --kind URS").out.substr(0, 2), "# ");
  EXPECT_EQ(ursula.files(), 1u);
}

TEST(Init, tellsEditorsWhereTheSchemaIs) {
  const Program ursula;
  ursula.passing("init robot.toml --kind UPS");
  const std::string text = ursula.read("robot.toml"), directive = "#:schema ";
  ASSERT_THAT(text, StartsWith(directive));
  const std::string path = text.substr(directive.size(), text.find('\n') - directive.size());
  EXPECT_THAT(path, StartsWith("/"));
  EXPECT_TRUE(nlohmann::json::parse(TemporaryFolder::read(path)).contains("$schema")) << path;
}

TEST(Init, neverOverwrites) {
  const Program ursula;
  ursula.write("mine.toml", "mine");
  expectRefused(ursula, {{"init mine.toml", "mine.toml exists, expected the name of a new file"}});
  EXPECT_EQ(ursula.read("mine.toml"), "mine");
}

TEST(Init, turnsLengthsInMillimetresIntoMetres) {
  const Program ursula;
  ursula.passing("init metres.toml --kind UPS");
  std::string text = ursula.read("metres.toml");
  const auto replace = [&](const std::string& old, const std::string& now) {
    ASSERT_NE(text.find(old), std::string::npos) << old;
    text.replace(text.find(old), old.size(), now);
  };
  const std::string links = "length = 1.1, mass = 25.0, center_of_mass = 0.5", point = "[1.1818, -0.2084, 0.0000]";
  replace(links, "\"length\" = 1_100, mass = 25.0, center_of_mass = { value = 500, tolerance = 5 }");
  replace("name = \"metres\"", "name = \"µm\"; base_point = 1");
  ursula.write("broken.toml", text);
  ursula.ending(2, "init new.toml --from broken.toml --lengths mm");
  replace("; base_point = 1", "  # base_point = 1");
  replace("base_point = " + point, "base_point = [1181.8, -208.4, 0.0]  # µ 7");
  ursula.write("millimetres.toml", text);
  ursula.passing("init new.toml --from millimetres.toml --lengths mm");
  const std::string made = ursula.read("new.toml");
  EXPECT_THAT(made, HasSubstr("\"length\" = 1.1, mass = 25.0, center_of_mass = { value = 0.5, tolerance = 0.005 }"));
  EXPECT_THAT(made, HasSubstr("base_point = [1.1818, -0.2084, 0]  # µ 7"));
  EXPECT_THAT(made, HasSubstr("\"µm\"  # base_point = 1"));
}

class InitKind : public testing::TestWithParam<const char*> {};

TEST_P(InitKind, writesAScenarioThatPassesTheCheckAndCanBeComputed) {
  const Program ursula;
  const std::string kind = GetParam();
  ursula.passing("init robot.toml --kind " + kind);
  const std::string text = ursula.read("robot.toml");
  EXPECT_THAT(text, HasSubstr("name = \"robot\""));
  EXPECT_THAT(text, HasSubstr("\nkind = \"" + kind + "\""));
  const UrsulaRun check = ursula.passing("check robot.toml --picture robot.svg");
  EXPECT_THAT(check.out, StartsWith("robot.toml: the scenario and its motion are valid; 0 warnings\nnot shown"));
  const UrsulaRun inverse = ursula.passing("inverse robot.toml --samples 3");
  EXPECT_THAT(inverse.out, HasSubstr(kind == "RUS" ? ",tau_6_Nm\n" : ",tau_6_N\n"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, InitKind, testing::Values("UPS", "RUS", "PUS"),
                         [](const auto& test) { return test.param; });

TEST(Init, refusesKindsThatThereAreNot) {
  const Program ursula;
  expectRefused(ursula, {{"init a.toml --kind UPZ",
                          "--kind UPZ: unknown kind of leg, expected one of URS, UPS, RUS, PUS, did you mean"}});
}

TEST(CheckVerb, warnsAndPasses) {
  const Program ursula;
  ursula.write("a.toml", replaced(good_scenario, "[manipulator]\n", "[manipulator]\ngravity = [0, 0, 9.81]\n"));
  const UrsulaRun run = ursula.passing("check a.toml --picture a.svg");
  EXPECT_THAT(run.out, AllOf(HasSubstr("a.toml:4:11: warning: manipulator.gravity: its z is +9.81 m/s2"),
                             HasSubstr("a.toml: the scenario and its motion are valid; 1 warning\n")));
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(ursula.read("a.svg"), HasSubstr("</svg>"));
}

std::size_t countOf(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(Warnings, ofCheckAreSaidOnceByEachVerbThatUsesTheMotion) {
  const Program ursula;
  ursula.write("good.toml", good_scenario);
  ursula.write("odd.toml", replaced(good_scenario, "[manipulator]\n", "[manipulator]\ngravity = [0, 0, 9.81]\n"));
  ursula.passing("inverse good.toml --samples 31 --out tau.csv");
  for (const std::string name : {"good", "odd"}) {
    ursula.write("of_" + name + ".toml", "scenario = \"" + name +
                                             ".toml\"\nwhat = \"inverse\"\ndesign = \"grid\"\n[[vary]]\nkey = "
                                             "\"manipulator.platform.mass\"\nvalues = [500.0]\n");
    for (const std::string& call : {"inverse " + name + ".toml --samples 2", "poses " + name + ".toml --samples 2",
                                    "export " + name + ".toml --format sdf", "map " + name + ".toml --x -0.1,0.1,2",
                                    "simulate " + name + ".toml --torques tau.csv --time-limit 1e-3",
                                    "validate " + name + ".toml --time-limit 1e-3 --quiet --out results_of_" + name,
                                    "sweep of_" + name + ".toml"}) {
      const UrsulaRun run = ursula(call);
      EXPECT_EQ(countOf(run.err, "odd.toml:4:11: warning: manipulator.gravity: "), name == "odd" ? 1 : 0)
          << call << "\n"
          << run.err;
      EXPECT_EQ(countOf(run.err + run.out, "warning"), name == "odd" ? 1 : 0) << call;
    }
  }
}

TEST(CheckVerb, doesNotReplaceTheScenarioThatItsInputIs) {
  const Program ursula;
  ursula.write("my.toml", good_scenario);
  expectRefused(ursula, {{"check - --picture my.toml <my.toml", "the program reads this file, expected another file"}});
  EXPECT_EQ(ursula.read("my.toml"), good_scenario);
  ursula.passing("check - --picture my.svg <my.toml");
  EXPECT_EQ(ursula("check - --picture /dev/null").exit_code, 2) << "an empty input is no scenario";
}

/// Returns a file of results; the test fails unless it is UTF-8.
std::string utf8File(const std::filesystem::path& file) {
  const std::string text = TemporaryFolder::read(file);
  EXPECT_FALSE(text.empty()) << file;
  EXPECT_TRUE(utf8(text) == text) << file;
  return text;
}

TEST(Latin1, inALogOrAFilesNameIsWrittenAsUtf8) {
  const Program ursula;
  ursula.write("m\xb5.toml", good_scenario);
  ursula.passing("inverse m\xb5.toml --samples 301 --out own.csv");
  std::string log = ursula.read("own.csv");
  for (auto at = log.find('\n'); at != std::string::npos; at = log.find('\n', at + 3))
    log.insert(at, at == log.find('\n') ? ",\xb5" : ",0");
  ursula.write("l\xb0.csv", log);
  const UrsulaRun plain = ursula("identify m\xb5.toml --measured own.csv --out plain --quiet");
  const UrsulaRun run = ursula("identify m\xb5.toml --measured l\xb0.csv --out 'o\xb5' --quiet");
  EXPECT_EQ(run.exit_code, plain.exit_code) << run.err;
  EXPECT_THAT(run.err, HasSubstr("columns that are not used: "));
  EXPECT_TRUE(utf8(run.err) == run.err);
  EXPECT_THAT(utf8File(ursula.folder() / "o\xb5/summary.json"), HasSubstr("\"µ\""));
  utf8File(ursula.folder() / "o\xb5/report.html");
  ursula.ending(3, "validate m\xb5.toml --time-limit 0.1 --out v");
  for (const char* file : {"summary.json", "report.html", "junit.xml"})
    EXPECT_THAT(utf8File(ursula.folder() / "v" / file), HasSubstr("mµ.toml")) << file;
  ursula.write("s\xb5.toml",
               "scenario = \"own.toml\"\nwhat = \"inverse\"\ndesign = \"grid\"\n[[vary]]\nkey = "
               "\"manipulator.platform.mass\"\nvalues = [500.0]\n");
  ursula.write("own.toml", good_scenario);
  ursula.passing("sweep s\xb5.toml --db s.db");
  EXPECT_THAT(ursula.read("s.db"), HasSubstr("sµ.toml"));
}

TEST(CheckVerb, drawsAPngWhereTheNameEndsSo) {
  const Program ursula;
  ursula.write("a.toml", good_scenario);
  ursula.passing("check a.toml --picture a.png");
  const std::string png = ursula.read("a.png");
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_GT(png.size(), 2000U);
  ursula.write("a.png", "kept");
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const UrsulaRun without = ursula("check a.toml --picture a.png");
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err, HasSubstr("librsvg2-bin"));
  EXPECT_EQ(ursula.read("a.png"), "kept");
  for (const char* verb : {"check", "map"})
    EXPECT_THAT(ursula(std::string(verb) + " --help").out, HasSubstr("librsvg2-bin"));
}

TEST(CheckVerb, listsWhatCannotShowAsJson) {
  const Program ursula;
  const UrsulaRun run = ursula.passing("check " + helix + " --json");
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["valid"], true);
  EXPECT_FALSE(json["blind"].empty());
  for (const auto& one : json["blind"]) {
    EXPECT_TRUE(one["mistake"].is_string() && one["cause"]["kind"].is_string()) << one;
    EXPECT_LT(one["largest"].get<double>(), 1e-9) << one;
  }
  EXPECT_THAT(ursula("check " + helix).out, HasSubstr("friction left out"));
  EXPECT_TRUE(nlohmann::json::parse(ursula("check " + helix + " " + helix + " --json").out).is_array());
}

TEST(CheckVerb, suggestsAMotionThatShowsMore) {
  const Program ursula;
  const UrsulaRun run = ursula.passing("check " + helix + " --suggest --out new.toml");
  EXPECT_THAT(run.err, HasSubstr("do with this motion"));
  const auto count = [&](const std::string& file) {
    return nlohmann::json::parse(ursula("check " + file + " --json").out)["blind"].size();
  };
  EXPECT_LT(count("new.toml"), count(helix));
  EXPECT_EQ(ursula("check " + helix + " --suggest --out new.toml").exit_code, 2) << "never overwrites";
  ursula.ending(2, "check " + helix + " --suggest --json");
}

TEST(CheckVerb, exitsWithTwoForErrorsOfAnyScenarioAndNamesThemAll) {
  const Program ursula;
  ursula.write("good.toml", good_scenario);
  ursula.write("key.toml", replaced(good_scenario, "mass = 500.0", "weight = 500.0"));
  ursula.write("far.toml", replaced(good_scenario, "height_phase = 2.2", "height_phase = 6"));
  const UrsulaRun run = ursula.ending(2, "check key.toml far.toml good.toml");
  EXPECT_THAT(run.err, AllOf(HasSubstr("key.toml:5:1: error: unknown key 'weight'"),
                             ContainsRegex("far.toml:44:1: error: the motion cannot be made: leg [1-6] is out of reach "
                                           "at t = 0 s: .* it misses by [0-9.]+ m")));
  EXPECT_THAT(run.out, HasSubstr("good.toml: the scenario and its motion are valid"));
  ursula.passing("check good.toml");
  ursula.ending(2, "check good.toml key.toml --picture x.svg");
}

TEST(CheckVerb, tellsEveryErrorOfAScenario) {
  const Program ursula;
  ursula.write("bad.toml",
               replaced(replaced(good_scenario, "mass = 500.0", "weight = 500.0"), "pitch = 1.2", "pitch = 0"));
  for (const char* verb : {"check", "validate", "inverse"}) {
    const UrsulaRun run = ursula.ending(2, std::string(verb) + " bad.toml");
    EXPECT_THAT(run.err, AllOf(HasSubstr("bad.toml:5:1: error: unknown key 'weight'"),
                               HasSubstr("   5 | weight = 500.0\n     | ^\nbad.toml:48:9: error: trajectory.pitch: 0"),
                               HasSubstr("  48 | pitch = 0\n     |         ^\n")));
  }
  EXPECT_EQ(ursula.files(), 1u);
}

/// Every verb that follows the motion says the same.
TEST(UnreachableMotion, namesPlaceInstantLegAndMetres) {
  const Program ursula;
  ursula.write("far.toml", replaced(good_scenario, "height_phase = 2.2", "height_phase = 3.3"));
  for (const char* verb : {"inverse", "poses", "check", "validate"}) {
    const UrsulaRun run = ursula.ending(2, std::string(verb) + " far.toml");
    EXPECT_THAT(run.err, ContainsRegex("far.toml:44:1: error: the motion cannot be made: leg [1-6] is out of reach at "
                                       "t = [0-9.]+ s: .* m apart.* span at most 2.7 m; it misses by [0-9.e-]+ m"))
        << verb;
  }
}

/// The error says what is too short or too far, in the words of the leg's kind.
TEST(UnreachableMotion, isToldOfLegsOfEveryKind) {
  const Program ursula;
  const std::pair<const char*, const char*> kinds[] = {
      {"UPS", "are 3.[0-9]+ m apart, and its cylinder and rod span at most 2.1 m; it misses by 1.[0-9]+ m"},
      {"RUS",
       "is 3.[0-9]+ m from its crank's axis, and from there crank and rod span at most 1.[0-9]+ m; it misses by"},
      {"PUS", "is [2-4].[0-9]+ m from its rail, and its rod spans at most 1.5 m; it misses by"}};
  for (const auto& [kind, words] : kinds) {
    const std::string name = std::string(kind) + ".toml",
                      far = kind == std::string("PUS") ? "[3.5, 0.0, 1.6]" : "[0.0, 0.0, 3.5]";
    ursula.passing("init " + name + " --kind " + kind);
    const std::string text = ursula.read(name), key = "{ time = 0.0, position = ";
    const auto at = text.find(key) + key.size();
    ursula.write(name, text.substr(0, at) + far + text.substr(text.find(']', at) + 1));
    const UrsulaRun run = ursula.ending(2, "check " + name + " --picture far.svg");
    EXPECT_THAT(run.err, ContainsRegex(words)) << run.err;
    EXPECT_THAT(ursula.read("far.svg"), HasSubstr("class=\"unreached\""));
  }
}

}  // namespace
}  // namespace ursula
