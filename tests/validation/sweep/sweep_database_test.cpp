// What is kept in a sweep's database, and which databases are refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <future>
#include <thread>

#include "tests/model/refusals.h"
#include "tests/validation/sweep/sweeps.h"
#include "validation/sweep/merge.h"

namespace ursula {
namespace {

using testing::HasSubstr;

SweepIdentity identity(const std::string& hash = "aa", int shard = 1, int shards = 1) {
  SweepIdentity out;
  out.hash = hash;
  out.version = "1.0";
  out.file = "s.toml";
  out.points = 4;
  out.shard = shard;
  out.shards = shards;
  out.keys = {"a.b"};
  return out;
}

SweepPoint point(std::int64_t id, double value = 1.5) {
  return {id, R"({"a.b":1})", "pass", 0.5, "", {{"tau", value, std::nan(""), ""}, {"check", 0.1, 0.2, "pass"}}};
}

std::string refused(const std::filesystem::path& file, const SweepIdentity& whose = identity()) {
  return refusal<DatabaseError>([&] { SweepDatabase(file, whose); });
}

/// All rows but their seconds, as text.
std::string rowsOf(const std::filesystem::path& file) {
  Sqlite database(file, Sqlite::Access::read);
  std::string out;
  Statement points(database, "SELECT id || parameters || verdict || coalesce(error, '-') FROM point");
  while (points.step()) out += points.text(0) + "\n";
  Statement results(database, "SELECT point || name || coalesce(value, '-') || coalesce(\"limit\", '-') FROM result");
  while (results.step()) out += results.text(0) + "\n";
  return out;
}

TEST(SweepDatabase, keepsWhatWasCommitted) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "s.db";
  {
    SweepDatabase database(file, identity());
    database.add(point(2));
    database.commit();
    database.add(point(3));  // never committed
  }
  SweepDatabase again(file, identity());
  EXPECT_EQ(again.pointsDone(), 1);
  EXPECT_EQ(again.firstDone(0, 4), 2);
  EXPECT_EQ(again.firstDone(3, 4), 4);
  EXPECT_EQ(again.sqlite().number("SELECT count(*) FROM result WHERE point = 2"), 2);
  EXPECT_EQ(again.sqlite().number("SELECT count(*) FROM result WHERE point = 3"), 0);
  EXPECT_EQ(again.sqlite().number("SELECT count(*) FROM result WHERE value IS NULL"), 0);
  EXPECT_EQ(again.sqlite().number("SELECT count(*) FROM result WHERE \"limit\" IS NULL"), 1);
  EXPECT_EQ(again.sqlite().number("SELECT count(*) FROM point WHERE error IS NULL"), 1);
}

TEST(SweepDatabase, refusesThoseOfOthersAndLeavesThemAsTheyAre) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "s.db";
  SweepDatabase(file, identity()).finish();
  EXPECT_THAT(refused(file, identity("bb")), HasSubstr("of another sweep, s.toml"));
  EXPECT_THAT(refused(file, identity("aa", 1, 2)), HasSubstr("holds shard 1/1, expected 1/2"));
  SweepIdentity newer = identity();
  newer.version = "2.0";
  EXPECT_THAT(refused(file, newer), HasSubstr("written by ursula 1.0"));
  Sqlite(file, Sqlite::Access::write).run("PRAGMA user_version = 7");
  EXPECT_THAT(refused(file), HasSubstr("has layout 7, of a newer ursula"));

  const std::filesystem::path foreign = folder.path() / "foreign.db";
  Sqlite(foreign, Sqlite::Access::create).run("CREATE TABLE x(y); INSERT INTO x VALUES(1)");
  EXPECT_THAT(refused(foreign), HasSubstr("is no database of a sweep"));
  EXPECT_EQ(Sqlite(foreign, Sqlite::Access::read).number("SELECT y FROM x"), 1);
  const std::filesystem::path text = folder.write("text.db", "this is a text, and long enough that it is one\n");
  EXPECT_THAT(refused(text), HasSubstr("no SQLite database"));
  EXPECT_THAT(TemporaryFolder::read(text), HasSubstr("this is a text"));
  EXPECT_THAT(refused(folder.path() / "none" / "s.db"), HasSubstr("cannot be opened or made"));
}

