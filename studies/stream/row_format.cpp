#include "studies/stream/row_format.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "base/csv_rows.h"

namespace ursula {
namespace {

/// Aligns rows for vector loads if the file is mapped into memory.
constexpr std::size_t alignment = 64;

std::string jsonLine(const std::vector<std::string>& names, std::size_t rows) {
  std::string columns;
  for (const std::string& name : names) columns += (columns.empty() ? "\"" : ", \"") + name + "\"";
  const auto line = [&](std::size_t offset) {
    return fmt::format(R"({{"columns": [{}], "rows": {}, "dtype": "<f8", "offset": {:7}}})", columns, rows, offset);
  };
  const std::size_t least = line(0).size() + 1, offset = (least + alignment - 1) / alignment * alignment;
  std::string out = line(offset);
  out.resize(offset - 1, ' ');
  return out + '\n';
}

void putLittleEndian(double value, char* to) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  for (unsigned k = 0; k < sizeof(bits); ++k)
    to[k] = static_cast<char>(bits >> (8 * k));  // compiles to one store if possible
}

void appendBinary(const std::vector<std::vector<double>>& columns, std::string& out) {
  const std::size_t rows = columns.empty() ? 0 : columns.front().size(), before = out.size();
  out.resize(before + rows * columns.size() * sizeof(double));
  char* to = &out[before];
  for (std::size_t row = 0; row < rows; ++row)
    for (const std::vector<double>& column : columns) {
      putLittleEndian(column[row], to);
      to += sizeof(double);
    }
}

}  // namespace

std::string rowHeader(RowFormat format, const std::vector<std::string>& names, std::size_t rows) {
  return format == RowFormat::csv ? csvHeader(names) : jsonLine(names, rows);
}

void appendRows(RowFormat format, const TimeSeries& series, std::string& out) {
  if (format == RowFormat::csv)
    appendCsvRows(series.columns, out);
  else
    appendBinary(series.columns, out);
}

}  // namespace ursula
