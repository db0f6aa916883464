#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/fresh_paths.h"
#include "studies/sweep/sqlite.h"

namespace ursula {

/// Parts that a sweep is cut into.
constexpr int most_shards = 1'000'000;

/// What a database is of: its table `sweep`, one row.
struct SweepIdentity {
  std::string text;      ///< the sweep's file
  std::string hash;      ///< of all that decides rows: the sweep's meaning, the scenario's text, files that it names
  std::string version;   ///< of the program
  std::string file;      ///< the sweep's path, as given
  std::string scenario;  ///< the text of the scenario that is varied
  std::string name;      ///< that scenario's
  std::string what;      ///< "validate" or "inverse"
  std::string design;    ///< "grid", "random" or "sobol"
  bool pointwise = false;
  std::int64_t points = 0;  ///< in all shards
  int shard = 1, shards = 1;
  std::vector<std::string> keys;  ///< the varied numbers, in the sweep's order
};

/// One name's value of a point; NaN where there is none.
struct SweepValue {
  std::string name;
  double value = 0, limit = 0;
  std::string verdict;  ///< of a check; empty: none
};

/// One point, as it goes into the database.
struct SweepPoint {
  std::int64_t id = 0;
  std::string parameters;  ///< JSON object, in the sweep's order
  std::string verdict;     ///< pass, fail, inconclusive, out_of_reach, singular or error
  double seconds = 0;
  std::string error;  ///< empty: none
  std::vector<SweepValue> values;
};

/// Points and results of a sweep. Written in batches: what one holds is there as a whole or not at all, however the
/// program ends. Throws DatabaseError: of a file that is no such database, is damaged, was written by a newer program,
/// or is written to by somebody else.
class SweepDatabase {
 public:
  /// Opens, or makes, the one of `identity`, with folders that are missing; refuses one of another sweep, another shard
  /// or another program version.
  SweepDatabase(const std::filesystem::path& file, const SweepIdentity& identity);
  /// To be read.
  explicit SweepDatabase(const std::filesystem::path& file);
  ~SweepDatabase();

  const SweepIdentity& identity() const { return identity_; }
  std::int64_t pointsDone();
  /// The least id of [from, end) that is there; `end` where none is.
  std::int64_t firstDone(std::int64_t from, std::int64_t end);

  /// Takes those with verdict "error" out, so that they are made again.
  void dropErrors();
  void add(const SweepPoint& point);
  /// What was added since the last time is there for good. Refuses a file that was removed, renamed or replaced
  /// meanwhile, after all that was added is in it, wherever it is.
  void commit();
  /// The same for the last time: leaves one file that can be read wherever it is carried. Refuses one that is damaged,
  /// read anew.
  void finish();

  Sqlite& sqlite() { return sqlite_; }

 private:
  struct Statements;
  void requireInPlace();
  void requireSoundFile();

  FreshPaths folders_;
  Sqlite sqlite_;
  SweepIdentity identity_;
  std::unique_ptr<Statements> statements_;
};

/// Reads a sweep's identity of an open database and checks that it is one; throws DatabaseError.
SweepIdentity readIdentity(Sqlite& database);
/// Throws DatabaseError where `file`, of `there`, is not of the same sweep, shard and program version as `ours`.
void requireSame(const std::filesystem::path& file, const SweepIdentity& there, const SweepIdentity& ours);
/// Whether it was only just made: whoever made it ended before anything was in it.
bool isEmpty(Sqlite& database);

}  // namespace ursula
