#include "parts/sweep/sqlite.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

namespace ursula {
namespace {

/// Waits this long, because others may lock the database while they write one batch.
constexpr int patience = 5000;  // ms
/// Steps of SQLite's virtual machine between two polls: some microseconds.
constexpr int steps_between = 100;
/// By Sqlite::Access.
constexpr int flags[] = {SQLITE_OPEN_READONLY, SQLITE_OPEN_READWRITE, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE};

/// Returns the last error of the system. SQLite reports it for a connection, but not at the end of a transaction; then
/// its files have it.
int systemError(sqlite3* handle) {
  int error = sqlite3_system_errno(handle);
  sqlite3_file* journal = nullptr;
  if (error == 0) sqlite3_file_control(handle, "main", SQLITE_FCNTL_JOURNAL_POINTER, &journal);
  if (journal != nullptr && journal->pMethods != nullptr)
    journal->pMethods->xFileControl(journal, SQLITE_FCNTL_LAST_ERRNO, &error);
  if (error == 0) sqlite3_file_control(handle, "main", SQLITE_FCNTL_LAST_ERRNO, &error);
  return error;
}

/// Returns the system's message; `message` is SQLite's, which gives no cause.
std::string cause(int system_error, const char* message) {
  if (system_error == EFBIG) return "a file may not grow further (ulimit -f)";
  return system_error != 0 ? std::strerror(system_error) : message;
}

/// Returns a message for the user about errors that the user can fix.
std::string inWords(int code, const char* message, int system_error) {
  switch (code) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program has locked it: try again when that program has ended";
    case SQLITE_CONSTRAINT:  // each sweep has its own points
      return "another sweep has written the same points meanwhile; its points are kept, and a new run continues from "
             "them";
    case SQLITE_FULL:
      return "the disk is full; points written earlier are kept";
    case SQLITE_READONLY:
      return "it cannot be written: the file or its folder is read-only";
    case SQLITE_NOTADB:
      return "not an SQLite database, expected the database of a sweep";
    case SQLITE_CORRUPT:
      return std::string("the database is damaged: ") + message;
    case SQLITE_CANTOPEN:
      return "it cannot be opened or created here" + (system_error != 0 ? ": " + cause(system_error, "") : "");
    case SQLITE_IOERR:
      return "reading or writing failed: " + cause(system_error, message);
    default:
      return message;
  }
}

}  // namespace

Sqlite::Sqlite(const std::filesystem::path& file, Access access) : file_(file) {
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::status(file, ignored);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
    throw DatabaseError(fmt::format("{}: error: is not a regular file, expected a database", file.string()));
  // An absolute path, because SQLite gives names such as ":memory:" and "file:…" a special meaning.
  const std::string path = std::filesystem::absolute(file).string();
  const int status =
      sqlite3_open_v2(path.c_str(), &handle_, flags[static_cast<int>(access)] | SQLITE_OPEN_NOMUTEX, nullptr);
  if (status == SQLITE_OK) {
    sqlite3_extended_result_codes(handle_, 0);
    sqlite3_busy_timeout(handle_, patience);
    return;
  }
  const std::string why = handle_ == nullptr ? inWords(status, "out of memory", 0)
                                             : inWords(status, sqlite3_errmsg(handle_), systemError(handle_));
  sqlite3_close(handle_);
  throw DatabaseError(fmt::format("{}: error: {}", file.string(), why));
}

Sqlite::~Sqlite() {
  sqlite3_progress_handler(handle_, 0, nullptr, nullptr);  // a poll that stopped the closing would leave its log behind
  sqlite3_close(handle_);
}

void Sqlite::fail() const {
  const int code = sqlite3_errcode(handle_) & 0xff;
  const std::string what =
      fmt::format("{}: error: {}", file_.string(), inWords(code, sqlite3_errmsg(handle_), systemError(handle_)));
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) throw DatabaseLocked(what);
  if (code == SQLITE_INTERRUPT) throw DatabaseStopped(what);
  throw DatabaseError(what);
}

void Sqlite::stopWhen(std::function<bool()> stop) {
  stop_ = std::move(stop);
  if (!stop_) return;
  const auto ask = [](void* stop_of) { return (*static_cast<std::function<bool()>*>(stop_of))() ? 1 : 0; };
  sqlite3_progress_handler(handle_, steps_between, ask, &stop_);
}

void Sqlite::run(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::int64_t Sqlite::number(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.step() ? statement.integer(0) : 0;
}

std::string Sqlite::text(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.step() ? statement.text(0) : "";
}

bool Sqlite::hasMoved() const {
  int moved = 0;
  return sqlite3_file_control(handle_, "main", SQLITE_FCNTL_HAS_MOVED, &moved) == SQLITE_OK && moved != 0;
}

std::int64_t Sqlite::changed() const { return sqlite3_changes64(handle_); }

Statement::Statement(Sqlite& database, const std::string& sql) : database_(database) {
  if (sqlite3_prepare_v2(database.handle_, sql.c_str(), -1, &handle_, nullptr) != SQLITE_OK) database.fail();
}

Statement::~Statement() { sqlite3_finalize(handle_); }

void Statement::put(int k, std::int64_t value) { sqlite3_bind_int64(handle_, k, value); }
void Statement::put(int k, double value) { sqlite3_bind_double(handle_, k, value); }

void Statement::put(int k, const std::optional<std::string_view>& value) {
  if (value)
    sqlite3_bind_text64(handle_, k, value->data(), value->size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  else
    sqlite3_bind_null(handle_, k);
}

bool Statement::step() {
  const int status = sqlite3_step(handle_);
  if (status == SQLITE_ROW) return true;
  sqlite3_reset(handle_);
  if (status != SQLITE_DONE) database_.fail();
  return false;
}

void Statement::reset() { sqlite3_reset(handle_); }

void Statement::run() {
  while (step()) {
  }
}

bool Statement::isNull(int k) const { return sqlite3_column_type(handle_, k) == SQLITE_NULL; }
std::int64_t Statement::integer(int k) const { return sqlite3_column_int64(handle_, k); }

double Statement::real(int k) const {
  return isNull(k) ? std::numeric_limits<double>::quiet_NaN() : sqlite3_column_double(handle_, k);
}

std::string Statement::text(int k) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_, k));
  return bytes == nullptr ? "" : std::string(bytes, sqlite3_column_bytes(handle_, k));
}

}  // namespace ursula
