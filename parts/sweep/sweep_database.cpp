#include "parts/sweep/sweep_database.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "parts/sweep/sweep_file.h"

namespace ursula {
namespace {

constexpr std::int64_t application = 0x75727375;  ///< "ursu": marks our databases
constexpr std::int64_t layout = 1;                ///< PRAGMA user_version

constexpr const char* tables = R"(
CREATE TABLE sweep(text TEXT NOT NULL, hash TEXT NOT NULL, version TEXT NOT NULL, file TEXT NOT NULL,
  scenario TEXT NOT NULL, name TEXT NOT NULL, what TEXT NOT NULL, design TEXT NOT NULL, pointwise INTEGER NOT NULL,
  points INTEGER NOT NULL, shard INTEGER NOT NULL, shards INTEGER NOT NULL, keys TEXT NOT NULL);
CREATE TABLE point(id INTEGER PRIMARY KEY, parameters TEXT NOT NULL, verdict TEXT NOT NULL, seconds REAL NOT NULL,
  error TEXT);
CREATE TABLE result(point INTEGER NOT NULL, name TEXT NOT NULL, value REAL, "limit" REAL, verdict TEXT,
  PRIMARY KEY(point, name)) WITHOUT ROWID;
)";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw DatabaseError(fmt::format("{}: error: {}", file.string(), why));
}

void create(Sqlite& database, const SweepIdentity& identity) {
  database.run(tables);
  database.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", application, layout));
  const SweepIdentity& i = identity;
  Statement(database, "INSERT INTO sweep VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?)")
      .bind(i.text, i.hash, i.version, i.file, i.scenario, i.name, i.what, i.design, int{i.pointwise}, i.points,
            i.shard, i.shards, nlohmann::json(i.keys).dump())
      .run();
}

/// Refuses tables that are not as create() made them, and triggers. A view instead of a table, or a trigger, may never
/// end. Users' own indexes, views and tables for queries may stay.
void requireOurTables(Sqlite& database) {
  Statement each(
      database,
      "SELECT sql FROM sqlite_master WHERE type = 'trigger' OR name IN ('sweep', 'point', 'result') ORDER BY rowid");
  std::string found = "\n";
  while (each.step()) found += each.text(0) + ";\n";
  if (found != tables) refuse(database.file(), "the database is damaged: its tables are not those of a sweep");
}

/// Refuses foreign and newer databases before it uses their content.
void requireOurs(Sqlite& database) {
  const std::filesystem::path& file = database.file();
  const std::int64_t whose = database.number("PRAGMA application_id"), version = database.number("PRAGMA user_version");
  if (whose != application)
    refuse(file, isEmpty(database) ? "is empty: no sweep has begun to write it" : "is not a database of a sweep");
  if (version > layout)
    refuse(file, fmt::format("has layout {} of a newer ursula, expected at most {}", version, layout));
  requireOurTables(database);
  if (const std::string found = database.text("PRAGMA quick_check(1)"); found != "ok")
    refuse(file, "the database is damaged: " + found);
}

// SQLite stores values of any type in any column.
constexpr const char* odd_points =
    "SELECT id FROM point WHERE typeof(parameters) <> 'text' OR NOT json_valid(parameters) OR json_type(parameters) <> "
    "'object' OR typeof(seconds) <> 'real' OR typeof(error) NOT IN ('text', 'null') LIMIT 1";
// Text sorts after all numbers, and BLOBs after all text; this takes a third of the time of typeof().
constexpr const char* odd_results =
    "SELECT point FROM result WHERE value >= '' OR \"limit\" >= '' OR verdict >= x'' OR name >= x'' LIMIT 1";
constexpr const char* without_results =
    "SELECT id FROM point WHERE verdict IN ('pass', 'fail', 'inconclusive') AND NOT EXISTS (SELECT 1 FROM result WHERE "
    "point = id) LIMIT 1";

