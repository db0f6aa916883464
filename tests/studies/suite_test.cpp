// Suites: their files, refusals before anything is computed, and results that do not depend on the number of threads.

#include "studies/suite/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <regex>
#include <stdexcept>
#include <thread>

#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/model/scenario_text.h"
#include "validation/validate.h"

namespace ursula {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The small scenario under another name, with few instants of a short motion.
std::string scenarioText(const std::string& name) {
  std::string text = replaced(good_scenario, "name = \"small\"", "name = \"" + name + "\"");
  text = replaced(text, "duration = 3.0", "duration = 0.3");
  return text + "\n[simulation]\nsamples = 3\n";
}

std::string mixedKnees(const std::string& name) {
  return replaced(scenarioText(name), "platform_point = [0.0667,", "knee = \"negative\"\nplatform_point = [0.0667,");
}

std::string loaded(const std::string& name) {
  return scenarioText(name) + "[load]\nforce = [10.0, 20.0, -300.0]\npoint = [0.2, 0.0, 0.1]\n";
}

std::vector<SuiteMember> threeScenarios(const TemporaryFolder& folder) {
  return readSuite({folder.write("a.toml", scenarioText("plain")), folder.write("b.toml", mixedKnees("knees")),
                    folder.write("c.toml", loaded("load"))});
}

/// Removes wall times from the suite's files and JUnit's, because only these differ between two runs.
std::string withoutTimes(const std::string& file, const std::string& content) {
  const auto without = [&content](const char* times) { return std::regex_replace(content, std::regex(times), ""); };
  if (file == "suite.json") return without("\"seconds\": [0-9.e-]+");
  if (file == "index.html") return without("data-value=\"[0-9.]+\">[0-9.]+<|[0-9.]+ s of computing");
  if (file.find("junit.xml") != std::string::npos) return without(" time=\"[0-9.]+\" timestamp=\"[0-9T:-]+\"");
  return content;
}

/// The content of every file below `dir` by its relative path.
std::map<std::string, std::string> contents(const std::filesystem::path& dir) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(dir))
    if (entry.is_regular_file()) {
      const std::string name = entry.path().lexically_relative(dir).string();
      files[name] = withoutTimes(name, TemporaryFolder::read(entry.path()));
    }
  return files;
}

std::vector<std::string> names(const std::map<std::string, std::string>& files) {
  std::vector<std::string> out;
  for (const auto& [name, content] : files) out.push_back(name);
  return out;
}

ValidationResult passing(const Scenario& scenario) {
  ValidationResult result;
  result.scenario = scenario.name;
  result.checks = {judged("check", 1, 2, "m", "basis", "why")};
  result.verdict = overall(result.checks);
  result.timeseries.add("t_s", {0, 1});
  return result;
}

SuiteOptions options(int jobs, std::function<ValidationResult(const Scenario&)> judge) {
  SuiteOptions out;
  out.jobs = jobs;
  out.judge = std::move(judge);
  return out;
}

TEST(Suite, resultsAreTheSameToTheByteForAnyNumberOfJobs) {
  const TemporaryFolder folder;
  const std::vector<SuiteMember> scenarios = threeScenarios(folder);
  const auto judge = [](const Scenario& scenario) { return validate(scenario); };
  const auto entries = runSuite(scenarios, folder.path() / "one", options(1, judge));
  const auto one = contents(folder.path() / "one");
  ASSERT_THAT(names(one), ElementsAre("index.html", "junit.xml", "knees/junit.xml", "knees/report.html",
                                      "knees/summary.json", "knees/timeseries.csv", "load/junit.xml",
                                      "load/report.html", "load/summary.json", "load/timeseries.csv", "plain/junit.xml",
                                      "plain/report.html", "plain/summary.json", "plain/timeseries.csv", "suite.json"));
  for (const SuiteEntry& entry : entries) EXPECT_EQ(entry.verdict, Verdict::pass) << entry.scenario;
  EXPECT_THAT(TemporaryFolder::read(folder.path() / "one" / "suite.json"), ContainsRegex("\"seconds\": [0-9]"));
  EXPECT_THAT(one.at("plain/report.html"), HasSubstr("href=\"../index.html\""));
  for (const int jobs : {2, 3}) {
    const std::filesystem::path dir = folder.path() / "several";
    runSuite(scenarios, dir, options(jobs, judge));
    const auto several = contents(dir);
    ASSERT_EQ(names(several), names(one));
    for (const auto& [name, content] : one) EXPECT_TRUE(several.at(name) == content) << name << " with jobs = " << jobs;
    std::filesystem::remove_all(dir);
  }
  // The contents are not trivially equal, because the scenarios differ.
  EXPECT_NE(one.at("plain/timeseries.csv"), one.at("knees/timeseries.csv"));
  EXPECT_NE(one.at("plain/timeseries.csv"), one.at("load/timeseries.csv"));
}

