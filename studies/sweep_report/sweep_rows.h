#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "studies/sweep/sqlite.h"

namespace ursula {

/// One point with its results, as the database has them.
struct SweepRow {
  struct Value {
    std::size_t name = 0;         ///< index into SweepRows::names()
    double value = 0, limit = 0;  ///< NaN where there is none
    std::string verdict;          ///< empty where there is none
  };
  std::int64_t id = 0;
  std::string verdict, error;
  std::vector<double> parameters;  ///< one for each key, finite
  std::vector<Value> values;
};

/// Points by ascending id, one at a time, as they were when this was made, whoever writes meanwhile. One at a time for
/// a connection. Throws DatabaseError.
class SweepRows {
 public:
  SweepRows(Sqlite& database, const std::vector<std::string>& keys);

  /// Names of results, by their bytes.
  const std::vector<std::string>& names() const { return names_; }
  bool next(SweepRow& row);

 private:
  /// A transaction that reads.
  class Snapshot {
   public:
    explicit Snapshot(Sqlite& database) : database_(database) { database_.run("BEGIN"); }
    ~Snapshot();
    Snapshot(const Snapshot&) = delete;
    Snapshot& operator=(const Snapshot&) = delete;

   private:
    Sqlite& database_;
  };

  void readParameters(SweepRow& row) const;
  std::size_t indexOf(const std::string& name, std::size_t guess) const;

  Sqlite& database_;
  const std::vector<std::string>& keys_;
  Snapshot snapshot_;  ///< outlives the statements
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::size_t> places_;
  Statement points_, results_;
  bool has_result_;
};

}  // namespace ursula
