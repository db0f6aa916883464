// `ursula sweep --slurm` with stand-ins for sbatch and squeue; bash runs its scripts. tests/cluster/ uses a real Slurm.

#include <gtest/gtest.h>

#include <string>

#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

class Slurm : public testing::Test {
 protected:
  void SetUp() override {
    write("mass.toml", "");
    // Records its arguments, and answers with numbers from 12 on.
    program("sbatch", "echo \"$*\" >>'$HERE/submitted'; echo $((11 + $(wc -l <'$HERE/submitted')))\n");
    program("squeue", "cat '$HERE/queue' 2>/dev/null; exit 0\n");
  }

  void write(const std::string& name, const std::string& slurm) {
    ursula_.write(name, "scenario = \"" URSULA_SCENARIOS
                        "/paper-helix.toml\"\nwhat = \"inverse\"\ndesign = \"random\"\ncount = 10\nsamples = 2\n"
                        "[[vary]]\nkey = \"manipulator.platform.mass\"\nuniform = [400.0, 600.0]\n" +
                            slurm);
  }

  void program(const std::string& name, std::string body) {
    for (std::size_t at; (at = body.find("$HERE")) != std::string::npos;)
      body.replace(at, 5, ursula_.folder().string());
    std::filesystem::create_directories(ursula_.folder() / "bin");
    const std::filesystem::path path = ursula_.write("bin/" + name, "#!/bin/sh\n" + body);
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }

  UrsulaRun slurm(const std::string& arguments) {
    ::setenv("PATH", ((ursula_.folder() / "bin").string() + ":/usr/bin:/bin").c_str(), 1);
    return ursula_("sweep mass.toml --slurm " + arguments);
  }

  std::string submitted() const { return ursula_.read("submitted"); }

  /// Runs a task as Slurm would; returns the exit code.
  int task(const std::string& script, int index = 0) const {
    const std::string command = "cd / && SLURM_ARRAY_TASK_ID=" + std::to_string(index) + " bash '" +
                                (ursula_.folder() / script).string() + "' >/dev/null 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  }

  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  Program ursula_;
  const std::string path_ = std::getenv("PATH");
};

TEST_F(Slurm, submitsAnArrayAndAMergeAfterIt) {
  const UrsulaRun run = slurm("--shards 4 --db out/m.db");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("4 of 4 shards submitted (1-4): job 12\n"));
  EXPECT_THAT(run.out, HasSubstr("/out/m.db: job 13\n"));
  EXPECT_THAT(submitted(), testing::MatchesRegex("--parsable .*/out/m.slurm/array.sh\n"
                                                 "--parsable --dependency=afterany:12 .*/out/m.slurm/merge.sh\n"));
  EXPECT_TRUE(std::filesystem::is_directory(ursula_.folder() / "out/m.slurm/logs")) << "or Slurm would write no logs";
}

TEST_F(Slurm, scriptsMakeWhatOneProcessMakes) {
  ASSERT_EQ(slurm("--shards 3 --db 'it'\\''s \"$HOME\" & so/m.db'").exit_code, 0);
  const std::string folder = "it's \"$HOME\" & so";
  ASSERT_TRUE(std::filesystem::exists(ursula_.folder() / folder / "m.slurm" / "merge.sh"));
  std::filesystem::create_directory_symlink(ursula_.folder() / folder, ursula_.folder() / "out");
  EXPECT_EQ(task("out/m.slurm/merge.sh"), 3) << "no shard is there";
  EXPECT_EQ(task("out/m.slurm/array.sh", 1), 0);
  EXPECT_EQ(task("out/m.slurm/array.sh", 3), 0);
  EXPECT_EQ(task("out/m.slurm/merge.sh"), 3) << "one is missing";
  EXPECT_EQ(task("out/m.slurm/array.sh", 2), 0);
  EXPECT_EQ(task("out/m.slurm/merge.sh"), 0);
  EXPECT_EQ(task("out/m.slurm/array.sh", 4), 2) << "there is no fourth";
  const std::string before = submitted();
  const UrsulaRun again = slurm("--shards 3 --db out/m.db");
  EXPECT_THAT(again.out, StartsWith("nothing to do: all 10 points are in "));
  EXPECT_EQ(submitted(), before);
}

