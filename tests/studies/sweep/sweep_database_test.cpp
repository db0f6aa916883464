// The content of a sweep's database, and refused databases.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <future>
#include <thread>
#include <utility>

#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/studies/sweep/small_databases.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

using test::identity;
using test::point;
using test::pointsIn;

std::string refused(const std::filesystem::path& file, const SweepIdentity& whose = identity()) {
  return refusal<DatabaseError>([&] { SweepDatabase(file, whose); });
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

/// Somebody renames, replaces or removes the file between two batches. The renamed file has the earlier results.
TEST(SweepDatabase, refusesToGoOnWithoutItsFile) {
  for (const bool at_the_end : {false, true})
    for (const auto& [comes, says] : {std::pair("", "s.db: error: was removed or renamed"),
                                      {"foreign", "s.db: error: was replaced by another file"}}) {
      const TemporaryFolder folder;
      const std::filesystem::path file = folder.path() / "s.db", kept = folder.path() / "kept.db";
      {
        SweepDatabase database(file, identity());
        database.add(point(2));
        std::filesystem::rename(file, kept);
        if (*comes != '\0') folder.write("s.db", comes);
        const auto go_on = [&] { at_the_end ? database.finish() : database.commit(); };
        EXPECT_THAT(refusal<DatabaseError>(go_on), HasSubstr(says)) << at_the_end;
      }
      EXPECT_EQ(pointsIn(kept), 1) << comes << at_the_end;
      EXPECT_EQ(*comes == '\0' ? "" : TemporaryFolder::read(file), comes) << at_the_end;
    }
}

/// Another program truncates the log. Its content is lost, which this connection's memory hides.
TEST(SweepDatabase, refusesToFinishWhereItsLogWasCutShort) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "s.db";
  SweepIdentity many = identity();
  many.points = 4000;
  for (const int left : {0, 4096 + 57, 100'000}) {
    std::filesystem::remove(file);
    SweepDatabase database(file, many);
    for (int id = 0; id < 4000; ++id) {
      database.add(point(id));
      if (id % 100 == 0) database.commit();
      if (id == 2000) std::filesystem::resize_file(folder.path() / "s.db-wal", static_cast<std::uintmax_t>(left));
    }
    EXPECT_THAT(refusal<DatabaseError>([&] { database.finish(); }),
                testing::AllOf(HasSubstr("s.db: error: the database is damaged"),
                               HasSubstr("or its -wal, while it was written")))
        << left;
  }
}

/// The same sweep may be started twice. The second one then meets points of the first.
TEST(SweepDatabase, namesAnotherSweepThatWroteThePoint) {
  const TemporaryFolder folder;
  SweepDatabase database(folder.path() / "s.db", identity());
  database.add(point(2));
  EXPECT_THAT(refusal<DatabaseError>([&] { database.add(point(2)); }),
              HasSubstr("another sweep has written the same points meanwhile"));
}

/// The limit is that of `ulimit -f`.
TEST(SweepDatabase, namesTheLimitOfItsSize) {
  const TemporaryFolder folder;
  SweepDatabase database(folder.path() / "s.db", identity("aa", 1, 1));
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit little{1 << 16, before.rlim_max};
  const auto former = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &little);
  const std::string said = refusal<DatabaseError>([&] {
    for (int k = 0; k < 100; ++k) {
      SweepPoint large = point(k);
      large.parameters = "{\"x\": \"" + std::string(5000, 'x') + "\"}";
      database.add(large);
      database.commit();
    }
  });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, former);
  EXPECT_THAT(said, HasSubstr("s.db: error: reading or writing failed: a file may not grow further (ulimit -f)"));
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
  EXPECT_THAT(refused(file), HasSubstr("has layout 7 of a newer ursula"));

  const std::filesystem::path foreign = folder.path() / "foreign.db";
  Sqlite(foreign, Sqlite::Access::create).run("CREATE TABLE x(y); INSERT INTO x VALUES(1)");
  EXPECT_THAT(refused(foreign), HasSubstr("is not a database of a sweep"));
  const std::filesystem::path empty = folder.write("empty.db", "");
  EXPECT_THAT(refusal<DatabaseError>([&] { pointsIn(empty); }), HasSubstr("is empty: no sweep has begun"));
  EXPECT_EQ(Sqlite(foreign, Sqlite::Access::read).number("SELECT y FROM x"), 1);
  const std::filesystem::path text = folder.write("text.db", "this is a text, and long enough that it is one\n");
  EXPECT_THAT(refused(text), HasSubstr("not an SQLite database"));
  EXPECT_THAT(TemporaryFolder::read(text), HasSubstr("this is a text"));
  EXPECT_THAT(refused(text / "s.db"), HasSubstr("cannot be opened or created"));
}

TEST(SweepDatabase, makesItsFolders) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a" / "b" / "s.db";
  SweepDatabase(file, identity()).finish();
  EXPECT_EQ(pointsIn(file), 0);
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
  // The view never ends, so a reader would wait for ever.
  EXPECT_THAT(changed("DROP TABLE point; CREATE VIEW point AS WITH RECURSIVE n(id) AS (SELECT 0 UNION ALL SELECT 0 "
                      "FROM n) SELECT id, '{}' AS parameters, 'pass' AS verdict, 0.1 AS seconds, NULL AS error FROM n"),
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
  EXPECT_EQ(pointsIn(file), 0) << "what somebody adds for queries of his own is left alone";
}

/// SQLite accepts text in a column of numbers, and returns it as 0.
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
  EXPECT_THAT(
      changed(
          "INSERT INTO result SELECT point + 1000000000, name, value, \"limit\", verdict FROM result WHERE point = 1"),
      HasSubstr("is damaged: it has results of point 1000000001, which is none of this sweep"));
  // A merge looks at each shard, and so many would take all memory.
  for (const char* value : {"shards = 2147483647", "shards = 1000001", "shards = 4294967297", "shards = 0",
                            "shard = 4294967297", "points = 9223372036854775807"})
    EXPECT_THAT(changed("UPDATE sweep SET " + std::string(value)), HasSubstr("does not say which points it is to hold"))
        << value;
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
  EXPECT_THAT(refused(file), HasSubstr("another program has locked it"));
  EXPECT_EQ(pointsIn(file), 0) << "but anybody may read it";
}

/// Another sweep creates the database after this one found it empty.
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
            "INSERT INTO sweep SELECT * FROM made.sweep; PRAGMA application_id = 1970434933; PRAGMA user_version = 1; "
            "COMMIT");
  EXPECT_THAT(says.get(), HasSubstr("of another sweep, s.toml"));
  Sqlite written(file, Sqlite::Access::read);
  EXPECT_EQ(readIdentity(written).hash, "bb");
}

}  // namespace
}  // namespace ursula
