#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/errors.h"

struct sqlite3;
struct sqlite3_stmt;

namespace ursula {

/// An error of SQLite, or a file that is no database of ours; the text names the file.
struct DatabaseError : InputError {
  using InputError::InputError;
};

/// Another process uses the database.
struct DatabaseLocked : DatabaseError {
  using DatabaseError::DatabaseError;
};

/// Sqlite::stopWhen ended the statement.
struct DatabaseStopped : DatabaseError {
  using DatabaseError::DatabaseError;
};

/// One connection, for one thread. Every function throws DatabaseError.
class Sqlite {
 public:
  enum class Access { read, write, create };

  Sqlite(const std::filesystem::path& file, Access access);
  ~Sqlite();
  Sqlite(const Sqlite&) = delete;
  Sqlite& operator=(const Sqlite&) = delete;

  /// Polls `stop`, even within a statement, and throws DatabaseStopped if it returns true. `stop` may be empty.
  void stopWhen(std::function<bool()> stop);
  void run(const std::string& sql);
  /// Returns the first column of the first row.
  std::int64_t number(const std::string& sql);
  std::string text(const std::string& sql);
  /// Returns whether the open file was renamed or removed.
  bool hasMoved() const;
  /// Returns the number of rows that the last statement changed.
  std::int64_t changed() const;
  const std::filesystem::path& file() const { return file_; }

 private:
  friend class Statement;
  [[noreturn]] void fail() const;

  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
  std::function<bool()> stop_;
};

/// A prepared statement. Columns count from 0.
class Statement {
 public:
  Statement(Sqlite& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// Binds all parameters: integers, numbers and texts. NaN and a text that is not there become NULL.
  template <class... Values>
  Statement& bind(const Values&... values) {
    int k = 0;
    (put(++k, values), ...);
    return *this;
  }

  /// Returns whether there is a row. After the last one, or after reset(), the statement can run again.
  bool step();
  void reset();
  /// Runs to the end and ignores rows.
  void run();

  bool isNull(int k) const;
  std::int64_t integer(int k) const;
  double real(int k) const;  ///< NULL becomes NaN
  std::string text(int k) const;
  /// Sets values to the first columns.
  template <class... Values>
  void read(Values&... values) const {
    int k = 0;
    (get(k++, values), ...);
  }

 private:
  void put(int k, std::int64_t value);
  void put(int k, int value) { put(k, std::int64_t{value}); }
  void put(int k, double value);
  void put(int k, const std::optional<std::string_view>& value);
  void get(int k, std::int64_t& value) const { value = integer(k); }
  void get(int k, double& value) const { value = real(k); }
  void get(int k, bool& value) const { value = integer(k) != 0; }
  void get(int k, std::string& value) const { value = text(k); }

  Sqlite& database_;
  sqlite3_stmt* handle_ = nullptr;
};

}  // namespace ursula
