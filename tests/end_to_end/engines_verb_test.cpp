// `ursula engines`: its output, its files, and its refusals.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

const std::string quick = "engines '" URSULA_SCENARIOS "/hexaglide.toml' --samples 5 --seconds 0.01 ";

TEST(EnginesVerb, printsATableAndWritesAFolder) {
  const Program ursula;
  const UrsulaRun run = ursula(quick + "--out found");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(TemporaryFolder::read(ursula.folder() / "found" / "engines.json"));
  const std::string page = TemporaryFolder::read(ursula.folder() / "found" / "report.html");
  ASSERT_GE(json.at("engines").size(), 2u);
  for (const auto& engine : json.at("engines")) {
    EXPECT_LE(engine.at("efforts").at(0).at("error").get<double>(), 1e-12);
    EXPECT_THAT(run.out, HasSubstr(engine.at("sentence").get<std::string>()));
    EXPECT_THAT(page, HasSubstr(engine.at("name").get<std::string>()));
  }
  EXPECT_THAT(run.out, HasSubstr("page: found/report.html"));
  EXPECT_THAT(TemporaryFolder::read(ursula.folder() / "found" / "engines.csv"), HasSubstr("Simbody,"));
}

TEST(EnginesVerb, printsJsonAndNothingElse) {
  const Program ursula;
  const UrsulaRun run = ursula(quick + "--json --engine simbody,'maximal coordinates'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  ASSERT_EQ(json.at("engines").size(), 2u);
  EXPECT_EQ(json.at("engines").at(0).at("name"), "Simbody");
  EXPECT_EQ(json.at("scenario"), "hexaglide");
  EXPECT_EQ(ursula.files(), 0u) << "nothing is written without --out";
}

TEST(EnginesVerb, refusesWhatItCannotDo) {
  const Program ursula;
  ursula.write("broken.toml", "name = \"broken\"\n[manipulator\n");
  ursula.write("far.toml", [] {
    std::string text = Program::shipped("hold.toml");
    const std::size_t at = text.find("position = [");
    return text.replace(at, text.find(']', at) + 1 - at, "position = [0.0, 0.0, 90.0]");
  }());
  ursula.write("file", "mine");
  expectRefused(ursula,
                {
                    {quick + "--engine havok", "'havok', expected one of Simbody, maximal coordinates, MuJoCo, DART"},
                    {quick + "--samples 1", "--samples"},
                    {quick + "--seconds 0", "--seconds"},
                    {quick + "--seconds nan", "--seconds"},
                    {quick + "--out file", "file"},
                    {"engines broken.toml --out out", "broken.toml:2"},
                    {"engines nowhere.toml --out out", "nowhere.toml"},
                    {"engines far.toml --out out", "the motion cannot be made"},
                });
}

TEST(EnginesVerb, refusesAMechanism) {
  const Program ursula;
  ursula.write("a.toml", "[mechanism]\nfile = \"a.xml\"\n");
  const UrsulaRun run = ursula("engines a.toml");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("engines takes scenarios with [manipulator]"));
}

}  // namespace
}  // namespace ursula
