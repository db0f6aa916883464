#include "studies/identify/measured_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "base/csv.h"
#include "base/leading_number.h"
#include "base/shown_text.h"
#include "studies/identify/log_columns.h"

namespace ursula {
namespace {

using identification::LogColumn;
using identification::LogColumns;
using identification::LogQuantity;

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t fewest_rows = 16, most_gap = 100'000;

/// Rows on their way to a grid: at most most_log_rows of them, neighbours averaged where there are more.
class GridCollector {
 public:
  explicit GridCollector(std::size_t width) : width_(width), sum_(width, 0.0) {}

  void add(const double* row) {
    for (std::size_t k = 0; k < width_; ++k) sum_[k] += row[k];
    if (++in_sum_ < averaged) return;
    for (double& value : sum_) {
      data.push_back(value / averaged);
      value = 0;
    }
    in_sum_ = 0;
    if (data.size() >= most_log_rows * width_) halve();
  }

  std::size_t rows() const { return data.size() / width_; }

  std::vector<double> data;
  int averaged = 1;

 private:
  void halve() {
    const std::size_t pairs = rows() / 2;
    for (std::size_t i = 0; i < pairs; ++i)
      for (std::size_t k = 0; k < width_; ++k)
        data[i * width_ + k] = (data[2 * i * width_ + k] + data[(2 * i + 1) * width_ + k]) / 2;
    data.resize(pairs * width_);
    averaged *= 2;
  }

  std::size_t width_;
  std::vector<double> sum_;
  int in_sum_ = 0;
};

/// Puts rows with their instants on a grid.
class LogGrid {
 public:
  LogGrid(std::size_t width, std::vector<std::size_t> turning) : collector_(width), width_(width), turning_(std::move(turning)) {}

  /// `place` names the row in errors.
  template <class Place>
  void add(double t, std::vector<double>& row, const Place& place) {
    if (count_ > 0 && !(t > last_t_))
      throw CsvError(fmt::format("{}: error: t = {} s {} {} s of the row before, expected increasing instants", place(),
                                 t, t == last_t_ ? "repeats" : "comes after", last_t_));
    if (count_ < head_size) {
      head_t_.push_back(t);
      head_.push_back(row);
    } else {
      if (count_ == head_size) settleHead();
      put(t, row, place);
    }
    last_t_ = t;
    ++count_;
  }

  MeasuredLog finish(const std::string& file);

 private:
  static constexpr std::size_t head_size = 1000;

  void settleHead() {
    std::vector<double> steps;
    for (std::size_t k = 1; k < head_t_.size(); ++k) steps.push_back(head_t_[k] - head_t_[k - 1]);
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
    step_ = steps[steps.size() / 2];
    first_t_ = grid_t_ = head_t_.front();
    for (std::size_t k = 0; k < head_t_.size(); ++k)
      put(head_t_[k], head_[k], [&] { return fmt::format("t = {} s", head_t_[k]); });
    head_.clear();
  }

  template <class Place>
  void put(double t, std::vector<double>& row, const Place& place) {
    if (rows_ > 0) {
      const double steps = (t - grid_t_) / step_;
      const auto jump = static_cast<std::size_t>(std::clamp(std::round(steps), 1.0, 1e9));
      if (jump > most_gap)
        throw CsvError(fmt::format("{}: error: {:.6g} s after the row before, where rows are {:.6g} s apart", place(),
                                   t - grid_t_, step_));
      if (jump == 1) jitter_ += (steps - 1) * (steps - 1);
      for (std::size_t k = 1; k < jump; ++k) fill(row, static_cast<double>(k) / static_cast<double>(jump));
      gaps_ += jump > 1 ? 1 : 0;
    }
    bool lacks = false;
    for (std::size_t k = 0; k < width_; ++k)
      if (std::isnan(row[k])) lacks = true, row[k] = last_.empty() ? 0 : last_[k];
    for (const std::size_t k : turning_)
      if (!last_.empty() && std::abs(row[k] - last_[k]) > pi)
        row[k] -= 2 * pi * std::round((row[k] - last_[k]) / (2 * pi));
    append(row.data(), lacks);
    lacking_ += lacks ? 1 : 0;
    last_ = row;
    grid_t_ = t;
  }

  void fill(const std::vector<double>& next, double share) {
    std::vector<double> between = last_;
    for (std::size_t k = 0; k < width_; ++k)
      if (!std::isnan(next[k])) between[k] += share * (next[k] - last_[k]);
    append(between.data(), true);
  }

  void append(const double* row, bool missing) {
    collector_.add(row);
    ++rows_;
    missing_.push_back(missing);
  }

