#include "apps/output.h"

#include <execinfo.h>
#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "apps/choice.h"
#include "apps/verbs.h"
#include "base/child_process.h"

namespace ursula {

void sayText(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void secureStreams() {
  // Standard input still cannot be read, and standard output cannot be written.
  constexpr std::array<std::pair<int, int>, 3> streams = {
      {{STDIN_FILENO, O_WRONLY}, {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_WRONLY}}};
  for (const auto& [stream, access] : streams)
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF) ::open("/dev/null", access);  // gets the lowest free number
  for (const int error : {SIGPIPE, SIGXFSZ}) std::signal(error, SIG_IGN);
}

void loadUnwinder() {
  void* frame = nullptr;
  ::backtrace(&frame, 1);
}

void shareArenaInBoundedMemory() {
#ifdef __GLIBC__
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) ::mallopt(M_ARENA_MAX, 1);
#endif
}

std::string lostOutput() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return "";
  return std::string("standard output could not be written") + (errno == 0 ? "" : ": ") +
         (errno == 0 ? "" : std::strerror(errno));
}

namespace {

[[noreturn]] void failOnStandardOutput() {
  throw std::runtime_error(std::string("standard output could not be written: ") + std::strerror(errno));
}

bool isPng(const std::string& file) { return file.size() > 4 && file.compare(file.size() - 4, 4, ".png") == 0; }

}  // namespace

void writePicture(const std::string& file, const std::string& svg) {
  if (!isPng(file)) return writeOutput(file, svg);
  try {
    constexpr double longest = 60;  // s
    writeOutput(file, answerOf({"rsvg-convert", "--zoom", "2", "--background-color", "white"}, svg, Deadline(longest)));
  } catch (const OutOfTime& limit) {
    throw std::runtime_error(fmt::format("{}: rsvg-convert makes no picture: {}", file, limit.what()));
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::no_such_file_or_directory) throw;
    throw UsageError("--picture: " + file + ": PNG needs rsvg-convert, in Debian's librsvg2-bin; expected an SVG file");
  }
}

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
  verb.add_option("--jobs", jobs, "Number of threads, at most those of the processor; results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

}  // namespace ursula
