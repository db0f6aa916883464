// `ursula engines`: its output, its files, and its refusals.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

const std::string quick = "engines '" URSULA_SCENARIOS "/hexaglide.toml' --samples 5 --seconds 0.01 ";

TEST(EnginesVerb, printsATableAndWritesAFolder) {
  const Program ursula;
  const UrsulaRun run = ursula.passing(quick + "--out found");
  const auto json = nlohmann::json::parse(ursula.read("found/engines.json"));
  const std::string page = ursula.read("found/report.html");
  ASSERT_GE(json.at("engines").size(), 2u);
  for (const auto& engine : json.at("engines")) {
    EXPECT_LE(engine.at("efforts").at(0).at("error").get<double>(), 1e-12);
    EXPECT_THAT(run.out, HasSubstr(engine.at("sentence").get<std::string>()));
    EXPECT_THAT(page, HasSubstr(engine.at("name").get<std::string>()));
  }
  EXPECT_THAT(run.out, HasSubstr("page: found/report.html"));
  EXPECT_THAT(ursula.read("found/engines.csv"), HasSubstr("Simbody,"));
}

TEST(EnginesVerb, printsJsonAndNothingElse) {
  const Program ursula;
  const UrsulaRun run = ursula.passing(quick + "--json --engine simbody,'maximal coordinates'");
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

TEST(EnginesVerb, takesAMechanism) {
  const Program ursula;
  const std::string call = "engines '" URSULA_SCENARIOS "/mechanisms/fivebar.toml' --samples 5 ";
  const UrsulaRun run = ursula.passing(call + "--engine simbody,'maximal coordinates' --out found");
  EXPECT_THAT(run.out, HasSubstr("Motors: left up to "));
  const auto json = nlohmann::json::parse(ursula.read("found/engines.json"));
  ASSERT_EQ(json.at("engines").size(), 2u);
  EXPECT_LE(json.at("engines").at(0).at("efforts").at(0).at("error").get<double>(), 1e-13);
  EXPECT_EQ(json.at("engines").at(0).at("cut"), nlohmann::json({"pin"}));
  EXPECT_THAT(ursula.read("found/report.html"), HasSubstr("fivebar.xml"));
  EXPECT_THAT(ursula.read("found/efforts.csv"), HasSubstr("simbody_exact_tau_2_Nm"));
  const UrsulaRun judged =
      ursula("validate '" URSULA_SCENARIOS "/mechanisms/fivebar.toml' --torques found/efforts.csv --quiet");
  EXPECT_THAT(judged.out, HasSubstr("fivebar: ")) << "the file is one of efforts: " << judged.err;
  EXPECT_EQ(nlohmann::json::parse(ursula(call + "--json").out).at("model"), "fivebar.xml");
}

TEST(EnginesVerb, replacesNothingThatAMechanismReads) {
  const Program ursula;
  const std::string shipped = Program::shipped("mechanisms/fivebar.toml");
  ASSERT_EQ(ursula("inverse '" URSULA_SCENARIOS "/mechanisms/fivebar.toml' --samples 41 --out motion.csv").exit_code,
            0);
  std::filesystem::create_directory(ursula.folder() / "side");
  ursula.write("side/efforts.csv", ursula.read("motion.csv"));
  std::string text = shipped.substr(0, shipped.find("[trajectory]"));
  text.replace(text.find("fivebar.xml"), 11, URSULA_SCENARIOS "/mechanisms/fivebar.xml");
  ursula.write("sampled.toml", text + "[trajectory]\nkind = \"samples\"\nfile = \"side/efforts.csv\"\n");
  const UrsulaRun run = ursula.ending(2, "engines sampled.toml --out side");
  EXPECT_THAT(run.err, HasSubstr("results would replace "));
  ursula.passing("engines sampled.toml --samples 3 --engine Simbody --out elsewhere");
}

TEST(EnginesVerb, refusesAMechanismThatCannotMove) {
  const Program ursula;
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = Program::shipped("mechanisms/fivebar.toml");
    text.replace(text.find(from), from.size(), to);
    const std::string file = "\"fivebar.xml\"";
    if (const std::size_t at = text.find(file); at != std::string::npos)
      text.replace(at, file.size(), "\"" URSULA_SCENARIOS "/mechanisms/fivebar.xml\"");
    return text;
  };
  ursula.write("nofile.toml", changed("fivebar.xml", "nowhere.xml"));
  ursula.write("motors.toml", changed("\"left\", \"right\"", "\"left\""));
  ursula.write("far.toml", [] {
    std::string text = Program::shipped("mechanisms/delta.toml");
    text.replace(text.find("delta.xml"), 9, URSULA_SCENARIOS "/mechanisms/delta.xml");
    return text.replace(text.find("sin = [0.2,"), 11, "sin = [3.2,");
  }());
  expectRefused(ursula, {{"engines nofile.toml --out out", "nowhere.xml"},
                         {"engines motors.toml --out out", "motors.toml"},
                         {"engines far.toml --out out", "far.toml"}});
}

}  // namespace
}  // namespace ursula
