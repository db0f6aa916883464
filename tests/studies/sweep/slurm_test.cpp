// The input of sbatch, checked by bash itself if bash reads it, and the parts of a sweep still to be submitted.
// tests/cluster/ tests the whole on a real Slurm.

#include "parts/sweep/slurm.h"

#include <gtest/gtest.h>

#include "parts/sweep/merge.h"
#include "tests/base/temporary_folder.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

using testing::IsEmpty;

SlurmJob job() {
  SlurmJob out;
  out.program = "/opt/ursula";
  out.sweep = "/data/mass.toml";
  out.database = "/data/mass.db";
  out.shards = 4;
  out.todo = {1, 2, 4};
  return out;
}

TEST(Slurm, arrayNumbersAreRanges) {
  EXPECT_EQ(arrayNumbers({5}), "5");
  EXPECT_EQ(arrayNumbers({1, 2, 3, 7, 9, 10}), "1-3,7,9-10");
  std::vector<int> every_other;
  for (int k = 2; k <= most_slurm_shards; k += 2) every_other.push_back(k);
  EXPECT_LT(arrayNumbers(every_other).size(), 8192 - 100) << "as much as sbatch takes in one option";
}

TEST(Slurm, filesStandBesideTheDatabase) {
  EXPECT_EQ(shardDatabase("/data/mass.db", {2, 4}), "/data/mass.shard-2-of-4.db");
  EXPECT_EQ(shardDatabase("/data/mass.sqlite", {1, 1}), "/data/mass.shard-1-of-1.db");
  EXPECT_EQ(slurmFolder("/data/mass.db"), "/data/mass.slurm");
}

TEST(Slurm, settingsComeAfterOursAndWin) {
  SlurmJob with = job();
  with.cpus = 3;
  with.settings = {"long", "01:00:00", "500M", {"--cpus-per-task=8", "-A x"}};
  for (const std::string& script : {arrayScript(with), mergeScript(with)}) {
    EXPECT_THAT(script, HasSubstr("#SBATCH --partition=long\n#SBATCH --time=01:00:00\n#SBATCH --mem=500M\n"));
    EXPECT_LT(script.find("--cpus-per-task="), script.find("#SBATCH --cpus-per-task=8\n#SBATCH -A x\n"));
  }
  EXPECT_THAT(arrayScript(with), HasSubstr("--cpus-per-task=3\n"));
  EXPECT_THAT(arrayScript(with), HasSubstr("#SBATCH --array=1-2,4\n"));
  EXPECT_THAT(mergeScript(with), Not(HasSubstr("--array")));
  EXPECT_THAT(arrayScript(job()), Not(HasSubstr("--partition")));
}

TEST(Slurm, pathsOfAnyKindAreOneWord) {
  SlurmJob with = job();
  with.database = "/it's 100% \"$HOME\" & #/mass.db";
  with.settings.options = {"--comment=a \"b\" \\", "--account x y"};
  EXPECT_THAT(arrayScript(with), HasSubstr(R"(#SBATCH --output="/it's 100%% \"$HOME\" & #/mass.slurm/logs/%A_%a.log")"
                                           "\n"));
  EXPECT_THAT(arrayScript(with), HasSubstr(R"(#SBATCH "--comment=a \"b\" \\")"
                                           "\n"
                                           R"(#SBATCH --account "x y")"
                                           "\n"));
  EXPECT_THAT(mergeScript(with), HasSubstr(R"(cd '/it'\''s 100% "$HOME" & #')"));
}

TEST(Slurm, whatWouldBreakItIsRefused) {
  for (const char* option :
       {"--array=1-4", "--arr=1", "-a1-4", "-a 1", "-d afterok:1", "--dependency=singleton", "--wrap=x"}) {
    SlurmJob with = job();
    with.settings.options = {option};
    EXPECT_THROW(arrayScript(with), std::invalid_argument) << option;
    EXPECT_THROW(mergeScript(with), std::invalid_argument) << option;
  }
  for (const char* option : {"--account=array", "-A x", "--wait", "--deadline=now", "--no-requeue"}) {
    SlurmJob with = job();
    with.settings.options = {option};
    EXPECT_NO_THROW(arrayScript(with)) << option;
  }
  SlurmJob backslash = job();
  backslash.database = "/a\\b/mass.db";
  EXPECT_THROW(arrayScript(backslash), std::invalid_argument) << "Slurm would fill in no numbers of tasks";
}

TEST(Slurm, queueIsReadAsSqueueWritesIt) {
  const std::vector<QueuedTask> queue = readQueue("12|3|RUNNING\n13|N/A|PENDING\n");
  ASSERT_EQ(queue.size(), 2u);
  EXPECT_EQ(queue[0].job, 12);
  EXPECT_EQ(queue[0].index, 3);
  EXPECT_EQ(queue[0].state, "RUNNING");
  EXPECT_EQ(queue[1].index, 0);
  EXPECT_THAT(readQueue(""), IsEmpty());
  EXPECT_THROW(readQueue("12 3 RUNNING\n"), std::runtime_error);
  EXPECT_THROW(readQueue("x|3|RUNNING\n"), std::runtime_error);
}

