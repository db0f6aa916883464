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

/// Refuses names of pictures that this program cannot draw.
inline std::string expectsSvg(const std::string& file) {
  const bool is_png = file.size() > 4 && file.compare(file.size() - 4, 4, ".png") == 0;
  return is_png ? "got " + file + ", expected an SVG file; a report's page saves PNG" : "";
}

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
