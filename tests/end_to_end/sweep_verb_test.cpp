// `ursula sweep`, called as users call it.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "parts/sweep/sqlite.h"
#include "tests/end_to_end/program.h"
#include "tests/end_to_end/running.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

const std::string head = "scenario = \"" URSULA_SCENARIOS "/paper-helix.toml\"\n";

std::string sweepOf(const std::string& what, const std::string& rest) {
  return head + "what = \"" + what + "\"\n" + rest + "[[vary]]\nkey = \"platform.mass\"\nuniform = [400.0, 600.0]\n";
}

TEST(SweepVerb, worksOnceAndThenSaysThatAllIsThere) {
  const Program ursula;
  ursula.write("s.toml", sweepOf("inverse", "design = \"random\"\ncount = 50\nsamples = 5\n"));
  const UrsulaRun first = ursula.passing("sweep s.toml");
  EXPECT_EQ(first.out, "50 points: 50 pass\nresults/s.db\n");
  ASSERT_TRUE(std::filesystem::exists(ursula.folder() / "results/s.db"));
  EXPECT_FALSE(std::filesystem::exists(ursula.folder() / "results/s.db-wal"));
  const std::string bytes = ursula.read("results/s.db");
  const UrsulaRun second = ursula.passing("sweep s.toml");
  EXPECT_THAT(second.err, HasSubstr("nothing to do: all 50 points are in results/s.db"));
  EXPECT_EQ(second.out, first.out);
}

TEST(SweepVerb, showWritesAPointThatValidatesWithTheSameNumbers) {
  const Program ursula;
  ursula.write("s.toml", "scenario = \"" URSULA_SCENARIOS
                         "/helix-0.3s.toml\"\ndesign = \"random\"\ncount = 2\nsamples = 7\n"
                         "[[vary]]\nkey = \"platform.mass\"\nuniform = [400.0, 600.0]\n");
  const UrsulaRun sweep = ursula("sweep s.toml --db s.db --jobs 1");
  EXPECT_EQ(sweep.exit_code, 0) << sweep.out << sweep.err;
  const UrsulaRun shown = ursula.passing("sweep show s.toml 1");
  ursula.write("point.toml", shown.out);
  const UrsulaRun validated = ursula.passing("validate point.toml --json --out point");
  const auto summary = nlohmann::json::parse(validated.out);
  EXPECT_EQ(summary.at("scenario"), "helix-0.3s-1");
  EXPECT_EQ(shown.out, ursula("sweep show s.toml 1").out);
  EXPECT_NE(shown.out, ursula("sweep show s.toml 0").out);
}

TEST(SweepVerb, shardsMergeToTheWholeAndWhatIsMissingIsNamed) {
  const Program ursula;
  ursula.write("s.toml", sweepOf("inverse", "design = \"sobol\"\ncount = 64\nsamples = 5\n"));
  for (const char* shard : {"1/4", "2/4", "4/4"}) ursula.passing("sweep s.toml --shard " + std::string(shard));
  const UrsulaRun partial = ursula.ending(3, "sweep merge results/s.shard-*.db --db all.db");
  EXPECT_THAT(partial.err, HasSubstr("16 of 64 points are missing, the first from 32 to 47; to make them:\n"
                                     "  ursula sweep s.toml --shard 3/4\n"));
  ursula.passing("sweep s.toml --shard 3/4");
  const UrsulaRun whole = ursula.passing("sweep merge results/s.shard-*.db --db all.db");
  EXPECT_THAT(whole.out, HasSubstr("64 of 64 points, 16 of them new"));
  EXPECT_THAT(ursula("sweep s.toml --db all.db").err, HasSubstr("nothing to do"));
}

TEST(SweepVerb, mergeMakesFoldersWhereItWritesAlone) {
  const Program ursula;
  ursula.write("s.toml", sweepOf("inverse", "design = \"random\"\ncount = 4\nsamples = 5\n"));
  ursula.passing("sweep s.toml --db a/b/s.db");
  ursula.ending(2, "sweep merge none.db --db c/d/all.db");
  EXPECT_FALSE(std::filesystem::exists(ursula.folder() / "c"));
  ursula.passing("sweep merge a/b/s.db --db c/d/all.db");
  EXPECT_TRUE(std::filesystem::exists(ursula.folder() / "c/d/all.db"));
}