TEST_F(Slurm, onlyWhatIsMissingIsSubmittedAgain) {
  ASSERT_EQ(slurm("--shards 4").exit_code, 0);
  for (const int index : {1, 3}) ASSERT_EQ(task("results/mass.slurm/array.sh", index), 0);
  ursula_.write("queue", "12|2|RUNNING\n13|N/A|PENDING\n7|4|RUNNING\n");
  const UrsulaRun run = slurm("--shards 4");
  EXPECT_THAT(run.out, AllOf(HasSubstr("1 of 4 shards are already in the queue (job 12) and are not submitted again"),
                             HasSubstr("1 of 4 shards submitted (4): job 14")));
  EXPECT_THAT(submitted(), HasSubstr("--dependency=afterany:12:14:13 ")) << "a merge at a time, after all";
  EXPECT_THAT(ursula_.read("results/mass.slurm/array.sh"), HasSubstr("--array=4\n"));
}

TEST_F(Slurm, whatIsAllThereIsOnlyMerged) {
  ASSERT_EQ(slurm("--shards 1").exit_code, 0);
  ASSERT_EQ(task("results/mass.slurm/array.sh", 1), 0);
  const UrsulaRun run = slurm("--shards 1");
  EXPECT_THAT(run.out, AllOf(HasSubstr("mass.db: job 14"), Not(HasSubstr("submitted"))));
  EXPECT_THAT(submitted(),
              testing::EndsWith("\n--parsable " + (ursula_.folder() / "results/mass.slurm/merge.sh").string() + "\n"));
}

TEST_F(Slurm, anotherCutWhileJobsAreInTheQueueIsRefused) {
  ASSERT_EQ(slurm("--shards 4").exit_code, 0);
  ursula_.write("queue", "12|2|RUNNING\n");
  const UrsulaRun run = slurm("--shards 5");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("in 4 are in the queue; wait for them, or scancel 12"));
}

TEST_F(Slurm, dryRunPrintsWhatWouldBeSubmittedAndWritesNothing) {
  std::filesystem::remove_all(ursula_.folder() / "bin");
  const std::size_t before = ursula_.files();
  const UrsulaRun run = slurm("--shards 400 --dry-run --jobs 3");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("--shards 400: reduced to 10"));
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("#SBATCH --array=1-10\n"), HasSubstr("--cpus-per-task=3\n"), HasSubstr("sweep merge")));
  EXPECT_EQ(ursula_.files(), before);
}

TEST_F(Slurm, whatSlurmSaysIsPassedOn) {
  program("sbatch", "echo 'sbatch: error: invalid partition specified: x' >&2; exit 1\n");
  const UrsulaRun run = slurm("--shards 2");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err,
              HasSubstr("sbatch: error: invalid partition specified: x\nerror: sbatch ended with exit code 1\n"));
  program("sbatch", "echo hello\n");
  EXPECT_THAT(slurm("--shards 2").err, HasSubstr("sbatch said 'hello"));
}

TEST_F(Slurm, misuseIsRefused) {
  std::filesystem::remove(ursula_.folder() / "bin/sbatch");
  const std::string path = (ursula_.folder() / "bin").string();
  for (const auto& [arguments, answer] : std::vector<std::pair<std::string, std::string>>{
           {"mass.toml --slurm", "expected also --shards N"},
           {"mass.toml --shards 2", "--shards requires --slurm"},
           {"mass.toml --dry-run", "--dry-run requires --slurm"},
           {"mass.toml --slurm --shards 2 --shard 1/2", "excludes"},
           {"mass.toml --slurm --shards 2 --retry-errors", "excludes"},
           {"mass.toml --slurm --shards 0", "--shards"},
           {"options.toml --slurm --shards 2 --dry-run", "'--array=1-9' is not to be set here"},
           {"mass.toml --slurm --shards 2", "there is no sbatch on PATH"}}) {
    write("options.toml", "[slurm]\noptions = [\"--array=1-9\"]\n");
    ::setenv("PATH", path.c_str(), 1);
    const UrsulaRun run = ursula_.ending(2, "sweep " + arguments);
    EXPECT_THAT(run.err, HasSubstr(answer)) << arguments;
  }
}

}  // namespace
}  // namespace ursula
