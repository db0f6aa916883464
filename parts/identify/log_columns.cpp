#include "parts/identify/log_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "base/csv.h"
#include "base/scalar.h"
#include "base/text.h"
#include "validation/subject/torque_names.h"

namespace ursula::identification {
namespace {

constexpr const char* unit_tail = R"((?:[ _]*[\[(/_ ,][ ]*(rad|deg|degrees|°|mm|m|mA|A|kN|N|kNm|Nm)?[ ]*[\])]?)?)";

double factorOf(const std::string& unit) {
  if (unit == "deg" || unit == "degrees" || unit == "°") return degree;
  if (unit == "mm" || unit == "mA") return 1e-3;
  return unit == "kN" || unit == "kNm" ? 1e3 : 1;
}

std::optional<Coordinate> coordinateOf(const std::string& name) {
  for (const Coordinate each : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d})
    if (name == nameOf(each)) return each;
  return std::nullopt;
}

std::optional<LogColumn> meaningOfColumn(const std::string& name) {
  static const std::string tail = unit_tail;
  static const std::regex of_leg("(phi|psi|theta|d)_?([0-6])" + tail);
  static const std::regex of_motor(
      "(?:q|pos|position|enc|encoder|angle|length|joint|joint[ _]pos(?:ition)?)[ _]?([0-6])" + tail, std::regex::icase);
  static const std::regex current("(?:i|current|motor[ _]?current)[ _]?([0-6])" + tail, std::regex::icase);
  static const std::regex vector("([pqfm])_?([wxyz])" + tail);
  std::smatch found;
  if (const auto torque = meaningOf(name))
    return LogColumn{torque->motor < 0 ? LogQuantity::time : LogQuantity::effort, torque->motor,
                     std::pow(10.0, torque->power)};
  const auto digit = [&](std::size_t group) { return found[group].str()[0] - '0'; };
  if (std::regex_match(name, found, of_leg))
    return LogColumn{LogQuantity::driven, digit(2), factorOf(found[3]), 0, name, coordinateOf(found[1])};
  if (std::regex_match(name, found, of_motor)) return LogColumn{LogQuantity::driven, digit(1), factorOf(found[2])};
  if (std::regex_match(name, found, current)) return LogColumn{LogQuantity::current, digit(1), factorOf(found[2])};
  if (!std::regex_match(name, found, vector)) return std::nullopt;
  const char kind = found[1].str()[0];
  const int axis = static_cast<int>(std::string("xyz").find(found[2]));
  if (kind == 'q') return LogColumn{LogQuantity::quaternion, found[2] == "w" ? 0 : axis + 1, 1};
  if (axis < 0) return std::nullopt;
  return LogColumn{kind == 'p'   ? LogQuantity::position
                   : kind == 'f' ? LogQuantity::force
                                 : LogQuantity::moment,
                   axis, factorOf(found[3])};
}

/// Finds the meaning of a log's columns.
class LogFinder {
 public:
  LogFinder(const CsvDialect& dialect, const std::string& file, const Manipulator& machine)
      : dialect_(dialect), file_(file), machine_(machine) {}

  LogColumns find(const std::vector<std::pair<std::string, std::string>>& map) {
    std::vector<LogColumn> all;
    std::vector<bool> mapped(dialect_.header_cells.size(), false);
    for (const auto& [name, column] : map) {
      all.push_back(target(name));
      all.back().place = place(column, mapped);
    }
    for (std::size_t i = 0; i < mapped.size(); ++i)
      if (auto meaning = mapped[i] ? std::nullopt : meaningOfColumn(dialect_.header_cells[i])) {
        meaning->place = i;
        all.push_back(*meaning);
      }
    const int first = countsFrom(all);
    for (const LogColumn& column : all) add(column, first);
    choose();
    return std::move(out_);
  }

 private:
  LogColumn target(const std::string& name) const {
    if (const auto meaning = meaningOfColumn(name)) return *meaning;
    fail(fmt::format("--map: '{}' is no name of a log's column, expected one such as t_s, {}, {}, p_x_m, q_w, i_1_A",
                     shown(name), drivenName(machine_.motors()[0]), effortColumn(machine_.motors(), 0)));
  }

  std::size_t place(const std::string& column, std::vector<bool>& mapped) const {
    const auto& cells = dialect_.header_cells;
    const auto found = std::find(cells.begin(), cells.end(), column);
    if (found == cells.end()) fail(fmt::format("no column '{}'{}", shown(column), didYouMean(column, cells)));
    const auto at = static_cast<std::size_t>(found - cells.begin());
    if (mapped[at]) fail(fmt::format("--map: column '{}' twice", shown(column)));
    mapped[at] = true;
    return at;
  }

  /// Returns 0 or 1, the number of the first motor.
  static int countsFrom(const std::vector<LogColumn>& all) {
    const auto has = [&](int index) {
      return std::any_of(all.begin(), all.end(),
                         [&](const LogColumn& each) { return counts(each) && each.index == index; });
    };
    return has(0) && !has(6) ? 0 : 1;
  }

  /// Returns whether the column's index counts motors or legs.
  static bool counts(const LogColumn& column) {
    return column.quantity == LogQuantity::driven || column.quantity == LogQuantity::effort ||
           column.quantity == LogQuantity::current;
  }

