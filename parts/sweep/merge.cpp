#include "parts/sweep/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace ursula {
namespace {

using Stop = std::function<bool()>;

struct Part {
  std::filesystem::path file;
  SweepIdentity identity;
  std::int64_t first = 0, last = 0;  ///< its smallest and its largest point
};

/// Throws if another process writes the database. Its points would change, and SQLite's error would name the target
/// instead.
void requireUnlocked(const std::filesystem::path& file) {
  Sqlite(file, Sqlite::Access::write).run("BEGIN IMMEDIATE; ROLLBACK");
}

/// Opens the databases of one sweep, in the order of their points.
std::vector<Part> opened(const std::vector<std::filesystem::path>& files, const Stop& stop) {
  std::vector<Part> out;
  for (const std::filesystem::path& file : files) {
    Sqlite database(file, Sqlite::Access::read);
    database.stopWhen(stop);
    if (isEmpty(database)) continue;
    out.push_back({file, readIdentity(database), database.number("SELECT coalesce(min(id), 0) FROM point"),
                   database.number("SELECT coalesce(max(id), -1) FROM point")});
    const auto differs = [&](const std::string SweepIdentity::*what) {
      return out.back().identity.*what != out.front().identity.*what;
    };
    if (differs(&SweepIdentity::hash))
      throw DatabaseError(
          fmt::format("{}: error: is of another sweep than {}", file.string(), out.front().file.string()));
    if (differs(&SweepIdentity::version))
      throw DatabaseError(fmt::format("{}: error: was written by ursula {}, {} by {}: their results may differ",
                                      file.string(), out.back().identity.version, out.front().file.string(),
                                      out.front().identity.version));
    requireUnlocked(file);
  }
  if (out.empty()) throw DatabaseError(fmt::format("{}: error: holds nothing yet", files.front().string()));
  std::stable_sort(out.begin(), out.end(), [](const Part& a, const Part& b) { return a.first < b.first; });
  return out;
}

/// Finds points that differ. Points with errors are ignored, because the computer caused them, for instance by lack of
/// memory.
constexpr const char* differing = R"(
SELECT p.id FROM part.point p JOIN main.point m ON m.id = p.id WHERE m.parameters IS NOT p.parameters
  OR ('error' NOT IN (m.verdict, p.verdict) AND (m.verdict IS NOT p.verdict OR m.error IS NOT p.error))
UNION ALL SELECT r.point FROM part.result r JOIN main.point m ON m.id = r.point LEFT JOIN main.result o
  ON o.point = r.point AND o.name = r.name WHERE m.verdict <> 'error' AND (o.value IS NOT r.value OR o."limit" IS NOT r."limit"
  OR o.verdict IS NOT r.verdict)
LIMIT 1)";

/// Removes error points that a part has computed again.
constexpr const char* drop_retried = R"(
DELETE FROM main.result WHERE point IN (SELECT m.id FROM main.point m JOIN part.point p ON p.id = m.id
  WHERE m.verdict = 'error' AND p.verdict <> 'error');
DELETE FROM main.point WHERE verdict = 'error' AND id IN (SELECT id FROM part.point WHERE verdict <> 'error'))";

/// Throws unless the points that both have are the same.
void requireSame(Sqlite& database, const Part& part) {
  Statement other(database, differing);
  if (!other.step()) return;
  throw DatabaseError(fmt::format(
      "{}: error: its point {} is not that of {}: one of the two is wrong, or two kinds of machines round differently",
      part.file.string(), other.integer(0), database.file().string()));
}

constexpr const char* meets =
    "SELECT count(*) FROM (SELECT 1 FROM main.point WHERE id >= (SELECT min(id) FROM part.point) AND id <= (SELECT "
    "max(id) FROM part.point) LIMIT 1)";

/// Uses an absolute path, as Sqlite does.
void attach(Sqlite& database, const std::filesystem::path& file) {
  Statement(database, "ATTACH ? AS part").bind(std::filesystem::absolute(file).string()).run();
}

/// Throws if a point of `part` differs from that of `database`; changes nothing.
void compare(Sqlite& database, const Part& part) {
  attach(database, part.file);
  if (database.number(meets) != 0) requireSame(database, part);
  database.run("DETACH part");
}