TEST(Slurm, jobsAreKept) {
  const TemporaryFolder folder;
  EXPECT_EQ(readSlurmJobs(folder.path()).shards, 0);
  writeSlurmJobs(folder.path(), {4, {12, 15}, {13}});
  const SlurmJobs jobs = readSlurmJobs(folder.path());
  EXPECT_EQ(jobs.shards, 4);
  EXPECT_THAT(jobs.arrays, ElementsAre(12, 15));
  EXPECT_THAT(jobs.merges, ElementsAre(13));
  folder.write("jobs.json", "{\"shards\": 4}");
  EXPECT_THROW(readSlurmJobs(folder.path()), std::runtime_error);
}

/// Ten points in four shards: 0–2, 3–5, 6–7, 8–9.
class SlurmStandingTest : public testing::Test {
 protected:
  static SweepIdentity sweep() {
    SweepIdentity out;
    out.hash = "h";
    out.version = "1";
    out.what = "inverse";
    out.points = 10;
    return out;
  }

  std::filesystem::path database() const { return folder_.path() / "mass.db"; }

  /// Makes the database with points [first, end) of a shard or of the whole.
  void make(const Shard& shard, std::int64_t first, std::int64_t end, const std::string& hash = "h") const {
    SweepIdentity identity = sweep();
    identity.hash = hash;
    identity.shard = shard.index;
    identity.shards = shard.of;
    SweepDatabase into(shard.of == 1 ? database() : shardDatabase(database(), shard), identity);
    for (std::int64_t i = first; i < end; ++i) into.add({i, "{}", "pass", 0, "", {{"tau_1_Nm", 1, 1, ""}}});
    into.finish();
  }

  SlurmStanding standing(const std::string& queue = "") const {
    return standingOf(sweep(), database(), 4, {4, {12}, {13}}, readQueue(queue));
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(SlurmStandingTest, whatIsNotThereOrNotWholeIsMissing) {
  EXPECT_THAT(standing().in(ShardState::missing), ElementsAre(1, 2, 3, 4));
  make({1, 4}, 0, 3);
  make({2, 4}, 3, 5);
  EXPECT_THAT(standing().in(ShardState::complete), ElementsAre(1));
  EXPECT_THAT(standing().in(ShardState::missing), ElementsAre(2, 3, 4));
  EXPECT_FALSE(standing().merged);
}

/// Such is the database of a task that was killed before it wrote anything.
TEST_F(SlurmStandingTest, anEmptyDatabaseIsMissing) {
  { const Sqlite begun(shardDatabase(database(), {1, 4}), Sqlite::Access::create); }
  EXPECT_THAT(standing().in(ShardState::missing), ElementsAre(1, 2, 3, 4));
  EXPECT_THROW(mergeSweeps({shardDatabase(database(), {1, 4})}, database(), {}), DatabaseError) << "nothing to merge";
  make({2, 4}, 3, 6);
  const MergeResult merged =
      mergeSweeps({shardDatabase(database(), {1, 4}), shardDatabase(database(), {2, 4})}, database(), {});
  EXPECT_EQ(merged.done, 3);
  EXPECT_EQ(merged.missing_shards.size(), 3u);
}

TEST_F(SlurmStandingTest, whatIsMergedIsComplete) {
  make({1, 1}, 0, 6);
  EXPECT_THAT(standing().in(ShardState::complete), ElementsAre(1, 2)) << "without databases of their own";
  EXPECT_FALSE(standing().merged);
  make({1, 1}, 6, 10);
  EXPECT_TRUE(standing().merged);
}

TEST_F(SlurmStandingTest, whatIsInTheQueueIsNotMissing) {
  const SlurmStanding queued = standing("12|2|RUNNING\n12|3|PENDING\n13|N/A|PENDING\n99|4|RUNNING\n");
  EXPECT_THAT(queued.in(ShardState::queued), ElementsAre(2, 3));
  EXPECT_THAT(queued.in(ShardState::missing), ElementsAre(1, 4)) << "job 99 is not this sweep's";
  EXPECT_THAT(queued.arrays, ElementsAre(12));
  EXPECT_THAT(queued.merges, ElementsAre(13));
  EXPECT_THAT(standing().arrays, IsEmpty());
}

TEST_F(SlurmStandingTest, whatIsWrittenToIsNotMissing) {
  SweepIdentity identity = sweep();
  identity.shard = 2;
  identity.shards = 4;
  {
    const SweepDatabase writer(shardDatabase(database(), {2, 4}), identity);
    EXPECT_THAT(standing().in(ShardState::locked), ElementsAre(2));
  }
  EXPECT_THAT(standing().in(ShardState::locked), IsEmpty());
}

TEST_F(SlurmStandingTest, anotherSweepIsRefused) {
  make({3, 4}, 6, 8, "other");
  EXPECT_THROW(standing(), DatabaseError);
}

}  // namespace
}  // namespace ursula