TEST(SweepDatabase, refusesTablesThatAreNoneOfOursBeforeTheyAreRead) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "s.db";
  const auto changed = [&](const std::string& sql) {
    std::filesystem::remove(file);
    SweepDatabase(file, identity()).finish();
    Sqlite(file, Sqlite::Access::write).run(sql);
    return refused(file);
  };
  // Without an end: who reads it waits for ever.
  EXPECT_THAT(
      changed("DROP TABLE point; CREATE VIEW point AS WITH RECURSIVE n(id) AS (SELECT 0 UNION ALL SELECT 0 FROM "
              "n) SELECT id, '{}' AS parameters, 'pass' AS verdict, 0.1 AS seconds, NULL AS error FROM n"),
      HasSubstr("its tables are not those of a sweep"));
  EXPECT_THAT(changed("CREATE TRIGGER t AFTER INSERT ON point BEGIN DELETE FROM result; END"),
              HasSubstr("its tables are not those of a sweep"));
  EXPECT_THAT(changed("ALTER TABLE point ADD COLUMN more TEXT"), HasSubstr("its tables are not those of a sweep"));
  EXPECT_THAT(changed("DROP TABLE result"), HasSubstr("its tables are not those of a sweep"));
  const std::string own =
      "CREATE INDEX mine ON result(name); CREATE VIEW failed AS SELECT * FROM point; ANALYZE; VACUUM";
  std::filesystem::remove(file);
  SweepDatabase(file, identity()).finish();
  Sqlite(file, Sqlite::Access::write).run(own);
  EXPECT_EQ(SweepDatabase(file).pointsDone(), 0) << "what somebody adds for queries of his own is left alone";
}

/// SQLite takes text for a number, and says 0 when asked for it.
TEST(SweepDatabase, refusesRowsThatNoSweepWrites) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "s.db";
  const auto changed = [&](const std::string& sql) {
    std::filesystem::remove(file);
    {
      SweepDatabase database(file, identity());
      for (int id = 0; id < 4; ++id) database.add(point(id));
      database.finish();
    }
    Sqlite(file, Sqlite::Access::write).run(sql);
    return refused(file);
  };
  for (const char* value : {"value = 'abc'", "value = x'00ff'", "\"limit\" = 'x'", "verdict = x'00'", "name = x'00'"})
    EXPECT_THAT(changed("UPDATE result SET " + std::string(value) + " WHERE point = 2 AND name = 'tau'"),
                HasSubstr("is damaged: a result of point 2 is not as a sweep writes it"))
        << value;
  for (const char* value :
       {"parameters = '{'", "parameters = '[1, 2]'", "parameters = x'7b7d'", "seconds = 'x'", "error = x'00'"})
    EXPECT_THAT(changed("UPDATE point SET " + std::string(value) + " WHERE id = 1"),
                HasSubstr("is damaged: point 1 is not as a sweep writes it"))
        << value;
  EXPECT_THAT(changed("DELETE FROM result WHERE point = 3"), HasSubstr("is damaged: point 3 has no results"));
}

TEST(SweepDatabase, seesDamage) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "s.db";
  {
    SweepDatabase database(file, identity());
    for (int id = 0; id < 4; ++id) database.add(point(id));
    database.finish();
  }
  std::fstream damage(file, std::ios::in | std::ios::out | std::ios::binary);
  damage.seekp(2 * 4096 + 8);
  damage << std::string(4000, '\x5a');
  damage.close();
  EXPECT_THAT(refused(file), HasSubstr("damaged"));
}

TEST(SweepDatabase, isWrittenByOneAtATime) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "s.db";
  SweepDatabase one(file, identity());
  EXPECT_THAT(refused(file), HasSubstr("locked by another program"));
  EXPECT_EQ(SweepDatabase(file).pointsDone(), 0) << "but anybody may read it";
}

/// Another sweep comes first after this one has looked, and found nothing.
TEST(SweepDatabase, isOfTheSweepThatWroteFirst) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "s.db", made = folder.path() / "made.db";
  SweepDatabase(made, identity("bb")).finish();
  std::string tables;
  {
    Sqlite database(made, Sqlite::Access::read);
    Statement each(database, "SELECT sql FROM sqlite_master ORDER BY rowid");
    while (each.step()) tables += each.text(0) + ";";
  }
  Sqlite other(file, Sqlite::Access::create);
  other.run("PRAGMA journal_mode = WAL; ATTACH '" + made.string() + "' AS made; BEGIN IMMEDIATE");
  std::future<std::string> says = std::async(std::launch::async, [&] { return refused(file); });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  other.run(tables +
            "INSERT INTO sweep SELECT * FROM made.sweep; PRAGMA application_id = 1970434933; "
            "PRAGMA user_version = 1; COMMIT");
  EXPECT_THAT(says.get(), HasSubstr("of another sweep, s.toml"));
  EXPECT_EQ(SweepDatabase(file).identity().hash, "bb");
}

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

/// An error is the machine's: what a shard made of it again counts, in whatever order they come.
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
  EXPECT_EQ(rowsOf(all), rowsOf(one));
  EXPECT_THAT(refusal<DatabaseError>([&] { mergeSweeps({one, all}, all); }), HasSubstr("that all go into"));
  EXPECT_THAT(refusal<DatabaseError>([&] { mergeSweeps({folder.path() / "no.db"}, all); }),
              HasSubstr("cannot be opened"));
}

}  // namespace
}  // namespace ursula