TEST(Suite, severalAreJudgedAtATimeAndEntriesKeepTheirOrder) {
  const TemporaryFolder folder;
  std::atomic<int> waiting{0};
  SuiteOptions two = options(2, [&waiting](const Scenario& scenario) {
    ++waiting;
    // The first waits until another has begun, so with one thread this would never end.
    while (scenario.name == "plain" && waiting < 2) std::this_thread::yield();
    return passing(scenario);
  });
  std::vector<std::size_t> done;
  two.finished = [&done](const SuiteEntry&, std::size_t count) { done.push_back(count); };
  const auto entries = runSuite(threeScenarios(folder), folder.path() / "out", two);
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[0].scenario, "plain");
  EXPECT_EQ(entries[1].scenario, "knees");
  EXPECT_EQ(entries[2].scenario, "load");
  EXPECT_THAT(done, ElementsAre(1u, 2u, 3u));
}

TEST(Suite, aScenarioWhoseJudgeThrowsFailsWithTheReasonAndTheOthersGoOn) {
  const TemporaryFolder folder;
  const std::filesystem::path dir = folder.path() / "out";
  const auto throwing = [](const Scenario& scenario) -> ValidationResult {
    if (scenario.name == "knees") throw std::runtime_error("no such luck");
    return passing(scenario);
  };
  runSuite(threeScenarios(folder), dir, options(1, passing));
  const auto entries = runSuite(threeScenarios(folder), dir, options(2, throwing));
  EXPECT_EQ(entries[0].verdict, Verdict::pass);
  EXPECT_EQ(entries[1].verdict, Verdict::fail);
  EXPECT_EQ(entries[1].error, "no such luck");
  EXPECT_EQ(entries[2].verdict, Verdict::pass);
  EXPECT_THAT(TemporaryFolder::read(dir / "junit.xml"), HasSubstr("message=\"no such luck\""));
  EXPECT_FALSE(std::filesystem::exists(dir / "knees" / "summary.json")) << "that of the run before has to go";
}

TEST(Suite, oneThatIsInErrorIsJudgedByNobodyAndTheOthersGoOn) {
  const TemporaryFolder folder;
  const std::filesystem::path dir = folder.path() / "out";
  const auto good = folder.write("good.toml", scenarioText("good"));
  const auto key = folder.write("key.toml", replaced(scenarioText("key"), "mass = 500.0", "weight = 500.0"));
  const auto reach =
      folder.write("reach.toml", replaced(scenarioText("reach"), "height_phase = 2.2", "height_phase = 5"));
  std::vector<std::string> judged;
  const auto entries = runSuite(readSuite({key, good, reach}), dir, options(1, [&judged](const Scenario& scenario) {
                                  judged.push_back(scenario.name);
                                  return passing(scenario);
                                }));
  EXPECT_THAT(judged, ElementsAre("good"));
  EXPECT_EQ(entries[0].scenario, key.string());
  EXPECT_EQ(entries[2].scenario, "reach");
  EXPECT_EQ(entries[1].error, "");
  EXPECT_EQ(entries[1].verdict, Verdict::pass);
  for (const char* file : {"junit.xml", "index.html"})
    EXPECT_THAT(TemporaryFolder::read(dir / file),
                AllOf(HasSubstr("key.toml:5:1: error: "), HasSubstr("error: the motion cannot be made")))
        << file;
  EXPECT_THAT(TemporaryFolder::read(dir / "junit.xml"), HasSubstr("errors=\"2\""));
}

TEST(Suite, whatCannotBeWrittenIsNoVerdict) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("out", "a file where a folder should be");
  for (const int jobs : {1, 2})
    EXPECT_ANY_THROW(runSuite(threeScenarios(folder), file, options(jobs, passing))) << jobs;
}

