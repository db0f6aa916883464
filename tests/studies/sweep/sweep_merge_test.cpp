// Merging databases of shards, and refusals before anything is written.

#include "parts/sweep/merge.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/studies/sweep/small_databases.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

using test::identity;
using test::point;
using test::pointsIn;
using test::rowsOf;

TEST(SweepMerge, takesEachPointOnceInAnyOrderAndSaysWhatIsMissing) {
  const TemporaryFolder folder;
  const auto part = [&](int shard, std::vector<int> ids) {
    const std::filesystem::path file = folder.path() / ("part" + std::to_string(shard) + ".db");
    SweepDatabase database(file, identity("aa", shard, 2));
    for (const int id : ids) database.add(point(id));
    database.finish();
    return file;
  };
  const auto second = part(2, {2, 3}), first = part(1, {0});
  const std::filesystem::path all = folder.path() / "all.db";
  const MergeResult most = mergeSweeps({second, first}, all);
  EXPECT_EQ(most.added, 3);
  ASSERT_EQ(most.missing.size(), 1u);
  EXPECT_EQ(most.missing[0].first, 1);
  EXPECT_EQ(most.missing[0].end, 2);
  ASSERT_EQ(most.missing_shards.size(), 1u);
  EXPECT_EQ(most.missing_shards[0].index, 1);
  {
    SweepDatabase database(first, identity("aa", 1, 2));
    database.add(point(1));
    database.finish();
  }
  EXPECT_EQ(mergeSweeps({first}, all).added, 1);
  const MergeResult again = mergeSweeps({first, second, first}, all);
  EXPECT_EQ(again.added, 0);
  EXPECT_EQ(again.done, 4);
  EXPECT_TRUE(again.missing.empty());

  const std::filesystem::path whole = folder.path() / "whole.db";
  {
    SweepDatabase database(whole, identity());
    for (int id = 0; id < 4; ++id) database.add(point(id));
    database.finish();
  }
  EXPECT_EQ(rowsOf(all), rowsOf(whole));
}

/// An error is the computer's. If a shard computed the point again, that result counts, in any order of the parts.
TEST(SweepMerge, takesAPointThatWasMadeAgainForOneInError) {
  const TemporaryFolder folder;
  const auto made = [&](const std::string& name, bool in_error) {
    SweepDatabase database(folder.path() / name, identity());
    database.add(point(0));
    SweepPoint second = point(1);
    if (in_error) second = {1, second.parameters, "error", 0.1, "out of memory", {}};
    database.add(second);
    database.finish();
    return folder.path() / name;
  };
  const auto error = made("error.db", true), again = made("again.db", false);
  const std::filesystem::path first = folder.path() / "first.db", last = folder.path() / "last.db";
  EXPECT_EQ(mergeSweeps({error}, first).added, 2);
  EXPECT_NE(rowsOf(first), rowsOf(again));
  EXPECT_EQ(mergeSweeps({again}, first).added, 1);
  EXPECT_EQ(rowsOf(first), rowsOf(again));
  mergeSweeps({again}, last);
  EXPECT_EQ(mergeSweeps({error}, last).added, 0);
  EXPECT_EQ(rowsOf(last), rowsOf(again));
}

TEST(SweepMerge, refusesOtherSweepsAndPointsThatDiffer) {
  const TemporaryFolder folder;
  const auto made = [&](const std::string& name, const SweepIdentity& whose, double value) {
    SweepDatabase database(folder.path() / name, whose);
    database.add(point(0, value));
    database.finish();
    return folder.path() / name;
  };
  const auto one = made("one.db", identity(), 1.5), other = made("other.db", identity("bb"), 1.5),
             off = made("off.db", identity(), std::nextafter(1.5, 2));
  const std::filesystem::path all = folder.path() / "all.db";
  EXPECT_THAT(refusal<DatabaseError>([&] { mergeSweeps({one, other}, all); }), HasSubstr("of another sweep than"));
  EXPECT_FALSE(std::filesystem::exists(all));
  EXPECT_THAT(refusal<DatabaseError>([&] { mergeSweeps({one, off}, all); }), HasSubstr("its point 0 is not that of"));
  EXPECT_FALSE(std::filesystem::exists(all)) << "the first part's points are there";
  mergeSweeps({one}, all);
  EXPECT_THAT(refusal<DatabaseError>([&] { mergeSweeps({off}, all); }), HasSubstr("its point 0 is not that of"));
  EXPECT_EQ(rowsOf(all), rowsOf(one));
  EXPECT_THAT(refusal<DatabaseError>([&] { mergeSweeps({one, all}, all); }), HasSubstr("that all go into"));
  EXPECT_THAT(refusal<DatabaseError>([&] { mergeSweeps({folder.path() / "no.db"}, all); }),
              HasSubstr("cannot be opened"));
}

/// Existing content stays unchanged, whichever part does not fit.
TEST(SweepMerge, writesNothingWhereAPartIsRefused) {
  const TemporaryFolder folder;
  const auto made = [&](const std::string& name, int id, double value) {
    SweepDatabase database(folder.path() / name, identity());
    database.add(point(id, value));
    database.finish();
    return folder.path() / name;
  };
  const std::filesystem::path all = made("all.db", 2, 1.5), off = made("off.db", 2, 2.5), other = made("0.db", 0, 1.5);
  const std::string before = rowsOf(all);
  EXPECT_THAT(refusal<DatabaseError>([&] {
                mergeSweeps({other, off}, all);
              }),
              AllOf(HasSubstr("off.db: error: its point 2 is not that of"), HasSubstr("all.db")));
  EXPECT_EQ(rowsOf(all), before);
}

/// It stops between two parts, and before anything is read. The database is whole then, with no other file beside it.
TEST(SweepMerge, stopsWhereItIsAskedAndGoesOnLater) {
  const TemporaryFolder folder;
  const auto part = [&](int shard) {
    SweepIdentity whose = identity("aa", shard, 2);
    whose.points = 400;
    SweepDatabase database(folder.path() / (std::to_string(shard) + ".db"), whose);
    for (int id = 200 * (shard - 1); id < 200 * shard; ++id) database.add(point(id));
    database.finish();
    return folder.path() / (std::to_string(shard) + ".db");
  };
  const std::vector<std::filesystem::path> parts = {part(1), part(2)};
  const std::filesystem::path all = folder.path() / "all.db";
  EXPECT_THROW(mergeSweeps(parts, all, {}, [] { return true; }), DatabaseStopped);
  EXPECT_FALSE(std::filesystem::exists(all));
  std::size_t done = 0;
  const auto count = [&](std::size_t of) { done = of; };
  EXPECT_THROW(mergeSweeps(parts, all, count, [&] { return done == 1; }), DatabaseStopped);
  std::set<std::string> files;
  for (const auto& each : std::filesystem::directory_iterator(folder.path())) files.insert(each.path().filename());
  EXPECT_EQ(files, (std::set<std::string>{"1.db", "2.db", "all.db"}));
  EXPECT_EQ(pointsIn(all), 200);
  EXPECT_EQ(mergeSweeps(parts, all).added, 200);
}

TEST(SweepMerge, namesThePartThatIsBeingWritten) {
  const TemporaryFolder folder;
  const std::filesystem::path part = folder.path() / "part.db", all = folder.path() / "all.db";
  SweepDatabase writes(part, identity());
  writes.add(point(0));
  writes.commit();
  EXPECT_THAT(refusal<DatabaseError>([&] { mergeSweeps({part}, all); }),
              HasSubstr("part.db: error: another program has locked it"));
  EXPECT_FALSE(std::filesystem::exists(all));
}

}  // namespace
}  // namespace ursula
