#include "apps/output.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "apps/choice.h"
#include "apps/streams.h"
#include "apps/verbs.h"
#include "base/child_process.h"

namespace ursula {
namespace {

[[noreturn]] void failOnStandardOutput() {
  throw std::runtime_error(std::string("standard output could not be written: ") + std::strerror(errno));
}

/// Gives `text` to a program's standard input. Returns its output.
std::string filtered(const std::vector<std::string>& words, std::string_view text) {
  ChildProcess child({words, {}, true});
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(child.to(), text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) break;  // it ended; its status says why
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  child.closeInput();
  std::string out;
  std::array<char, 65536> some{};
  for (ssize_t count = 0; (count = ::read(child.from(), some.data(), some.size())) != 0;)
    if (count > 0)
      out.append(some.data(), static_cast<std::size_t>(count));
    else if (errno != EINTR)
      break;
  child.wait();
  if (child.status() != 0) throw std::runtime_error(words.front() + " " + child.howItEnded());
  return out;
}

bool isPng(const std::string& file) { return file.size() > 4 && file.compare(file.size() - 4, 4, ".png") == 0; }

}  // namespace

void writePicture(const std::string& file, const std::string& svg) {
  if (!isPng(file)) return writeOutput(file, svg);
  try {
    writeOutput(file, filtered({"rsvg-convert", "--zoom", "2", "--background-color", "white"}, svg));
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