TEST(Suite, fewerThanOneJobIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal<std::invalid_argument>([&] { runSuite({}, folder.path(), options(0, passing)); }),
              HasSubstr("0 jobs"));
}

TEST(SuiteInput, aFolderStandsForItsTomlFilesSorted) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "in" / "below");
  std::filesystem::create_directories(folder.path() / "in" / "e.toml");
  folder.write("in/b.toml", scenarioText("second"));
  folder.write("in/a.toml", scenarioText("third"));
  folder.write("in/c.csv", "no scenario");
  folder.write("in/below/d.toml", "none either");
  const auto first = folder.write("z.toml", scenarioText("first"));
  std::vector<std::string> read;
  for (const SuiteMember& member : readSuite({first, folder.path() / "in"})) read.push_back(member.name);
  EXPECT_THAT(read, ElementsAre("first", "third", "second"));
}

TEST(SuiteInput, everyBadScenarioIsNamedAtOnce) {
  const TemporaryFolder folder;
  const auto good = folder.write("good.toml", scenarioText("good"));
  const auto key = folder.write("key.toml", replaced(scenarioText("key"), "mass = 500.0", "weight = 500.0"));
  const auto reach =
      folder.write("reach.toml", replaced(scenarioText("reach"), "height_phase = 2.2", "height_phase = 5"));
  const auto none = folder.path() / "none.toml", empty = folder.path() / "empty";
  std::filesystem::create_directory(empty);
  const std::string errors = refusal<ScenarioError>([&] { allOrNothing(readSuite({good, key, reach, none, empty})); });
  EXPECT_THAT(
      errors,
      AllOf(HasSubstr("key.toml:5:1: error: "), HasSubstr("none.toml: error: no such file"),
            ContainsRegex("reach.toml:[0-9]+:1: error: the motion cannot be made: leg [1-6] is out of reach at t = "),
            HasSubstr("empty: error: no scenario in this folder, expected *.toml"), Not(HasSubstr("good.toml"))));
}

/// The motion passes a singular pose, turned by about 45.26° about e_z, between two instants.
TEST(SuiteInput, aMotionThroughASingularPoseIsRefusedThoughNoInstantMeetsIt) {
  const TemporaryFolder folder;
  std::string text = scenarioText("singular");
  text.erase(text.find("[trajectory]"));
  const std::string poses = R"([trajectory]
kind = "waypoints"
points = [
  { time = 0.0, position = [0.0, 0.0, 1.2], orientation = [1.0, 0.0, 0.0, 0.0] },
  { time = 2.0, position = [0.0, 0.0, 1.2], orientation = [SECOND] },
]
)";
  const auto turned = [&](const std::string& q) { return folder.write("t.toml", text + replaced(poses, "SECOND", q)); };
  EXPECT_THAT(refusal<ScenarioError>([&] { allOrNothing(readSuite({turned("0.9063, 0.0, 0.0, 0.4226")})); }),  // 50°
              ContainsRegex("t.toml:[0-9]+:1: error: the motion cannot be made: at t = .* s the pose is singular"));
  EXPECT_EQ(readSuite({turned("0.9397, 0.0, 0.0, 0.3420")}).front().error, "");  // 40°
}

TEST(SuiteInput, scenariosOfOneNameAreRefusedNamingBothFiles) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.toml", scenarioText("same")), b = folder.write("b.toml", mixedKnees("same"));
  EXPECT_EQ(refusal<ScenarioError>([&] {
              readSuite({a, b});
            }),
            b.string() + ": error: name = 'same' is also that of " + a.string() + ", expected a name for each");
  EXPECT_THAT(refusal<ScenarioError>([&] { readSuite({a, a}); }), HasSubstr("'same' is also that of"));
}

TEST(SuiteInput, aNameThatASuitesOwnFilesHaveIsRefusedInASuite) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.toml", scenarioText("index.html")), b = folder.write("b.toml", scenarioText("b"));
  EXPECT_THAT(refusal<ScenarioError>([&] {
                readSuite({a, b});
              }),
              HasSubstr("'index.html' is also that of the suite's"));
  EXPECT_EQ(readSuite({a}).size(), 1u);
}

}  // namespace
}  // namespace ursula
