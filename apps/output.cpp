#include "apps/output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <stdexcept>

#include "apps/choice.h"

namespace ursula {
namespace {

[[noreturn]] void failOnStandardOutput() {
  throw std::runtime_error(std::string("standard output could not be written: ") + std::strerror(errno));
}

}  // namespace

Output::Output(const std::string& file) {
  if (namesFile(file)) file_.emplace(file);
}

void Output::write(std::string_view piece) {
  if (file_) return file_->write(piece);
  if (std::fwrite(piece.data(), 1, piece.size(), stdout) != piece.size()) failOnStandardOutput();
}

void Output::commit() {
  if (file_) return file_->commit();
  if (std::fflush(stdout) != 0) failOnStandardOutput();
}

void addRowOptions(CLI::App& verb, RowFormat& format, int& jobs) {
  static const std::map<std::string, RowFormat> formats = {{"csv", RowFormat::csv}, {"binary", RowFormat::binary}};
  takeOneOf(verb.add_option("--format", format,
                            "binary: a line of JSON (columns, rows, dtype, offset), then the rows as little-endian "
                            "doubles, as numpy.fromfile reads them"),
            formats)
      ->default_str("csv");
  verb.add_option("--jobs", jobs, "Threads, as far as the processor has them; results are the same for any number")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

}  // namespace ursula
