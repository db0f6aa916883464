#include "validation/subject/torque_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/text.h"
#include "model/effort_units.h"
#include "model/motor_table.h"
#include "model/torque_names.h"
#include "validation/subject/single_precision.h"

namespace ursula {
namespace {

std::string quoted(const std::string& text) {
  return text.find_first_of(" \t[](){}*;&|<>$`\"\\#?") == std::string::npos ? text : "'" + text + "'";
}

std::string separatorWords(const CsvDialect& dialect) {
  if (dialect.separator == '\t') return "tabs";
  return dialect.separator == ' ' ? "blanks" : fmt::format("'{}'", dialect.separator);
}

/// Assigns a meaning to each column.
class Finder {
 public:
  Finder(const CsvDialect& dialect, const std::filesystem::path& file, const EffortAxes& motors)
      : dialect_(dialect), file_(file), motors_(motors), targets_(targetNames(motors)) {}

  std::vector<TorqueColumn> find(const ColumnMap& map) {
    for (const auto& [name, column] : map) take(name, column);
    // Then tau_1_Nm belongs to motor 2.
    const bool from_zero = (has("tau_0_Nm") || has("tau_0_N")) && !has(targets_.back());
    for (const std::string& name : targets_) {
      if (!from_zero && found_.count(name) == 0 && isTaken(name))
        fail(fmt::format("--map gives column '{}' to another name, so '{}' has none; expected --map {} too", name, name,
                         quoted(name + "=COLUMN")));
    }
    for (const std::string& name : targets_)
      if (has(name) && (!from_zero || name == "t_s")) found_.emplace(name, TorqueColumn{name, name, 0});
    takeByJoint();
    takeCertain();
    std::vector<TorqueColumn> out;
    for (const std::string& name : targets_) {
      const auto column = found_.find(name);
      if (column == found_.end()) fail(missingText(name));
      out.push_back(column->second);
    }
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw CsvError(fmt::format("{}:{}: error: {}", file_.string(), std::max(1, dialect_.header), what));
  }

  bool has(const std::string& column) const {
    return std::find(dialect_.header_cells.begin(), dialect_.header_cells.end(), column) != dialect_.header_cells.end();
  }

  std::string headerInWords() const {
    constexpr std::size_t most = 1000;
    return shown(fmt::format("{}", fmt::join(dialect_.header_cells, ", ")), most);
  }

  bool isTaken(const std::string& column) const {
    return std::any_of(found_.begin(), found_.end(), [&](const auto& pair) { return pair.second.source == column; });
  }

  void take(const std::string& name, const std::string& column) {
    if (!has(column))
      fail(fmt::format("no column '{}' (--map {}), the header has {}{}", column, quoted(name + "=" + column),
                       headerInWords(), didYouMean(column, dialect_.header_cells)));
    const ColumnMeaning meaning = *meaningOfTarget(name, motors_);
    const std::string target = targetName(motors_, meaning.motor);
    found_.emplace(target, TorqueColumn{target, column, meaning.power, meaning.multiplier});
  }

  void takeCertain() {
    std::vector<std::pair<std::string, ColumnMeaning>> certain;
    bool zero = false, last = false;
    for (const std::string& column : dialect_.header_cells) {
      const std::optional<ColumnMeaning> meaning = isTaken(column) ? std::nullopt : meaningOf(column);
      if (!meaning) continue;
      certain.emplace_back(column, *meaning);
      zero = zero || meaning->motor == 0;
      last = last || meaning->motor == motors_.count();
    }
    if (zero && last) return;  // of one effort too many the superfluous one is unknown
    const auto by_map_or_name = found_;
    for (auto& [column, meaning] : certain) {
      const int motor = meaning.motor < 0 || zero ? meaning.motor : meaning.motor - 1;
      if (motor >= motors_.count()) continue;
      if (by_map_or_name.count(targetName(motors_, motor)) == 0) takeAs(motor, column, meaning);
    }
  }

  void takeByJoint() {
    for (const std::string& column : dialect_.header_cells)
      if (!isTaken(column))
        if (const auto meaning = meaningByJoint(column, motors_)) takeAs(meaning->motor, column, *meaning);
  }

