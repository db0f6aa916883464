// Help and misuse, the same for every verb that the program lists.

#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

/// Returns the verbs listed by --help.
std::vector<std::string> verbs(const Program& ursula) {
  std::istringstream lines(ursula("--help").out);
  std::vector<std::string> out;
  bool listed = false;
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (listed && std::regex_search(line, match, std::regex("^  ([a-z]+) "))) out.push_back(match[1]);
    listed = listed || line == "Judge:";
  }
  return out;
}

TEST(Usage, helpIsGivenByTheProgramAndByEachVerb) {
  const Program ursula;
  const std::vector<std::string> listed = verbs(ursula);
  EXPECT_THAT(listed, testing::IsSupersetOf({"validate", "inverse"}));
  for (const std::string& verb : listed) {
    const UrsulaRun run = ursula(verb + " --help");
    EXPECT_EQ(run.exit_code, 0) << verb;
    EXPECT_THAT(run.out, HasSubstr("--help")) << verb;
    EXPECT_EQ(run.err, "") << verb;
  }
  ursula.passing("--help");
  ursula.passing("--version");
  EXPECT_EQ(ursula.files(), 0u);
}

TEST(Usage, misuseExitsWithTwoAndSaysSoOnStandardError) {
  const Program ursula;
  for (const std::string& verb : verbs(ursula)) expectRefused(ursula, {{verb + " --no-such-option", ""}});
  expectRefused(ursula, {{"", ""}, {"validate", ""}, {"inverse none.toml", "none.toml"}, {"--no-such-option", ""}});
  for (const char* tolerance : {"--rtol nan", "--rtol inf", "--rtol 0", "--rtol 1e-3x", "--atol nan", "--atol -1"})
    expectRefused(ursula, {{"validate " + helix + " " + tolerance, "finite number above 0"}});
}

TEST(Usage, aMisspeltVerbOrOptionGetsOneLineWithTheNearest) {
  const Program ursula;
  for (const auto& [call, line] : std::vector<std::pair<std::string, std::string>>{
           {"validat a.toml", "ursula: no verb \"validat\"; did you mean \"validate\"? (ursula --help lists all)\n"},
           {"xyzzy", "ursula: no verb \"xyzzy\" (ursula --help lists all)\n"},
           {"--versio", "ursula: no option \"--versio\"; did you mean \"--version\"? (ursula --help lists all)\n"},
           {"validate a.toml --jbs 4",
            "ursula validate: no option \"--jbs\"; did you mean \"--jobs\"? (ursula validate --help lists all)\n"},
           {"inverse --sampels=3",
            "ursula inverse: no option \"--sampels\"; did you mean \"--samples\"? (ursula inverse --help lists all)\n"},
           {"inverse a.toml b.toml",
            "ursula inverse: \"b.toml\" is one argument too many (ursula inverse --help shows the usage)\n"},
           {"inverse", "ursula inverse: scenario is required (ursula inverse --help shows the usage)\n"},
           {"explain torque.pontwise",
            "error: no check 'torque.pontwise', did you mean 'torque.pointwise'? (ursula explain lists all)\n"}}) {
    const UrsulaRun run = ursula.ending(2, call);
    EXPECT_EQ(run.err, line);
    EXPECT_EQ(run.out, "") << call;
  }
}

TEST(Usage, aFolderThatCannotBeWrittenIsAnError) {
  const Program ursula;
  ursula.write("file", "");
  expectRefused(ursula, {{"inverse --samples 2 --out file/below.csv " + helix, "file"}});
}

TEST(Usage, numbersAreReadAsPeopleWriteThem) {
  const Program ursula;
  ursula.write("helix.toml", Program::shipped("paper-helix.toml"));
  ursula.write("a.csv", "t_s,x\n0,1\n1,2\n");
  expectRefused(ursula,
                {{"inverse helix.toml --samples 010", "--samples 010: is not a whole number in plain digits"},
                 {"inverse helix.toml --samples 0x10", "--samples 0x10: is not a whole number in plain digits"},
                 {"map helix.toml --at 1e-400", "--at 1e-400: is not a number"},
                 {"map helix.toml --at 1,5", "Could not convert: --at = 1,5, expected a number"},
                 {"map helix.toml --x 0,1,3 --y=-1e308,1e308,3", "-1e308, expected a size of at most 1e+100"},
                 {"validate helix.toml --rtol 0x1p0", "'0x1p0' is not a finite number above 0"},
                 {"compare a.csv a.csv --interpolate=7", "interpolate was given a disallowed"},
                 {"compare a.csv a.csv --interpolate=x", "interpolate was given a disallowed"},
                 {"compare a.csv a.csv --out - --junit -", "--out - and --junit -: expected standard output for one"}});
  for (const char* call : {"compare a.csv a.csv --interpolate", "compare a.csv a.csv --no-interpolate",
                           "inverse helix.toml --samples +10", "map helix.toml --at 0 --x 0,1,2 --y 0,1,2"})
    EXPECT_EQ(ursula(call).exit_code, 0) << call << ursula(call).err;
}

}  // namespace
}  // namespace ursula
