#include "parts/identify/measured_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "base/csv.h"
#include "base/text.h"
#include "base/utf8.h"
#include "model/columns.h"
#include "parts/identify/log_grid.h"

namespace ursula {
namespace {

using identification::LogGrid;

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

std::vector<std::pair<std::string, std::string>> pairsOf(const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw CsvError(fmt::format("--map: '{}', expected NAME=COLUMN", shown(text)));
    out.emplace_back(trimmedCell(std::string_view(text).substr(0, equals)),
                     utf8(std::string(trimmedCell(std::string_view(text).substr(equals + 1)))));
  }
  return out;
}

/// Returns each motor's constant, N·m/A or N/A.
PerMotor<double> constantsOf(const Columns& columns, const std::vector<double>& given) {
  PerMotor<double> out;
  out.fill(1);
  if (columns.has_currents && given.size() != 1 && given.size() != motor_count)
    throw CsvError(fmt::format(
        "the log has currents: --constant needs the motors' constants, N·m/A or N/A, one or six, and got {}",
        given.size()));
  if (!columns.has_currents && !given.empty()) throw CsvError("--constant is for currents, and the log has efforts");
  for (std::size_t k = 0; k < motor_count && !given.empty(); ++k) out[k] = given.size() == 1 ? given[0] : given[k];
  return out;
}

/// A log is read twice from its start, which no pipe can give.
const std::filesystem::path& seekable(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    throw CsvError(fmt::format("{}: error: not a regular file, expected one", shownPath(file.string())));
  return file;
}

/// Returns a value's place in a row: motion, efforts, then moment and force of the load.
std::size_t slotOf(const Column& column, const Columns& columns) {
  const std::size_t motion = columns.has_poses ? 7 : 6;
  const ColumnQuantity of = column.quantity;
  return column.index + (of == ColumnQuantity::quaternion || of == ColumnQuantity::angle ? 3
                         : of == ColumnQuantity::effort || of == ColumnQuantity::current ? motion
                         : of == ColumnQuantity::moment                                  ? motion + 6
                         : of == ColumnQuantity::force                                   ? motion + 9
                                                                                         : 0);
}

std::vector<std::size_t> turningOf(const Manipulator& machine, bool has_poses) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < motor_count && !has_poses; ++k)
    if (!machine.motors()[k].slides()) out.push_back(k);
  return out;
}

/// Splits the grid's values into `motion` columns of motion, efforts and a load, if any.
MeasuredLog parted(MeasuredLog log, Eigen::Index motion) {
  log.efforts = log.motion.middleCols(motion, motor_count);
  if (log.motion.cols() > motion + motor_count) log.load = log.motion.rightCols(6);
  log.motion.conservativeResize(Eigen::NoChange, motion);
  log.has_poses = motion == 7;
  return log;
}

/// Reads a log line by line, so that large files need little memory.
class LogReader {
 public:
  LogReader(const LogOptions& options, const Manipulator& machine)
      : machine_(machine), file_(options.file.string()), stream_(seekable(options.file), std::ios::binary) {
    if (!stream_)
      throw CsvError(fmt::format("{}: error: {}, expected a log as CSV", shownPath(file_),
                                 std::filesystem::exists(options.file) ? "cannot be read" : "no such file"));
    std::string head(std::size_t{1} << 16, '\0');
    stream_.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(stream_.gcount());
    if (const auto end = head.rfind('\n'); stream_ && end != std::string::npos) head.resize(end + 1);
    stream_.clear();
    stream_.seekg(0);
    dialect_ = guessDialect(utf8(std::move(head)), options.file);
    if (dialect_.header_cells.empty())
      throw CsvError(fmt::format("{}: error: empty, expected a log", shownPath(file_)));
    columns_ = findLogColumns(dialect_, file_, pairsOf(options.map), machine);
    const auto constants = constantsOf(columns_, options.constants);
    for (Column& column : columns_.columns)
      if (column.quantity == ColumnQuantity::current) column.factor *= constants[column.index];
  }

