#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/output_file.h"
#include "studies/stream/row_format.h"

namespace ursula {

/// An option may also be absent, or "-", which is a standard stream.
inline bool namesFile(const std::string& option) { return !option.empty() && option != "-"; }

/// What a verb writes piece by piece: to a file that nobody sees before it is whole, or to standard output where `file`
/// is "-" or empty.
class Output {
 public:
  explicit Output(const std::string& file);

  void write(std::string_view piece);
  void commit();

 private:
  std::optional<OutputFile> file_;
};

/// `--format` and `--jobs` of verbs that write rows.
void addRowOptions(CLI::App& verb, RowFormat& format, int& jobs);

}  // namespace ursula
