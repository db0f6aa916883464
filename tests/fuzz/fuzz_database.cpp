// A database and its report. The database is a file of any bytes, or a sound one changed by SQL.

#include <sqlite3.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "parts/sweep/report/sweep_outputs.h"
#include "parts/sweep/report/sweep_summary.h"
#include "tests/fuzz/fuzz.h"

namespace {

/// The file is in memory if possible, because libFuzzer opens it thousands of times a second. A name below /proc does
/// not work, because SQLite follows links to a file's own name.
const std::filesystem::path& file() {
  static const std::filesystem::path path = [] {
    const std::filesystem::path memory = "/dev/shm";
    const auto folder = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    std::atexit([] { std::filesystem::remove(file()); });
    return folder / ("ursula-fuzz-" + std::to_string(::getpid()) + ".db");
  }();
  return path;
}

void write(const std::string& bytes) { std::ofstream(file(), std::ios::binary | std::ios::trunc) << bytes; }

/// The database of a small sweep, with small pages.
const std::string& soundDatabase() {
  static const std::string bytes = [] {
    std::filesystem::remove(file());
    {
      ursula::SweepIdentity of;
      of.text = of.hash = of.version = of.file = of.scenario = of.name = "a";
      of.what = "validate";
      of.design = "random";
      of.points = 12;
      of.keys = {"platform.mass", "leg.1.drive"};
      ursula::SweepDatabase database(file(), of);
      for (int id = 0; id < 10; ++id)
        database.add({id,
                      R"({"platform.mass": 1.5, "leg.1.drive": )" + std::to_string(id) + "}",
                      id == 7 ? "error" : "pass",
                      0.1,
                      id == 7 ? "leg 3 cannot reach" : "",
                      {{"max_tau_1_Nm", 1.0 + id, 1, ""}, {"kappa", 3.0 * id, 1, ""}, {"torques", 0.1, 0.2, "pass"}}});
      database.finish();
    }
    ursula::Sqlite(file(), ursula::Sqlite::Access::write).run("PRAGMA page_size = 512; VACUUM");
    std::ifstream in(file(), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  }();
  return bytes;
}

/// Runs the SQL for a bounded number of steps, so that an endless statement ends.
void change(const std::string& sql) {
  sqlite3* handle = nullptr;
  if (sqlite3_open(file().c_str(), &handle) == SQLITE_OK) {
    sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, 100'000);
    sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 0);
    sqlite3_progress_handler(
        handle, 10'000, [](void*) { return 1; }, nullptr);
    sqlite3_exec(handle, "PRAGMA journal_mode = MEMORY; PRAGMA synchronous = OFF", nullptr, nullptr, nullptr);
    sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr);
  }
  sqlite3_close(handle);
}

void read() {
  ursula::Sqlite database(file(), ursula::Sqlite::Access::read);
  ursula::summarise(database);
  ursula::writeSweepCsv(database, [](std::string_view) {});
  ++ursula::fuzz::accepted;
}

}  // namespace

/// The sound database is read here, not in LLVMFuzzerInitialize. Writing a file catches SIGALRM, and libFuzzer, which
/// catches signals after that function, leaves a signal alone that is caught.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  [[maybe_unused]] static const bool sound_is_read = [] {  // otherwise nothing is tested
    write(soundDatabase());
    read();
    return true;
  }();
  const std::string input = ursula::fuzz::textOf(data, size);
  const bool whole = input.rfind("SQLite format", 0) == 0;
  write(whole ? input : soundDatabase());
  if (!whole) change(input);
  try {
    read();
  } catch (const ursula::DatabaseError&) {
  }
  return 0;
}