/// Refuses rows that no sweep writes.
void requireSound(Sqlite& database, const SweepIdentity& sweep) {
  if (sweep.points < 1 || sweep.points > most_points || sweep.shards < 1 || sweep.shards > most_shards ||
      sweep.shard < 1 || sweep.shard > sweep.shards)
    refuse(database.file(), "the database is damaged: it does not say which points it is to hold");
  Statement odd(database,
                "SELECT min(id) FROM point WHERE id < 0 OR id >= ? OR verdict NOT IN ('pass', 'fail', 'inconclusive', "
                "'out_of_reach', 'singular', 'error')");
  odd.bind(sweep.points).step();
  if (!odd.isNull(0))
    refuse(database.file(), fmt::format("the database is damaged: point {} is none of this sweep", odd.integer(0)));
  Statement foreign(database, "SELECT point FROM result WHERE point < 0 OR point >= ? LIMIT 1");
  if (foreign.bind(sweep.points).step())
    refuse(database.file(),
           fmt::format("the database is damaged: it has results of point {}, which is none of this sweep",
                       foreign.integer(0)));
  for (const auto& [sql, what] : {std::pair(odd_points, "point {} is not as a sweep writes it"),
                                  {odd_results, "a result of point {} is not as a sweep writes it"},
                                  {without_results, "point {} has no results"}})
    if (Statement row(database, sql); row.step())
      refuse(database.file(), "the database is damaged: " + fmt::format(fmt::runtime(what), row.integer(0)));
}

/// Returns the file's folder, or an empty path if a parent is a file; SQLite's error then names it.
std::filesystem::path folderFor(const std::filesystem::path& file) {
  std::filesystem::path there = file.parent_path();
  while (!there.empty() && !std::filesystem::exists(there)) there = there.parent_path();
  return there.empty() || std::filesystem::is_directory(there) ? file.parent_path() : std::filesystem::path();
}

}  // namespace

bool isEmpty(Sqlite& database) { return database.number("SELECT count(*) FROM sqlite_master") == 0; }

void requireSame(const std::filesystem::path& file, const SweepIdentity& there, const SweepIdentity& ours) {
  if (there.hash != ours.hash)
    refuse(file, fmt::format("is of another sweep, {}, or of that before it or its scenario changed; expected an empty "
                             "place, or --db with another file",
                             there.file));
  if (there.version != ours.version)
    refuse(file,
           fmt::format(
               "was written by ursula {}, whose results may differ from those of {}; expected --db with another file",
               there.version, ours.version));
  if (there.shard != ours.shard || there.shards != ours.shards)
    refuse(file, fmt::format("holds shard {}/{}, expected {}/{}", there.shard, there.shards, ours.shard, ours.shards));
}

SweepIdentity readIdentity(Sqlite& database) {
  requireOurs(database);
  Statement row(database,
                "SELECT text, hash, version, file, scenario, name, what, design, pointwise, points, shard, shards, "
                "keys FROM sweep");
  if (!row.step()) refuse(database.file(), "the database is damaged: it does not say of which sweep it is");
  SweepIdentity out;
  std::int64_t shard = 0, shards = 0;
  std::string keys;
  row.read(out.text, out.hash, out.version, out.file, out.scenario, out.name, out.what, out.design, out.pointwise,
           out.points, shard, shards, keys);
  // A count beyond int is refused like one that is too large.
  out.shard = static_cast<int>(std::clamp<std::int64_t>(shard, 0, most_shards + 1));
  out.shards = static_cast<int>(std::clamp<std::int64_t>(shards, 0, most_shards + 1));
  try {
    out.keys = nlohmann::json::parse(keys).get<std::vector<std::string>>();
  } catch (const nlohmann::json::exception&) {
    refuse(database.file(), "the database is damaged: it does not say what varies");
  }
  requireSound(database, out);
  return out;
}

