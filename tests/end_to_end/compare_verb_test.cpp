// `ursula compare` as users call it: the shipped results against a fresh run, chosen columns, JUnit, exit codes.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/csv.h"
#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

const std::string shipped_results = "'" URSULA_RESULTS "/paper-helix/inverse.csv'";

TEST(CompareVerb, whatShipsComparesWithAFreshRunWhateverItsSampling) {
  const Program ursula;
  ursula.passing("inverse " + helix + " --out fresh.csv");
  const UrsulaRun same = ursula("compare " + shipped_results + " fresh.csv");
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  ursula.passing("inverse " + helix + " --samples 121 --out coarse.csv");
  const UrsulaRun coarse = ursula("compare " + shipped_results + " coarse.csv --columns 'tau_*,q_*'");
  EXPECT_EQ(coarse.exit_code, 0) << coarse.out << coarse.err;
  EXPECT_THAT(coarse.out, HasSubstr("the reference was interpolated at "));
  EXPECT_THAT(coarse.out, HasSubstr("compared 10 of 10 channels"));
}

TEST(CompareVerb, exitsAsEveryVerbDoesAndWritesJUnit) {
  const Program ursula;
  ursula.write("a.csv", "t_s,x,y\n0,1,1\n1,2,1\n");
  ursula.write("b.csv", "t_s,x\n0,1\n1,2\n");
  ursula.write("c.csv", "t_s,x,y\n0,1,1\n1,2.5,1\n");
  ursula.write("d.csv", "t_s,x\n1,1\n0,2\n");
  const UrsulaRun same = ursula.passing("compare a.csv a.csv");
  EXPECT_THAT(same.out,
              testing::AllOf(HasSubstr("compared 2 of 2 channels at 2 instants"), HasSubstr("verdict: pass\n")));
  ursula.ending(1, "compare a.csv c.csv --junit junit.xml");
  ursula.passing("compare a.csv c.csv --tolerance 0.3");
  EXPECT_THAT(ursula.read("junit.xml"),
              testing::AllOf(HasSubstr("tests=\"2\" failures=\"1\""), HasSubstr("name=\"x\"><failure")));
  ursula.ending(3, "compare a.csv b.csv");
  ursula.passing("compare a.csv b.csv --columns x");
  const UrsulaRun csv = ursula("compare a.csv c.csv --out -");
  EXPECT_THAT(csv.out, testing::StartsWith("channel,verdict,"));
  EXPECT_THAT(csv.out, testing::Not(HasSubstr("compared")));
  EXPECT_THAT(csv.err, HasSubstr("compared 2 of 2 channels"));
  expectRefused(ursula, {{"compare a.csv none.csv", "none.csv"},
                         {"compare a.csv d.csv", "d.csv:3: error: "},
                         {"compare a.csv a.csv --columns x,yy",
                          "--columns yy: neither side has such a column, did you mean 'y'?"},
                         {"compare a.csv a.csv --tolerance nan", "tolerance"},
                         {"compare a.csv a.csv --tolerance inf", "tolerance"},
                         {"compare a.csv a.csv --tolerance -1", "tolerance"}});
}

TEST(CompareVerb, changesNothingOfWhatItReads) {
  const Program ursula;
  std::filesystem::create_directories(ursula.folder() / "a");
  ursula.write("a/timeseries.csv", "t_s,x\n0,1\n1,2\n");
  ursula.write("b.csv", "t_s,x\n0,1\n1,2\n");
  std::filesystem::create_symlink("a/timeseries.csv", ursula.folder() / "link.xml");
  std::filesystem::create_symlink("a/new.xml", ursula.folder() / "dangling.xml");
  std::filesystem::create_hard_link(ursula.folder() / "a/timeseries.csv", ursula.folder() / "hard.csv");
  for (const char* into : {"--junit a/timeseries.csv", "--junit a/new.xml", "--out ./a/table.csv", "--junit link.xml",
                           "--junit dangling.xml", "--out hard.csv"})
    expectRefused(
        ursula, {{std::string("compare b.csv a ") + into, "is inside a, which is compared, expected another folder"}});
  EXPECT_EQ(ursula.read("a/timeseries.csv"), "t_s,x\n0,1\n1,2\n");
  ursula.passing("compare b.csv a --junit new.xml");
}

TEST(CompareVerb, writesAPageIntoAFolderAndTheTableAloneIntoAFile) {
  const Program ursula;
  ursula.write("a.csv", "t_s,x\n0,1\n1,2\n2,3\n");
  ursula.write("b.csv", "t_s,x\n0,1\n1,2\n2,4\n");
  const UrsulaRun run = ursula.ending(1, "compare a.csv b.csv --out out");
  EXPECT_THAT(run.out, testing::EndsWith("page: out/compare.html\n"));
  EXPECT_THAT(ursula.read("out/compare.html"),
              HasSubstr("The test differs from the reference in 1 of 1 channels at 3 instants"));
  EXPECT_THAT(ursula.read("out/junit.xml"), HasSubstr("failures=\"1\""));
  EXPECT_THAT(ursula.read("out/compare.csv"), testing::StartsWith("channel,verdict,"));
  ursula.passing("compare a.csv a.csv --out table.csv");
  EXPECT_THAT(ursula.read("table.csv"), testing::StartsWith("channel,verdict,"));
  ursula.write("file", "in the way");
  for (const char* call : {"compare a.csv a.csv --out file", "prove --out file"})
    expectRefused(ursula, {{call, "file"}});
}

TEST(CompareMechanisms, judgesTheLoopsGapByTheMachine) {
  const Program ursula_;
  for (const std::string file : {"fourbar.toml", "fourbar.xml"})
    ursula_.write(file, TemporaryFolder::read(std::string(URSULA_VECTORS "/loops/") + file));
  for (const std::string engine : {"noc", "simbody"})
    ursula_.passing("simulate fourbar.toml --engine " + engine + " --out " + engine + ".csv");
  const UrsulaRun alike = ursula_("compare noc.csv simbody.csv --tolerance 1e-4");
  EXPECT_EQ(alike.exit_code, 0) << alike.out << alike.err;
  const CsvTable given = readCsv(ursula_.folder() / "simbody.csv");
  std::vector<std::vector<double>> columns = given.columns;
  columns[std::find(given.names.begin(), given.names.end(), "closure_m") - given.names.begin()][3] = 1e-3;
  ursula_.write("open.csv", csvText(given.names, columns));
  ursula_.ending(1, "compare noc.csv open.csv --tolerance 1e-4");
}

}  // namespace
}  // namespace ursula