  void add(LogColumn column, int first) {
    column.name = dialect_.header_cells[column.place];
    const Motors& motors = machine_.motors();
    if (counts(column)) column.index -= first;
    if (column.coordinate) {  // a leg's coordinate counts only if a motor drives it
      const auto motor = std::find_if(motors.begin(), motors.end(), [&](const Motor& each) {
        return each.leg == column.index && each.coordinate == *column.coordinate;
      });
      if (motor == motors.end()) return;
      column.index = static_cast<int>(motor - motors.begin());
    }
    const bool is_time = column.quantity == LogQuantity::time;
    if (column.index >= motor_count || (column.index < 0 && !is_time)) return;
    if (column.quantity == LogQuantity::effort) requireUnit(column);
    const auto same = [&](const LogColumn& other) {
      return other.quantity == column.quantity && other.index == column.index;
    };
    if (std::any_of(found_.begin(), found_.end(), same)) return;  // the first column wins; mapped ones come before all
    found_.push_back(column);
  }

  void requireUnit(const LogColumn& column) const {
    const auto meaning = meaningOf(column.name);
    if (!meaning || meaning->fits(machine_.motors(), column.index)) return;
    fail(fmt::format("column '{}': {}", shown(column.name), whatItTakes(machine_.motors(), column.index)));
  }

  bool has(LogQuantity quantity, int count) const {
    return std::count_if(found_.begin(), found_.end(), [&](const LogColumn& c) { return c.quantity == quantity; }) >=
           count;
  }

  /// Prefers driven coordinates to poses, and efforts to currents.
  void choose() {
    if (!has(LogQuantity::time, 1)) missing("t_s");
    const bool poses = has(LogQuantity::position, 3) && has(LogQuantity::quaternion, 4);
    out_.has_poses = poses && !has(LogQuantity::driven, motor_count);
    if (!poses) requireSix(LogQuantity::driven, [this](int k) { return drivenName(machine_.motors()[k]); });
    out_.has_currents = !has(LogQuantity::effort, 1) && has(LogQuantity::current, motor_count);
    if (!out_.has_currents)
      requireSix(LogQuantity::effort, [this](int k) { return effortColumn(machine_.motors(), k); });
    out_.has_load = has(LogQuantity::force, 3) && has(LogQuantity::moment, 3);
    for (const LogColumn& column : found_)
      if (isUsed(column.quantity)) out_.columns.push_back(column);
    std::vector<std::string> words;
    for (std::size_t i = 0; i < dialect_.header_cells.size(); ++i) {
      const auto used = std::find_if(out_.columns.begin(), out_.columns.end(),
                                     [&](const LogColumn& column) { return column.place == i; });
      if (used == out_.columns.end())
        out_.ignored.push_back(dialect_.header_cells[i]);
      else
        words.push_back(wordsOf(*used));
    }
    out_.read_as = fmt::format("{}", fmt::join(words, ", "));
    if (const std::string how = dialect_.words(); !how.empty()) out_.read_as = how + "; " + out_.read_as;
  }

  bool isUsed(LogQuantity of) const {
    if (of == LogQuantity::driven) return !out_.has_poses;
    if (of == LogQuantity::position || of == LogQuantity::quaternion) return out_.has_poses;
    if (of == LogQuantity::effort) return !out_.has_currents;
    if (of == LogQuantity::current) return out_.has_currents;
    return of == LogQuantity::time || out_.has_load;
  }

  std::string wordsOf(const LogColumn& column) const {
    static constexpr const char* words[] = {"time",   "coordinate", "position of P", "orientation",
                                            "effort", "current",    "load",          "load"};
    std::string what = words[static_cast<int>(column.quantity)];
    if (counts(column)) what += fmt::format(" of motor {}", column.index + 1);
    return column.factor == 1 ? fmt::format("'{}' {}", shown(column.name), what)
                              : fmt::format("'{}' {} × {:.6g}", shown(column.name), what, column.factor);
  }

  template <class Name>
  void requireSix(LogQuantity quantity, const Name& name) const {
    for (int k = 0; k < motor_count; ++k)
      if (std::none_of(found_.begin(), found_.end(),
                       [&](const LogColumn& c) { return c.quantity == quantity && c.index == k; }))
        missing(name(k));
  }

  [[noreturn]] void missing(const std::string& name) const {
    const auto& cells = dialect_.header_cells;
    fail(fmt::format(
        "missing column '{}', expected it in the header; found {}; if one of them holds it, add --map {}=COLUMN", name,
        shown(fmt::format("'{}'", fmt::join(cells, "', '")), 400), name));
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw CsvError(fmt::format("{}:{}: error: {}", shownPath(file_), std::max(dialect_.header, 1), what));
  }

  const CsvDialect& dialect_;
  const std::string& file_;
  const Manipulator& machine_;
  std::vector<LogColumn> found_;
  LogColumns out_;
};

}  // namespace

std::string drivenName(const Motor& motor) {
  return fmt::format("{}_{}_{}", nameOf(motor.coordinate), motor.leg + 1, motor.slides() ? "m" : "rad");
}

LogColumns findLogColumns(const CsvDialect& dialect, const std::string& file,
                          const std::vector<std::pair<std::string, std::string>>& map, const Manipulator& machine) {
  return LogFinder(dialect, file, machine).find(map);
}

}  // namespace ursula::identification