struct SweepDatabase::Statements {
  explicit Statements(Sqlite& database)
      : point(database, "INSERT INTO point VALUES(?,?,?,?,?)"),
        stale(database, "DELETE FROM result WHERE point = ?"),
        result(database, "INSERT INTO result VALUES(?,?,?,?,?)"),
        first(database, "SELECT min(id) FROM point WHERE id >= ? AND id < ?") {}
  Statement point, stale, result, first;
};

SweepDatabase::SweepDatabase(const std::filesystem::path& file, const SweepIdentity& identity)
    : folders_(folderFor(file)), sqlite_(file, Sqlite::Access::create) {
  // Checks before any change, because it may be a foreign database.
  const bool was_empty = isEmpty(sqlite_);
  if (!was_empty) requireSame(file, readIdentity(sqlite_), identity);
  // Throws DatabaseLocked if another process is writing.
  sqlite_.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA wal_autocheckpoint = 4000");
  sqlite_.run("BEGIN IMMEDIATE");
  // Checks again under the lock, because another sweep may have come first.
  if (isEmpty(sqlite_))
    create(sqlite_, identity);
  else if (was_empty)
    requireSame(file, readIdentity(sqlite_), identity);
  statements_ = std::make_unique<Statements>(sqlite_);
  commit();
}

SweepDatabase::~SweepDatabase() = default;

std::int64_t SweepDatabase::pointsDone() { return sqlite_.number("SELECT count(*) FROM point"); }

std::int64_t SweepDatabase::firstDone(std::int64_t from, std::int64_t end) {
  Statement& first = statements_->first;
  first.bind(from, end).step();
  const std::int64_t found = first.isNull(0) ? end : first.integer(0);
  first.reset();
  return found;
}

void SweepDatabase::dropErrors() {
  sqlite_.run("DELETE FROM result WHERE point IN (SELECT id FROM point WHERE verdict = 'error')");
  sqlite_.run("DELETE FROM point WHERE verdict = 'error'");
}

void SweepDatabase::add(const SweepPoint& point) {
  const auto unlessEmpty = [](const std::string& text) {
    return text.empty() ? std::nullopt : std::optional<std::string_view>(text);
  };
  statements_->point.bind(point.id, point.parameters, point.verdict, point.seconds, unlessEmpty(point.error)).run();
  statements_->stale.bind(point.id).run();  // removes results of a point that somebody removed manually
  for (const SweepValue& value : point.values)
    statements_->result.bind(point.id, value.name, value.value, value.limit, unlessEmpty(value.verdict)).run();
}

/// A transaction is always open, so nobody else can write between two of ours.
void SweepDatabase::commit() {
  sqlite_.run("COMMIT");
  requireInPlace();
  sqlite_.run("BEGIN IMMEDIATE");
}

void SweepDatabase::requireInPlace() {
  if (!sqlite_.hasMoved()) return;
  sqlite_.run("PRAGMA wal_checkpoint(TRUNCATE)");  // its log keeps the old name, where another database may appear
  std::error_code ignored;
  refuse(sqlite_.file(), fmt::format("{} while the sweep wrote to it: the points found before are in the original file "
                                     "if that was renamed; else they are lost",
                                     std::filesystem::exists(sqlite_.file(), ignored) ? "was replaced by another file"
                                                                                      : "was removed or renamed"));
}

void SweepDatabase::finish() {
  sqlite_.run("COMMIT");
  requireInPlace();
  try {
    sqlite_.run("PRAGMA journal_mode = DELETE");
  } catch (const DatabaseLocked&) {  // a reader keeps the database in this mode, which is as good
  }
  // The file may differ from this connection's memory, because another program may have truncated its log.
  try {
    Sqlite written(sqlite_.file(), Sqlite::Access::read);
    readIdentity(written);
  } catch (const DatabaseError& error) {
    throw DatabaseError(
        fmt::format("{}; another program has changed it, or its -wal, while it was written", error.what()));
  }
}

}  // namespace ursula
