#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/output_file.h"
#include "base/text.h"
#include "report/files/blocks.h"

namespace ursula {

/// Writes to standard error for people, and ignores failures, because only lost data is an error. Control characters
/// are not escaped.
void sayText(const std::string& text);

/// Writes a sentence. Control characters in file names and contents are escaped, to protect the terminal.
template <class... Arguments>
void say(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
  sayText(withoutControls(fmt::format(form, std::forward<Arguments>(arguments)...)));
}

/// Prepares the streams before anything is opened. Streams that the caller closed get a placeholder, so that no file
/// receives text for a terminal; writing to standard output still fails. A closed reader or a file size limit becomes
/// an error of the write instead of a signal.
void secureStreams();

/// Loads early the library that unwinds threads. The C library loads it on demand and aborts if memory is short by
/// then.
void loadUnwinder();

/// If the address space is bounded (`ulimit -v`), makes threads share one arena. glibc reserves 64 MB for each further
/// arena, and repeats failed attempts at every call.
void shareArenaInBoundedMemory();

/// Returns why standard output is incomplete; "" if it is complete.
std::string lostOutput();

/// Whether the option names a file. It may also be absent, or "-" for a standard stream.
inline bool namesFile(const std::string& option) { return !option.empty() && option != "-"; }

/// Writes a picture, as PNG if the file's name ends so. Throws UsageError if the program that makes PNG is missing.
void writePicture(const std::string& file, const std::string& svg);

/// Writes in pieces to a file that appears only when complete, or to standard output if `file` is "-" or empty.
class Output {
 public:
  explicit Output(const std::string& file);

  void write(std::string_view piece);
  void commit();

 private:
  std::optional<OutputFile> file_;
};

/// Adds `--format` and `--jobs` to verbs that write rows.
void addRowOptions(CLI::App& verb, RowFormat& format, int& jobs);

}  // namespace ursula