/// Compares all pairs before anything is written, so a refused second part leaves no points of the first.
void requireAgreement(const std::vector<Part>& parts, const Stop& stop) {
  for (auto one = parts.begin(); one != parts.end(); ++one) {
    Sqlite database(one->file, Sqlite::Access::read);
    database.stopWhen(stop);
    for (auto other = one + 1; other != parts.end() && other->first <= one->last; ++other) compare(database, *other);
  }
}

/// Copies the points that `into` lacks, within one transaction.
std::int64_t takeIn(SweepDatabase& into, const Part& part) {
  Sqlite& database = into.sqlite();
  if (database.number(meets) == 0) {  // the parts share no point, so everything is copied
    database.run("INSERT INTO main.result SELECT * FROM part.result; INSERT INTO main.point SELECT * FROM part.point");
    return database.changed();
  }
  requireSame(database, part);
  database.run(drop_retried);
  database.run(
      "INSERT INTO main.result SELECT r.* FROM part.result r WHERE NOT EXISTS (SELECT 1 FROM main.point m WHERE m.id = "
      "r.point);INSERT INTO main.point SELECT * FROM part.point p WHERE NOT EXISTS (SELECT 1 FROM main.point m WHERE "
      "m.id = p.id)");
  return database.changed();
}

std::vector<PointRange> missingOf(SweepDatabase& database, std::int64_t points) {
  std::vector<PointRange> out;
  Statement ids(database.sqlite(), "SELECT id FROM point ORDER BY id");
  std::int64_t expected = 0;
  const auto gap = [&](std::int64_t until) {
    if (until > expected && out.size() < most_named) out.push_back({expected, until});
  };
  for (; ids.step(); ++expected) {
    gap(ids.integer(0));
    expected = ids.integer(0);
  }
  gap(points);
  return out;
}

std::vector<Shard> shardsOf(const std::vector<PointRange>& missing, const std::vector<Part>& parts,
                            std::int64_t points) {
  const int shards = parts.front().identity.shards;
  const auto same = [&](const Part& part) { return part.identity.shards == shards; };
  std::vector<Shard> out;
  if (shards == 1 || !std::all_of(parts.begin(), parts.end(), same)) return out;
  for (int k = 1; k <= shards; ++k) {
    const Shard shard{k, shards};
    const auto within = [&](const PointRange& range) {
      return range.first < shard.end(points) && range.end > shard.first(points);
    };
    if (std::any_of(missing.begin(), missing.end(), within)) out.push_back(shard);
  }
  return out;
}

}  // namespace

MergeResult mergeSweeps(const std::vector<std::filesystem::path>& files, const std::filesystem::path& into,
                        const std::function<void(std::size_t parts)>& progress, const std::function<bool()>& stop) {
  for (const std::filesystem::path& file : files) {
    std::error_code ignored;
    if (std::filesystem::equivalent(file, into, ignored))
      throw DatabaseError(
          fmt::format("{}: error: is the database that all go into, expected it as --db alone", file.string()));
  }
  const std::vector<Part> parts = opened(files, stop);
  requireAgreement(parts, stop);
  MergeResult out;
  out.identity = parts.front().identity;
  out.identity.shard = out.identity.shards = 1;
  SweepDatabase database(into, out.identity);
  database.sqlite().stopWhen(stop);
  database.sqlite().run("COMMIT");
  for (const Part& part : parts) compare(database.sqlite(), part);
  std::size_t done = 0;
  for (const Part& part : parts) {
    database.sqlite().run("BEGIN IMMEDIATE");  // begins before the attachment, which would be locked, too
    attach(database.sqlite(), part.file);
    out.added += takeIn(database, part);
    database.sqlite().run("COMMIT; DETACH part");
    if (progress) progress(++done);
  }
  out.done = database.pointsDone();
  out.missing = missingOf(database, out.identity.points);
  out.missing_shards = shardsOf(out.missing, parts, out.identity.points);
  database.sqlite().run("BEGIN");
  database.finish();
  return out;
}

}  // namespace ursula
