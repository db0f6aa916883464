#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/output_file.h"
#include "studies/stream/row_format.h"

namespace ursula {

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
