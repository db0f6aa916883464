#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace ursula {

/// What SQLite, or a file that is no database of ours, has to say, with the file.
struct DatabaseError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Somebody else is at it.
struct DatabaseLocked : DatabaseError {
  using DatabaseError::DatabaseError;
};

/// What was asked ended it: Sqlite::stopWhen.
struct DatabaseStopped : DatabaseError {
  using DatabaseError::DatabaseError;
};

/// One connection, for one thread. Everything throws DatabaseError.
class Sqlite {
 public:
  enum class Access { read, write, create };

  Sqlite(const std::filesystem::path& file, Access access);
  ~Sqlite();
  Sqlite(const Sqlite&) = delete;
  Sqlite& operator=(const Sqlite&) = delete;

  /// Asks now and then, also within a statement, and throws DatabaseStopped where the answer is yes; may be empty.
  void stopWhen(std::function<bool()> stop);
  void run(const std::string& sql);
  /// The first column of the first row.
  std::int64_t number(const std::string& sql);
  std::string text(const std::string& sql);
  /// Whether the file that is open has another name by now, or none.
  bool hasMoved() const;
  /// Rows that the last statement changed.
  std::int64_t changed() const;
  const std::filesystem::path& file() const { return file_; }
  [[noreturn]] void fail(const std::string& doing) const;

 private:
  friend class Statement;
  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
  std::function<bool()> stop_;
};

/// A statement made once and run often. Parameters and columns count from 0.
class Statement {
 public:
  Statement(Sqlite& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int k, std::int64_t value);
  Statement& bind(int k, double value);  ///< NaN becomes NULL
  Statement& bind(int k, std::string_view value);
  Statement& bindNull(int k);

  /// True where there is a row. After the last one, and by reset(), it can be run anew.
  bool step();
  void reset();
  /// To its end; no rows wanted.
  void run();

  bool isNull(int k) const;
  std::int64_t integer(int k) const;
  double real(int k) const;  ///< NULL is NaN
  std::string text(int k) const;

 private:
  Sqlite& database_;
  sqlite3_stmt* handle_ = nullptr;
};

}  // namespace ursula