/// The merge is stopped while its log exists, and so within it.
TEST(SweepVerb, mergeThatASignalStopsLeavesOneFile) {
  const Program ursula;
  ursula.write("s.toml", sweepOf("inverse", "design = \"random\"\ncount = 8000\nsamples = 5\n"));
  ursula.passing("sweep s.toml --db s.db");
  const std::filesystem::path log = ursula.folder() / "all.db-wal";
  for (const int signal : {SIGINT, SIGTERM}) {
    Running merge(ursula, {"sweep", "merge", "s.db", "--db", "all.db"});
    while (!std::filesystem::exists(log) && !merge.hasEnded()) std::this_thread::yield();
    merge.send(SIGSTOP);
    ASSERT_TRUE(std::filesystem::exists(log)) << "or nothing would be seen below";
    merge.send(signal);
    merge.send(SIGCONT);
    EXPECT_EQ(merge.exitCode(), 128 + signal);
    EXPECT_EQ(ursula.files(), 3u) << "s.toml, s.db, all.db";
  }
  ursula.passing("sweep merge s.db --db all.db");
}

TEST(SweepVerb, refusesInOneLineWhatCannotBe) {
  const Program ursula;
  ursula.write("s.toml", sweepOf("inverse", "design = \"random\"\ncount = 50\nsamples = 5\n"));
  ursula.write("other.toml", sweepOf("inverse", "design = \"random\"\ncount = 51\nsamples = 5\n"));
  ursula.write("bad.toml", sweepOf("inverse", "design = \"randon\"\ncount = 50\n"));
  ursula.passing("sweep s.toml --db s.db");
  ursula.write(
      "twice.toml",
      sweepOf("inverse", "design = \"random\"\ncount = 2\n[[vary]]\nkey = \"leg.01.base_point.0\"\nvalues = [0.1]\n"));
  expectRefused(
      ursula,
      {{"sweep bad.toml",
        "bad.toml:3:10: error: design: 'randon', expected 'grid', 'random' or 'sobol', did you mean 'random'?"},
       {"sweep '" URSULA_SCENARIOS "/paper-helix.toml'",
        "manipulator: a scenario, expected a sweep, which names one: scenario = \"paper-helix.toml\""},
       {"sweep none.toml", "none.toml: error: no such file"},
       {"sweep other.toml --db s.db", "s.db: error: is of another sweep, s.toml"},
       {"sweep s.toml --shard 0/4", "--shard 0/4: expected I/N with I from 1 to N"},
       {"sweep s.toml --shard 5/4", "--shard 5/4: expected I/N"},
       {"sweep s.toml --shard 1/4x", "--shard 1/4x: expected I/N"},
       {"sweep s.toml --db bad.toml", "bad.toml: error: not an SQLite database, expected the database of a sweep"},
       {"sweep s.toml --pointwise", "--pointwise: expected a sweep with what = \"validate\""},
       {"sweep show s.toml 50", "point 50: s.toml has points 0 to 49"},
       {"sweep merge s.db none.db --db all.db", "none.db: error: it cannot be opened"},
       {"sweep ", "sweep"},
       {"sweep merge s.db", "ursula sweep merge: --db is required (ursula sweep merge --help"},
       {"sweep s.toml --db /dev/null", "/dev/null: error: is not a regular file"},
       {"sweep twice.toml", "'01', expected an index from 1 to 6"}});
}

/// SQLite gives some names a special meaning.
TEST(SweepVerb, keepsItsDatabaseWhateverItIsCalled) {
  const Program ursula;
  ursula.write("-a b's.toml", sweepOf("inverse", "design = \"random\"\ncount = 4\nsamples = 5\n"));
  const std::string file = "\"./-a b's.toml\"";
  for (const char* name : {":memory:", "file:y.db?mode=memory"}) {
    ursula.passing("sweep " + file + " --db '" + name + "'");
    EXPECT_THAT(ursula("sweep " + file + " --db '" + name + "'").err, HasSubstr("nothing to do")) << name;
    EXPECT_THAT(ursula("sweep merge '" + std::string(name) + "' --db merged.db").out, HasSubstr("4 of 4 points"))
        << name;
  }
  ursula.passing("sweep " + file + " --shard 1/2 --db 1.db");
  const std::string said = ursula("sweep merge 1.db --db all.db").err;
  const std::size_t at = said.find("  ursula ");
  ASSERT_NE(at, std::string::npos) << said;
  EXPECT_EQ(ursula(said.substr(at + 9, said.find('\n', at) - at - 9)).exit_code, 0) << "as pasted: " << said;
}

