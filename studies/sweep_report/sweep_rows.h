#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "studies/sweep/sqlite.h"

namespace ursula {

/// One point with its results, as in the database.
struct SweepRow {
  struct Value {
    std::size_t name = 0;         ///< index into SweepRows::names()
    double value = 0, limit = 0;  ///< NaN if there is none
    std::string verdict;          ///< empty if there is none
  };
  std::int64_t id = 0;
  std::string verdict, error;
  std::vector<double> parameters;  ///< one per key, finite
  std::vector<Value> values;
};

/// Reads points by ascending id, one at a time, as they were at its construction, even if others write meanwhile. A
/// connection can have only one reader. Throws DatabaseError.
class SweepRows {
 public:
  SweepRows(Sqlite& database, const std::vector<std::string>& keys);

  /// Names of results, sorted by their bytes.
  const std::vector<std::string>& names() const { return names_; }
  bool next(SweepRow& row);

 private:
  /// A read transaction.
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