  void takeAs(int motor, const std::string& column, const ColumnMeaning& meaning) {
    const std::string name = targetName(motors_, motor);
    if (motor >= 0 && !meaning.fits(motors_, motor))
      wrong_unit_.emplace(name, fmt::format("column '{}': {}", column, whatItTakes(motors_, motor)));
    else if (!found_.emplace(name, TorqueColumn{name, column, meaning.power, meaning.multiplier}).second)
      fail(fmt::format("'{}' and '{}' may both be {}, expected one; choose by --map {}", found_.at(name).source, column,
                       name, quoted(name + "=" + column)));
  }

  /// Adds options that would read the file if unassigned columns end in the leg's number.
  std::string missingText(const std::string& name) const {
    if (const auto wrong = wrong_unit_.find(name); wrong != wrong_unit_.end()) return wrong->second;
    std::string text = fmt::format("missing column '{}', expected it in the header", name);
    std::vector<std::string> free;
    for (const std::string& column : dialect_.header_cells)
      if (!isTaken(column)) free.push_back(column);
    text += didYouMean(name, likeliest(name, free));
    text += dialect_.header == 0
                ? fmt::format("; the file has no header, and {} columns (separated by {})",
                              dialect_.header_cells.size(), separatorWords(dialect_))
                : fmt::format("; its columns, separated by {}, are: {}", separatorWords(dialect_), headerInWords());
    return text + options(free);
  }

  /// Never suggests a column of another motor.
  std::vector<std::string> likeliest(const std::string& name, const std::vector<std::string>& columns) const {
    std::vector<std::string> out;
    std::copy_if(columns.begin(), columns.end(), std::back_inserter(out), [&](const std::string& column) {
      return (column.size() != name.size() && !meaningOfTarget(column, motors_)) || name == "t_s";
    });
    return out;
  }

  std::string options(const std::vector<std::string>& free) const {
    std::string out;
    std::vector<std::string> unguessed;
    std::size_t next = 0;
    for (int k = -1; k < motors_.count(); ++k) {
      const std::string& name = targets_[static_cast<std::size_t>(k + 1)];
      if (found_.count(name) > 0) continue;
      const std::string number = name == "t_s" ? "" : name.substr(4, name.rfind('_') - 4);
      const auto column = dialect_.header == 0 || (name == "t_s" && dialect_.header_cells.size() == wanted())
                              ? std::find(free.begin(), free.end(), next < free.size() ? free[next++] : "")
                              : std::find_if(free.begin(), free.end(), [&](const std::string& cell) {
                                  const auto digit = cell.find_first_of("0123456789");
                                  const auto end = std::min(cell.find_first_not_of("0123456789", digit), cell.size());
                                  return digit != std::string::npos && cell.substr(digit, end - digit) == number;
                                });
      const std::string unit = column == free.end() ? "" : unitOfColumn(*column, motors_, k);
      if (unit.empty())
        unguessed.push_back(name);
      else
        out += fmt::format(" --map {}", quoted(name.substr(0, name.rfind('_') + 1) + unit + "=" + *column));
    }
    if (found_.count("t_s") == 0 && dialect_.header == 0 && dialect_.header_cells.size() + 1 == wanted())
      return "; is the column of the time missing?";
    if (dialect_.header_cells.size() > 2 * wanted()) return "; is the table transposed? expected a row per instant";
    if (unguessed.empty()) return "; if that is what its columns hold, add" + out;
    out += fmt::format(" --map {}=COLUMN", unguessed.front());
    unguessed.erase(unguessed.begin());
    const std::string likewise =
        unguessed.empty() ? "" : fmt::format(", and likewise for {}", fmt::join(unguessed, ", "));
    return "; if its columns hold them under other names, add" + out + likewise;
  }

  std::size_t wanted() const { return targets_.size(); }