  static constexpr double pi = 3.14159265358979323846;
  GridCollector collector_;
  std::size_t width_;
  std::vector<std::size_t> turning_;
  std::vector<double> head_t_;
  std::vector<std::vector<double>> head_;
  std::vector<bool> missing_;
  std::vector<double> last_;
  double step_ = 0, first_t_ = 0, grid_t_ = 0, last_t_ = 0, jitter_ = 0;
  std::size_t count_ = 0, rows_ = 0, gaps_ = 0, lacking_ = 0;
};

MeasuredLog LogGrid::finish(const std::string& file) {
  if (count_ < fewest_rows)
    throw CsvError(fmt::format("{}: error: {} rows, expected at least {}", shownPath(file), count_, fewest_rows));
  if (rows_ == 0) settleHead();
  MeasuredLog log;
  log.file = file;
  log.file_rows = count_;
  log.averaged = collector_.averaged;
  log.file_step = (grid_t_ - first_t_) / static_cast<double>(rows_ - 1);
  log.step = log.file_step * log.averaged;
  log.start = first_t_ + 0.5 * (log.averaged - 1) * log.file_step;
  const auto rows = static_cast<Eigen::Index>(collector_.rows());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  log.motion = Eigen::Map<const Rows>(collector_.data.data(), rows, static_cast<Eigen::Index>(width_));
  log.missing.assign(static_cast<std::size_t>(rows), false);
  for (std::size_t k = 0; k < missing_.size(); ++k)
    if (missing_[k] && k / static_cast<std::size_t>(log.averaged) < log.missing.size())
      log.missing[k / static_cast<std::size_t>(log.averaged)] = true;
  const std::size_t filled = rows_ - count_ + lacking_;
  if (filled > 0)
    log.findings.push_back({"drop_outs", -1, static_cast<double>(filled), "rows",
                            fmt::format("{} of {} rows are missing, in {} gaps and {} rows with empty cells; what is near them is left out",
                                        filled, rows_, gaps_, lacking_)});
  if (const double jitter = std::sqrt(jitter_ / static_cast<double>(rows_)); jitter > 0.05)
    log.findings.push_back({"jitter", -1, jitter, "steps",
                            fmt::format("instants are off a grid of {:.6g} s by {:.2g} of a step (rms); they are taken to be on it",
                                        log.file_step, jitter)});
  return log;
}

std::vector<std::pair<std::string, std::string>> pairsOf(const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw CsvError(fmt::format("--map: '{}', expected NAME=COLUMN", shown(text)));
    out.emplace_back(trimmedCell(std::string_view(text).substr(0, equals)),
                     trimmedCell(std::string_view(text).substr(equals + 1)));
  }
  return out;
}

/// N·m/A of each motor.
std::array<double, motor_count> constantsOf(const LogColumns& columns, const std::vector<double>& given) {
  std::array<double, motor_count> out;
  out.fill(1);
  if (columns.has_currents && given.size() != 1 && given.size() != motor_count)
    throw CsvError(fmt::format("the log has currents: --constant needs the motors' constants, N m/A or N/A, one or six, and got {}",
                               given.size()));
  if (!columns.has_currents && !given.empty())
    throw CsvError("--constant is for currents, and the log has efforts");
  for (std::size_t k = 0; k < motor_count && !given.empty(); ++k) out[k] = given.size() == 1 ? given[0] : given[k];
  return out;
}

/// Where a value goes in a row: motion, efforts, load.
std::size_t slotOf(const LogColumn& column, const LogColumns& columns) {
  const auto index = static_cast<std::size_t>(std::max(column.index, 0));
  const std::size_t motion = columns.has_poses ? 7 : 6;
  switch (column.quantity) {
    case LogQuantity::quaternion:
      return 3 + index;
    case LogQuantity::effort:
    case LogQuantity::current:
      return motion + index;
    case LogQuantity::moment:
      return motion + 6 + index;
    case LogQuantity::force:
      return motion + 9 + index;
    default:
      return index;
  }
}

/// Reads lines with their numbers; nothing else of the file is in memory.
class LogReader {
 public:
  LogReader(const LogOptions& options, const Manipulator& machine)
      : machine_(machine), file_(options.file.string()), stream_(options.file, std::ios::binary) {
    if (!stream_) throw CsvError(fmt::format("{}: error: cannot be read", shownPath(file_)));
    std::string head(std::size_t{1} << 16, '\0');
    stream_.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream_.gcount()));
    if (const auto end = head.rfind('\n'); stream_ && end != std::string::npos) head.resize(end + 1);
    stream_.clear();
    stream_.seekg(0);
    dialect_ = guessDialect(head, options.file);
    if (dialect_.header_cells.empty()) throw CsvError(fmt::format("{}: error: empty, expected a log", shownPath(file_)));
    columns_ = identification::findLogColumns(dialect_, file_, pairsOf(options.map), machine);
    constants_ = constantsOf(columns_, options.constants);
    for (LogColumn& column : columns_.columns) {
      if (column.quantity == LogQuantity::current) column.factor *= constants_[static_cast<std::size_t>(column.index)];
      width_ = std::max(width_, column.place + 1);
    }
    by_place_.assign(width_, nullptr);
    for (const LogColumn& column : columns_.columns) by_place_[column.place] = &column;
  }

  MeasuredLog read() {
    const std::size_t motion = columns_.has_poses ? 7 : 6, width = motion + 6 + (columns_.has_load ? 6 : 0);
    std::vector<std::size_t> turning;
    for (std::size_t k = 0; k < motor_count && !columns_.has_poses; ++k)
      if (!machine_.motors()[k].slides()) turning.push_back(k);
    LogGrid grid(width, turning);
    std::vector<double> row(width), before;
    std::string line;
    while (std::getline(stream_, line)) {
      ++line_;
      if (line_ <= dialect_.header || isPassedOver(line, dialect_)) continue;
      if (trimmedCell(line).find_first_not_of('\r') == std::string_view::npos) continue;
      const double t = parse(line, row);
      if (columns_.has_poses) keepSign(row, before);
      grid.add(t, row, [this] { return fmt::format("{}:{}", shownPath(file_), line_); });
    }
    return split(grid.finish(file_), static_cast<Eigen::Index>(motion));
  }

 private:
  /// Fills `row` and returns the instant.
  double parse(std::string& line, std::vector<double>& row) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (dialect_.decimal_comma) std::replace(line.begin(), line.end(), ',', '.');
    std::string_view rest = line;
    if (dialect_.separator == ' ') rest = trimmedCell(rest);
    double t = not_there;
    for (std::size_t place = 0; place < width_; ++place) {
      const auto end = dialect_.separator == ' ' ? rest.find_first_of(" \t") : rest.find(dialect_.separator);
      if (end == std::string_view::npos && place + 1 < width_)
        throw CsvError(fmt::format("{}:{}: error: {} cells, expected at least {}", shownPath(file_), line_, place + 1, width_));
      if (const LogColumn* column = by_place_[place]) {
        const double value = cell(rest.substr(0, end), *column);
        if (column->quantity == LogQuantity::time)
          t = value;
        else
          row[slotOf(*column, columns_)] = value * column->factor;
      }
      if (end == std::string_view::npos) break;
      rest.remove_prefix(end + 1);
      if (dialect_.separator == ' ') rest = trimmedCell(rest);
    }
    if (std::isnan(t)) throw CsvError(fmt::format("{}:{}: error: no instant, expected a number", shownPath(file_), line_));
    return t * timeFactor();
  }

  double timeFactor() const {
    for (const LogColumn& column : columns_.columns)
      if (column.quantity == LogQuantity::time) return column.factor;
    return 1;
  }

  double cell(std::string_view text, const LogColumn& column) const {
    text = trimmedCell(text);
    if (text.size() > 1 && text.front() == '"') text = text.substr(1, text.size() - 2);
    if (text.empty() || text == "nan" || text == "NaN" || text == "NA") return not_there;
    const LeadingNumber number = leadingNumber(text);
    if (number.length != text.size() || !std::isfinite(number.value))
      throw CsvError(fmt::format("{}:{}: error: column '{}': '{}', expected a finite number", shownPath(file_), line_,
                                 shown(column.name), shown(std::string(text))));
    return number.value;
  }

  /// q and −q are one orientation.
  static void keepSign(std::vector<double>& row, std::vector<double>& before) {
    if (!before.empty()) {
      double product = 0;
      for (std::size_t k = 3; k < 7; ++k) product += row[k] * before[k];
      for (std::size_t k = 3; k < 7 && product < 0; ++k) row[k] = -row[k];
    }
    before = row;
  }

  MeasuredLog split(MeasuredLog log, Eigen::Index motion) const {
    log.efforts = log.motion.middleCols(motion, motor_count);
    if (columns_.has_load) log.load = log.motion.rightCols(6);
    log.motion.conservativeResize(Eigen::NoChange, motion);
    log.has_poses = columns_.has_poses;
    log.by_currents = columns_.has_currents;
    log.read_as = columns_.read_as;
    log.ignored = columns_.ignored;
    return log;
  }

  const Manipulator& machine_;
  std::string file_;
  std::ifstream stream_;
  CsvDialect dialect_;
  LogColumns columns_;
  std::array<double, motor_count> constants_{};
  std::vector<const LogColumn*> by_place_;
  std::size_t width_ = 0;
  int line_ = 0;
};

}  // namespace

MeasuredLog readMeasuredLog(const LogOptions& options, const Manipulator& machine) {
  return LogReader(options, machine).read();
}

MeasuredLog measuredLogOf(const std::vector<double>& t, const Eigen::MatrixXd& motion, const Eigen::MatrixXd& efforts,
                          const Manipulator& machine) {
  const auto columns = static_cast<std::size_t>(motion.cols());
  std::vector<std::size_t> turning;
  for (std::size_t k = 0; k < motor_count && columns == motor_count; ++k)
    if (!machine.motors()[k].slides()) turning.push_back(k);
  LogGrid grid(columns + motor_count, turning);
  std::vector<double> row(columns + motor_count);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    Eigen::Map<Eigen::VectorXd>(row.data(), motion.cols()) = motion.row(at).transpose();
    Eigen::Map<Eigen::VectorXd>(row.data() + columns, motor_count) = efforts.row(at).transpose();
    grid.add(t[i], row, [i] { return fmt::format("row {}", i + 1); });
  }
  MeasuredLog log = grid.finish("the log");
  log.efforts = log.motion.rightCols(motor_count);
  log.motion.conservativeResize(Eigen::NoChange, motion.cols());
  log.has_poses = columns == 7;
  return log;
}

}  // namespace ursula
