// A database that is opened, and what a report makes of it.

#include <sys/mman.h>
#include <unistd.h>

#include <stdexcept>

#include "tests/fuzz/fuzz.h"
#include "validation/sweep_report/sweep_csv.h"
#include "validation/sweep_report/sweep_summary.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int file = ::memfd_create("fuzz.db", 0);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (::ftruncate(file, 0) != 0 || ::pwrite(file, data, size, 0) != static_cast<ssize_t>(size)) return 0;
  try {
    ursula::Sqlite database(path, ursula::Sqlite::Access::read);
    ursula::summarise(database);
    ursula::writeSweepCsv(database, [](std::string_view) {});
  } catch (const ursula::DatabaseError&) {
  }
  return 0;
}
