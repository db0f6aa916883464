#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/fresh_paths.h"
#include "parts/sweep/sqlite.h"

namespace ursula {

/// The largest number of shards of a sweep.
constexpr int most_shards = 1'000'000;

/// The sweep of a database: its table `sweep`, one row.
struct SweepIdentity {
  std::string text;      ///< the sweep's file
  std::string hash;      ///< of everything that determines rows: the sweep's content, the scenario's text and the files
                         ///< that it names
  std::string version;   ///< version of the program
  std::string file;      ///< the sweep's path, as given
  std::string scenario;  ///< text of the varied scenario
  std::string name;      ///< name of that scenario
  std::string what;      ///< "validate" or "inverse"
  std::string design;    ///< "grid", "random" or "sobol"
  bool pointwise = false;
  std::int64_t points = 0;  ///< in all shards
  int shard = 1, shards = 1;
  std::vector<std::string> keys;  ///< the varied numbers, in the sweep's order
};

/// One named value of a point; NaN if missing.
struct SweepValue {
  std::string name;
  double value = 0, limit = 0;
  std::string verdict;  ///< for a check; else empty
};

/// One point, as stored in the database.
struct SweepPoint {
  std::int64_t id = 0;
  std::string parameters;  ///< JSON object, in the sweep's order
  std::string verdict;     ///< pass, fail, inconclusive, out_of_reach, singular or error
  double seconds = 0;
  std::string error;  ///< empty if there is none
  std::vector<SweepValue> values;
};

/// Writes points and results of a sweep. Writes are atomic in batches, however the program ends. Throws DatabaseError
/// if the file is no such database, is damaged, comes from a newer program, or is being written by another process.
class SweepDatabase {
 public:
  /// Opens or creates the database of `identity`, with missing folders. Refuses one of another sweep, shard or program
  /// version.
  SweepDatabase(const std::filesystem::path& file, const SweepIdentity& identity);
  ~SweepDatabase();

  std::int64_t pointsDone();
  /// Returns the smallest existing id in [from, end); `end` if there is none.
  std::int64_t firstDone(std::int64_t from, std::int64_t end);

  /// Removes points with verdict "error", so that they are computed again.
  void dropErrors();
  void add(const SweepPoint& point);
  /// Makes added points durable. Refuses a file that was removed, renamed or replaced meanwhile, after all added points
  /// are in it.
  void commit();
  /// Commits for the last time and leaves one file that can be moved anywhere. Reads it again and refuses a damaged
  /// one.
  void finish();

  Sqlite& sqlite() { return sqlite_; }

 private:
  struct Statements;
  void requireInPlace();

  FreshPaths folders_;
  Sqlite sqlite_;
  std::unique_ptr<Statements> statements_;
};

/// Reads a sweep's identity from an open database and checks that it is one; throws DatabaseError.
SweepIdentity readIdentity(Sqlite& database);
/// Throws DatabaseError unless `file`, with the identity `there`, has the same sweep, shard and program version as
/// `ours`.
void requireSame(const std::filesystem::path& file, const SweepIdentity& there, const SweepIdentity& ours);
/// Returns whether the database has no content, because its creator ended early.
bool isEmpty(Sqlite& database);

}  // namespace ursula