  const CsvDialect& dialect_;
  const std::filesystem::path& file_;
  const EffortAxes& motors_;
  std::vector<std::string> targets_;
  std::map<std::string, TorqueColumn> found_;
  std::map<std::string, std::string> wrong_unit_;  ///< by the missing column: the column found instead, in words
};

/// Whether only the first of `wanted` columns without a header can be the time.
bool isTimeThenTorques(const CsvTable& table, std::size_t wanted) {
  const auto looksLikeTime = [](const std::vector<double>& column) {
    const double step =
        column.size() < 3 ? 0 : (column.back() - column.front()) / static_cast<double>(column.size() - 1);
    if (!(step > 0 && std::abs(column.front()) <= 1e-9 * step)) return false;
    for (std::size_t k = 1; k < column.size(); ++k)
      if (!(std::abs(column[k] - column[k - 1] - step) <= 0.01 * step)) return false;
    return true;
  };
  return table.columns.size() == wanted && looksLikeTime(table.columns.front()) &&
         std::none_of(table.columns.begin() + 1, table.columns.end(), looksLikeTime);
}

/// Puts the columns in this order, with their names and in SI but for the multipliers.
void arrange(const std::vector<TorqueColumn>& columns, CsvTable& table) {
  const CsvTable given = table;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto from = std::find(given.names.begin(), given.names.end(), columns[i].source) - given.names.begin();
    const int power = columns[i].power;
    const double unit = std::pow(10.0, std::abs(power));
    table.names[i] = columns[i].name;
    table.columns[i] = given.columns[from];
    table.last_places[i] = given.last_places[from];
    for (double& value : table.columns[i]) value = power < 0 ? value / unit : value * unit;
    for (int& place : table.last_places[i]) place += power;
  }
}

std::string readAs(const CsvDialect& dialect, const std::vector<TorqueColumn>& columns) {
  std::string out = dialect.words();
  for (const TorqueColumn& column : columns)
    if (column.source != column.name)
      out += fmt::format("{}{} = '{}'{}", out.empty() ? "" : ", ", column.name, column.source,
                         column.multiplier != 1
                             ? fmt::format(" times {:.7g}", column.multiplier * std::pow(10, column.power))
                         : column.power == 0 ? ""
                                             : fmt::format(" times 1e{}", column.power));
  return out;
}

}  // namespace

ColumnMap parseColumnMap(const std::vector<std::string>& texts, const EffortAxes& motors) {
  const std::vector<std::string> targets = targetNames(motors);
  ColumnMap out;
  for (const std::string& text : texts) {
    const auto fail = [&text](const std::string& what) {
      throw CsvError(fmt::format("--map {}: {}", quoted(text), what));
    };
    const std::pair<std::string, std::string> entry = mapEntry(text);
    const std::string &name = entry.first, &column = entry.second;
    if (name.empty() || column.empty()) fail(fmt::format("expected NAME=COLUMN, as in {}=tau1", targets[1]));
    const std::optional<ColumnMeaning> meaning = meaningOfTarget(name, motors);
    if (!meaning)
      fail(fmt::format("'{}' is not a column of a torque file, expected t_s or {} to {}{}", name, targets[1],
                       targets.back(), didYouMean(name, targets)));
    if (meaning->motor >= 0 && !meaning->fits(motors, meaning->motor)) fail(whatItTakes(motors, meaning->motor));
    for (const auto& [other, its_column] : out) {
      if (meaningOfTarget(other, motors)->motor == meaning->motor) fail(fmt::format("{} is mapped twice", name));
      if (its_column == column) fail(fmt::format("column '{}' is mapped to {} already", column, other));
    }
    out.emplace_back(name, column);
  }
  return out;
}

TorqueColumns readTorqueColumns(const std::string& text, const std::filesystem::path& file, const ColumnMap& map,
                                const EffortAxes& motors) {
  CsvOptions options;
  options.dialect = guessDialect(text, file);
  std::vector<TorqueColumn> columns;
  if (options.dialect.header == 0 && map.empty() &&
      isTimeThenTorques(parseCsv(text, file, options), targetNames(motors).size())) {
    for (int k = -1; k < motors.count(); ++k) columns.push_back({targetName(motors, k), std::to_string(k + 2), 0});
  } else if (options.dialect.header_cells.empty()) {
    parseCsv(text, file);  // reports the defect of an empty file
  } else {
    columns = Finder(options.dialect, file, motors).find(map);
  }
  options.wanted = [&columns](const std::string& name) {
    return std::any_of(columns.begin(), columns.end(), [&](const TorqueColumn& one) { return one.source == name; });
  };
  TorqueColumns out{parseCsv(text, file, options), {}, readAs(options.dialect, columns)};
  SinglePrecision single;
  for (const TorqueColumn& column : columns) {
    out.multipliers.push_back(column.multiplier);
    if (column.name == "t_s") continue;
    for (const double effort : out.table.at(column.source)) single.add(effort);
  }
  out.all_single = single.all();
  arrange(columns, out.table);
  return out;
}

}  // namespace ursula