/// A shell starts background jobs with SIGINT ignored, because Ctrl-C is for the foreground.
TEST(SweepVerb, leavesIgnoredWhatWasIgnoredWhenItWasStarted) {
  const Program ursula;
  ursula.write("s.toml", sweepOf("inverse", "design = \"random\"\ncount = 20000\nsamples = 5\n"));
  ursula.write("interrupted.sh",
               "trap '' INT TERM\n'" URSULA_PROGRAM
               "' sweep s.toml --jobs 2 >said 2>&1 &\n"
               "for k in 1 2 3 4 5 6 7 8 9 10; do sleep 0.1; kill -INT $!; kill -TERM $!; done\nwait $!\n");
  const std::string command = "cd '" + ursula.folder().string() + "' && sh interrupted.sh 2>.err";
  EXPECT_EQ(std::system(command.c_str()), 0) << ursula.read("said");
  EXPECT_THAT(ursula.read("said"), HasSubstr("20000 points: 20000 pass"));
}

/// Runs a hundredth of each shipped sweep; no point may fail or have an error.
TEST(SweepVerb, sweepsThatShipPass) {
  const Program ursula;
  for (const char* name : {"payload", "random-machines", "tolerances", "workspace"}) {
    const UrsulaRun run =
        ursula("sweep '" URSULA_SWEEPS "/" + std::string(name) + ".toml' --shard 51/100 --db " + name + ".db");
    EXPECT_EQ(run.exit_code, 0) << name << run.out << run.err;
    EXPECT_THAT(run.out, testing::MatchesRegex("[0-9]+ points: [0-9]+ pass\n.*\n")) << name;
  }
}

/// Calls the program with a C library that sees no fused multiply-add in the processor.
class WithoutFma {
 public:
  WithoutFma() {
    ::setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-FMA_Usable,-FMA4_Usable,-AVX2_Usable", 1);
  }
  ~WithoutFma() { ::unsetenv("GLIBC_TUNABLES"); }
};

bool hasFma() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

/// What docs/sweep.md promises of other machines.
TEST(SweepVerb, rowsOfAMachineThatRoundsDifferentlyAreTheSameUpToRounding) {
  const Program ursula;
  ursula.write("s.toml", "scenario = \"" URSULA_SCENARIOS
                         "/helix-0.3s.toml\"\ndesign = \"random\"\ncount = 4\nsamples = 7\n"
                         "[[vary]]\nkey = \"platform.mass\"\nuniform = [400.0, 600.0]\n"
                         "[[vary]]\nkey = \"trajectory.radius\"\nuniform = [0.1, 0.3]\n");
  ursula.passing("sweep s.toml --db one.db");
  ursula.passing("sweep s.toml --db again.db");
  {
    const WithoutFma there;
    ursula.passing("sweep s.toml --db other.db");
  }
  const auto differing = [&](const char* database, const std::string& of) {
    Sqlite one(ursula.folder() / "one.db", Sqlite::Access::read);
    one.run("ATTACH '" + (ursula.folder() / database).string() + "' AS other");
    return one.number(
        "SELECT count(*) FROM point p JOIN other.point q ON q.id = p.id JOIN result r ON r.point = p.id JOIN "
        "other.result s ON s.point = p.id AND s.name = r.name WHERE " +
        of);
  };
  EXPECT_GT(differing("other.db", "1"), 4 * 30);
  EXPECT_EQ(differing("other.db", "p.parameters <> q.parameters OR p.verdict <> q.verdict OR r.verdict <> s.verdict"),
            0);
  EXPECT_EQ(differing("other.db", "abs(r.value - s.value) > max(r.\"limit\", s.\"limit\")"), 0);
  EXPECT_EQ(differing("again.db", "r.value <> s.value OR r.\"limit\" <> s.\"limit\""), 0);
  if (!hasFma()) return;
  EXPECT_GT(differing("other.db", "r.value <> s.value"), 0) << "a control: the two libraries do round differently";
  const UrsulaRun merged = ursula.ending(2, "sweep merge one.db other.db --db both.db");
  EXPECT_THAT(merged.err, HasSubstr("two kinds of machines round differently"));
}

}  // namespace
}  // namespace ursula