  MeasuredLog read() {
    const std::size_t motion = columns_.has_poses ? 7 : 6, width = motion + 6 + (columns_.has_load ? 6 : 0);
    LogGrid grid(width, turningOf(machine_, columns_.has_poses));
    std::vector<double> row(width), before;
    std::string line;
    while (std::getline(stream_, line)) {
      ++line_;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (line_ <= dialect_.header || isPassedOver(line, dialect_)) continue;
      const double t = parse(line, row);
      if (columns_.has_poses) keepSign(row, before);
      grid.add(t, row, [this] { return fmt::format("{}:{}", shownPath(file_), line_); });
    }
    MeasuredLog log = parted(grid.finish(file_, first_lacking_), motion);
    log.read_as = columns_.read_as;
    log.ignored = columns_.ignored;
    return log;
  }

 private:
  /// Fills `row` and returns its instant.
  double parse(std::string& line, std::vector<double>& row) {
    if (dialect_.decimal_comma) std::replace(line.begin(), line.end(), ',', '.');
    const std::vector<std::string_view> cells = splitCells(line, dialect_.separator);
    if (const std::size_t width = dialect_.header_cells.size(); cells.size() != width)
      throw CsvError(fmt::format("{}:{}: error: {} cell{}, expected {}, one for each column of the header",
                                 shownPath(file_), line_, cells.size(), cells.size() == 1 ? "" : "s", width));
    double t = not_there;
    for (const Column& column : columns_.columns) {
      const double value = cell(cells[column.place], column) * column.factor;
      (column.quantity == ColumnQuantity::time ? t : row[slotOf(column, columns_)]) = value;
      if (std::isnan(value) && first_lacking_.empty())
        first_lacking_ = fmt::format("'{}' in line {}", shown(column.name), line_);
    }
    if (columns_.has_angles) {
      const Eigen::Vector4d q = quaternionOfAngles({row[3], row[4], row[5]});
      std::copy(q.begin(), q.end(), row.begin() + 3);
    }
    if (std::isnan(t))
      throw CsvError(fmt::format("{}:{}: error: no instant, expected a number", shownPath(file_), line_));
    return t;
  }

  double cell(std::string_view text, const Column& column) const {
    if (text.empty() || text == "nan" || text == "NaN" || text == "NA") return not_there;
    const LeadingNumber number = leadingNumber(text);
    if (number.length != text.size() || !std::isfinite(number.value))
      throw CsvError(fmt::format("{}:{}: error: column '{}': '{}', expected a finite number", shownPath(file_), line_,
                                 shown(column.name), shown(std::string(text))));
    return number.value;
  }

  /// Keeps a quaternion near the previous one, as q and −q are the same orientation.
  static void keepSign(std::vector<double>& row, std::vector<double>& before) {
    double product = 0;
    for (std::size_t k = 3; k < 7; ++k) product += row[k] * (before.empty() ? row[k] : before[k]);
    for (std::size_t k = 3; k < 7 && product < 0; ++k) row[k] = -row[k];
    if (!std::isnan(product)) before = row;
  }

  const Manipulator& machine_;
  std::string file_;
  std::ifstream stream_;
  CsvDialect dialect_;
  Columns columns_;
  std::string first_lacking_;  ///< the first cell without a number, in words
  int line_ = 0;
};

}  // namespace

MeasuredLog readMeasuredLog(const LogOptions& options, const Manipulator& machine) {
  return LogReader(options, machine).read();
}

MeasuredLog measuredLogOf(const std::vector<double>& t, const Eigen::MatrixXd& motion, const Eigen::MatrixXd& efforts,
                          const Manipulator& machine) {
  const std::size_t columns = motion.cols();
  LogGrid grid(columns + motor_count, turningOf(machine, columns == 7));
  std::vector<double> row(columns + motor_count);
  for (std::size_t i = 0; i < t.size(); ++i) {
    Eigen::Map<Eigen::VectorXd>(row.data(), motion.cols()) = motion.row(i).transpose();
    Eigen::Map<Eigen::VectorXd>(row.data() + columns, motor_count) = efforts.row(i).transpose();
    grid.add(t[i], row, [i] { return fmt::format("row {}", i + 1); });
  }
  return parted(grid.finish("the log"), motion.cols());
}

}  // namespace ursula
